#include "geometry/test_helpers.h"
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>

using namespace geometry_test;

TEST(GeometryReader, every_form)
{
  const NMM::Geometry geometry = NMM::parse_geometry(
    "\xEF\xBB\xBF# a comment\r\n"
    "boundary name=outer material=\"hard rock\" LineString (0 0, # why\n"
    "  1 +0.5,\n"
    "  -1e-3 2)   \n"
    "\n"
    "hole CIRCLE(0.5 0.25, 0.125)\n"
    "joint name='a b' state=closed MULTILINESTRING ((0 0, 1 1), (2 2, 3 3))\n"
    "joint name=c CIRCULARSTRING (1 0, 0 1, -1 0, -2 -1, -3 0)\n"
    "interface material=m COMPOUNDCURVE ((0 0, 1 0), CIRCULARSTRING (1 0, 0 1, "
    "-1 0), LINESTRING (-1 0, 0 0))\n"
    "boundary name=p CURVEPOLYGON (CIRCLE (9 9, 1), COMPOUNDCURVE "
    "(CIRCULARSTRING (9 9, 9.1 9.1, 9.2 9), (9.2 9, 9 9)), (8.5 9, 8.7 9, 8.7 "
    "9.1))\n"
    "material name=m2 POINT (0.5 0.75)",
    "f");
  const auto &curves = geometry.curves();
  ASSERT_EQ(curves.size(), 9u);

  EXPECT_EQ(curves[0].name, "outer");
  EXPECT_EQ(curves[0].material, "hard rock");
  EXPECT_EQ(curves[0].source, "f:2");
  EXPECT_EQ(curves[0].pieces.size(), 2u);
  EXPECT_EQ(curves[0].pieces[1].start, Point(1., 0.5));
  EXPECT_EQ(curves[0].pieces[1].end, Point(-1e-3, 2.));

  EXPECT_EQ(curves[1].role, NMM::CurveRole::hole);
  EXPECT_EQ(curves[1].name, "hole-2");
  EXPECT_EQ(curves[1].source, "f:6");
  EXPECT_EQ(curves[1].pieces[0].kind, NMM::CurvePiece::Kind::circle);
  EXPECT_EQ(curves[1].pieces[0].center, Point(0.5, 0.25));
  EXPECT_EQ(curves[1].pieces[0].radius, 0.125);

  EXPECT_EQ(curves[2].name, "a b");
  EXPECT_EQ(curves[3].name, "a b");
  EXPECT_EQ(curves[3].state, NMM::JointState::closed);
  EXPECT_EQ(curves[3].start(), Point(2., 2.));

  EXPECT_EQ(curves[4].state, NMM::JointState::open);
  ASSERT_EQ(curves[4].pieces.size(), 2u);
  EXPECT_EQ(curves[4].pieces[0].through, Point(0., 1.));
  EXPECT_EQ(curves[4].pieces[0].center, Point(0., 0.));
  EXPECT_EQ(curves[4].pieces[0].radius, 1.);

  ASSERT_EQ(curves[5].pieces.size(), 3u);
  EXPECT_EQ(curves[5].role, NMM::CurveRole::interface);
  EXPECT_EQ(curves[5].pieces[1].kind, NMM::CurvePiece::Kind::arc);
  EXPECT_TRUE(curves[5].is_closed());

  EXPECT_EQ(curves[6].name, "p");
  EXPECT_EQ(curves[7].name, "p.hole1");
  EXPECT_EQ(curves[8].name, "p.hole2");
  EXPECT_EQ(curves[8].role, NMM::CurveRole::hole);
  EXPECT_EQ(curves[8].pieces.size(), 3u);

  ASSERT_EQ(geometry.material_points().size(), 1u);
  EXPECT_EQ(geometry.material_points()[0].first, Point(0.5, 0.75));
  EXPECT_EQ(geometry.material_points()[0].second, "m2");
}


TEST(GeometryReader, numbers_keep_every_bit)
{
  std::mt19937_64 generator(7);
  unsigned int    n_compared = 0;
  for (unsigned int i = 0; i < 10000; ++i)
  {
    const std::uint64_t bits = generator();
    double              number;
    std::memcpy(&number, &bits, sizeof(number));
    // Others are refused.
    if (!(std::abs(number) >= 1e-75 && std::abs(number) <= 1e75))
      continue;
    char text[64];
    std::snprintf(text,
                  sizeof(text),
                  "joint LINESTRING (%.17g 0, 0 1)",
                  number);
    EXPECT_EQ(NMM::parse_geometry(text, "f").curves()[0].start()[0], number);
    ++n_compared;
  }
  // 498 of the 2046 exponents are in this range.
  EXPECT_GT(n_compared, 2200u);
}


TEST(GeometryReader, errors_name_file_line_and_remedy)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
    {"bondary LINESTRING (0 0, 1 1)", {"'bondary'", "boundary, hole"}},
    {"(0 0, 1 1)", {"starts with '('"}},
    {"joint nme=a LINESTRING (0 0, 1 1)", {"'nme'", "name and state"}},
    {"joint name=a name=b LINESTRING (0 0, 1 1)", {"given twice"}},
    {"joint name= LINESTRING (0 0, 1 1)", {"write LINESTRING"}},
    {"joint name=(0 0, 1 1)", {"'name' has no value"}},
    {"joint name='a LINESTRING (0 0, 1 1)", {"quotation mark"}},
    {"joint state=shut LINESTRING (0 0, 1 1)", {"'shut'", "state=open"}},
    {"joint SPLINE (0 0, 1 1)", {"'SPLINE'", "LINESTRING"}},
    {"joint POINT (0 0)", {"'POINT'", "CIRCLE"}},
    {"joint name=a", {"no shape", "LINESTRING"}},
    {"joint LINESTRING", {"expected '('"}},
    {"joint LINESTRING EMPTY", {"'EMPTY'", "parentheses"}},
    {"joint LINESTRING (0 0)", {"too few points (1)", "at least 2"}},
    {"joint LINESTRING ()", {"expected a number"}},
    {"joint LINESTRING (0 0, 1)", {"only one coordinate", "two numbers"}},
    {"joint LINESTRING (0 0 1, 1 1)", {"'1' follows", "comma"}},
    {"joint LINESTRING (0 0, 1 x)", {"'x' is not a number"}},
    {"joint LINESTRING (0 0, 1 1.5.2)", {"'1.5.2' is not a number"}},
    {"joint LINESTRING (0 0, nan 1)", {"'nan'", "finite"}},
    {"joint LINESTRING (0 0, 1 inf)", {"'inf'", "finite"}},
    {"joint LINESTRING (0 0, 1 1e999)", {"'1e999'", "number"}},
    {"joint LINESTRING (0 0, 1 inf)", {"'inf'", "not finite"}},
    {"joint LINESTRING (0 0, 1 -nan)", {"'-nan'", "not finite"}},
    {"joint LINESTRING (0 0, 1 -1e308)", {"'-1e308'", "1e75"}},
    {"boundary CIRCLE (0 0, 1e160)", {"'1e160'", "1e75"}},
    {"joint LINESTRING (0 0, 1 1e-80)", {"'1e-80'", "1e-75"}},
    {"joint LINESTRING (0 0, 1 0x10)", {"'0x10' is not a number"}},
    // A message shows no more than this of a file that may be somebody else's.
    {"root:secretpassword:1:2", {"'root:secretp...'"}},
    {"joint LINESTRING (0 0, 1 1", {"never closed", "missing ')'"}},
    {"joint LINESTRING (0 0, 1 1\njoint LINESTRING (0 0, 1 1)",
     {"not closed before 'joint'", "missing ')'"}},
    {"joint LINESTRING (0 0, 1 1))", {"closes nothing"}},
    {"joint LINESTRING (0 0, 1 1) (2 2)", {"expected the end of the record"}},
    {"joint CIRCULARSTRING (0 0, 1 1)", {"too few points (2)", "3"}},
    {"joint CIRCULARSTRING (0 0, 1 1, 2 0, 3 3)", {"4 points", "odd number"}},
    {"joint COMPOUNDCURVE (POLYGON ((0 0, 1 1)))", {"'POLYGON'", "no part"}},
    {"boundary CURVEPOLYGON (CIRCULARSTRING (0 0, 1 1, 2 0))",
     {"2 m", "(2, 0)", "ends"}},
    {"boundary CURVEPOLYGON (SPLINE (0 0, 1 1))", {"'SPLINE'", "no ring"}},
    {"boundary POLYGON ((0 0, 1 1, 0 0))", {"fewer than three"}},
    {"boundary POLYGON (0 0, 1 1, 1 0)", {"expected '('"}},
    {"hole CIRCLE (0 0 1)", {"'1' follows"}},
    {"hole CIRCLE (0 0)", {"centre first"}},
    {"hole material=m CIRCLE (0 0, 1)", {"'material'", "its keys are name"}},
    {"hole POLYGON ((0 0, 4 0, 4 4), (1 1, 2 1, 2 2))", {"islands"}},
    {"interface POLYGON ((0 0, 4 0, 4 4), (1 1, 2 1, 2 2))", {"inner ring"}},
    {"material POINT (0 0)", {"no material", "name="}},
    {"material name=m LINESTRING (0 0, 1 1)", {"'LINESTRING'", "POINT"}}};
  for (const auto &[text, parts] : cases)
  {
    SCOPED_TRACE(text);
    const std::string message = error_of(
      [&, &text = text]() { NMM::parse_geometry("\n" + text, "dir/f.wkt"); });
    EXPECT_FALSE(message.empty());
    expect_parts(message, parts);
    expect_parts(message, {"dir/f.wkt:2"});
  }
}


TEST(GeometryReader, files)
{
  expect_parts(error_of([]() { NMM::read_geometry("/nowhere/x.wkt"); }),
               {"cannot be read", "/nowhere/x.wkt"});
  const std::string name = NMM_TEST_OUTPUT_DIR "/reader.wkt";
  std::ofstream(name) << "boundary name=disk CIRCLE (0 0, 1)\n";
  EXPECT_EQ(NMM::read_geometry(name).curves().at(0).source, name + ":1");
}
