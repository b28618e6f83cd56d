#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/matrix_sum.h>

namespace NMM
{
  namespace internal
  {
    void
    MatrixAdder::find_places(const Matrix &from_matrix, const Matrix &to_matrix)
    {
      const Epetra_CrsMatrix &from         = from_matrix.trilinos_matrix();
      const Epetra_CrsMatrix &to           = to_matrix.trilinos_matrix();
      const int              *from_columns = from.ColMap().MyGlobalElements();
      const int              *to_columns   = to.ColMap().MyGlobalElements();
      const MatrixRows        from_rows(from), to_rows(to);
      places.clear();
      places_of_rows.clear();
      std::vector<std::pair<int, int>> row;
      for (int r = 0; r < from.NumMyRows(); ++r)
      {
        const std::size_t begin = places.size();
        row.clear();
        for (int i = to_rows.begins[r]; i < to_rows.begins[r + 1]; ++i)
          row.emplace_back(to_columns[to_rows.columns[i]],
                           i - to_rows.begins[r]);
        // on one rank they are sorted already
        if (!std::is_sorted(row.begin(), row.end()))
          std::sort(row.begin(), row.end());
        for (int i = from_rows.begins[r]; i < from_rows.begins[r + 1]; ++i)
        {
          const int  column = from_columns[from_rows.columns[i]];
          const auto place =
            std::lower_bound(row.begin(), row.end(), std::make_pair(column, 0));
          AssertThrow(place != row.end() && place->first == column,
                      dealii::ExcMessage(
                        "The pattern is not within that of the stiffness."));
          places.push_back(place->second);
        }
        // If each block has a mesh of its own, the entries of a row are consecutive in both
        // matrices.
        bool are_consecutive = true;
        for (std::size_t i = begin + 1; i < places.size(); ++i)
          are_consecutive = are_consecutive && places[i] == places[i - 1] + 1;
        if (!are_consecutive || places.size() == begin)
          places_of_rows.push_back({begin, -1});
        else
        {
          places_of_rows.push_back({begin, places[begin]});
          places.resize(begin);
        }
      }
    }


    void
    MatrixAdder::add(const double       factor,
                     const Matrix      &from_matrix,
                     Matrix            &to_matrix,
                     const unsigned int version,
                     const ActiveItems &rows)
    {
      if (!is_known || version != known_version)
      {
        find_places(from_matrix, to_matrix);
        is_known      = true;
        known_version = version;
      }
      const MatrixRows from(from_matrix), to(to_matrix);
      rows.for_each(from_matrix.trilinos_matrix().NumMyRows(),
                    [&](const unsigned int r) {
                      const auto [begin, first] = places_of_rows[r];
                      double       *values      = to.values + to.begins[r];
                      const double *source      = from.values + from.begins[r];
                      const int     n = from.begins[r + 1] - from.begins[r];
                      if (first >= 0)
                        for (int i = 0; i < n; ++i)
                          values[first + i] += factor * source[i];
                      else
                        for (int i = 0; i < n; ++i)
                          values[places[begin + i]] += factor * source[i];
                    });
    }


    void
    MatrixSum::assemble(const Matrix      &stiffness,
                        const double       k,
                        const Matrix      &mass,
                        const double       m,
                        const Matrix      *damping,
                        const double       c,
                        const unsigned int version,
                        const ActiveItems &rows)
    {
      if (sum.m() != stiffness.m() || version != known_version)
      {
        known_version = version;
        sum.reinit(stiffness);
      }
      const MatrixRows from(stiffness), to(sum);
      rows.for_each(stiffness.trilinos_matrix().NumMyRows(),
                    [&](const unsigned int r) {
                      for (int i = from.begins[r]; i < from.begins[r + 1]; ++i)
                        to.values[i] = k * from.values[i];
                    });
      mass_adder.add(m, mass, sum, version, rows);
      if (damping != nullptr && c != 0.)
        damping_adder.add(c, *damping, sum, version, rows);
    }
  } // namespace internal
} // namespace NMM
