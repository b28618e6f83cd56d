#include <nmm/covers/unknowns.h>
#include <nmm/linear_algebra/body_matrix.h>

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
  BodyMatrix::is_suitable(const std::vector<unsigned int> &unknown_to_body)
  {
    unsigned int first = 0;
    for (unsigned int i = 0; i < unknown_to_body.size(); ++i)
    {
      if (unknown_to_body[i] != unknown_to_body[first])
      {
        if (unknown_to_body[i] != unknown_to_body[first] + 1)
          return false;
        first = i;
      }
      if (i - first >= max_body)
        return false;
    }
    return !unknown_to_body.empty() && unknown_to_body[0] == 0;
  }


  BodyMatrix::BodyMatrix(const std::vector<unsigned int> &unknown_to_body)
    : unknown_to_body(unknown_to_body)
  {
    Assert(is_suitable(unknown_to_body),
           dealii::ExcMessage("Bodies are large or scattered."));
    const unsigned int n = unknown_to_body.back() + 1;
    begins.assign(n + 1, 0);
    for (const unsigned int body : unknown_to_body)
      ++begins[body + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    first_of_rows.assign(n, none);
  }


  void
  BodyMatrix::begin_rows(const std::vector<bool> &bodies)
  {
    std::fill(first_of_rows.begin(), first_of_rows.end(), none);
    couplings.clear();
    values.clear();
    stored = bodies;
    for (unsigned int b = 0; b < n_bodies(); ++b)
      if (is_stored(b))
        append(b, b);
  }


  double *
  BodyMatrix::append(const unsigned int row, const unsigned int column)
  {
    const std::size_t begin = values.size();
    values.resize(begin + std::size_t(size(row)) * size(column), 0.);
    unsigned int *last = &first_of_rows[row];
    while (*last != none)
      last = &couplings[*last].next;
    *last = couplings.size();
    couplings.push_back({begin, column, none});
    return values.data() + begin;
  }


  double *
  BodyMatrix::coupling(const unsigned int row, const unsigned int column)
  {
    for (unsigned int i = first_of_rows[row]; i != none; i = couplings[i].next)
      if (couplings[i].column == column)
        return values.data() + couplings[i].begin;
    return append(row, column);
  }


  void
  BodyMatrix::add(const dealii::ArrayView<const unsigned int> covers,
                  const double                               *matrix)
  {
    const unsigned int n      = covers.size();
    const auto         end_of = [&](const unsigned int first) {
      unsigned int       last = first;
      const unsigned int body = body_of(unknown_of(covers[first], 0));
      while (last < n && body_of(unknown_of(covers[last], 0)) == body)
        ++last;
      return last;
    };
    for (unsigned int i = 0, i_end; i < n; i = i_end)
    {
      i_end                  = end_of(i);
      const unsigned int row = body_of(unknown_of(covers[i], 0));
      if (!is_stored(row))
        continue;
      const unsigned int height = size(row);
      for (unsigned int j = 0, j_end; j < n; j = j_end)
      {
        j_end                     = end_of(j);
        const unsigned int column = body_of(unknown_of(covers[j], 0));
        double            *to     = coupling(row, column);
        for (unsigned int a = i; a < i_end; ++a)
        {
          const double      *from = matrix + std::size_t(4) * n * a;
          const unsigned int r    = unknown_of(covers[a], 0) - begin(row);
          for (unsigned int b = j; b < j_end; ++b)
          {
            double *at =
              to + height * (unknown_of(covers[b], 0) - begin(column)) + r;
            at[0] += from[unknown_of(b, 0)];
            at[1] += from[2 * n + unknown_of(b, 0)];
            at[height] += from[unknown_of(b, 1)];
            at[height + 1] += from[2 * n + unknown_of(b, 1)];
          }
        }
      }
    }
  }


  void
  BodyMatrix::add(const double factor, const Matrix &matrix)
  {
    const MatrixRows from(matrix);
    const auto       next_stored = [this](unsigned int b) {
      while (b < n_bodies() && !is_stored(b))
        ++b;
      return b;
    };
    for (unsigned int b = next_stored(0), next; b < n_bodies(); b = next)
    {
      next = next_stored(b + 1);
      if (next < n_bodies())
      {
        const int first = from.begins[begin(next)];
        internal::fetch(from.values + first,
                        from.begins[begin(next + 1)] - first);
      }
      const unsigned int n  = size(b);
      double            *to = coupling(b, b);
      for (unsigned int r = 0; r < n; ++r)
      {
        const int     first   = from.begins[begin(b) + r];
        const int     length  = from.begins[begin(b) + r + 1] - first;
        const double *entry   = from.values + first;
        const int    *columns = from.columns + first;
        // columns of a full row need not be read
        const bool is_full = length == static_cast<int>(n);
        for (int e = 0; e < length; ++e)
        {
          const unsigned int c = is_full ? e : columns[e] - begin(b);
          Assert(columns[e] == static_cast<int>(begin(b) + c) && c < n,
                 dealii::ExcMessage("Bodies are coupled."));
          to[std::size_t(n) * c + r] += factor * entry[e];
        }
      }
    }
  }


  void
  BodyMatrix::read(const Matrix            &matrix,
                   const std::vector<bool> &bodies,
                   const Couplings         &neighbors)
  {
    begin_rows(bodies);
    for (unsigned int b = 0; b < n_bodies(); ++b)
      for (const unsigned int other : neighbors[b])
        for (const auto &[row, column] :
             {std::make_pair(b, other), std::make_pair(other, b)})
          if (is_stored(row))
            (void)coupling(row, column);

    const MatrixRows from(matrix);
    for (unsigned int b = 0; b < n_bodies(); ++b)
      for (unsigned int i = is_stored(b) ? first_of_rows[b] : none; i != none;
           i              = couplings[i].next)
      {
        const int first = begin(couplings[i].column),
                  last  = begin(couplings[i].column + 1);
        double *to      = values.data() + couplings[i].begin;
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


  BodyMatrix::Matrix
  BodyMatrix::sparse() const
  {
    const unsigned int             n = unknown_to_body.size();
    dealii::DynamicSparsityPattern pattern(n);
    for (unsigned int i = 0; i < n; ++i)
      pattern.add(i, i);
    const auto for_each_entry = [this](const auto &action) {
      for (unsigned int b = 0; b < n_bodies(); ++b)
        for_each_in_row(b,
                        [&](const unsigned int column, const double *values) {
                          for (unsigned int c = 0; c < size(column); ++c)
                            for (unsigned int r = 0; r < size(b); ++r)
                              action(begin(b) + r,
                                     begin(column) + c,
                                     values[std::size_t(size(b)) * c + r]);
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
