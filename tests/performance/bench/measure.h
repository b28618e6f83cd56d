#ifndef nmm_tests_performance_bench_measure_h
#define nmm_tests_performance_bench_measure_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include "row.h"

namespace NMM
{
  namespace Bench
  {
    /// How much is measured.
    enum class Size
    {
      /// Seconds: does the program work?
      smallest,
      /// Some minutes.
      quick,
      /// All bars at full size.
      full
    };


    /// Laps of wall time, which end together on all ranks.
    class Stopwatch
    {
    public:
      explicit Stopwatch(MPI_Comm communicator = MPI_COMM_WORLD);

      /// Since the last lap, on the slowest rank [s].
      double
      lap();

      /// Since the start, at the last lap [s].
      double
      total() const;

    private:
      MPI_Comm      communicator;
      dealii::Timer timer;
      double        last = 0.;
    };


    /// Bytes allocated on this rank now [MB].
    double
    allocated_memory();


    /// Collects rows, prints what they say as they come.
    class Recorder
    {
    public:
      Recorder(Size size, std::vector<Row> rows = {});

      Size
      size() const;

      /**
       * Run @p run three times, or twice if that takes longer than two seconds,
       * or once if that takes longer than ten. Of each time the least counts, of
       * everything else the first run's. Memory is that of the first run.
       */
      void
      record(const std::function<Row()> &run);

      /// A row that is measured already.
      void
      add(Row row);

      const std::vector<Row> &
      rows() const;

    private:
      Size             how_much;
      std::vector<Row> list;
    };


    /// @name Cases. Each adds its rows.
    /// @{

    /// Thick ring on any number of ranks; fitted elements beside it on one.
    void
    measure_ring(Recorder &recorder);

    /// Cantilever under dead and follower load.
    void
    measure_cantilever(Recorder &recorder);

    /// Cylinder on a rigid plate: pressure against Hertz's.
    void
    measure_hertz(Recorder &recorder);

    /// Energy of a plate with an edge crack.
    void
    measure_cracked_plate(Recorder &recorder);

    /// Block that slides down an incline.
    void
    measure_incline(Recorder &recorder);

    /// Slope of jointed rock that slides.
    void
    measure_slope(Recorder &recorder);

    /// Cutting, covers and quadrature of a large mesh with many joints, beside deal.II's own
    /// triangulation and dofs.
    void
    measure_cutting(Recorder &recorder);

    /// Rings with many unknowns, on any number of ranks.
    void
    measure_large_rings(Recorder &recorder);

    /// Rings on ranks that hold all of the mesh or a part of it: the same one on
    /// more ranks, and one that grows with them.
    void
    measure_ranks(Recorder &recorder);

    /// A run in time that writes fields.
    void
    measure_output(Recorder &recorder);

    /// Assembly of elasticity with ElementValues, and the library's own.
    void
    measure_values(Recorder &recorder);

    /// Rules of cut elements and assembly on one thread and two.
    void
    measure_threads(Recorder &recorder);
    /// @}
  } // namespace Bench
} // namespace NMM

#endif
