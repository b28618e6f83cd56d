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
 * | extended_matrix.h | a copy of a matrix with further couplings, for forces between blocks |
 * | chosen_items.h | lists of rows, elements or points that belong to selected blocks |
 * | linear_solver.h | symmetric positive definite systems with one matrix, direct or iterative |
 * | matrix_rows.h | the rows of this rank of an Epetra matrix, as arrays |
 * | direct_solver.h | a factorization that is used many times; selects one of the direct solvers |
 * | direct_factorization.h | the interface of direct solvers |
 * | mumps_factorization.h, klu_factorization.h, body_lu.h | the direct solvers |
 * | two_level_preconditioner.h, cover_smoother.h, linear_covers.h | the preconditioner of conjugate gradients for second order; that for first order is in linear_solver.cc |
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
 * A matrix that is solved with only once (linear statics) uses internal::solve_linear_system()
 * instead. Only this function can iterate: the steps of Newton's method are direct.
 *
 * To add a direct solver, implement DirectFactorization in a file of its own, list it in
 * source/linear_algebra/CMakeLists.txt, make it a member of DirectSolver that factorize_sparse()
 * asks before MUMPS (and forget_analysis() tells, if it keeps an analysis), and test it in
 * tests/linear_algebra/direct_solver_test.cc. A library that it needs is found in
 * cmake/NmmFindPrivateDependencies.cmake and has its line in doc/dependencies.md. To add a
 * preconditioner, write a class with a constructor from (matrix, covers, constraints) and a
 * function vmult(dst, src) const that is symmetric and positive definite, list its source, select
 * it in solve_linear_system(), where the order of the covers decides, and test it in
 * tests/mechanics/iterative_test.cc. What scenes choose is LinearSolverParameters::Type: a new word
 * is also one in source/scene/scene_parameters.cc and doc/parameters.md.
 *
 * A singular matrix and lack of memory throw NumericalFailure; so do iterations that do not
 * converge, unless the solver was chosen automatically, which then factorizes.
 */

#endif
