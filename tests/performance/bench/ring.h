#ifndef nmm_tests_performance_bench_ring_h
#define nmm_tests_performance_bench_ring_h

#include "staged_model.h"

namespace NMM
{
  namespace Bench
  {
    /// The thick ring on a mesh that does not fit it.
    struct Ring
    {
      std::string            name = "ring";
      double                 cell_size;
      bool                   is_graded = false;
      StagedModel::Options   options;
      LinearSolverParameters solver;
    };

    Row
    run(const Ring &ring, bool with_stress_error = true);
  } // namespace Bench
} // namespace NMM

#endif
