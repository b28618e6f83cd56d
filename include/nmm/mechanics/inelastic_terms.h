#ifndef nmm_mechanics_inelastic_terms_h
#define nmm_mechanics_inelastic_terms_h

#include <nmm/materials/inelastic_law.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/force_term.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The terms that inelastic materials add to the equations of FiniteElasticity, which contain an
   * elastic law without initial stress in inelastic regions.
   *
   * Small displacements: the elastic law is Hooke's. For the stress sigma of InelasticLaw, this
   * class adds
   * @f[ r(v) = \int_\Omega (\sigma - C\varepsilon(u)):\varepsilon(v)
   *     - \int_\Gamma \{(\sigma - C\varepsilon(u))N\}\cdot Bv, \qquad
   *     K = \frac{dr}{du}, @f]
   * so that the traction of Nitsche's terms at displacement conditions and ties is that of the
   * same law; the term that makes them symmetric keeps Hooke's law. K is not symmetric in
   * general. Elements that have never yielded and have no initial stress add nothing.
   *
   * Finite displacements: the elastic law is St. Venant-Kirchhoff's, with the stress P_e. The
   * inelastic law is evaluated in the frame that rotates with the material, F = R U, for Biot's
   * strain U - I. Its stress T is conjugate to U, which gives P with P : dF = T : dU
   * (source/mechanics/rotated_frame.h), and
   * @f[ r(v) = \int_\Omega (P - P_e):\nabla v
   *     - \int_\Gamma \{(P - P_e)N\}\cdot Bv. @f]
   * Rotations may be of any size, and a rigid one changes neither T nor plastic strain nor energy.
   * Strains have to be small, some percent: elastic and plastic strains are added, and T, which
   * yields, is a force per reference area and thickness. Relative errors are of the size of strains.
   * Conserving steps have the mean of T at both ends: they conserve momenta exactly, and the change
   * of the stored energy is their work minus what the mean of T dissipates by the plastic strain.
   * K is unsymmetric.
   *
   * Material states are those of the last accepted step. Assembling does not change them;
   * accept() replaces them by those at the end of a step.
   *
   * Cost: one evaluation of the law per quadrature point, two in conserving steps of finite
   * displacements, and three passes over the matrix if any point yields or displacements are finite.
   * Memory: two states (80 bytes) per point of inelastic regions.
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
    InelasticTerms(const FiniteElasticity &elasticity, Kinematics kinematics);
    ~InelasticTerms();

    /// Assemble r at @p u (locally relevant, [m]) and, if @p with_tangent, K. The result
    /// Deformation::inverted means that a law has no stress at some point, and that no result of
    /// the assembly may be used. Returns the same on all ranks. With @p begin, in finite
    /// displacements only, r is that of a conserving step from there to @p u, K its derivative as
    /// in FiniteElasticity::assemble_between(), and Totals::energy is undefined.
    Deformation
    assemble(const Vector &u, bool with_tangent, const Vector *begin = nullptr);

    /// r of the last assembly on owned unknowns, 0 for constrained ones [N/m].
    const Vector &
    residual() const;

    /// The sum of @p elastic_stiffness and K of the last assembly, which must have been one with
    /// tangent. In small displacements it is @p elastic_stiffness itself if no point yields.
    const Matrix &
    add_to(const Matrix &elastic_stiffness);

    /// Sums over an assembly and all ranks.
    struct Totals
    {
      /// Stored energy (InelasticLaw::Response::energy) minus the energy of the elastic law [J/m].
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
      /// In-plane Cauchy stress [Pa]; the component 00 is NaN if the law has no stress.
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
