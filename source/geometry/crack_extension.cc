#include <nmm/base/exceptions.h>
#include <nmm/geometry/crack_extension.h>

#include "geometry/curve.h"
#include "geometry/piece_geometry.h"
#include <limits>

namespace NMM
{
  namespace
  {
    /// A point on a piece of a curve.
    struct Meeting
    {
      double           distance = std::numeric_limits<double>::max();
      unsigned int     curve = 0, piece = 0;
      dealii::Point<2> point;
    };


    /// Points that a ray and a piece have in common. A point within @p near [m] of an end of the
    /// piece is moved to that end, so that no short pieces arise. Ends within @p near of the ray
    /// are common points, too, also those of pieces along the ray.
    std::vector<dealii::Point<2>>
    shared_points(const CurvePiece &ray,
                  const CurvePiece &piece,
                  const double      near)
    {
      std::vector<dealii::Point<2>> points = internal::crossings(ray, piece);
      if (piece.kind == CurvePiece::Kind::circle)
        return points;
      const double               reach = ray.start.distance(ray.end);
      const dealii::Tensor<1, 2> along = (ray.end - ray.start) / reach;
      for (const dealii::Point<2> &end : {piece.start, piece.end})
      {
        for (dealii::Point<2> &x : points)
          if (x.distance(end) < near)
            x = end;
        const double               t   = (end - ray.start) * along;
        const dealii::Tensor<1, 2> off = end - ray.start - t * along;
        if (t < reach && off.norm() < near)
          points.push_back(end);
      }
      return points;
    }


    /// First point at which @p ray meets a curve, at least @p least [m] from its start.
    Meeting
    find_meeting(const std::vector<Curve> &curves,
                 const CurvePiece         &ray,
                 const double              least,
                 const double              near)
    {
      const dealii::Tensor<1, 2> forward = ray.end - ray.start;
      Meeting                    nearest;
      for (unsigned int c = 0; c < curves.size(); ++c)
        for (unsigned int p = 0; p < curves[c].pieces.size(); ++p)
          for (const dealii::Point<2> &x :
               shared_points(ray, curves[c].pieces[p], near))
          {
            const double distance = x.distance(ray.start);
            if (distance > least && distance < nearest.distance &&
                (x - ray.start) * forward > 0.)
              nearest = {distance, c, p, x};
          }
      return nearest;
    }


    /// Divides a piece of @p curve at @p point, unless this is an end of the piece.
    void
    divide_at(Curve                  &curve,
              const unsigned int      piece,
              const dealii::Point<2> &point)
    {
      const CurvePiece whole = curve.pieces[piece];
      if (whole.kind != CurvePiece::Kind::circle &&
          (point == whole.start || point == whole.end))
        return;
      const auto [first, second] = internal::split(whole, point);
      curve.pieces[piece]        = second;
      curve.pieces.insert(curve.pieces.begin() + piece, first);
    }


    /// Lengths below this part of an increment are not made [-].
    constexpr double near = 1e-3;
  } // namespace


  CrackExtension
  extend_crack(Geometry                   &geometry,
               const dealii::Point<2>     &tip,
               const dealii::Tensor<1, 2> &direction,
               const double                length,
               const std::string          &name)
  {
    constexpr double    look_ahead = 1.5, nearly_none = 1e-6;
    std::vector<Curve> &curves = geometry.curves();
    const Meeting       meeting =
      find_meeting(curves,
                   CurvePiece::segment(tip,
                                       tip + look_ahead * length * direction),
                   nearly_none * length,
                   near * length);

    CrackExtension result;
    if (meeting.distance < std::numeric_limits<double>::max())
    {
      Curve &other = curves[meeting.curve];
      result.met   = internal::describe(other);
      result.end   = meeting.point;
      divide_at(other, meeting.piece, meeting.point);
    }
    else
      result.end = tip + length * direction;

    Curve extension;
    extension.name   = name;
    extension.role   = CurveRole::joint;
    extension.pieces = {CurvePiece::segment(tip, result.end)};
    geometry.add(std::move(extension));
    return result;
  }


  CrackExtension
  start_crack(Geometry                   &geometry,
              const dealii::Point<2>     &point,
              const dealii::Tensor<1, 2> &direction,
              const double                length,
              const std::string          &name)
  {
    Meeting nearest;
    for (unsigned int c = 0; c < geometry.curves().size(); ++c)
    {
      const Curve &curve = geometry.curves()[c];
      if (curve.role != CurveRole::boundary && curve.role != CurveRole::hole)
        continue;
      for (unsigned int p = 0; p < curve.pieces.size(); ++p)
      {
        const dealii::Point<2> x =
          internal::nearest_point(curve.pieces[p], point);
        if (x.distance(point) < nearest.distance)
          nearest = {x.distance(point), c, p, x};
      }
    }
    AssertThrow(nearest.distance < std::numeric_limits<double>::max(),
                InputError("no boundary is there for a crack to start at",
                           to_string(point),
                           "draw a boundary"));
    Curve           &curve = geometry.curves()[nearest.curve];
    const CurvePiece piece = curve.pieces[nearest.piece];
    if (piece.kind != CurvePiece::Kind::circle)
      for (const dealii::Point<2> &end : {piece.start, piece.end})
        if (nearest.point.distance(end) < near * length)
          nearest.point = end;
    divide_at(curve, nearest.piece, nearest.point);
    return extend_crack(geometry, nearest.point, direction, length, name);
  }
} // namespace NMM
