#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Map.h>
#include <algorithm>
#include <linear_algebra/extended_matrix.h>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/matrix_sum.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Index of the entry of a row with this local column.
      int
      entry(const MatrixRows &rows, const int row, const int column)
      {
        const int *const end = rows.columns + rows.begins[row + 1];
        const int *const found =
          std::lower_bound(rows.columns + rows.begins[row], end, column);
        AssertThrow(found != end && *found == column,
                    dealii::ExcMessage(
                      "A force couples unknowns that are not in one of the "
                      "couplings of its term."));
        return found - rows.columns;
      }
    } // namespace


    ExtendedMatrix::ExtendedMatrix(std::vector<std::vector<Index>> couplings)
      : couplings(std::move(couplings))
    {
    }


    void
    ExtendedMatrix::build(const Matrix           &original,
                          const dealii::IndexSet &owned,
                          const MPI_Comm          communicator)
    {
      const MatrixRows       from(original);
      const Epetra_BlockMap &of_original = original.trilinos_matrix().ColMap();
      const int              n           = owned.n_elements();
      dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
      for (int row = 0; row < n; ++row)
        for (int i = from.begins[row]; i < from.begins[row + 1]; ++i)
          pattern.add(owned.nth_index_in_set(row),
                      of_original.GID(from.columns[i]));
      for (const std::vector<Index> &coupled : couplings)
        for (const Index row : coupled)
          if (owned.is_element(row))
            pattern.add_entries(row, coupled.begin(), coupled.end());
      extended.clear();
      extended.reinit(owned, owned, pattern, communicator);
    }


    void
    ExtendedMatrix::read(const Matrix &original, const ChosenItems &rows)
    {
      const MatrixRows to(extended);
      rows.for_each(extended.local_size(), [&](const unsigned int row) {
        std::fill(to.values + to.begins[row],
                  to.values + to.begins[row + 1],
                  0.);
      });
      add_rows(1., original, extended, rows);
    }


    void
    ExtendedMatrix::add(const Index       *unknowns,
                        const unsigned int n,
                        const double      *values,
                        const ChosenItems &rows)
    {
      const MatrixRows to(extended);
      const auto      &matrix = extended.trilinos_matrix();
      columns.clear();
      for (unsigned int j = 0; j < n; ++j)
        columns.push_back(matrix.ColMap().LID(static_cast<int>(unknowns[j])));
      for (unsigned int i = 0; i < n; ++i)
      {
        const int row = matrix.RowMap().LID(static_cast<int>(unknowns[i]));
        if (row < 0 || !rows.contains(row))
          continue;
        for (unsigned int j = 0; j < n; ++j)
          to.values[entry(to, row, columns[j])] += values[n * i + j];
      }
    }
  } // namespace internal
} // namespace NMM
