#include <nmm/fracture/tip_cover.h>
#include <nmm/fracture/tip_grading.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace
  {
    /// The sizes about a point at which the displacement is of the degree @p exponent, see
    /// grade_towards().
    LocalSize
    grade(const dealii::Point<2> &point,
          const double            free_radius,
          const double            exponent,
          const double            growth,
          const double            size_at_point)
    {
      LocalSize size;
      size.kind     = LocalSize::Kind::point;
      size.point    = point;
      size.size     = size_at_point;
      size.growth   = growth;
      size.exponent = 1. - exponent / 3.;
      size.length   = free_radius;
      return size;
    }
  } // namespace


  LocalSize
  grade_towards(const CrackTip &tip,
                const double    growth,
                const double    least_size,
                const double    smallest)
  {
    return grade(tip.point,
                 tip.free_radius,
                 0.5,
                 growth,
                 std::max(smallest * tip.free_radius, least_size));
  }


  LocalSize
  grade_towards(const CrackCorner &corner,
                const double       growth,
                const double       least_size,
                const double       smallest)
  {
    const double exponent = corner_exponent(corner.angle);
    return grade(corner.point,
                 corner.free_radius,
                 exponent,
                 growth,
                 std::max(std::pow(smallest, 0.5 / exponent) *
                            corner.free_radius,
                          least_size));
  }


  double
  corner_exponent(const double angle)
  {
    Assert(angle > dealii::numbers::PI && angle < 2. * dealii::numbers::PI,
           dealii::ExcMessage("The corner must reach into the solid."));
    // The left-hand side falls from a positive to a negative value.
    double low = 0.5, high = 1.;
    for (unsigned int i = 0; i < 50; ++i)
    {
      const double middle = 0.5 * (low + high);
      const bool   is_positive =
        std::sin(middle * angle) + middle * std::sin(angle) > 0.;
      (is_positive ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }


  std::vector<LocalSize>
  sizes_at_tips(const PhysicalMesh &solid,
                const double        growth,
                const double        smallest)
  {
    const double           least_size = least_cell_size(solid);
    std::vector<LocalSize> sizes;
    for (const CrackTip &tip : find_crack_tips(solid))
      if (has_tip_cover(solid, tip))
        // The circle of the cover bounds the free radius.
        sizes.push_back(
          grade_towards(tip, 0.8 * growth, least_size, 0.4 * growth));
      else
        sizes.push_back(grade_towards(tip, growth, least_size, smallest));
    return sizes;
  }


  std::vector<LocalSize>
  sizes_at_corners(const PhysicalMesh &solid,
                   const double        growth,
                   const double        smallest)
  {
    constexpr double least_turn = 20. * dealii::numbers::PI / 180.,
                     roughness = 0.25, coarsening = 1.6;
    const std::vector<CrackCorner> corners =
      find_crack_corners(solid, least_turn);
    if (corners.empty())
      return {};
    const auto nearest = [](const dealii::Point<2> &x, const auto &others) {
      double distance = std::numeric_limits<double>::max();
      for (const auto &other : others)
        if (other.point != x)
          distance = std::min(distance, x.distance(other.point));
      return distance;
    };
    const std::vector<CrackTip> tips = find_crack_tips(solid);
    std::vector<LocalSize>      sizes;
    for (const CrackCorner &corner : corners)
      if (nearest(corner.point, corners) >=
          roughness * nearest(corner.point, tips))
        sizes.push_back(grade_towards(corner,
                                      std::min(1., coarsening * growth),
                                      least_cell_size(solid),
                                      smallest));
    return sizes;
  }
} // namespace NMM
