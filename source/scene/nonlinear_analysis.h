#ifndef nmm_source_scene_nonlinear_analysis_h
#define nmm_source_scene_nonlinear_analysis_h

#include <nmm/mechanics/elastic_system.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/incremental_elasticity.h>
#include <nmm/mechanics/incremental_statics.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <exception>
#include <memory>
#include <optional>
#include <scene/scene_analysis.h>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Statics under growing load that is no linear problem: large displacements, by Newton's method
     * or step by step (IncrementalElasticity); contact and inelastic materials. If a load step
     * fails, the last one that converged is what is written.
     */
    class NonlinearAnalysis : public SceneAnalysis
    {
    public:
      using SceneAnalysis::SceneAnalysis;

      void
      solve() override;

      void
      verify() override;

    private:
      using Vector = FiniteElasticity::Vector;

      /// A row of history.csv.
      struct HistoryRow
      {
        double       load_factor       = 0.;
        unsigned int n_iterations      = 0;
        unsigned int n_cuts            = 0;
        unsigned int n_lost_iterations = 0;
        /// Of Newton's method; incremental steps have none.
        std::optional<double> relative_residual;
        /// [J].
        double strain_energy = 0.;
        /// [m].
        double max_displacement = 0.;
        /// Of probes that are points [m].
        std::vector<dealii::Tensor<1, 2>> probe_displacements;
        /// See ContactAnalysis::columns(); energies times the thickness.
        std::vector<double> contact_numbers;
        /// See CrackTips::columns().
        std::vector<double> tip_numbers;
        /// Of inelastic materials: energy dissipated so far [J] and area that has yielded [m^2].
        struct Plastic
        {
          double dissipation = 0., yielded_area = 0.;
        };
        std::optional<Plastic> plastic;
      };

      /// Not for incremental steps; small displacements as well, as `system` sees it.
      std::unique_ptr<FiniteElasticity>      finite;
      std::unique_ptr<ElasticSystem>         system;
      std::unique_ptr<IncrementalElasticity> incremental;
      /// Why there are no equations: a block floats. Not an input error, so it waits
      /// until solve().
      std::exception_ptr failure;
      /// Where the largest displacement is looked for: elements and reference
      /// coordinates.
      std::vector<std::pair<unsigned int, dealii::Point<2>>> output_points;

      std::vector<HistoryRow> history;
      /// Cuts and iterations of a step that was given up at last.
      unsigned int n_last_cuts = 0, n_last_iterations = 0;
      /// Of the last step that converged.
      Vector last_solution;
      /// Of inelastic materials, of all steps [J].
      double plastic_dissipation = 0.;

      void
      make_system() override;

      bool
      has_large_displacements() const;

      /// Null: all materials are elastic.
      const InelasticTerms *
      inelastic_terms() const;

      /// Without contact, large or small displacements.
      void
      run_newton();

      void
      run_contact();

      /// @throws NumericalFailure: @p error and which block gives way, if one does.
      void
      explain(const NumericalFailure &error, const ContactStatics &statics);

      /// @throws NumericalFailure, if contact alone has to hold blocks and one of them touches
      /// nothing: @p reason and the block.
      void
      check_that_all_touch(const std::string &reason);

      void
      run_incremental();

      /// Note a load step that converged, and say so.
      void
      add_step(HistoryRow row, const Vector &solution);

      /// Make field, recovery and evaluator those of the last step that converged.
      void
      show();

      double
      last_value() const override;

      std::string
      unsolved_note() const override;

      /// history.csv as far as it goes.
      void
      write_history() const;

      void
      write_history(std::ostream &out) const;
    };
  } // namespace internal
} // namespace NMM

#endif
