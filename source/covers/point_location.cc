#include <nmm/covers/point_location.h>

#include <algorithm>
#include <base/cross.h>
#include <map>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    using internal::cross;

    /**
     * Whether the ray from @p x in the direction +x crosses the segment a b. The test is half-open
     * in y, so that a ray through a common end point counts once.
     */
    bool
    ray_crosses(const Point<2> &a, const Point<2> &b, const Point<2> &x)
    {
      if ((a[1] > x[1]) == (b[1] > x[1]))
        return false;
      const double t = (x[1] - a[1]) / (b[1] - a[1]);
      return a[0] + t * (b[0] - a[0]) > x[0];
    }


    /**
     * Whether the ray crosses an arc, by parity. An arc is its chord plus the circular segment
     * between both: the parity is that of the chord, toggled for points of the circular segment.
     */
    bool
    in_circular_segment(const Point<2> &start,
                        const Point<2> &end,
                        const Point<2> &center,
                        const double    radius,
                        const bool      counter_clockwise,
                        const Point<2> &x)
    {
      if (x.distance_square(center) >= radius * radius)
        return false;
      double side = cross(end - start, x - start);
      // Points on the chord count as slightly to its right and, by even less, above it, as in
      // ray_crosses().
      if (side == 0.)
        side = end[1] != start[1] ? start[1] - end[1] : end[0] - start[0];
      return counter_clockwise ? side < 0. : side > 0.;
    }


    bool
    is_counter_clockwise(const CurvePiece &arc)
    {
      return cross(arc.through - arc.start, arc.end - arc.through) > 0.;
    }
  } // namespace


  double
  swept_angle(const CurvePiece &piece)
  {
    if (piece.kind == CurvePiece::Kind::circle)
      return 2. * numbers::PI;
    return swept_angle(piece.center,
                       piece.start,
                       piece.end,
                       is_counter_clockwise(piece));
  }


  bool
  is_in_solid(const PhysicalMesh &physical_mesh, const Point<2> &x)
  {
    // Excavations may overlap everything else, so that each of them is tested separately.
    bool                         is_in_domain = false;
    std::map<unsigned int, bool> is_in_excavation;
    for (unsigned int i = 0; i < physical_mesh.pieces().size(); ++i)
    {
      const unsigned int c     = physical_mesh.piece_to_curve()[i];
      const Curve       &curve = physical_mesh.curves()[c];
      if (curve.role != CurveRole::boundary && curve.role != CurveRole::hole)
        continue;
      bool &inside = curve.role == CurveRole::hole && curve.is_clipped
                       ? is_in_excavation[c]
                       : is_in_domain;
      const CurvePiece &piece = physical_mesh.pieces()[i];
      switch (piece.kind)
      {
        case CurvePiece::Kind::segment:
          inside ^= ray_crosses(piece.start, piece.end, x);
          break;
        case CurvePiece::Kind::arc:
          inside ^= ray_crosses(piece.start, piece.end, x);
          inside ^= in_circular_segment(piece.start,
                                        piece.end,
                                        piece.center,
                                        piece.radius,
                                        is_counter_clockwise(piece),
                                        x);
          break;
        case CurvePiece::Kind::circle:
          inside ^= x.distance(piece.center) < piece.radius;
          break;
      }
    }
    return is_in_domain &&
           std::none_of(is_in_excavation.begin(),
                        is_in_excavation.end(),
                        [](const auto &entry) { return entry.second; });
  }


  bool
  is_inside(const ArrayView<const ElementEdge> edges, const Point<2> &x)
  {
    bool inside = false;
    for (const ElementEdge &edge : edges)
    {
      inside ^= ray_crosses(edge.start, edge.end, x);
      if (edge.is_arc())
        inside ^= in_circular_segment(edge.start,
                                      edge.end,
                                      edge.center,
                                      std::abs(edge.radius),
                                      edge.radius > 0.,
                                      x);
    }
    return inside;
  }


  double
  distance(const ElementEdge &edge, const Point<2> &x)
  {
    if (edge.is_arc())
    {
      const double sweep = swept_angle(edge);
      const double to_x =
        swept_angle(edge.center, edge.start, x, edge.radius > 0.);
      if (std::abs(to_x) <= std::abs(sweep))
        return std::abs(x.distance(edge.center) - std::abs(edge.radius));
      return std::min(x.distance(edge.start), x.distance(edge.end));
    }
    const Tensor<1, 2> d = edge.end - edge.start;
    const double       t =
      std::clamp((x - edge.start) * d / std::max(d.norm_square(), 1e-300),
                 0.,
                 1.);
    return x.distance(edge.start + t * d);
  }
} // namespace NMM
