#ifndef nmm_analysis_strength_reduction_h
#define nmm_analysis_strength_reduction_h

#include <nmm/analysis/motion.h>
#include <nmm/dynamics/strength_reduction.h>

#include <functional>
#include <vector>

namespace NMM
{
  /// What loses strength in a StrengthReduction.
  enum class ReducedStrength
  {
    /// Faces in contact and materials that yield.
    both,
    /// Faces in contact.
    joints,
    /// Materials that yield.
    blocks
  };


  /// The plastic flow in a StrengthReduction. With a dilation angle below the friction angle the factor
  /// is not bounded by the theorems of limit analysis, and may depend on mesh and path.
  enum class FlowRule
  {
    /// Flow with the friction angle as dilation angle.
    associated,
    /// Flow with the dilation angle of the material.
    given
  };


  /// Range, accuracy and trials of a StrengthReduction.
  struct StrengthReductionParameters
  {
    /// Range and accuracy of the factor.
    SafetyFactorParameters search;
    /// Steps and bounds of a trial; RelaxationParameters::max_displacement is the displacement above which
    /// blocks do not stand.
    RelaxationParameters trial;
    /// The equations of a trial.
    MotionParameters motion;
    /// What loses strength.
    ReducedStrength reduced = ReducedStrength::both;
    /// The flow of materials that yield, in all trials.
    FlowRule flow_rule = FlowRule::associated;
  };


  /**
   * The factor of safety of a solid by reduction of strength: that by which the strength of faces
   * (reduce_strength()) and of yielding materials can be divided before blocks no longer come to rest.
   * Each trial is a relaxation from the same state, see find_safety_factor().
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class StrengthReduction
  {
  public:
    /// A state of equilibrium under full strength.
    struct Start
    {
      /// Displacements of owned unknowns [m].
      ForceTerm::Vector displacement;
      /// What contact remembers.
      ContactHistory contact;
      /// InelasticTerms::internal_state(); empty if all materials are elastic.
      std::vector<char> materials;
      /// FurtherTerms::save().
      std::vector<char> terms;
      /// Blocks that are gone.
      std::vector<unsigned int> removed_blocks = {};
    };

    /// The end of a trial.
    struct Result
    {
      /// The trial.
      StrengthTrial trial;
      /// Displacements of owned unknowns at its end [m].
      ForceTerm::Vector displacement;
      /// The state of contact at its end.
      ContactModel::State contact;
      /// InelasticTerms::internal_state() at its end.
      std::vector<char> materials;
    };

    /// @p contact is null for a solid whose faces do not touch. @throws as the constructor of Motion.
    StrengthReduction(const Solid                &solid,
                      const ElasticityProblem    &problem,
                      StrengthReductionParameters parameters,
                      ContactModel               *contact = nullptr);

    /// Let all trials start from @p state, instead of an undeformed solid.
    void
    start_from(Start state);

    /// The displacements from which trials start [m], of owned unknowns.
    ForceTerm::Vector
    start() const;

    /// Called after each time step of a trial, with the factor.
    std::function<void(double factor, const StepRecord &)> after_step;

    /// Called after each trial; it may complete StrengthTrial::reason.
    std::function<void(StrengthTrial &)> after_trial;

    /// Find the factor of safety. What `after_step` throws ends the search.
    /// @throws InputError as SafetyFactorParameters::check().
    SafetyFactor
    find();

    /// All trials so far, also of a search that was ended, and the bracket that they give.
    SafetyFactor
    so_far() const;

    /// The end of the trial that tells most: one that failed, else the smallest factor at which blocks
    /// move, if there is one at the time, after which the largest at which they stand replaces it.
    const Result &
    shown() const
    {
      return best;
    }

    /// Let materials and contact be those of shown().
    void
    show();

    /// The equations of the trials.
    Motion &
    motion()
    {
      return equations;
    }

  private:
    StrengthTrial
    try_factor(double factor);

    /// Whether a trial is to be shown instead of the present one.
    bool
    tells_more(const StrengthTrial &trial) const;

    void
    set_strength(double factor);

    const ElasticityProblem    *problem;
    StrengthReductionParameters parameters;
    ContactModel               *contact;
    Motion                      equations;
    Start                       begin;
    bool                        has_start = false;
    std::vector<StrengthTrial>  trials;
    Result                      best;
  };
} // namespace NMM

#endif
