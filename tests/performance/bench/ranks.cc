// The same ring on more ranks, and one with as many unknowns for each rank.

#include "ring.h"
#include <cmath>
#include <vector>

namespace NMM
{
  namespace Bench
  {
    void
    measure_ranks(Recorder &recorder)
    {
      using Solver = LinearSolverParameters::Type;
      const double n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const bool   is_small = recorder.size() == Size::smallest;
      const double full     = recorder.size() == Size::full ? 0.0074
                              : is_small                    ? 0.1
                                                            : 0.0151;
      Ring         ring;
      for (const Solver solver : {Solver::direct, Solver::iterative})
      {
        ring.solver.type = solver;
        ring.name        = "strong scaling";
        ring.cell_size   = full;
        recorder.record([&]() { return run(ring, false); });
        // a quarter as many unknowns on each rank as there are above
        ring.name      = "weak scaling";
        ring.cell_size = 2. * full / std::sqrt(n_ranks);
        recorder.record([&]() { return run(ring, false); });
      }
    }
  } // namespace Bench
} // namespace NMM
