#ifndef nmm_mechanics_static_elasticity_h
#define nmm_mechanics_static_elasticity_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace NMM
{
  /**
   * Linear static elasticity on a cover system: stiffness (7), initial stress
   * (9), body force (10), point force (11), fixed point (12), and loads and displacements on
   * boundary pieces, assembled into Trilinos objects.
   *
   * Displacement conditions are imposed weakly by Nitsche's method,
   * @f[ -\int_\Gamma (B\sigma(u)n)\cdot v -\int_\Gamma (B\sigma(v)n)\cdot(u-g)
   *     +\int_\Gamma \frac{\gamma}{h}\,B(u-g)\cdot v @f]
   * with B the projection onto the prescribed component(s) or n n^T: consistent,
   * hence of full order. sigma includes the initial stress where it stands for
   * the traction. The penalty gamma / h is four times the bound that a discrete
   * trace inequality, solved on each element, gives: no number to choose, and
   * coercive however the element is cut. Material interfaces and closed joints
   * are tied the same way, with averages weighted by stiffness and size. Open
   * joints and boundaries shared by two domains carry nothing.
   *
   * A condition on a curve holds on all elements along it; where boundaries of two
   * domains coincide, that is both sides.
   *
   * All terms are per unit thickness. Constrained unknowns (aggregated covers)
   * are eliminated; their rows keep a diagonal entry. With a ghost penalty its
   * terms are added.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class StaticElasticity
  {
  public:
    /// @throws InputError if the problem does not fit the mesh, see
    /// ElasticityProblem::check(), or a point lies outside the solid.
    StaticElasticity(const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const ElasticityProblem                 &problem,
                     const GhostPenalty *ghost_penalty = nullptr);

    /**
     * Sparsity, matrix and right-hand side. With @p timer, in sections
     * "sparsity", "assembly" and "to Trilinos".
     * @throws NumericalFailure for a block that floats freely, naming it: one
     * whose displacement conditions and fixed points leave a rigid motion.
     */
    void
    assemble(dealii::TimerOutput *timer = nullptr);

    /// @throws NumericalFailure for a singular system or when the iteration does
    /// not converge.
    LinearSolverReport
    solve(const LinearSolverParameters &parameters);

    /// Displacements of covers [m], locally relevant, constraints distributed.
    const dealii::TrilinosWrappers::MPI::Vector &
    solution() const;

    const dealii::TrilinosWrappers::SparseMatrix &
    system_matrix() const;

    const dealii::TrilinosWrappers::MPI::Vector &
    system_rhs() const;

  private:
    const CoverSystem                       *covers;
    const QuadratureCollection              *quadrature;
    const dealii::AffineConstraints<double> *constraints;
    const ElasticityProblem                 *problem;
    const GhostPenalty                      *ghost_penalty;

    dealii::TrilinosWrappers::SparseMatrix matrix;
    dealii::TrilinosWrappers::MPI::Vector  rhs;
    dealii::TrilinosWrappers::MPI::Vector  relevant_solution;
  };
} // namespace NMM

#endif
