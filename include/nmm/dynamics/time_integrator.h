#ifndef nmm_dynamics_time_integrator_h
#define nmm_dynamics_time_integrator_h

#include <nmm/dynamics/dynamic_state.h>
#include <nmm/dynamics/time_scheme.h>
#include <nmm/mechanics/mechanical_model.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

/**
 * @defgroup dynamics Dynamics
 *
 * Time integration of blocks that deform, touch and move. The forces are terms of the modules
 * before this one: see ForceTerm.
 *
 * **In**: a MechanicalModel, which is the sum of force terms (solid, contact, springs), with a mass
 * matrix. **Out**: displacements, velocities and accelerations
 * after each step (DynamicState), and an account of energies and momenta (Account).
 *
 * | file (in nmm/dynamics) | job |
 * |---|---|
 * | time_scheme.h | coefficients of the time integration schemes |
 * | dynamic_state.h | the state, its energies, and thresholds of sleep |
 * | time_integrator.h | one time step, energy account, sleeping and leaving blocks |
 * | step_control.h | lengths of time steps |
 * | relaxation.h | dynamic relaxation to static equilibrium |
 * | strength_reduction.h | search for the factor of safety |
 * | leaving_blocks.h | finds blocks that have left the scene |
 * | checkpoint.h | saves and restores the state |
 *
 * Order of calls:
 * @code
 * // the rule of the masses is exact for polynomials of degree 2p
 * FiniteSolid solid(elasticity, loading, make_mass_matrix(elasticity, mass_quadrature));
 * ContactTerm touch(solid.layout(), contact);            // only if blocks touch
 * SpringTerm springs(covers, solid.layout(), {spring});  // or a term of one's own, see ForceTerm
 * MechanicalModel model(solid.layout(), {&solid, &touch, &springs});
 * TimeIntegrator integrator(model, TimeScheme::energy_momentum());
 * integrator.initialize(u, v);                           // else undeformed and at rest
 * StepControlParameters parameters;
 * parameters.initial_step = 1e-3;
 * StepControl(parameters).run(integrator, end_time, [&](const StepRecord &) {
 *   print(integrator.account());
 *   return true;                                         // go on
 * });
 * @endcode
 *
 * To add a scheme of the family of TimeScheme, write a function there that sets its coefficients.
 * HHT-alpha, for example, has alpha_m = 0, alpha_f = alpha, beta = (1 + alpha)^2 / 4 and
 * gamma = 1/2 + alpha; forces are those at u_{1 - alpha}, not the mean of both ends. The other places
 * are a test in tests/dynamics/scheme_test.cc and, for scenes, TimeParameters::Scheme
 * (nmm/scene/scene_parameters_dynamics.h); in source/scene/scene_parameters_dynamics.cc its word in
 * `schemes`, its case in TimeParameters::time_scheme() and its own parameters in list_entries() and
 * check_scheme(); the table of schemes in doc/scene-format.md, doc/parameters.md and doc/news. How
 * forces and accelerations of a scheme are combined in a step is in source/dynamics/scheme_step.h
 * (rates) and step_equations.h (residual and matrix): a scheme outside of the family, such as one
 * of several stages, changes these two.
 */

namespace NMM
{
  /// Result of a step that was tried.
  struct StepReport
  {
    /// Whether the step may be accepted.
    bool converged = false;
    /// @{
    /// For a step that failed: why, as part of a message, and what the user can do; see StepFault.
    std::string reason, remedy;
    /// @}
    /// Length of the next trial divided by that of this step; 0: unknown. See StepFault::retry.
    double retry = 0.;
    /// Length of the step [s].
    double step = 0.;
    /// Iterations of Newton's method; 1 if the model is linear.
    unsigned int n_iterations = 0;
    /// Sum over iterations of the part of the unknowns that was corrected [-].
    double n_full_iterations = 0.;
    /// @{
    /// Wall times of factorizations and of substitutions [s]; 0 if the model is linear.
    double factorization_time = 0., substitution_time = 0.;
    /// @}
    /// Largest displacement of a cover in the step [m].
    double max_displacement = 0.;
    /**
     * Estimate of the local error of u: the mass-weighted root mean square of
     * |beta - 1/6| h^2 (a_1 - a_0) (Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991)
     * 871, eq. (11); the factor is 1/12 for conserving schemes) [m].
     */
    double error = 0.;
  };


  /**
   * Advances a MechanicalModel by one step at a time. A step is tried by try_step(), and the
   * state changes only when accept() is called. StepControl does both.
   *
   * Linear models need one factorization for all steps of equal length, and one
   * solve per step. Others are solved by NewtonSolver, starting from
   * @f$ u_0 + h v_0 + h^2 a_0 / 2 @f$, or from @f$ u_0 + h v_0 @f$ in conserving schemes.
   *
   * Lifetime: the model must outlive this object.
   */
  class TimeIntegrator
  {
  public:
    /// See MechanicalModel::Vector.
    using Vector = MechanicalModel::Vector;

    /// Parameters of Newton's method for time steps. Residuals of rotated stiff bodies cannot be
    /// reduced below about 1e-10 of the force scale.
    static NewtonParameters
    default_newton_parameters();

    /// The state is that of initialize() without arguments.
    /// @throws InputError for coefficients of the scheme that are out of range, and for a model without
    /// masses.
    TimeIntegrator(
      MechanicalModel        &model,
      const TimeScheme       &scheme,
      const NewtonParameters &newton = default_newton_parameters());
    ~TimeIntegrator();

    /**
     * Start at @p time [s] with the displacements @p u and velocities @p v of owned unknowns.
     * Constrained unknowns are set from the constraints, and accelerations from
     * M a = -C v - r(u, t). @throws NumericalFailure if u is not admissible.
     */
    void
    initialize(const Vector &u, const Vector &v, double time = 0.);

    /// Start undeformed and at rest at the time 0.
    void
    initialize();

    /// Continue from a state that state() returned. The steps that follow are bitwise the same as
    /// they were, if the internal state of the model has been restored before
    /// (MechanicalModel::restore_internal_state()).
    void
    restore(const DynamicState &state);

    /// Try a step of @p step [s]. Expected failures (no convergence, a fault that the model
    /// finds) are results. The state does not change. @p residual_tolerance: see
    /// NewtonSolver::solve().
    [[nodiscard]] StepReport
    try_step(double step, double residual_tolerance = 0.);

    /// Accept the step that was tried last. @pre It converged.
    void
    accept();

    /// Pass the model's events up to the time @p until [s], which must be the current time up to
    /// rounding. Forces jump, and accelerations with them. The energy of conditions
    /// that are removed counts as (negative) external work.
    void
    pass_events(double until);

    /// Set velocities to zero. Their kinetic energy counts as dissipated.
    void
    stop_motion();

    /**
     * Remove blocks (ManifoldMesh::block()) for good, see Presence. Their
     * energies, including that of contact with other blocks, count as `left`. Blocks that they
     * touched no longer feel their contact forces.
     * @throws InputError for a block that does not exist or has left already.
     */
    void
    drop_blocks(const std::vector<unsigned int> &blocks);

    /// Set the accelerations to those of M a = -C v - r(u, t). In conserving schemes the state has
    /// the mean ones of the last step instead.
    void
    balance_accelerations();

    /**
     * Continue from the state of a solid that was cut further since: @p state has the u, v and
     * a of that solid, with balance_accelerations(), as functions of this model's unknowns (see
     * CarriedCovers); numbers of blocks are those of this model. The tractions that the faces of
     * the cut exerted on each other are M a + C v + r(u, t), which vanishes at all unknowns that
     * the cut does not concern. They become ClosingForces, which fade over @p duration [s], so that
     * accelerations do not jump. Closing forces of an earlier cut are a part of these. @p energy
     * is the kinetic and the stored energy before the cut [J/m].
     * What the model remembers must have been restored before.
     */
    void
    continue_after_cut(const DynamicState &state,
                       double              energy,
                       double              duration);

    /// Let blocks sleep from now on. All are awake unless the state says otherwise.
    /// @throws InputError for a model that does not distinguish blocks, as on several
    /// ranks, or parameters out of range.
    void
    let_blocks_sleep(const SleepParameters &parameters);

    /// Number of blocks that sleep now; 0 if sleeping is disabled.
    unsigned int
    n_asleep() const;

    /// The state after the last accepted step.
    const DynamicState &
    state() const;

    /// Set DynamicState::next_step [s]; called by the step control only.
    void
    set_next_step(double step);

    /// The account of energies and momenta of the current state.
    const Account &
    account() const;

    /// The model given to the constructor.
    MechanicalModel &
    model() const;

    /// The scheme given to the constructor.
    const TimeScheme &
    scheme() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
