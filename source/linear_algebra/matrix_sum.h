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
     * Adds a sparse matrix to another one, whose pattern contains its own. Where each entry
     * goes is found in the first call and kept, so that further calls with other values
     * cost one addition per entry. (Epetra searches each entry in its row each time.)
     */
    class MatrixAdder
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Add @p factor times @p from to @p to in the active @p rows. @p version has to
      /// change when one of both patterns does.
      void
      add(double             factor,
          const Matrix      &from,
          Matrix            &to,
          unsigned int       version,
          const ActiveItems &rows);

    private:
      void
      find_places(const Matrix &from, const Matrix &to);

      /// Positions of the entries of a row in the row of the other matrix: consecutive
      /// ones from first on, or, if that is negative, those in places from begin on.
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


    /// The sum k K + m M + c C, with the pattern of K, which has to contain the others.
    class MatrixSum
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Assemble the active @p rows. @p damping may be null. @p version has to change when
      /// the pattern of K does.
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
