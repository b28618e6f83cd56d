// Matrices of bodies that are there when they are needed, against dense ones.
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Eigen/Dense>
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

using namespace NMM;

namespace
{
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;


  /// Of two, four and two unknowns.
  const std::vector<unsigned int> three_bodies = {0, 0, 1, 1, 1, 1, 2, 2};


  Eigen::MatrixXd
  dense(const BodyMatrix &matrix)
  {
    const unsigned int n      = matrix.begin(matrix.n_bodies());
    const Matrix       sparse = matrix.sparse();
    Eigen::MatrixXd    result = Eigen::MatrixXd::Zero(n, n);
    for (const auto &entry : sparse)
      result(entry.row(), entry.column()) = entry.value();
    return result;
  }


  std::vector<unsigned int>
  columns(const BodyMatrix &matrix, const unsigned int row)
  {
    std::vector<unsigned int> result;
    matrix.for_each_in_row(row, [&](const unsigned int column, const double *) {
      result.push_back(column);
    });
    return result;
  }


  // Local matrices of covers of two bodies, of one of them twice, go where they belong,
  // unknown by unknown; a body that nothing is added to is not there.
  TEST(BodyMatrix, LocalMatricesAreAdded)
  {
    std::mt19937                           generator(5);
    std::uniform_real_distribution<double> random(-1., 1.);
    SCOPED_TRACE("seed 5");
    BodyMatrix matrix(three_bodies);
    matrix.begin_rows({});
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(8, 8);
    for (const std::vector<unsigned int> &covers :
         {std::vector<unsigned int>{2, 1, 0},
          std::vector<unsigned int>{1, 2, 0, 2, 1}})
    {
      const unsigned int  n = 2 * covers.size();
      std::vector<double> local(n * n);
      for (double &x : local)
        x = random(generator);
      matrix.add({covers.data(), covers.size()}, local.data());
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          expected(2 * covers[i / 2] + i % 2, 2 * covers[j / 2] + j % 2) +=
            local[n * i + j];
    }
    // sums of two to five numbers of size 1
    EXPECT_LE((dense(matrix) - expected).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(columns(matrix, 0), (std::vector<unsigned int>{0, 1}));
    EXPECT_EQ(columns(matrix, 1), (std::vector<unsigned int>{1, 0}));
    EXPECT_EQ(columns(matrix, 2), (std::vector<unsigned int>{2}));
    matrix.begin_rows({});
    EXPECT_EQ(columns(matrix, 0), (std::vector<unsigned int>{0}));
    EXPECT_EQ(dense(matrix).norm(), 0.);
  }


  // Only rows of the bodies that were begun are stored.
  TEST(BodyMatrix, HasRowsOfSomeBodies)
  {
    BodyMatrix                matrix(three_bodies);
    const std::vector<double> ones(36, 1.);
    const unsigned int        covers[3] = {0, 1, 3};
    matrix.begin_rows({true, false, true});
    matrix.add({covers, 3}, ones.data());
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(8, 8);
    for (const unsigned int i : {0, 1, 6, 7})
      for (const unsigned int j : {0, 1, 2, 3, 6, 7})
        expected(i, j) = 1.;
    EXPECT_EQ((dense(matrix) - expected).norm(), 0.);
    EXPECT_EQ(columns(matrix, 1), (std::vector<unsigned int>{}));

    // what was there is forgotten
    matrix.begin_rows({false, true, false});
    for (unsigned int i = 0; i < 2; ++i)
      matrix.add({covers, 3}, ones.data());
    expected.setZero();
    for (const unsigned int i : {2, 3})
      for (const unsigned int j : {0, 1, 2, 3, 6, 7})
        expected(i, j) = 2.;
    EXPECT_EQ((dense(matrix) - expected).norm(), 0.);
    EXPECT_EQ(columns(matrix, 0), (std::vector<unsigned int>{}));
  }


  // Sparse matrices: what couples no bodies can be added, what does can be read as far as
  // it is said to couple them.
  TEST(BodyMatrix, SparseMatrices)
  {
    const auto sparse = [](const bool couples, const double size) {
      dealii::DynamicSparsityPattern pattern(8);
      const auto                     for_each = [&](const auto &action) {
        for (unsigned int i = 0; i < 8; ++i)
          for (unsigned int j = 0; j < 8; ++j)
            // with gaps in the rows of a body
            if (couples ||
                (three_bodies[i] == three_bodies[j] && (i + j) % 3 != 1))
              action(i, j);
      };
      for_each(
        [&](const unsigned int i, const unsigned int j) { pattern.add(i, j); });
      Matrix result;
      result.reinit(dealii::complete_index_set(8), pattern, MPI_COMM_SELF);
      for_each([&](const unsigned int i, const unsigned int j) {
        result.set(i, j, size * (8. * i + j + 1.));
      });
      result.compress(dealii::VectorOperation::insert);
      return result;
    };
    const auto entry = [](const unsigned int i, const unsigned int j) {
      return 8. * i + j + 1.;
    };
    BodyMatrix matrix(three_bodies);
    matrix.read(sparse(true, 1.), {true, true, false}, {{1}, {}, {0}});
    matrix.add(0.5, sparse(false, 4.));
    const Eigen::MatrixXd found = dense(matrix);
    for (unsigned int i = 0; i < 8; ++i)
      for (unsigned int j = 0; j < 8; ++j)
      {
        const unsigned int row = three_bodies[i], column = three_bodies[j];
        // 0 and 1 are coupled, and 0 with 2, the rows of which do not count
        const bool is_there =
          row < 2 && (row == column || row + column == 1 || row + column == 2);
        const bool is_added = row < 2 && row == column && (i + j) % 3 != 1;
        // small whole numbers are exact
        EXPECT_EQ(found(i, j),
                  (is_there ? entry(i, j) : 0.) +
                    (is_added ? 2. * entry(i, j) : 0.))
          << i << ' ' << j;
      }
  }


  // Bodies that are large, or whose unknowns are scattered, are for others.
  TEST(BodyMatrix, IsForSmallBodiesInOrder)
  {
    std::vector<unsigned int> bodies(BodyMatrix::max_body, 0);
    EXPECT_TRUE(BodyMatrix::is_suitable(bodies));
    bodies.push_back(1);
    EXPECT_TRUE(BodyMatrix::is_suitable(bodies));
    bodies.push_back(0);
    EXPECT_FALSE(BodyMatrix::is_suitable(bodies));
    EXPECT_FALSE(BodyMatrix::is_suitable(
      std::vector<unsigned int>(BodyMatrix::max_body + 1, 0)));
    EXPECT_FALSE(BodyMatrix::is_suitable({}));
  }
} // namespace
