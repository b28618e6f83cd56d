#ifndef nmm_mechanics_finite_elasticity_h
#define nmm_mechanics_finite_elasticity_h

#include <nmm/covers/cover_system.h>
#include <nmm/materials/hyperelastic_law.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * What multiplies the loads and conditions of an ElasticityProblem, all beside
   * the common load factor. An empty list stands for ones (or nothing released).
   */
  struct LoadAmplitudes
  {
    /// Per boundary condition: its value, prescribed displacements included.
    std::vector<double> boundary_conditions;
    std::vector<double> point_forces;
    /// Per fixed point: its displacement.
    std::vector<double> fixed_points;
    double              gravity    = 1.;
    double              body_force = 1.;
    /// Displacement conditions and fixed points that hold no longer.
    std::vector<bool> released_conditions, released_fixed_points;
  };


  /**
   * Total Lagrangian elasticity on a cover system: forces and tangent of the
   * potential
   * @f[ \Pi(u) = \int_\Omega W(I+\nabla u)\,dA - \text{loads}(u) + \Pi_N(u), @f]
   * all integrals over the reference configuration, which is cut once. W is the
   * law of each region's material (HyperelasticLaw). Loads: gravity,
   * body force, tractions and pressures that keep their direction (per reference
   * area), follower pressure -p cof(F) N dA, which has no potential
   * and makes the tangent unsymmetric, and point forces. Fixed points are springs (12).
   *
   * Displacement conditions and ties are imposed weakly by the potential form of
   * Nitsche's method, with d = B (u - g):
   * @f[ \Pi_N = \int_\Gamma -P(F):(d\otimes N) + \frac{\gamma}{2}|d|^2\,ds, @f]
   * gamma as in StaticElasticity, from the moduli at rest: consistent, exact
   * under rotation (the terms with d vanish with d), and with a symmetric tangent; its
   * linearization at u = 0 is StaticElasticity's form. N and curves of normal
   * displacement conditions are those of the reference configuration.
   *
   * Loads and prescribed displacements are multiplied by a load factor. Initial
   * stress is not.
   *
   * Cost: weights and physical gradients at quadrature points are computed once
   * and shared by equal whole elements; the pattern of the matrix is made once.
   * A quadrature of degree 2(p - 1) for whole elements keeps the order of
   * convergence (the bound for linear problems; the energy of St.
   * Venant-Kirchhoff is a polynomial of degree 4(p - 1)), see results of step-nmm-2.
   *
   * All terms are per unit thickness. Inhomogeneities of the constraints hold
   * from the first solution on, whatever the load factor.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class FiniteElasticity
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// @throws InputError if the problem does not fit the mesh, see
    /// ElasticityProblem::check(), or a point lies outside the solid.
    /// @throws NumericalFailure for a block that floats freely, unless
    /// @p may_float (dynamics).
    FiniteElasticity(const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const ElasticityProblem                 &problem,
                     bool may_float = false);
    ~FiniteElasticity();

    /**
     * Residual r = internal forces - loads at @p u (locally relevant, [m]) and
     * K = dr/du. For @p increment see NonlinearSystem. Tangent::robust
     * leaves out D_G A, the third derivative of W, where the jump d is so large
     * (more than a tenth of 1 / Lambda, a fraction of the element) that it spoils
     * ellipticity: when a prescribed displacement has just grown. The first
     * iteration then moves the boundary to its place as in a linear problem.
     * The same result on all ranks.
     */
    Deformation
    assemble(const Vector &u,
             double        load_factor,
             Tangent       tangent,
             const Vector *increment = nullptr);

    /**
     * Residual between the displacements @p begin and @p end of a time step, of
     * the energy-momentum conserving scheme. Internal forces and those of
     * conditions and ties (source/mechanics/conserving_terms.h) do the work by
     * which the strain energy and the energy of conditions change, but for the
     * work of moving supports; internal forces and ties exert no moment in the mean
     * position. All other terms are those at the mean displacement. Prescribed
     * displacements are multiplied by what @p first and @p last say of them at
     * the beginning and at the end, where these are given, else by the amplitudes
     * that were set. tangent() is the
     * derivative by the mean displacement at given @p begin, i.e. twice that by
     * @p end, and not symmetric. Of energies() only `loads`,
     * `work_of_conditions` and `dissipated` are set.
     *
     * @p damping: a coefficient of the stiffness [s] over the step; adds to the second
     * Piola-Kirchhoff stress the moduli at rest times the change of the
     * Green-Lagrange strain times it.
     */
    Deformation
    assemble_between(const Vector         &begin,
                     const Vector         &end,
                     double                load_factor,
                     Tangent               tangent,
                     const LoadAmplitudes *first   = nullptr,
                     const LoadAmplitudes *last    = nullptr,
                     double                damping = 0.);

    /**
     * Let the penalties gamma grow with the moduli A(u) at the boundary once these
     * are more than twice those at rest, e.g. under strong compression; they
     * never decrease. Between steps, not within: the
     * potential changes, by the order of the discretization error.
     */
    void
    adapt_penalties(const Vector &u);

    /// Multiplies loads from the next assembly on.
    void
    set_amplitudes(const LoadAmplitudes &amplitudes);

    /**
     * From the next assembly on nothing is added of these blocks
     * (ManifoldMesh::block()), nor of what ties them to others: their rows of the
     * tangent keep a diagonal entry that means nothing. Empty: all blocks are there.
     * @throws InputError for another number of blocks.
     */
    void
    set_absent_blocks(const std::vector<bool> &is_absent);

    /// From now on nothing of other blocks is assembled: residual and tangent are
    /// wrong in their rows, and energies and force_scale() are those of the rest. Empty:
    /// all blocks are active.
    void
    set_active_blocks(const std::vector<bool> &is_active);

    /// Pairs of blocks that are tied to each other and that this rank knows of.
    std::vector<std::pair<unsigned int, unsigned int>>
    tied_blocks() const;

    /// Elements that the last assembly worked on, on this rank.
    unsigned int
    n_assembled_elements() const;

    /// Owned unknowns [N/m thickness]; 0 for constrained ones.
    const Vector &
    residual() const;

    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const;

    /// False if there is follower pressure.
    bool
    tangent_is_symmetric() const;

    /// Energies of the last assembly, per unit thickness.
    struct Energies
    {
      /// Integral of W [J/m].
      double strain = 0.;
      /// Energy of weak conditions, ties and springs of fixed points [J/m].
      double conditions = 0.;
      /// Minus the work of loads that keep direction and size, at the current
      /// factor [J/m].
      double loads = 0.;
      /// Done in assemble_between() by the change of what is prescribed [J/m].
      double work_of_conditions = 0.;
      /// Energy dissipated by damping in assemble_between() [J/m].
      double dissipated = 0.;
    };

    const Energies &
    energies() const;

    /// Root of the sum over elements of the squares of internal forces, of
    /// loads and of the forces of conditions, of the last assembly; not less than
    /// forces at a strain of 1e-6 [N/m].
    double
    force_scale() const;

    /**
     * Largest |d| of displacement conditions and ties of the last assembly,
     * times the Lambda of the element [-]: 1 is a jump of about a tenth of a cell.
     * At a solution it is of the order of the discretization error, 0.1 at
     * singular corners of coarse meshes. The potential of Nitsche's
     * method is not bounded from below, and a stationary point with large
     * jumps is none of the problem: one above @c largest_good_jump.
     */
    double
    largest_jump() const;

    static constexpr double largest_good_jump = 0.5;

    /// A vector of locally relevant unknowns, zero but for inhomogeneities of
    /// the constraints.
    Vector
    initial_solution() const;

    const CoverSystem &
    cover_system() const;

    const ElasticityProblem &
    elasticity_problem() const;

    const dealii::AffineConstraints<double> &
    affine_constraints() const;

    /// Law of a region of the physical mesh.
    const HyperelasticLaw &
    law(unsigned int region) const;

    /// Whether a region has an inelastic law, of which this knows the elastic part only, without
    /// initial stress; see InelasticTerms.
    bool
    is_inelastic() const;

    /// Tables of gradients that whole elements share.
    unsigned int
    n_shared_tables() const;

  private:
    friend class InelasticTerms;

    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
