#include <deal.II/base/mpi.h>

#include <Epetra_IntVector.h>
#include <algorithm>
#include <linear_algebra/linear_covers.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Corners that each of the six covers of an element lies between.
      constexpr unsigned int element_ends[6][2] =
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};


      /// Numbers of owned unknowns, and of others that the matrix has columns of; signed,
      /// since Epetra knows no other integers.
      std::vector<int>
      to_columns(const Epetra_CrsMatrix &matrix, std::vector<int> &owned)
      {
        std::vector<int> all(matrix.NumMyCols());
        if (matrix.Importer() == nullptr)
          return owned;
        const Epetra_IntVector from(View, matrix.RowMap(), owned.data());
        Epetra_IntVector       to(View, matrix.ColMap(), all.data());
        to.Import(from, *matrix.Importer(), Insert);
        return all;
      }
    } // namespace


    LinearCovers::LinearCovers(
      const Epetra_CrsMatrix                  &matrix,
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
    {
      number(covers, constraints, matrix);
      number_locally();
    }


    unsigned int
    LinearCovers::n_unknowns() const
    {
      return row_map->NumGlobalElements();
    }


    const Epetra_Map &
    LinearCovers::map() const
    {
      return *row_map;
    }


    const std::vector<unsigned int> &
    LinearCovers::covers_of_rows() const
    {
      return row_to_cover;
    }


    void
    LinearCovers::number(const CoverSystem                       &covers,
                         const dealii::AffineConstraints<double> &constraints,
                         const Epetra_CrsMatrix                  &matrix)
    {
      // ends of owned covers: an owned element has them
      const unsigned int n_owned = matrix.NumMyRows() / 2;
      const unsigned int first_owned =
        n_owned > 0 ? covers.locally_owned_covers().nth_index_in_set(0) : 0;
      std::vector<std::array<unsigned int, 2>> cover_to_ends(
        n_owned, {{invalid_index, invalid_index}});
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
      {
        const auto of_element = covers.covers(e);
        for (unsigned int i = 0; i < 6; ++i)
        {
          const unsigned int cover = covers.global_cover(of_element[i]);
          if (cover >= first_owned && cover < first_owned + n_owned)
            for (unsigned int j = 0; j < 2; ++j)
              cover_to_ends[cover - first_owned][j] =
                covers.global_cover(of_element[element_ends[i][j]]);
        }
      }

      const auto is_free = [&](const unsigned int cover) {
        return !constraints.is_constrained(2 * cover) &&
               !constraints.is_constrained(2 * cover + 1);
      };
      for (unsigned int k = 0; k < n_owned; ++k)
        if (cover_to_ends[k][0] == first_owned + k &&
            cover_to_ends[k][1] == first_owned + k && is_free(first_owned + k))
          row_to_cover.push_back(first_owned + k);
      n_rows              = row_to_cover.size();
      unsigned int before = 0;
      MPI_Exscan(
        &n_rows, &before, 1, MPI_UNSIGNED, MPI_SUM, covers.communicator());
      if (dealii::Utilities::MPI::this_mpi_process(covers.communicator()) == 0)
        before = 0;
      row_map = std::make_unique<Epetra_Map>(-1,
                                             static_cast<int>(2 * n_rows),
                                             0,
                                             matrix.Comm());

      std::vector<int> numbers(2 * n_owned, -1);
      for (unsigned int i = 0; i < n_rows; ++i)
        numbers[2 * (row_to_cover[i] - first_owned)] = before + i;
      const std::vector<int> column_numbers = to_columns(matrix, numbers);
      for (unsigned int k = 0; k < n_owned; ++k)
        for (unsigned int j = 0; j < 2; ++j)
        {
          const unsigned int end    = cover_to_ends[k][j];
          int               &number = numbers[2 * k + j];
          number                    = -1;
          if (end == invalid_index || !is_free(first_owned + k))
            continue;
          const int column = matrix.ColMap().LID(static_cast<int>(2 * end));
          if (column >= 0)
            number = column_numbers[column];
        }
      const std::vector<int> column_ends = to_columns(matrix, numbers);
      ends.resize(column_ends.size() / 2);
      for (unsigned int k = 0; k < ends.size(); ++k)
        for (unsigned int j = 0; j < 2; ++j)
          ends[k][j] = column_ends[2 * k + j];
      local_ends.assign(ends.begin(), ends.begin() + n_owned);
    }


    void
    LinearCovers::number_locally()
    {
      const unsigned int first    = n_rows > 0 ? row_map->MinMyGID() / 2 : 0;
      const auto         is_owned = [&](const unsigned int number) {
        return number >= first && number < first + n_rows;
      };
      std::vector<unsigned int> others;
      for (const auto &both : local_ends)
        for (const unsigned int number : both)
          if (number != none && !is_owned(number))
            others.push_back(number);
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      for (auto &both : local_ends)
        for (unsigned int &number : both)
          if (number != none)
            number =
              is_owned(number)
                ? number - first
                : n_rows +
                    (std::lower_bound(others.begin(), others.end(), number) -
                     others.begin());
      std::vector<int> unknowns;
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          unknowns.push_back(2 * (first + i) + c);
      for (const unsigned int number : others)
        for (unsigned int c = 0; c < 2; ++c)
          unknowns.push_back(2 * number + c);
      local_map = std::make_unique<Epetra_Map>(
        -1, unknowns.size(), unknowns.data(), 0, row_map->Comm());
      local = std::make_unique<Epetra_Vector>(*local_map);
      if (row_map->Comm().NumProc() > 1)
        importer = std::make_unique<Epetra_Import>(*local_map, *row_map);
    }


    std::unique_ptr<Epetra_FECrsMatrix>
    LinearCovers::multiply(const Epetra_CrsMatrix &matrix) const
    {
      // owned covers of second order that a row of first order is made of
      const unsigned int        n_local = local_map->NumMyElements() / 2;
      std::vector<unsigned int> begin(n_local + 2, 0);
      const auto for_each_end = [](const auto &both, const auto &action) {
        if (both[0] != none)
          action(both[0], both[0] == both[1] ? 1. : 0.5);
        if (both[1] != none && both[1] != both[0])
          action(both[1], 0.5);
      };
      for (const auto &both : local_ends)
        for_each_end(both,
                     [&](const unsigned int i, double) { ++begin[i + 2]; });
      for (unsigned int i = 0; i < n_local; ++i)
        begin[i + 2] += begin[i + 1];
      std::vector<std::pair<unsigned int, double>> parts(begin.back());
      for (unsigned int k = 0; k < local_ends.size(); ++k)
        for_each_end(local_ends[k],
                     [&](const unsigned int i, const double weight) {
                       parts[begin[i + 1]++] = {k, weight};
                     });

      constexpr int expected = 20; // entries of a row
      auto          product =
        std::make_unique<Epetra_FECrsMatrix>(::Copy, *row_map, expected);
      std::vector<int>    columns;
      std::vector<double> rows[2];
      // places of columns of first order in the row: a few neighbours, searched from the
      // last one
      for (unsigned int i = 0; i < n_local; ++i)
      {
        columns.clear();
        for (auto &row : rows)
          row.clear();
        for (unsigned int p = begin[i]; p < begin[i + 1]; ++p)
        {
          const auto [k, weight] = parts[p];
          int     n, *indices;
          double *first, *second;
          matrix.ExtractMyRowView(2 * k, n, first, indices);
          matrix.ExtractMyRowView(2 * k + 1, n, second);
          for (int j = 0; j < n; j += 2)
            for_each_end(ends[indices[j] / 2],
                         [&, weight = weight](const unsigned int column,
                                              const double column_weight) {
                           const int number = 2 * column;
                           int       place  = columns.size();
                           while (place > 0 && columns[place - 2] != number)
                             place -= 2;
                           if (place == 0)
                           {
                             place = columns.size() + 2;
                             columns.push_back(number);
                             columns.push_back(number + 1);
                             for (auto &row : rows)
                               row.resize(place, 0.);
                           }
                           const double w = weight * column_weight;
                           for (int c = 0; c < 2; ++c)
                           {
                             rows[0][place - 2 + c] += w * first[j + c];
                             rows[1][place - 2 + c] += w * second[j + c];
                           }
                         });
        }
        for (unsigned int c = 0; c < 2; ++c)
        {
          const int row   = local_map->GID(2 * i + c);
          const int error = product->InsertGlobalValues(row,
                                                        columns.size(),
                                                        rows[c].data(),
                                                        columns.data());
          AssertThrow(error >= 0,
                      dealii::ExcMessage("Epetra returned the error code " +
                                         std::to_string(error)));
        }
      }
      product->GlobalAssemble();
      product->OptimizeStorage();
      return product;
    }


    void
    LinearCovers::restrict_to(const std::vector<float> &r,
                              Epetra_Vector            &result) const
    {
      Epetra_Vector &sum = *local;
      sum.PutScalar(0.);
      double *values = sum.Values();
      for (unsigned int k = 0; k < local_ends.size(); ++k)
        for (const unsigned int end : local_ends[k])
          if (end != none)
            for (unsigned int c = 0; c < 2; ++c)
              values[2 * end + c] += 0.5 * r[2 * k + c];
      if (importer == nullptr)
        std::copy(values, values + 2 * n_rows, result.Values());
      else
      {
        result.PutScalar(0.);
        result.Export(sum, *importer, Add);
      }
    }


    void
    LinearCovers::add_interpolated(const Epetra_Vector &v,
                                   std::vector<float>  &x) const
    {
      const double *values = v.Values();
      if (importer != nullptr)
      {
        local->Import(v, *importer, Insert);
        values = local->Values();
      }
      for (unsigned int k = 0; k < local_ends.size(); ++k)
        for (const unsigned int end : local_ends[k])
          if (end != none)
            for (unsigned int c = 0; c < 2; ++c)
              x[2 * k + c] += 0.5 * values[2 * end + c];
    }
  } // namespace internal
} // namespace NMM
