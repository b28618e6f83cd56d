#ifndef nmm_linear_algebra_condition_number_h
#define nmm_linear_algebra_condition_number_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace NMM
{
  /**
   * The spectral condition number of a symmetric positive definite matrix A
   * after diagonal scaling,
   * @f[ \kappa = \lambda_{max} / \lambda_{min} \quad\text{of}\quad
   *     D^{-1/2} A\,D^{-1/2},\quad D = diag\,A, @f]
   * on the free unknowns: rows of constrained ones are decoupled and left out.
   * Diagonal scaling takes units and stiffness of materials out; what it leaves
   * is what a cut does to the basis.
   */
  struct ConditionNumber
  {
    /// Extreme eigenvalues of the scaled matrix [-]; smallest = 0 if the matrix
    /// is singular to rounding.
    double smallest = 0., largest = 0.;
    /// Cover with the largest share in the eigenvector of the smallest
    /// eigenvalue: where the matrix is weakest; invalid_index if it is
    /// singular.
    unsigned int weakest_cover = invalid_index;
    /// Its node [m].
    dealii::Point<2> weakest_node;
    /// Steps of the two Lanczos iterations.
    unsigned int n_products = 0, n_solves = 0;

    /// largest / smallest [-], infinite for a singular matrix.
    double
    value() const;
  };

  /**
   * Both ends by Lanczos' iteration with full reorthogonalization, the largest
   * eigenvalue with products by the scaled matrix, the smallest with solves
   * (one direct factorization). Ends when the residual shows an eigenvalue
   * within @p tolerance [-] (relative) of the Ritz value: a sharp estimate from
   * below. The start vector follows from the numbers of the unknowns alone.
   * Cost: a factorization and some 20 solves, and some 50 products.
   *
   * Reference: Parlett, The Symmetric Eigenvalue Problem, chap. 13.
   * @throws NumericalFailure for a matrix with a diagonal entry that is not
   * positive, or lack of memory.
   */
  ConditionNumber
  estimate_condition_number(
    const dealii::TrilinosWrappers::SparseMatrix &matrix,
    const CoverSystem                            &covers,
    const dealii::AffineConstraints<double>      &constraints,
    double                                        tolerance = 1e-2);
} // namespace NMM

#endif
