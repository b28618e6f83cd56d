#include <nmm/covers/point_location.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/output/picture.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    /// The point of a piece at the parameter @p t, from 0 at its start to 1 at its end.
    Point<2>
    place_on(const CurvePiece &piece, const double t)
    {
      if (piece.kind == CurvePiece::Kind::segment)
        return piece.start + t * (piece.end - piece.start);
      const double angle =
        angle_about(piece.center, piece.start) + t * swept_angle(piece);
      return piece.center +
             std::abs(piece.radius) *
               dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)});
    }


    /// Larger side of the box around an undeformed triangle [m].
    double
    size_of(const PictureData::Triangle &triangle)
    {
      double size = 0.;
      for (const PictureData::Vertex &vertex : triangle.vertices)
        for (unsigned int d = 0; d < 2; ++d)
          size = std::max(size,
                          std::abs(vertex.at(0.)[d] -
                                   triangle.vertices[0].at(0.)[d]));
      return size;
    }


    /// The largest number not above @p value that is 1, 2 or 5 times a power of ten.
    double
    rounded_down(const double value)
    {
      const double power = std::pow(10., std::floor(std::log10(value)));
      for (const double factor : {5., 2.})
        if (factor * power <= value)
          return factor * power;
      return power;
    }
  } // namespace


  double
  choose_deformation_scale(const double largest_displacement,
                           const double diagonal,
                           const double smallest_hole)
  {
    // Opposite sides of a hole may move towards each other.
    const double shown = std::min(0.05 * diagonal, 0.125 * smallest_hole);
    return largest_displacement > 1e-14 * diagonal
             ? rounded_down(shown / largest_displacement)
             : 0.;
  }


  double
  smallest_hole(const PhysicalMesh &mesh)
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Curve &curve : mesh.curves())
    {
      if (curve.pieces.empty())
        continue;
      // What a tied joint surrounds can be excavated in a stage.
      const bool may_become_hole = curve.role == CurveRole::joint &&
                                   curve.state == JointState::closed &&
                                   curve.is_closed();
      if (curve.role != CurveRole::hole && !may_become_hole)
        continue;
      Point<2> lower = curve.pieces.front().start, upper = lower;
      for (const CurvePiece &piece : curve.pieces)
        for (unsigned int k = 0; k <= 8; ++k)
        {
          const Point<2> x = place_on(piece, k / 8.);
          for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
        }
      const double side = std::min(upper[0] - lower[0], upper[1] - lower[1]);
      // A curve that is only a part of a hole's boundary may be a straight line.
      if (side > 0.)
        smallest = std::min(smallest, side);
    }
    return smallest;
  }


  void
  PictureExtents::add(const PictureData &data, const double scale)
  {
    for (const PictureData::Triangle &triangle : data.triangles)
    {
      for (const PictureData::Vertex &vertex : triangle.vertices)
      {
        const Point<2> x = vertex.at(scale);
        for (unsigned int d = 0; d < 2; ++d)
          if (std::isfinite(x[d]))
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
        if (std::isfinite(vertex.displacement.norm()))
          largest = std::max(largest, vertex.displacement.norm());
      }
    }
    // Values in triangles about a crack tip that are too small to be seen would dominate the range
    // of colours.
    constexpr double least_visible = 1e-3;
    const double     least =
      least_visible * std::max(upper[0] - lower[0], upper[1] - lower[1]);
    const bool has_large =
      std::any_of(data.triangles.begin(),
                  data.triangles.end(),
                  [&](const PictureData::Triangle &triangle) {
                    return size_of(triangle) >= least;
                  });
    for (const PictureData::Triangle &triangle : data.triangles)
      if (!has_large || size_of(triangle) >= least)
        for (const double value : triangle.values)
          if (std::isfinite(value))
          {
            minimum = std::min(minimum, value);
            maximum = std::max(maximum, value);
          }
    for (const PictureData::Polyline &line : data.obstacles)
      for (const PictureData::Vertex &vertex : line)
        for (unsigned int d = 0; d < 2; ++d)
        {
          rigid_lower[d] = std::min(rigid_lower[d], vertex.at(scale)[d]);
          rigid_upper[d] = std::max(rigid_upper[d], vertex.at(scale)[d]);
        }
    for (const PictureData::Bar &bar : data.contacts)
      traction = std::max(traction, bar.traction.norm());
  }


  std::pair<Point<2>, Point<2>>
  PictureExtents::view(const double margin) const
  {
    if (!(lower[0] <= upper[0] && lower[1] <= upper[1]))
      return {Point<2>(0., 0.), Point<2>(1., 1.)};
    const double size = std::max(upper[0] - lower[0], upper[1] - lower[1]);
    // Obstacles may be very long, so only the part near the solid is shown.
    constexpr double shown = 0.08;
    const double     space = margin * size;
    Point<2>         first, last;
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double low  = std::max(rigid_lower[d], lower[d] - shown * size);
      const double high = std::min(rigid_upper[d], upper[d] + shown * size);
      first[d]          = std::min(lower[d], low) - space;
      last[d]           = std::max(upper[d], high) + space;
    }
    return {first, last};
  }


  std::pair<double, double>
  PictureExtents::range() const
  {
    if (!(minimum <= maximum))
      return {0., 0.};
    if (maximum - minimum <=
        1e-9 * std::max(std::abs(minimum), std::abs(maximum)))
      return {minimum, minimum};
    return {minimum, maximum};
  }


  double
  PictureExtents::largest_displacement() const
  {
    return largest;
  }


  double
  PictureExtents::largest_traction() const
  {
    return traction;
  }
} // namespace NMM
