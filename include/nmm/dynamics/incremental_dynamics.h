#ifndef nmm_dynamics_incremental_dynamics_h
#define nmm_dynamics_incremental_dynamics_h

#include <nmm/mechanics/incremental_elasticity.h>
#include <nmm/solution/step_sequence.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>

namespace NMM
{
  /**
   * The paper's equation (6) in its step-by-step kinematics: one linear problem per
   * step on the current geometry,
   * @f[ \left(\frac{2}{h^2} M + K\right)\Delta u
   *     = f - \int B^T\sigma\,da + \frac{2}{h} M v, \qquad
   *     v \leftarrow \frac{2}{h}\Delta u - v. @f]
   * This is the scheme of constant acceleration. M is the mass matrix (8) of the reference
   * configuration (mass stays with the material). The class serves as a comparison for
   * TimeIntegrator: the points of a rotating block move on straight lines in each step, so that
   * the block grows (see IncrementalElasticity).
   *
   * Order of calls: set_velocity() if the solid moves initially, then advance() (with step
   * control) or step() until time() is the end.
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class IncrementalDynamics
  {
  public:
    /// See IncrementalElasticity::Vector.
    using Vector = IncrementalElasticity::Vector;

    /// @p covers, @p constraints and @p problem must be those of @p elasticity, whose blocks need
    /// no supports. @p mass_quadrature must be exact for degree 2p.
    /// @throws InputError for a material without density.
    IncrementalDynamics(IncrementalElasticity      &elasticity,
                        const CoverSystem          &covers,
                        const QuadratureCollection &mass_quadrature,
                        const dealii::AffineConstraints<double> &constraints,
                        const ElasticityProblem                 &problem);
    ~IncrementalDynamics();

    /// Set the velocities of owned unknowns [m/s]. The energy account starts anew.
    void
    set_velocity(const Vector &velocity);

    /// Take a step of @p h [s] under loads times @p load_factor. Returns the largest
    /// displacement of a cover in the step [m]. @throws NumericalFailure as
    /// IncrementalElasticity::step().
    double
    step(double h, double load_factor = 1.);

    /// Take the same step, unless a cover would move by more than @p max_displacement [m]: then
    /// nothing changes.
    [[nodiscard]] IncrementalElasticity::StepResult
    try_step(double h, double load_factor, double max_displacement);

    /// Bounds on the steps that advance() chooses.
    struct Control
    {
      /// @{
      /// Largest step, which is also the first one tried, and smallest step [s].
      double max_step, min_step;
      /// @}
      /// Largest displacement of a cover in a step [m]; infinite: no bound.
      double max_displacement;
    };

    /// The step that advance() took, and those it tried before.
    struct Advance : LostSteps
    {
      /// Length of the step [s].
      double step = 0.;
      /// Largest displacement of a cover in the step [m].
      double largest_displacement = 0.;
    };

    /**
     * Take one step (StepSequence) towards the time @p end [s], as large as @p control allows.
     * The step is reduced and tried again from the same state until no cover moves by more than
     * allowed. The next step is at most twice as large. Loads are multiplied by @p load_factor at
     * the end of the step; an empty function stands for 1.
     * @throws InputError for bounds that are not positive or an end that is reached already.
     * @throws NumericalFailure as StepSequence::advance().
     */
    Advance
    advance(double                                 end,
            const Control                         &control,
            const std::function<double(double t)> &load_factor = {});

    /// Time since the start [s].
    double
    time() const;

    /// Energies per unit thickness [J/m].
    struct Account
    {
      /// @{
      /// Kinetic energy and strain energy [J/m].
      double kinetic = 0., strain = 0.;
      /// @}
      /// Work of loads that keep their direction, see IncrementalElasticity::work_of_loads().
      double work = 0.;
      /// Change of kinetic + strain - work since the start: energy that the scheme, supports and
      /// follower pressure add (> 0) or remove (< 0).
      double balance = 0.;
    };

    /// The energy account of the current state.
    Account
    account() const;

    /// Everything that a step changes, to return to a state or to continue from it.
    struct State
    {
      /// Displacements and stresses.
      IncrementalElasticity::State elasticity;
      /// Velocities of owned unknowns [m/s].
      Vector velocity;
      /// @{
      /// Time [s], the step that advance() would try next (0: none chosen yet) [s], and
      /// kinetic + strain energy - work at the start of the account [J/m].
      double time = 0., next_step = 0., initial_energy = 0.;
      /// @}
    };

    /// A copy of the current state.
    State
    state() const;

    /// Continue from @p state. The steps that follow are bitwise the same as they were.
    void
    restore(const State &state);

    /// Velocities of owned unknowns [m/s].
    const Vector &
    velocity() const;

    /// Kinetic energy [J/m].
    double
    kinetic_energy() const;

    /// Angular momentum about the origin in the current configuration, positive
    /// counter-clockwise [kg m/s].
    double
    angular_momentum() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
