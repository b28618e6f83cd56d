#ifndef nmm_mechanics_thick_ring_h
#define nmm_mechanics_thick_ring_h

#include <nmm/materials/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /**
   * Lamé's solution of a ring under inner pressure: inner radius a, outer
   * radius b [m], pressure p on the inner boundary [Pa], no traction on the outer one. With
   * s = p a^2 / (b^2 - a^2),
   * @f[ \sigma_r = s\,(1 - b^2/r^2), \quad
   *     \sigma_\theta = s\,(1 + b^2/r^2), \quad
   *     u_r = \frac{s\,r}{2(\lambda+\mu)} + \frac{s\,b^2}{2\mu\,r} @f]
   * with the plane lambda of the plane state; the hoop stress is the paper's
   * p ((b/r)^2 + 1) / ((b/a)^2 - 1). The mean rotation and translation are zero.
   * Source: Timoshenko & Goodier, Theory of Elasticity, section 28.
   */
  class ThickRing
  {
  public:
    /// @throws InputError unless 0 < a < b, for a pressure that is not finite, and for an invalid
    /// material.
    ThickRing(double                  inner_radius,
              double                  outer_radius,
              double                  pressure,
              const Material         &material,
              PlaneState              plane_state,
              const dealii::Point<2> &center = dealii::Point<2>());

    /// Inner radius a [m].
    double
    inner_radius() const;

    /// Outer radius b [m].
    double
    outer_radius() const;

    /// Centre of the ring [m].
    const dealii::Point<2> &
    center() const;

    /// Radial stress sigma_r at the radius @p r [Pa].
    double
    radial_stress(double r) const;

    /// Hoop stress sigma_theta at the radius @p r [Pa].
    double
    hoop_stress(double r) const;

    /// Radial displacement u_r at the radius @p r [m].
    double
    radial_displacement(double r) const;

    /// Displacement u at the point @p x, which must not be the centre [m].
    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &x) const;

    /// In-plane stress at @p x, in Cartesian components [Pa].
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Point<2> &x) const;

  private:
    double           a, b;
    double           scale;
    PlaneElasticity  elasticity;
    dealii::Point<2> origin;
  };
} // namespace NMM

#endif
