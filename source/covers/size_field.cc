#include <nmm/base/exceptions.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/point_location.h>
#include <nmm/geometry/physical_mesh.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    double
    distance_from_box(const LocalSize &box, const Point<2> &x)
    {
      Tensor<1, 2> d;
      for (unsigned int i = 0; i < 2; ++i)
        d[i] = std::max({box.lower[i] - x[i], 0., x[i] - box.upper[i]});
      return d.norm();
    }


    /// Distance from a piece. An arc is treated as two edges of less than half a circle each, and a
    /// segment as one edge, so that the distance from an edge can be used.
    double
    distance(const CurvePiece &piece, const Point<2> &x)
    {
      if (piece.kind == CurvePiece::Kind::circle)
        return std::abs(x.distance(piece.center) - piece.radius);
      ElementEdge edge;
      edge.start = piece.start;
      edge.end   = piece.end;
      if (piece.kind == CurvePiece::Kind::segment)
        return NMM::distance(edge, x);

      const double sweep = swept_angle(piece);
      const double middle =
        angle_about(piece.center, piece.start) + 0.5 * sweep;
      edge.center = piece.center;
      edge.radius = std::copysign(piece.radius, sweep);
      edge.end = piece.center + piece.radius * Tensor<1, 2>({std::cos(middle),
                                                             std::sin(middle)});
      ElementEdge second = edge;
      second.start       = edge.end;
      second.end         = piece.end;
      return std::min(NMM::distance(edge, x), NMM::distance(second, x));
    }
  } // namespace


  SizeField::SizeField(const PhysicalMesh  &physical_mesh,
                       GradedMeshParameters parameters_)
    : parameters(std::move(parameters_))
  {
    for (const LocalSize &local : parameters.local_sizes)
    {
      AssertThrow(local.size > 0. && local.growth > 0. && local.growth <= 1.,
                  InputError("a local size of " + std::to_string(local.size) +
                               " m that grows by " +
                               std::to_string(local.growth) + " per distance",
                             "Mathematical mesh/Local sizes",
                             "the size must be positive and the growth in "
                             "(0, 1]"));
      Assert(local.exponent > 0. && local.exponent <= 1. && local.length > 0.,
             ExcMessage(
               "The size of cells must not grow faster than linearly."));
      pieces_of_local_size.emplace_back();
      if (local.kind != LocalSize::Kind::curve)
        continue;
      for (unsigned int i = 0; i < physical_mesh.pieces().size(); ++i)
        if (physical_mesh.curves()[physical_mesh.piece_to_curve()[i]].name ==
            local.curve)
          pieces_of_local_size.back().push_back(physical_mesh.pieces()[i]);
      AssertThrow(!pieces_of_local_size.back().empty(),
                  InputError("there is no curve called '" + local.curve + "'",
                             "Mathematical mesh/Local sizes",
                             "name a curve of the geometry"));
    }
  }


  double
  SizeField::operator()(const Point<2> &x) const
  {
    double size = parameters.cell_size;
    for (unsigned int i = 0; i < parameters.local_sizes.size(); ++i)
    {
      const LocalSize &local = parameters.local_sizes[i];
      double           d     = 1e300;
      switch (local.kind)
      {
        case LocalSize::Kind::point:
          d = x.distance(local.point);
          break;
        case LocalSize::Kind::box:
          d = distance_from_box(local, x);
          break;
        case LocalSize::Kind::curve:
          for (const CurvePiece &piece : pieces_of_local_size[i])
            d = std::min(d, distance(piece, x));
          break;
      }
      // The power need not be computed if even the linear growth up to `length`, which is a lower
      // bound, exceeds the size.
      if (local.size + local.growth * std::min(d, local.length) >= size)
        continue;
      const bool is_linear = local.exponent == 1. || d >= local.length;
      size                 = std::min(size,
                      local.size + local.growth *
                                     (is_linear ? d
                                                                : local.length *
                                                    std::pow(d / local.length,
                                                             local.exponent)));
    }
    return size;
  }
} // namespace NMM
