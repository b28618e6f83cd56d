// Orders of elimination: each row once, and less fill than row by row.

#include <algorithm>
#include <gtest/gtest.h>
#include <linear_algebra/nested_dissection.h>
#include <numeric>
#include <random>
#include <set>

namespace
{
  using dealii::Point;

  struct Graph
  {
    std::vector<std::size_t>  row_begin = {0};
    std::vector<unsigned int> columns;
    std::vector<Point<2>>     points;

    /// Rows are neighbours if they are closer than @p radius.
    Graph(std::vector<Point<2>> points, const double radius)
      : points(std::move(points))
    {
      for (const Point<2> &p : this->points)
      {
        for (unsigned int j = 0; j < this->points.size(); ++j)
          if (p.distance(this->points[j]) < radius)
            columns.push_back(j);
        row_begin.push_back(columns.size());
      }
    }

    std::vector<unsigned int>
    order() const
    {
      return NMM::internal::nested_dissection(row_begin, columns, points);
    }

    /// Entries of the factor, by eliminating one row after the other.
    std::size_t
    n_factor_entries(const std::vector<unsigned int> &places) const
    {
      std::vector<std::set<unsigned int>> later(points.size());
      for (unsigned int i = 0; i < points.size(); ++i)
        for (std::size_t k = row_begin[i]; k < row_begin[i + 1]; ++k)
          if (places[columns[k]] > places[i])
            later[places[i]].insert(places[columns[k]]);
      std::size_t n = points.size();
      for (const std::set<unsigned int> &row : later)
      {
        n += row.size();
        if (!row.empty())
          later[*row.begin()].insert(std::next(row.begin()), row.end());
      }
      return n;
    }
  };


  void
  expect_each_once(const std::vector<unsigned int> &places)
  {
    std::vector<bool> is_taken(places.size(), false);
    for (const unsigned int place : places)
    {
      ASSERT_LT(place, places.size());
      EXPECT_FALSE(is_taken[place]) << place;
      is_taken[place] = true;
    }
  }
} // namespace


// 40 x 40 points with eight neighbours: row by row the factor has 40 + 2 entries in a row;
// dissection leaves 0.53 of that here.
TEST(NestedDissection, FillsLessThanRowByRow)
{
  constexpr unsigned int n = 40;
  std::vector<Point<2>>  points;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      points.emplace_back(0.8 * j - 0.3 * i, 0.7 * i + 0.2 * j);
  std::mt19937 generator(20261122);
  const Graph  in_rows(points, 1.1);
  std::shuffle(points.begin(), points.end(), generator);
  const Graph               graph(points, 1.1);
  std::vector<unsigned int> rows(n * n);
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<unsigned int> places = graph.order();
  expect_each_once(places);
  EXPECT_LT(graph.n_factor_entries(places),
            0.6 * in_rows.n_factor_entries(rows));
}


// Parts without neighbours, rows without any, all in one place, none at all.
TEST(NestedDissection, TakesAnyGraph)
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> random(0., 1.);
  std::vector<Point<2>>                  apart;
  for (unsigned int i = 0; i < 300; ++i)
    apart.emplace_back(random(generator) + (i % 3) * 5., random(generator));
  expect_each_once(Graph(apart, 0.1).order());
  expect_each_once(Graph(apart, 1e-9).order());
  expect_each_once(Graph(apart, 100.).order());
  expect_each_once(Graph(std::vector<Point<2>>(200), 1.).order());
  EXPECT_TRUE(Graph({}, 1.).order().empty());
}
