#ifndef nmm_scene_scene_parameters_bolts_h
#define nmm_scene_scene_parameters_bolts_h

#include <nmm/mechanics/bolt.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// Equal bolts: a subsection of `Bolts`.
  struct BoltParameters
  {
    /// Name of the subsection.
    std::string name;
    /// Paths as lines of well-known text, separated by semicolons; a bolt for each.
    std::string paths;
    /// All values but the path and the time of installation. A limit of 0 stands for none.
    Bolt bolt;

    BoltParameters();

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);

    /// The bolts that are installed at the load factor or time @p installed_at.
    /// @throws InputError for paths that are no lines.
    std::vector<Bolt>
    make_bolts(double installed_at) const;
  };
} // namespace NMM

#endif
