#ifndef nmm_source_linear_algebra_extended_matrix_h
#define nmm_source_linear_algebra_extended_matrix_h

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <linear_algebra/chosen_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * A copy of a sparse matrix whose pattern has further couplings, for forces that couple unknowns
     * which the original does not. Order of calls: build() whenever the original has a new pattern;
     * in each assembly read(), then add() for each local matrix.
     */
    class ExtendedMatrix
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Index  = dealii::types::global_dof_index;

      /// Each of @p couplings is a set of unknowns that are coupled with each other; the same on
      /// all ranks.
      explicit ExtendedMatrix(std::vector<std::vector<Index>> couplings);

      /// Set the pattern to that of @p original and the couplings, and all values to zero. The rows
      /// of both matrices are the unknowns @p owned. Collective.
      void
      build(const Matrix           &original,
            const dealii::IndexSet &owned,
            MPI_Comm                communicator);

      /// Replace the values in @p rows by those of the original.
      void
      read(const Matrix &original, const ChosenItems &rows);

      /// Add the n x n @p values, stored row by row, of the n @p unknowns, in owned unknowns of @p rows.
      void
      add(const Index       *unknowns,
          unsigned int       n,
          const double      *values,
          const ChosenItems &rows);

      const Matrix &
      matrix() const
      {
        return extended;
      }

      Matrix &
      matrix()
      {
        return extended;
      }

    private:
      std::vector<std::vector<Index>> couplings;
      Matrix                          extended;
      /// Local columns of the unknowns of add().
      std::vector<int> columns;
    };
  } // namespace internal
} // namespace NMM

#endif
