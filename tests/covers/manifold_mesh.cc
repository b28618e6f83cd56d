#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/triangulate.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>

#include "support/random_scenes.h"
#include <gtest/gtest.h>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  struct Cut
  {
    PhysicalMesh     physical;
    MathematicalMesh mathematical;
    ManifoldMesh     manifold;
    CoverSystem      covers;

    Cut(Geometry geometry, const RegularMeshParameters &parameters)
      : physical(std::move(geometry))
      , mathematical(make_regular_mesh(physical, parameters, 2))
      , manifold(mathematical, physical)
      , covers(manifold, MPI_COMM_SELF)
    {
    }

    double
    area() const
    {
      double sum = 0.;
      for (unsigned int e = 0; e < manifold.n_elements(); ++e)
        sum += manifold.area(e);
      return sum;
    }

    /// Sets of elements connected through joined(): blocks, if all is right.
    unsigned int
    n_connected() const
    {
      std::vector<bool> seen(manifold.n_elements(), false);
      unsigned int      n = 0;
      for (unsigned int e = 0; e < manifold.n_elements(); ++e)
      {
        if (seen[e])
          continue;
        ++n;
        std::vector<unsigned int> stack(1, e);
        seen[e] = true;
        while (!stack.empty())
        {
          const unsigned int here = stack.back();
          stack.pop_back();
          for (const auto &link : manifold.joined(here))
            if (!seen[link.neighbor])
            {
              seen[link.neighbor] = true;
              stack.push_back(link.neighbor);
            }
        }
      }
      return n;
    }
  };

  RegularMeshParameters
  aligned(const double cell_size)
  {
    RegularMeshParameters parameters;
    parameters.cell_size = cell_size;
    parameters.pattern   = MeshPattern::right_angled;
    return parameters;
  }

  Geometry
  ring()
  {
    Geometry geometry;
    geometry.add_circle(Point<2>(), 2., "outer", CurveRole::boundary);
    geometry.add_circle(Point<2>(), 1., "inner", CurveRole::hole);
    return geometry;
  }
} // namespace


TEST(ManifoldMesh, FittedMeshIsOrdinaryFiniteElements)
{
  const Cut cut(make_box(1., 1.), aligned(0.25));
  // 4 x 4 squares, two triangles each; 9 x 9 nodes
  EXPECT_EQ(cut.manifold.n_elements(), 32u);
  EXPECT_EQ(cut.covers.n_covers(), 81u);
  for (unsigned int e = 0; e < cut.manifold.n_elements(); ++e)
    EXPECT_TRUE(cut.manifold.is_whole(e));
}


TEST(ManifoldMesh, AreaOfARingWithTrueArcs)
{
  for (const double h : {0.9, 0.31, 0.1})
  {
    const Cut cut(ring(), skew_mesh(h));
    EXPECT_NEAR(cut.area(), 3. * dealii::numbers::PI, 1e-12)
      << "cell size " << h;
    EXPECT_EQ(cut.n_connected(), 1u);
  }
}


TEST(ManifoldMesh, BoundariesOfElementsCloseExactly)
{
  // bit for bit: quadrature sorts corners and must see each only once
  const Cut cut(ring(), skew_mesh(0.05));
  for (unsigned int e = 0; e < cut.manifold.n_elements(); ++e)
  {
    const auto   edges     = cut.manifold.edges(e);
    unsigned int loop_from = 0;
    for (unsigned int i = 0; i < edges.size(); ++i)
    {
      const bool closes = (edges[i].end == edges[loop_from].start);
      if (!closes)
        ASSERT_EQ(edges[i].end, edges[i + 1].start) << "element " << e;
      else
        loop_from = i + 1;
    }
    EXPECT_EQ(loop_from, edges.size());
  }
}


TEST(ManifoldMesh, CrackTipDoesNotDivideItsCell)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(-0.2, 0.51), Point<2>(0.53, 0.51)},
                        "crack",
                        CurveRole::joint);
  const Cut cut(std::move(geometry), aligned(0.25));
  EXPECT_NEAR(cut.area(), 1., 1e-14);
  EXPECT_EQ(cut.n_connected(), 1u);
  // the mathematical mesh has 81 covers; those whose support the crack crosses
  // fully are doubled
  EXPECT_GT(cut.covers.n_covers(), 81u);
  // in the tip's cell one element holds both sides
  const unsigned int tip = cut.manifold.find_element(Point<2>(0.53, 0.5100001));
  EXPECT_EQ(tip, cut.manifold.find_element(Point<2>(0.52, 0.5099999)));
  EXPECT_NE(cut.manifold.find_element(Point<2>(0.3, 0.5100001)),
            cut.manifold.find_element(Point<2>(0.3, 0.5099999)));
}


TEST(ManifoldMesh, JointAlongMeshEdgesDividesWithoutCutting)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0., 0.5), Point<2>(1., 0.5)},
                        "joint",
                        CurveRole::joint);
  const Cut cut(std::move(geometry), aligned(0.25));
  EXPECT_EQ(cut.manifold.n_elements(), 32u);
  EXPECT_EQ(cut.n_connected(), 2u);
  // two stacks of 9 x 5 nodes
  EXPECT_EQ(cut.covers.n_covers(), 90u);
}


TEST(ManifoldMesh, JointThroughMeshNodes)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0., 0.), Point<2>(1., 1.)},
                        "joint",
                        CurveRole::joint);
  const Cut cut(std::move(geometry), aligned(0.25));
  EXPECT_EQ(cut.n_connected(), 2u);
  EXPECT_NEAR(cut.area(), 1., 1e-15);
  // it cuts the 4 squares on the diagonal, each of two triangles, in two
  EXPECT_EQ(cut.manifold.n_elements(), 32u + 8u);
}


TEST(ManifoldMesh, BlocksTouchingInAPointStayApart)
{
  Geometry geometry;
  geometry.add_polygon({Point<2>(0., 0.), Point<2>(1., 0.), Point<2>(0.5, 0.5)},
                       "lower");
  geometry.add_polygon({Point<2>(0.5, 0.5), Point<2>(1., 1.), Point<2>(0., 1.)},
                       "upper");
  const Cut cut(std::move(geometry), skew_mesh(0.2));
  EXPECT_EQ(cut.physical.n_blocks(), 2u);
  EXPECT_EQ(cut.n_connected(), 2u);
  EXPECT_NEAR(cut.area(), 0.5, 1e-14);
}


TEST(ManifoldMesh, BlockSmallerThanACell)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polygon({Point<2>(0.41, 0.42),
                        Point<2>(0.42, 0.42),
                        Point<2>(0.42, 0.43),
                        Point<2>(0.41, 0.43)},
                       "block",
                       CurveRole::joint);
  const Cut cut(std::move(geometry), aligned(0.25));
  EXPECT_EQ(cut.physical.n_blocks(), 2u);
  EXPECT_EQ(cut.n_connected(), 2u);
  EXPECT_NEAR(cut.area(), 1., 1e-14);
  // the small block has the six covers of its only element to itself
  EXPECT_EQ(cut.covers.n_covers(), 81u + 6u);
}


TEST(ManifoldMesh, TangentCirclesAndHoles)
{
  Geometry geometry = make_box(2., 2.);
  geometry.add_circle(Point<2>(0.5, 1.), 0.5, "left", CurveRole::hole);
  geometry.add_circle(Point<2>(1.5, 1.), 0.5, "right", CurveRole::hole);
  const Cut cut(std::move(geometry), skew_mesh(0.23));
  EXPECT_NEAR(cut.area(), 4. - 2. * dealii::numbers::PI * 0.25, 1e-13);
  // the holes touch the sides and each other: an upper and a lower part remain
  EXPECT_EQ(cut.n_connected(), 2u);
}


TEST(ManifoldMesh, ElementsOfABlockAddUpToIt)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 20, seed % 2 == 0);
    const Cut           cut(std::move(geometry),
                  random_mesh(random, 0.07, seed % 4 == 0));
    std::vector<double> area(cut.physical.regions().size(), 0.);
    for (unsigned int e = 0; e < cut.manifold.n_elements(); ++e)
      area[cut.manifold.region(e)] += cut.manifold.area(e);
    for (unsigned int r = 0; r < area.size(); ++r)
      EXPECT_NEAR(area[r], cut.physical.regions()[r].area, 1e-13);
    EXPECT_EQ(cut.n_connected(), cut.physical.n_blocks());
  }
}


TEST(ManifoldMesh, WholeBoxGivesTheSameElements)
{
  RegularMeshParameters parameters = skew_mesh(0.17);
  const Cut             sparse(ring(), parameters);
  parameters.whole_box = true;
  const Cut full(ring(), parameters);
  EXPECT_LT(sparse.mathematical.n_cells(), full.mathematical.n_cells());
  EXPECT_EQ(sparse.manifold.n_elements(), full.manifold.n_elements());
  EXPECT_EQ(sparse.covers.n_covers(), full.covers.n_covers());
}


TEST(ManifoldMesh, UsersTriangulationMustCoverTheSolid)
{
  Triangulation<2> triangulation;
  GridGenerator::subdivided_hyper_cube_with_simplices(triangulation,
                                                      4,
                                                      -3.,
                                                      3.);
  const PhysicalMesh     physical(ring());
  const MathematicalMesh mesh(triangulation, 2);
  const ManifoldMesh     manifold(mesh, physical);
  double                 area = 0.;
  for (unsigned int e = 0; e < manifold.n_elements(); ++e)
    area += manifold.area(e);
  EXPECT_NEAR(area, 3. * dealii::numbers::PI, 1e-12);

  for (const double size : {1.9, 0.1})
  {
    Triangulation<2> small;
    GridGenerator::subdivided_hyper_cube_with_simplices(small, 4, -size, size);
    const MathematicalMesh small_mesh(small, 2);
    EXPECT_THROW(ManifoldMesh(small_mesh, physical), InputError)
      << "half width " << size;
  }
}


TEST(ManifoldMesh, RefinedTriangulationOfTheUser)
{
  Triangulation<2> triangulation;
  GridGenerator::subdivided_hyper_cube_with_simplices(triangulation,
                                                      2,
                                                      -3.,
                                                      3.);
  triangulation.refine_global(2);
  const PhysicalMesh     physical(ring());
  const MathematicalMesh mesh(triangulation, 2);
  const ManifoldMesh     manifold(mesh, physical);
  const CoverSystem      covers(manifold, MPI_COMM_SELF);
  double                 area = 0.;
  for (unsigned int e = 0; e < manifold.n_elements(); ++e)
    area += manifold.area(e);
  EXPECT_NEAR(area, 3. * dealii::numbers::PI, 1e-12);
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    EXPECT_EQ(mesh.cell_iterator(c)->active_cell_index(), c);
}


TEST(ManifoldMesh, FindElement)
{
  const Cut cut(ring(), skew_mesh(0.2));
  EXPECT_EQ(cut.manifold.find_element(Point<2>(0.2, 0.3)), invalid_index);
  EXPECT_EQ(cut.manifold.find_element(Point<2>(2.1, 0.3)), invalid_index);
  for (unsigned int k = 0; k < 50; ++k)
  {
    const double   angle = 0.123 * k;
    const Point<2> inner(std::cos(angle), std::sin(angle));
    // exactly on the boundary up to rounding
    for (const double r : {1., 1.37, 2.})
    {
      const unsigned int e = cut.manifold.find_element(r * inner);
      ASSERT_NE(e, invalid_index) << "angle " << angle << " radius " << r;
      const Point<2> xi =
        cut.mathematical.real_to_reference(cut.manifold.cell(e), r * inner);
      EXPECT_GT(std::min({xi[0], xi[1], 1. - xi[0] - xi[1]}), -1e-12);
    }
  }
}


TEST(ManifoldMesh, FindElementOnTheChordsOfArcs)
{
  // a disk inside a cell is bounded by two half circles: its centre lies on
  // the chord of both
  Geometry geometry = make_box(1., 1.);
  geometry.add_circle(Point<2>(0.4, 0.6), 0.01, "disk", CurveRole::joint);
  const Cut  cut(std::move(geometry), skew_mesh(0.2));
  const auto region = [&](const double x) {
    return cut.manifold.region(cut.manifold.find_element(Point<2>(x, 0.6)));
  };
  for (const double d : {-0.009, -0.003, 0., 0.003, 0.009})
    EXPECT_EQ(region(0.4 + d), region(0.4001)) << d;
  for (const double d : {-0.011, 0.011})
    EXPECT_NE(region(0.4 + d), region(0.4001)) << d;
}


TEST(Triangulate, CoversTheElementWithCurvedTriangles)
{
  const Cut cut(ring(), skew_mesh(0.4));
  double    area = 0.;
  for (unsigned int e = 0; e < cut.manifold.n_elements(); ++e)
    for (const QuadraticTriangle &t : triangulate(cut.manifold, e))
    {
      // area of a triangle with parabolic sides: corners plus 2/3 of chord
      // times bulge per side
      const auto cross = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b) {
        return a[0] * b[1] - a[1] * b[0];
      };
      double here = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
      for (unsigned int i = 0; i < 3; ++i)
        here -= 2. / 3. * cross(t[(i + 1) % 3] - t[i], t[3 + i] - t[i]);
      EXPECT_GT(here, 0.);
      area += here;
    }
  // parabolas instead of arcs of at most pi/8: relative area error below 1e-4
  EXPECT_NEAR(area, 3. * dealii::numbers::PI, 3e-4);
}
