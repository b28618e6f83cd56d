#ifndef nmm_solution_step_sequence_h
#define nmm_solution_step_sequence_h

#include <nmm/base/step_fault.h>

#include <functional>
#include <limits>
#include <string>

namespace NMM
{
  /// Effort that brought no accepted step.
  struct LostSteps
  {
    /// @{
    /// Steps that were tried and given up since the last accepted one, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
    /// @}
    /// Why the last one of them was given up.
    StepFault last_fault = {};
  };


  /// A step that is to be tried, in the unit of what the steps go through.
  struct StepTrial
  {
    /// Length of the step, at least 0 in both directions.
    double length = 0.;
    /// Where the step ends; bitwise the target, if reaches_target.
    double end = 0.;
    /// Whether the step ends at the target of StepSequence::advance().
    bool reaches_target = false;
  };


  /// Result of a step that was tried.
  struct StepVerdict
  {
    /// The verdict on a step whose result must not be kept.
    static StepVerdict
    rejected(const StepFault &fault, unsigned int n_iterations = 0);

    /// The verdict on a step whose result is kept. @p ratio: see the member.
    static StepVerdict
    accepted(double ratio = 2.);

    /// Why the step is rejected, if it is; then StepFault::reason is not empty.
    StepFault fault;
    /// Iterations that were lost, if the step is rejected.
    unsigned int n_iterations = 0;
    /// Length that the next step may have, divided by the length of this one, if it is
    /// accepted [-].
    double ratio = 2.;

    /// Whether the next step starts at the end of this one.
    bool
    is_accepted() const
    {
      return fault.reason.empty();
    }
  };


  /**
   * The one loop that steps: through load factors, through time, and through the pseudo-time of a
   * relaxation. Who solves a step, and which results are good enough, is the caller's business.
   *
   * A step that is rejected is tried again from the same place with StepFault::retry times its
   * length: at most 0.9 times, and at most half from the sixth cut on or if there is no proposal.
   * Steps are given up only once the smallest length has been tried.
   * After an accepted step the next one may be StepVerdict::ratio times as long.
   *
   * Steps meet their targets. A step that would go beyond is shortened, and where less than one
   * and a half steps are left, the way is taken in two equal ones. A step that was shortened for
   * its target does not limit the next one, unless its ratio is below 1.
   */
  class StepSequence
  {
  public:
    /// What steps go through, and which lengths are allowed.
    struct Range
    {
      /// @{
      /// Name and unit for messages, for example "time" and "s".
      std::string quantity, unit;
      /// @}
      /// Smallest length. Steps that a target shortens may be smaller as long as none fails.
      double least = 0.;
      /// Largest length.
      double largest = std::numeric_limits<double>::infinity();
    };

    /// Steps begin at @p position; the first one is tried with @p length.
    StepSequence(const Range &range, double position, double length);

    /**
     * Take one accepted step towards @p target, which may be infinitely far away, or be position()
     * itself: then the step has no length. @p attempt solves a step, and keeps its result if it
     * accepts it. @p lost begins at zero, and is up to date at each attempt.
     * @throws NumericalFailure if the smallest step is rejected, with the place and the reason.
     */
    void
    advance(double                                               target,
            const std::function<StepVerdict(const StepTrial &)> &attempt,
            LostSteps                                           &lost);

    /// Where the last accepted step ended.
    double
    position() const
    {
      return reached;
    }

    /// Length of the next trial.
    double
    length() const
    {
      return next_length;
    }

  private:
    StepTrial
    next_trial(double target) const;

    Range  range;
    double reached, next_length;
  };
} // namespace NMM

#endif
