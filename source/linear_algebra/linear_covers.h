#ifndef nmm_source_linear_algebra_linear_covers_h
#define nmm_source_linear_algebra_linear_covers_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <Epetra_FECrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <array>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Displacements of first order among those of second order on the same cover system:
     * values at corner nodes, and their mean at a mid-side node,
     * @f[ u_k = \tfrac12 (v_{a(k)} + v_{b(k)}), \qquad u = P v. @f]
     * The cover of a mid-side node is a piece of the supports of both ends, so that a(k) and b(k)
     * are physical covers, and nothing couples across a joint. Covers that are constrained to
     * others (aggregation) take no part: who is not has ends that are not.
     */
    class LinearCovers
    {
    public:
      static constexpr unsigned int none = -1;

      /// Collective. @p matrix: of second order, of CoverMatrixAssembler.
      LinearCovers(const Epetra_CrsMatrix                  &matrix,
                   const CoverSystem                       &covers,
                   const dealii::AffineConstraints<double> &constraints);

      /// Unknowns of first order, of all ranks.
      unsigned int
      n_unknowns() const;

      /// P^T A P of the matrix of the constructor. Collective.
      std::unique_ptr<Epetra_FECrsMatrix>
      multiply(const Epetra_CrsMatrix &matrix) const;

      /// result = P^T r, @p r being of owned unknowns of second order.
      void
      restrict_to(const std::vector<float> &r, Epetra_Vector &result) const;

      /// x += P v.
      void
      add_interpolated(const Epetra_Vector &v, std::vector<float> &x) const;

      const Epetra_Map &
      map() const;

      /// Covers of this rank that are unknowns of first order, as numbered by the cover
      /// system, in the order of those.
      const std::vector<unsigned int> &
      covers_of_rows() const;

    private:
      void
      number(const CoverSystem                       &covers,
             const dealii::AffineConstraints<double> &constraints,
             const Epetra_CrsMatrix                  &matrix);

      void
      number_locally();

      unsigned int                n_rows = 0;
      std::vector<unsigned int>   row_to_cover;
      std::unique_ptr<Epetra_Map> row_map;

      /// Of the columns of second order, first the owned ones: both ends, equal for
      /// corners, or none; global numbers of first order, and local ones of owned
      /// covers.
      std::vector<std::array<unsigned int, 2>> ends, local_ends;

      /// Owned unknowns of first order and, behind them, ends of others.
      std::unique_ptr<Epetra_Map>            local_map;
      std::unique_ptr<Epetra_Import>         importer;
      mutable std::unique_ptr<Epetra_Vector> local;
    };
  } // namespace internal
} // namespace NMM

#endif
