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
    /**
     * Solve the symmetric positive definite systems A x = b for all right-hand sides b, with one
     * factorization or preconditioner; see LinearSolverParameters. The report has the iterations
     * and the residual of the system that had most.
     * @throws NumericalFailure if the factorization fails or the iteration does
     * not converge.
     */
    LinearSolverReport
    solve_linear_system(
      const dealii::TrilinosWrappers::SparseMatrix                     &matrix,
      const std::vector<const dealii::TrilinosWrappers::MPI::Vector *> &rhs,
      const CoverSystem                                                &covers,
      const dealii::AffineConstraints<double>            &constraints,
      const LinearSolverParameters                       &parameters,
      std::vector<dealii::TrilinosWrappers::MPI::Vector> &solutions);
  } // namespace internal
} // namespace NMM

#endif
