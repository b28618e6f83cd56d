#ifndef nmm_source_linear_algebra_matrix_sum_h
#define nmm_source_linear_algebra_matrix_sum_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <linear_algebra/active_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Adds a matrix to another one whose pattern it lies within, again and again with
     * other values: where the entries go is looked up once.
     */
    class MatrixAdder
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// to += factor from, in @p rows. @p version: another number if one of them has
      /// another pattern.
      void
      add(double             factor,
          const Matrix      &from,
          Matrix            &to,
          unsigned int       version,
          const ActiveItems &rows);

    private:
      void
      find_places(const Matrix &from, const Matrix &to);

      /// Where its entries go in the other one's row: one after the other from the first one
      /// on, or, if that is negative, each to a place of its own.
      struct PlacesOfRow
      {
        std::size_t begin;
        int         first;
      };

      std::vector<PlacesOfRow> places_of_rows;
      std::vector<int>         places;
      bool                     is_known      = false;
      unsigned int             known_version = 0;
    };


    /// k K + m M + c C for matrices whose patterns lie within that of K.
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
      Matrix       sum;
      MatrixAdder  mass_adder, damping_adder;
      unsigned int known_version = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
