#ifndef nmm_source_linear_algebra_cover_smoother_h
#define nmm_source_linear_algebra_cover_smoother_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <vector>

class Epetra_CrsMatrix;
class Epetra_Vector;

namespace NMM
{
  namespace internal
  {
    /**
     * Smoother of a multigrid method for a symmetric positive definite matrix of 2 x 2
     * entries, a row of them for each cover. It consists of one Gauss-Seidel sweep over
     * the rows, and of exact solutions on the covers of each cut element, one element after
     * the other. The latter are needed because a small element has hardly any energy
     * while its covers reach far out of the solid: Gauss-Seidel alone takes off 5 % of
     * such an error in a sweep, and conjugate gradients need three times the iterations.
     *
     * post_smooth() is the transpose of pre_smooth(), so that with any symmetric positive
     * definite coarse correction between them the whole is symmetric and positive
     * definite. On several ranks each sweeps over its own rows; for the same to hold,
     * half the sum of the absolute values in other ranks' columns is added to the
     * diagonal of a row (Baker, Falgout, Kolev & Yang, SIAM J. Sci. Comput. 33 (2011)
     * 2864).
     *
     * Time is spent on reading memory. Values are therefore kept in single precision: 20
     * bytes for an entry with its column instead of 48 in an Epetra_CrsMatrix. The first
     * sweep and its residual read half of the entries each, the last sweep all.
     *
     * Lifetime: the matrix must outlive this object.
     */
    class CoverSmoother
    {
    public:
      /// @p matrix: made by CoverMatrixAssembler.
      CoverSmoother(const Epetra_CrsMatrix                  &matrix,
                    const CoverSystem                       &covers,
                    const dealii::AffineConstraints<double> &constraints);

      /// Number of owned covers, which are the rows.
      unsigned int
      n_owned() const;

      /// Number of columns: owned covers, then those of other ranks.
      unsigned int
      n_columns() const;

      /// Set x = B b and the residual b - A x, where B is this smoother. @p rhs and
      /// @p residual have two values for each row, @p x two for each column.
      void
      pre_smooth(const std::vector<float> &rhs,
                 std::vector<float>       &x,
                 std::vector<float>       &residual);

      /// Set x = x + B^T (b - A x); given are the values of owned covers.
      void
      post_smooth(const std::vector<float> &rhs, std::vector<float> &x);

    private:
      struct Patch
      {
        /// Its part of patch_rows, and where its inverse begins in patch_inverses.
        unsigned int begin, end;
        std::size_t  inverse;
      };

      void
      read(const Epetra_CrsMatrix &matrix);

      void
      invert_diagonals();

      void
      make_patches(const CoverSystem                       &covers,
                   const dealii::AffineConstraints<double> &constraints);

      void
      add_patch(const std::vector<unsigned int> &rows);

      /// Set product = inverse * r on a patch.
      void
      solve_patch(const Patch &patch, const float *r, float *product) const;

      /// Get the values of covers of other ranks from those.
      void
      update_ghosts(std::vector<float> &x);

      /// The two components of b - A x in a row.
      void
      residual_of_row(unsigned int              row,
                      const std::vector<float> &rhs,
                      const std::vector<float> &x,
                      float                    *residual) const;

      const Epetra_CrsMatrix   *matrix;
      unsigned int              n_rows = 0, n_all = 0;
      std::vector<unsigned int> row_begin, columns;
      /// For each row the position of its diagonal entry, and of the first entry in a
      /// column of another rank.
      std::vector<unsigned int> diagonal, owned_end;
      std::vector<float>        values, inverse_diagonal;
      /// What is added to the diagonal, empty on one rank; and x before smoothing.
      std::vector<float> addition, start;

      std::vector<Patch>        patches;
      std::vector<unsigned int> patch_rows;
      std::vector<float>        patch_inverses;
      /// Scratch for one patch.
      std::vector<float> patch_residual, patch_solution;
    };
  } // namespace internal
} // namespace NMM

#endif
