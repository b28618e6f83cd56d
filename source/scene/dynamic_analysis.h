#ifndef nmm_source_scene_dynamic_analysis_h
#define nmm_source_scene_dynamic_analysis_h

#include <nmm/dynamics/elastic_models.h>
#include <nmm/dynamics/incremental_dynamics.h>
#include <nmm/dynamics/leaving_blocks.h>
#include <nmm/dynamics/step_control.h>
#include <nmm/output/csv_series.h>

#include <memory>
#include <scene/probe_history.h>
#include <scene/scene_analysis.h>
#include <scene/static_start.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Motion in time, or relaxation to rest, of small, finite or incremental
     * kinematics. Histories, series and checkpoints are written as the run goes; if
     * it fails, the last good state is what is written.
     */
    class DynamicAnalysis : public SceneAnalysis
    {
    public:
      /// @p restart: checkpoint to continue from; empty: none.
      DynamicAnalysis(const Scene       &scene,
                      Progress          &progress,
                      MPI_Comm           communicator,
                      const std::string &restart);

      void
      solve() override;

      void
      verify() override;

    private:
      using Vector = MechanicalModel::Vector;

      std::string restart;
      Analysis    kind;

      // Each object refers to those above it.
      std::unique_ptr<QuadratureCollection> mass_quadrature;
      /// Small and finite kinematics.
      std::unique_ptr<FiniteElasticity>      elasticity;
      std::unique_ptr<ElasticModel>          model;
      std::unique_ptr<AccountedContactModel> contact_model;
      std::unique_ptr<TimeIntegrator>        integrator;
      /// As given, or chosen.
      RayleighDamping damping;
      /// Null if no block may leave.
      std::unique_ptr<LeavingBlocks> leaving;
      /// Incremental kinematics.
      std::unique_ptr<IncrementalElasticity> incremental;
      std::unique_ptr<IncrementalDynamics>   incremental_dynamics;
      double                                 incremental_time = 0.;
      unsigned int                           incremental_step = 0;

      /// Of the state that is shown [m/s].
      std::unique_ptr<DisplacementField> velocity_field;

      /// On the first rank.
      std::unique_ptr<CsvSeries>    history;
      std::unique_ptr<ProbeHistory> probe_history;
      std::unique_ptr<CsvSeries>    departures;

      /// To go back to if a step fails half-way.
      DynamicState last_good;
      /// Between a step and the decision that its end is good.
      bool             is_checking_state = false;
      RelaxationReport relaxation;
      StartReport      start;
      /// Of this run, without what a checkpoint was reached by.
      unsigned int n_steps = 0, n_iterations = 0, n_lost_iterations = 0,
                   n_cuts = 0;
      /// Where this run starts [s].
      double start_time = 0.;
      /// Largest of all steps [J/m].
      double           largest_balance = 0., largest_energy = 0.;
      Progress::Stage *stage = nullptr;

      void
      make_system() override;

      void
      make_integrator();

      /// Null: all materials are elastic.
      InelasticTerms *
      inelastic_terms() const;

      /// Does any law of contact have a friction angle?
      bool
      has_friction() const;

      void
      make_incremental();

      /// @throws InputError for a block that is out of the scene at the begin.
      void
      make_leaving();

      /// Drop blocks that have left the scene, and write who they are.
      void
      drop_blocks();

      void
      open_departures(int continue_after);

      /// Columns of history.csv after time and step, and their values in the state
      /// reached by @p record.
      std::vector<std::string>
      history_columns() const;
      std::vector<double>
      history_values(const StepRecord &record) const;

      /// From the scene's list. @throws InputError for a block that does not
      /// exist.
      Vector
      initial_velocity() const;

      /// Of a block, or of the whole solid for dealii's invalid index [m].
      dealii::Point<2>
      centroid(unsigned int block) const;

      /// Does the run begin by looking for equilibrium?
      bool
      has_start() const;

      /// Look for it, and go on from there.
      void
      run_start();

      void
      open_files() override;

      /// The contact is that of the state the run starts from.
      void
      take_contact();

      /// What is written of the state the run starts from.
      void
      write_first_state();

      void
      run_dynamics();

      void
      run_relaxation();

      void
      run_incremental();

      /// Write what belongs to the state reached by @p record.
      void
      after_step(const StepRecord &record);

      void
      write_rows(const StepRecord &record);

      void
      write_state_of_series();

      void
      write_checkpoint();

      void
      show_progress();

      /// Back to the last good state after a failure, and keep it.
      void
      recover();

      double
      time() const;

      unsigned int
      step_number() const;

      const Vector &
      velocity() const;

      /// Displacements with relevant unknowns.
      Vector
      displacement() const;

      /// Make field, recovery and evaluator those of the current state.
      void
      show();

      void
      add_energies();

      /// Keep the largest energies and their balance. @throws NumericalFailure
      /// unless they are finite.
      void
      note_energies();

      double
      relative_balance() const;

      /// Is more energy unaccounted for than results can be trusted with?
      bool
      balance_is_off() const;

      std::string
      balance_note() const;

      /// @throws NumericalFailure with @p reason and what the balance says, if that
      /// is off.
      void
      explain_balance(const std::string &reason) const;

      double
      last_value() const override;

      std::string
      unsolved_note() const override;
    };
  } // namespace internal
} // namespace NMM

#endif
