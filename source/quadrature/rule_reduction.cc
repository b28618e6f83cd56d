#include "rule_reduction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      constexpr double epsilon = std::numeric_limits<double>::epsilon();

      /// Computes a -= factor b on contiguous arrays, so that the compiler can vectorize it.
      inline void
      subtract_multiple(double *__restrict a,
                        const double *__restrict b,
                        const double      factor,
                        const std::size_t size)
      {
        for (std::size_t k = 0; k < size; ++k)
          a[k] -= factor * b[k];
      }
    } // namespace


    void
    RuleReduction::make_tableau(const std::vector<double> &values,
                                const std::vector<double> &weights,
                                const std::size_t          n_points,
                                const double               rank_tolerance)
    {
      n_columns = columns.size();
      stride    = n_columns;
      tableau.resize(n * stride);
      u.assign(n_columns, 1.);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < n_columns; ++c)
          tableau[i * stride + c] =
            values[i * n_points + columns[c]] * weights[columns[c]];
      right_side = residual;
      rows.clear();
      rank = 0;
      for (std::size_t i = 0; i < n && rank < n_columns; ++i)
      {
        double     *pivot_row = tableau.data() + i * stride;
        std::size_t best      = rank;
        for (std::size_t c = rank + 1; c < n_columns; ++c)
          if (std::abs(pivot_row[c]) > std::abs(pivot_row[best]))
            best = c;
        if (std::abs(pivot_row[best]) <= rank_tolerance)
          continue;
        if (best != rank)
        {
          std::swap(columns[best], columns[rank]);
          for (std::size_t r = 0; r < n; ++r)
            std::swap(tableau[r * stride + best], tableau[r * stride + rank]);
        }
        const double inverse = 1. / pivot_row[rank];
        for (std::size_t c = rank + 1; c < n_columns; ++c)
          pivot_row[c] *= inverse;
        right_side[i] *= inverse;
        for (std::size_t r = 0; r < n; ++r)
          if (r != i)
          {
            const double factor = tableau[r * stride + rank];
            if (factor == 0.)
              continue;
            subtract_multiple(tableau.data() + r * stride + rank + 1,
                              pivot_row + rank + 1,
                              factor,
                              n_columns - rank - 1);
            right_side[r] -= factor * right_side[i];
          }
        rows.push_back(i);
        ++rank;
      }
    }


    // The smallest (delta_B, delta_N) with delta_B + T delta_N = b is
    // delta_B = y, delta_N = T^T y, where (I + T T^T) y = b. This matrix is positive
    // definite with eigenvalues >= 1 for any points.
    bool
    RuleReduction::correct_weights()
    {
      const std::size_t n_free = n_columns - rank;
      gram.resize(rank * rank);
      solution.resize(rank);
      for (std::size_t i = 0; i < rank; ++i)
      {
        solution[i] = right_side[rows[i]];
        const Eigen::Map<const Eigen::VectorXd> a(row(i) + rank, n_free);
        for (std::size_t j = 0; j <= i; ++j)
          gram[i * rank + j] =
            a.dot(Eigen::Map<const Eigen::VectorXd>(row(j) + rank, n_free)) +
            (i == j ? 1. : 0.);
      }
      // Cholesky factorization in place
      for (std::size_t i = 0; i < rank; ++i)
        for (std::size_t j = 0; j <= i; ++j)
        {
          double sum = gram[i * rank + j];
          for (std::size_t k = 0; k < j; ++k)
            sum -= gram[i * rank + k] * gram[j * rank + k];
          gram[i * rank + j] =
            i == j ? std::sqrt(sum) : sum / gram[j * rank + j];
        }
      for (std::size_t i = 0; i < rank; ++i)
      {
        for (std::size_t k = 0; k < i; ++k)
          solution[i] -= gram[i * rank + k] * solution[k];
        solution[i] /= gram[i * rank + i];
      }
      for (std::size_t i = rank; i-- > 0;)
      {
        for (std::size_t k = i + 1; k < rank; ++k)
          solution[i] -= gram[k * rank + i] * solution[k];
        solution[i] /= gram[i * rank + i];
      }
      for (std::size_t i = 0; i < rank; ++i)
      {
        u[i] += solution[i];
        subtract_multiple(u.data() + rank, row(i) + rank, -solution[i], n_free);
      }
      return std::all_of(u.begin(), u.end(), [](const double value) {
        return value > 0.;
      });
    }


    void
    RuleReduction::pivot(const std::size_t i, const std::size_t column)
    {
      double      *pivot_row = row(i);
      const double inverse   = 1. / pivot_row[column];
      for (std::size_t c = rank; c < column; ++c)
        pivot_row[c] *= inverse;
      for (std::size_t r = 0; r < rank; ++r)
        if (r != i)
          subtract_multiple(row(r) + rank,
                            pivot_row + rank,
                            row(r)[column],
                            column - rank);
      columns[i] = columns[column];
      u[i]       = u[column];
    }


    void
    RuleReduction::eliminate()
    {
      // Entries below this are round-off and never taken as pivots.
      constexpr double negligible = 1e-12;
      for (std::size_t c = n_columns; c-- > rank;)
      {
        // Lowering u_c by x raises u_B by T_c x; raising it lowers u_B.
        double      down = u[c], up = std::numeric_limits<double>::max();
        std::size_t down_row = rank, up_row = rank;
        for (std::size_t i = 0; i < rank; ++i)
        {
          const double entry = row(i)[c];
          if (entry < -negligible && u[i] < -entry * down)
          {
            down     = -u[i] / entry;
            down_row = i;
          }
          else if (entry > negligible && u[i] < entry * up)
          {
            up     = u[i] / entry;
            up_row = i;
          }
        }
        // Remove point c without an exchange if possible, else with the larger pivot.
        const bool raise =
          down_row < rank && up_row < rank &&
          std::abs(row(up_row)[c]) > std::abs(row(down_row)[c]);
        const double      step     = raise ? up : -down;
        const std::size_t exchange = raise ? up_row : down_row;
        for (std::size_t i = 0; i < rank; ++i)
          u[i] = std::max(u[i] - step * row(i)[c], 0.);
        u[c] += step;
        if (exchange < rank)
          pivot(exchange, c);
      }
      n_columns = std::min(n_columns, rank);
      columns.resize(n_columns);
    }


    double
    RuleReduction::residual_of(const std::vector<double> &values,
                               const std::vector<double> &moments,
                               const std::vector<double> &weights)
    {
      residual.resize(n);
      const std::size_t n_points = weights.size();
      double            largest  = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        const Eigen::Map<const Eigen::VectorXd> v(values.data() + i * n_points,
                                                  n_points);
        residual[i] =
          moments[i] -
          v.dot(Eigen::Map<const Eigen::VectorXd>(weights.data(), n_points));
        largest = std::max(largest, std::abs(residual[i]));
      }
      return largest;
    }


    bool
    RuleReduction::reduce(const std::vector<double> &values,
                          const std::vector<double> &moments,
                          const double               noise,
                          const bool                 correct,
                          std::vector<double>       &weights)
    {
      n                          = moments.size();
      const std::size_t n_points = weights.size();
      // No more columns than this are treated at once, so that the cost grows linearly with the
      // number of candidates.
      const std::size_t chunk = 4 * n;

      const double defect  = residual_of(values, moments, weights);
      const double largest = *std::max_element(weights.begin(), weights.end());
      const double rank_tolerance =
        std::max(64. * epsilon * largest, 4. * noise / n_points);

      columns.clear();
      std::size_t next         = 0;
      bool        have_tableau = false;
      if (correct && defect > noise)
      {
        for (std::size_t k = 0; k < n_points; ++k)
          columns.push_back(k);
        make_tableau(values, weights, n_points, rank_tolerance);
        if (!correct_weights())
          return false;
        have_tableau = n_points <= chunk;
        if (have_tableau)
          next = n_points;
        else
        {
          for (std::size_t c = 0; c < columns.size(); ++c)
            weights[columns[c]] *= u[c];
          columns.clear();
        }
      }

      while (have_tableau || next < n_points)
      {
        if (!have_tableau)
        {
          while (next < n_points && columns.size() < chunk)
            columns.push_back(next++);
          std::fill(residual.begin(), residual.end(), 0.);
          make_tableau(values, weights, n_points, rank_tolerance);
        }
        have_tableau = false;
        active.assign(columns.begin(), columns.end());
        eliminate();
        solution.resize(columns.size());
        for (std::size_t c = 0; c < columns.size(); ++c)
          solution[c] = u[c] * weights[columns[c]];
        for (const std::size_t k : active)
          weights[k] = 0.;
        for (std::size_t c = 0; c < columns.size(); ++c)
          weights[columns[c]] = solution[c];
        // Remove points whose weights are round-off of zero.
        columns.erase(std::remove_if(columns.begin(),
                                     columns.end(),
                                     [&](const std::size_t k) {
                                       if (weights[k] > epsilon * largest)
                                         return false;
                                       weights[k] = 0.;
                                       return true;
                                     }),
                      columns.end());
      }
      return !columns.empty();
    }


    // There are as many equations as unknowns, or a few more. They are solved by Gauss elimination
    // with pivoting over rows if the pivots are good, else by least squares without the
    // directions that only round-off determines.
    void
    RuleReduction::solve_survivors(const std::vector<double> &values,
                                   const std::vector<double> &weights)
    {
      const std::size_t n_points = weights.size();
      const std::size_t p        = columns.size();
      gram.resize(n * p);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < p; ++c)
          gram[i * p + c] =
            values[i * n_points + columns[c]] * weights[columns[c]];
      solution        = residual;
      bool is_regular = p == n;
      for (std::size_t c = 0; c < p && is_regular; ++c)
      {
        std::size_t best = c;
        for (std::size_t i = c + 1; i < n; ++i)
          if (std::abs(gram[i * p + c]) > std::abs(gram[best * p + c]))
            best = i;
        const double pivot = gram[best * p + c];
        if (std::abs(pivot) <= 1e-8 * weights[columns[c]])
        {
          is_regular = false;
          break;
        }
        if (best != c)
        {
          std::swap_ranges(gram.begin() + best * p,
                           gram.begin() + (best + 1) * p,
                           gram.begin() + c * p);
          std::swap(solution[best], solution[c]);
        }
        for (std::size_t i = c + 1; i < n; ++i)
        {
          const double factor = gram[i * p + c] / pivot;
          subtract_multiple(gram.data() + i * p + c + 1,
                            gram.data() + c * p + c + 1,
                            factor,
                            p - c - 1);
          solution[i] -= factor * solution[c];
        }
      }
      if (is_regular)
      {
        for (std::size_t i = p; i-- > 0;)
        {
          for (std::size_t k = i + 1; k < p; ++k)
            solution[i] -= gram[i * p + k] * solution[k];
          solution[i] /= gram[i * p + i];
        }
        return;
      }

      Eigen::MatrixXd matrix(n, p);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < p; ++c)
          matrix(i, c) =
            values[i * n_points + columns[c]] * weights[columns[c]];
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
      decomposition.setThreshold(1e-7);
      decomposition.compute(matrix);
      const Eigen::VectorXd x = decomposition.solve(
        Eigen::Map<const Eigen::VectorXd>(residual.data(), n));
      solution.assign(x.data(), x.data() + p);
    }


    double
    RuleReduction::polish(const std::vector<double> &values,
                          const std::vector<double> &moments,
                          const double               goal,
                          std::vector<double>       &weights)
    {
      n              = moments.size();
      double largest = residual_of(values, moments, weights);
      for (unsigned int step = 0; step < 2 && largest > goal; ++step)
      {
        columns.clear();
        for (std::size_t k = 0; k < weights.size(); ++k)
          if (weights[k] > 0.)
            columns.push_back(k);
        solve_survivors(values, weights);
        before = weights;
        for (std::size_t c = 0; c < columns.size(); ++c)
        {
          const std::size_t k = columns[c];
          weights[k] += solution[c] * weights[k];
          if (!(weights[k] > 0.))
          {
            weights = before;
            return largest;
          }
        }
        const double now = residual_of(values, moments, weights);
        if (now >= largest)
        {
          weights = before;
          return largest;
        }
        largest = now;
      }
      return largest;
    }
  } // namespace internal
} // namespace NMM
