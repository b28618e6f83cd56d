#ifndef nmm_dynamics_step_control_h
#define nmm_dynamics_step_control_h

#include <nmm/dynamics/time_integrator.h>

#include <functional>
#include <limits>

namespace NMM
{
  struct StepControlParameters
  {
    /// First step, and the only one if nothing below asks for others [s].
    double initial_step = std::numeric_limits<double>::signaling_NaN();
    /// No step is smaller, except the last one before an event or the end [s]; 0:
    /// a millionth of the first.
    double min_step = 0.;
    /// [s]; 0: the first step.
    double max_step = 0.;
    /// Largest displacement of a cover in a step, as in the paper [m]; 0: any.
    double max_displacement = 0.;
    /// Largest StepReport::error [m]; 0: any.
    double max_error = 0.;
    /// Steps may grow while Newton's method takes fewer iterations, each counted by the
    /// share of the unknowns that it was about: contact takes some eight however short
    /// the step.
    unsigned int few_iterations = 12;

    /// @throws InputError naming the parameter and its value.
    void
    check() const;
  };


  /// What was done between two accepted states.
  struct StepRecord
  {
    StepReport report;
    /// Steps tried and given up before, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
  };


  /**
   * Chooses steps: a step that fails, moves more or errs more than allowed is cut
   * and tried again from the last good state; steps grow, by 1.5 at
   * most, while Newton's method needs few iterations and bounds are far. Steps end
   * at events and at the end of the run.
   */
  class StepControl
  {
  public:
    explicit StepControl(const StepControlParameters &parameters);

    /**
     * One accepted step towards @p end [s]. False if the end is
     * reached already.
     * @throws NumericalFailure if a step would be smaller than allowed, with time,
     * step and reason; the integrator is then in the last good state.
     */
    bool
    advance(TimeIntegrator &integrator, double end, StepRecord &record) const;

    /// Advance to @p end; @p after_step is called after each step and
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


  struct RelaxationParameters
  {
    /// First step [s]; the lowest period is a good one.
    double step = std::numeric_limits<double>::signaling_NaN();
    /// Account::imbalance that counts as rest.
    double       tolerance = 1e-8;
    unsigned int max_steps = 1000;
    /// Factor by which steps grow after each success.
    double growth = 1.2;
    /// Steps may grow while Newton's method takes fewer iterations, and shrink beyond
    /// twice as many; see StepControlParameters.
    unsigned int few_iterations = 12;
    /// End as soon as a cover has moved further than this since the begin [m]; 0:
    /// any way is allowed.
    double max_displacement = 0.;
    /// No step moves a cover further [m]; 0: a hundredth of max_displacement, or any way
    /// if that is not bound. Long steps pass by what would give way on the
    /// way, and come to rest where nothing stands.
    double max_step_displacement = 0.;
  };


  struct RelaxationReport
  {
    unsigned int n_steps = 0, n_iterations = 0, n_stops = 0;
    double       imbalance = 0.;
    /// Ended because something has moved too far, not at rest.
    bool moves_away = false;
  };


  /**
   * Dynamic relaxation to the static answer: the motion is stopped whenever the
   * kinetic energy has passed a peak (kinetic damping, Cundall 1976), and
   * steps grow. Loads must not depend on time, which goes on. @p after_step is
   * called after each step, before the motion is stopped.
   * @throws NumericalFailure if rest is not reached.
   */
  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step = {});
} // namespace NMM

#endif
