#include <nmm/covers/crack_tip.h>

#include <cmath>
#include <gtest/gtest.h>

// Crack tips: where they are, their frames, and the angle that jumps on the crack.

namespace
{
  using dealii::Point;
  using NMM::CrackTip;

  constexpr double pi = dealii::numbers::PI;

  std::vector<CrackTip>
  tips_of(const std::string &joints)
  {
    return NMM::find_crack_tips(NMM::PhysicalMesh(NMM::parse_geometry(
      "boundary POLYGON ((-5 -5, 5 -5, 5 5, -5 5))\n" + joints, "")));
  }


  TEST(CrackTip, StraightCrackHasTwo)
  {
    const auto tips = tips_of("joint LINESTRING (-1 0, 1 0)");
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[0].point, Point<2>(-1., 0.));
    EXPECT_EQ(tips[1].point, Point<2>(1., 0.));
    EXPECT_EQ(tips[0].direction, Point<2>(-1., 0.));
    EXPECT_EQ(tips[1].direction, Point<2>(1., 0.));
    // up to the other tip
    EXPECT_DOUBLE_EQ(tips[1].free_radius, 2.);
    EXPECT_NEAR(tips[1].angle({0., 1e-9}), pi, 1e-8);
    EXPECT_NEAR(tips[1].angle({0., -1e-9}), -pi, 1e-8);
    EXPECT_NEAR(tips[1].angle({1., 1.}), 0.5 * pi, 1e-15);
    EXPECT_NEAR(tips[0].angle({-1., 1.}), -0.5 * pi, 1e-15);
    // on the crack the side decides
    EXPECT_NEAR(tips[1].angle({0., 0.}, Point<2>(0., 1.)), pi, 1e-15);
    EXPECT_NEAR(tips[1].angle({0., 0.}, Point<2>(0., -1.)), -pi, 1e-15);
  }


  TEST(CrackTip, EndsElsewhereAreNone)
  {
    // at the boundary, at another joint, and of a joint that is tied
    EXPECT_EQ(tips_of("joint LINESTRING (-6 0, 1 0)").size(), 1u);
    EXPECT_EQ(tips_of(
                "joint LINESTRING (-6 0, 6 0)\njoint LINESTRING (0 0, 0 6)")
                .size(),
              0u);
    EXPECT_EQ(tips_of("joint state=closed LINESTRING (-1 0, 1 0)").size(), 0u);
    // a joint that goes on under another name
    EXPECT_EQ(tips_of("joint name=a LINESTRING (-1 0, 0 0)\njoint name=b "
                      "LINESTRING (0 0, 1 1)")
                .size(),
              2u);
  }


  TEST(CrackTip, FreeRadiusEndsAtWhatIsNear)
  {
    EXPECT_DOUBLE_EQ(tips_of("joint LINESTRING (0 0, 4 0)")[1].free_radius, 1.);
    // a junction
    const auto star = tips_of(
      "joint LINESTRING (0 0, 1 0)\n"
      "joint LINESTRING (0 0, -1 1)\n"
      "joint LINESTRING (0 0, -1 -1)");
    ASSERT_EQ(star.size(), 3u);
    EXPECT_DOUBLE_EQ(star[2].free_radius, 1.);
    ASSERT_EQ(star[2].path.size(), 1u);
    // a crack that turns back: (0 0) to (1 0) to (0.25 1), whose distance from the tip
    // (0 0) grows up to 1 and falls then
    const auto hook = tips_of("joint LINESTRING (0 0, 1 0, 0.25 1)");
    ASSERT_EQ(hook.size(), 2u);
    // the second part is nowhere nearer to the tip than its foot, 0.8
    EXPECT_DOUBLE_EQ(hook[0].free_radius, 0.8);
  }


  TEST(CrackTip, LiesOnInterfacesAndTiedJoints)
  {
    // On the side of an inclusion: the disk may hold both parts of that side, up to its corners.
    const std::string inclusion =
      "interface name=inclusion material=ore POLYGON ((1 -1, 3 -1, 3 2, 1 "
      "2))\n";
    auto tips = tips_of(inclusion + "joint name=crack LINESTRING (-2 0, 1 0)");
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[0].tied_curve, NMM::invalid_index);
    EXPECT_EQ(tips[0].regions.size(), 1u);
    EXPECT_EQ(tips[1].point, Point<2>(1., 0.));
    EXPECT_EQ(tips[1].direction, Point<2>(1., 0.));
    EXPECT_NE(tips[1].tied_curve, NMM::invalid_index);
    EXPECT_EQ(tips[1].regions.size(), 2u);
    // The side of the inclusion runs on around all of it and ends in the tip again, so that nothing
    // but the boundary at x = 5 and the other end of the crack are left.
    EXPECT_DOUBLE_EQ(tips[1].free_radius, 3.);
    // In a corner of the inclusion.
    tips = tips_of(inclusion + "joint LINESTRING (-2 -1, 1 -1)");
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[1].regions.size(), 2u);
    // Along the lower side, from outside of it to its middle; where the crack arrives at the corner,
    // the other sides begin.
    tips = tips_of(inclusion + "joint LINESTRING (0 -1, 2 -1)");
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[1].point, Point<2>(2., -1.));
    EXPECT_EQ(tips[1].regions.size(), 2u);
    EXPECT_DOUBLE_EQ(tips[1].free_radius, 1.);
    // Both ends on a side.
    tips = tips_of(inclusion + "joint LINESTRING (1.5 -1, 2 -1)");
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_DOUBLE_EQ(tips[0].free_radius, 0.5);
    // On a joint that is tied, but not where that ends at the boundary.
    const std::string tied = "joint state=closed LINESTRING (1 -6, 1 6)\n";
    EXPECT_EQ(tips_of(tied + "joint LINESTRING (-2 0, 1 0)").size(), 2u);
    EXPECT_EQ(tips_of(tied + "joint LINESTRING (-2 0, 1 5)").size(), 1u);
    // A crack that crosses an interface has no tip there.
    EXPECT_EQ(tips_of(inclusion + "joint LINESTRING (-2 0, 2 0)").size(), 2u);
  }


  TEST(CrackTip, WithoutRoomIsNamedApart)
  {
    const std::string outline = "boundary POLYGON ((-5 -5, 5 -5, 5 5, -5 5))\n";
    const auto        mesh_of = [&](const std::string &joints) {
      return NMM::PhysicalMesh(NMM::parse_geometry(outline + joints, ""));
    };
    // 1e4 eps times the largest coordinate is 1.1e-11.
    const auto narrow =
      mesh_of("joint name=a LINESTRING (-1 0, 4.99999999999 0)");
    EXPECT_EQ(NMM::find_crack_tips(narrow).size(), 1u);
    const auto crowded = NMM::find_tips_without_room(narrow);
    ASSERT_EQ(crowded.size(), 1u);
    EXPECT_EQ(narrow.curves()[crowded[0].nearest_curve].role,
              NMM::CurveRole::boundary);
    EXPECT_EQ(NMM::find_crack_ends(narrow).size(), 2u);
    EXPECT_NEAR(NMM::find_crack_ends(narrow)[0].length, 6., 1e-10);
    // There is room for a gap of 1e-10 of the size, and it is the free radius.
    const auto wide = mesh_of("joint name=a LINESTRING (-1 0, 4.999999999 0)");
    ASSERT_EQ(NMM::find_crack_tips(wide).size(), 2u);
    EXPECT_NEAR(NMM::find_crack_tips(wide)[1].free_radius, 1e-9, 1e-15);
    EXPECT_TRUE(NMM::find_tips_without_room(wide).empty());
  }


  TEST(CrackCorner, IsWhereTheSolidReachesIn)
  {
    const auto corners_of = [](const std::string &joints) {
      return NMM::find_crack_corners(NMM::PhysicalMesh(NMM::parse_geometry(
                                       "boundary POLYGON ((-5 -5, 5 -5, 5 5, "
                                       "-5 5))\n" +
                                         joints,
                                       "")),
                                     20. * pi / 180.);
    };
    const auto kink = corners_of("joint LINESTRING (-1 0, 0 0, 0 0.5)");
    ASSERT_EQ(kink.size(), 1u);
    EXPECT_EQ(kink[0].point, Point<2>(0., 0.));
    EXPECT_NEAR(kink[0].angle, 1.5 * pi, 1e-14);
    EXPECT_DOUBLE_EQ(kink[0].free_radius, 0.5);
    // Turns of 17 and of 22 degrees.
    EXPECT_TRUE(corners_of("joint LINESTRING (-1 0, 0 0, 1 0.3)").empty());
    EXPECT_EQ(corners_of("joint LINESTRING (-1 0, 0 0, 1 0.4)").size(), 1u);
    // Branches to one side, to both sides, and a tee.
    EXPECT_EQ(corners_of("joint LINESTRING (-1 0, 0 0)\n"
                         "joint LINESTRING (0 0, -0.5 0.5)\n"
                         "joint LINESTRING (0 0, 0 1)")
                .size(),
              1u);
    EXPECT_TRUE(corners_of("joint LINESTRING (-1 0, 0 0)\n"
                           "joint LINESTRING (0 0, 1 1)\n"
                           "joint LINESTRING (0 0, 1 -1)")
                  .empty());
    EXPECT_TRUE(corners_of("joint LINESTRING (-1 0, 1 0)\n"
                           "joint LINESTRING (0 0, 0 1)")
                  .empty());
    // At the boundary the solid is on one side of it.
    EXPECT_TRUE(corners_of("joint LINESTRING (-6 0, 0 0)").empty());
    // An arc that goes on in the direction of its tangent.
    EXPECT_TRUE(corners_of("joint COMPOUNDCURVE ((-2 1, 0 1), "
                           "CIRCULARSTRING (0 1, 0.6 0.8, 1 0))")
                  .empty());
  }


  /// Follow the angle along a circle about the tip from the one face to the other: it has
  /// to be the circle's own angle.
  void
  expect_continuous(const CrackTip &tip)
  {
    constexpr unsigned int n = 1000;
    for (const double share : {0.01, 0.3, 0.6, 0.99})
    {
      const double r       = share * tip.free_radius;
      const double ahead   = std::atan2(tip.direction[1], tip.direction[0]);
      unsigned int n_jumps = 0;
      double       last    = 0.;
      for (unsigned int i = 0; i <= n; ++i)
      {
        const double angle = ahead + 2. * pi * i / n;
        const double theta =
          tip.angle(tip.point + r * Point<2>(std::cos(angle), std::sin(angle)));
        // up to full turns it is the polar angle
        EXPECT_NEAR(std::remainder(theta - 2. * pi * i / n, 2. * pi), 0., 1e-9);
        if (i > 0 && std::abs(theta - last) > 1.)
        {
          ++n_jumps;
          EXPECT_NEAR(theta - last, -2. * pi, 2.1 * pi / n);
        }
        last = theta;
      }
      EXPECT_EQ(n_jumps, 1u);
      EXPECT_NEAR(last, 0., 1e-9);
    }
  }


  TEST(CrackTip, AngleJumpsOnKinksAndArcs)
  {
    // a half circle of radius 1 about the origin, from (1, 0) over (0, 1)
    const auto arc = tips_of("joint CIRCULARSTRING (1 0, 0 1, -1 0)");
    ASSERT_EQ(arc.size(), 2u);
    EXPECT_NEAR(arc[1].direction[0], 0., 1e-15);
    EXPECT_NEAR(arc[1].direction[1], -1., 1e-15);
    EXPECT_DOUBLE_EQ(arc[1].free_radius, 2.);
    // (0, 1) at the distance sqrt(2) is on the crack: seen from the tip (1, 0) at 135 degrees,
    // 225 degrees from its direction
    EXPECT_NEAR(arc[1].angle({0., 1.}, Point<2>(0., -1.)), -0.75 * pi, 1e-12);
    EXPECT_NEAR(arc[1].angle({0., 1.}, Point<2>(0., 1.)), 1.25 * pi, 1e-12);
    for (const CrackTip &tip : arc)
      expect_continuous(tip);

    const auto clockwise = tips_of("joint CIRCULARSTRING (-1 0, 0 1, 1 0)");
    EXPECT_NEAR((clockwise[1].direction - arc[1].direction).norm(), 0., 1e-15);

    for (const std::string joint :
         {"joint LINESTRING (0 0, 1 0.2, 1.5 1.5, 3 2)",
          "joint COMPOUNDCURVE ((0 0, 1 0.5), CIRCULARSTRING (1 0.5, 2 0.5, "
          "2.5 "
          "1.5), LINESTRING (2.5 1.5, 2.6 3))",
          "joint CIRCULARSTRING (0 0, 2 1, 2 3)"})
    {
      const auto tips = tips_of(joint);
      ASSERT_EQ(tips.size(), 2u);
      for (const CrackTip &tip : tips)
      {
        EXPECT_GT(tip.free_radius, 1.);
        expect_continuous(tip);
      }
    }
  }
} // namespace
