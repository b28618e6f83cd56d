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
     * Displacements of first order among those of second order on the same cover system:
     * values at corner nodes, and their mean at a mid-side node,
     * @f[ u_k = \tfrac12 (v_{a(k)} + v_{b(k)}), \qquad u = P v. @f]
     * The cover of a mid-side node is a piece of the supports of both ends of the side, so
     * that a(k) and b(k) are physical covers, and nothing is coupled across a joint. For a
     * corner a(k) = b(k) = k. Covers that are constrained (supports, aggregation) take no
     * part: their rows of P are empty.
     */
    class LinearCovers
    {
    public:
      /// Collective. @p matrix: of second order, made by CoverMatrixAssembler.
      LinearCovers(const Epetra_CrsMatrix                  &matrix,
                   const CoverSystem                       &covers,
                   const dealii::AffineConstraints<double> &constraints);

      /// P, (unknowns of second order x unknowns of first order).
      const Epetra_CrsMatrix &
      interpolation() const;

      /// P^T A P for the matrix of the constructor. Collective.
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
