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
     * Adds a sparse matrix to another one, whose pattern contains that of the first. The position
     * of each entry in the other matrix is determined in the first call and stored, so that further
     * calls with other values cost one addition per entry. (Epetra would search for each entry in
     * each call.)
     */
    class MatrixAdder
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Add @p factor times @p from to @p to in the active @p rows. @p version must
      /// change when the pattern of either matrix changes.
      void
      add(double             factor,
          const Matrix      &from,
          Matrix            &to,
          unsigned int       version,
          const ActiveItems &rows);

    private:
      void
      find_places(const Matrix &from, const Matrix &to);

      /// Positions of the entries of a row in the row of the other matrix. They are consecutive
      /// from `first` on; if `first` is negative, they are stored in `places` from `begin` on.
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


    /// The sum k K + m M + c C, with the pattern of K, which must contain those of M and C.
    class MatrixSum
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Compute the active @p rows of the sum. @p damping may be null. @p version must change when
      /// the pattern of K changes.
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
