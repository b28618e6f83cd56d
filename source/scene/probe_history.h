#ifndef nmm_source_scene_probe_history_h
#define nmm_source_scene_probe_history_h

#include <nmm/covers/cover_system.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/probes.h>

#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The table probes-history.csv: displacement [m] and velocity [m/s] of the probes that are
     * points, with a row per time step. All functions are collective.
     */
    class ProbeHistory
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      ProbeHistory(const CoverSystem        &covers,
                   const ProbePoints        &points,
                   const std::vector<Probe> &probes);

      /// Uses the arguments from now on, after the solid was cut again; the table remains. Probes
      /// must be the same.
      void
      follow(const CoverSystem        &covers,
             const ProbePoints        &points,
             const std::vector<Probe> &probes);

      /// Whether no probe is a point.
      bool
      is_empty() const;

      /// Opens the table on rank 0; see CsvSeries for @p continue_after.
      void
      open(const std::string &file_name, int continue_after);

      /// Displacement and velocity of each probe in turn, from vectors of owned unknowns. The
      /// result is the same on all ranks.
      std::vector<double>
      evaluate(const Vector &u, const Vector &v) const;

      /// Writes a row on rank 0.
      void
      write(double time, unsigned int step, const std::vector<double> &values);

    private:
      struct Term
      {
        unsigned int cover;
        double       weight;
      };

      MPI_Comm                 communicator;
      std::vector<std::string> names;
      /// For each probe, the terms of its displacement from covers that this rank owns.
      std::vector<std::vector<Term>> terms;
      std::unique_ptr<CsvSeries>     table;
    };
  } // namespace internal
} // namespace NMM

#endif
