#include <nmm/base/exceptions.h>
#include <nmm/geometry/geometry.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace NMM
{
  namespace
  {
    std::vector<CurvePiece>
    segments_through(const std::vector<dealii::Point<2>> &vertices)
    {
      std::vector<CurvePiece> pieces;
      for (unsigned int i = 1; i < vertices.size(); ++i)
        pieces.push_back(CurvePiece::segment(vertices[i - 1], vertices[i]));
      return pieces;
    }
  } // namespace


  void
  Geometry::add(Curve curve)
  {
    if (curve.name.empty())
      curve.name =
        to_string(curve.role) + "-" + std::to_string(all_curves.size() + 1);
    curve.check();
    all_curves.push_back(std::move(curve));
  }


  void
  Geometry::add_polygon(const std::vector<dealii::Point<2>> &vertices,
                        const std::string                   &name,
                        const CurveRole                      role,
                        const std::string                   &material)
  {
    std::vector<dealii::Point<2>> closed = vertices;
    if (closed.size() > 1 && closed.front() != closed.back())
      closed.push_back(closed.front());

    Curve curve;
    curve.name     = name;
    curve.role     = role;
    curve.material = material;
    curve.pieces   = segments_through(closed);
    AssertThrow(curve.pieces.size() > 2,
                InputError("polygon '" + name +
                             "' has fewer than three "
                             "different vertices",
                           vertices.empty() ? "its definition"
                                            : to_string(vertices.front()),
                           "give it at least three"));
    add(std::move(curve));
  }


  void
  Geometry::add_polyline(const std::vector<dealii::Point<2>> &vertices,
                         const std::string                   &name,
                         const CurveRole                      role,
                         const JointState                     state)
  {
    Curve curve;
    curve.name   = name;
    curve.role   = role;
    curve.state  = state;
    curve.pieces = segments_through(vertices);
    add(std::move(curve));
  }


  void
  Geometry::add_circle(const dealii::Point<2> &center,
                       const double            radius,
                       const std::string      &name,
                       const CurveRole         role,
                       const std::string      &material)
  {
    Curve curve;
    curve.name     = name;
    curve.role     = role;
    curve.material = material;
    curve.pieces.push_back(CurvePiece::circle(center, radius));
    add(std::move(curve));
  }


  void
  Geometry::add_material_point(const dealii::Point<2> &point,
                               const std::string      &material)
  {
    AssertThrow(std::isfinite(point[0]) && std::isfinite(point[1]),
                InputError("the point of material '" + material +
                             "' is not finite",
                           to_string(point),
                           "give finite numbers"));
    AssertThrow(!material.empty(),
                InputError("a material point has no material name",
                           to_string(point),
                           "give it one"));
    all_material_points.emplace_back(point, material);
  }


  void
  Geometry::add_region(Curve curve)
  {
    curve.check();
    AssertThrow(curve.is_closed(),
                InputError("the region '" + curve.name + "' is not closed",
                           to_string(curve.end()),
                           "let it end where it starts"));
    for (const Curve &other : all_regions)
      AssertThrow(other.name != curve.name,
                  InputError("there are two regions called '" + curve.name +
                               "'",
                             to_string(curve.start()),
                             "rename one"));
    all_regions.push_back(std::move(curve));
  }


  void
  Geometry::add_material_region(const std::string &region,
                                const std::string &material)
  {
    AssertThrow(std::any_of(all_regions.begin(),
                            all_regions.end(),
                            [&](const Curve &curve) {
                              return curve.name == region;
                            }),
                InputError("there is no region '" + region + "'",
                           "the material '" + material + "'",
                           "add the region first"));
    all_material_regions.emplace_back(region, material);
  }


  void
  Geometry::merge_blocks_below(const double area)
  {
    AssertThrow(area >= 0. && std::isfinite(area),
                InputError("blocks are to be merged that are smaller than " +
                             std::to_string(area) + " m^2",
                           "",
                           "give an area that is not negative, 0 for none"));
    area_to_merge = area;
  }


  double
  Geometry::merging_area() const
  {
    return area_to_merge;
  }


  void
  Geometry::unite_doubled_joints()
  {
    unites_joints = true;
  }


  bool
  Geometry::unites_doubled_joints() const
  {
    return unites_joints;
  }


  const std::vector<Curve> &
  Geometry::regions() const
  {
    return all_regions;
  }


  const std::vector<std::pair<std::string, std::string>> &
  Geometry::material_regions() const
  {
    return all_material_regions;
  }


  const std::vector<Curve> &
  Geometry::curves() const
  {
    return all_curves;
  }


  std::vector<Curve> &
  Geometry::curves()
  {
    return all_curves;
  }


  const std::vector<std::pair<dealii::Point<2>, std::string>> &
  Geometry::material_points() const
  {
    return all_material_points;
  }
} // namespace NMM
