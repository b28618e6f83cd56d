#ifndef nmm_dynamics_incremental_dynamics_h
#define nmm_dynamics_incremental_dynamics_h

#include <nmm/mechanics/incremental_elasticity.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>

namespace NMM
{
  /**
   * The paper's equation (6) in its step-by-step kinematics: one linear problem a
   * step on the current geometry,
   * @f[ \left(\frac{2}{h^2} M + K\right)\Delta u
   *     = f - \int B^T\sigma\,da + \frac{2}{h} M v, \qquad
   *     v \leftarrow \frac{2}{h}\Delta u - v, @f]
   * the scheme of constant acceleration, M the mass matrix (8) of the reference
   * configuration (mass stays with the material). The comparison for
   * TimeIntegrator: a turning block moves on straight lines in each step, and grows
   * (see IncrementalElasticity).
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class IncrementalDynamics
  {
  public:
    using Vector = IncrementalElasticity::Vector;

    /// @p elasticity may float; its covers, constraints and problem are to be
    /// given again. @p mass_quadrature: exact for degree 2p.
    /// @throws InputError for a material without density.
    IncrementalDynamics(IncrementalElasticity      &elasticity,
                        const CoverSystem          &covers,
                        const QuadratureCollection &mass_quadrature,
                        const dealii::AffineConstraints<double> &constraints,
                        const ElasticityProblem                 &problem);
    ~IncrementalDynamics();

    /// Owned unknowns [m/s]. The account of energies starts anew.
    void
    set_velocity(const Vector &velocity);

    /// A step of @p h [s] under loads times @p load_factor. Returns the largest
    /// displacement of a cover in the step [m]. @throws NumericalFailure as
    /// IncrementalElasticity::step().
    double
    step(double h, double load_factor = 1.);

    /// The same, unless a cover would move by more than @p max_displacement [m]:
    /// then nothing changes.
    [[nodiscard]] IncrementalElasticity::StepResult
    try_step(double h, double load_factor, double max_displacement);

    /// How advance() chooses its steps.
    struct Control
    {
      /// The largest step, and the first one tried; the smallest allowed [s].
      double max_step, min_step;
      /// Largest displacement of a cover in a step [m].
      double max_displacement;
    };

    /// What advance() did.
    struct Advance
    {
      /// [s]
      double step = 0.;
      /// [m]
      double       largest_displacement = 0.;
      unsigned int n_cuts               = 0;
    };

    /**
     * One step towards the time @p end [s], as large as @p control allows: it is cut
     * and tried again from the same state until no cover moves by more than allowed,
     * and the next one is at most twice as large. @p load_factor at the end of the step
     * acts. @throws NumericalFailure if a step would be smaller than allowed.
     */
    Advance
    advance(double                                 end,
            const Control                         &control,
            const std::function<double(double t)> &load_factor = {});

    /// Since the start [s].
    double
    time() const;

    /// [J/m]
    struct Account
    {
      double kinetic = 0., strain = 0.;
      /// Work of loads that keep their direction, IncrementalElasticity::work_of_loads().
      double work = 0.;
      /// kinetic + strain - work less that at the start: what the scheme, supports and
      /// follower pressure add (> 0) or take away.
      double balance = 0.;
    };

    Account
    account() const;

    /// All that steps change; to go back to, or to continue from.
    struct State
    {
      IncrementalElasticity::State elasticity;
      /// Owned unknowns [m/s].
      Vector velocity;
      double time = 0., next_step = 0., initial_energy = 0.;
    };

    State
    state() const;

    /// The same bits follow.
    void
    restore(const State &state);

    /// Owned unknowns [m/s].
    const Vector &
    velocity() const;

    /// [J/m]
    double
    kinetic_energy() const;

    /// About the origin, in the current configuration [kg m/s].
    double
    angular_momentum() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
