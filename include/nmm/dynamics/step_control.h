#ifndef nmm_dynamics_step_control_h
#define nmm_dynamics_step_control_h

#include <nmm/dynamics/time_integrator.h>
#include <nmm/solution/step_sequence.h>

#include <functional>
#include <limits>

namespace NMM
{
  /// Bounds on time steps and on their results; see StepControl.
  struct StepControlParameters
  {
    /// First step [s]. All steps have this length unless one fails or exceeds a bound below, or
    /// max_step allows longer ones.
    double initial_step = std::numeric_limits<double>::signaling_NaN();
    /// Smallest step [s]; 0: a millionth of the first. Steps that end at an event or at the end
    /// of the run may be smaller.
    double min_step = 0.;
    /// Largest step [s]; 0: the first step.
    double max_step = 0.;
    /// Largest displacement of a cover in a step, as in the paper [m]; 0: no bound.
    double max_displacement = 0.;
    /// Largest StepReport::error [m]; 0: no bound.
    double max_error = 0.;
    /// Steps may grow as long as Newton's method needs at most this many iterations
    /// (StepReport::n_full_iterations), and shrink if it needs more than twice as many. Contact
    /// takes some eight iterations however short the step is.
    unsigned int few_iterations = 12;

    /// @throws InputError naming the parameter and its value.
    void
    check() const;
  };


  /// Effort of one accepted step.
  struct StepRecord : LostSteps
  {
    /// Report on the accepted step.
    StepReport report;
  };


  /**
   * Steps through time (StepSequence). A step that fails, or whose displacement or error is larger
   * than allowed, is reduced and tried again from the last accepted state. Steps grow by a factor
   * of at most 1.5 while Newton's method needs few iterations and results are well within their
   * bounds. Steps end at events of the model and at the end of the run.
   */
  class StepControl
  {
  public:
    /// @throws InputError as StepControlParameters::check().
    explicit StepControl(const StepControlParameters &parameters);

    /**
     * Take one accepted step towards the time @p end [s], and describe it in @p record. Returns
     * false without a step if the end is reached already.
     * @throws NumericalFailure as StepSequence::advance(); the integrator is then in the last
     * accepted state.
     */
    bool
    advance(TimeIntegrator &integrator, double end, StepRecord &record) const;

    /// Advance to the time @p end [s]. @p after_step, if given, is called after each step and
    /// stops the run by returning false.
    void
    run(TimeIntegrator                                &integrator,
        double                                         end,
        const std::function<bool(const StepRecord &)> &after_step = {}) const;

    /// Factor by which steps may change after one with @p n_iterations (see
    /// StepReport::n_full_iterations): @p largest up to few_iterations, then 1. It is 0.7 beyond
    /// twice as many, because shorter steps cost less then.
    static double
    growth_after(double       n_iterations,
                 unsigned int few_iterations,
                 double       largest);

  private:
    double
    next_target(const TimeIntegrator &integrator, double end) const;

    StepVerdict
    try_step(TimeIntegrator &integrator, double h, StepReport &report) const;

    StepControlParameters parameters;
  };
} // namespace NMM

#endif
