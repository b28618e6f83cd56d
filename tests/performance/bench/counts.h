#ifndef nmm_tests_performance_bench_counts_h
#define nmm_tests_performance_bench_counts_h

#include "row.h"
#include <ostream>

namespace NMM
{
  namespace Bench
  {
    /// A count that does not depend on how busy the machine is.
    struct Count
    {
      /// "allocations" or "instructions".
      std::string kind;
      /// Of what, and for each of what.
      std::string what, per;
      /// How many of those there were.
      double n = none;
      /// The count over n.
      double count = none;
    };


    /// Calls of `operator new` in this program so far.
    unsigned long
    n_allocations();

    /// Allocations in the loops that run in every step and iteration, and in cutting.
    std::vector<Count>
    count_allocations();

    /**
     * Instructions from the files that callgrind has left in @p directory when it ran
     * nmm-kernels; none if there are none.
     */
    std::vector<Count>
    read_instructions(const std::string &directory);

    void
    write_counts(const std::string        &file_name,
                 const std::vector<Count> &counts);
  } // namespace Bench
} // namespace NMM

#endif
