#ifndef nmm_covers_point_location_h
#define nmm_covers_point_location_h

#include <nmm/covers/manifold_mesh.h>
#include <nmm/geometry/curve.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  /// Angle of @p x about @p center [rad], in (-pi, pi].
  inline double
  angle_about(const dealii::Point<2> &center, const dealii::Point<2> &x)
  {
    return std::atan2(x[1] - center[1], x[0] - center[0]);
  }

  /**
   * Angle swept from @p start to @p end about @p center, positive
   * counter-clockwise [rad], in (0, 2 pi] for @p counter_clockwise, else in
   * [-2 pi, 0).
   */
  inline double
  swept_angle(const dealii::Point<2> &center,
              const dealii::Point<2> &start,
              const dealii::Point<2> &end,
              const bool              counter_clockwise)
  {
    double sweep = angle_about(center, end) - angle_about(center, start);
    if (counter_clockwise)
      return sweep > 0. ? sweep : sweep + 2. * dealii::numbers::PI;
    return sweep < 0. ? sweep : sweep - 2. * dealii::numbers::PI;
  }

  /// Angle swept by an arc or circle, signed [rad].
  double
  swept_angle(const CurvePiece &piece);

  /**
   * Call @p action for points of the piece at most @p spacing [m] apart,
   * including its ends.
   */
  template <typename Action>
  void
  for_each_sample(const CurvePiece &piece,
                  const double      spacing,
                  const Action     &action)
  {
    const bool   straight = (piece.kind == CurvePiece::Kind::segment);
    const double sweep    = straight ? 0. : swept_angle(piece);
    const double length   = straight ? piece.start.distance(piece.end)
                                     : std::abs(sweep) * piece.radius;
    const auto   n =
      static_cast<unsigned int>(std::max(1., std::ceil(length / spacing)));
    const double first = straight ? 0. : angle_about(piece.center, piece.start);
    for (unsigned int k = 0; k <= n; ++k)
    {
      const double t = static_cast<double>(k) / n;
      if (straight)
        action(piece.start + t * (piece.end - piece.start));
      else
        action(piece.center + piece.radius * dealii::Tensor<1, 2>(
                                               {std::cos(first + t * sweep),
                                                std::sin(first + t * sweep)}));
    }
  }

  /// Call @p action for points of an edge of a manifold element or of the physical mesh, at most
  /// @p spacing [m] apart, including its ends.
  template <typename Action>
  void
  for_each_sample(const ElementEdge &edge,
                  const double       spacing,
                  const Action      &action)
  {
    const double sweep  = swept_angle(edge);
    const double length = edge.is_arc() ? std::abs(sweep * edge.radius)
                                        : edge.start.distance(edge.end);
    const auto   n =
      static_cast<unsigned int>(std::max(1., std::ceil(length / spacing)));
    const double first =
      edge.is_arc() ? angle_about(edge.center, edge.start) : 0.;
    action(edge.start);
    for (unsigned int k = 1; k < n; ++k)
    {
      const double t = static_cast<double>(k) / n;
      if (edge.is_arc())
        action(edge.center +
               std::abs(edge.radius) *
                 dealii::Tensor<1, 2>(
                   {std::cos(first + t * sweep), std::sin(first + t * sweep)}));
      else
        action(edge.start + t * (edge.end - edge.start));
    }
    action(edge.end);
  }

  /**
   * Whether @p x is in the solid, by the parity of crossings with boundaries and holes. The test is
   * done in floating point and not reliable within rounding of a curve.
   */
  bool
  is_in_solid(const PhysicalMesh &physical_mesh, const dealii::Point<2> &x);

  /// Whether @p x is inside the closed boundary @p edges of a manifold element, by the same test.
  bool
  is_inside(dealii::ArrayView<const ElementEdge> edges,
            const dealii::Point<2>              &x);

  /// Distance of @p x from the nearest point of an edge [m].
  double
  distance(const ElementEdge &edge, const dealii::Point<2> &x);
} // namespace NMM

#endif
