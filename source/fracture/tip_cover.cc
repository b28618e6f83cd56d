#include <nmm/base/exceptions.h>
#include <nmm/fracture/tip_cover.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    /// The length over which the crack is straight from its tip on [m].
    double
    straight_length(const CrackTip &tip)
    {
      double length = 0.;
      for (const ElementEdge &edge : tip.path)
      {
        const dealii::Tensor<1, 2> along = edge.end - tip.point;
        if (edge.is_arc() || std::abs(dealii::cross_product_2d(along) *
                                      tip.direction) > 1e-12 * along.norm())
          break;
        length = along.norm();
      }
      return length;
    }
  } // namespace


  TipCover::TipCover(const CrackTip        &tip,
                     const double           radius,
                     const PlaneElasticity &elasticity)
    : crack_tip(tip)
    , disk_radius(radius)
  {
    for (unsigned int c = 0; c < 2; ++c)
      frame[c][0] = tip.direction[c];
    frame[0][1] = -tip.direction[1];
    frame[1][1] = tip.direction[0];
    for (const unsigned int n : {1, 3})
      for (const auto kind : {TipField::Kind::opening, TipField::Kind::sliding})
      {
        fields.emplace_back(kind, elasticity, n);
        scales.push_back(std::pow(radius, 0.5 * (1. - n)));
      }
  }


  const CrackTip &
  TipCover::tip() const
  {
    return crack_tip;
  }


  double
  TipCover::radius() const
  {
    return disk_radius;
  }


  unsigned int
  TipCover::n_functions() const
  {
    return fields.size();
  }


  bool
  TipCover::contains(const dealii::Point<2> &x) const
  {
    return x.distance(crack_tip.point) < disk_radius;
  }


  DiskCover::Value
  TipCover::at(const unsigned int i, const double r, const double theta) const
  {
    const TipField::Values values = fields[i].evaluate(r, theta);
    Value                  result;
    result.displacement = scales[i] * (frame * values.displacement);
    result.gradient =
      scales[i] * (frame * values.gradient * dealii::transpose(frame));
    return result;
  }


  DiskCover::Value
  TipCover::evaluate(const unsigned int          i,
                     const dealii::Point<2>     &x,
                     const dealii::Tensor<1, 2> &into_solid) const
  {
    constexpr double at_tip = 1e-6, beside_tip = 1e-2, on_crack = 1e-9;
    const dealii::Tensor<1, 2> d =
      dealii::transpose(frame) * (x - crack_tip.point);
    if (d.norm() < at_tip * disk_radius)
      return at(i, beside_tip * disk_radius, 0.);
    const double theta = std::atan2(d[1], d[0]);
    if (dealii::numbers::PI - std::abs(theta) > on_crack)
      return at(i, d.norm(), theta);

    const Value above = at(i, d.norm(), dealii::numbers::PI),
                below = at(i, d.norm(), -dealii::numbers::PI);
    const double side = (dealii::transpose(frame) * into_solid)[1];
    if (side != 0.)
      return side > 0. ? above : below;
    Value mean;
    mean.displacement = 0.5 * (above.displacement + below.displacement);
    mean.gradient     = 0.5 * (above.gradient + below.gradient);
    return mean;
  }


  std::vector<double>
  TipCover::work(const Loads &loads) const
  {
    // With r = R s^2 all integrands are smooth functions of s.
    const dealii::QGauss<1> radial(8), angular(24);
    const double            pi = dealii::numbers::PI;
    std::vector<double>     work(fields.size());
    dealii::Tensor<1, 2>    up;
    for (unsigned int c = 0; c < 2; ++c)
      up[c] = frame[c][1];
    for (unsigned int p = 0; p < radial.size(); ++p)
    {
      const double s = radial.point(p)[0], r = disk_radius * s * s,
                   dr = 2. * disk_radius * s * radial.weight(p);
      for (unsigned int q = 0; q < angular.size(); ++q)
      {
        const double           theta  = pi * (2. * angular.point(q)[0] - 1.);
        const double           weight = r * dr * 2. * pi * angular.weight(q);
        const dealii::Point<2> x =
          crack_tip.point +
          frame * dealii::Point<2>(r * std::cos(theta), r * std::sin(theta));
        const dealii::Tensor<1, 2> force =
          loads.body_force ? loads.body_force(x) : dealii::Tensor<1, 2>();
        for (unsigned int i = 0; i < work.size(); ++i)
          work[i] += weight * (force * at(i, r, theta).displacement);
      }
      // The normal that points out of the solid is -up on the upper face. Pressure and
      // initial stress act on both faces in opposite directions.
      dealii::Tensor<1, 2> traction = loads.initial_stress * up;
      if (loads.face_pressure)
        traction +=
          loads.face_pressure(crack_tip.point - r * crack_tip.direction) * up;
      for (unsigned int i = 0; i < work.size(); ++i)
        work[i] +=
          dr *
          (traction * (at(i, r, pi).displacement - at(i, r, -pi).displacement));
    }
    return work;
  }


  std::vector<std::unique_ptr<TipCover>>
  make_tip_covers(const PhysicalMesh      &solid,
                  const ElasticityProblem &problem,
                  const double             least_radius,
                  const double             least_share)
  {
    const std::vector<CrackTip>     tips = find_crack_tips(solid);
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(solid);
    std::vector<std::unique_ptr<TipCover>> covers;
    for (const CrackTip &tip : tips)
    {
      double radius =
        std::min(0.8 * tip.free_radius, 0.9 * straight_length(tip));
      for (const PointForce &force : problem.point_forces)
        radius = std::min(radius, 0.8 * force.point.distance(tip.point));
      for (const FixedPoint &point : problem.fixed_points)
        radius = std::min(radius, 0.8 * point.point.distance(tip.point));
      for (const CrackTip &other : tips)
        if (&other != &tip)
          radius = std::min(radius, 0.45 * other.point.distance(tip.point));
      if (tip.tied_curve != invalid_index ||
          radius < std::max(least_share * tip.free_radius, least_radius))
        continue;
      const Material &material =
        problem.materials[region_to_material[tip.region]];
      covers.push_back(std::make_unique<TipCover>(
        tip, radius, material.plane_elasticity(problem.plane_state)));
    }
    return covers;
  }


  void
  add_circles(const std::vector<std::unique_ptr<TipCover>> &covers,
              const PhysicalMesh                           &solid,
              Geometry                                     &geometry)
  {
    for (const auto &cover : covers)
    {
      const unsigned int material =
        solid.regions()[cover->tip().region].material;
      geometry.add_circle(
        cover->tip().point,
        cover->radius(),
        "circle about the crack tip at " + to_string(cover->tip().point),
        CurveRole::interface,
        material == invalid_index ? "" : solid.material_names()[material]);
      geometry.curves().back().is_auxiliary = true;
    }
  }


  bool
  has_tip_cover(const PhysicalMesh &solid, const CrackTip &tip)
  {
    return std::any_of(solid.curves().begin(),
                       solid.curves().end(),
                       [&](const Curve &curve) {
                         return curve.is_auxiliary &&
                                curve.pieces.front().center == tip.point;
                       });
  }
} // namespace NMM
