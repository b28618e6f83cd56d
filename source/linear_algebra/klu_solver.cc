#include <nmm/base/exceptions.h>

#include <algorithm>
#include <base/disjoint_sets.h>
#include <klu.h>
#include <linear_algebra/klu_solver.h>
#include <linear_algebra/matrix_rows.h>
#include <numeric>
#include <vector>

namespace NMM
{
  namespace internal
  {
    struct KluSolver::Data
    {
      Data()
      {
        klu_defaults(&common);
        // forces over displacements everywhere: rows need no scaling, and neither does what
        // we put together need checking
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

      /// Call action(row, column, value) where the value is not zero, both being of
      /// @p rows and counted among them, until it returns false. False if it
      /// did.
      template <typename Action>
      bool
      for_each_value(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                     const Action                                 &action) const
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

      void
      number_rows(const unsigned int n, const std::vector<unsigned int> &some)
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

      static constexpr unsigned int left_out = -1;

      klu_common    common;
      klu_symbolic *symbolic = nullptr;
      klu_numeric  *numeric  = nullptr;
      /// Rows of A, which KLU takes for columns of its transpose.
      std::vector<int>    begins, columns;
      std::vector<double> values;
      /// Of unknowns that are coupled, and the size of each set at its least member.
      DisjointSets              groups;
      std::vector<unsigned int> sizes;
      /// Rows that are solved for, and the number of each row among them.
      std::vector<unsigned int> rows, numbers;
      std::vector<double>       scratch;
    };


    KluSolver::KluSolver()
      : data(std::make_unique<Data>())
    {
    }


    KluSolver::~KluSolver() = default;


    bool
    KluSolver::is_suitable(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                           const std::vector<unsigned int>              &rows)
    {
      Data &d = *data;
      d.number_rows(matrix.m(), rows);
      d.groups.reinit(d.rows.size());
      d.sizes.assign(d.rows.size(), 1);
      return d.for_each_value(
        matrix,
        [&](const unsigned int row, const unsigned int column, const double) {
          const unsigned int a = d.groups.find(row), b = d.groups.find(column);
          if (a == b)
            return true;
          d.groups.join(a, b);
          d.sizes[std::min(a, b)] = d.sizes[a] + d.sizes[b];
          return d.sizes[std::min(a, b)] <= max_group;
        });
    }


    double
    KluSolver::analyze(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                       const std::vector<unsigned int>              &rows)
    {
      Data &d = *data;
      d.number_rows(matrix.m(), rows);
      const int n = d.rows.size();
      d.begins.assign(1, 0);
      d.columns.clear();
      d.values.clear();
      d.for_each_value(matrix,
                       [&](const unsigned int row,
                           const unsigned int column,
                           const double       value) {
                         d.begins.resize(row + 1, d.columns.size());
                         d.columns.push_back(column);
                         d.values.push_back(value);
                         return true;
                       });
      d.begins.resize(n + 1, d.columns.size());

      d.clear();
      d.symbolic = klu_analyze(n, d.begins.data(), d.columns.data(), &d.common);
      return d.symbolic == nullptr || n == 0 ? 0. : d.symbolic->est_flops / n;
    }


    void
    KluSolver::factorize()
    {
      Data &d = *data;
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
    }


    double
    KluSolver::n_factor_entries() const
    {
      const klu_numeric *factors = data->numeric;
      return factors == nullptr ? 0. : double(factors->lnz) + factors->unz;
    }


    void
    KluSolver::solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
                     dealii::TrilinosWrappers::MPI::Vector       &solution,
                     const std::vector<bool> & /*blocks*/)
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
