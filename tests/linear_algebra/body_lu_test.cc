// Elimination of whole bodies, against dense LU.
#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <linear_algebra/body_lu.h>
#include <linear_algebra/direct_solver.h>
#include <numeric>
#include <random>

using namespace NMM;
using internal::BodyLu;

namespace
{
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector = dealii::TrilinosWrappers::MPI::Vector;


  /// Bodies, an unsymmetric matrix of them with places of zero value between all, and the
  /// same as a dense one.
  struct Bodies
  {
    explicit Bodies(const std::vector<unsigned int> &sizes)
      : couplings(sizes.size())
    {
      begins.push_back(0);
      for (unsigned int b = 0; b < sizes.size(); ++b)
      {
        unknown_to_body.insert(unknown_to_body.end(), sizes[b], b);
        begins.push_back(unknown_to_body.size());
      }
      const unsigned int n = unknown_to_body.size();
      dense.setZero(n, n);
    }

    unsigned int
    n() const
    {
      return unknown_to_body.size();
    }

    void
    couple(const unsigned int a, const unsigned int b)
    {
      couplings[a].push_back(b);
      for (unsigned int i = begins[a]; i < begins[a + 1]; ++i)
        for (unsigned int j = begins[b]; j < begins[b + 1]; ++j)
        {
          dense(i, j) = random(generator);
          // one way, if it is not the other one's turn as well
          if (dense(j, i) == 0.)
            dense(j, i) = random(generator);
        }
    }

    /// A body's own matrix: rows need to change places.
    void
    fill(const unsigned int b, const double size)
    {
      const unsigned int m = begins[b + 1] - begins[b];
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          dense(begins[b] + i, begins[b] + j) =
            random(generator) + ((i + 1) % m == j ? size : 0.);
    }

    Matrix
    sparse() const
    {
      dealii::DynamicSparsityPattern pattern(n());
      for (unsigned int i = 0; i < n(); ++i)
        for (unsigned int j = 0; j < n(); ++j)
          pattern.add(i, j);
      Matrix result;
      result.reinit(dealii::complete_index_set(n()), pattern, MPI_COMM_SELF);
      for (unsigned int i = 0; i < n(); ++i)
        for (unsigned int j = 0; j < n(); ++j)
          result.set(i, j, dense(i, j));
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    /// As far as it is coupled, in rows of the bodies of @p some (empty: all).
    BodyMatrix
    body_matrix(const std::vector<bool> &some = {}) const
    {
      BodyMatrix result(unknown_to_body);
      result.read(sparse(), some, couplings);
      return result;
    }

    std::mt19937                           generator{7};
    std::uniform_real_distribution<double> random{-1., 1.};
    std::vector<unsigned int>              unknown_to_body, begins;
    BodyMatrix::Couplings                  couplings;
    Eigen::MatrixXd                        dense;
  };


  Vector
  counted(const unsigned int n)
  {
    Vector result(dealii::complete_index_set(n), MPI_COMM_SELF);
    for (unsigned int i = 0; i < n; ++i)
      result(i) = std::cos(1. + i);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  // Random graphs of bodies of different sizes, some of which are left out: the solution
  // is that of the dense system of the others, in place or not.
  TEST(BodyLu, SolvesWhatDenseLuSolves)
  {
    std::mt19937 generator(11);
    SCOPED_TRACE("seed 11");
    for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const unsigned int        n_bodies = 2 + generator() % 12;
      std::vector<unsigned int> sizes;
      for (unsigned int b = 0; b < n_bodies; ++b)
        sizes.push_back(1 + generator() % 13);
      Bodies bodies(sizes);
      for (unsigned int b = 0; b < n_bodies; ++b)
        bodies.fill(b, 40.);
      for (unsigned int i = 0; i < 2 * n_bodies; ++i)
      {
        const unsigned int a = generator() % n_bodies;
        const unsigned int b = generator() % n_bodies;
        if (a != b)
          bodies.couple(a, b);
      }
      std::vector<unsigned int> rows;
      for (unsigned int i = 0; i < bodies.n(); ++i)
        if (sample % 2 == 0 || bodies.unknown_to_body[i] % 3 != 1)
          rows.push_back(i);
      std::vector<bool> chosen(sample % 2 == 0 ? 0 : n_bodies);
      for (const unsigned int row : rows)
        if (!chosen.empty())
          chosen[bodies.unknown_to_body[row]] = true;
      BodyLu lu;
      ASSERT_TRUE(
        lu.factorize(bodies.body_matrix(chosen),
                     sample % 2 == 0 ? std::vector<unsigned int>() : rows));
      const Vector rhs      = counted(bodies.n());
      Vector       solution = rhs;
      lu.solve(solution, solution, {});

      Eigen::MatrixXd some(rows.size(), rows.size());
      Eigen::VectorXd right(rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        right(i) = rhs(rows[i]);
        for (unsigned int j = 0; j < rows.size(); ++j)
          some(i, j) = bodies.dense(rows[i], rows[j]);
      }
      const Eigen::VectorXd expected = some.partialPivLu().solve(right);
      // rounding, with conditions of some 10
      for (unsigned int i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(solution(rows[i]), expected(i), 1e-13) << sample;
      for (unsigned int i = 0; i < bodies.n(); ++i)
        if (std::find(rows.begin(), rows.end(), i) == rows.end())
        {
          EXPECT_EQ(solution(i), rhs(i)) << sample;
        }
    }
  }


  // Two systems side by side: where only one is wanted, its solution has the same bits, and
  // nothing is written to the other one.
  TEST(BodyLu, SolvesOneOfTwoSystemsOnly)
  {
    const std::vector<unsigned int> sizes = {3, 5, 2, 4, 6};
    Bodies                          bodies(sizes);
    for (unsigned int b = 0; b < sizes.size(); ++b)
      bodies.fill(b, 40.);
    bodies.couple(0, 3);
    bodies.couple(3, 4);
    bodies.couple(1, 2);
    const std::vector<bool> first = {true, false, false, true, true};
    BodyLu                  lu;
    ASSERT_TRUE(lu.factorize(bodies.body_matrix(), {}));
    const Vector rhs = counted(bodies.n());
    Vector       all = rhs, some = rhs;
    lu.solve(rhs, all, {});
    lu.solve(rhs, some, first);
    for (unsigned int i = 0; i < bodies.n(); ++i)
      EXPECT_EQ(some(i), first[bodies.unknown_to_body[i]] ? all(i) : rhs(i));
  }


  // A chain of bodies, numbered at random, has no fill, and neither has a star: what
  // is in the middle is eliminated last.
  TEST(BodyLu, OrdersSoThatLittleIsFilled)
  {
    constexpr unsigned int    n_bodies = 40, size = 3;
    std::mt19937              generator(3);
    std::vector<unsigned int> number(n_bodies);
    std::iota(number.begin(), number.end(), 0U);
    std::shuffle(number.begin(), number.end(), generator);
    for (const bool is_star : {false, true})
    {
      Bodies bodies(std::vector<unsigned int>(n_bodies, size));
      for (unsigned int b = 0; b < n_bodies; ++b)
        bodies.fill(b, 100.);
      for (unsigned int b = 0; b + 1 < n_bodies; ++b)
        bodies.couple(number[is_star ? n_bodies - 1 : b + 1], number[b]);
      BodyLu lu;
      ASSERT_TRUE(lu.factorize(bodies.body_matrix(), {}));
      EXPECT_EQ(lu.n_factor_entries(),
                size * size * (n_bodies + 2 * (n_bodies - 1)))
        << is_star;
    }
  }


  // A body without a pivot is no body to begin with: the direct solver then has
  // others do it.
  TEST(BodyLu, SaysIfABodyIsSingular)
  {
    for (const double little : {0., 1e-16})
    {
      Bodies bodies({2, 2});
      bodies.dense << little, 0., 1., 0., //
        0., little, 0., 1.,               //
        1., 0., 1., 0.,                   //
        0., -1., 0., -1.;
      bodies.dense(0, 1) = bodies.dense(1, 0) = little == 0. ? 0. : 1.;
      bodies.dense(0, 0)                      = little == 0. ? 0. : 1. + little;
      bodies.dense(1, 1)                      = little == 0. ? 0. : 1.;
      bodies.couplings[0]                     = {1};
      const Matrix matrix                     = bodies.sparse();
      BodyLu       lu;
      EXPECT_FALSE(lu.factorize(bodies.body_matrix(), {}));

      for (const bool is_sparse : {true, false})
      {
        internal::DirectSolver solver(
          internal::DirectSolver::Symmetry::unsymmetric,
          bodies.unknown_to_body);
        if (is_sparse)
          solver.factorize(matrix, {}, bodies.couplings);
        else
          solver.factorize(bodies.body_matrix(), {});
        const Vector rhs      = counted(4);
        Vector       solution = rhs, residual = rhs;
        solver.solve(rhs, solution);
        matrix.vmult(residual, solution);
        residual -= rhs;
        EXPECT_LE(residual.l2_norm(), 1e-13);
      }
    }
  }
} // namespace
