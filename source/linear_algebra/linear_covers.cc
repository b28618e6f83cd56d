#include <nmm/base/types.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <Epetra_Map.h>
#include <array>
#include <linear_algebra/linear_covers.h>
#include <ml_epetra_utils.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// For each of the six covers of an element, the corners at the ends of its side; a corner
      /// cover has its own corner twice.
      constexpr unsigned int element_ends[6][2] =
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};


      /// For each owned cover, the global numbers of the covers at both ends of its side, which
      /// are found in an owned element.
      std::vector<std::array<unsigned int, 2>>
      find_ends(const CoverSystem &covers,
                const unsigned int first_owned,
                const unsigned int n_owned)
      {
        std::vector<std::array<unsigned int, 2>> ends(
          n_owned, {{invalid_index, invalid_index}});
        const auto [first, last] = covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
        {
          const auto of_element = covers.covers(e);
          for (unsigned int i = 0; i < 6; ++i)
          {
            const unsigned int cover = of_element[i];
            if (cover >= first_owned && cover < first_owned + n_owned)
              for (unsigned int j = 0; j < 2; ++j)
                ends[cover - first_owned][j] = of_element[element_ends[i][j]];
          }
        }
        return ends;
      }
    } // namespace


    LinearCovers::LinearCovers(
      const Epetra_CrsMatrix                  &matrix,
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
    {
      const unsigned int n_owned = matrix.NumMyRows() / 2;
      const unsigned int first_owned =
        n_owned > 0 ? covers.locally_owned_covers().nth_index_in_set(0) : 0;
      const auto ends    = find_ends(covers, first_owned, n_owned);
      const auto is_free = [&](const unsigned int cover) {
        return !constraints.is_constrained(unknown_of(cover, 0)) &&
               !constraints.is_constrained(unknown_of(cover, 1));
      };
      for (unsigned int k = 0; k < n_owned; ++k)
        if (ends[k][0] == first_owned + k && ends[k][1] == first_owned + k &&
            is_free(first_owned + k))
          unknown_to_cover.push_back(first_owned + k);
      const Epetra_Map linear_map(-1,
                                  static_cast<int>(2 * unknown_to_cover.size()),
                                  0,
                                  matrix.Comm());

      // for each unknown of second order, its unknown of first order, or -1 if it has none
      Epetra_IntVector owned(matrix.RowMap()), all(matrix.ColMap());
      owned.PutValue(-1);
      for (unsigned int i = 0; i < unknown_to_cover.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          owned[2 * (unknown_to_cover[i] - first_owned) + c] =
            linear_map.GID(unknown_of(i, c));
      all.Import(owned,
                 Epetra_Import(matrix.ColMap(), matrix.RowMap()),
                 Insert);

      matrix_P = std::make_unique<Epetra_CrsMatrix>(::Copy, matrix.RowMap(), 2);
      for (unsigned int k = 0; k < n_owned; ++k)
        for (unsigned int c = 0; c < 2 && is_free(first_owned + k); ++c)
          for (unsigned int j = 0; j < 2; ++j)
          {
            // at a corner, both ends are the same unknown, and the halves add up to 1
            const int    row  = 2 * (first_owned + k) + c;
            const double half = 0.5;
            if (ends[k][j] == invalid_index)
              continue;
            const int column =
              matrix.ColMap().LID(static_cast<int>(unknown_of(ends[k][j], c)));
            if (column >= 0 && all[column] >= 0)
              matrix_P->InsertGlobalValues(row, 1, &half, &all[column]);
          }
      matrix_P->FillComplete(linear_map, matrix.RowMap());
      matrix_P->OptimizeStorage();
    }


    const Epetra_CrsMatrix &
    LinearCovers::interpolation() const
    {
      return *matrix_P;
    }


    const std::vector<unsigned int> &
    LinearCovers::covers_of_unknowns() const
    {
      return unknown_to_cover;
    }


    std::unique_ptr<Epetra_CrsMatrix>
    LinearCovers::multiply(const Epetra_CrsMatrix &matrix) const
    {
      Epetra_CrsMatrix *product = nullptr;
      const int error = ML_Epetra::ML_Epetra_PtAP(matrix, *matrix_P, product);
      AssertThrow(error == 0,
                  dealii::ExcMessage("ML returned the error code " +
                                     std::to_string(error)));
      return std::unique_ptr<Epetra_CrsMatrix>(product);
    }
  } // namespace internal
} // namespace NMM
