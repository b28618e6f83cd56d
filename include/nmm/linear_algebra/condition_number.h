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
   * Diagonal scaling removes the influence of units and of the materials' stiffness; what
   * remains is the influence of the way the covers are cut.
   */
  struct ConditionNumber
  {
    /// @{
    /// Smallest and largest eigenvalue of the scaled matrix [-]. The smallest one is 0 if the
    /// matrix is singular to rounding.
    double smallest = 0., largest = 0.;
    /// @}
    /// Cover with the largest entry of the eigenvector of the smallest eigenvalue, where the
    /// matrix is closest to singular; invalid_index if the matrix is singular to rounding.
    unsigned int weakest_cover = invalid_index;
    /// Node of weakest_cover [m].
    dealii::Point<2> weakest_node;
    /// @{
    /// Steps of the Lanczos iterations for the largest eigenvalue (a product with the matrix
    /// each) and for the smallest one (a solve each).
    unsigned int n_products = 0, n_solves = 0;
    /// @}

    /// The condition number largest / smallest [-]; infinite for a singular matrix.
    double
    value() const;
  };

  /**
   * Estimate the extreme eigenvalues by Lanczos' iteration with full reorthogonalization: the
   * largest one with products with the scaled matrix, the smallest one with solves (one direct
   * factorization). An iteration ends when the residual proves an eigenvalue within @p tolerance
   * [-] (relative) of the Ritz value, or after 150 steps. The result is an estimate of the
   * condition number from below. The start vector depends on the numbers of the unknowns only.
   * Cost: a factorization, some 20 solves and some 50 products.
   *
   * Reference: Parlett, The Symmetric Eigenvalue Problem, chap. 13.
   * @throws NumericalFailure if a diagonal entry of the matrix is not positive. A matrix that
   * cannot be factorized counts as singular.
   */
  ConditionNumber
  estimate_condition_number(
    const dealii::TrilinosWrappers::SparseMatrix &matrix,
    const CoverSystem                            &covers,
    const dealii::AffineConstraints<double>      &constraints,
    double                                        tolerance = 1e-2);
} // namespace NMM

#endif
