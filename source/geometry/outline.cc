#include "geometry/outline.h"

#include <boost/geometry.hpp>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      namespace bg     = boost::geometry;
      using PlanePoint = bg::model::d2::point_xy<double>;
      using Polygon    = bg::model::polygon<PlanePoint>;


      /// Append points of the piece, without its end.
      void
      append(const CurvePiece &piece, Polygon &polygon)
      {
        const auto add = [&](const dealii::Point<2> &point) {
          bg::append(polygon.outer(), PlanePoint(point[0], point[1]));
        };
        add(piece.start);
        if (piece.kind == CurvePiece::Kind::segment)
          return;
        const auto angle = [&](const dealii::Point<2> &point) {
          return std::atan2(point[1] - piece.center[1],
                            point[0] - piece.center[0]);
        };
        constexpr double   turn = 2. * dealii::numbers::PI;
        constexpr unsigned n    = 64;
        const double       from = angle(piece.start);
        double             span = turn;
        if (piece.kind == CurvePiece::Kind::arc)
        {
          const auto after = [&](const dealii::Point<2> &point) {
            const double difference = angle(point) - from;
            return difference < 0. ? difference + turn : difference;
          };
          span = after(piece.end);
          if (after(piece.through) > span)
            span -= turn;
        }
        for (unsigned int i = 1; i < n; ++i)
        {
          const double a = from + span * i / n;
          add({piece.center[0] + piece.radius * std::cos(a),
               piece.center[1] + piece.radius * std::sin(a)});
        }
      }
    } // namespace


    bool
    contains(const Curve &curve, const dealii::Point<2> &point)
    {
      Polygon polygon;
      for (const CurvePiece &piece : curve.pieces)
        append(piece, polygon);
      bg::correct(polygon);
      return bg::within(PlanePoint(point[0], point[1]), polygon);
    }
  } // namespace internal
} // namespace NMM
