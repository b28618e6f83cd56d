#include <deal.II/base/mpi.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <linear_algebra/cover_matrix_assembler.h>
#include <set>
#include <string>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      void
      check(const int error_code)
      {
        AssertThrow(error_code >= 0,
                    dealii::ExcMessage("Epetra returned the error code " +
                                       std::to_string(error_code)));
      }


      /// The pattern of unknowns, two for each cover of @p pattern. Epetra is given the columns of
      /// this rank, first the owned ones, then those of other ranks in ascending order: it would
      /// take as long again to find them, and would not keep the two columns of a cover together.
      Epetra_CrsGraph
      make_graph(const dealii::IndexSet               &owned,
                 const dealii::DynamicSparsityPattern &pattern,
                 const Epetra_Map                     &row_map)
      {
        std::vector<int>       lengths, unknowns;
        std::set<unsigned int> of_other_ranks;
        for (const auto cover : owned)
        {
          const unsigned int n = pattern.row_length(cover);
          lengths.insert(lengths.end(), 2, 2 * n);
          for (const unsigned int c : {0, 1})
            unknowns.push_back(unknown_of(cover, c));
          for (unsigned int j = 0; j < n; ++j)
            if (const auto column = pattern.column_number(cover, j);
                !owned.is_element(column))
              of_other_ranks.insert(column);
        }
        for (const unsigned int cover : of_other_ranks)
          for (const unsigned int c : {0, 1})
            unknowns.push_back(unknown_of(cover, c));
        const Epetra_Map column_map(
          -1, unknowns.size(), unknowns.data(), 0, row_map.Comm());

        Epetra_CrsGraph  graph(::Copy,
                              row_map,
                              column_map,
                              lengths.data(),
                              /* StaticProfile = */ true);
        std::vector<int> columns;
        int              row = 0;
        for (const auto cover : owned)
        {
          columns.clear();
          for (unsigned int j = 0; j < pattern.row_length(cover); ++j)
          {
            const int column = column_map.LID(
              static_cast<int>(unknown_of(pattern.column_number(cover, j), 0)));
            columns.insert(columns.end(), {column, column + 1});
          }
          for (unsigned int c = 0; c < 2; ++c, ++row)
            check(graph.InsertMyIndices(row, columns.size(), columns.data()));
        }
        check(graph.FillComplete(row_map, row_map));
        return graph;
      }
    } // namespace


    CoverMatrixAssembler::CoverMatrixAssembler(
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
      : covers(&covers)
      , constraints(&constraints)
      , is_constrained(covers.n_covers())
      , pattern(covers.n_covers(),
                covers.n_covers(),
                covers.locally_relevant_covers())
      , n_rows(covers.locally_owned_covers().n_elements())
    {
      for (const auto &line : constraints.get_lines())
        is_constrained[cover_of(line.index)] = true;
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
        couple(covers.covers(e));
    }


    void
    CoverMatrixAssembler::ignore_inhomogeneities()
    {
      has_inhomogeneities = false;
    }


    void
    CoverMatrixAssembler::leave_empty_rows()
    {
      leaves_empty_rows = true;
    }


    void
    CoverMatrixAssembler::restrict_to(const ChosenItems &covers)
    {
      chosen_covers = &covers;
    }


    void
    CoverMatrixAssembler::expand(
      const dealii::ArrayView<const unsigned int> of_covers)
    {
      expanded.clear();
      for (const unsigned int k : of_covers)
        if (!is_constrained[k])
          expanded.push_back(k);
        else
          for (unsigned int c = 0; c < 2; ++c)
            if (const auto *entries =
                  constraints->get_constraint_entries(unknown_of(k, c)))
              for (const auto &entry : *entries)
                expanded.push_back(cover_of(entry.first));
            else
              expanded.push_back(k);
      std::sort(expanded.begin(), expanded.end());
      expanded.erase(std::unique(expanded.begin(), expanded.end()),
                     expanded.end());
    }


    void
    CoverMatrixAssembler::couple(
      const dealii::ArrayView<const unsigned int> coupled)
    {
      expand(coupled);
      global_columns.assign(expanded.begin(), expanded.end());
      for (const auto row : global_columns)
        pattern.add_entries(row,
                            global_columns.begin(),
                            global_columns.end(),
                            /* indices_are_sorted = */ true);
    }


    void
    CoverMatrixAssembler::build(Matrix &new_matrix, Vector &new_rhs)
    {
      matrix                               = &new_matrix;
      rhs                                  = &new_rhs;
      const MPI_Comm          communicator = covers->communicator();
      const dealii::IndexSet &owned        = covers->locally_owned_covers();
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
        dealii::SparsityTools::distribute_sparsity_pattern(
          pattern, owned, communicator, covers->locally_relevant_covers());

      const dealii::IndexSet unknowns = covers->locally_owned_dofs(2);
      const Epetra_Map       row_map =
        unknowns.make_trilinos_map(communicator, false);
      for (const auto cover : owned)
        pattern.add(cover, cover);
      const Epetra_CrsGraph graph = make_graph(owned, pattern, row_map);
      pattern.reinit(0, 0);
      Epetra_CrsMatrix trilinos_matrix(::Copy, graph);
      check(trilinos_matrix.FillComplete(row_map, row_map));
      matrix->reinit(trilinos_matrix);
      if (rhs->size() != unknowns.size())
        rhs->reinit(unknowns, communicator);

      rows       = MatrixRows(*matrix);
      rhs_values = rhs->begin();
      cover_to_column.assign(covers->n_covers(), invalid_index);
      for (unsigned int k = 0; k < covers->n_covers(); ++k)
      {
        const int column =
          graph.ColMap().LID(static_cast<int>(unknown_of(k, 0)));
        if (column >= 0)
          cover_to_column[k] = cover_of(column);
      }
    }


    void
    CoverMatrixAssembler::reset(const bool with_matrix)
    {
      if (chosen_covers == nullptr || chosen_covers->all())
      {
        *rhs = 0.;
        if (with_matrix)
          *matrix = 0.;
        return;
      }
      for_each_row([&](const unsigned int row) {
        std::fill_n(rhs_values + unknown_of(row, 0), 2, 0.);
        if (with_matrix)
          std::fill(rows.values + rows.begins[unknown_of(row, 0)],
                    rows.values + rows.begins[unknown_of(row + 1, 0)],
                    0.);
      });
    }


    void
    CoverMatrixAssembler::add(
      const dealii::ArrayView<const unsigned int> of_covers,
      const double                               *matrix_values,
      const double                               *rhs_values)
    {
      if (std::any_of(of_covers.begin(),
                      of_covers.end(),
                      [this](const unsigned int k) {
                        return is_constrained[k];
                      }))
        add_constrained(of_covers, matrix_values, rhs_values);
      else
        add_free(of_covers, matrix_values, rhs_values);
    }


    /// Add T^T A T and T^T (f - A g) for a local matrix A and right-hand side f, where
    /// u = T z + g are the constraints of the local unknowns u. Most rows of T have one entry.
    void
    CoverMatrixAssembler::add_constrained(
      const dealii::ArrayView<const unsigned int> of_covers,
      const double                               *matrix_values,
      const double                               *values)
    {
      Assert(matrix_values != nullptr || !has_inhomogeneities,
             dealii::ExcMessage("Inhomogeneous constraints need the matrix."));
      expand(of_covers);
      const auto position_of = [this](const unsigned int cover) {
        return std::lower_bound(expanded.begin(), expanded.end(), cover) -
               expanded.begin();
      };
      const unsigned int n = 2 * of_covers.size(), m = 2 * expanded.size();
      local_inhomogeneities.assign(n, 0.);
      terms.clear();
      term_begins.assign(1, 0);
      for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int k       = of_covers[cover_of(i)];
        const unsigned int unknown = unknown_of(k, component_of(i));
        if (const auto *entries = constraints->get_constraint_entries(unknown))
        {
          for (const auto &[j, weight] : *entries)
            terms.emplace_back(unknown_of(position_of(cover_of(j)),
                                          component_of(j)),
                               weight);
          if (has_inhomogeneities)
            local_inhomogeneities[i] = constraints->get_inhomogeneity(unknown);
        }
        else
          terms.emplace_back(unknown_of(position_of(k), component_of(i)), 1.);
        term_begins.push_back(terms.size());
      }
      if (m == 0)
        return;

      expanded_rhs.assign(m, 0.);
      expanded_matrix.assign(matrix_values != nullptr ? m * m : 0, 0.);
      for (unsigned int i = 0; i < n; ++i)
      {
        double value = values[i];
        if (has_inhomogeneities)
          for (unsigned int j = 0; j < n; ++j)
            value -= matrix_values[n * i + j] * local_inhomogeneities[j];
        for (unsigned int a = term_begins[i]; a < term_begins[i + 1]; ++a)
        {
          const auto [row, weight] = terms[a];
          expanded_rhs[row] += weight * value;
          if (matrix_values == nullptr)
            continue;
          double *const expanded_row = expanded_matrix.data() + m * row;
          for (unsigned int j = 0; j < n; ++j)
          {
            const double entry = weight * matrix_values[n * i + j];
            for (unsigned int b = term_begins[j]; b < term_begins[j + 1]; ++b)
              expanded_row[terms[b].first] += entry * terms[b].second;
          }
        }
      }
      add_free({expanded.data(), expanded.size()},
               matrix_values != nullptr ? expanded_matrix.data() : nullptr,
               expanded_rhs.data());
    }


    void
    CoverMatrixAssembler::add_free(
      const dealii::ArrayView<const unsigned int> of_covers,
      const double                               *matrix_values,
      const double                               *values)
    {
      // insertion sort by column, so that each row is traversed only once
      constexpr unsigned int n_max = 128;
      const unsigned int     n     = of_covers.size();
      AssertThrow(n <= n_max, dealii::ExcInternalError());
      unsigned int order[n_max], columns[n_max];
      for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int column = cover_to_column[of_covers[i]];
        unsigned int       j      = i;
        for (; j > 0 && columns[j - 1] > column; --j)
        {
          columns[j] = columns[j - 1];
          order[j]   = order[j - 1];
        }
        columns[j] = column;
        order[j]   = i;
      }

      for (unsigned int a = 0; a < n; ++a)
      {
        const unsigned int row = columns[a], i = order[a];
        if (row >= n_rows)
        {
          add_row_of_other_rank(i, of_covers, matrix_values, values);
          continue;
        }
        if (!is_chosen(row))
          continue;
        rhs_values[unknown_of(row, 0)] += values[unknown_of(i, 0)];
        rhs_values[unknown_of(row, 1)] += values[unknown_of(i, 1)];
        if (matrix_values == nullptr)
          continue;
        const double *from    = matrix_values + 4 * n * i;
        const int    *entries = rows.columns + rows.begins[unknown_of(row, 0)];
        double       *first   = rows.values + rows.begins[unknown_of(row, 0)];
        double       *second  = rows.values + rows.begins[unknown_of(row, 1)];
        std::size_t   p       = 0;
        for (unsigned int b = 0; b < n; ++b)
        {
          while (entries[p] != static_cast<int>(unknown_of(columns[b], 0)))
          {
            p += 2;
            Assert(entries + p < rows.columns + rows.begins[unknown_of(row, 1)],
                   dealii::ExcInternalError());
          }
          const double *entry = from + unknown_of(order[b], 0);
          first[p] += entry[0];
          first[p + 1] += entry[1];
          second[p] += entry[2 * n];
          second[p + 1] += entry[2 * n + 1];
        }
      }
    }


    void
    CoverMatrixAssembler::add_row_of_other_rank(
      const unsigned int                          i,
      const dealii::ArrayView<const unsigned int> of_covers,
      const double                               *matrix_values,
      const double                               *values)
    {
      const unsigned int n = 2 * of_covers.size();
      global_columns.clear();
      for (const unsigned int k : of_covers)
        for (unsigned int c = 0; c < 2; ++c)
          global_columns.push_back(unknown_of(k, c));
      rhs->add(2, &global_columns[unknown_of(i, 0)], values + unknown_of(i, 0));
      for (unsigned int c = 0; c < 2 && matrix_values != nullptr; ++c)
        matrix->add(global_columns[unknown_of(i, c)],
                    n,
                    global_columns.data(),
                    matrix_values + n * unknown_of(i, c),
                    /* elide_zero_values = */ false);
    }


    void
    CoverMatrixAssembler::compress(const bool with_matrix)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(covers->communicator()) > 1)
      {
        rhs->compress(dealii::VectorOperation::add);
        if (with_matrix)
          matrix->compress(dealii::VectorOperation::add);
      }
      if (with_matrix && !leaves_empty_rows)
        fill_empty_diagonals();
    }


    /// Rows of constrained unknowns, and of unknowns whose support has no area, are empty. They
    /// get the mean of the other diagonal entries.
    void
    CoverMatrixAssembler::fill_empty_diagonals()
    {
      const auto diagonal = [this](const unsigned int unknown) -> double & {
        const int *begin = rows.columns + rows.begins[unknown];
        const int *end   = rows.columns + rows.begins[unknown + 1];
        return rows
          .values[std::lower_bound(begin, end, static_cast<int>(unknown)) -
                  rows.columns];
      };
      std::array<double, 2>     sum_and_count = {{0., 0.}};
      std::vector<unsigned int> empty;
      for_each_row([&](const unsigned int row) {
        for (const unsigned int unknown :
             {unknown_of(row, 0), unknown_of(row, 1)})
          if (const double entry = std::abs(diagonal(unknown)))
          {
            sum_and_count[0] += entry;
            sum_and_count[1] += 1.;
          }
          else
            empty.push_back(unknown);
      });
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(sum_and_count.data(), 2),
        covers->communicator(),
        dealii::ArrayView<double>(sum_and_count.data(), 2));
      for (const unsigned int unknown : empty)
        diagonal(unknown) =
          sum_and_count[1] > 0. ? sum_and_count[0] / sum_and_count[1] : 1.;
    }
  } // namespace internal
} // namespace NMM
