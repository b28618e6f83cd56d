#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <mechanics/matrix_rows.h>
#include <mechanics/matrix_sum.h>

namespace NMM
{
  namespace internal
  {
    MatrixSum::Places
    MatrixSum::find_places(const Matrix &matrix) const
    {
      const Epetra_CrsMatrix &from         = matrix.trilinos_matrix();
      const Epetra_CrsMatrix &to           = sum.trilinos_matrix();
      const int              *from_columns = from.ColMap().MyGlobalElements();
      const int              *to_columns   = to.ColMap().MyGlobalElements();
      Places                  places;
      places.places.reserve(from.NumMyNonzeros());
      std::vector<std::pair<int, int>> row;
      for (int r = 0; r < from.NumMyRows(); ++r)
      {
        int     n_from, n_to, *from_indices, *to_indices;
        double *values;
        places.row_begin.push_back(places.places.size());
        from.ExtractMyRowView(r, n_from, values, from_indices);
        to.ExtractMyRowView(r, n_to, values, to_indices);
        row.clear();
        for (int i = 0; i < n_to; ++i)
          row.emplace_back(to_columns[to_indices[i]], i);
        std::sort(row.begin(), row.end());
        for (int i = 0; i < n_from; ++i)
        {
          const int  column = from_columns[from_indices[i]];
          const auto place =
            std::lower_bound(row.begin(), row.end(), std::make_pair(column, 0));
          AssertThrow(place != row.end() && place->first == column,
                      dealii::ExcMessage(
                        "The pattern is not within that of the stiffness."));
          places.places.push_back(place->second);
        }
      }
      return places;
    }


    void
    MatrixSum::add(const Matrix      &matrix,
                   const double       factor,
                   const Places      &places,
                   const ActiveItems &rows)
    {
      const MatrixRows from(matrix), to(sum);
      rows.for_each(matrix.trilinos_matrix().NumMyRows(),
                    [&](const unsigned int r) {
                      const int *place =
                        places.places.data() + places.row_begin[r];
                      double *values = to.values + to.begins[r];
                      for (int i = from.begins[r]; i < from.begins[r + 1]; ++i)
                        values[*place++] += factor * from.values[i];
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
        mass_places    = find_places(mass);
        damping_places = Places();
      }
      if (damping != nullptr && damping_places.places.empty())
        damping_places = find_places(*damping);

      const MatrixRows from(stiffness), to(sum);
      rows.for_each(stiffness.trilinos_matrix().NumMyRows(),
                    [&](const unsigned int r) {
                      for (int i = from.begins[r]; i < from.begins[r + 1]; ++i)
                        to.values[i] = k * from.values[i];
                    });
      add(mass, m, mass_places, rows);
      if (damping != nullptr && c != 0.)
        add(*damping, c, damping_places, rows);
    }
  } // namespace internal
} // namespace NMM
