#include <nmm/base/exceptions.h>
#include <nmm/mechanics/thick_ring.h>

#include <cmath>
#include <string>

namespace NMM
{
  ThickRing::ThickRing(const double            inner_radius,
                       const double            outer_radius,
                       const double            pressure,
                       const Material         &material,
                       const PlaneState        plane_state,
                       const dealii::Point<2> &center)
    : a(inner_radius)
    , b(outer_radius)
    , origin(center)
  {
    AssertThrow(a > 0. && b > a && std::isfinite(b),
                InputError("A ring's radii are " + std::to_string(a) +
                             " m and " + std::to_string(b) + " m",
                           to_string(center),
                           "give 0 < inner radius < outer radius"));
    AssertThrow(std::isfinite(pressure),
                InputError("A ring's pressure is not finite",
                           to_string(center),
                           "give a number in Pa"));
    material.check(plane_state);
    elasticity = material.plane_elasticity(plane_state);
    scale      = pressure * a * a / (b * b - a * a);
  }


  double
  ThickRing::inner_radius() const
  {
    return a;
  }


  double
  ThickRing::outer_radius() const
  {
    return b;
  }


  const dealii::Point<2> &
  ThickRing::center() const
  {
    return origin;
  }


  double
  ThickRing::radial_stress(const double r) const
  {
    return scale * (1. - b * b / (r * r));
  }


  double
  ThickRing::hoop_stress(const double r) const
  {
    return scale * (1. + b * b / (r * r));
  }


  double
  ThickRing::radial_displacement(const double r) const
  {
    return scale * (r / (2. * (elasticity.lambda + elasticity.mu)) +
                    b * b / (2. * elasticity.mu * r));
  }


  dealii::Tensor<1, 2>
  ThickRing::displacement(const dealii::Point<2> &x) const
  {
    const dealii::Tensor<1, 2> d = x - origin;
    const double               r = d.norm();
    return radial_displacement(r) / r * d;
  }


  dealii::SymmetricTensor<2, 2>
  ThickRing::stress(const dealii::Point<2> &x) const
  {
    const dealii::Tensor<1, 2> d = x - origin;
    const double               r = d.norm();
    const dealii::Tensor<1, 2> e = d / r;

    // sigma_theta I + (sigma_r - sigma_theta) e_r e_r^T
    const double                  hoop       = hoop_stress(r);
    const double                  difference = radial_stress(r) - hoop;
    dealii::SymmetricTensor<2, 2> sigma;
    sigma[0][0] = hoop + difference * e[0] * e[0];
    sigma[0][1] = difference * e[0] * e[1];
    sigma[1][1] = hoop + difference * e[1] * e[1];
    return sigma;
  }
} // namespace NMM
