#ifndef nmm_source_scene_safety_factor_analysis_h
#define nmm_source_scene_safety_factor_analysis_h

#include <nmm/analysis/strength_reduction.h>

#include <memory>
#include <scene/cut_notice.h>
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

      std::unique_ptr<StrengthReduction> reduction;
      unsigned int                       n_start_steps = 0;
      /// Blocks that stages have removed.
      std::vector<unsigned int> removed_blocks;

      CutNotice cut_notice{progress};

      /// The stage of the search, while it runs.
      Progress::Stage *stage = nullptr;

      SafetyFactor result;
      void
      make_system() override;

      /// Finds the equilibrium under full strength.
      void
      settle();

      /// Completes, writes and reports a trial.
      void
      add_trial(StrengthTrial &trial);

      /// Shows the last step of a trial as a sign of life.
      void
      show_progress(double factor, const StepRecord &step);

      /// Reports that no bracket was found, or that a trial failed. @throws NumericalFailure.
      void
      give_up();

      /// Part of a message: the bounds of the factor from the trials that did not fail.
      std::string
      what_is_known() const;

      void
      write_trials(const std::vector<StrengthTrial> &trials) const;

      /// Which blocks have moved from the start of a trial to @p end, as a part of a sentence.
      std::string
      describe_motion(const Vector &end) const;

      /// Makes field, recovery and evaluator of the trial that is shown.
      void
      show();

      double
      last_value() const override;

      std::string
      unsolved_note() const override;
    };
  } // namespace internal
} // namespace NMM

#endif
