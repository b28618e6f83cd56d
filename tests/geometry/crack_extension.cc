#include <nmm/covers/crack_tip.h>
#include <nmm/geometry/crack_extension.h>

#include "test_helpers.h"
#include <gtest/gtest.h>

// Cracks that grow: what they meet, and that they are connected with it exactly.

namespace
{
  using geometry_test::Point;
  using NMM::CrackExtension;

  const std::string plate = "boundary POLYGON ((-5 -5, 5 -5, 5 5, -5 5))\n";
  const std::string crack = "joint name=crack LINESTRING (0 0, 1 0.1)\n";


  struct Grown
  {
    CrackExtension             extension;
    std::vector<NMM::CrackTip> tips;
    unsigned int               n_blocks;
  };


  /// Let the crack grow from (1, 0.1) by @p length in the direction of @p towards.
  Grown
  grow(const std::string &others, const double length, const Point &towards)
  {
    NMM::Geometry geometry = NMM::parse_geometry(plate + crack + others, "");
    const Point   tip(1., 0.1);
    Grown         result;
    result.extension = NMM::extend_crack(
      geometry, tip, (towards - tip) / (towards - tip).norm(), length, "crack");
    const NMM::PhysicalMesh mesh(std::move(geometry));
    result.tips     = NMM::find_crack_tips(mesh);
    result.n_blocks = mesh.n_blocks();
    return result;
  }


  TEST(CrackExtension, EndsInsideAndIsATipAgain)
  {
    const Grown grown = grow("", 0.5, {2., 0.9});
    EXPECT_EQ(grown.extension.met, "");
    EXPECT_NEAR(grown.extension.end.distance({1., 0.1}), 0.5, 1e-15);
    ASSERT_EQ(grown.tips.size(), 2u);
    EXPECT_EQ(grown.tips[1].point, grown.extension.end);
    // one crack: the path from the new tip runs through the old one
    EXPECT_EQ(grown.tips[1].path.size(), 2u);
  }


  TEST(CrackExtension, ArrivesAtWhatItMeets)
  {
    const struct
    {
      std::string  curve, met;
      Point        end;
      unsigned int n_tips;
    } cases[] = {
      // through the middle of a joint, a circle, an arc, an interface and another crack
      {"joint name=other LINESTRING (3 -6, 3 6)",
       "joint 'other'",
       {3., 0.3},
       1},
      {"hole name=bore CIRCLE (3.9 0.4, 1)",
       "hole 'bore'",
       {2.9060022, 0.2906002},
       1},
      {"joint name=other CIRCULARSTRING (3 -1, 3.4 0.34, 3 2)",
       "joint 'other'",
       {3.4, 0.34},
       3},
      {"interface name=seam LINESTRING (2.3 -6, 3.7 6)",
       "interface 'seam'",
       {3.0354132, 0.3035413},
       // the tip on the interface stays one, since the solid is all around
       2},
      {"joint name=other LINESTRING (2.3 0.5, 3.7 0.1)",
       "joint 'other'",
       {3., 0.3},
       3}};
    for (const auto &c : cases)
    {
      SCOPED_TRACE(c.curve);
      const Grown grown = grow(c.curve, 3., {2., 0.2});
      EXPECT_EQ(grown.extension.met, c.met);
      EXPECT_NEAR(grown.extension.end.distance(c.end), 0., 1e-6);
      // The tip is gone: no bridge, however thin, is left.
      EXPECT_EQ(grown.tips.size(), c.n_tips);
    }
    EXPECT_EQ(grow("", 9., {2., 0.2}).extension.met.substr(0, 8), "boundary");
  }


  TEST(CrackExtension, LeavesNoShortBridge)
  {
    const std::string wall = "joint name=wall LINESTRING (2 -6, 2 6)";
    // the wall is 1.005 away
    EXPECT_EQ(grow(wall, 0.68, {2., 0.2}).extension.met, "joint 'wall'");
    EXPECT_EQ(grow(wall, 0.66, {2., 0.2}).extension.met, "");
    // a corner that is near is where it arrives
    const Grown grown =
      grow("joint name=wall LINESTRING (2 -6, 2 0.2001, 3 6)", 1., {2., 0.2});
    EXPECT_EQ(grown.extension.end, Point(2., 0.2001));
  }


  TEST(CrackExtension, SetsABlockFree)
  {
    // A joint from side to side, with a bridge between two cracks that is cut.
    NMM::Geometry geometry = NMM::parse_geometry(
      plate +
        "joint name=a LINESTRING (-6 0, -1 0)\njoint name=b LINESTRING "
        "(1 0, 6 0)",
      "");
    EXPECT_EQ(NMM::PhysicalMesh(NMM::Geometry(geometry)).n_blocks(), 1u);
    const auto extension =
      NMM::extend_crack(geometry, {-1., 0.}, Point(1., 0.), 1.9, "a");
    EXPECT_EQ(extension.met, "joint 'b'");
    const NMM::PhysicalMesh mesh(std::move(geometry));
    EXPECT_EQ(mesh.n_blocks(), 2u);
    EXPECT_TRUE(NMM::find_crack_tips(mesh).empty());
  }


  TEST(CrackExtension, StartsAtAHoleAndInACorner)
  {
    // The place is off the circle by rounding of a field: the hole is divided at its nearest point.
    NMM::Geometry geometry =
      NMM::parse_geometry(plate + "hole name=bore CIRCLE (0 0, 1)", "");
    const Point along(0.6, 0.8);
    auto        extension = NMM::start_crack(
      geometry, Point(0.6001, 0.8), Point(along) / along.norm(), 0.5, "new");
    EXPECT_EQ(extension.met, "");
    EXPECT_NEAR(extension.end.norm(), 1.5, 1e-4);
    // In the corner within a thousandth of the increment, and there exactly.
    extension = NMM::start_crack(
      geometry, Point(-4.9999, -5.), Point(0.6, 0.8), 2., "corner");
    EXPECT_EQ(extension.end, Point(-5. + 2. * 0.6, -5. + 2. * 0.8));
    const NMM::PhysicalMesh mesh(std::move(geometry));
    const auto              tips = NMM::find_crack_tips(mesh);
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(mesh.n_blocks(), 1u);
    EXPECT_EQ(mesh.curves()[tips[1].curve].name, "new");
    EXPECT_TRUE(mesh.notices().empty());

    // From side to side of a narrow strip.
    NMM::Geometry strip =
      NMM::parse_geometry("boundary POLYGON ((0 0, 9 0, 9 1, 0 1))", "");
    EXPECT_EQ(NMM::start_crack(strip, Point(4., 0.), Point(0., 1.), 0.8, "cut")
                .met.substr(0, 8),
              "boundary");
    EXPECT_EQ(NMM::PhysicalMesh(std::move(strip)).n_blocks(), 2u);
  }
} // namespace
