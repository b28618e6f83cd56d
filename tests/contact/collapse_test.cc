// Mechanisms of rigid blocks.

#include <cmath>
#include <contact/diagnostics/collapse.h>
#include <gtest/gtest.h>
#include <limits>

using namespace NMM;
using namespace NMM::internal;
using dealii::Point;

namespace
{
  constexpr double any = std::numeric_limits<double>::max();


  /// A block of 2 m by 4 m around @p x, without motion.
  BlockMotion
  block(const double x)
  {
    BlockMotion result;
    result.block  = 0;
    result.area   = 8.;
    result.center = Point<2>(x, 2.);
    result.radius = std::sqrt((4. + 16.) / 12.);
    return result;
  }


  /// Two corners of the block stand on a floor at y = 0 with a friction coefficient.
  void
  add_floor(RigidBlocks       &blocks,
            const unsigned int number,
            const double       x,
            const double       friction)
  {
    for (const double side : {-1., 1.})
      for (const double sign : {-1., 1.})
        blocks.add_force(number,
                         invalid_index,
                         {x + side, 0.},
                         Point<2>(sign * friction, 1.) /
                           std::hypot(1., friction),
                         0.,
                         any);
  }


  // A horizontal force on the centroid, 2 m above the floor, overturns the block about its edge, 1 m
  // beside the centroid, from half of its weight on.
  TEST(RigidBlocks, Overturn)
  {
    RigidBlocks blocks({block(1.)});
    add_floor(blocks, 0, 1., 0.7);
    EXPECT_TRUE(blocks.find_mechanism({{{0.499, -1., 0.}}}).empty());
    const auto v = blocks.find_mechanism({{{0.501, -1., 0.}}});
    ASSERT_EQ(v.size(), 1u);
    // clockwise about (2, 0): the centroid moves along (2, 1), up to the iterations
    EXPECT_LT(v[0][2], 0.);
    EXPECT_NEAR(v[0][0], -2. * v[0][2], 1e-3 * std::abs(v[0][2]));
    EXPECT_NEAR(v[0][1], -v[0][2], 1e-3 * std::abs(v[0][2]));
  }


  // It slides before it overturns if friction is below one half.
  TEST(RigidBlocks, Slide)
  {
    RigidBlocks blocks({block(1.)});
    add_floor(blocks, 0, 1., 0.3);
    EXPECT_TRUE(blocks.find_mechanism({{{0.299, -1., 0.}}}).empty());
    const auto v = blocks.find_mechanism({{{0.301, -1., 0.}}});
    ASSERT_EQ(v.size(), 1u);
    EXPECT_GT(v[0][0], 0.);
    EXPECT_NEAR(v[0][2], 0., 1e-3 * v[0][0]);
  }


  // Of two blocks side by side, a force on the first one has to overturn both: together they bear
  // twice the force if they are pushed at the same height without friction between them.
  TEST(RigidBlocks, OverturnTogether)
  {
    RigidBlocks blocks({block(1.), block(3.)});
    add_floor(blocks, 0, 1., 0.7);
    add_floor(blocks, 1, 3., 0.7);
    blocks.add_force(1, 0, {2., 2.}, Point<2>(1., 0.), 0., any);
    EXPECT_TRUE(
      blocks.find_mechanism({{{0.998, -1., 0.}}, {{0., -1., 0.}}}).empty());
    const auto v = blocks.find_mechanism({{{1.002, -1., 0.}}, {{0., -1., 0.}}});
    ASSERT_EQ(v.size(), 2u);
    EXPECT_LT(v[0][2], 0.);
    EXPECT_LT(v[1][2], 0.);
  }
} // namespace
