#ifndef nmm_dynamics_step_control_h
#define nmm_dynamics_step_control_h

#include <nmm/dynamics/time_integrator.h>

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
  struct StepRecord
  {
    /// Report on the accepted step.
    StepReport report;
    /// @{
    /// Steps that were tried and given up since the last accepted one, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
    /// @}
  };


  /**
   * Chooses the lengths of time steps. A step that fails, or whose displacement or error is larger
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
     * @throws NumericalFailure if a step would be smaller than allowed, with time,
     * step and reason; the integrator is then in the last accepted state.
     */
    bool
    advance(TimeIntegrator &integrator, double end, StepRecord &record) const;

    /// Advance to the time @p end [s]. @p after_step, if given, is called after each step and
    /// stops the run by returning false.
    void
    run(TimeIntegrator                                &integrator,
        double                                         end,
        const std::function<bool(const StepRecord &)> &after_step = {}) const;

  private:
    double
    next_target(const TimeIntegrator &integrator, double end) const;

    StepControlParameters parameters;
  };


  /// Steps, tolerance and bounds of a dynamic relaxation; see relax().
  struct RelaxationParameters
  {
    /// First step [s]. The longest natural period of the solid is a good choice.
    double step = std::numeric_limits<double>::signaling_NaN();
    /// Largest Account::imbalance that counts as rest [-].
    double tolerance = 1e-8;
    /// Number of steps after which the relaxation is given up.
    unsigned int max_steps = 1000;
    /// Factor by which steps grow after each accepted step [-].
    double growth = 1.2;
    /// Steps may grow as long as Newton's method needs at most this many iterations, and shrink
    /// if it needs more than twice as many; see StepControlParameters.
    unsigned int few_iterations = 12;
    /// The relaxation ends once an unknown has changed by more than this since its beginning [m];
    /// 0: no bound.
    double max_displacement = 0.;
    /// Largest displacement of a cover in a step [m]; 0: a hundredth of max_displacement, or no
    /// bound if that is 0 as well. Longer steps may jump over states in which blocks fail, to an
    /// equilibrium that the true motion does not reach.
    double max_step_displacement = 0.;
  };


  /// Result of relax().
  struct RelaxationReport
  {
    /// @{
    /// Accepted steps, iterations of all steps (also of those given up), and times at which the
    /// motion was stopped.
    unsigned int n_steps = 0, n_iterations = 0, n_stops = 0;
    /// @}
    /// Account::imbalance at the end [-].
    double imbalance = 0.;
    /// Whether the relaxation ended because of RelaxationParameters::max_displacement, and not at
    /// rest.
    bool moves_away = false;
  };


  /**
   * Dynamic relaxation to static equilibrium: the motion is stopped whenever the
   * kinetic energy has passed a peak (kinetic damping, Cundall 1976), and
   * steps grow. Loads must not depend on time, because time goes on. @p after_step, if given, is
   * called after each step, before the motion is stopped.
   * @throws NumericalFailure if rest is not reached within the steps allowed, or steps become
   * shorter than a millionth of the first one.
   */
  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step = {});
} // namespace NMM

#endif
