#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <algorithm>
#include <linear_algebra/cover_matrix_assembler.h>
#include <linear_algebra/matrix_rows.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Index = dealii::TrilinosWrappers::types::int_type;

      void
      check(const int error_code)
      {
        AssertThrow(error_code >= 0,
                    dealii::ExcMessage("Epetra returned the error code " +
                                       std::to_string(error_code)));
      }
    } // namespace


    void
    CoverMatrixAssembler::finish(dealii::TrilinosWrappers::SparseMatrix &matrix,
                                 dealii::TrilinosWrappers::MPI::Vector  &rhs)
    {
      matrix.clear();
      transfer(matrix, rhs);
      std::vector<double>().swap(values);
      std::vector<unsigned int>().swap(columns);
    }


    void
    CoverMatrixAssembler::transfer(
      dealii::TrilinosWrappers::SparseMatrix &matrix,
      dealii::TrilinosWrappers::MPI::Vector  &rhs)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(covers->communicator()) > 1)
        exchange_values(true);
      fix_empty_diagonals();
      if (matrix.m() != 2 * covers->n_global_covers())
        make_matrix(matrix);
      const MatrixRows to(matrix);
      if (to.values != entries)
        copy_values(to);
      if (to.values != entries && is_made_in_place)
      {
        entries = to.values;
        std::vector<double>().swap(values);
      }
      copy_rhs(rhs);
    }


    void
    CoverMatrixAssembler::transfer_rhs(
      dealii::TrilinosWrappers::MPI::Vector &rhs)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(covers->communicator()) > 1)
        exchange_values(false);
      copy_rhs(rhs);
    }


    /**
     * Make an Epetra matrix directly, with known row lengths and local column
     * numbers, because TrilinosWrappers::SparsityPattern would search for every column.
     */
    void
    CoverMatrixAssembler::make_matrix(
      dealii::TrilinosWrappers::SparseMatrix &matrix) const
    {
      const dealii::IndexSet owned = covers->locally_owned_dofs(2);
      const Epetra_Map       row_map =
        owned.make_trilinos_map(covers->communicator(), false);
      std::vector<Index> column_numbers;
      column_numbers.reserve(2 * (n_owned + ghost_covers.size()));
      for (unsigned int i = 0; i < 2 * n_owned; ++i)
        column_numbers.push_back(2 * first_owned + i);
      for (const unsigned int k : ghost_covers)
      {
        column_numbers.push_back(2 * k);
        column_numbers.push_back(2 * k + 1);
      }
      const Epetra_Map column_map(
        -1, column_numbers.size(), column_numbers.data(), 0, row_map.Comm());

      std::vector<int> lengths(2 * n_owned);
      for (unsigned int r = 0; r < n_owned; ++r)
        lengths[2 * r] = lengths[2 * r + 1] =
          2 * static_cast<int>(row_begin[r + 1] - row_begin[r]);

      Epetra_CrsGraph graph(
        ::Copy, row_map, column_map, lengths.data(), /*StaticProfile=*/true);
      std::vector<int> indices;
      for (unsigned int r = 0; r < n_owned; ++r)
      {
        indices.clear();
        for (std::size_t i = row_begin[r]; i < row_begin[r + 1]; ++i)
        {
          indices.push_back(2 * columns[i]);
          indices.push_back(2 * columns[i] + 1);
        }
        for (unsigned int c = 0; c < 2; ++c)
          check(
            graph.InsertMyIndices(2 * r + c, indices.size(), indices.data()));
      }
      check(graph.FillComplete(row_map, row_map));

      Epetra_CrsMatrix trilinos_matrix(::Copy, graph);
      check(trilinos_matrix.FillComplete(row_map, row_map));
      matrix.reinit(trilinos_matrix);
    }


    void
    CoverMatrixAssembler::copy_values(const MatrixRows &to) const
    {
      // both matrices store values in the same order
      active_rows.for_each(n_owned, [&](const unsigned int r) {
        AssertDimension(static_cast<std::size_t>(to.begins[2 * r]),
                        4 * row_begin[r]);
        std::copy(entries + 4 * row_begin[r],
                  entries + 4 * row_begin[r + 1],
                  to.values + to.begins[2 * r]);
      });
    }


    void
    CoverMatrixAssembler::copy_rhs(
      dealii::TrilinosWrappers::MPI::Vector &rhs) const
    {
      if (rhs.size() != 2 * covers->n_global_covers())
        rhs.reinit(covers->locally_owned_dofs(2), covers->communicator());
      const auto to = rhs.begin();
      active_rows.for_each(n_owned, [&](const unsigned int r) {
        *(to + 2 * r)     = right_hand_side[2 * r];
        *(to + 2 * r + 1) = right_hand_side[2 * r + 1];
      });
    }
  } // namespace internal
} // namespace NMM
