#ifndef nmm_source_linear_algebra_linear_solver_h
#define nmm_source_linear_algebra_linear_solver_h

#include <nmm/covers/cover_system.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace NMM
{
  namespace internal
  {
    /**
     * Solve the symmetric positive definite system A x = b; see
     * LinearSolverParameters.
     * @throws NumericalFailure if the factorization fails or the iteration does
     * not converge.
     */
    LinearSolverReport
    solve_linear_system(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const dealii::TrilinosWrappers::MPI::Vector  &rhs,
                        const CoverSystem                            &covers,
                        const dealii::AffineConstraints<double> &constraints,
                        const LinearSolverParameters            &parameters,
                        dealii::TrilinosWrappers::MPI::Vector   &solution);
  } // namespace internal
} // namespace NMM

#endif
