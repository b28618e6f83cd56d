#ifndef nmm_source_linear_algebra_linear_solver_h
#define nmm_source_linear_algebra_linear_solver_h

#include <nmm/covers/cover_system.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// What solve_linear_system() returns.
    struct LinearSolution
    {
      /// One for each right-hand side.
      std::vector<dealii::TrilinosWrappers::MPI::Vector> solutions;
      /// Samples of how much rounding changes the first of them.
      std::vector<dealii::TrilinosWrappers::MPI::Vector> effects;
      LinearSolverReport                                 report;
    };


    /**
     * Solve the symmetric positive definite systems A x = b for all right-hand sides b, with one
     * factorization or preconditioner; see LinearSolverParameters. The report has the iterations
     * and the residual of the system that had most.
     *
     * LinearSolution::effects are samples e of how much rounding changes the first solution x: if each
     * product A_ij x_j and each b_i is wrong by its rounding, x is off by e with A e = r,
     * r_i = +-epsilon (sum_j |A_ij x_j| + |b_i|) (Higham, Accuracy and Stability of Numerical
     * Algorithms, section 7.2: componentwise errors). Signs are random, since roundings add up
     * as random numbers do. LinearSolverReport::rounding_effect is the largest |e| / |x|.
     *
     * A cautious estimate needs no x in r, so that it is found together with x, which takes hardly
     * more time than x alone: 2 max_j |x_j| |e| / |x|, where e is the sample for x_j = 1 and b = 0,
     * and the factor 2 is for b_i = sum_j A_ij x_j. If it is at most 1e-8, it is the
     * rounding_effect, and there are no samples; nor are there any with the iterative solver.
     * @throws NumericalFailure if the factorization fails or the iteration does
     * not converge.
     */
    LinearSolution
    solve_linear_system(
      const dealii::TrilinosWrappers::SparseMatrix                     &matrix,
      const std::vector<const dealii::TrilinosWrappers::MPI::Vector *> &rhs,
      const CoverSystem                                                &covers,
      const dealii::AffineConstraints<double> &constraints,
      const LinearSolverParameters            &parameters);
  } // namespace internal
} // namespace NMM

#endif
