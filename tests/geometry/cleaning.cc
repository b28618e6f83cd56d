#include "geometry/test_helpers.h"
#include <chrono>
#include <cmath>
#include <random>

using namespace geometry_test;
using Kind = NMM::CleaningAction::Kind;

namespace
{
  struct Cleaned
  {
    NMM::Geometry                    geometry;
    std::vector<NMM::CleaningAction> actions;

    unsigned int
    n_blocks() const
    {
      return NMM::PhysicalMesh(geometry).n_blocks();
    }
  };


  Cleaned
  clean(const std::string &text, const double tolerance)
  {
    Cleaned cleaned;
    cleaned.geometry = NMM::parse_geometry(text, "test.wkt");
    cleaned.actions  = NMM::clean(cleaned.geometry, tolerance);
    return cleaned;
  }
} // namespace


TEST(Cleaning, off_for_zero_tolerance)
{
  const std::string text =
    unit_square + "joint LINESTRING (0.001 0.5, 1.001 0.5, 1.002 0.5)";
  const auto before  = NMM::parse_geometry(text, "");
  const auto cleaned = clean(text, 0.);
  EXPECT_TRUE(cleaned.actions.empty());
  EXPECT_EQ(cleaned.geometry.curves()[1].start(), before.curves()[1].start());
  EXPECT_EQ(cleaned.geometry.curves()[1].pieces.size(), 2u);
  expect_parts(error_of([&]() { clean(text, -1.); }), {"-1 m", "not negative"});
  expect_parts(error_of([&]() { clean(text, NAN); }), {"tolerance"});
}


TEST(Cleaning, closes_a_boundary)
{
  const std::string text =
    "boundary name=a LINESTRING (0 0, 1 0, 1 1)\n"
    "boundary name=b LINESTRING (1.001 1, 0 1, 0 0.002)";
  const auto cleaned = clean(text, 0.01);
  ASSERT_EQ(cleaned.actions.size(), 2u);
  EXPECT_EQ(cleaned.actions[0].kind, Kind::snapped_to_vertex);
  EXPECT_EQ(cleaned.actions[0].curve, "a");
  EXPECT_NEAR(cleaned.actions[0].distance, 0.002, 1e-15);
  expect_parts(cleaned.actions[0].description(),
               {"'a'", "(0, 0)", "(0, 0.002)", "0.002 m"});
  EXPECT_EQ(cleaned.n_blocks(), 1u);
  // beyond the tolerance it stays open
  EXPECT_FALSE(error_of([&]() { clean(text, 0.0015).n_blocks(); }).empty());
  // a curve's own gap
  EXPECT_EQ(
    clean("boundary LINESTRING (0 0, 1 0, 1 1, 0 0.001)", 0.01).n_blocks(), 1u);
  EXPECT_EQ(clean("boundary CIRCULARSTRING (0 0, 1 1, 2 0, 1 -1, 0.001 0)",
                  0.01)
              .n_blocks(),
            1u);
}


TEST(Cleaning, short_ends_and_overshoots_at_segments)
{
  // A slanted target, on which no rounded point lies exactly
  const std::string text =
    unit_square + "joint name=target LINESTRING (0 0.1, 1 0.4)\n";
  const auto extended =
    clean(text + "joint name=j LINESTRING (0.3 0.195, 0.3 1)", 0.01);
  ASSERT_EQ(extended.actions.size(), 1u);
  EXPECT_EQ(extended.actions[0].kind, Kind::extended_to_curve);
  EXPECT_NEAR(extended.actions[0].to[1], 0.19, 1e-15);
  EXPECT_NEAR(extended.actions[0].to[0], 0.3, 1e-15);
  EXPECT_EQ(extended.n_blocks(), 3u);
  EXPECT_EQ(extended.geometry.curves()[1].pieces.size(), 2u);

  const auto trimmed =
    clean(text + "joint name=j LINESTRING (0.3 1.002, 0.3 0.185)", 0.01);
  ASSERT_EQ(trimmed.actions.size(), 2u);
  EXPECT_EQ(trimmed.actions[0].kind, Kind::trimmed_overshoot);
  EXPECT_NEAR(trimmed.actions[0].distance, 0.002, 1e-15);
  EXPECT_EQ(trimmed.actions[1].kind, Kind::trimmed_overshoot);
  EXPECT_NEAR(trimmed.actions[1].distance, 0.005, 1e-15);
  EXPECT_EQ(trimmed.n_blocks(), 3u);
  EXPECT_TRUE(NMM::PhysicalMesh(trimmed.geometry).notices().empty());

  // Longer ones stay
  EXPECT_TRUE(clean(text + "joint LINESTRING (0.3 0.21, 0.3 1.02)", 0.01)
                .actions.empty());
  // Two ends at the same piece, from both sides
  const auto both = clean(text +
                            "joint LINESTRING (0.3 0.195, 0.3 1)\n"
                            "joint LINESTRING (0.7 0.3, 0.7 0)\n",
                          0.02);
  EXPECT_EQ(both.n_blocks(), 4u);
  EXPECT_EQ(both.geometry.curves()[1].pieces.size(), 3u);
}


TEST(Cleaning, short_ends_and_overshoots_at_arcs)
{
  for (const std::string target :
       {"hole name=t CIRCLE (0.5 0.5, 0.3)",
        "joint name=t CIRCULARSTRING (0.2 0.5, 0.5 0.8, 0.8 0.5, 0.5 0.2, 0.2 "
        "0.5)"})
    for (const double start : {0.805, 0.795})
    {
      SCOPED_TRACE(target + " " + std::to_string(start));
      const std::string joint =
        "joint name=j LINESTRING (0.6 " + std::to_string(start) + ", 0.6 1)\n";
      const auto cleaned = clean(unit_square + target + "\n" + joint +
                                   "joint LINESTRING (0.5 0, 0.5 0.199)",
                                 0.05);
      ASSERT_EQ(cleaned.actions.size(), 2u);
      // on the circle to round-off
      for (const auto &action : cleaned.actions)
        EXPECT_NEAR(action.to.distance(Point(0.5, 0.5)), 0.3, 1e-15);
      const NMM::PhysicalMesh mesh(cleaned.geometry);
      const bool              is_hole = target[0] == 'h';
      EXPECT_EQ(mesh.n_blocks(), is_hole ? 2u : 3u);
      // Splitting keeps the circle to round-off.
      EXPECT_NEAR(total_area(mesh),
                  is_hole ? 1. - dealii::numbers::PI * 0.09 : 1.,
                  1e-14);
    }
}


TEST(Cleaning, arcs_end_at_curves)
{
  // An arc whose end overshoots the lower side
  const auto trimmed =
    clean(unit_square +
            "joint name=j CIRCULARSTRING (0.2 -0.001, 0.5 0.3, 0.8 0)",
          0.01);
  ASSERT_EQ(trimmed.actions.size(), 1u);
  EXPECT_EQ(trimmed.actions[0].kind, Kind::trimmed_overshoot);
  EXPECT_EQ(trimmed.n_blocks(), 2u);
  // and one that is short of it
  const auto extended =
    clean(unit_square +
            "joint name=j CIRCULARSTRING (0.2 0.001, 0.5 0.3, 0.8 0)",
          0.01);
  ASSERT_EQ(extended.actions.size(), 1u);
  EXPECT_EQ(extended.actions[0].kind, Kind::extended_to_curve);
  EXPECT_EQ(extended.n_blocks(), 2u);
}


TEST(Cleaning, ends_near_vertices)
{
  // three joints that should meet in a point, one end just beside a corner
  const auto cleaned =
    clean(unit_square +
            "joint name=a LINESTRING (0.001 0.001, 0.5 0.5)\n"
            "joint name=b LINESTRING (0.5 0.501, 1 1)\n"
            "joint name=c LINESTRING (0.501 0.5, 1 0)",
          0.01);
  EXPECT_EQ(cleaned.actions.size(), 3u);
  for (const auto &action : cleaned.actions)
    EXPECT_EQ(action.kind, Kind::snapped_to_vertex);
  EXPECT_EQ(cleaned.n_blocks(), 3u);
  // Ends that are exact already stay, even with a vertex nearby.
  EXPECT_TRUE(clean(unit_square + "joint LINESTRING (0.001 0, 0.5 1)", 0.01)
                .actions.empty());
}


TEST(Cleaning, short_pieces)
{
  const auto cleaned =
    clean(unit_square +
            "joint name=a LINESTRING (0 0.5, 0.5 0.5, 0.501 0.5, 1 0.5)\n"
            "joint name=b LINESTRING (0.2 0.2, 0.201 0.2)\n"
            "joint name=c LINESTRING (0 0.7, 0.999 0.7, 1 0.7)",
          0.01);
  ASSERT_EQ(cleaned.actions.size(), 3u);
  for (const auto &action : cleaned.actions)
  {
    EXPECT_EQ(action.kind, Kind::removed_piece);
    EXPECT_NEAR(action.distance, 0.001, 1e-15);
  }
  ASSERT_EQ(cleaned.geometry.curves().size(), 3u);
  EXPECT_EQ(cleaned.geometry.curves()[1].pieces.size(), 2u);
  EXPECT_EQ(cleaned.geometry.curves()[2].end(), Point(1., 0.7));
  EXPECT_EQ(cleaned.n_blocks(), 3u);
}


// A brick wall whose ends all miss by a random distance: cleaning restores
// every brick.
TEST(Cleaning, disturbed_wall)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> error(-1e-4, 1e-4);
    const auto                             point = [&](double x, double y) {
      return Point(x + error(generator), y + error(generator));
    };
    NMM::Geometry geometry;
    geometry.add_polygon(
      {Point(0., 0.), Point(10., 0.), Point(10., 10.), Point(0., 10.)}, "b");
    for (unsigned int row = 0; row < 10; ++row)
    {
      if (row > 0)
        geometry.add_polyline({point(0., row), point(10., row)},
                              "bed" + std::to_string(row),
                              NMM::CurveRole::joint);
      for (unsigned int column = 0; column < 9; ++column)
      {
        const double x = column + (row % 2 == 0 ? 1. : 0.5);
        geometry.add_polyline({point(x, row), point(x, row + 1)},
                              "head" + std::to_string(row) + "-" +
                                std::to_string(column),
                              NMM::CurveRole::joint);
      }
    }
    const auto actions = NMM::clean(geometry, 1e-3);
    for (const auto &action : actions)
      EXPECT_LE(action.distance, 1e-3);
    const NMM::PhysicalMesh mesh(geometry);
    EXPECT_EQ(mesh.n_blocks(), 100u);
    EXPECT_TRUE(mesh.notices().empty());
    EXPECT_NEAR(total_area(mesh), 100., 1e-11);
    // Clean geometry stays as it is.
    EXPECT_TRUE(NMM::clean(geometry, 1e-3).empty());
  }
}
