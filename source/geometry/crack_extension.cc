#include <nmm/geometry/crack_extension.h>

#include "geometry/messages.h"
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
  } // namespace


  CrackExtension
  extend_crack(Geometry                   &geometry,
               const dealii::Point<2>     &tip,
               const dealii::Tensor<1, 2> &direction,
               const double                length,
               const std::string          &name)
  {
    constexpr double    look_ahead = 1.5, nearly_none = 1e-6, near = 1e-3;
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
      Curve           &other = curves[meeting.curve];
      const CurvePiece piece = other.pieces[meeting.piece];
      result.met             = internal::describe(other);
      result.end             = meeting.point;
      if (piece.kind == CurvePiece::Kind::circle ||
          (result.end != piece.start && result.end != piece.end))
      {
        const auto [first, second]  = internal::split(piece, meeting.point);
        other.pieces[meeting.piece] = second;
        other.pieces.insert(other.pieces.begin() + meeting.piece, first);
      }
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
} // namespace NMM
