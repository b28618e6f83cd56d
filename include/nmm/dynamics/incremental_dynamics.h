#ifndef nmm_dynamics_incremental_dynamics_h
#define nmm_dynamics_incremental_dynamics_h

#include <nmm/mechanics/incremental_elasticity.h>

#include <deal.II/base/tensor.h>

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

    /// Owned unknowns [m/s].
    void
    set_velocity(const Vector &velocity);

    /// A step of @p h [s] under loads times @p load_factor. Returns the largest
    /// displacement of a cover in the step [m]. @throws NumericalFailure as
    /// IncrementalElasticity::step().
    double
    step(double h, double load_factor = 1.);

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
