#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <base/disjoint_sets.h>
#include <klu.h>
#include <linear_algebra/klu_factorization.h>
#include <linear_algebra/matrix_rows.h>
#include <numeric>
#include <vector>

namespace NMM
{
  namespace internal
  {
    struct KluFactorization::Data
    {
      Data()
      {
        klu_defaults(&common);
        // All rows have the same unit (force over displacement), so that none needs scaling. The
        // negative value also skips the check of the input.
        common.scale = -1;
      }

      ~Data()
      {
        clear();
      }

      Data(const Data &) = delete;
      Data &
      operator=(const Data &) = delete;

      void
      clear()
      {
        klu_free_numeric(&numeric, &common);
        klu_free_symbolic(&symbolic, &common);
      }

      /// Call action(row, column, value) for each nonzero value in chosen rows and columns, until
      /// a call returns false. Rows and columns are numbered among the chosen
      /// ones. Returns whether all calls returned true.
      template <typename Action>
      bool
      for_each_value(const Matrix &matrix, const Action &action) const
      {
        const MatrixRows entries(matrix);
        for (unsigned int k = 0; k < rows.size(); ++k)
          for (int i = entries.begins[rows[k]]; i < entries.begins[rows[k] + 1];
               ++i)
            if (entries.values[i] != 0.)
            {
              const unsigned int column = numbers[entries.columns[i]];
              if (column != left_out && !action(k, column, entries.values[i]))
                return false;
            }
        return true;
      }

      /// Choose the rows @p some (empty: all) of a matrix with @p n rows.
      void
      choose_rows(const unsigned int n, const std::vector<unsigned int> &some)
      {
        for (const unsigned int row : rows)
          numbers[row] = left_out;
        numbers.resize(n, left_out);
        rows = some;
        if (some.empty())
        {
          rows.resize(n);
          std::iota(rows.begin(), rows.end(), 0U);
        }
        for (unsigned int k = 0; k < rows.size(); ++k)
          numbers[rows[k]] = k;
      }

      /// Whether no group of unknowns that are coupled by nonzero values has more than
      /// max_group unknowns.
      bool
      has_small_groups(const Matrix &matrix);

      /// Read the matrix and compute the order of elimination. Returns the number of operations
      /// of the factorization per unknown.
      double
      analyze(const Matrix &matrix);

      static constexpr unsigned int left_out = -1;

      bool          analysis_is_needed = false;
      klu_common    common;
      klu_symbolic *symbolic = nullptr;
      klu_numeric  *numeric  = nullptr;
      /// The chosen part of the matrix stored by rows; KLU, which expects columns, factorizes its
      /// transpose.
      std::vector<int>    begins, columns;
      std::vector<double> values;
      /// Sets of coupled unknowns, and the size of each set, stored at its representative.
      DisjointSets              groups;
      std::vector<unsigned int> sizes;
      /// Chosen rows, and the position of each row among them.
      std::vector<unsigned int> rows, numbers;
      std::vector<double>       scratch;
    };


    KluFactorization::KluFactorization()
      : data(std::make_unique<Data>())
    {
    }


    KluFactorization::~KluFactorization() = default;


    void
    KluFactorization::set_analysis_is_needed(const bool is_needed)
    {
      data->analysis_is_needed = is_needed;
    }


    bool
    KluFactorization::Data::has_small_groups(const Matrix &matrix)
    {
      groups.reinit(rows.size());
      sizes.assign(rows.size(), 1);
      return for_each_value(
        matrix,
        [&](const unsigned int row, const unsigned int column, const double) {
          const unsigned int a = groups.find(row), b = groups.find(column);
          if (a == b)
            return true;
          groups.join(a, b);
          sizes[std::min(a, b)] = sizes[a] + sizes[b];
          return sizes[std::min(a, b)] <= max_group;
        });
    }


    double
    KluFactorization::Data::analyze(const Matrix &matrix)
    {
      const int n = rows.size();
      begins.assign(1, 0);
      columns.clear();
      values.clear();
      for_each_value(matrix,
                     [&](const unsigned int row,
                         const unsigned int column,
                         const double       value) {
                       begins.resize(row + 1, columns.size());
                       columns.push_back(column);
                       values.push_back(value);
                       return true;
                     });
      begins.resize(n + 1, columns.size());

      clear();
      symbolic = klu_analyze(n, begins.data(), columns.data(), &common);
      return symbolic == nullptr || n == 0 ? 0. : symbolic->est_flops / n;
    }


    bool
    KluFactorization::factorize(const Matrix                    &matrix,
                                const std::vector<unsigned int> &rows)
    {
      Data &d = *data;
      if (dealii::Utilities::MPI::n_mpi_processes(
            matrix.get_mpi_communicator()) > 1)
        return false;
      d.choose_rows(matrix.m(), rows);
      const bool has_small_groups = d.has_small_groups(matrix);
      if (!has_small_groups && !d.analysis_is_needed)
        return false;
      if (d.analyze(matrix) > max_operations && !has_small_groups)
        return false;
      if (d.symbolic != nullptr)
        d.numeric = klu_factor(d.begins.data(),
                               d.columns.data(),
                               d.values.data(),
                               d.symbolic,
                               &d.common);
      AssertThrow(d.numeric != nullptr,
                  NumericalFailure(
                    "KLU's factorization failed with the status " +
                      std::to_string(d.common.status),
                    "",
                    d.common.status == KLU_SINGULAR
                      ? "the system is singular: check that every block is "
                        "held and has an area above rounding"
                      : "the system may be too large for this machine's "
                        "memory"));
      return true;
    }


    double
    KluFactorization::n_factor_entries() const
    {
      const klu_numeric *factors = data->numeric;
      return factors == nullptr ? 0. : double(factors->lnz) + factors->unz;
    }


    void
    KluFactorization::solve(const Vector &rhs,
                            Vector       &solution,
                            const std::vector<bool> & /*bodies*/)
    {
      Data &d = *data;
      d.scratch.clear();
      const auto from = rhs.begin();
      for (const unsigned int row : d.rows)
        d.scratch.push_back(*(from + row));
      klu_tsolve(
        d.symbolic, d.numeric, d.rows.size(), 1, d.scratch.data(), &d.common);
      const auto to = solution.begin();
      for (unsigned int k = 0; k < d.rows.size(); ++k)
        *(to + d.rows[k]) = d.scratch[k];
    }
  } // namespace internal
} // namespace NMM
