#include "geometry/arrangement.h"

#include <limits>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using FT       = Kernel::FT;
      using Interval = CGAL::Interval_nt<true>;

      Interval
      to_interval(const FT &number)
      {
        return Interval(CGAL::to_interval(number));
      }

      // Interval of a lazy number after its exact evaluation; it is at most one ulp wide.
      Interval
      to_tight_interval(const FT &number)
      {
        CGAL::exact(number);
        return to_interval(number);
      }

      // Whether the interval is at most 16 epsilon wide, so that its middle is off by at most 8
      // epsilon. A smaller bound would evaluate most numbers exactly, at three times the cost.
      bool
      is_tight(const Interval &interval)
      {
        const double magnitude =
          std::min(std::abs(interval.inf()), std::abs(interval.sup()));
        return interval.is_point() ||
               (interval.inf() * interval.sup() > 0. &&
                interval.sup() - interval.inf() <=
                  16. * std::numeric_limits<double>::epsilon() * magnitude);
      }

      double
      middle(const Interval &interval)
      {
        return interval.inf() + 0.5 * (interval.sup() - interval.inf());
      }

      double
      to_double(const FT &number)
      {
        const Interval interval = to_interval(number);
        return middle(is_tight(interval) ? interval
                                         : to_tight_interval(number));
      }
    } // namespace


    BaseTraits::Curve_2
    exact_curve(const CurvePiece &piece)
    {
      switch (piece.kind)
      {
        case CurvePiece::Kind::segment:
          return {exact(piece.start), exact(piece.end)};
        case CurvePiece::Kind::arc:
          return {exact(piece.start), exact(piece.through), exact(piece.end)};
        case CurvePiece::Kind::circle:
          // With the radius and not its square, the two points where CGAL divides the circle have
          // rational coordinates.
          return {exact(piece.center),
                  FT(piece.radius),
                  CGAL::COUNTERCLOCKWISE};
      }
      Assert(false, dealii::ExcInternalError());
      return {};
    }


    double
    to_double(const BaseTraits::Point_2::CoordNT &coordinate)
    {
      if (!coordinate.is_extended())
        return to_double(coordinate.a0());

      const FT &a = coordinate.a0();
      const FT &b = coordinate.a1();
      const FT &c = coordinate.root();

      const Interval quick =
        to_interval(a) + to_interval(b) * sqrt(to_interval(c));
      if (is_tight(quick))
        return middle(quick);

      // Where a and b sqrt(c) nearly cancel,
      // a + b sqrt(c) = (a^2 - b^2 c) / (a - b sqrt(c))
      // has an exact numerator and no cancellation in the denominator.
      const Interval tight_a = to_tight_interval(a);
      const Interval tight_r =
        to_tight_interval(b) * sqrt(to_tight_interval(c));
      if (CGAL::sign(a) * CGAL::sign(b) >= 0)
        return middle(tight_a + tight_r);
      const FT numerator = a * a - b * b * c;
      if (CGAL::is_zero(numerator))
        return 0.;
      return middle(to_tight_interval(numerator) / (tight_a - tight_r));
    }


    dealii::Point<2>
    to_double(const BaseTraits::Point_2 &point)
    {
      return {to_double(point.x()), to_double(point.y())};
    }
  } // namespace internal
} // namespace NMM
