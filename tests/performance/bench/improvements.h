#ifndef nmm_tests_performance_bench_improvements_h
#define nmm_tests_performance_bench_improvements_h

#include "row.h"
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace NMM
{
  namespace Bench
  {
    /// A row of nmm-heap's table: cells by the names of their columns.
    using HeapRow = std::map<std::string, std::string>;

    /// Empty if there is no such file.
    std::vector<HeapRow>
    read_heaps(const std::string &file_name);

    /// What was measured before something became faster, and at present.
    struct Earlier
    {
      std::vector<Row>     rows;
      std::vector<HeapRow> heaps_before, heaps;
    };

    /// Stages before and now, of what both tables have.
    void
    write_improvements(std::ostream           &out,
                       const Earlier          &earlier,
                       const std::vector<Row> &rows);
  } // namespace Bench
} // namespace NMM

#endif
