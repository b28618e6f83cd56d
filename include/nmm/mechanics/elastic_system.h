#ifndef nmm_mechanics_elastic_system_h
#define nmm_mechanics_elastic_system_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/solution/newton_solver.h>

namespace NMM
{
  /**
   * The static equations of a FiniteElasticity at a load factor, as NewtonSolver
   * sees them: as they are, or linearized at u = 0,
   * @f[ r(u) = K(0)\,u + r(0), @f]
   * which is the theory of small displacements. Loads are those of the load factor in
   * both.
   *
   * Lifetime: the elasticity must outlive this object, and nobody else may
   * assemble it while a linearized one is in use.
   */
  class ElasticSystem : public NonlinearSystem
  {
  public:
    ElasticSystem(FiniteElasticity &elasticity, bool is_linearized);

    void
    set_load_factor(double load_factor);

    double
    load_factor() const;

    FiniteElasticity &
    elasticity() const;

    bool
    is_linearized() const;

    Deformation
    assemble(const Vector &u,
             Tangent       tangent,
             const Vector *increment) override;

    const Vector &
    residual() const override;

    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const override;

    bool
    tangent_is_symmetric() const override;

    double
    force_scale() const override;

    /// Strain energy of the last assembly, of small displacements with
    /// what the conditions store [J/m].
    double
    strain_energy() const;

  private:
    FiniteElasticity *elastic;
    bool              linearized;
    double            factor = 0.;

    /// Linearized: K(0) is in the elasticity; r(0), and whether both are known.
    bool   has_stiffness = false, has_load = false;
    Vector owned, load, sum;
    double scale = 0., energy = 0.;
  };
} // namespace NMM

#endif
