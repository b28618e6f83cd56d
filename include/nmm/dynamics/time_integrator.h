#ifndef nmm_dynamics_time_integrator_h
#define nmm_dynamics_time_integrator_h

#include <nmm/dynamics/mechanical_model.h>
#include <nmm/dynamics/time_scheme.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// Sums that the energy account keeps [J/m].
  struct EnergySums
  {
    /// Kinetic + strain + conditions at the start.
    double initial = 0.;
    /// Done by loads, moving supports and, in a release, by what is taken away.
    double external_work = 0.;
    /// Energy dissipated by Rayleigh damping and by stops of a relaxation [J/m].
    double dissipated = 0.;
    /// Kinetic + strain + conditions of blocks that have left, when they did.
    double left = 0.;
  };


  /// All that a continuation needs. Vectors hold owned unknowns.
  struct DynamicState
  {
    using Vector = MechanicalModel::Vector;

    double       time = 0.;
    unsigned int step = 0;
    /// [m], [m/s], [m/s^2].
    Vector u, v, a;
    /// What MechanicalModel::pass_events() was called with last.
    double events_passed = 0.;
    /// Step that would be tried next, chosen by the step control; 0: none yet [s].
    double     next_step = 0.;
    double     kinetic   = 0.;
    EnergySums sums;
    /// Blocks that have left, in the order in which they did.
    std::vector<unsigned int> left_blocks;
    /// For each block, how long it has been at rest [s], infinity if it sleeps, and if
    /// so forces [N/m] and moment [N] on it when it fell asleep. Empty if none
    /// may. See SleepParameters.
    std::vector<std::array<double, 4>> rest;
  };


  /**
   * Which blocks may sleep: they are held where they are, neither assembled nor
   * solved for, while what touches them feels them as before. A block falls asleep once
   * it has been slow for some time, and wakes, in the same step, when forces on it
   * differ from those when it fell asleep. What it errs by: motion that is slower
   * than this ends, its energy counts as dissipated, and force that changes by less
   * than mass times the acceleration given here moves nothing.
   */
  struct SleepParameters
  {
    /// Root mean square of a block's speed below which it is at rest [m/s].
    double speed = 0.01;
    /// For so long before it sleeps [s].
    double time = 0.25;
    /// Change of the force on it over its mass, and of the moment over sqrt(mass *
    /// moment of inertia), that wake it [m/s^2].
    double acceleration = 1.;
  };


  /// Energies [J/m], linear momentum [kg/s] and angular momentum about the
  /// origin [kg m/s], all per unit thickness.
  struct Account
  {
    double kinetic = 0., strain = 0., conditions = 0., external_work = 0.,
           dissipated = 0., left = 0.;
    /// kinetic + strain + conditions + dissipated + left - external_work -
    /// initial: what the scheme adds (> 0) or takes away.
    double               balance = 0.;
    dealii::Tensor<1, 2> linear_momentum;
    double               angular_momentum = 0.;
    /// |r + C v| / force scale: 0 at rest in balance [-].
    double imbalance = 0.;
  };


  /// A step that was tried.
  struct StepReport
  {
    bool converged = false;
    /// Messages: why the step failed, and what the user can do; see StepFault.
    std::string reason, remedy;
    /// Share of the step that is to be tried next; 0: nothing is known of that.
    double       retry        = 0.;
    double       step         = 0.;
    unsigned int n_iterations = 0;
    /// The same, each times the share of the unknowns it was for.
    double n_full_iterations = 0.;
    /// Wall times of the equations' factorization and of substitutions [s]; 0 if
    /// the step is linear.
    double factorization_time = 0., substitution_time = 0.;
    /// Largest displacement of a cover in the step [m].
    double max_displacement = 0.;
    /**
     * Estimate of the local error of u, |beta - 1/6| h^2 |a_1 - a_0| in the mean
     * weighted with mass (Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991)
     * 871, eq. (11); 1/12 for midpoint rules) [m].
     */
    double error = 0.;
  };


  /**
   * Advances a MechanicalModel by one step at a time. A step is tried, and the state
   * changes only when it is accepted.
   *
   * Linear models: one factorization for all steps of equal size, one
   * solution per step. Others: NewtonSolver from
   * @f$ u_0 + h v_0 + h^2 a_0 / 2 @f$.
   *
   * Lifetime: the model must outlive this object.
   */
  class TimeIntegrator
  {
  public:
    using Vector = MechanicalModel::Vector;

    /// Residuals of turned stiff bodies end near 1e-10 of force_scale().
    static NewtonParameters
    default_newton_parameters();

    /// @throws InputError if the scheme's coefficients do not fit.
    TimeIntegrator(
      MechanicalModel        &model,
      const TimeScheme       &scheme,
      const RayleighDamping  &damping = {},
      const NewtonParameters &newton  = default_newton_parameters());
    ~TimeIntegrator();

    /**
     * Start at @p time with displacements and velocities of owned unknowns
     * (constrained ones are set) and the accelerations that follow:
     * M a = -C v - r(u, t). @throws NumericalFailure if u is not admissible.
     */
    void
    initialize(const Vector &u, const Vector &v, double time = 0.);

    /// Begin at rest, undeformed.
    void
    initialize();

    /// Continue from a state that state() returned: the same bits follow.
    void
    restore(const DynamicState &state);

    /// Try a step of @p step [s]. Expected failures are results.
    [[nodiscard]] StepReport
    try_step(double step);

    /// Take the step that was tried last. @pre It converged.
    void
    accept();

    /// Pass the model's events up to @p until, the current time but for
    /// rounding: forces jump, accelerations with them. What energy the conditions
    /// taken away had counts as (negative) external work.
    void
    pass_events(double until);

    /// Zero velocities; their energy counts as dissipated.
    void
    stop_motion();

    /**
     * The blocks (ManifoldMesh::block()) leave for good, see
     * MechanicalModel::set_absent_blocks(). Their energies, that of contact with
     * others included, count as `left`, and what they still touched loses that
     * force. @throws InputError for a block that has left already.
     */
    void
    drop_blocks(const std::vector<unsigned int> &blocks);

    /// From now on blocks may sleep. They are awake unless the state says otherwise.
    /// @throws InputError for a model that does not tell blocks apart, as on several
    /// ranks, or parameters that are not positive.
    void
    let_blocks_sleep(const SleepParameters &parameters);

    /// How many sleep now.
    unsigned int
    n_asleep() const;

    const DynamicState &
    state() const;

    /// For the step control.
    void
    set_next_step(double step);

    /// The energy account of the current state.
    const Account &
    account() const;

    MechanicalModel &
    model() const;

    const TimeScheme &
    scheme() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
