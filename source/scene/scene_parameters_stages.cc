#include <nmm/scene/scene_parameters_stages.h>

#include <scene/parsing.h>

// This file has the parameters of stages.
namespace NMM
{
  using namespace internal;

  void
  StageParameters::list_entries(Entries &entries)
  {
    entries.add("Remove regions",
                removed_regions,
                "Names of regions with 'Use = staged' that are removed at the "
                "beginning of the stage.");
    entries.add("Add conditions",
                added_conditions,
                "Names of loads (boundary conditions and point forces) that "
                "grow from 0 to their size in the stage. They do not act "
                "before.");
    entries.add("Remove conditions",
                removed_conditions,
                "Names of loads that decrease to 0 in the stage, and of "
                "supports (displacement conditions and fixed points) that are "
                "gone from its beginning on.");
    entries.add("Install",
                installed,
                "Names of bolts that are installed at the beginning of the "
                "stage, without force but their pretension.");
    entries.add("Water table",
                water_table,
                "Table of water at the end of the stage, as 'Water/Table': "
                "pressures change to it with the load factor. Empty: it "
                "stays.");
    entries.add(
      "Relaxation",
      relaxation,
      dealii::Patterns::Double(0., 1.),
      "Share of the tractions on the walls of all regions, and of all "
      "supports, removed so far that is released at the end of the "
      "stage; the rest is held [-].");
  }
} // namespace NMM
