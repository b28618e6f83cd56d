#ifndef nmm_linear_algebra_linear_algebra_h
#define nmm_linear_algebra_linear_algebra_h

#include <nmm/linear_algebra/body_matrix.h>
#include <nmm/linear_algebra/condition_number.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>

/**
 * @defgroup linear_algebra Linear algebra
 *
 * Matrices that covers assemble into, and the solution of A x = b. This room knows covers
 * and constraints, but neither elements' terms nor contact. Nothing outside of it
 * names Epetra, Amesos, ML, MUMPS or KLU.
 *
 * **In**: a CoverSystem, its AffineConstraints, and local matrices (2n x 2n) [N/m^2] of n
 * covers. **Out**: the solution as a distributed vector, and what it took.
 *
 * | file (those without a folder: source/linear_algebra) | job |
 * |---|---|
 * | cover_matrix_assembler.h | the sparse matrix and right-hand side that covers assemble into |
 * | nmm/linear_algebra/body_matrix.h | dense couplings of many small bodies, instead of a sparse matrix |
 * | matrix_sum.h | k K + m M + c C for matrices with patterns of each other |
 * | active_items.h | rows, elements or points of chosen blocks |
 * | linear_solver.h | one symmetric positive definite system, direct or iterative |
 * | direct_solver.h | a factorization that is used many times; chooses the solver |
 * | direct_factorization.h | the interface of direct solvers |
 * | mumps_factorization.h, klu_factorization.h, body_lu.h | the direct solvers |
 * | two_level_preconditioner.h, cover_smoother.h, linear_covers.h | the preconditioner of conjugate gradients |
 * | nmm/linear_algebra/linear_solver_parameters.h | which solver, and the measurements behind the choice |
 * | nmm/linear_algebra/condition_number.h | condition number and weakest place of a matrix |
 *
 * Order of calls, for a matrix that is assembled and solved with again and again:
 * @code
 * CoverMatrixAssembler assembler(covers, constraints);    // couples all elements
 * for (const auto &pair : tied_pairs)
 *   assembler.couple(pair.covers);                        // what else is coupled
 * assembler.build();                                      // the pattern
 * DirectSolver solver(DirectSolver::Symmetry::symmetric);
 * while (!has_converged)
 *   {
 *     assembler.reset();
 *     for (unsigned int e = first; e < last; ++e)
 *       assembler.add(covers.covers(e), local_matrix(e), local_rhs(e));
 *     assembler.transfer(matrix, rhs);                    // to Trilinos
 *     solver.factorize(matrix);
 *     solver.solve(rhs, solution);
 *     constraints.distribute(solution);
 *   }
 * @endcode
 * A system that is solved once takes CoverMatrixAssembler::finish() and
 * internal::solve_linear_system().
 *
 * To add a direct solver, implement DirectFactorization in a file of its own and name it
 * in DirectSolver. Failures are NumericalFailure (singular matrix, lack of memory,
 * iterations that do not converge).
 */

#endif
