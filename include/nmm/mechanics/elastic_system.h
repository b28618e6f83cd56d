#ifndef nmm_mechanics_elastic_system_h
#define nmm_mechanics_elastic_system_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/solution/newton_solver.h>

#include <memory>

namespace NMM
{
  /**
   * The static equations of a FiniteElasticity at a load factor, as NewtonSolver
   * sees them: as they are, or linearized at u = 0,
   * @f[ r(u) = K(0)\,u + r(0), @f]
   * which is the theory of small displacements. Loads are those of the load factor in
   * both. In small displacements inelastic materials add their part (InelasticTerms), and the
   * equations are linear no longer. The forces r_0 by which their initial stress is out of balance
   * in the undeformed state act with the load factor as well,
   * @f[ r(u) = K(0)\,u + r(0) + r_\mathrm{inelastic}(u) - (1 - \lambda)\,r_0, @f]
   * as by an excavation in small steps: yielding depends on the way.
   *
   * Order of calls in a load step: set_load_factor(), assemble() as often as needed, accept_step()
   * if the step is accepted.
   *
   * Lifetime: the elasticity must outlive this object, and nobody else may
   * assemble it while a linearized one is in use.
   */
  class ElasticSystem : public NonlinearSystem
  {
  public:
    /// @throws InputError for inelastic materials unless @p is_linearized.
    ElasticSystem(FiniteElasticity &elasticity, bool is_linearized);
    ~ElasticSystem() override;

    /// The step to @p u is accepted: inelastic materials keep their new states. Returns what they
    /// dissipated in it [J/m].
    double
    accept_step(const Vector &u);

    /// The next step begins at the undeformed state, whose materials remember nothing.
    void
    forget_states();

    /// See FiniteElasticity::adapt_penalties(); the theory of small displacements has no need
    /// for it.
    void
    adapt_penalties(const Vector &u);

    /// FiniteElasticity::largest_jump(). 0 in small displacements, where the
    /// potential is convex and each solution is one.
    double
    largest_jump() const;

    /// Null: all materials are elastic.
    InelasticTerms *
    inelastic_terms() const;

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
    void
    find_initial_imbalance();

    FiniteElasticity *elastic;
    bool              linearized;
    double            factor = 0.;

    /// Linearized: K(0) is in the elasticity; r(0), and whether both are known.
    bool   has_stiffness = false, has_load = false;
    Vector owned, load, sum;
    /// r_0; empty before the first assembly.
    Vector                                        initial_imbalance;
    std::unique_ptr<InelasticTerms>               inelastic;
    const dealii::TrilinosWrappers::SparseMatrix *stiffness = nullptr;
    double                                        scale = 0., energy = 0.;
  };
} // namespace NMM

#endif
