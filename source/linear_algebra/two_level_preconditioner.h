#ifndef nmm_source_linear_algebra_two_level_preconditioner_h
#define nmm_source_linear_algebra_two_level_preconditioner_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <linear_algebra/cover_smoother.h>
#include <linear_algebra/linear_covers.h>
#include <memory>

namespace ML_Epetra
{
  class MultiLevelPreconditioner;
}

namespace NMM
{
  namespace internal
  {
    /**
     * The rigid-body modes, which are the near-null space that smoothed aggregation must
     * preserve: the values of both translations and of the rotation about the centre of the solid
     * at the nodes of the n @p covers (global numbers of owned ones). Each mode has two values per
     * cover, which are zero where constrained; the modes are stored one after the other (3 x 2n).
     */
    std::vector<double>
    rigid_body_modes(const CoverSystem                       &cover_system,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<unsigned int>         &covers);

    /// Make smoothed aggregation multigrid (ML) for a matrix with the near-null space @p modes.
    /// Its smoothers are Chebyshev polynomials of degree @p n_sweeps for the eigenvalues between
    /// the largest one divided by @p spectrum and the largest one.
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner>
    make_aggregation_multigrid(const Epetra_RowMatrix    &matrix,
                               const std::vector<double> &modes,
                               unsigned int               n_sweeps,
                               double                     spectrum);


    /**
     * Preconditioner of the stiffness matrix of second order on covers. One application
     * consists of CoverSmoother::pre_smooth(), a correction by displacements of first order on the
     * same covers (LinearCovers), computed by one cycle of ML, and
     * CoverSmoother::post_smooth(). It is symmetric and positive definite.
     *
     * Processor time of a solution by conjugate gradients (set-up included) and
     * iterations, with this preconditioner and with smoothed aggregation (ML, rigid-body modes) of
     * the matrix of second order; the problems are those of
     * LinearSolverParameters:
     *
     * |         | unknowns | this [s] | iterations | ML [s] | iterations |
     * |---------|---------:|-----:|----:|-----:|----:|
     * | ring    |   91,020 | 0.36 |  21 | 1.20 |  45 |
     * | ring    |  177,772 | 0.98 |  29 | 3.61 |  51 |
     * | ring    |  393,284 | 1.99 |  25 | 9.06 |  52 |
     * | beam    |  111,634 | 0.57 |  26 | 2.19 |  61 |
     * | jointed |  135,174 | 2.87 |  64 | 14.7 | 327 |
     *
     * The matrix of second order has 22 nonzeros per row. Smoothed aggregation of this matrix
     * reads it ten times per iteration, because it needs four sweeps before and
     * after the coarse correction; this preconditioner reads it three times. The matrix of first
     * order has a seventh of the nonzeros.
     *
     * Lifetime: the matrix must outlive this object.
     */
    class TwoLevelPreconditioner
    {
    public:
      /// @p covers must be of second order. Collective.
      TwoLevelPreconditioner(
        const dealii::TrilinosWrappers::SparseMatrix &matrix,
        const CoverSystem                            &covers,
        const dealii::AffineConstraints<double>      &constraints);

      ~TwoLevelPreconditioner();

      /// Set @p dst to the preconditioner times @p src.
      void
      vmult(dealii::TrilinosWrappers::MPI::Vector       &dst,
            const dealii::TrilinosWrappers::MPI::Vector &src) const;

    private:
      mutable CoverSmoother smoother;
      LinearCovers          linear_covers;
      /// Matrix P^T A P of first order and its multigrid solver; null if all covers are
      /// constrained.
      std::unique_ptr<Epetra_CrsMatrix>                    coarse_matrix;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> coarse;

      mutable std::vector<float> rhs, x, residual;
    };
  } // namespace internal
} // namespace NMM

#endif
