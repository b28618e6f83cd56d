#ifndef nmm_source_scene_safety_factor_analysis_h
#define nmm_source_scene_safety_factor_analysis_h

#include <nmm/dynamics/strength_reduction.h>
#include <nmm/mechanics/solid_term.h>

#include <memory>
#include <scene/scene_analysis.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Finds the factor by which the strength of all contacts and materials can be divided before
     * blocks move. Trials of relaxation, each from the same state, bracket the factor, which is
     * then bisected. The results show how the solid fails: the displacements of the
     * trial with the smallest factor at which blocks move. If they move at none, the trial with the
     * largest factor is shown. If a trial fails, which ends the search, its last accepted state is
     * shown.
     *
     * safety_factor.csv has a row per trial and is complete after each of them.
     */
    class SafetyFactorAnalysis : public SceneAnalysis
    {
    public:
      using SceneAnalysis::SceneAnalysis;

      void
      solve() override;

      void
      verify() override;

    private:
      using Vector = MechanicalModel::Vector;

      // Each object refers to those above it.
      std::unique_ptr<QuadratureCollection> mass_quadrature;
      std::unique_ptr<FiniteElasticity>     elasticity;
      std::unique_ptr<SolidTerm>            model;

      /// The state from which each trial starts, unless it starts without displacements.
      Vector            settled;
      ContactHistory    settled_contact;
      std::vector<char> settled_materials;
      unsigned int      n_start_steps = 0;

      /// The stage of the search, while it runs.
      Progress::Stage *stage = nullptr;

      SafetyFactor result;
      /// The trials so far.
      std::vector<StrengthTrial> trials;
      /// The trial whose results are shown, and its final state.
      StrengthTrial          shown;
      Vector                 shown_displacement;
      ContactAnalysis::State shown_contact;
      std::vector<char>      shown_materials;

      void
      make_system() override;

      /// Finds the equilibrium under full strength.
      void
      settle();

      StrengthTrial
      try_factor(double factor);

      /// Shows the last step of a trial as a sign of life.
      void
      show_progress(double                factor,
                    const TimeIntegrator &integrator,
                    const StepRecord     &step);

      /// Whether this trial is to be shown instead of the present one.
      bool
      tells_more(const StrengthTrial &trial) const;

      /// Reports that no bracket was found, or that a trial failed. @throws NumericalFailure.
      void
      give_up();

      /// Part of a message: the bounds of the factor from the trials that did not fail.
      std::string
      what_is_known() const;

      void
      write_trials() const;

      /// Which blocks have moved from the start of a trial to @p end, as a part of a sentence.
      std::string
      describe_motion(const Vector &end) const;

      /// Makes field, recovery and evaluator of the trial that is shown.
      void
      show();

      /// The same, and its contact.
      void
      show_best_trial();

      double
      last_value() const override;

      std::string
      unsolved_note() const override;
    };
  } // namespace internal
} // namespace NMM

#endif
