// How the ring is shared out among ranks: all of the mesh on each rank, or a part.

#include "ring.h"
#include <cmath>
#include <vector>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      /**
       * Time that a message of @p n_bytes takes from one rank to another one [s]: half of
       * the way there and back, the least of several series. Rows say it as total.
       */
      Row
      measure_message(const unsigned int n_bytes)
      {
        constexpr unsigned int n_series = 20, n_per_series = 100;
        std::vector<char>      buffer(n_bytes);
        const unsigned int     rank =
          dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
        double best = 1e300;
        for (unsigned int s = 0; s < n_series; ++s)
        {
          MPI_Barrier(MPI_COMM_WORLD);
          const double start = MPI_Wtime();
          for (unsigned int i = 0; i < n_per_series && rank < 2; ++i)
            for (const unsigned int sender : {0U, 1U})
              if (rank == sender)
                MPI_Send(buffer.data(),
                         n_bytes,
                         MPI_CHAR,
                         1 - rank,
                         0,
                         MPI_COMM_WORLD);
              else
                MPI_Recv(buffer.data(),
                         n_bytes,
                         MPI_CHAR,
                         1 - rank,
                         0,
                         MPI_COMM_WORLD,
                         MPI_STATUS_IGNORE);
          best = std::fmin(best, (MPI_Wtime() - start) / (2. * n_per_series));
        }
        Row row;
        row.name          = "message";
        row.method        = "MPI";
        row.messages      = 1.;
        row.message_bytes = n_bytes;
        row.total         = best;
        return row;
      }
    } // namespace


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
      if (n_ranks > 1.)
        for (const unsigned int n_bytes : {8U, 1000000U})
          recorder.add(measure_message(n_bytes));

      Ring ring;
      for (const bool is_distributed : {false, true})
        for (const Solver solver : {Solver::direct, Solver::iterative})
        {
          ring.options.is_distributed = is_distributed;
          ring.solver.type            = solver;
          ring.name                   = "strong scaling";
          ring.cell_size              = full;
          recorder.record([&]() { return run(ring, false); });
          // a quarter as many unknowns on each rank as there are above
          ring.name      = "weak scaling";
          ring.cell_size = 2. * full / std::sqrt(n_ranks);
          recorder.record([&]() { return run(ring, false); });
        }
    }
  } // namespace Bench
} // namespace NMM
