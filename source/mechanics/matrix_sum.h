#ifndef nmm_source_mechanics_matrix_sum_h
#define nmm_source_mechanics_matrix_sum_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <mechanics/active_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * k K + m M + c C for matrices whose patterns lie within that of K, again and
     * again with other values: where the entries go is looked up once.
     */
    class MatrixSum
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// @p damping may be null. @p version: another number if K has another
      /// pattern. Of @p rows only.
      void
      assemble(const Matrix      &stiffness,
               double             k,
               const Matrix      &mass,
               double             m,
               const Matrix      *damping,
               double             c,
               unsigned int       version = 0,
               const ActiveItems &rows    = ActiveItems());

      const Matrix &
      operator()() const
      {
        return sum;
      }

    private:
      /// Per entry of a matrix, row by row, its place in the sum's row.
      struct Places
      {
        std::vector<std::size_t> row_begin;
        std::vector<int>         places;
      };

      Places
      find_places(const Matrix &matrix) const;

      void
      add(const Matrix      &matrix,
          double             factor,
          const Places      &places,
          const ActiveItems &rows);

      Matrix       sum;
      Places       mass_places, damping_places;
      unsigned int known_version = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
