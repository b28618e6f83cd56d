#ifndef nmm_dynamics_relaxation_h
#define nmm_dynamics_relaxation_h

#include <nmm/dynamics/step_control.h>

#include <functional>
#include <limits>

namespace NMM
{
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
   * steps grow. Loads must not depend on time, because time goes on; where prescribed displacements
   * grow at first, the caller lets the relaxation go on until they have grown. @p after_step, if
   * given, is called after each step, before the motion is stopped.
   * @throws NumericalFailure if rest is not reached within the steps allowed, or as
   * StepSequence::advance() if steps become shorter than a millionth of the first one.
   */
  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step = {});
} // namespace NMM

#endif
