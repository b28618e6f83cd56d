#ifndef nmm_source_scene_dynamic_analysis_h
#define nmm_source_scene_dynamic_analysis_h

#include <nmm/analysis/motion.h>
#include <nmm/dynamics/leaving_blocks.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/output/csv_series.h>

#include <memory>
#include <optional>
#include <scene/bolts.h>
#include <scene/cut_notice.h>
#include <scene/growth_in_motion.h>
#include <scene/joint_water.h>
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
     * Motion in time, or relaxation to rest, with small or finite
     * kinematics. Histories, series and checkpoints are written during the run. If
     * it fails, the last accepted state is written at the end.
     */
    class DynamicAnalysis : public SceneAnalysis
    {
    public:
      /// @p restart is the file of the checkpoint from which to continue; empty for none.
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

      /// What a checkpoint holds beside the state of the motion.
      struct SavedPart
      {
        /// Length of the next step if the state is one of the relaxation from which the motion
        /// starts [s], else 0.
        double next_step_of_start = 0.;
        /// Largest energy imbalance and largest energy of all steps so far [J/m].
        double largest_balance = 0., largest_energy = 0.;
        /// Whether cracks may grow.
        bool        has_growth = false;
        SavedGrowth growth;

        template <typename Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          archive &next_step_of_start &largest_balance &largest_energy
                  &has_growth;
          archive &growth;
        }
      };

      Analysis kind;

      /// Null without bolts.
      std::unique_ptr<SceneBolts> bolts;
      /// Null unless water flows in joints.
      std::unique_ptr<SceneJointWater> joint_water;
      std::unique_ptr<Motion>          motion;
      /// The damping, with the coefficients that Scene::make_damping() chooses.
      RayleighDamping damping;
      /// Null if no block may leave the scene.
      std::unique_ptr<LeavingBlocks> leaving;

      /// Null if cracks do not grow.
      std::unique_ptr<GrowthInMotion> growth;
      /// What the checkpoint holds from which this run continues, if it does.
      std::optional<SavedPart> earlier_part;

      /// Velocity of the state that is shown [m/s].
      std::unique_ptr<DisplacementField> velocity_field;

      /// Tables that are written during the run, on rank 0.
      std::unique_ptr<CsvSeries>    history;
      std::unique_ptr<ProbeHistory> probe_history;
      std::unique_ptr<CsvSeries>    departures;

      /// The last accepted state, which is restored if a step fails.
      DynamicState last_good;
      /// Whether a run can continue from the present state. It cannot while the end of a step is
      /// being checked, nor after a cut that failed.
      bool             can_be_saved = true;
      RelaxationReport relaxation;
      StartReport      start;
      /// The relaxation from which the motion starts; null if there is none, and afterwards.
      std::unique_ptr<StartRelaxation> relaxing;
      /// Numbers of this run, without those of the run that wrote the checkpoint.
      unsigned int n_steps = 0, n_iterations = 0, n_lost_iterations = 0,
                   n_cuts = 0;
      /// Time at which this run starts [s].
      double start_time = 0.;
      /// Largest energy imbalance and largest energy of all steps, also of those before the
      /// checkpoint [J/m].
      double           largest_balance = 0., largest_energy = 0.;
      Progress::Stage *stage = nullptr;
      CutNotice        cut_notice{progress};
      /// See warn_of_turns().
      bool has_warned_of_turns = false;

      void
      make_system() override;

      void
      clear() override;

      /// Destroys the equations of motion; the solid and its contact remain.
      void
      clear_equations();

      void
      make_integrator();

      /// Lets the integrator start from the scene's initial state, or from a checkpoint.
      void
      set_first_state();

      std::vector<Increment>
      earlier_increments() override;

      /// Makes the intensity factors those of the state from which this run continues.
      void
      continue_growth();

      /// The SavedPart of this run as bytes.
      std::vector<char>
      part_to_save(double next_step_of_start = 0.) const;

      /// Whether the run continues within the relaxation from which the motion starts.
      bool
      continues_in_start() const;

      /// The objects that the start needs.
      StartInput
      start_input();

      /// Makes `relaxing`.
      void
      make_relaxation();

      /// Whether a checkpoint is to be written after the step with this number.
      bool
      is_checkpoint_due(unsigned int step) const;

      /// Lets cracks grow whose tips have reached the toughness in the present state. Returns
      /// whether there were any.
      bool
      grow();

      /// The solid before it was cut again, and its state.
      struct FormerState
      {
        FormerSolid    solid;
        DynamicState   state;
        ContactHistory history;
        /// Kinetic and stored energy [J/m].
        double energy = 0.;
        /// See AccountedContact::friction_work() [J/m].
        double friction_work = 0.;
      };

      /// Cuts the solid again, with the geometry @p grown, and goes on from the same state. Faces
      /// that are new separate within @p duration [s]. @throws NumericalFailure if that is not
      /// possible; the solid is then as before.
      void
      cut_anew(const Geometry &grown, double duration);

      /// Takes over the state of a solid that has been cut again since.
      void
      carry_over(const FormerState &former, double duration);

      /// The terms of inelastic materials; null if all materials are elastic.
      InelasticTerms *
      inelastic_terms() const;

      /// Whether any contact law has a friction angle.
      bool
      has_friction() const;

      /// Say that nothing damps the vibrations of blocks on faces with friction, if that is so.
      void
      warn_of_flutter() const;

      /// Say once that a step turns a block so far that its angle is not resolved, if it does.
      void
      warn_of_turns(double length);

      /// Makes `leaving` if the scene has limits. @throws InputError for a block that is outside of
      /// them at the start.
      void
      make_leaving();

      /// Removes the blocks that have left the scene, and adds them to the table.
      void
      drop_blocks();

      void
      open_departures(int continue_after);

      /// The problem with its loads at the present time, and with the inertia force of a moving
      /// base as a part of gravity.
      ElasticityProblem
      problem_now() const override;

      /// Computes the intensity factors of all crack tips in the present state, if the scene asks
      /// for them. Collective.
      void
      compute_tips_in_motion();

      /// Cauchy stress in the present state, in axes that turn with the material at each point
      /// [Pa], without viscous stress.
      ElementStress
      stress_in_material_axes() const;

      /// Adds the present state of bolts to their tables.
      void
      write_bolts();

      /// Names of the columns of history.csv after time and step. history_values() are their values
      /// in the state at the end of the step @p record.
      std::vector<std::string>
      history_columns() const;
      std::vector<double>
      history_values(const StepRecord &record) const;

      /// The initial velocity from the scene's list [m/s]. @throws InputError for a block that does
      /// not exist.
      Vector
      initial_velocity() const;

      /// Centroid of a block, or of the whole solid if @p block is deal.II's invalid index [m].
      dealii::Point<2>
      centroid(unsigned int block) const;

      /// Whether the run begins with the search for an equilibrium, or with the rest of it.
      bool
      has_start() const;

      /// Finds the equilibrium, and initializes the integrator with it.
      void
      run_start();

      void
      open_files() override;

      /// Takes the contact state from which the run starts.
      void
      take_contact();

      /// Writes the state from which the run starts.
      void
      write_first_state();

      void
      run_dynamics();

      void
      run_relaxation();

      /// Writes everything that belongs to the state at the end of the step @p record.
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

      /// Ends the run after a signal. @throws Stopped
      void
      stop() const;

      /// Restores the last accepted state after a failure, and writes a checkpoint of it if the
      /// contact history allows that.
      void
      recover();

      double
      time() const;

      unsigned int
      step_number() const;

      const Vector &
      velocity() const;

      /// Displacements with relevant unknowns [m].
      Vector
      displacement() const;

      /// Makes field, recovery and evaluator of the current state.
      void
      show();

      void
      add_energies();

      /// Updates the largest energy and imbalance. @throws NumericalFailure
      /// unless they are finite.
      void
      note_energies();

      double
      relative_balance() const;

      /// Whether the energy balance is so wrong that the results cannot be trusted.
      bool
      balance_is_off() const;

      std::string
      balance_note() const;

      /// @throws NumericalFailure with @p reason, and with the energy balance if that is wrong.
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
