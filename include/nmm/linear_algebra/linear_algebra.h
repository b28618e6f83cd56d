#ifndef nmm_linear_algebra_linear_algebra_h
#define nmm_linear_algebra_linear_algebra_h

#include <nmm/linear_algebra/body_matrix.h>
#include <nmm/linear_algebra/condition_number.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>

/**
 * @defgroup linear_algebra Linear algebra
 *
 * Assembly of sparse matrices from local matrices of covers, and solution of A x = b. This
 * module knows covers and constraints, but neither the terms of the elements nor contact. No
 * other module uses Epetra, Amesos, ML, MUMPS or KLU directly.
 *
 * **In**: a CoverSystem, its AffineConstraints, and local matrices (2n x 2n) [N/m^2] of n
 * covers. **Out**: the solution as a distributed vector, and a report with iterations, times
 * and memory.
 *
 * | file (those without a folder: source/linear_algebra) | job |
 * |---|---|
 * | cover_matrix_assembler.h | sums local matrices and right-hand sides into a sparse system |
 * | nmm/linear_algebra/body_matrix.h | dense couplings of many small bodies, instead of a sparse matrix |
 * | matrix_sum.h | adds a matrix of a smaller pattern, in selected rows |
 * | active_items.h | lists of rows, elements or points that belong to selected blocks |
 * | linear_solver.h | one symmetric positive definite system, direct or iterative |
 * | direct_solver.h | a factorization that is used many times; selects one of the direct solvers |
 * | direct_factorization.h | the interface of direct solvers |
 * | mumps_factorization.h, klu_factorization.h, body_lu.h | the direct solvers |
 * | two_level_preconditioner.h, cover_smoother.h, linear_covers.h | the preconditioner of conjugate gradients |
 * | nmm/linear_algebra/linear_solver_parameters.h | choice of the solver, and measurements |
 * | nmm/linear_algebra/condition_number.h | condition number and weakest cover of a matrix |
 *
 * Order of calls for a matrix that is assembled and factorized repeatedly:
 * @code
 * CoverMatrixAssembler assembler(covers, constraints);    // couples all elements
 * for (const auto &pair : tied_pairs)
 *   assembler.couple(pair.covers);                        // couplings beyond elements
 * assembler.build(matrix, rhs);                           // makes the sparsity pattern
 * DirectSolver solver(DirectSolver::Symmetry::symmetric);
 * while (!has_converged)
 *   {
 *     assembler.reset();
 *     for (unsigned int e = first; e < last; ++e)
 *       assembler.add(covers.covers(e), local_matrix(e), local_rhs(e));
 *     assembler.compress();                               // sends values to their owners
 *     solver.factorize(matrix);
 *     solver.solve(rhs, solution);
 *     constraints.distribute(solution);
 *   }
 * @endcode
 * A system that is solved only once uses internal::solve_linear_system() instead.
 *
 * To add a direct solver, implement DirectFactorization in a file of its own and select it
 * in DirectSolver. Failures (a singular matrix, lack of memory, iterations that do not
 * converge) throw NumericalFailure.
 */

#endif
