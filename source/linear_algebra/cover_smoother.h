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
     * Smoother of a multigrid method for a symmetric positive definite matrix of 2x2
     * blocks, a block row for each cover: one Gauss-Seidel sweep over blocks, and exact
     * solutions on the covers of each cut element, one after the other. The latter because
     * what a small element holds has hardly any energy of its own while its covers reach out
     * of the solid: Gauss-Seidel alone takes off 5 % of such an error a sweep, with them
     * conjugate gradients need a third of the steps.
     *
     * post_smooth() is the transpose of pre_smooth(), so that with any symmetric positive
     * definite coarse correction between them the whole is symmetric and positive
     * definite. For that on several ranks, each of which sweeps over its own rows, half the
     * sum of the absolute values that belong to other ranks' columns is added to a row's
     * diagonal (Baker, Falgout, Kolev & Yang, SIAM J. Sci. Comput. 33 (2011) 2864).
     *
     * Memory traffic is all that counts here: values are kept in single precision, 20 bytes
     * for a block instead of 48 in an Epetra_CrsMatrix, of which the first sweep and its residual
     * read half each and the last sweep all.
     *
     * Lifetime: the matrix must outlive this object.
     */
    class CoverSmoother
    {
    public:
      /// Of a matrix of BlockSystem.
      CoverSmoother(const Epetra_CrsMatrix                  &matrix,
                    const CoverSystem                       &covers,
                    const dealii::AffineConstraints<double> &constraints);

      /// Owned block rows, and columns of other ranks beside those.
      unsigned int
      n_owned() const;

      unsigned int
      n_columns() const;

      /// Unknowns of owned covers, then of others in the order of the matrix's
      /// columns, to be multiplied by 2.
      void
      pre_smooth(const std::vector<float> &rhs,
                 std::vector<float>       &x,
                 std::vector<float>       &residual);

      /// Smooth @p x, of which owned unknowns are given.
      void
      post_smooth(const std::vector<float> &rhs, std::vector<float> &x);

    private:
      struct Patch
      {
        /// In patch_rows, and in patch_inverses.
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

      /// product = inverse * r on a patch.
      void
      solve_patch(const Patch &patch, const float *r, float *product) const;

      void
      update_ghosts(std::vector<float> &x);

      /// rhs - A x, in a row.
      void
      residual_of_row(unsigned int              row,
                      const std::vector<float> &rhs,
                      const std::vector<float> &x,
                      float                    *residual) const;

      const Epetra_CrsMatrix   *matrix;
      unsigned int              n_rows = 0, n_all = 0;
      std::vector<unsigned int> row_begin, columns;
      /// Of each row: its diagonal block, and the first block of another rank's column.
      std::vector<unsigned int> diagonal, owned_end;
      std::vector<float>        values, inverse_diagonal;
      /// What is added to the diagonal; empty on one rank.
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
