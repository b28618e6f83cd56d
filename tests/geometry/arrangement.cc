#include "geometry/arrangement.h"

#include <nmm/geometry/physical_mesh.h>

#include "geometry/cgal_compat.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace NMM::internal;
using Coordinate = BaseTraits::Point_2::CoordNT;

namespace
{
  // What to_double() promises.
  constexpr double tolerance = 8. * std::numeric_limits<double>::epsilon();
} // namespace


// Rounding in the presence of cancellation: 1 - sqrt(1 - h^2), where the line
// y = h meets the unit circle about (1, 0), is h^2/(1 + sqrt(1 - h^2)), which is
// right to 1.5 epsilon in doubles.
TEST(ToDouble, cancelling_roots)
{
  for (int k = 2; k < 100; ++k)
  {
    const double     h = std::ldexp(1., -k);
    const Coordinate x(Kernel::FT(1),
                       Kernel::FT(-1),
                       Kernel::FT(1) - Kernel::FT(h) * Kernel::FT(h));
    const double     exact = h * h / (1. + std::sqrt(1. - h * h));
    EXPECT_NEAR(to_double(x), exact, 1.5 * tolerance * exact) << "h = " << h;
    const Coordinate minus_x(Kernel::FT(-1), Kernel::FT(1), x.root());
    EXPECT_EQ(to_double(minus_x), -to_double(x));
  }
}


// Crossings of nearly parallel lines are rationals that lazy intervals know
// only roughly.
TEST(ToDouble, nearly_parallel_lines)
{
  for (int k = 2; k < 60; ++k)
  {
    // y = 0 and the line through (0, -h) and (1, 2 h): x = 1/3
    const double         h = std::ldexp(1., -k);
    const Kernel::Line_2 a(Kernel::Point_2(0, 0), Kernel::Point_2(1, 0));
    const Kernel::Line_2 b(Kernel::Point_2(0, -h), Kernel::Point_2(1, 2 * h));
    const auto           crossing = CGAL::intersection(a, b);
    ASSERT_TRUE(crossing);
    const auto *point = get_if<Kernel::Point_2>(*crossing);
    ASSERT_NE(point, nullptr);
    EXPECT_NEAR(to_double(Coordinate(point->x())), 1. / 3., tolerance / 3.);
  }
}


TEST(ToDouble, special_values)
{
  const Kernel::FT two(2);
  EXPECT_EQ(to_double(Coordinate(Kernel::FT(0.1))), 0.1);
  // 2 - sqrt(4) and 0 + 0 sqrt(2) are zero
  EXPECT_EQ(to_double(Coordinate(two, Kernel::FT(-1), Kernel::FT(4))), 0.);
  EXPECT_EQ(to_double(Coordinate(Kernel::FT(0), Kernel::FT(0), two)), 0.);
  EXPECT_NEAR(to_double(Coordinate(Kernel::FT(0), Kernel::FT(-1), two)),
              -std::sqrt(2.),
              tolerance);
  EXPECT_NEAR(to_double(Coordinate(two, Kernel::FT(-1), Kernel::FT(0))),
              2.,
              0.);
}


TEST(ExactCurve, passes_through_the_given_points)
{
  // Three doubles lie exactly on their circle, so a chain of arcs meets
  // exactly, and a circle has its rational extremes.
  const NMM::CurvePiece arc =
    NMM::CurvePiece::arc({0.1, 0.2}, {0.3, 0.7}, {1.1, 0.4});
  const auto curve = exact_curve(arc);
  EXPECT_EQ(curve.source(),
            BaseTraits::Point_2(Kernel::FT(0.1), Kernel::FT(0.2)));
  EXPECT_EQ(curve.target(),
            BaseTraits::Point_2(Kernel::FT(1.1), Kernel::FT(0.4)));
  EXPECT_EQ(curve.orientation(), CGAL::CLOCKWISE);
  EXPECT_EQ(CGAL::squared_distance(curve.supporting_circle().center(),
                                   Kernel::Point_2(0.3, 0.7)),
            curve.supporting_circle().squared_radius());

  const auto circle = exact_curve(NMM::CurvePiece::circle({0.1, 0.2}, 0.3));
  EXPECT_TRUE(circle.is_full());
  EXPECT_EQ(circle.supporting_circle().squared_radius(),
            Kernel::FT(0.3) * Kernel::FT(0.3));
}


// What joints that are dropped, and borders of regions, leave behind: nothing. A
// corner in the middle of a face would be one more edge of contact.
TEST(Trimming, leaves_no_corners)
{
  const auto count = [](NMM::Geometry geometry) {
    const NMM::PhysicalMesh mesh(std::move(geometry));
    const Arrangement      &arrangement = mesh.arrangement().arrangement;
    return std::make_pair(arrangement.number_of_vertices(),
                          arrangement.number_of_edges());
  };
  NMM::Geometry plain;
  plain.add_polygon({{0., 0.}, {4., 0.}, {4., 4.}, {0., 4.}}, "square");
  plain.add_polyline({{0., 2.}, {4., 2.}}, "through", NMM::CurveRole::joint);
  const auto expected = count(plain);
  EXPECT_EQ(expected, std::make_pair(std::size_t(6), std::size_t(7)));

  NMM::Geometry stub = plain;
  stub.add_polyline({{1., 2.}, {1., 3.}}, "stub", NMM::CurveRole::joint);
  EXPECT_EQ(count(stub), std::make_pair(std::size_t(8), std::size_t(9)));
  stub.curves().back().drops_ends = true;
  EXPECT_EQ(count(stub), expected);

  // a joint above the region's border ends there, one below is gone
  NMM::Geometry confined = plain;
  NMM::Curve    region;
  region.name = "top";
  for (const auto &[a, b] :
       {std::make_pair(dealii::Point<2>(-1., 3.), dealii::Point<2>(5., 3.)),
        std::make_pair(dealii::Point<2>(5., 3.), dealii::Point<2>(2., 9.)),
        std::make_pair(dealii::Point<2>(2., 9.), dealii::Point<2>(-1., 3.))})
    region.pieces.push_back(NMM::CurvePiece::segment(a, b));
  confined.add_region(region);
  confined.add_polyline({{1., 0.}, {1., 1.}}, "gone", NMM::CurveRole::joint);
  confined.curves().back().within     = "top";
  confined.curves().back().is_clipped = true;
  EXPECT_EQ(count(confined), expected);
  confined.add_polyline({{2., 0.}, {2., 3.5}}, "end", NMM::CurveRole::joint);
  confined.curves().back().within = "top";
  // a crack from y = 3 to 3.5
  EXPECT_EQ(count(confined), std::make_pair(std::size_t(8), std::size_t(8)));
}
