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
     * Rigid-body modes, the near-null space that smoothed aggregation has to preserve:
     * both translations and the rotation about the solid's centre at the nodes of
     * @p covers (global numbers of owned ones), two unknowns each, zero where
     * constrained. One mode after the other, (3 x 2n).
     */
    std::vector<double>
    rigid_body_modes(const CoverSystem                       &cover_system,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<unsigned int>         &covers);

    /// Smoothed aggregation (ML) for a matrix with these modes as near-null space.
    /// Smoothers are Chebyshev polynomials of degree @p n_sweeps for eigenvalues from the
    /// largest down to 1 / @p spectrum of it.
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner>
    make_aggregation_multigrid(const Epetra_RowMatrix    &matrix,
                               const std::vector<double> &modes,
                               unsigned int               n_sweeps,
                               double                     spectrum);


    /**
     * Preconditioner of the stiffness matrix of second order on covers. One application
     * is CoverSmoother::pre_smooth(), a correction by displacements of first order on the
     * same covers (LinearCovers), for which one cycle of ML is the solver, and
     * CoverSmoother::post_smooth(). It is symmetric and positive definite.
     *
     * Processor time of a solution by conjugate gradients, set-up included [s], and
     * iterations, with this and with smoothed aggregation (ML, rigid-body modes) of the
     * matrix of second order, by turns; the problems are those of
     * LinearSolverParameters:
     *
     * |         | unknowns | this |     | ML   |     |
     * |---------|---------:|-----:|----:|-----:|----:|
     * | ring    |   91,020 | 0.36 |  21 | 1.20 |  45 |
     * | ring    |  177,772 | 0.98 |  29 | 3.61 |  51 |
     * | ring    |  393,284 | 1.99 |  25 | 9.06 |  52 |
     * | beam    |  111,634 | 0.57 |  26 | 2.19 |  61 |
     * | jointed |  135,174 | 2.87 |  64 | 14.7 | 327 |
     *
     * Aggregation of the matrix of second order reads it ten times in an iteration
     * instead of three times: it has 22 non-zeros per row and needs four sweeps before and
     * after. The matrix of first order has a seventh of its non-zeros.
     *
     * Lifetime: the matrix must outlive this object.
     */
    class TwoLevelPreconditioner
    {
    public:
      /// Collective. Second order only.
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
      /// Null if no cover takes part.
      std::unique_ptr<Epetra_CrsMatrix>                    coarse_matrix;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> coarse;

      mutable std::vector<float> rhs, x, residual;
    };
  } // namespace internal
} // namespace NMM

#endif
