#ifndef nmm_mechanics_static_solid_h
#define nmm_mechanics_static_solid_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/mechanics/solid_layout.h>

#include <memory>

namespace NMM
{
  /**
   * The force term of a solid at rest. Its time is the load factor lambda [-], by which loads and
   * prescribed displacements are multiplied. The forces are those of FiniteElasticity, or their
   * linearization at u = 0,
   * @f[ r(u) = K(0)\,u + r(0), @f]
   * which is the theory of small displacements. In small displacements inelastic materials add their
   * forces (InelasticTerms), and the equations are no longer linear.
   *
   * Lifetime: the elasticity must outlive this object. While a linearized solid is in use, no
   * other object may assemble the same elasticity.
   */
  class StaticSolid : public ForceTerm
  {
  public:
    /// @p is_linearized selects the theory of small displacements.
    /// @throws InputError for inelastic materials unless @p is_linearized.
    StaticSolid(FiniteElasticity &elasticity, bool is_linearized);
    ~StaticSolid() override;

    /// The unknowns of the solid, for further terms.
    const ModelLayout &
    layout() const
    {
      return unknowns.unknowns();
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    /// Properties of the last assembly.
    ForceProperties
    properties() const override;

    /// Inelastic materials keep their new states.
    StepWork
    commit(const Trial &step) override;

    /// Residual of the solid alone at @p u and a load factor (owned unknowns) [N/m].
    Vector
    residual_at(const Vector &u, double load_factor);

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

    /// The elasticity given to the constructor.
    FiniteElasticity &
    elasticity() const;

    /// Whether these are the forces of small displacements.
    bool
    is_linearized() const;

    /// Strain energy of the last assembly; in small displacements the energy of displacement
    /// conditions and ties is included [J/m].
    double
    strain_energy() const;

  private:
    /// Compute K(0) and r(0) at the load factor unless they are known.
    void
    linearize(double load_factor);

    Deformation
    assemble_linearized(const Trial &trial, AssembledForces &forces);

    FiniteElasticity *elastic;
    bool              linearized;
    SolidLayout       unknowns;

    /// If linearized: whether K(0), which is stored in the elasticity, is known; the load factor of
    /// r(0), or no number; and vectors of owned unknowns: u, r(0) and the residual.
    bool   has_stiffness = false;
    double load_at;
    Vector owned, load, sum;

    std::unique_ptr<InelasticTerms> inelastic;
    double                          scale = 0., energy = 0.;
  };
} // namespace NMM

#endif
