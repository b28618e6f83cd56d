#ifndef nmm_dynamics_time_scheme_h
#define nmm_dynamics_time_scheme_h

#include <string>

namespace NMM
{
  /**
   * A one-step scheme of Newmark's family,
   * @f[ u_1 = u_0 + h v_0 + h^2\left((\tfrac12-\beta) a_0+\beta a_1\right),\quad
   *     v_1 = v_0 + h\left((1-\gamma) a_0 + \gamma a_1\right), @f]
   * @f[ M a_{1-\alpha_m} + C v_{1-\alpha_f} + r(u_{1-\alpha_f}, t_{1-\alpha_f}) = 0,
   *     \qquad x_{1-\alpha} = (1-\alpha) x_1 + \alpha x_0, @f]
   * h being the step.
   */
  struct TimeScheme
  {
    /// Name of the scheme for messages.
    std::string name = "newmark";
    /// @{
    /// Coefficients of the formulas above [-], in the ranges that check() verifies.
    double beta = 0.25, gamma = 0.5, alpha_m = 0., alpha_f = 0.;
    /// @}
    /// Whether the forces are conserving (see Trial), which depend on both ends of the step, instead
    /// of r at u_{1 - alpha_f}.
    bool is_conserving = false;

    /// Newmark's scheme. With beta = 1/4 and gamma = 1/2, the trapezoidal rule, it is
    /// of order 2, unconditionally stable and without damping for linear problems.
    static TimeScheme
    newmark(double beta = 0.25, double gamma = 0.5);

    /**
     * The generalized-alpha scheme of Chung & Hulbert (J. Appl. Mech. 60 (1993) 371),
     * eqs. (17), (20), (25). It has order 2 and damps mainly those frequencies that the step does
     * not resolve. @p spectral_radius in [0, 1] is the factor by which the amplitude of
     * infinite frequencies is multiplied in each step.
     */
    static TimeScheme
    generalized_alpha(double spectral_radius);

    /**
     * The scheme of DDA and the numerical manifold method (Shi). In each
     * step the acceleration is the constant @f$ a_1 = 2 (u_1 - u_0 - h v_0)/h^2 @f$,
     * which balances the forces at the end of the step: beta = 1/2, gamma = 1. The scheme has
     * order 1 and damps; rotating bodies lose energy.
     */
    static TimeScheme
    constant_acceleration();

    /**
     * The energy-momentum scheme (Simo & Tarnow 1992, Gonzalez 2000): the midpoint rule with
     * conserving forces. Linear and angular momentum and, without loads, energy are
     * conserved up to rounding and the tolerance of the iteration, whatever the step.
     * The order is 2. a_1 is the mean acceleration of the step. Forces of displacement conditions
     * and ties conserve energy as well, see FiniteElasticity::assemble_between().
     */
    static TimeScheme
    energy_momentum();

    /// @throws InputError naming the coefficient.
    void
    check() const;
  };

} // namespace NMM

#endif
