// The frontal solver of time steps against dense elimination.
#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <mechanics/frontal_solver.h>
#include <random>

namespace NMM
{
  namespace
  {
    using internal::FrontalSolver;
    using Dense = Eigen::MatrixXd;

    /// Bodies of a few covers each, all coupled, in a row of rows; neighbours may touch.
    struct Bodies
    {
      explicit Bodies(const unsigned int seed)
        : generator(seed)
      {
        const unsigned int n_bodies = 1 + generator() % 30;
        width                       = 1 + generator() % 6;
        for (unsigned int b = 0; b < n_bodies; ++b)
        {
          first.push_back(n);
          n += 2 * (1 + generator() % 7);
        }
        first.push_back(n);
      }

      /// Regular bodies, a share of all contacts.
      Dense
      matrix(const double share, const bool is_symmetric)
      {
        Dense result = Dense::Zero(n, n);
        for (unsigned int b = 0; b + 1 < first.size(); ++b)
        {
          for (unsigned int i = first[b]; i < first[b + 1]; ++i)
            for (unsigned int j = first[b]; j < first[b + 1]; ++j)
              result(i, j) = random() + (i == j ? 20. : 0.);
          for (const unsigned int other : {b + 1, b + width})
            if (other > b && other + 1 < first.size() &&
                std::abs(random()) < share)
              for (unsigned int i = first[b]; i < first[b + 1]; ++i)
                for (unsigned int j = first[other]; j < first[other + 1]; ++j)
                {
                  result(i, j) = random();
                  result(j, i) = random();
                }
        }
        return is_symmetric ? Dense(result + result.transpose()) : result;
      }

      /// Entries of the pattern of all contacts, zero or not.
      void
      pattern(const bool        is_triangle,
              std::vector<int> &rows,
              std::vector<int> &columns)
      {
        const auto body = [&](const unsigned int i) {
          return std::upper_bound(first.begin(), first.end(), i) -
                 first.begin() - 1;
        };
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = is_triangle ? i : 0; j < n; ++j)
          {
            const unsigned int d = std::abs(body(i) - body(j));
            if (d == 0 || d == 1 || d == width)
            {
              rows.push_back(i + 1);
              columns.push_back(j + 1);
            }
          }
      }

      double
      random()
      {
        return std::uniform_real_distribution<double>(-1., 1.)(generator);
      }

      std::mt19937              generator;
      unsigned int              n = 0, width = 1;
      std::vector<unsigned int> first;
    };


    std::vector<double>
    values_of(const Dense            &matrix,
              const std::vector<int> &rows,
              const std::vector<int> &columns)
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < rows.size(); ++i)
        values.push_back(matrix(rows[i] - 1, columns[i] - 1));
      return values;
    }


    // Contacts come and go between factorizations; condition numbers are below 1e3,
    // so that 1e-11 is rounding.
    TEST(FrontalSolver, SolvesAsDenseElimination)
    {
      unsigned int n_solved = 0;
      for (unsigned int seed = 0; seed < 200; ++seed)
        for (const bool is_symmetric : {false, true})
        {
          SCOPED_TRACE("seed " + std::to_string(seed));
          Bodies           bodies(seed);
          std::vector<int> rows, columns;
          bodies.pattern(is_symmetric, rows, columns);
          FrontalSolver solver;
          solver.set_pattern(bodies.n, rows, columns, is_symmetric);
          for (const double share : {0., 0.3, 1., 0.1})
          {
            const Dense matrix = bodies.matrix(share, is_symmetric);
            if (share == 0.1)
              solver.forget();
            ASSERT_TRUE(solver.factorize(values_of(matrix, rows, columns)));
            Eigen::VectorXd x(bodies.n);
            for (unsigned int i = 0; i < bodies.n; ++i)
              x[i] = bodies.random();
            Eigen::VectorXd rhs = matrix * x;
            solver.solve(rhs.data());
            EXPECT_LT((rhs - x).norm(), 1e-11 * x.norm());
            ++n_solved;
          }
        }
      EXPECT_EQ(n_solved, 1600U);
    }


    // What was factorized before leaves no trace after forget(): bits of a continuation.
    TEST(FrontalSolver, ForgetsMatricesBefore)
    {
      Bodies           bodies(7);
      std::vector<int> rows, columns;
      bodies.pattern(false, rows, columns);
      const Dense   before = bodies.matrix(1., false);
      const Dense   matrix = bodies.matrix(0.4, false);
      FrontalSolver old, fresh;
      for (FrontalSolver *solver : {&old, &fresh})
        solver->set_pattern(bodies.n, rows, columns, false);
      ASSERT_TRUE(old.factorize(values_of(before, rows, columns)));
      old.forget();
      std::vector<double> results[2];
      unsigned int        i = 0;
      for (FrontalSolver *solver : {&old, &fresh})
      {
        ASSERT_TRUE(solver->factorize(values_of(matrix, rows, columns)));
        results[i].assign(bodies.n, 1.);
        solver->solve(results[i++].data());
      }
      EXPECT_EQ(results[0], results[1]);
    }


    // A zero on the diagonal is no lost pivot if another row of the body has one; a
    // body without any is.
    TEST(FrontalSolver, TellsLostPivots)
    {
      const std::vector<int> rows = {1, 1, 2, 2}, columns = {1, 2, 1, 2};
      FrontalSolver          solver;
      solver.set_pattern(2, rows, columns, false);
      ASSERT_TRUE(solver.factorize({0., 2., 4., 0.}));
      std::vector<double> x = {2., 8.};
      solver.solve(x.data());
      EXPECT_DOUBLE_EQ(x[0], 2.);
      EXPECT_DOUBLE_EQ(x[1], 1.);
      EXPECT_FALSE(solver.factorize({1., 2., 2., 4.}));
    }
  } // namespace
} // namespace NMM
