#ifndef nmm_mechanics_elastic_system_h
#define nmm_mechanics_elastic_system_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/solution/newton_solver.h>

#include <memory>

namespace NMM
{
  /**
   * The static equations of a FiniteElasticity at a load factor, in the form that NewtonSolver
   * solves: the nonlinear equations, or their linearization at u = 0,
   * @f[ r(u) = K(0)\,u + r(0), @f]
   * which is the theory of small displacements. Loads are multiplied by the load factor in
   * both. In small displacements inelastic materials add their forces (InelasticTerms), and the
   * equations are no longer linear. The residual r_0 of inelastic materials in the undeformed
   * state, due to their initial stress, is applied in proportion to the load factor lambda as well,
   * @f[ r(u) = K(0)\,u + r(0) + r_\mathrm{inelastic}(u) - (1 - \lambda)\,r_0, @f]
   * like an excavation in small steps, because yielding depends on the loading path.
   *
   * Order of calls in a load step: set_load_factor(), assemble() as often as needed, accept_step()
   * if the step is accepted.
   *
   * Lifetime: the elasticity must outlive this object. While a linearized system is in use, no
   * other object may assemble the same elasticity.
   */
  class ElasticSystem : public NonlinearSystem
  {
  public:
    /// @p is_linearized selects the theory of small displacements.
    /// @throws InputError for inelastic materials unless @p is_linearized.
    /// @throws NumericalFailure if the initial stress of a material cannot be returned to its yield
    /// surface.
    ElasticSystem(FiniteElasticity &elasticity, bool is_linearized);
    ~ElasticSystem() override;

    /// Accept the step to @p u: inelastic materials keep their new states. Returns the energy that
    /// they have dissipated in the step [J/m].
    double
    accept_step(const Vector &u);

    /// Reset inelastic materials to the undeformed state, so that the next step begins there.
    void
    forget_states();

    /// See FiniteElasticity::adapt_penalties(). Does nothing in small displacements.
    void
    adapt_penalties(const Vector &u);

    /// FiniteElasticity::largest_jump() [-]. 0 in small displacements, where the
    /// potential is convex and hence no solution is spurious.
    double
    largest_jump() const;

    /// Forces of inelastic materials, or null if all materials are elastic.
    InelasticTerms *
    inelastic_terms() const;

    /// Set the factor of loads and prescribed displacements for the next assemblies [-].
    void
    set_load_factor(double load_factor);

    /// The load factor that was set last; 0 initially [-].
    double
    load_factor() const;

    /// The elasticity given to the constructor.
    FiniteElasticity &
    elasticity() const;

    /// Whether these are the equations of small displacements.
    bool
    is_linearized() const;

    Deformation
    assemble(const Vector &u,
             Tangent       tangent,
             const Vector *increment) override;

    /// Strain energy of the last assembly; in small displacements the energy of displacement
    /// conditions and ties is included [J/m].
    double
    strain_energy() const;

  private:
    /// Compute r_0.
    void
    find_initial_imbalance();

    Deformation
    assemble_linearized(const Vector &u, bool with_tangent);

    FiniteElasticity *elastic;
    bool              linearized;
    double            factor = 0.;

    /// If linearized: whether K(0), which is stored in the elasticity, and r(0) are known; and
    /// vectors of owned unknowns: u, r(0) and the residual.
    bool   has_stiffness = false, has_load = false;
    Vector owned, load, sum;
    /// r_0 [N/m]; empty if all materials are elastic.
    Vector                          initial_imbalance;
    std::unique_ptr<InelasticTerms> inelastic;
    double                          scale = 0., energy = 0.;
  };
} // namespace NMM

#endif
