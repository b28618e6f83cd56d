#include "geometry/test_helpers.h"
#include <cmath>
#include <limits>

using namespace geometry_test;

namespace
{
  /// What building a mesh of @p text complains about.
  void
  expect_error(const std::string &text, const std::vector<std::string> &parts)
  {
    const std::string message = error_of([&]() { mesh_of(text); });
    SCOPED_TRACE(text);
    EXPECT_FALSE(message.empty());
    expect_parts(message, parts);
  }
} // namespace


TEST(BadInput, open_boundary)
{
  expect_error(
    "boundary name=left LINESTRING (0 0, 1 0, 1 1)\n"
    "boundary name=right LINESTRING (1 1, 0 1, 0 0.125)\n",
    {"'left'",
     "open",
     "(0, 0)",
     "0.125 m away at (0, 0.125)",
     "'right'",
     "test.wkt:1",
     "cleaning tolerance"});
  // three ends in one point
  expect_error(
    "boundary name=a LINESTRING (0 0, 1 0, 1 1, 0 0)\n"
    "boundary name=b LINESTRING (2 2, 3 3, 3 4)\n",
    {"'b'", "(2, 2)", "coincide"});
  expect_error(unit_square +
                 "hole name=h LINESTRING (0.2 0.2, 0.3 0.3, 0.2 0.3)",
               {"hole 'h'", "open", "(0.2, 0.2)"});
}


TEST(BadInput, self_intersecting_boundary)
{
  expect_error("boundary name=eight POLYGON ((0 0, 1 1, 1 0, 0 1))",
               {"'eight'", "crosses", "(0.5, 0.5)", "order of the points"});
  // two triangles that hang together at a vertex
  expect_error("boundary name=pinch POLYGON ((0 0, 1 1, 2 0, 2 2, 1 1, 0 2))",
               {"'pinch'", "touches", "(1, 1)", "closed curve of its own"});
  expect_error("boundary name=spike POLYGON ((0 0, 2 0, 1 0, 1 1))",
               {"'spike'", "overlaps itself", "remove"});
  expect_error(
    "boundary name=a LINESTRING (0 0, 2 0, 2 1)\n"
    "boundary name=b LINESTRING (2 1, 1 -1, 0 0)",
    {"'a'", "'b'", "crosses", "(1.5, 0)"});
  // an arc that bulges through the opposite side
  expect_error(
    "boundary name=c COMPOUNDCURVE (CIRCULARSTRING (0 0, 1 2, 2 0), "
    "(2 0, 2 3, 0 3, 0 0))",
    {"'c'", "crosses"});
}


TEST(BadInput, misplaced_domains_and_holes)
{
  expect_error(unit_square + "hole name=h CIRCLE (3 0, 1)",
               {"'h'", "outside", "test.wkt:2", "move it"});
  expect_error(unit_square + "hole name=h CIRCLE (1 0.5, 0.25)",
               {"'h'", "outside", "(1."});
  expect_error(unit_square +
                 "hole name=h CIRCLE (0.5 0.5, 0.25)\n"
                 "hole name=i CIRCLE (0.6 0.5, 0.25)",
               {"'h'", "'i'", "overlap", "merge"});
  expect_error(unit_square + "boundary name=b CIRCLE (0.5 0.5, 0.25)",
               {"'square'", "'b'", "overlap", "hole or an interface"});
  expect_error(unit_square + unit_square, {"overlap"});
  expect_error("joint LINESTRING (0 0, 1 1)", {"no outer boundary", "add"});
}


TEST(BadInput, lines_outside)
{
  expect_error(unit_square + "joint name=j LINESTRING (2 0, 3 0)",
               {"joint 'j'", "wholly outside", "(2, 0)", "test.wkt:2"});
  // touching the solid in a point only
  expect_error(unit_square + "joint name=j LINESTRING (1 1, 3 0)",
               {"wholly outside"});
  expect_error(unit_square +
                 "hole CIRCLE (0.5 0.5, 0.4)\n"
                 "interface name=i CIRCLE (0.5 0.5, 0.1)",
               {"interface 'i'", "wholly outside"});
}


TEST(BadInput, degenerate_pieces)
{
  expect_error("boundary name=b POLYGON ((0 0, 1 0, 1 0, 1 1))",
               {"'b'", "zero length", "(1, 0)", "test.wkt:1", "repeated"});
  expect_error(unit_square + "joint name=j CIRCULARSTRING (0 0, 2 2, 1 1)",
               {"'j'", "straight line", "(2, 2)", "between"});
  expect_error(unit_square + "joint name=j CIRCULARSTRING (0 0, 1 0, 0 0)",
               {"'j'", "coincide", "CIRCLE"});
  expect_error(unit_square + "hole name=h CIRCLE (0.5 0.5, 0)",
               {"'h'", "radius", "0 m", "positive"});
  expect_error(unit_square + "hole name=h CIRCLE (0.5 0.5, 1e-17)",
               {"'h'", "too small"});
  expect_error(unit_square +
                 "joint name=j COMPOUNDCURVE ((0 0, 0.5 0.5), "
                 "(0.5 0.25, 1 1))",
               {"piece 2", "'j'", "0.25 m", "(0.5, 0.25)", "exactly"});
}


TEST(BadInput, from_calls)
{
  const double  nan = std::numeric_limits<double>::quiet_NaN();
  const double  inf = std::numeric_limits<double>::infinity();
  NMM::Geometry geometry;
  expect_parts(error_of([&]() {
                 geometry.add_polyline({Point(0., 0.), Point(nan, 1.)},
                                       "j",
                                       NMM::CurveRole::joint);
               }),
               {"'j'", "not a finite number", "(nan, 1)"});
  expect_parts(error_of([&]() {
                 geometry.add_circle(Point(0., 0.),
                                     inf,
                                     "c",
                                     NMM::CurveRole::hole);
               }),
               {"'c'", "not a finite number"});
  expect_parts(error_of([&]() {
                 geometry.add_polygon({Point(0., 0.), Point(1., 1.)}, "p");
               }),
               {"'p'", "fewer than three"});
  expect_parts(error_of([&]() {
                 geometry.add_polyline({Point(0., 0.)},
                                       "j",
                                       NMM::CurveRole::joint);
               }),
               {"'j'", "no piece"});
  expect_parts(error_of(
                 [&]() { geometry.add_material_point(Point(0., nan), "m"); }),
               {"'m'", "not finite"});
  EXPECT_TRUE(geometry.curves().empty());
}


TEST(BadInput, names_and_materials)
{
  expect_error(unit_square + "joint name=square LINESTRING (0 0, 1 1)",
               {"'square'", "boundary", "joint", "rename"});
  expect_error(unit_square + "material name=m POINT (2 2)",
               {"'m'", "outside", "(2, 2)"});
  expect_error(unit_square + "material name=m POINT (0.5 0)", {"on a curve"});
  expect_error(unit_square +
                 "interface name=i material=m LINESTRING (0 0, 1 1)",
               {"'i'", "'m'", "open", "material point"});
  expect_error(
    "boundary name=a material=m LINESTRING (0 0, 1 0, 1 1)\n"
    "boundary name=b material=n LINESTRING (1 1, 0 0)",
    {"'a'", "'b'", "'m'", "'n'", "same material"});
}
