#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <linear_algebra/two_level_preconditioner.h>
#include <ml_MultiLevelPreconditioner.h>

namespace NMM
{
  namespace internal
  {
    std::vector<double>
    rigid_body_modes(const CoverSystem                       &cover_system,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<unsigned int>         &covers)
    {
      const auto &box = cover_system.manifold_mesh()
                          .physical_mesh()
                          .bounding_box()
                          .get_boundary_points();
      const dealii::Point<2> center(0.5 * (box.first + box.second));
      const double           size = box.first.distance(box.second);

      const unsigned int  n = 2 * covers.size();
      std::vector<double> modes(3 * n, 0.);
      unsigned int        i = 0;
      for (const unsigned int k : covers)
      {
        const dealii::Tensor<1, 2> d = (cover_system.node(k) - center) / size;
        for (unsigned int c = 0; c < 2; ++c, ++i)
          if (!constraints.is_constrained(unknown_of(k, c)))
          {
            modes[c * n + i] = 1.;
            modes[2 * n + i] = c == 0 ? -d[1] : d[0];
          }
      }
      return modes;
    }


    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner>
    make_aggregation_multigrid(const Epetra_RowMatrix    &matrix,
                               const std::vector<double> &modes,
                               const unsigned int         n_sweeps,
                               const double               spectrum)
    {
      Teuchos::ParameterList ml;
      ML_Epetra::SetDefaults("SA", ml);
      ml.set("ML output", 0);
      ml.set("PDE equations", 2);
      ml.set("null space: type", "pre-computed");
      ml.set("null space: dimension", 3);
      ml.set("null space: vectors", const_cast<double *>(modes.data()));
      ml.set("null space: add default vectors", false);
      ml.set("aggregation: type", "Uncoupled");
      ml.set("aggregation: threshold", 0.);
      ml.set("smoother: type", "Chebyshev");
      ml.set("smoother: sweeps", static_cast<int>(n_sweeps));
      ml.set("smoother: Chebyshev alpha", spectrum);
      ml.set("coarse: max size", 500);
      ml.set("coarse: type", "Amesos-KLU");
      return std::make_unique<ML_Epetra::MultiLevelPreconditioner>(matrix, ml);
    }


    TwoLevelPreconditioner::TwoLevelPreconditioner(
      const dealii::TrilinosWrappers::SparseMatrix &matrix,
      const CoverSystem                            &covers,
      const dealii::AffineConstraints<double>      &constraints)
      : smoother(matrix.trilinos_matrix(), covers, constraints)
      , linear_covers(matrix.trilinos_matrix(), covers, constraints)
      , rhs(2 * smoother.n_owned())
      , x(2 * smoother.n_columns())
      , residual(2 * smoother.n_owned())
    {
      if (linear_covers.interpolation().NumGlobalCols() == 0)
        return;
      coarse_matrix = linear_covers.multiply(matrix.trilinos_matrix());
      coarse        = make_aggregation_multigrid(
        *coarse_matrix,
        rigid_body_modes(covers,
                         constraints,
                         linear_covers.covers_of_unknowns()),
        2,
        20.);
    }


    TwoLevelPreconditioner::~TwoLevelPreconditioner() = default;


    void
    TwoLevelPreconditioner::vmult(
      dealii::TrilinosWrappers::MPI::Vector       &dst,
      const dealii::TrilinosWrappers::MPI::Vector &src) const
    {
      std::copy(src.begin(), src.end(), rhs.begin());
      smoother.pre_smooth(rhs, x, residual);
      if (coarse)
      {
        const Epetra_CrsMatrix &P = linear_covers.interpolation();
        Epetra_Vector fine(P.RangeMap()), r(P.DomainMap()), v(P.DomainMap());
        std::copy(residual.begin(), residual.end(), fine.Values());
        P.Multiply(true, fine, r);
        coarse->ApplyInverse(r, v);
        P.Multiply(false, v, fine);
        for (int i = 0; i < fine.MyLength(); ++i)
          x[i] += fine[i];
      }
      smoother.post_smooth(rhs, x);
      std::copy(x.begin(), x.begin() + rhs.size(), dst.begin());
    }
  } // namespace internal
} // namespace NMM
