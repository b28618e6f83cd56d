#ifndef nmm_source_linear_algebra_linear_covers_h
#define nmm_source_linear_algebra_linear_covers_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <Epetra_CrsMatrix.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The interpolation from displacements of first order to those of second order on the same
     * cover system: v are the values at corner nodes, and a mid-side node gets the mean of both
     * ends of its side,
     * @f[ u_k = \tfrac12 (v_{a(k)} + v_{b(k)}), \qquad u = P v. @f]
     * The physical cover of a mid-side node is contained in one physical cover of each end of the
     * side. So a(k) and b(k) are unique, and nothing is coupled across a joint. For a
     * corner a(k) = b(k) = k. The rows of P of constrained covers (supports, aggregation) are
     * empty.
     */
    class LinearCovers
    {
    public:
      /// @p matrix is that of second order, made by CoverMatrixAssembler. Collective.
      LinearCovers(const Epetra_CrsMatrix                  &matrix,
                   const CoverSystem                       &covers,
                   const dealii::AffineConstraints<double> &constraints);

      /// The matrix P (unknowns of second order x unknowns of first order).
      const Epetra_CrsMatrix &
      interpolation() const;

      /// The matrix P^T A P, where A is the matrix given to the constructor. Collective.
      std::unique_ptr<Epetra_CrsMatrix>
      multiply(const Epetra_CrsMatrix &matrix) const;

      /// Global numbers of the covers of this rank that have unknowns of first order, in
      /// the order of these unknowns, two for each.
      const std::vector<unsigned int> &
      covers_of_unknowns() const;

    private:
      std::vector<unsigned int>         unknown_to_cover;
      std::unique_ptr<Epetra_CrsMatrix> matrix_P;
    };
  } // namespace internal
} // namespace NMM

#endif
