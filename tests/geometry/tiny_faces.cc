// What is smaller than coordinates can tell apart: faces, and the sagitta of arcs.

#include "test_helpers.h"
#include <cmath>

using namespace geometry_test;

namespace
{
  unsigned int
  n_notices_with(const NMM::PhysicalMesh &mesh, const std::string &words)
  {
    unsigned int n = 0;
    for (const std::string &notice : mesh.notices())
      n += notice.find(words) != std::string::npos;
    return n;
  }


  const std::string apart = "smaller than coordinates can tell apart";
} // namespace


// Digits of three lines through (0.5, 0.5) leave a triangle with all corners there.
TEST(TinyFaces, ThreeLinesThroughAPoint)
{
  const auto mesh = mesh_of(unit_square +
                            "joint LINESTRING (0 0.2, 1 0.8)\n"
                            "joint LINESTRING (0 0.8, 1 0.2)\n"
                            "joint LINESTRING (0.2 0, 0.8 1)");
  EXPECT_EQ(mesh.n_blocks(), 6u);
  EXPECT_EQ(n_notices_with(mesh, apart), 1u);
  // a dozen roundings of numbers up to 1
  EXPECT_NEAR(total_area(mesh), 1., 1e-14);
}


// A joint drawn twice, one ulp apart, is one joint; so is an interface beside a joint,
// and the joint is what remains.
TEST(TinyFaces, LinesDrawnTwice)
{
  const std::string line = " LINESTRING (0 0.5, 1 0.5)\n";
  const std::string above =
    " LINESTRING (0 0.5000000000000001, "
    "1 0.5000000000000001)\n";
  for (const std::string other : {"joint", "interface"})
  {
    SCOPED_TRACE(other);
    const auto mesh =
      mesh_of(unit_square + "joint" + line + other + " name=o" + above);
    EXPECT_EQ(mesh.regions().size(), 2u);
    EXPECT_EQ(mesh.n_blocks(), 2u);
    EXPECT_EQ(n_notices_with(mesh, apart), 1u);
    EXPECT_NEAR(total_area(mesh), 1., 1e-14);
  }
  const auto bonded = mesh_of(unit_square + "interface name=a" + line +
                              "interface name=b" + above);
  EXPECT_EQ(bonded.regions().size(), 2u);
  EXPECT_EQ(bonded.n_blocks(), 1u);
}


TEST(TinyFaces, WholeDomains)
{
  // one ulp wide beside another domain, and by itself
  const std::string thin =
    "boundary name=thin POLYGON ((2 0, "
    "2.0000000000000004 0, 2.0000000000000004 1, 2 1))";
  const auto mesh = mesh_of(unit_square + thin);
  EXPECT_EQ(mesh.regions().size(), 1u);
  EXPECT_EQ(n_notices_with(mesh, "left out"), 1u);
  expect_parts(error_of([&]() { mesh_of(thin); }),
               {apart, "(2, 0)", "test.wkt:1"});
}


// Thin, but not below rounding: it stays, and is named.
TEST(TinyFaces, SliversAreNamed)
{
  const auto mesh =
    mesh_of(unit_square +
            "joint name=a LINESTRING (0 0.5, 1 0.5)\n"
            "joint name=b LINESTRING (0 0.50000000001, 1 0.50000000001)");
  ASSERT_EQ(mesh.regions().size(), 3u);
  EXPECT_EQ(n_notices_with(mesh, apart), 0u);
  EXPECT_EQ(n_notices_with(mesh, "sliver"), 1u);
  expect_parts(mesh.notices().back(),
               {"1e-11 m", "(0.5, 0.5", "joint 'a'", "joint 'b'"});
  unsigned int n_slivers = 0;
  for (const auto &region : mesh.regions())
    n_slivers += region.is_sliver;
  EXPECT_EQ(n_slivers, 1u);
}


// On a line in decimal digits, not in binary ones, or below the rounding of the centre.
TEST(TinyFaces, StraightArcs)
{
  for (const std::string middle :
       {"0.3 0.4", "0.3 0.40000000000000013", "0.3 0.400000001"})
  {
    SCOPED_TRACE(middle);
    const auto mesh = mesh_of(unit_square + "joint name=j CIRCULARSTRING " +
                              "(0 0.1, " + middle + ", 0.6 0.7)");
    EXPECT_EQ(n_notices_with(mesh, "joint 'j'"), 1u);
    EXPECT_EQ(mesh.pieces().back().kind, NMM::CurvePiece::Kind::segment);
  }
  const auto arc = mesh_of(unit_square + "joint name=j CIRCULARSTRING " +
                           "(0 0.1, 0.3 0.400001, 0.6 0.7)");
  EXPECT_TRUE(arc.notices().empty());
  EXPECT_EQ(arc.pieces().back().kind, NMM::CurvePiece::Kind::arc);

  // area between an arc of sagitta s and its chord c: 2/3 c s
  const double s = 1e-7, c = 1.;
  const auto   segment = mesh_of(
    "boundary name=a CIRCULARSTRING (0 0, 0.5 -1e-7, 1 0)\n"
      "boundary name=b LINESTRING (1 0, 1 1, 0 1, 0 0)");
  EXPECT_NEAR(total_area(segment), 1. + 2. / 3. * c * s, 1e-14);
}


// Collinear lines with rounded digits, one of which ends inside the block: a strip that is
// open there is no face of its own. All of them are one joint of two blocks' length.
TEST(TinyFaces, LinesThatEndOnOthers)
{
  const auto mesh =
    mesh_of(unit_square +
            "joint name=a LINESTRING (0 0.1, 0.7 0.38)\n"
            "joint name=b LINESTRING (0.30000000000000004 0.22000000000000006, "
            "1 0.5)\n"
            "joint name=c LINESTRING (0.5 0.30000000000000004, "
            "0.6 0.3399999999999999)");
  EXPECT_EQ(mesh.regions().size(), 2u);
  EXPECT_EQ(mesh.n_blocks(), 2u);
  EXPECT_EQ(mesh.dangling_ends().n_kept, 0u);
  EXPECT_EQ(n_notices_with(mesh, "within rounding"), 1u);
  EXPECT_EQ(n_notices_with(mesh, "'a' and joint 'b' coincide"), 1u);
  EXPECT_EQ(n_notices_with(mesh, "'a' and joint 'c' coincide"), 1u);
  EXPECT_EQ(n_notices_with(mesh, apart), 0u);
  // a dozen roundings of numbers up to 1
  EXPECT_NEAR(total_area(mesh), 1., 1e-14);
}


// What is exact stays as it is drawn: ends on other lines and short of them, crossings at
// small angles, and lines just further apart than rounding (32 epsilon).
TEST(TinyFaces, LinesThatMerelyMeet)
{
  const auto n_pieces = [](const std::string &lines) {
    const auto mesh = mesh_of(unit_square + lines);
    EXPECT_EQ(n_notices_with(mesh, "within rounding"), 0u) << lines;
    return mesh.pieces().size();
  };
  const std::string line = "joint name=a LINESTRING (0.1 0.5, 0.9 0.5)\n";
  EXPECT_EQ(n_pieces(line + "joint LINESTRING (0.5 0, 0.5 0.5)"), 6u);
  EXPECT_EQ(n_pieces(line + "joint LINESTRING (0.5 0, 0.5 0.4999999999999999)"),
            6u);
  EXPECT_EQ(n_pieces(line + "joint LINESTRING (0 0.49999999999999, "
                            "1 0.50000000000001)"),
            6u);
  EXPECT_EQ(n_pieces(line + "joint LINESTRING (0.3 0.50000000000001, "
                            "0.7 0.50000000000001)"),
            6u);
  // the same corner, two sides of a joint beside one that is folded sharply
  EXPECT_EQ(n_pieces("joint LINESTRING (0.1 0.5, 0.9 0.5, 0.1 0.51)"), 6u);
}


// A joint along a side and beyond its corner: the boundary gets no vertex, and the joint
// separates where it is inside.
TEST(TinyFaces, LinesAlongBoundaries)
{
  const std::string angle =
    "boundary POLYGON ((0 0, 0.3 0.1, 1 0.1, 1 1, 0 1))\n";
  const auto mesh = mesh_of(
    angle + "joint name=a LINESTRING (0.03 0.010000000000000002, 0.9 0.3)");
  EXPECT_EQ(mesh.n_blocks(), 1u);
  EXPECT_EQ(n_notices_with(mesh, "runs along a boundary"), 1u);
  EXPECT_EQ(n_notices_with(mesh, "within rounding"), 1u);
  EXPECT_EQ(mesh.dangling_ends().n_kept, 1u);
}
