#include "geometry/piece_geometry.h"

#include "geometry/arrangement.h"
#include "geometry/curve.h"
#include <algorithm>
#include <base/cross.h>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Point  = dealii::Point<2>;
      using Vector = dealii::Tensor<1, 2>;

      /// Twice the signed area of the triangle.
      double
      turn(const Point &a, const Point &b, const Point &c)
      {
        return cross(b - a, c - a);
      }

      bool
      is_segment(const CurvePiece &piece)
      {
        return piece.kind == CurvePiece::Kind::segment;
      }

      /// Whether a point of the piece's circle is on the piece, that is, on the arc's side of the
      /// chord.
      bool
      is_on_arc(const CurvePiece &piece, const Point &point)
      {
        return piece.kind == CurvePiece::Kind::circle ||
               turn(piece.start, piece.end, point) *
                   turn(piece.start, piece.end, piece.through) >=
                 0.;
      }

      bool
      is_counterclockwise(const CurvePiece &arc)
      {
        return turn(arc.start, arc.through, arc.end) > 0.;
      }

      /// The middle of an arc of the given circle. It is computed from the chord, because the
      /// centre of a flat arc may be very far away.
      Point
      middle_of_arc(const Point &start,
                    const Point &end,
                    const Point &center,
                    const double radius,
                    const bool   counterclockwise)
      {
        const Vector chord = end - start;
        const double half  = 0.5 * chord.norm();
        const double height =
          std::sqrt(std::max(0., (radius - half) * (radius + half)));
        // A counter-clockwise arc lies to the right of its chord. It is longer than a half circle
        // if the centre is on the right, too.
        const double side     = counterclockwise ? 1. : -1.;
        const bool   is_minor = side * turn(start, end, center) > 0.;
        const double sagitta =
          is_minor ? half * half / (radius + height) : radius + height;
        const Vector right({chord[1], -chord[0]});
        return start + 0.5 * chord + (side * sagitta / (2. * half)) * right;
      }

      /// Parameters t with |a + t d - center| = radius.
      std::vector<double>
      line_meets_circle(const Point  &a,
                        const Vector &d,
                        const Point  &center,
                        const double  radius)
      {
        const double d2           = d * d;
        const double foot         = ((center - a) * d) / d2;
        const double offset       = cross(a - center, d) / std::sqrt(d2);
        const double discriminant = (radius - offset) * (radius + offset);
        if (discriminant < 0.)
          return {};
        const double half = std::sqrt(discriminant / d2);
        return {foot - half, foot + half};
      }

      std::vector<Point>
      circle_meets_circle(const CurvePiece &a, const CurvePiece &b)
      {
        const Vector d        = b.center - a.center;
        const double distance = d.norm();
        if (distance == 0.)
          return {};
        const double along =
          0.5 *
          (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance);
        const double square = (a.radius - along) * (a.radius + along);
        if (square < 0.)
          return {};
        const Vector unit = d / distance;
        const Vector normal({-unit[1], unit[0]});
        const double across = std::sqrt(square);
        return {a.center + along * unit + across * normal,
                a.center + along * unit - across * normal};
      }

      /// Points of @p other on the line a + t d with t in [t_min, t_max].
      std::vector<Point>
      line_meets(const Point      &a,
                 const Vector     &d,
                 const double      t_min,
                 const double      t_max,
                 const CurvePiece &other)
      {
        std::vector<Point> points;
        if (is_segment(other))
        {
          const Vector e           = other.end - other.start;
          const double determinant = cross(d, e);
          if (determinant == 0.)
            return {};
          const double t = cross(other.start - a, e) / determinant;
          const double s = cross(other.start - a, d) / determinant;
          if (s >= 0. && s <= 1. && t >= t_min && t <= t_max)
            points.push_back(other.start + s * e);
          return points;
        }
        for (const double t :
             line_meets_circle(a, d, other.center, other.radius))
          if (t >= t_min && t <= t_max && is_on_arc(other, a + t * d))
            points.push_back(a + t * d);
        return points;
      }
    } // namespace


    std::array<Point, 2>
    corners_around(const CurvePiece &piece)
    {
      std::array<Point, 2> corners = {{piece.start, piece.start}};
      const auto           include = [&](const Point &point) {
        for (unsigned int d = 0; d < 2; ++d)
        {
          corners[0][d] = std::min(corners[0][d], point[d]);
          corners[1][d] = std::max(corners[1][d], point[d]);
        }
      };
      include(piece.end);
      if (!is_segment(piece))
        for (unsigned int d = 0; d < 2; ++d)
          for (const double sign : {-1., 1.})
          {
            Point extreme = piece.center;
            extreme[d] += sign * piece.radius;
            if (is_on_arc(piece, extreme))
              include(extreme);
          }
      return corners;
    }


    double
    length(const CurvePiece &piece)
    {
      if (is_segment(piece))
        return piece.start.distance(piece.end);
      if (piece.kind == CurvePiece::Kind::circle)
        return 2. * dealii::numbers::PI * piece.radius;
      const Point  middle   = piece.start + 0.5 * (piece.end - piece.start);
      const double half     = std::atan2(0.5 * piece.start.distance(piece.end),
                                     middle.distance(piece.center));
      const bool   is_minor = turn(piece.start, piece.end, piece.through) *
                              turn(piece.start, piece.end, piece.center) <
                            0.;
      return 2. * piece.radius * (is_minor ? half : dealii::numbers::PI - half);
    }


    Point
    nearest_point(const CurvePiece &piece, const Point &point)
    {
      if (is_segment(piece))
      {
        const Vector d = piece.end - piece.start;
        const double t =
          std::clamp(((point - piece.start) * d) / (d * d), 0., 1.);
        return t == 1. ? piece.end : piece.start + t * d;
      }
      const double distance = point.distance(piece.center);
      if (distance > 0.)
      {
        // Move along the radius by a difference, which is accurate for near points.
        const Point foot = point + ((piece.radius - distance) / distance) *
                                     (point - piece.center);
        if (is_on_arc(piece, foot))
          return foot;
      }
      return point.distance(piece.start) <= point.distance(piece.end)
               ? piece.start
               : piece.end;
    }


    std::vector<Point>
    crossings(const CurvePiece &a, const CurvePiece &b)
    {
      if (is_segment(a))
        return line_meets(a.start, a.end - a.start, 0., 1., b);
      if (is_segment(b))
        return crossings(b, a);
      std::vector<Point> points;
      for (const Point &point : circle_meets_circle(a, b))
        if (is_on_arc(a, point) && is_on_arc(b, point))
          points.push_back(point);
      return points;
    }


    Point
    continuation(const CurvePiece &piece,
                 const bool        at_start,
                 const CurvePiece &other,
                 const double      reach)
    {
      const Point &end = at_start ? piece.start : piece.end;
      Vector       direction;
      if (is_segment(piece))
        direction =
          at_start ? piece.start - piece.end : piece.end - piece.start;
      else
      {
        const Vector radius = end - piece.center;
        direction           = Vector({-radius[1], radius[0]});
        if (is_counterclockwise(piece) == at_start)
          direction *= -1.;
      }
      direction *= 1. / direction.norm();

      Point best = end;
      for (const Point &point : line_meets(end, direction, 0., reach, other))
        if (best == end || end.distance(point) < end.distance(best))
          best = point;
      return best;
    }


    bool
    lies_exactly_on(const CurvePiece &piece, const Point &point)
    {
      const Kernel::Point_2 p = exact(point);
      if (piece.kind == CurvePiece::Kind::circle)
        return CGAL::squared_distance(exact(piece.center), p) ==
               CGAL::square(Kernel::FT(piece.radius));
      const Kernel::Point_2 start = exact(piece.start);
      const Kernel::Point_2 end   = exact(piece.end);
      if (is_segment(piece))
        return Kernel::Segment_2(start, end).has_on(p);
      const Kernel::Point_2 through = exact(piece.through);
      return CGAL::side_of_bounded_circle(start, through, end, p) ==
               CGAL::ON_BOUNDARY &&
             (p == start || p == end ||
              CGAL::orientation(start, end, p) ==
                CGAL::orientation(start, end, through));
    }


    std::pair<CurvePiece, CurvePiece>
    split(const CurvePiece &piece, const Point &point)
    {
      if (is_segment(piece))
        return {CurvePiece::segment(piece.start, point),
                CurvePiece::segment(point, piece.end)};

      const bool  is_circle  = piece.kind == CurvePiece::Kind::circle;
      const bool  turns_left = is_circle || is_counterclockwise(piece);
      const Point opposite   = piece.center + (piece.center - point);
      const Point a          = is_circle ? point : piece.start;
      const Point b          = is_circle ? opposite : point;
      const Point c          = is_circle ? point : piece.end;
      const auto  arc        = [&](const Point &from, const Point &to) {
        return CurvePiece::arc(
          from,
          middle_of_arc(from, to, piece.center, piece.radius, turns_left),
          to);
      };
      return {arc(a, b), arc(b, c)};
    }


    CurvePiece
    with_moved_end(const CurvePiece &piece,
                   const bool        at_start,
                   const Point      &point)
    {
      const Point &start = at_start ? point : piece.start;
      const Point &end   = at_start ? piece.end : point;
      if (is_segment(piece))
        return CurvePiece::segment(start, end);
      // The given point of the arc may lie beyond a trimmed end; use the middle of the arc instead.
      return CurvePiece::arc(start,
                             middle_of_arc(start,
                                           end,
                                           piece.center,
                                           piece.radius,
                                           is_counterclockwise(piece)),
                             end);
    }


    bool
    is_valid(const CurvePiece &piece)
    {
      Curve curve;
      curve.pieces = {piece};
      try
      {
        curve.check();
      }
      catch (const InputError &)
      {
        return false;
      }
      return true;
    }
  } // namespace internal
} // namespace NMM
