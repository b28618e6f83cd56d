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
     * Translations and the rotation about the solid's centre at the nodes of @p covers
     * (global numbers of owned ones), two unknowns each, zero where constrained: the
     * near-null space that smoothed aggregation must keep. One mode after the other.
     */
    std::vector<double>
    rigid_body_modes(const CoverSystem                       &cover_system,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<unsigned int>         &covers);

    /// Smoothed aggregation (ML) for a matrix of that near-null space.
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner>
    make_aggregation_multigrid(const Epetra_RowMatrix    &matrix,
                               const std::vector<double> &modes,
                               unsigned int               n_sweeps,
                               double                     spectrum);


    /**
     * Preconditioner of the stiffness of second order on covers: CoverSmoother, the
     * displacements of first order on the same covers (LinearCovers) as coarse space, and for
     * these one cycle of ML.
     *
     * Smoothed aggregation of the matrix of second order itself needs twice the steps, and in
     * each step reads that matrix ten times instead of three: 22 non-zeros per row and four
     * sweeps before and after. The matrix of first order has a seventh of its non-zeros.
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

      /// @p dst = M^-1 @p src.
      void
      vmult(dealii::TrilinosWrappers::MPI::Vector       &dst,
            const dealii::TrilinosWrappers::MPI::Vector &src) const;

    private:
      mutable CoverSmoother                                smoother;
      LinearCovers                                         linear_covers;
      std::unique_ptr<Epetra_FECrsMatrix>                  coarse_matrix;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> coarse;

      mutable std::vector<float>             rhs, x, residual;
      mutable std::unique_ptr<Epetra_Vector> coarse_rhs, coarse_x;
    };
  } // namespace internal
} // namespace NMM

#endif
