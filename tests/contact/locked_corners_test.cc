// Corners that cannot slide without going into the ground.

#include <nmm/contact/diagnostics/locked_corners.h>

#include <contact/contact_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  const Tensor<1, 2> down({0., -9.81});


  std::vector<LockedCorner>
  locked_corners(Geometry geometry, const Tensor<1, 2> &gravity = down)
  {
    Bodies::Options options;
    options.cell_size = 3.;
    const Bodies bodies(std::move(geometry), options);
    return find_locked_corners(bodies.surface, gravity);
  }


  /// Level ground at y = 0 up to the toe at x = 0, and a slope. A joint rises by 4 in 6
  /// from @p lift above the toe, from a little before the slope.
  Geometry
  slope(const double lift)
  {
    Geometry geometry;
    geometry.add_polygon(
      {{-8., -6.}, {12., -6.}, {12., 6.}, {3., 6.}, {0., 0.}, {-8., 0.}},
      "rock");
    const double before = lift > 0. ? 0.3 * lift : 0.;
    geometry.add_polyline({{0.5 * lift - before, lift - before * 2. / 3.},
                           {0.5 * lift + 12., lift + 8.}},
                          "plane",
                          CurveRole::joint,
                          JointState::open);
    return geometry;
  }


  TEST(LockedCorners, PlaneThatEndsAtTheToe)
  {
    const auto corners = locked_corners(slope(0.));
    ASSERT_EQ(corners.size(), 1u);
    EXPECT_EQ(corners[0].place.norm(), 0.);
    EXPECT_EQ(corners[0].along, "plane");
    EXPECT_EQ(corners[0].ahead, "rock");
    // nothing slides uphill
    EXPECT_EQ(locked_corners(slope(0.), -down).size(), 0u);
  }


  TEST(LockedCorners, PlaneThatEndsAboveTheToe)
  {
    EXPECT_EQ(locked_corners(slope(0.2)).size(), 0u);
  }


  // What fills a corner rests in it, and steep walls stop what runs into them.
  TEST(LockedCorners, BlocksThatRestInCorners)
  {
    Geometry stairs;
    stairs.add_polygon(
      {{0., 0.}, {8., 0.}, {8., 4.}, {4., 4.}, {4., 2.}, {0., 2.}}, "stairs");
    stairs.add_polygon({{2., 2.}, {4., 2.}, {4., 3.}, {2., 3.}}, "brick");
    EXPECT_EQ(locked_corners(stairs).size(), 0u);

    Geometry wall;
    add_box(wall, {0., 0.}, {6., 4.});
    for (const double y : {1., 2., 3.})
      wall.add_polyline({{-1., y}, {7., y}},
                        "bed",
                        CurveRole::joint,
                        JointState::open);
    wall.add_polyline({{2., 1.}, {2., 2.}},
                      "head",
                      CurveRole::joint,
                      JointState::open);
    EXPECT_EQ(locked_corners(wall).size(), 0u);
  }


  // The passive wedge fills the other side of the active wedge's corner, but it moves away.
  TEST(LockedCorners, WedgeBesideAnother)
  {
    Geometry wedges;
    wedges.add_polygon({{0., 0.}, {5., 6.}, {0., 6.}}, "active");
    wedges.add_polygon({{0., 0.}, {0., 6.}, {-10., -2.5}}, "passive");
    wedges.add_polygon(
      {{-10., -8.}, {5., -8.}, {5., 6.}, {0., 0.}, {-10., -2.5}}, "base");
    const auto corners = locked_corners(wedges);
    ASSERT_EQ(corners.size(), 1u);
    EXPECT_EQ(corners[0].place.norm(), 0.);
    EXPECT_EQ(corners[0].ahead, "base");
    EXPECT_NE(corners[0].ahead_edge, invalid_index);
  }


  // Where joints cross at an angle of less than 60 degrees, each block slides along the two beyond.
  TEST(LockedCorners, JointsThatCross)
  {
    Geometry mass;
    add_box(mass, {-6., -6.}, {6., 6.});
    for (const double rise : {3., -3.})
      mass.add_polyline({{-7., -7. / 6. * rise}, {7., 7. / 6. * rise}},
                        "joint",
                        CurveRole::joint,
                        JointState::open);
    EXPECT_EQ(locked_corners(mass).size(), 0u);
  }
} // namespace
