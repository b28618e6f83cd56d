#ifndef nmm_mechanics_inelastic_terms_h
#define nmm_mechanics_inelastic_terms_h

#include <nmm/materials/inelastic_law.h>
#include <nmm/mechanics/finite_elasticity.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The terms that inelastic materials add to the linear equations of small displacements. In
   * inelastic regions the equations K u - f contain Hooke's law without initial stress only. For
   * the stress sigma of InelasticLaw, this class adds
   * @f[ r(v) = \int_\Omega (\sigma - C\varepsilon(u)):\varepsilon(v)
   *     - \int_\Gamma \{(\sigma - C\varepsilon(u))N\}\cdot Bv, \qquad
   *     K = \frac{dr}{du}, @f]
   * so that the traction of Nitsche's terms at displacement conditions and ties is that of the
   * same law; the term that makes them symmetric keeps Hooke's law. K is not symmetric in
   * general. Elements that have never yielded and have no initial stress add nothing.
   *
   * Material states are those of the last accepted step. Assembling does not change them;
   * accept() replaces them by those at the end of a step.
   *
   * Cost: one evaluation of the law per quadrature point, and three passes over the matrix if
   * any point yields. Memory: two states (80 bytes) per point of
   * inelastic regions.
   *
   * Lifetime: the elasticity must outlive this object.
   */
  class InelasticTerms
  {
  public:
    /// See FiniteElasticity::Vector.
    using Vector = FiniteElasticity::Vector;
    /// Distributed sparse matrix of the unknowns.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// @p elasticity must have an inelastic region, see FiniteElasticity::is_inelastic().
    explicit InelasticTerms(const FiniteElasticity &elasticity);
    ~InelasticTerms();

    /// Assemble r at @p u (locally relevant, [m]) and, if @p with_tangent, K. The result
    /// Deformation::inverted means that a law has no stress at some point, and that no result of
    /// the assembly may be used. Returns the same on all ranks.
    Deformation
    assemble(const Vector &u, bool with_tangent);

    /// r of the last assembly on owned unknowns, 0 for constrained ones [N/m].
    const Vector &
    residual() const;

    /// The sum of @p elastic_stiffness and K of the last assembly, which must have been one with
    /// tangent. If no point yields, this is @p elastic_stiffness itself.
    const Matrix &
    add_to(const Matrix &elastic_stiffness);

    /// Sums over an assembly and all ranks.
    struct Totals
    {
      /// Stored energy (InelasticLaw::Response::energy) minus the energy of Hooke's law without
      /// initial stress [J/m].
      double energy = 0.;
      /// Dissipation sigma : Delta epsilon^p since the last accepted state, where sigma is the
      /// stress at the end of the step, as computed by the law; never negative [J/m].
      double dissipated = 0.;
      /// Area with plastic strain [m^2].
      double yielded_area = 0.;
      /// Number of quadrature points, of elements and of sides of conditions and ties, that yield in
      /// the step.
      unsigned int n_yielding = 0;
      /// Root of the sum over inelastic elements of the squares of internal forces [N/m]. It is
      /// bounded by the strength of the material, however large the displacements are.
      double force_scale = 0.;
      /// For each boundary condition, the work that its prescribed displacement does against the
      /// tractions of these terms [J/m], per unit of its amplitude.
      std::vector<double> support_work;
    };

    /// Sums of the last assembly.
    const Totals &
    totals() const;

    /// Accept the step to @p u, at which an assembly has succeeded before: the states at @p u
    /// become the accepted ones. This assembles again, so that totals() are those of the step.
    void
    accept(const Vector &u);

    /// Accepted states of all ranks as bytes; the same on all ranks.
    std::vector<char>
    internal_state() const;

    /// Restore what internal_state() returned for the same problem, on any number of ranks.
    /// @throws InputError for another number of points.
    void
    restore_internal_state(const std::vector<char> &state);

    /// Reset all states to those of the undeformed material, to start again from the beginning.
    void
    forget_states();

    /// Replace the laws by those of @p materials, in the order of ElasticityProblem::materials, as
    /// a search for the factor of safety does. Elastic constants and initial stress must be the
    /// same.
    void
    set_materials(const std::vector<Material> &materials);

    /// Stresses and plastic strain at a quadrature point.
    struct PointValues
    {
      /// In-plane stress [Pa]; the component 00 is NaN if the law has no stress.
      dealii::SymmetricTensor<2, 2> stress;
      /// Out-of-plane normal stress [Pa].
      double stress_zz = 0.;
      /// Equivalent plastic strain [-].
      double equivalent_plastic_strain = 0.;
    };

    /// Values at the quadrature points of an element for the displacements of the last assembly;
    /// empty if its material is elastic.
    std::vector<PointValues>
    values(unsigned int element) const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
