#ifndef nmm_mechanics_finite_elasticity_h
#define nmm_mechanics_finite_elasticity_h

#include <nmm/covers/aggregation.h>
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
   * Factors of the loads and conditions of an ElasticityProblem, in addition to
   * the common load factor. An empty list stands for factors 1, or for no release.
   */
  struct LoadAmplitudes
  {
    /// For each boundary condition, the factor of its value, also of a prescribed displacement [-].
    std::vector<double> boundary_conditions;
    /// For each point force, its factor [-].
    std::vector<double> point_forces;
    /// For each fixed point, the factor of its displacement [-].
    std::vector<double> fixed_points;
    /// Factor of gravity [-].
    double gravity = 1.;
    /// Factor of the further body force [-].
    double body_force = 1.;
    /// @{
    /// For each boundary condition (displacement conditions only) and each fixed point, whether it
    /// has been removed.
    std::vector<bool> released_conditions, released_fixed_points;
    /// @}
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
   * gamma as in StaticElasticity, from the moduli of the undeformed state. The form is consistent,
   * invariant under rotation (the terms with d vanish with d), and has a symmetric tangent; its
   * linearization at u = 0 is the form of StaticElasticity. The normals N of normal
   * displacement conditions are those of the reference configuration.
   *
   * Loads and prescribed displacements are multiplied by a load factor. Initial
   * stress is not.
   *
   * Cost: weights and physical gradients at quadrature points are computed once
   * and shared by equal whole elements; the sparsity pattern is made once.
   * A quadrature of degree 2(p - 1) for whole elements keeps the order of
   * convergence (the bound for linear problems), see the results of step-nmm-2. The energy of St.
   * Venant-Kirchhoff is a polynomial of degree 4(p - 1): with that degree the result does not
   * depend on which rule an element has.
   *
   * All terms are per unit thickness. The inhomogeneities of the constraints are not multiplied
   * by the load factor.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class FiniteElasticity
  {
  public:
    /// Distributed vector of displacements [m] or forces [N/m].
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// @throws InputError if the problem does not fit the mesh, see
    /// ElasticityProblem::check(), or a point lies outside the solid.
    /// @throws NumericalFailure for a block whose supports permit a rigid motion, unless
    /// @p may_float (dynamics). With a @p ghost_penalty only assemble_at_rest() is possible; other
    /// assemblies throw an InputError.
    FiniteElasticity(const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const ElasticityProblem                 &problem,
                     bool                                     may_float = false,
                     const GhostPenalty *ghost_penalty = nullptr);
    ~FiniteElasticity();

    /**
     * Assemble the residual r = internal forces - loads at @p u (locally relevant, [m]) and
     * K = dr/du. For @p increment see NonlinearSystem::assemble(). Tangent::robust
     * omits the terms with the third derivative of W where the jump d is so large
     * (more than a tenth of 1 / Lambda, a fraction of the element) that they would destroy
     * ellipticity. This happens when a prescribed displacement has just grown. The first
     * iteration then moves the boundary to its prescribed position as in a linear problem.
     * Returns the same result on all ranks.
     */
    Deformation
    assemble(const Vector &u,
             double        load_factor,
             Tangent       tangent,
             const Vector *increment = nullptr);

    /**
     * Assemble the residual of the energy-momentum conserving scheme between the displacements
     * @p begin and @p end of a time step. The work of internal forces and of the forces of
     * conditions and ties (source/mechanics/conserving_terms.h) equals the
     * change of the strain energy and of the energy of conditions, except for the
     * work of moving supports. Internal forces and ties exert no moment in the mean
     * position. All other terms are those at the mean displacement. Prescribed
     * displacements are multiplied by the amplitudes @p first at the beginning and @p last at the
     * end, if given, otherwise by the amplitudes that were set. tangent() is the
     * derivative with respect to the mean displacement at fixed @p begin, i.e. twice that with
     * respect to @p end, and not symmetric. Of energies() only `loads`,
     * `work_of_conditions` and `dissipated` are valid afterwards.
     *
     * @p damping is the coefficient of stiffness-proportional damping [s] divided by the length
     * of the step [s]. This number times the moduli of the undeformed state times the change of
     * the Green-Lagrange strain is added to the second Piola-Kirchhoff stress.
     */
    Deformation
    assemble_between(const Vector         &begin,
                     const Vector         &end,
                     Tangent               tangent,
                     const LoadAmplitudes *first   = nullptr,
                     const LoadAmplitudes *last    = nullptr,
                     double                damping = 0.);

    /**
     * Assemble the residual of the theory of small displacements at @p u (locally relevant, [m]),
     * the derivative of the potential
     * @f[ \Pi_2(u) = \int_\Omega S_0:H + \tfrac{1}{2}H:C:H\,dA
     *     + \int_\Gamma -(S_0 + C:H):(d\otimes N) + \frac{\gamma}{2}|d|^2\,ds
     *     - \text{loads}(u), \qquad H = \nabla u, @f]
     * with the initial stress S_0 and the moduli C of the undeformed state. Rotations are neglected,
     * so that initial stress does not change the stiffness, and follower pressure keeps its
     * direction. Afterwards energies() has the first integral as `strain` and the second one, with
     * the springs of fixed points, as `conditions`. The tangent stays as it is.
     */
    void
    assemble_linearized(const Vector &u, double load_factor);

    /// Assemble the residual of the theory of small displacements at initial_solution(), and its
    /// tangent, which is the same at all u.
    void
    assemble_at_rest(double load_factor);

    /**
     * Increase the penalties gamma with the moduli A(u) at the boundary once these
     * are more than twice those of the undeformed state, e.g. under strong compression. Penalties
     * never decrease. Call this between steps only, because the
     * potential changes, though only by the order of the discretization error.
     */
    void
    adapt_penalties(const Vector &u);

    /// Set the factors of loads and conditions from the next assembly on.
    /// @throws InputError for lists of the wrong length.
    void
    set_amplitudes(const LoadAmplitudes &amplitudes);

    /**
     * Leave out absent blocks (ManifoldMesh::block()) and their ties to other blocks from the next
     * assembly on. Their rows of the tangent keep an arbitrary diagonal entry. Empty: no block
     * is absent.
     * @throws InputError for another number of blocks.
     */
    void
    set_absent_blocks(const std::vector<bool> &is_absent);

    /// Assemble only the elements of these blocks from now on. Energies and force_scale() are
    /// theirs, too.
    void
    restrict_to(const BlockSelection &blocks);

    /// Pairs of different blocks that are tied to each other, as far as this rank knows them.
    std::vector<std::pair<unsigned int, unsigned int>>
    tied_blocks() const;

    /// Number of elements on this rank that the last assembly processed.
    unsigned int
    n_assembled_elements() const;

    /// Residual of the last assembly on owned unknowns, 0 for constrained ones [N/m].
    const Vector &
    residual() const;

    /// Derivative of the residual at the last assembly with a tangent [N/m^2].
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
      /// Potential of loads that keep direction and size: minus their work at the current factors
      /// [J/m].
      double loads = 0.;
      /// Work done in assemble_between() by the change of prescribed displacements [J/m].
      double work_of_conditions = 0.;
      /// Energy dissipated by damping in assemble_between() [J/m].
      double dissipated = 0.;
    };

    /// Energies of the last assembly, summed over ranks.
    const Energies &
    energies() const;

    /// Root of the sum over elements of the squares of internal forces, of
    /// loads and of the forces of conditions in the last assembly; not less than the
    /// forces at a strain of 1e-6 [N/m].
    double
    force_scale() const;

    /**
     * Largest |d| of displacement conditions and ties of the last assembly,
     * times the Lambda of the element [-]: 1 is a jump of about a tenth of a cell.
     * At a solution it is of the order of the discretization error, and 0.1 at
     * singular corners of coarse meshes. The potential of Nitsche's
     * method is not bounded from below. A stationary point with a jump above @c largest_good_jump
     * is spurious: it is no solution of the problem.
     */
    double
    largest_jump() const;

    /// Value of largest_jump() above which a stationary point counts as spurious [-].
    static constexpr double largest_good_jump = 0.5;

    /// A vector of locally relevant unknowns that are zero except for the inhomogeneities of
    /// the constraints [m].
    Vector
    initial_solution() const;

    /// The cover system given to the constructor.
    const CoverSystem &
    cover_system() const;

    /// The problem given to the constructor.
    const ElasticityProblem &
    elasticity_problem() const;

    /// The constraints given to the constructor.
    const dealii::AffineConstraints<double> &
    affine_constraints() const;

    /// Hyperelastic law of a region of the physical mesh.
    const HyperelasticLaw &
    law(unsigned int region) const;

    /// Whether any region has an inelastic law. This class contains only the elastic part of such
    /// a law, without initial stress; InelasticTerms adds the rest.
    bool
    is_inelastic() const;

  private:
    friend class InelasticTerms;

    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
