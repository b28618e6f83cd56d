#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <linear_algebra/cover_matrix_assembler.h>

namespace NMM
{
  namespace internal
  {
    CoverMatrixAssembler::CoverMatrixAssembler(
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
      : covers(&covers)
      , first_owned(covers.locally_owned_covers().n_elements() > 0
                      ? covers.locally_owned_covers().nth_index_in_set(0)
                      : 0)
      , first_owned_here(0)
      , n_owned(covers.locally_owned_covers().n_elements())
      , cover_to_expansion(covers.n_covers(), invalid_index)
    {
      Assert(covers.locally_owned_covers().is_contiguous(),
             dealii::ExcInternalError());
      if (n_owned > 0)
        first_owned_here = covers.local_cover(first_owned);
      read_constraints(constraints);

      const auto [first, last] = covers.locally_owned_elements();
      const unsigned int n_per_element =
        covers.manifold_mesh().mathematical_mesh().n_covers_per_cell();
      stencil_begin.reserve(last - first + 1);
      stencil_begin.push_back(0);
      stencil_covers.reserve((last - first) * n_per_element);
      for (unsigned int e = first; e < last; ++e)
        couple(covers.covers(e));
    }


    void
    CoverMatrixAssembler::read_constraints(
      const dealii::AffineConstraints<double> &constraints)
    {
      // lines are sorted, so that those of the two unknowns of a cover follow each other
      unsigned int last_cover = invalid_index;
      const auto   open       = [&](const unsigned int cover) {
        if (cover_to_expansion[cover] != invalid_index)
          return;
        cover_to_expansion[cover] = expansion.constrained.size();
        expansion.constrained.push_back({{false, false}});
        expansion.inhomogeneity.push_back({{0., 0.}});
      };
      for (const auto &line : constraints.get_lines())
      {
        const unsigned int cover     = covers->local_cover(line.index / 2);
        const unsigned int component = line.index % 2;
        open(cover);
        const unsigned int x                  = cover_to_expansion[cover];
        expansion.constrained[x][component]   = true;
        expansion.inhomogeneity[x][component] = line.inhomogeneity;
      }

      std::vector<std::vector<Term>> terms(expansion.constrained.size());
      const auto                     add = [&](const unsigned int x,
                           const unsigned int component,
                           const unsigned int unknown,
                           const double       weight) {
        const unsigned int cover = covers->local_cover(unknown / 2);
        Assert(cover != invalid_index, dealii::ExcInternalError());
        auto term =
          std::find_if(terms[x].begin(),
                       terms[x].end(),
                       [cover](const Term &t) { return t.cover == cover; });
        if (term == terms[x].end())
          term = terms[x].insert(term, Term{cover, {{0., 0., 0., 0.}}});
        term->entry[2 * component + unknown % 2] += weight;
      };
      for (const auto &line : constraints.get_lines())
      {
        const unsigned int cover = covers->local_cover(line.index / 2);
        const unsigned int x     = cover_to_expansion[cover];
        if (cover != last_cover)
          for (unsigned int c = 0; c < 2; ++c)
            if (!expansion.constrained[x][c])
              add(x, c, 2 * (line.index / 2) + c, 1.);
        last_cover = cover;
        for (const auto &[unknown, weight] : line.entries)
          add(x, line.index % 2, unknown, weight);
      }

      expansion.begin.push_back(0);
      for (const std::vector<Term> &t : terms)
      {
        expansion.terms.insert(expansion.terms.end(), t.begin(), t.end());
        expansion.begin.push_back(expansion.terms.size());
      }
    }


    void
    CoverMatrixAssembler::ignore_inhomogeneities()
    {
      std::fill(expansion.inhomogeneity.begin(),
                expansion.inhomogeneity.end(),
                std::array<double, 2>{{0., 0.}});
    }


    bool
    CoverMatrixAssembler::has_constrained(
      const dealii::ArrayView<const unsigned int> covers) const
    {
      for (const unsigned int k : covers)
        if (cover_to_expansion[k] != invalid_index)
          return true;
      return false;
    }


    void
    CoverMatrixAssembler::expand(
      const dealii::ArrayView<const unsigned int> covers,
      std::vector<unsigned int>                  &expanded) const
    {
      const std::size_t begin = expanded.size();
      const auto        meet  = [&](const unsigned int cover) {
        if (std::find(expanded.begin() + begin, expanded.end(), cover) ==
            expanded.end())
          expanded.push_back(cover);
      };
      for (const unsigned int k : covers)
        if (cover_to_expansion[k] == invalid_index)
          meet(k);
        else
          for (unsigned int t = expansion.begin[cover_to_expansion[k]];
               t < expansion.begin[cover_to_expansion[k] + 1];
               ++t)
            meet(expansion.terms[t].cover);
    }


    void
    CoverMatrixAssembler::leave_empty_rows()
    {
      leaves_empty_rows = true;
    }


    void
    CoverMatrixAssembler::assemble_in_place()
    {
      is_made_in_place =
        dealii::Utilities::MPI::n_mpi_processes(covers->communicator()) == 1;
    }


    void
    CoverMatrixAssembler::couple(
      const dealii::ArrayView<const unsigned int> covers)
    {
      if (has_constrained(covers))
      {
        expand(covers, stencil_covers);
        // the row of a constrained cover has a diagonal entry only
        for (const unsigned int k : covers)
          if (cover_to_expansion[k] != invalid_index)
          {
            stencil_begin.push_back(stencil_covers.size());
            stencil_covers.push_back(k);
          }
      }
      else
        stencil_covers.insert(stencil_covers.end(),
                              covers.begin(),
                              covers.end());
      stencil_begin.push_back(stencil_covers.size());
    }


    void
    CoverMatrixAssembler::build()
    {
      number_rows();
      fill_rows();
      if (dealii::Utilities::MPI::n_mpi_processes(covers->communicator()) > 1)
        exchange_pattern();
      localize_columns();
      values.assign(4 * columns.size(), 0.);
      entries = values.data();
      right_hand_side.assign(2 * n_rows, 0.);
    }


    void
    CoverMatrixAssembler::number_rows()
    {
      cover_to_local.assign(covers->n_covers(), invalid_index);
      for (unsigned int i = 0; i < n_owned; ++i)
        cover_to_local[first_owned_here + i] = i;

      for (const unsigned int k : stencil_covers)
        if (cover_to_local[k] == invalid_index)
        {
          cover_to_local[k] = 0;
          ghost_covers.push_back(k);
        }
      std::sort(ghost_covers.begin(), ghost_covers.end());
      for (unsigned int i = 0; i < ghost_covers.size(); ++i)
      {
        cover_to_local[ghost_covers[i]] = n_owned + i;
        ghost_covers[i]                 = covers->global_cover(ghost_covers[i]);
      }
      n_rows = n_owned + ghost_covers.size();
    }


    unsigned int
    CoverMatrixAssembler::row_of(const unsigned int global_cover) const
    {
      if (global_cover >= first_owned && global_cover < first_owned + n_owned)
        return global_cover - first_owned;
      return n_owned + (std::lower_bound(ghost_covers.begin(),
                                         ghost_covers.end(),
                                         global_cover) -
                        ghost_covers.begin());
    }


    /// Make the rows of this rank's stencils, with columns as global numbers.
    void
    CoverMatrixAssembler::fill_rows()
    {
      // the stencils that contain each row
      std::vector<unsigned int> first_stencil(n_rows + 2, 0);
      for (const unsigned int k : stencil_covers)
        ++first_stencil[cover_to_local[k] + 2];
      for (unsigned int r = 0; r < n_rows; ++r)
        first_stencil[r + 2] += first_stencil[r + 1];
      std::vector<unsigned int> row_to_stencils(stencil_covers.size());
      const unsigned int        n_stencils = stencil_begin.size() - 1;
      for (unsigned int s = 0; s < n_stencils; ++s)
        for (unsigned int i = stencil_begin[s]; i < stencil_begin[s + 1]; ++i)
          row_to_stencils[first_stencil[cover_to_local[stencil_covers[i]] +
                                        1]++] = s;

      // last_row[k]: the last row in which column k was inserted
      std::vector<unsigned int> last_row(covers->n_covers(), invalid_index);
      row_begin.resize(n_rows + 1);
      row_begin[0] = 0;
      columns.reserve(3 * stencil_covers.size());
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        for (unsigned int i = first_stencil[r]; i < first_stencil[r + 1]; ++i)
          for (unsigned int j = stencil_begin[row_to_stencils[i]];
               j < stencil_begin[row_to_stencils[i] + 1];
               ++j)
            if (last_row[stencil_covers[j]] != r)
            {
              last_row[stencil_covers[j]] = r;
              columns.push_back(stencil_covers[j]);
            }
        if (r < n_owned && last_row[first_owned_here + r] != r)
          columns.push_back(first_owned_here + r);
        std::sort(columns.begin() + row_begin[r], columns.end());
        row_begin[r + 1] = columns.size();
      }

      if (covers->n_covers() < covers->n_global_covers())
        for (unsigned int &k : columns)
          k = covers->global_cover(k);
      std::vector<unsigned int>().swap(stencil_begin);
      std::vector<unsigned int>().swap(stencil_covers);
    }


    void
    CoverMatrixAssembler::exchange_pattern()
    {
      using namespace dealii::Utilities::MPI;
      const std::vector<unsigned int> rank_to_end =
        all_gather(covers->communicator(), first_owned + n_owned);
      // a rank without covers has the end 0, but the binary search needs ascending ends
      std::vector<unsigned int> ends = rank_to_end;
      for (unsigned int r = 1; r < ends.size(); ++r)
        ends[r] = std::max(ends[r], ends[r - 1]);

      std::map<unsigned int, std::vector<unsigned int>> rank_to_rows;
      for (unsigned int r = n_owned; r < n_rows; ++r)
      {
        const unsigned int cover = ghost_covers[r - n_owned];
        const unsigned int owner =
          std::upper_bound(ends.begin(), ends.end(), cover) - ends.begin();
        std::vector<unsigned int> &rows = rank_to_rows[owner];
        rows.push_back(cover);
        rows.push_back(row_begin[r + 1] - row_begin[r]);
        rows.insert(rows.end(),
                    columns.begin() + row_begin[r],
                    columns.begin() + row_begin[r + 1]);
      }
      const auto from_others =
        some_to_some(covers->communicator(), rank_to_rows);
      sent.assign(rank_to_rows.begin(), rank_to_rows.end());
      received.assign(from_others.begin(), from_others.end());

      // merge received rows with those of this rank
      std::vector<std::vector<unsigned int>> extra(n_owned);
      for (const auto &[rank, rows] : received)
        for (std::size_t i = 0; i < rows.size(); i += 2 + rows[i + 1])
          extra[rows[i] - first_owned].insert(
            extra[rows[i] - first_owned].end(),
            rows.begin() + i + 2,
            rows.begin() + i + 2 + rows[i + 1]);
      std::vector<std::size_t>  new_begin(1, 0);
      std::vector<unsigned int> new_columns;
      new_columns.reserve(columns.size());
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        new_columns.insert(new_columns.end(),
                           columns.begin() + row_begin[r],
                           columns.begin() + row_begin[r + 1]);
        if (r < n_owned && !extra[r].empty())
        {
          new_columns.insert(new_columns.end(),
                             extra[r].begin(),
                             extra[r].end());
          const auto begin = new_columns.begin() + new_begin[r];
          std::sort(begin, new_columns.end());
          new_columns.erase(std::unique(begin, new_columns.end()),
                            new_columns.end());
        }
        new_begin.push_back(new_columns.size());
      }
      columns.swap(new_columns);
      row_begin.swap(new_begin);
    }


    void
    CoverMatrixAssembler::localize_columns()
    {
      if (n_owned == covers->n_global_covers())
        return;

      // columns received from other ranks have no local number yet
      const std::vector<unsigned int> row_ghosts = ghost_covers;
      for (const unsigned int k : columns)
        if (k < first_owned || k >= first_owned + n_owned)
          ghost_covers.push_back(k);
      std::sort(ghost_covers.begin(), ghost_covers.end());
      ghost_covers.erase(std::unique(ghost_covers.begin(), ghost_covers.end()),
                         ghost_covers.end());
      for (const unsigned int k : row_ghosts)
        cover_to_local[covers->local_cover(k)] = row_of(k);

      std::vector<std::size_t>  new_begin(1, 0);
      std::vector<unsigned int> new_columns;
      new_columns.reserve(columns.size());
      const auto copy_row = [&](const unsigned int r) {
        for (std::size_t i = row_begin[r]; i < row_begin[r + 1]; ++i)
          new_columns.push_back(row_of(columns[i]));
        std::sort(new_columns.begin() + new_begin.back(), new_columns.end());
        new_begin.push_back(new_columns.size());
      };
      for (unsigned int r = 0; r < n_owned; ++r)
        copy_row(r);
      unsigned int old_ghost = 0;
      for (const unsigned int k : ghost_covers)
        if (old_ghost < row_ghosts.size() && row_ghosts[old_ghost] == k)
          copy_row(n_owned + old_ghost++);
        else
          new_begin.push_back(new_columns.size());
      columns.swap(new_columns);
      row_begin.swap(new_begin);
      n_rows = n_owned + ghost_covers.size();
    }


    double *
    CoverMatrixAssembler::find_entry(const unsigned int row,
                                     const unsigned int column,
                                     unsigned int      &stride)
    {
      const auto begin = columns.begin() + row_begin[row];
      const auto end   = columns.begin() + row_begin[row + 1];
      const auto it    = std::lower_bound(begin, end, column);
      Assert(it != end && *it == column, dealii::ExcInternalError());
      stride = 2 * (row_begin[row + 1] - row_begin[row]);
      return entries + 4 * row_begin[row] + 2 * (it - begin);
    }


    void
    CoverMatrixAssembler::add(
      const dealii::ArrayView<const unsigned int> covers,
      const double                               *matrix,
      const double                               *rhs)
    {
      if (has_constrained(covers))
        add_constrained(covers, matrix, rhs);
      else
        add_to_rows(covers.data(), covers.size(), matrix, rhs);
    }


    void
    CoverMatrixAssembler::add_to_rows(const unsigned int *covers,
                                      const unsigned int  n,
                                      const double       *matrix,
                                      const double       *rhs)
    {
      // insertion sort by local number, so that each row is traversed only once
      constexpr unsigned int n_max = 128;
      AssertThrow(n <= n_max, dealii::ExcInternalError());
      unsigned int order[n_max], number[n_max];
      for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int k = cover_to_local[covers[i]];
        unsigned int       j = i;
        for (; j > 0 && number[j - 1] > k; --j)
        {
          number[j] = number[j - 1];
          order[j]  = order[j - 1];
        }
        number[j] = k;
        order[j]  = i;
      }

      for (unsigned int a = 0; a < n; ++a)
      {
        const unsigned int r = number[a];
        if (!is_active_row.empty() && is_active_row[r] == 0)
          continue;
        const double       *from   = matrix + 4 * n * order[a];
        const unsigned int *row    = columns.data() + row_begin[r];
        const std::size_t   length = row_begin[r + 1] - row_begin[r];
        double             *first  = entries + 4 * row_begin[r];
        double             *second = first + 2 * length;
        std::size_t         p      = 0;
        for (unsigned int b = 0; b < n; ++b)
        {
          while (row[p] != number[b])
          {
            ++p;
            Assert(p < length, dealii::ExcInternalError());
          }
          const double *entry = from + 2 * order[b];
          first[2 * p] += entry[0];
          first[2 * p + 1] += entry[1];
          second[2 * p] += entry[2 * n];
          second[2 * p + 1] += entry[2 * n + 1];
        }
        right_hand_side[2 * r] += rhs[2 * order[a]];
        right_hand_side[2 * r + 1] += rhs[2 * order[a] + 1];
      }
    }


    void
    CoverMatrixAssembler::add_rhs(
      const dealii::ArrayView<const unsigned int> covers,
      const double                               *rhs)
    {
      for (unsigned int i = 0; i < covers.size(); ++i)
      {
        const double      *f = rhs + 2 * i;
        const unsigned int x = cover_to_expansion[covers[i]];
        if (x == invalid_index)
        {
          const unsigned int r = cover_to_local[covers[i]];
          right_hand_side[2 * r] += f[0];
          right_hand_side[2 * r + 1] += f[1];
          continue;
        }
        for (unsigned int t = expansion.begin[x]; t < expansion.begin[x + 1];
             ++t)
        {
          const std::array<double, 4> &w = expansion.terms[t].entry;
          const unsigned int r = cover_to_local[expansion.terms[t].cover];
          right_hand_side[2 * r] += w[0] * f[0] + w[2] * f[1];
          right_hand_side[2 * r + 1] += w[1] * f[0] + w[3] * f[1];
        }
      }
    }


    void
    CoverMatrixAssembler::set_active_rows(const std::vector<bool> &blocks)
    {
      if (!blocks.empty() && active_rows.empty())
      {
        const ManifoldMesh       &mesh = covers->manifold_mesh();
        std::vector<unsigned int> row_to_block(n_owned);
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const unsigned int k : covers->covers(e))
            row_to_block[cover_to_local[k]] = mesh.block(e);
        active_rows.reinit(row_to_block);
      }
      active_rows.select(blocks);
      is_active_row.assign(blocks.empty() ? 0 : n_rows, 0);
      for (const unsigned int r : active_rows.chosen())
        is_active_row[r] = 1;
    }


    void
    CoverMatrixAssembler::reset(const bool with_matrix)
    {
      if (with_matrix && active_rows.all())
        std::fill_n(entries, 4 * columns.size(), 0.);
      else if (with_matrix)
        active_rows.for_each(n_rows, [this](const unsigned int r) {
          std::fill(entries + 4 * row_begin[r],
                    entries + 4 * row_begin[r + 1],
                    0.);
        });
      active_rows.for_each(n_rows, [this](const unsigned int r) {
        right_hand_side[2 * r] = right_hand_side[2 * r + 1] = 0.;
      });
    }


    /// Add T^T A T and T^T (f - A g) for a local matrix A and right-hand side f, where
    /// u = T z + g are the constraints of the local unknowns u.
    void
    CoverMatrixAssembler::add_constrained(
      const dealii::ArrayView<const unsigned int> covers,
      const double                               *matrix,
      const double                               *rhs)
    {
      local_covers.clear();
      expand(covers, local_covers);
      const unsigned int n = covers.size(), m = local_covers.size();

      // the 2 x 2 entries of the rows of T
      static const std::array<double, 4> identity = {{1., 0., 0., 1.}};
      parts.clear();
      parts_begin.assign(1, 0);
      local_inhomogeneity.assign(2 * n, 0.);
      const auto position_of = [&](const unsigned int cover) {
        return static_cast<unsigned int>(
          std::find(local_covers.begin(), local_covers.end(), cover) -
          local_covers.begin());
      };
      for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int x = cover_to_expansion[covers[i]];
        if (x == invalid_index)
          parts.push_back({position_of(covers[i]), identity.data()});
        else
        {
          for (unsigned int t = expansion.begin[x]; t < expansion.begin[x + 1];
               ++t)
            parts.push_back({position_of(expansion.terms[t].cover),
                             expansion.terms[t].entry.data()});
          local_inhomogeneity[2 * i]     = expansion.inhomogeneity[x][0];
          local_inhomogeneity[2 * i + 1] = expansion.inhomogeneity[x][1];
        }
        parts_begin.push_back(parts.size());
      }

      local_rhs.assign(2 * m, 0.);
      local_matrix.assign(4 * m * m, 0.);
      local_product.assign(4 * n * m, 0.); // A T, (2n x 2m)
      for (unsigned int i = 0; i < 2 * n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double *a = matrix + 2 * n * i + 2 * j;
          for (unsigned int t = parts_begin[j]; t < parts_begin[j + 1]; ++t)
          {
            const double *w = parts[t].entry;
            double       *h =
              local_product.data() + 2 * m * i + 2 * parts[t].position;
            h[0] += a[0] * w[0] + a[1] * w[2];
            h[1] += a[0] * w[1] + a[1] * w[3];
          }
        }
      for (unsigned int i = 0; i < n; ++i)
      {
        double f[2] = {rhs[2 * i], rhs[2 * i + 1]};
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int j = 0; j < 2 * n; ++j)
            f[c] -= matrix[2 * n * (2 * i + c) + j] * local_inhomogeneity[j];
        for (unsigned int t = parts_begin[i]; t < parts_begin[i + 1]; ++t)
        {
          const double      *w  = parts[t].entry;
          const unsigned int p  = parts[t].position;
          const double      *h0 = local_product.data() + 2 * m * (2 * i);
          const double      *h1 = h0 + 2 * m;
          double            *k0 = local_matrix.data() + 2 * m * (2 * p);
          double            *k1 = k0 + 2 * m;
          for (unsigned int j = 0; j < 2 * m; ++j)
          {
            k0[j] += w[0] * h0[j] + w[2] * h1[j];
            k1[j] += w[1] * h0[j] + w[3] * h1[j];
          }
          local_rhs[2 * p] += w[0] * f[0] + w[2] * f[1];
          local_rhs[2 * p + 1] += w[1] * f[0] + w[3] * f[1];
        }
      }
      add_to_rows(local_covers.data(),
                  m,
                  local_matrix.data(),
                  local_rhs.data());
    }


    void
    CoverMatrixAssembler::exchange_values(const bool with_matrix)
    {
      using namespace dealii::Utilities::MPI;

      // each row is sent as two entries of the right-hand side, followed by its matrix entries
      std::map<unsigned int, std::vector<double>> rank_to_values;
      for (const auto &[rank, rows] : sent)
        for (std::size_t i = 0; i < rows.size(); i += 2 + rows[i + 1])
        {
          const unsigned int   r   = row_of(rows[i]);
          std::vector<double> &out = rank_to_values[rank];
          out.push_back(right_hand_side[2 * r]);
          out.push_back(right_hand_side[2 * r + 1]);
          for (unsigned int j = 0; with_matrix && j < rows[i + 1]; ++j)
          {
            unsigned int  stride;
            const double *entry =
              find_entry(r, row_of(rows[i + 2 + j]), stride);
            out.insert(out.end(),
                       {entry[0], entry[1], entry[stride], entry[stride + 1]});
          }
        }
      const auto from_others =
        some_to_some(covers->communicator(), rank_to_values);
      for (const auto &[rank, rows] : received)
      {
        const double *in = from_others.at(rank).data();
        for (std::size_t i = 0; i < rows.size(); i += 2 + rows[i + 1])
        {
          const unsigned int r = row_of(rows[i]);
          right_hand_side[2 * r] += *in++;
          right_hand_side[2 * r + 1] += *in++;
          for (unsigned int j = 0; with_matrix && j < rows[i + 1]; ++j, in += 4)
          {
            unsigned int stride;
            double      *entry = find_entry(r, row_of(rows[i + 2 + j]), stride);
            entry[0] += in[0];
            entry[1] += in[1];
            entry[stride] += in[2];
            entry[stride + 1] += in[3];
          }
        }
      }
    }


    /**
     * Rows of constrained unknowns, and of unknowns whose support has no area,
     * are empty. They get the mean of the other diagonal entries.
     */
    void
    CoverMatrixAssembler::fix_empty_diagonals()
    {
      if (leaves_empty_rows)
        return;
      std::array<double, 2> sum_and_count = {{0., 0.}};
      const auto            diagonal      = [this](const unsigned int row,
                                   const unsigned int c) -> double                 &{
        unsigned int stride;
        double      *entry = find_entry(row, row, stride);
        return entry[c * stride + c];
      };
      active_rows.for_each(n_owned, [&](const unsigned int r) {
        for (unsigned int c = 0; c < 2; ++c)
          if (diagonal(r, c) != 0.)
          {
            sum_and_count[0] += std::abs(diagonal(r, c));
            sum_and_count[1] += 1.;
          }
      });
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(sum_and_count.data(), 2),
        covers->communicator(),
        dealii::ArrayView<double>(sum_and_count.data(), 2));
      const double mean =
        sum_and_count[1] > 0. ? sum_and_count[0] / sum_and_count[1] : 1.;
      active_rows.for_each(n_owned, [&](const unsigned int r) {
        for (unsigned int c = 0; c < 2; ++c)
          if (diagonal(r, c) == 0.)
            diagonal(r, c) = mean;
      });
    }
  } // namespace internal
} // namespace NMM
