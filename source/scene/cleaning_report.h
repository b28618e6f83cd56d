#ifndef nmm_source_scene_cleaning_report_h
#define nmm_source_scene_cleaning_report_h

#include <nmm/geometry/geometry.h>

#include <ostream>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// A sentence with the numbers of changes by their kinds, and the largest one.
    std::string
    summarize(const std::vector<CleaningAction> &actions);

    /// A table with one row for each change.
    void
    write_table(const std::vector<CleaningAction> &actions, std::ostream &out);
  } // namespace internal
} // namespace NMM

#endif
