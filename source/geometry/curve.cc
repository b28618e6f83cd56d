#include "geometry/curve.h"

#include <nmm/base/exceptions.h>
#include <nmm/geometry/curve.h>

#include "geometry/kernel.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace
  {
    bool
    is_finite(const dealii::Point<2> &point)
    {
      return std::isfinite(point[0]) && std::isfinite(point[1]);
    }

    using internal::exact;

    void
    check_circle(const Curve &curve, const CurvePiece &piece)
    {
      AssertThrow(is_finite(piece.center) && std::isfinite(piece.radius),
                  InputError("centre or radius of a circle of " +
                               internal::describe(curve) +
                               " is not a finite number",
                             internal::describe_place(curve, piece.center),
                             "give finite numbers"));
      AssertThrow(piece.radius > 0.,
                  InputError("the radius of a circle of " +
                               internal::describe(curve) + " is " +
                               internal::describe_length(piece.radius),
                             internal::describe_place(curve, piece.center),
                             "give a positive radius"));
      // A radius below the spacing of doubles at the centre would make the
      // circle vanish when its points are rounded.
      AssertThrow(piece.center[0] + piece.radius > piece.center[0] &&
                    piece.center[1] + piece.radius > piece.center[1],
                  InputError("a circle of " + internal::describe(curve) +
                               " has a radius of " +
                               internal::describe_length(piece.radius) +
                               ", too small for its coordinates",
                             internal::describe_place(curve, piece.center),
                             "enlarge it or move the origin closer to it"));
      AssertThrow(curve.pieces.size() == 1,
                  InputError("a full circle is followed or preceded by other "
                             "pieces in " +
                               internal::describe(curve),
                             internal::describe_place(curve, piece.center),
                             "give the circle a curve of its own"));
    }

    void
    check_segment_or_arc(const Curve &curve, const CurvePiece &piece)
    {
      const bool is_arc = piece.kind == CurvePiece::Kind::arc;
      for (const dealii::Point<2> &point :
           {piece.start, is_arc ? piece.through : piece.start, piece.end})
        AssertThrow(is_finite(point),
                    InputError("a coordinate of " + internal::describe(curve) +
                                 " is not a finite number",
                               internal::describe_place(curve, point),
                               "give finite numbers"));
      if (!is_arc)
      {
        AssertThrow(piece.start != piece.end,
                    InputError("a segment of " + internal::describe(curve) +
                                 " has zero length",
                               internal::describe_place(curve, piece.start),
                               "remove the repeated point"));
        return;
      }
      AssertThrow(piece.start != piece.end && piece.start != piece.through &&
                    piece.through != piece.end,
                  InputError("two of the three points of an arc of " +
                               internal::describe(curve) + " coincide",
                             internal::describe_place(curve, piece.start),
                             "give three different points; write a full circle "
                             "as CIRCLE"));
      AssertThrow(!CGAL::collinear(exact(piece.start),
                                   exact(piece.through),
                                   exact(piece.end)) &&
                    is_finite(piece.center) && std::isfinite(piece.radius),
                  InputError("the three points of an arc of " +
                               internal::describe(curve) +
                               " lie on a straight line, and the middle one is "
                               "not between the others",
                             internal::describe_place(curve, piece.through),
                             "put it between them, or use a straight segment "
                             "instead"));
    }
  } // namespace


  bool
  is_nearly_straight(const dealii::Point<2> &start,
                     const dealii::Point<2> &end,
                     const double            radius)
  {
    // The sagitta is h^2 / (R + sqrt(R^2 - h^2)) for half a chord of h.
    const double h     = 0.5 * start.distance(end);
    const double ratio = h / radius;
    const double sagitta =
      h * (ratio / (1. + std::sqrt(std::max(0., 1. - ratio * ratio))));
    return sagitta <= 4. * std::numeric_limits<double>::epsilon() *
                        std::max({radius,
                                  std::abs(start[0]),
                                  std::abs(start[1]),
                                  std::abs(end[0]),
                                  std::abs(end[1])});
  }


  CurvePiece
  CurvePiece::segment(const dealii::Point<2> &start,
                      const dealii::Point<2> &end)
  {
    CurvePiece piece;
    piece.kind  = Kind::segment;
    piece.start = start;
    piece.end   = end;
    return piece;
  }


  CurvePiece
  CurvePiece::arc(const dealii::Point<2> &start,
                  const dealii::Point<2> &through,
                  const dealii::Point<2> &end)
  {
    CurvePiece piece;
    piece.kind    = Kind::arc;
    piece.start   = start;
    piece.through = through;
    piece.end     = end;
    // Curve::check() reports points without a circle; here they must only not crash.
    if (!is_finite(start) || !is_finite(through) || !is_finite(end))
      return piece;
    const auto straightened = [&]() {
      CurvePiece chord      = segment(start, end);
      chord.is_straightened = true;
      return chord;
    };
    if (CGAL::collinear(exact(start), exact(through), exact(end)))
    {
      const bool is_between =
        start != through && through != end &&
        CGAL::collinear_are_ordered_along_line(exact(start),
                                               exact(through),
                                               exact(end));
      if (is_between)
        return straightened();
    }
    else
    {
      const internal::Kernel::Point_2 center =
        CGAL::circumcenter(exact(start), exact(through), exact(end));
      using Coordinate = internal::BaseTraits::Point_2::CoordNT;
      piece.center     = {internal::to_double(Coordinate(center.x())),
                          internal::to_double(Coordinate(center.y()))};
      piece.radius     = std::sqrt(internal::to_double(
        Coordinate(CGAL::squared_distance(center, exact(start)))));
      // Seen from a point of a minor arc, its chord subtends an obtuse angle.
      if (CGAL::angle(exact(start), exact(through), exact(end)) ==
            CGAL::OBTUSE &&
          is_nearly_straight(start, end, piece.radius))
        return straightened();
    }
    return piece;
  }


  CurvePiece
  CurvePiece::circle(const dealii::Point<2> &center, const double radius)
  {
    CurvePiece piece;
    piece.kind   = Kind::circle;
    piece.center = center;
    piece.radius = radius;
    piece.start = piece.end = {center[0] + radius, center[1]};
    return piece;
  }


  const dealii::Point<2> &
  Curve::start() const
  {
    return pieces.front().start;
  }


  const dealii::Point<2> &
  Curve::end() const
  {
    return pieces.back().end;
  }


  bool
  Curve::is_closed() const
  {
    return start() == end();
  }


  void
  Curve::check() const
  {
    AssertThrow(!pieces.empty(),
                InputError(internal::describe(*this) + " has no piece",
                           source.empty() ? "its definition" : source,
                           "give it at least two points"));
    for (const CurvePiece &piece : pieces)
      if (piece.kind == CurvePiece::Kind::circle)
        check_circle(*this, piece);
      else
        check_segment_or_arc(*this, piece);
    for (unsigned int i = 1; i < pieces.size(); ++i)
      AssertThrow(pieces[i - 1].end == pieces[i].start,
                  InputError("piece " + std::to_string(i + 1) + " of " +
                               internal::describe(*this) + " starts " +
                               internal::describe_length(
                                 pieces[i - 1].end.distance(pieces[i].start)) +
                               " away from the end of the piece before it, " +
                               to_string(pieces[i - 1].end),
                             internal::describe_place(*this, pieces[i].start),
                             "let each piece start exactly where the last one "
                             "ended"));
  }


  std::string
  to_string(const CurveRole role)
  {
    switch (role)
    {
      case CurveRole::boundary:
        return "boundary";
      case CurveRole::hole:
        return "hole";
      case CurveRole::joint:
        return "joint";
      case CurveRole::interface:
        return "interface";
    }
    Assert(false, dealii::ExcInternalError());
    return "";
  }
} // namespace NMM
