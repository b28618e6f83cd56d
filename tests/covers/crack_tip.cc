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
