#include "geometry/arrangement.h"

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
    const auto *point = boost::get<Kernel::Point_2>(&*crossing);
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
