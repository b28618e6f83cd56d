#ifndef nmm_dynamics_relaxation_h
#define nmm_dynamics_relaxation_h

#include <nmm/contact/assembly/term.h>
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
    /// First step of a relaxation that continues an earlier one [s]; 0: `step`.
    double continued_step = 0.;
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


  /// What is best for contact in a relaxation with @p scheme: every_step, unless its forces are
  /// conserving.
  ContactUpdate
  update_in_relaxation(const TimeScheme &scheme);


  /// Result of relax().
  struct RelaxationReport
  {
    /// @{
    /// Accepted steps, and iterations of all steps (also of those given up).
    unsigned int n_steps = 0, n_iterations = 0;
    /// @}
    /// Account::imbalance at the end [-].
    double imbalance = 0.;
    /// Whether the relaxation ended because of RelaxationParameters::max_displacement, and not at
    /// rest.
    bool moves_away = false;
  };


  /**
   * Dynamic relaxation to static equilibrium: steps grow, and the motion is stopped whenever its
   * kinetic energy has passed a peak (kinetic damping, Cundall 1976) or it turns back: if
   * @f$ (v_n, M v_{n+1}) < -\tfrac12 |v_n|_M\,|v_{n+1}|_M @f$. The second rule is for loose blocks that
   * rattle between their neighbours: TimeScheme::constant_acceleration() lets them bounce back with the
   * same speed in each step, so that their energy has no peak. A slope of 329 blocks had no rest after
   * 100 steps without it. A step from rest of the length h solves
   * @f[ \frac{2}{h^2} M\,(u_1 - u_0) + r(u_1) = 0, @f]
   * to a thirtieth of the forces out of balance at its beginning.
   * Loads must not depend on time, because time goes on; where prescribed displacements
   * grow at first, the caller lets the relaxation go on until they have grown. @p after_step, if given, is called after each
   * step, before the motion is stopped. @p before_step, if given, is called before
   * each step with its length [s]: a relaxation from the state of @p integrator at that time, with
   * this length as RelaxationParameters::continued_step, takes the same steps.
   * @throws NumericalFailure if rest is not reached within the steps allowed, or as
   * StepSequence::advance() if steps become shorter than a millionth of the first one.
   */
  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step  = {},
        const std::function<void(double length)>      &before_step = {});
} // namespace NMM

#endif
