#ifndef nmm_source_scene_nonlinear_analysis_h
#define nmm_source_scene_nonlinear_analysis_h

#include <nmm/analysis/equilibrium.h>

#include <exception>
#include <memory>
#include <optional>
#include <scene/bolts.h>
#include <scene/joint_water.h>
#include <scene/scene_analysis.h>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Nonlinear statics under growing load, by Newton's method: large displacements, contact, and
     * inelastic materials, and stages of all statics. The load factor grows from 0 to 1 with the loads,
     * and by 1 in each stage after that. If a load step fails, the results of the last step that
     * converged are written.
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
      using Vector = Equilibrium::Vector;

      /// A row of history.csv.
      struct HistoryRow
      {
        double       load_factor       = 0.;
        unsigned int n_iterations      = 0;
        unsigned int n_cuts            = 0;
        unsigned int n_lost_iterations = 0;
        /// Relative residual of Newton's method [-].
        double relative_residual = 0.;
        /// Strain energy [J].
        double strain_energy = 0.;
        /// Largest displacement [m].
        double max_displacement = 0.;
        /// Displacements of the probes that are points [m].
        std::vector<dealii::Tensor<1, 2>> probe_displacements;
        /// Values of ContactAnalysis::columns(), with energies times the thickness.
        std::vector<double> contact_numbers;
        /// Values of CrackTips::columns().
        std::vector<double> tip_numbers;
        /// Of inelastic materials, the energy dissipated so far [J] and the area that has yielded
        /// [m^2].
        struct Plastic
        {
          double dissipation = 0., yielded_area = 0.;
        };
        std::optional<Plastic> plastic;
      };

      /// Null without bolts.
      std::unique_ptr<SceneBolts> bolts;
      /// Null unless water flows in joints.
      std::unique_ptr<SceneJointWater> joint_water;
      /// Null if a block floats.
      std::unique_ptr<Equilibrium> equilibrium;
      /// The failure to set up equations, since a block floats. It is not an input error, so
      /// solve() throws it.
      std::exception_ptr failure;
      /// Points among which the largest displacement is taken: elements and reference
      /// coordinates [-].
      std::vector<std::pair<unsigned int, dealii::Point<2>>> output_points;

      std::vector<StageChange> stages;
      /// Blocks that stages have removed so far.
      std::vector<unsigned int> removed_blocks;

      std::vector<HistoryRow> history;
      /// Cuts and iterations of the last step, if it failed.
      unsigned int n_last_cuts = 0, n_last_iterations = 0;
      /// Displacements of the last step that converged [m].
      Vector last_solution;

      void
      make_system() override;

      ElasticityProblem
      problem_now() const override;

      bool
      has_large_displacements() const;

      /// The terms of inelastic materials; null if all materials are elastic.
      const InelasticTerms *
      inelastic_terms() const;

      /// Takes the steps of the first equilibrium and of all stages.
      void
      run_stages();

      /// "load factor 1.5", with the name of the stage.
      std::string
      describe_step(double load_factor) const;

      /// Whether a stage has removed the element.
      bool
      is_removed(unsigned int element) const override;

      /// Writes fields and picture of the present state into the series.
      void
      write_state(const HistoryRow &row, unsigned int number);

      /// The largest displacement of what has not been removed [m].
      double
      find_max_displacement() const;

      /// Stores and reports a load step that converged.
      void
      add_step(const ContactStep &step, const Vector &solution);

      /// Makes field, recovery and evaluator of the last step that converged.
      void
      show();

      /// Load factor of the last state; 0 if there is none [-].
      double
      reached_load_factor() const;

      /// That load factor or, if loads are also taken away, the number of steps.
      double
      last_value() const override;

      std::string
      unsolved_note() const override;

      /// Writes history.csv with the steps so far.
      void
      write_history() const;

      void
      write_history(std::ostream &out) const;
    };
  } // namespace internal
} // namespace NMM

#endif
