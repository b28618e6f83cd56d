// Direct solvers of sparse matrices: which one is chosen, chosen rows, and fill.
#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <linear_algebra/direct_solver.h>

using namespace NMM;
using internal::DirectSolver;

namespace
{
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector = dealii::TrilinosWrappers::MPI::Vector;


  /// 2 x 2 entries on a grid of n x n nodes with eight neighbours, unsymmetric by
  /// @p skew; dominated by the diagonal.
  Matrix
  grid_matrix(const unsigned int n, const double skew)
  {
    const unsigned int             n_rows = 2 * n * n;
    dealii::DynamicSparsityPattern pattern(n_rows);
    const auto                     for_each = [n](const auto &action) {
      for (unsigned int i = 0; i < n * n; ++i)
        for (unsigned int j = 0; j < n * n; ++j)
          if (std::abs(int(i / n) - int(j / n)) <= 1 &&
              std::abs(int(i % n) - int(j % n)) <= 1)
            for (unsigned int c = 0; c < 4; ++c)
              action(2 * i + c / 2, 2 * j + c % 2);
    };
    for_each(
      [&](const unsigned int i, const unsigned int j) { pattern.add(i, j); });
    Matrix result;
    result.reinit(dealii::complete_index_set(n_rows), pattern, MPI_COMM_SELF);
    for_each([&](const unsigned int i, const unsigned int j) {
      result.set(i,
                 j,
                 i == j  ? 20. + i % 3
                 : i < j ? -1. - 0.1 * ((i + j) % 5)
                         : -1. - 0.1 * ((i + j) % 5) + skew);
    });
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  // A small system goes to KLU, a large one to MUMPS, both ways of symmetry, of all rows or
  // of two thirds: the solution is that of dense elimination.
  TEST(DirectSolver, SolvesWhatDenseLuSolves)
  {
    for (const unsigned int n : {5U, 18U})
      for (const bool is_symmetric : {true, false})
        for (const bool are_all : {true, false})
        {
          SCOPED_TRACE(testing::Message()
                       << n << ' ' << is_symmetric << ' ' << are_all);
          const Matrix matrix = grid_matrix(n, is_symmetric ? 0. : 0.3);
          std::vector<unsigned int> rows;
          for (unsigned int i = 0; i < matrix.m(); ++i)
            if (are_all || i % 3 != 1)
              rows.push_back(i);
          Vector rhs(dealii::complete_index_set(matrix.m()), MPI_COMM_SELF);
          for (unsigned int i = 0; i < matrix.m(); ++i)
            rhs(i) = std::cos(1. + i);
          Vector       solution = rhs;
          DirectSolver solver(is_symmetric
                                ? DirectSolver::Symmetry::symmetric
                                : DirectSolver::Symmetry::unsymmetric);
          solver.factorize(matrix,
                           are_all ? std::vector<unsigned int>() : rows);
          EXPECT_EQ(solver.analysis_time() > 0.,
                    rows.size() > internal::KluFactorization::max_group);
          // two systems at once, and then one in place
          std::vector<Vector> both(2, rhs);
          both[1] *= -3.;
          solver.solve_all(both);
          solver.solve(solution, solution);

          Eigen::MatrixXd dense(rows.size(), rows.size());
          Eigen::VectorXd right(rows.size());
          for (unsigned int i = 0; i < rows.size(); ++i)
          {
            right(i) = rhs(rows[i]);
            for (unsigned int j = 0; j < rows.size(); ++j)
              dense(i, j) = matrix.el(rows[i], rows[j]);
          }
          const Eigen::VectorXd expected = dense.partialPivLu().solve(right);
          // rounding, with conditions of some 10
          for (unsigned int i = 0; i < rows.size(); ++i)
          {
            EXPECT_NEAR(solution(rows[i]), expected(i), 1e-13) << rows[i];
            EXPECT_NEAR(both[0](rows[i]), expected(i), 1e-13) << rows[i];
            EXPECT_NEAR(both[1](rows[i]), -3. * expected(i), 3e-13) << rows[i];
          }
        }
  }


  // With four times the unknowns, factors in a good order of elimination grow as n log n,
  // 4 log(12800) / log(3200) = 4.7 times; row by row they would grow 8 times. It is 5.3.
  TEST(DirectSolver, FactorsGrowAsInTheBestOrder)
  {
    double n_entries[2];
    for (const unsigned int i : {0, 1})
    {
      DirectSolver solver;
      solver.factorize(grid_matrix(40 << i, 0.));
      n_entries[i] = solver.n_factor_entries();
    }
    EXPECT_GT(n_entries[0], 0.);
    EXPECT_LT(n_entries[1], 6. * n_entries[0]);
  }
} // namespace
