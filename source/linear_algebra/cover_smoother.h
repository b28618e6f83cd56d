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
     * Multigrid smoother for a symmetric positive definite matrix of 2 x 2
     * entries, with one row of entries for each cover. It consists of one Gauss-Seidel sweep over
     * the rows, and of exact solutions on the covers of each cut element, one element after
     * the other. The latter are needed because displacements of a small element have hardly any
     * energy while its covers reach far out of the solid. Without them a Gauss-Seidel sweep
     * reduces such an error by 5 % only, and conjugate gradients need three times the iterations.
     *
     * post_smooth() is the transpose of pre_smooth(), so that with any symmetric positive
     * definite coarse correction between them the preconditioner is symmetric and positive
     * definite. On several ranks each rank sweeps over its own rows. To keep the preconditioner
     * positive definite, half the sum of the absolute values in other ranks' columns is then added
     * to the diagonal of a row (Baker, Falgout, Kolev & Yang, SIAM J. Sci. Comput. 33 (2011)
     * 2864).
     *
     * Memory bandwidth limits the speed. Values are therefore stored in single precision: 20
     * bytes for an entry with its column instead of 48 in an Epetra_CrsMatrix. The first
     * sweep and its residual read half of the entries each, the last sweep all of them.
     *
     * Lifetime: the matrix must outlive this object.
     */
    class CoverSmoother
    {
    public:
      /// @p matrix must have been made by CoverMatrixAssembler.
      CoverSmoother(const Epetra_CrsMatrix                  &matrix,
                    const CoverSystem                       &covers,
                    const dealii::AffineConstraints<double> &constraints);

      /// Number of owned covers, which are the rows.
      unsigned int
      n_owned() const;

      /// Number of columns: owned covers, then those of other ranks.
      unsigned int
      n_columns() const;

      /// Compute x = B b and the residual b - A x, where B is this smoother and b is @p rhs.
      /// @p rhs and @p residual have two values for each row, @p x two for each column.
      void
      pre_smooth(const std::vector<float> &rhs,
                 std::vector<float>       &x,
                 std::vector<float>       &residual);

      /// Replace x by x + B^T (b - A x). Initially @p x needs the values of owned covers only.
      void
      post_smooth(const std::vector<float> &rhs, std::vector<float> &x);

    private:
      /// The covers of a cut element, on which the matrix is inverted.
      struct Patch
      {
        /// Range of its rows in patch_rows, and index of its inverse in patch_inverses.
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

      /// Receive the values of covers that other ranks own.
      void
      update_ghosts(std::vector<float> &x);

      /// Compute the two components of b - A x in a row.
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
      /// Values added to the diagonal (empty on one rank), and x before smoothing.
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
