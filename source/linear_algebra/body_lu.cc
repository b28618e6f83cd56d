#include <nmm/base/types.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Epetra_BLAS.h>
#include <Epetra_LAPACK.h>
#include <algorithm>
#include <base/fetch.h>
#include <cmath>
#include <linear_algebra/body_lu.h>
#include <numeric>
#include <utility>

namespace NMM
{
  namespace internal
  {
    struct BodyLu::Data
    {
      /// The factors of a body j of n unknowns, where m is the number of unknowns of all bodies i
      /// that are coupled with j and eliminated later. Its entries in `values` are A_jj (n x n),
      /// then A_ij of all later bodies in one panel (m x n), then A_jj^-1 A_ji (n x m); each is
      /// stored column by column.
      struct Column
      {
        unsigned int body = 0, n = 0, m = 0;
        /// Range of its entries in `later`, and index of its first entry in `values` and of its
        /// first unknown in `x`.
        std::size_t  later_begin = 0, later_end = 0, diagonal = 0;
        unsigned int unknowns = 0;
        /// Index of its first unknown in the vectors of the caller.
        unsigned int first_unknown = 0;

        std::size_t
        lower() const
        {
          return diagonal + std::size_t(n) * n;
        }

        std::size_t
        upper() const
        {
          return lower() + std::size_t(n) * m;
        }
      };

      /// A body that is coupled with an earlier one: its index in `columns`, and the index of its
      /// first row in the panel of the earlier body.
      struct Later
      {
        unsigned int column = 0, offset = 0;
      };

      using Pairs = std::vector<BlockPair>;

      void
      choose_bodies(const BodyMatrix                &matrix,
                    const std::vector<unsigned int> &rows);

      /// Pairs of coupled bodies in both directions, given by their positions in `chosen`.
      Pairs
      find_pairs(const BodyMatrix &matrix) const;

      /// Order of elimination, given by positions in `chosen`.
      std::vector<unsigned int>
      order(const Pairs &pairs) const;

      void
      make_columns(const BodyMatrix                &matrix,
                   const Pairs                     &pairs,
                   const std::vector<unsigned int> &order);

      void
      read_values(const BodyMatrix &matrix);

      /// Pointer to the first entry of A_ik, and the stride between its columns; i and k are
      /// indices into `columns`.
      std::pair<double *, unsigned int>
      place(unsigned int i, unsigned int k);

      /// Eliminate a body. Returns false if a pivot of A_jj is too small.
      bool
      eliminate(const Column &column);

      void
      subtract_products(const Column &column);

      /// Bodies that are factorized, and the position of each body among them.
      std::vector<unsigned int> chosen, body_to_position;
      std::vector<Column>       columns;
      std::vector<unsigned int> position_to_column;
      std::vector<Later>        later;
      std::vector<double>       values;
      std::vector<int>          pivots;
      /// Scratch: products of panels, the unknowns in the order of elimination, and the unknowns
      /// of the later bodies of one column.
      std::vector<double> products, x, gathered;
      /// Columns of the bodies for which solve() was called.
      std::vector<const Column *> wanted;
      /// Scratch of make_columns(): first_child[j], next_child[first_child[j]], ... are the
      /// columns whose first later column is j.
      std::vector<unsigned int> first_child, next_child, begins, met, found;
      Epetra_BLAS               blas;
      Epetra_LAPACK             lapack;
    };


    BodyLu::BodyLu()
      : data(std::make_unique<Data>())
    {
    }


    BodyLu::~BodyLu() = default;


    void
    BodyLu::Data::choose_bodies(const BodyMatrix                &matrix,
                                const std::vector<unsigned int> &rows)
    {
      body_to_position.resize(matrix.n_bodies(), invalid_index);
      for (const unsigned int body : chosen)
        body_to_position[body] = invalid_index;
      chosen.clear();
      const auto choose = [this](const unsigned int body) {
        body_to_position[body] = chosen.size();
        chosen.push_back(body);
      };
      if (rows.empty())
        for (unsigned int body = 0; body < matrix.n_bodies(); ++body)
          choose(body);
      for (std::size_t i = 0; i < rows.size();
           i += matrix.size(matrix.body_of(rows[i])))
        choose(matrix.body_of(rows[i]));
    }


    BodyLu::Data::Pairs
    BodyLu::Data::find_pairs(const BodyMatrix &matrix) const
    {
      Pairs result;
      for (unsigned int p = 0; p < chosen.size(); ++p)
        matrix.for_each_in_row(chosen[p],
                               [&](const unsigned int body, const double *) {
                                 const unsigned int other =
                                   body_to_position[body];
                                 if (other == invalid_index || other == p)
                                   return;
                                 result.emplace_back(p, other);
                                 result.emplace_back(other, p);
                               });
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }


    std::vector<unsigned int>
    BodyLu::Data::order(const Pairs &pairs) const
    {
      const unsigned int                 n = chosen.size();
      std::vector<Eigen::Triplet<float>> triplets;
      triplets.reserve(pairs.size() + n);
      for (unsigned int p = 0; p < n; ++p)
        triplets.emplace_back(p, p, 1.f);
      for (const auto &[p, other] : pairs)
        triplets.emplace_back(p, other, 1.f);
      Eigen::SparseMatrix<float> graph(n, n);
      graph.setFromTriplets(triplets.begin(), triplets.end());
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> result(n);
      Eigen::AMDOrdering<int>()(graph, result);
      return {result.indices().data(), result.indices().data() + n};
    }


    void
    BodyLu::Data::make_columns(const BodyMatrix                &matrix,
                               const Pairs                     &pairs,
                               const std::vector<unsigned int> &order)
    {
      const unsigned int n = chosen.size();
      columns.assign(n, Column());
      position_to_column.resize(n);
      for (unsigned int j = 0; j < n; ++j)
        position_to_column[order[j]] = j;
      begins.assign(n + 1, 0);
      for (const auto &[p, other] : pairs)
        ++begins[p + 1];
      std::partial_sum(begins.begin(), begins.end(), begins.begin());

      // Eliminating a body couples all bodies that it is coupled with. This fill-in is recorded by
      // passing them on to the first of them in the order of elimination.
      first_child.assign(n, invalid_index);
      next_child.assign(n, invalid_index);
      met.assign(n, invalid_index);
      later.clear();
      std::size_t  n_values   = 0;
      unsigned int n_unknowns = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        Column &column       = columns[j];
        column.body          = chosen[order[j]];
        column.n             = matrix.size(column.body);
        column.first_unknown = matrix.begin(column.body);
        column.unknowns      = n_unknowns;
        n_unknowns += column.n;
        found.clear();
        met[j]         = j;
        const auto add = [&](const unsigned int i) {
          if (i > j && met[i] != j)
          {
            met[i] = j;
            found.push_back(i);
          }
        };
        for (unsigned int i = begins[order[j]]; i < begins[order[j] + 1]; ++i)
          add(position_to_column[pairs[i].second]);
        for (unsigned int child = first_child[j]; child != invalid_index;
             child              = next_child[child])
          for (std::size_t i = columns[child].later_begin;
               i < columns[child].later_end;
               ++i)
            add(later[i].column);
        std::sort(found.begin(), found.end());
        column.later_begin = later.size();
        for (const unsigned int i : found)
        {
          later.push_back({i, column.m});
          column.m += matrix.size(chosen[order[i]]);
        }
        column.later_end = later.size();
        if (!found.empty())
        {
          next_child[j]              = first_child[found.front()];
          first_child[found.front()] = j;
        }
        column.diagonal = n_values;
        n_values += std::size_t(column.n) * (column.n + 2 * column.m);
      }
      values.assign(n_values, 0.);
      pivots.resize(n_unknowns);
      x.resize(n_unknowns);
    }


    std::pair<double *, unsigned int>
    BodyLu::Data::place(const unsigned int i, const unsigned int k)
    {
      const Column &column = columns[std::min(i, k)];
      if (i == k)
        return {values.data() + column.diagonal, column.n};
      const auto found =
        std::lower_bound(later.begin() + column.later_begin,
                         later.begin() + column.later_end,
                         std::max(i, k),
                         [](const Later &entry, const unsigned int j) {
                           return entry.column < j;
                         });
      Assert(found->column == std::max(i, k), dealii::ExcInternalError());
      if (i > k)
        return {values.data() + column.lower() + found->offset, column.m};
      return {values.data() + column.upper() +
                std::size_t(found->offset) * column.n,
              column.n};
    }


    void
    BodyLu::Data::read_values(const BodyMatrix &matrix)
    {
      for (unsigned int j = 0; j < columns.size(); ++j)
      {
        if (j + 1 < columns.size())
          matrix.for_each_in_row(
            columns[j + 1].body,
            [&](const unsigned int other, const double *from) {
              fetch(from, std::size_t(columns[j + 1].n) * matrix.size(other));
            });
        matrix.for_each_in_row(
          columns[j].body, [&](const unsigned int other, const double *from) {
            const unsigned int p = body_to_position[other];
            if (p == invalid_index)
              return;
            const unsigned int k      = position_to_column[p];
            const auto [to, distance] = place(j, k);
            for (unsigned int c = 0; c < columns[k].n; ++c)
              std::copy_n(from + std::size_t(c) * columns[j].n,
                          columns[j].n,
                          to + std::size_t(c) * distance);
          });
      }
    }


    bool
    BodyLu::Data::eliminate(const Column &column)
    {
      // relative to the largest entry of A_jj [-]
      constexpr double least_pivot = 1e-14;

      const int n = column.n, m = column.m;
      double   *diagonal = values.data() + column.diagonal;
      int      *pivot    = pivots.data() + column.unknowns;
      double    largest  = 0.;
      for (int i = 0; i < n * n; ++i)
        largest = std::max(largest, std::abs(diagonal[i]));
      int info = 0;
      lapack.GETRF(n, n, diagonal, n, pivot, &info);
      if (info != 0)
        return false;
      for (int i = 0; i < n; ++i)
        if (!(std::abs(diagonal[i * (n + 1)]) > least_pivot * largest))
          return false;
      if (m == 0)
        return true;
      lapack.GETRS('N',
                   n,
                   m,
                   diagonal,
                   n,
                   pivot,
                   values.data() + column.upper(),
                   n,
                   &info);
      subtract_products(column);
      return true;
    }


    void
    BodyLu::Data::subtract_products(const Column &column)
    {
      const int n = column.n, m = column.m;
      products.resize(std::size_t(m) * m);
      blas.GEMM('N',
                'N',
                m,
                m,
                n,
                1.,
                values.data() + column.lower(),
                m,
                values.data() + column.upper(),
                n,
                0.,
                products.data(),
                m);
      const auto begin = later.begin() + column.later_begin,
                 end   = later.begin() + column.later_end;
      for (auto k = begin; k != end; ++k)
        for (auto i = begin; i != end; ++i)
        {
          const auto [to, distance] = place(i->column, k->column);
          const unsigned int n_i    = columns[i->column].n;
          const unsigned int n_k    = columns[k->column].n;
          const double      *from =
            products.data() + std::size_t(k->offset) * m + i->offset;
          for (unsigned int c = 0; c < n_k; ++c)
            for (unsigned int r = 0; r < n_i; ++r)
              to[std::size_t(c) * distance + r] -= from[std::size_t(c) * m + r];
        }
    }


    bool
    BodyLu::factorize(const BodyMatrix                &matrix,
                      const std::vector<unsigned int> &rows)
    {
      Data &d = *data;
      d.choose_bodies(matrix, rows);
      const Data::Pairs pairs = d.find_pairs(matrix);
      d.make_columns(matrix, pairs, d.order(pairs));
      d.read_values(matrix);
      for (const Data::Column &column : d.columns)
        if (!d.eliminate(column))
          return false;
      return true;
    }


    double
    BodyLu::n_factor_entries() const
    {
      return data->values.size();
    }


    void
    BodyLu::solve(const Vector            &rhs,
                  Vector                  &solution,
                  const std::vector<bool> &bodies)
    {
      Data         &d      = *data;
      const double *values = d.values.data();
      const auto    from   = rhs.begin();
      const auto    to     = solution.begin();
      d.wanted.clear();
      for (const Data::Column &column : d.columns)
        if (bodies.empty() || bodies[column.body])
        {
          d.wanted.push_back(&column);
          std::copy_n(from + column.first_unknown,
                      column.n,
                      d.x.begin() + column.unknowns);
        }

      for (const Data::Column *wanted : d.wanted)
      {
        const Data::Column &column = *wanted;
        double             *x      = d.x.data() + column.unknowns;
        int                 info   = 0;
        d.lapack.GETRS('N',
                       column.n,
                       1,
                       values + column.diagonal,
                       column.n,
                       d.pivots.data() + column.unknowns,
                       x,
                       column.n,
                       &info);
        if (column.m == 0)
          continue;
        d.gathered.resize(column.m);
        d.blas.GEMV('N',
                    column.m,
                    column.n,
                    1.,
                    values + column.lower(),
                    column.m,
                    x,
                    0.,
                    d.gathered.data());
        for (std::size_t i = column.later_begin; i < column.later_end; ++i)
        {
          const Data::Column &other = d.columns[d.later[i].column];
          for (unsigned int r = 0; r < other.n; ++r)
            d.x[other.unknowns + r] -= d.gathered[d.later[i].offset + r];
        }
      }
      for (auto i = d.wanted.size(); i > 0; --i)
      {
        const Data::Column *column = d.wanted[i - 1];
        double             *x      = d.x.data() + column->unknowns;
        if (i > 1)
        {
          const Data::Column &next = *d.wanted[i - 2];
          fetch(values + next.upper(), std::size_t(next.n) * next.m);
        }
        if (column->m > 0)
        {
          d.gathered.resize(column->m);
          for (std::size_t k = column->later_begin; k < column->later_end; ++k)
          {
            const Data::Column &other = d.columns[d.later[k].column];
            std::copy_n(d.x.data() + other.unknowns,
                        other.n,
                        d.gathered.data() + d.later[k].offset);
          }
          d.blas.GEMV('N',
                      column->n,
                      column->m,
                      -1.,
                      values + column->upper(),
                      column->n,
                      d.gathered.data(),
                      1.,
                      x);
        }
        std::copy_n(x, column->n, to + column->first_unknown);
      }
    }
  } // namespace internal
} // namespace NMM
