#include <nmm/linear_algebra/block_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <base/fetch.h>
#include <linear_algebra/matrix_rows.h>
#include <numeric>

namespace NMM
{
  using internal::MatrixRows;

  bool
  BlockMatrix::is_suitable(const std::vector<unsigned int> &unknown_to_block)
  {
    unsigned int first = 0;
    for (unsigned int i = 0; i < unknown_to_block.size(); ++i)
    {
      if (unknown_to_block[i] != unknown_to_block[first])
      {
        if (unknown_to_block[i] != unknown_to_block[first] + 1)
          return false;
        first = i;
      }
      if (i - first >= max_block)
        return false;
    }
    return !unknown_to_block.empty() && unknown_to_block[0] == 0;
  }


  BlockMatrix::BlockMatrix(const std::vector<unsigned int> &unknown_to_block)
    : unknown_to_block(unknown_to_block)
  {
    Assert(is_suitable(unknown_to_block),
           dealii::ExcMessage("Blocks are large or scattered."));
    const unsigned int n = unknown_to_block.back() + 1;
    begins.assign(n + 1, 0);
    for (const unsigned int block : unknown_to_block)
      ++begins[block + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    first_of_rows.assign(n, none);
  }


  void
  BlockMatrix::clear()
  {
    std::fill(first_of_rows.begin(), first_of_rows.end(), none);
    entries.clear();
    values.clear();
  }


  void
  BlockMatrix::begin_rows(const std::vector<bool> &blocks)
  {
    active = blocks;
    for (unsigned int b = 0; b < n_blocks(); ++b)
      if (is_active(b))
      {
        first_of_rows[b] = none;
        append(b, b);
      }
  }


  double *
  BlockMatrix::append(const unsigned int row, const unsigned int column)
  {
    const std::size_t begin = values.size();
    values.resize(begin + std::size_t(size(row)) * size(column), 0.);
    unsigned int *last = &first_of_rows[row];
    while (*last != none)
      last = &entries[*last].next;
    *last = entries.size();
    entries.push_back({begin, column, none});
    return values.data() + begin;
  }


  double *
  BlockMatrix::block(const unsigned int row, const unsigned int column)
  {
    for (unsigned int i = first_of_rows[row]; i != none; i = entries[i].next)
      if (entries[i].column == column)
        return values.data() + entries[i].begin;
    return append(row, column);
  }


  void
  BlockMatrix::add(const dealii::ArrayView<const unsigned int> covers,
                   const double                               *matrix)
  {
    const unsigned int n      = covers.size();
    const auto         end_of = [&](const unsigned int first) {
      unsigned int       last  = first;
      const unsigned int block = block_of(2 * covers[first]);
      while (last < n && block_of(2 * covers[last]) == block)
        ++last;
      return last;
    };
    for (unsigned int i = 0, i_end; i < n; i = i_end)
    {
      i_end                  = end_of(i);
      const unsigned int row = block_of(2 * covers[i]);
      if (!is_active(row))
        continue;
      const unsigned int height = size(row);
      for (unsigned int j = 0, j_end; j < n; j = j_end)
      {
        j_end                     = end_of(j);
        const unsigned int column = block_of(2 * covers[j]);
        double            *to     = block(row, column);
        for (unsigned int a = i; a < i_end; ++a)
        {
          const double      *from = matrix + std::size_t(4) * n * a;
          const unsigned int r    = 2 * covers[a] - begin(row);
          for (unsigned int b = j; b < j_end; ++b)
          {
            double *at = to + height * (2 * covers[b] - begin(column)) + r;
            at[0] += from[2 * b];
            at[1] += from[2 * n + 2 * b];
            at[height] += from[2 * b + 1];
            at[height + 1] += from[2 * n + 2 * b + 1];
          }
        }
      }
    }
  }


  void
  BlockMatrix::add(const double factor, const Matrix &matrix)
  {
    const MatrixRows from(matrix);
    const auto       next_active = [this](unsigned int b) {
      while (b < n_blocks() && !is_active(b))
        ++b;
      return b;
    };
    for (unsigned int b = next_active(0), next; b < n_blocks(); b = next)
    {
      next = next_active(b + 1);
      if (next < n_blocks())
      {
        const int first = from.begins[begin(next)];
        internal::fetch(from.values + first,
                        from.begins[begin(next + 1)] - first);
      }
      const unsigned int n  = size(b);
      double            *to = block(b, b);
      for (unsigned int r = 0; r < n; ++r)
      {
        const int     first   = from.begins[begin(b) + r];
        const int     length  = from.begins[begin(b) + r + 1] - first;
        const double *entry   = from.values + first;
        const int    *columns = from.columns + first;
        // of a full row columns need not be read
        const bool is_full = length == static_cast<int>(n);
        for (int e = 0; e < length; ++e)
        {
          const unsigned int c = is_full ? e : columns[e] - begin(b);
          Assert(columns[e] == static_cast<int>(begin(b) + c) && c < n,
                 dealii::ExcMessage("Blocks are coupled."));
          to[std::size_t(n) * c + r] += factor * entry[e];
        }
      }
    }
  }


  void
  BlockMatrix::read(const Matrix            &matrix,
                    const std::vector<bool> &blocks,
                    const Couplings         &couplings)
  {
    clear();
    begin_rows(blocks);
    for (unsigned int b = 0; b < n_blocks(); ++b)
      for (const unsigned int other : couplings[b])
        for (const auto &[row, column] :
             {std::make_pair(b, other), std::make_pair(other, b)})
          if (is_active(row))
            (void)block(row, column);

    const MatrixRows from(matrix);
    for (unsigned int b = 0; b < n_blocks(); ++b)
      for (unsigned int i = is_active(b) ? first_of_rows[b] : none; i != none;
           i              = entries[i].next)
      {
        const int first = begin(entries[i].column),
                  last  = begin(entries[i].column + 1);
        double *to      = values.data() + entries[i].begin;
        for (unsigned int r = 0; r < size(b); ++r)
        {
          const int end = from.begins[begin(b) + r + 1];
          int e = std::lower_bound(from.columns + from.begins[begin(b) + r],
                                   from.columns + end,
                                   first) -
                  from.columns;
          for (; e < end && from.columns[e] < last; ++e)
            to[std::size_t(size(b)) * (from.columns[e] - first) + r] =
              from.values[e];
        }
      }
  }


  BlockMatrix::Matrix
  BlockMatrix::sparse() const
  {
    const unsigned int             n = unknown_to_block.size();
    dealii::DynamicSparsityPattern pattern(n);
    for (unsigned int i = 0; i < n; ++i)
      pattern.add(i, i);
    const auto for_each_entry = [this](const auto &action) {
      for (unsigned int b = 0; b < n_blocks(); ++b)
        for_each_in_row(b, [&](const unsigned int column, const double *block) {
          for (unsigned int c = 0; c < size(column); ++c)
            for (unsigned int r = 0; r < size(b); ++r)
              action(begin(b) + r,
                     begin(column) + c,
                     block[std::size_t(size(b)) * c + r]);
        });
    };
    for_each_entry([&](const unsigned int i, const unsigned int j, double) {
      pattern.add(i, j);
    });
    Matrix result;
    result.reinit(dealii::complete_index_set(n), pattern, MPI_COMM_SELF);
    for_each_entry([&](const unsigned int i,
                       const unsigned int j,
                       const double       value) { result.set(i, j, value); });
    result.compress(dealii::VectorOperation::insert);
    return result;
  }
} // namespace NMM
