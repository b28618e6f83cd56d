#ifndef nmm_scene_scene_parameters_stages_h
#define nmm_scene_scene_parameters_stages_h

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// A stage after the first equilibrium: a subsection of `Stages`.
  struct StageParameters
  {
    /// Name of the subsection.
    std::string name;
    /// Names of the regions that are removed at the beginning of the stage.
    std::vector<std::string> removed_regions;
    /// Names of the loads that begin to act in the stage, and of the loads and supports that cease to.
    std::vector<std::string> added_conditions, removed_conditions;
    /// Names of the bolts that are installed at the beginning of the stage.
    std::vector<std::string> installed;
    /// The table of water at the end of the stage, see WaterParameters::table; empty: it stays.
    std::string water_table;
    /// Share of the tractions on the walls of all regions, and of all supports, removed so far that is
    /// released at the end of the stage [-].
    double relaxation = 1.;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
  };
} // namespace NMM

#endif
