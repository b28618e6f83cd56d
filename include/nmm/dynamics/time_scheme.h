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
   * h being the step. Coefficients without a unit.
   */
  struct TimeScheme
  {
    std::string name = "newmark";
    double      beta = 0.25, gamma = 0.5, alpha_m = 0., alpha_f = 0.;
    /// Forces between both states (MechanicalModel::assemble_between())
    /// instead of r at u_{1 - alpha_f}.
    bool is_conserving = false;

    /// Newmark; beta = 1/4, gamma = 1/2, the trapezoidal rule, is
    /// of order 2, unconditionally stable and without damping for linear problems.
    static TimeScheme
    newmark(double beta = 0.25, double gamma = 0.5);

    /**
     * Chung & Hulbert (J. Appl. Mech. 60 (1993) 371), eqs. (17), (20), (25): order
     * 2, damping only what the step does not resolve; @p spectral_radius in
     * [0, 1] is the factor per step that is left of infinite frequencies.
     */
    static TimeScheme
    generalized_alpha(double spectral_radius);

    /**
     * The scheme of DDA and the numerical manifold method (Shi): in each
     * step the acceleration is the constant @f$ a_1 = 2 (u_1 - u_0 - h v_0)/h^2 @f$,
     * of the forces at its end: beta = 1/2, gamma = 1. Order 1; it damps, and
     * turning bodies lose energy.
     */
    static TimeScheme
    constant_acceleration();

    /**
     * Midpoint rule with forces that conserve (Simo & Tarnow 1992, Gonzalez 2000):
     * linear and angular momentum, and without loads energy, are those of the
     * start to rounding and to the tolerance of the iteration, whatever the step.
     * Order 2. a_1 is the mean acceleration of the step. Displacement conditions
     * are evaluated at the mean displacement, which conserves energy
     * up to the order of the scheme for nonlinear models.
     */
    static TimeScheme
    energy_momentum();

    /// @throws InputError naming the coefficient.
    void
    check() const;
  };


  /// C = mass M + stiffness K(u = 0), see MechanicalModel::stiffness_at_rest(). K(u = 0)
  /// does not turn with a body; in conserving steps of `finite` kinematics the
  /// damping does, see MechanicalModel::set_stiffness_damping().
  struct RayleighDamping
  {
    /// [1/s]
    double mass = 0.;
    /// [s]
    double stiffness = 0.;
  };
} // namespace NMM

#endif
