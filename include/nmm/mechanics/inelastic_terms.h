#ifndef nmm_mechanics_inelastic_terms_h
#define nmm_mechanics_inelastic_terms_h

#include <nmm/materials/inelastic_law.h>
#include <nmm/mechanics/finite_elasticity.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * What inelastic materials add to the linear equations of small displacements. In these
   * regions the equations K u - f know Hooke's law without initial stress only; this adds, for
   * the stress sigma of InelasticLaw,
   * @f[ r(v) = \int_\Omega (\sigma - C\varepsilon(u)):\varepsilon(v)
   *     - \int_\Gamma \{(\sigma - C\varepsilon(u))N\}\cdot Bv, \qquad
   *     K = \frac{dr}{du}, @f]
   * so that the traction of Nitsche's terms at displacement conditions and ties is that of the
   * same law; the term that makes them symmetric keeps Hooke's law. K is not symmetric in
   * general. Elements that have never yielded and have no initial stress add nothing.
   *
   * The material's states are those of the step accepted last; assembling changes nothing, and
   * accept() makes those at the end of a step the accepted ones.
   *
   * Cost: one evaluation of the law per quadrature point, and three sweeps over the matrix where
   * something yields. Memory: two states (80 bytes) per point of
   * inelastic regions.
   *
   * Lifetime: the elasticity must outlive this object.
   */
  class InelasticTerms
  {
  public:
    using Vector = FiniteElasticity::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// @p elasticity has an inelastic region, see FiniteElasticity::is_inelastic().
    explicit InelasticTerms(const FiniteElasticity &elasticity);
    ~InelasticTerms();

    /// r at @p u (locally relevant, [m]) and, if @p with_tangent, K. With @c inverted, the law has
    /// no stress somewhere and nothing of it may be used. The same result on all ranks.
    Deformation
    assemble(const Vector &u, bool with_tangent);

    /// r of the last assembly [N/m]; owned unknowns, 0 for constrained ones.
    const Vector &
    residual() const;

    /// The sum of @p elastic_stiffness and K of the last assembly with tangent.
    const Matrix &
    add_to(const Matrix &elastic_stiffness);

    /// Sums over an assembly and all ranks.
    struct Totals
    {
      /// InelasticLaw::Response::energy less the energy of Hooke's law without initial stress
      /// [J/m].
      double energy = 0.;
      /// sigma : Delta epsilon^p since the last accepted state, sigma being that at the end of
      /// the step, as the law has it; never negative [J/m].
      double dissipated = 0.;
      /// Area with plastic strain [m^2].
      double yielded_area = 0.;
      /// Quadrature points in the volume that yield.
      unsigned int n_yielding = 0;
      /// Root of the sum over inelastic elements of the squares of internal forces. The
      /// material's strength bounds it, whatever the displacements [N/m].
      double force_scale = 0.;
    };

    /// Sums of the last assembly.
    const Totals &
    totals() const;

    /// The step to @p u, where the law has been evaluated before, is accepted: the states there
    /// are the accepted ones. Assembles; totals() are those of the step.
    void
    accept(const Vector &u);

    /// Accepted states of all ranks, and back again; on any number of ranks.
    std::vector<char>
    internal_state() const;

    void
    restore_internal_state(const std::vector<char> &state);

    /// As in the undeformed state; for another search from the beginning.
    void
    forget_states();

    /// Laws anew, those of @p materials in the order of ElasticityProblem::materials; elastic
    /// constants and initial stress must be the same. For a search for the factor of safety.
    void
    set_materials(const std::vector<Material> &materials);

    /// Stress at an element's quadrature points, in the plane and across it [Pa], and the
    /// equivalent plastic strain [-].
    struct PointValues
    {
      dealii::SymmetricTensor<2, 2> stress;
      double                        stress_zz                 = 0.;
      double                        equivalent_plastic_strain = 0.;
    };

    /// Values of an element's points at the displacements of the last assembly; empty if its material
    /// is elastic.
    std::vector<PointValues>
    values(unsigned int element) const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
