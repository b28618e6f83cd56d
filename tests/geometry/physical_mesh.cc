#include <deal.II/base/numbers.h>

#include "geometry/test_helpers.h"
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace geometry_test;
using dealii::numbers::PI;

namespace
{
  // Areas sum a handful of products of coordinates of size one.
  constexpr double round_off = 1e-14;


  void
  expect_counts(const NMM::PhysicalMesh &mesh,
                const unsigned int       n_regions,
                const unsigned int       n_blocks,
                const double             area)
  {
    EXPECT_EQ(mesh.regions().size(), n_regions);
    EXPECT_EQ(mesh.n_blocks(), n_blocks);
    EXPECT_NEAR(total_area(mesh), area, round_off * area);
  }
} // namespace


TEST(PhysicalMesh, joints_crossing_overshooting_and_ending)
{
  // a cross of two overshooting joints
  expect_counts(mesh_of(unit_square + "joint LINESTRING (-1 0.25, 2 0.25)\n"
                                      "joint LINESTRING (0.5 -1, 0.5 2)"),
                4,
                4,
                1.);
  // a T that ends exactly on another joint
  expect_counts(mesh_of(unit_square + "joint LINESTRING (0 0.25, 1 0.25)\n"
                                      "joint LINESTRING (0.5 0.25, 0.5 1)"),
                3,
                3,
                1.);
  // a crack tip does not divide
  expect_counts(mesh_of(unit_square + "joint LINESTRING (0 0.25, 0.9 0.25)"),
                1,
                1,
                1.);
  // a crack wholly inside
  expect_counts(mesh_of(unit_square + "joint LINESTRING (0.1 0.25, 0.9 0.25)"),
                1,
                1,
                1.);
  // a bent joint through a corner of the boundary
  expect_counts(mesh_of(unit_square + "joint LINESTRING (0 0, 0.25 0.5, 0 1)"),
                2,
                2,
                1.);
}


TEST(PhysicalMesh, overlapping_joints)
{
  const auto twice = mesh_of(unit_square +
                             "joint name=a LINESTRING (0 0.25, 1 0.25)\n"
                             "joint name=b LINESTRING (1 0.25, 0 0.25)");
  expect_counts(twice, 2, 2, 1.);
  ASSERT_EQ(twice.notices().size(), 1u);
  expect_parts(twice.notices()[0], {"'a'", "'b'", "coincide over 1 m"});

  const auto partly = mesh_of(unit_square +
                              "joint name=a LINESTRING (0 0.25, 0.75 0.25)\n"
                              "joint name=b LINESTRING (0.25 0.25, 1 0.25)");
  expect_counts(partly, 2, 2, 1.);
  expect_parts(partly.notices().at(0), {"coincide over 0.5 m"});

  const auto itself = mesh_of(
    unit_square + "joint name=a LINESTRING (0 0.25, 0.75 0.25, 0.5 0.25)");
  expect_counts(itself, 1, 1, 1.);
  expect_parts(itself.notices().at(0), {"'a'", "itself", "0.25 m"});

  const auto arcs = mesh_of(
    "boundary name=o CIRCLE (0 0, 2)\n"
    "joint name=a CIRCLE (0 0, 1)\n"
    "joint name=b CIRCULARSTRING (1 0, 0 1, -1 0)");
  expect_counts(arcs, 2, 2, 4. * PI);
  expect_parts(arcs.notices().at(0), {"coincide over 3.14159 m"});
}


TEST(PhysicalMesh, joint_along_boundary)
{
  const auto mesh = mesh_of(unit_square +
                            "joint name=j LINESTRING (0 0, 1 0, 1 2)\n"
                            "joint name=k LINESTRING (0 0.5, 1 0.5)");
  expect_counts(mesh, 2, 2, 1.);
  ASSERT_EQ(mesh.notices().size(), 2u);
  expect_parts(mesh.notices()[0], {"'j'", "outside", "over 1 m"});
  expect_parts(mesh.notices()[1], {"'j'", "along a boundary", "over 2 m"});
}


TEST(PhysicalMesh, tangent_circles)
{
  // a hole that touches the boundary from inside
  expect_counts(mesh_of("boundary CIRCLE (0 0, 2)\nhole CIRCLE (1 0, 1)"),
                1,
                1,
                3. * PI);
  // two tangent inclusions
  expect_counts(mesh_of("boundary CIRCLE (0 0, 4)\n"
                        "interface CIRCLE (1 0, 1)\n"
                        "interface CIRCLE (-1 0, 1)"),
                3,
                1,
                16. * PI);
  // a circle tangent to a joint and to the sides of the square
  expect_counts(mesh_of("boundary POLYGON ((-1 -1, 1 -1, 1 1, -1 1))\n"
                        "joint CIRCLE (0 0, 1)\n"
                        "interface CIRCLE (0 0, 0.5)\n"
                        "joint LINESTRING (-1 0.5, 1 0.5)"),
                9,
                8,
                4.);
}


TEST(PhysicalMesh, several_domains)
{
  const std::string second =
    "boundary name=s2 POLYGON ((1 1, 2 1, 2 2, 1 2))\n";
  // touching in one point
  expect_counts(mesh_of(unit_square + second), 2, 2, 2.);
  // apart
  expect_counts(mesh_of(unit_square +
                        "boundary POLYGON ((3 1, 4 1, 4 2, 3 2))\n"),
                2,
                2,
                2.);
  // sharing part of an edge: two blocks
  expect_counts(mesh_of(unit_square +
                        "boundary POLYGON ((1 0.5, 2 0.5, 2 2, 1 2))\n"),
                2,
                2,
                2.5);
  // with separately named sides that meet in a common corner
  expect_counts(mesh_of("boundary name=a LINESTRING (0 0, 1 0)\n"
                        "boundary name=b LINESTRING (1 1, 1 0)\n"
                        "boundary name=c LINESTRING (1 1, 0 1, 0 0)\n"
                        "boundary name=d LINESTRING (2 2, 2 1, 1 1)\n"
                        "boundary name=e LINESTRING (1 1, 1 2, 2 2)\n"),
                2,
                2,
                2.);
  // a shared edge drawn by sides of both
  expect_counts(mesh_of("boundary name=a LINESTRING (0 0, 1 0)\n"
                        "boundary name=b LINESTRING (1 0, 1 1)\n"
                        "boundary name=c LINESTRING (1 1, 0 1, 0 0)\n"
                        "boundary name=d LINESTRING (1 0, 1 1)\n"
                        "boundary name=e LINESTRING (1 1, 2 1, 2 0, 1 0)\n"),
                2,
                2,
                2.);
}


TEST(PhysicalMesh, holes_and_islands)
{
  expect_counts(mesh_of("boundary CIRCLE (0 0, 3)\n"
                        "hole CIRCLE (0 0, 2)\n"
                        "boundary CIRCLE (0 0, 1)"),
                2,
                2,
                6. * PI);
  // a notch: the hole shares an edge with the boundary
  expect_counts(mesh_of(unit_square +
                        "hole POLYGON ((0 0, 0.5 0, 0.5 0.5, 0 0.5))"),
                1,
                1,
                0.75);
  // holes cut the ligaments, and named open sides make a hole
  expect_counts(mesh_of(unit_square +
                        "hole LINESTRING (0.25 0.25, 0.75 0.25)\n"
                        "hole LINESTRING (0.75 0.25, 0.75 0.75, 0.25 "
                        "0.75, 0.25 0.25)\n"
                        "joint LINESTRING (-1 0.5, 2 0.5)"),
                2,
                2,
                0.75);
  // inner rings of polygons
  const auto rings = mesh_of(
    "boundary name=p POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 2 1, 2 2), "
    "(3 3, 3.5 3, 3 3.5))");
  expect_counts(rings, 1, 1, 16. - 0.5 - 0.125);
  EXPECT_EQ(rings.find_curve("p.hole2"), 2u);
}


TEST(PhysicalMesh, half_ring_of_named_arcs)
{
  const auto mesh = mesh_of(
    "boundary name=outer CIRCULARSTRING (-2 0, 0 -2, 2 0)\n"
    "boundary name=right LINESTRING (2 0, 1 0)\n"
    "boundary name=inner CIRCULARSTRING (-1 0, 0 -1, 1 0)\n"
    "boundary name=left LINESTRING (-2 0, -1 0)\n");
  expect_counts(mesh, 1, 1, 1.5 * PI);
  const auto corners = mesh.bounding_box().get_boundary_points();
  EXPECT_EQ(corners.first, Point(-2., -2.));
  EXPECT_EQ(corners.second, Point(2., 0.));
  EXPECT_EQ(mesh.find_curve("inner"), 2u);
  EXPECT_EQ(mesh.find_curve("nothing"), NMM::invalid_index);
}


TEST(PhysicalMesh, circular_segments_to_round_off)
{
  // Between a chord of half-angle t of the unit circle and the arc:
  // t - sin(t) cos(t), here (2 t)^3/12 (1 - (2 t)^2/20 + ...). The height
  // 1 - cos t of the point between is rounded, relative error eps/t^2.
  for (const double t : {1.5, 0.5, 1e-2, 1e-3})
  {
    SCOPED_TRACE(t);
    NMM::Geometry geometry;
    NMM::Curve    curve;
    curve.pieces = {
      NMM::CurvePiece::arc(Point(-std::sin(t), 0.),
                           Point(0., 2. * std::pow(std::sin(t / 2), 2)),
                           Point(std::sin(t), 0.)),
      NMM::CurvePiece::segment(Point(std::sin(t), 0.),
                               Point(-std::sin(t), 0.))};
    geometry.add(curve);
    const NMM::PhysicalMesh mesh(std::move(geometry));
    const double            u = 2. * t;
    const double            exact =
      t > 0.1 ? t - std::sin(t) * std::cos(t)
                         : u * u * u / 12. * (1. - u * u / 20. + std::pow(u, 4) / 840.);
    EXPECT_NEAR(total_area(mesh), exact, 1e-15 / (t * t) * exact);
    EXPECT_GT(mesh.regions()[0].inside[1], 0.);
  }
}


TEST(PhysicalMesh, tiny_block)
{
  // a triangle of 1e-18 m^2 in a corner, its area still to round-off
  const auto mesh = mesh_of(unit_square + "joint LINESTRING (1e-9 0, 0 2e-9)");
  ASSERT_EQ(mesh.regions().size(), 2u);
  EXPECT_NEAR(mesh.regions()[0].area, 1e-18, 1e-32);
  EXPECT_EQ(mesh.n_blocks(), 2u);
}


TEST(PhysicalMesh, materials)
{
  const auto mesh = mesh_of(
    "boundary material=rock POLYGON ((0 0, 10 0, 10 10, 0 10))\n"
    "interface name=inner material=core CIRCLE (5 5, 1)\n"
    "interface name=outer material=shell CIRCLE (5 5, 2)\n"
    "interface name=layer LINESTRING (0 1, 10 1)\n"
    "joint LINESTRING (0 9, 10 9)\n"
    "material name=clay POINT (5 0.5)\n"
    "material name=sand POINT (5 9.5)\n"
    "material name=soil POINT (5 9.5)\n");
  EXPECT_EQ(mesh.regions().size(), 5u);
  EXPECT_EQ(mesh.n_blocks(), 2u);
  std::map<std::string, double> areas;
  for (const auto &region : mesh.regions())
    areas[mesh.material_names().at(region.material)] += region.area;
  EXPECT_NEAR(areas["core"], PI, 1e-13);
  EXPECT_NEAR(areas["shell"], 3. * PI, 1e-13);
  EXPECT_NEAR(areas["clay"], 10., 1e-13);
  EXPECT_NEAR(areas["soil"], 10., 1e-13);
  EXPECT_NEAR(areas["rock"], 80. - 4. * PI, 1e-12);
  EXPECT_EQ(areas.size(), 5u);

  // of inclusions that are not nested the later one wins
  const auto crossing = mesh_of(
    "boundary POLYGON ((0 0, 4 0, 4 2, 0 2))\n"
    "interface material=a POLYGON ((0 0, 3 0, 3 2, 0 2))\n"
    "interface material=b POLYGON ((1 0, 4 0, 4 2, 1 2))");
  ASSERT_EQ(crossing.regions().size(), 3u);
  EXPECT_EQ(crossing.material_names()[crossing.regions()[0].material], "a");
  EXPECT_EQ(crossing.material_names()[crossing.regions()[1].material], "b");
  EXPECT_EQ(crossing.material_names()[crossing.regions()[2].material], "b");
  // no material given
  EXPECT_EQ(mesh_of(unit_square).regions()[0].material, NMM::invalid_index);
}


TEST(PhysicalMesh, interface_of_several_pieces_of_one_name)
{
  const auto mesh =
    mesh_of(unit_square +
            "interface name=i material=m LINESTRING (0.2 0.2, 0.8 "
            "0.2)\n"
            "interface name=i LINESTRING (0.2 0.2, 0.5 0.8, 0.8 0.2)\n"
            "interface name=free LINESTRING (0.4 0.9, 0.6 0.9)");
  ASSERT_EQ(mesh.regions().size(), 2u);
  EXPECT_EQ(mesh.n_blocks(), 1u);
  EXPECT_EQ(mesh.regions()[0].material, NMM::invalid_index);
  EXPECT_EQ(mesh.regions()[1].material, 0u);
  EXPECT_EQ(mesh.find_curves("i"), (std::vector<unsigned int>{1, 2}));
  ASSERT_EQ(mesh.notices().size(), 1u);
  expect_parts(mesh.notices()[0], {"'free'", "separates nothing"});
}


TEST(PhysicalMesh, numbering_is_independent_of_the_order_of_curves)
{
  const std::string a      = "joint name=a LINESTRING (0.1 0, 0.7 1)\n";
  const std::string b      = "joint name=b LINESTRING (0 0.3, 1 0.2)\n";
  const auto        first  = mesh_of(unit_square + a + b);
  const auto        second = mesh_of(b + a + unit_square);
  ASSERT_EQ(first.regions().size(), 4u);
  for (unsigned int r = 0; r < 4; ++r)
  {
    EXPECT_NEAR(first.regions()[r].area, second.regions()[r].area, 1e-15);
    EXPECT_EQ(first.regions()[r].block, second.regions()[r].block);
  }
}


namespace
{
  using Line = std::pair<Point, Point>;

  /// Twice the signed area of a triangle.
  double
  turn(const Point &a, const Point &b, const Point &c)
  {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }


  /// Bounded faces that lines in general position inside the unit square make
  /// with it: F = E - V + C, where each crossing adds a vertex and two edges.
  unsigned int
  n_faces_by_euler(const std::vector<Line> &lines)
  {
    // Component 0 is the square, which nothing touches.
    std::vector<unsigned int> component(lines.size());
    unsigned int              n_crossings = 0;
    for (unsigned int i = 0; i < lines.size(); ++i)
    {
      component[i] = i + 1;
      for (unsigned int j = 0; j < i; ++j)
      {
        const auto &[a, b] = lines[i];
        const auto &[c, d] = lines[j];
        if (turn(a, b, c) * turn(a, b, d) > 0. ||
            turn(c, d, a) * turn(c, d, b) > 0.)
          continue;
        ++n_crossings;
        const unsigned int old = component[j];
        for (unsigned int k = 0; k <= i; ++k)
          if (component[k] == old)
            component[k] = component[i];
      }
    }
    const std::set<unsigned int> components(component.begin(), component.end());
    const unsigned int n_vertices = 4 + 2 * lines.size() + n_crossings;
    const unsigned int n_edges    = 4 + lines.size() + 2 * n_crossings;
    return n_edges - n_vertices + components.size() + 1;
  }
} // namespace


// Areas add up, whether joints cross inside (then Euler's formula gives the
// number of blocks), overshoot the boundary, or meet in and overlap between the
// nodes of a lattice.
TEST(PhysicalMesh, random_joint_networks)
{
  unsigned int n_blocks_in_all = 0;
  for (unsigned int seed = 0; seed < 500; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> inside(0., 1.), beyond(-0.4, 1.4);
    std::uniform_int_distribution<int>     lattice(0, 4);
    const auto                             random = [&]() {
      return seed % 3 == 0   ? inside(generator)
                                         : seed % 3 == 1 ? beyond(generator)
                                                         : lattice(generator) / 4.;
    };
    NMM::Geometry geometry;
    geometry.add_polygon(
      {Point(0., 0.), Point(1., 0.), Point(1., 1.), Point(0., 1.)}, "b");
    std::vector<Line> joints;
    while (joints.size() < 15)
    {
      const Point a(random(), random()), b(random(), random());
      // Half-way a joint must be inside, else it may be wholly outside.
      const Point m = a + 0.5 * (b - a);
      if (a == b || m[0] <= 0. || m[0] >= 1. || m[1] <= 0. || m[1] >= 1.)
        continue;
      geometry.add_polyline({a, b},
                            "j" + std::to_string(joints.size()),
                            NMM::CurveRole::joint);
      joints.emplace_back(a, b);
    }
    const NMM::PhysicalMesh mesh(std::move(geometry));
    EXPECT_NEAR(total_area(mesh), 1., 1e-12);
    EXPECT_EQ(mesh.n_blocks(), mesh.regions().size());
    for (const auto &region : mesh.regions())
      EXPECT_GT(region.area, 0.);
    if (seed % 3 == 0)
    {
      EXPECT_EQ(mesh.n_blocks(), n_faces_by_euler(joints));
    }
    n_blocks_in_all += mesh.n_blocks();
  }
  EXPECT_GT(n_blocks_in_all, 5000u);
}


TEST(PhysicalMesh, thousand_joints)
{
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> position(0., 1.), step(-0.1, 0.1);
  NMM::Geometry                          geometry;
  geometry.add_polygon(
    {Point(0., 0.), Point(1., 0.), Point(1., 1.), Point(0., 1.)}, "b");
  for (unsigned int i = 0; i < 1000; ++i)
  {
    const Point a(position(generator), position(generator));
    const Point b(a[0] + step(generator), a[1] + step(generator));
    geometry.add_polyline({a, b},
                          "j" + std::to_string(i),
                          NMM::CurveRole::joint);
  }
  const auto              start = std::chrono::steady_clock::now();
  const NMM::PhysicalMesh mesh(std::move(geometry));
  const double            seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_NEAR(total_area(mesh), 1., 1e-12);
#ifdef DEBUG
  EXPECT_LT(seconds, 10.);
#else
  // measured: 0.06 s; a tenfold margin for loaded machines
  EXPECT_LT(seconds, 0.6);
#endif
}
