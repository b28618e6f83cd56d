#include <nmm/base/exceptions.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <klu.h>
#include <mechanics/klu_solver.h>
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

      /// Root of the tree that i is in; halves the way for the next time.
      unsigned int
      group(unsigned int i)
      {
        while (parents[i] != i)
          i = parents[i] = parents[parents[i]];
        return i;
      }

      /// Call action(row, column, value) where the value is not zero, until it
      /// returns false. False if it did.
      template <typename Action>
      static bool
      for_each_value(const Epetra_CrsMatrix &matrix, const Action &action)
      {
        for (int row = 0; row < matrix.NumMyRows(); ++row)
        {
          int     n;
          double *values;
          int    *columns;
          matrix.ExtractMyRowView(row, n, values, columns);
          for (int i = 0; i < n; ++i)
            if (values[i] != 0. && !action(row, columns[i], values[i]))
              return false;
        }
        return true;
      }

      klu_common    common;
      klu_symbolic *symbolic = nullptr;
      klu_numeric  *numeric  = nullptr;
      /// Rows of A, which KLU takes for columns of its transpose.
      std::vector<int>          begins, columns;
      std::vector<double>       values;
      std::vector<unsigned int> parents, sizes;
    };


    KluSolver::KluSolver()
      : data(std::make_unique<Data>())
    {
    }


    KluSolver::~KluSolver() = default;


    bool
    KluSolver::is_suitable(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      Data &d = *data;
      d.parents.resize(matrix.m());
      std::iota(d.parents.begin(), d.parents.end(), 0);
      d.sizes.assign(matrix.m(), 1);
      return Data::for_each_value(
        matrix.trilinos_matrix(),
        [&](const int row, const int column, const double) {
          unsigned int a = d.group(row), b = d.group(column);
          if (a == b)
            return true;
          if (d.sizes[a] < d.sizes[b])
            std::swap(a, b);
          d.parents[b] = a;
          d.sizes[a] += d.sizes[b];
          return d.sizes[a] <= max_group;
        });
    }


    void
    KluSolver::factorize(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      Data &d = *data;
      d.begins.assign(1, 0);
      d.columns.clear();
      d.values.clear();
      Data::for_each_value(matrix.trilinos_matrix(),
                           [&](const int    row,
                               const int    column,
                               const double value) {
                             d.begins.resize(row + 1, d.columns.size());
                             d.columns.push_back(column);
                             d.values.push_back(value);
                             return true;
                           });
      d.begins.resize(matrix.m() + 1, d.columns.size());

      d.clear();
      d.symbolic =
        klu_analyze(matrix.m(), d.begins.data(), d.columns.data(), &d.common);
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
                     dealii::TrilinosWrappers::MPI::Vector       &solution)
    {
      Data &d = *data;
      if (&rhs != &solution)
        std::copy(rhs.begin(), rhs.end(), solution.begin());
      klu_tsolve(d.symbolic,
                 d.numeric,
                 solution.size(),
                 1,
                 &*solution.begin(),
                 &d.common);
    }
  } // namespace internal
} // namespace NMM
