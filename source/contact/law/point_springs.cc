#include <algorithm>
#include <cmath>
#include <contact/law/point_springs.h>

namespace NMM
{
  namespace internal
  {
    double
    initial_closure(const ContactPoint &point, const PointData &fixed)
    {
      const double pressure =
        bears_initial_stress(point, fixed)
          ? fixed.initial_pressure - fixed.initial_multiplier
          : 0.;
      return pressure == 0.
               ? 0.
               : fixed.law->penetration(pressure / fixed.stiffening);
    }


    double
    opening_before(const ContactPoint &point, const PointData &fixed)
    {
      return fixed.law == nullptr
               ? 0.
               : fixed.law->opening(fixed.slip) + initial_closure(point, fixed);
    }


    ContactLaw::Response
    spring_pressure(const PointData &fixed, const double closure)
    {
      ContactLaw::Response spring = fixed.law->pressure(closure);
      spring.value *= fixed.stiffening;
      spring.derivative *= fixed.stiffening;
      return spring;
    }


    ContactLaw::Strength
    find_strength(const PointData &fixed,
                  const double     pressure,
                  const double     slip)
    {
      ContactLaw::Strength strength = fixed.law->strength(pressure, slip);
      if (fixed.keeps_cohesion && !fixed.law->depends_on_slip())
      {
        const ContactLaw::Response cohesion = fixed.law->cohesion_at(pressure);
        strength.value += fixed.kept_cohesion - cohesion.value;
        strength.by_pressure -= cohesion.derivative;
      }
      return strength;
    }


    double
    normal_energy(const ContactPoint &point,
                  const PointData    &fixed,
                  const double        pressure)
    {
      const ContactLaw &law = *fixed.law;
      return point.weight * fixed.stiffening *
             law.energy(law.penetration(pressure / fixed.stiffening));
    }


    double
    shear_energy(const ContactPoint &point,
                 const PointData    &fixed,
                 const double        shear)
    {
      return point.weight * fixed.law->shear_energy(shear);
    }


    double
    bond_ratio(const ContactPoint &point,
               const PointData    &fixed,
               const double        rounding)
    {
      const ContactLaw *const law = fixed.law;
      if (!point.is_bonded || law == nullptr)
        return -1.;
      const double least = rounding * law->normal_stiffness;
      const auto   ratio = [&](const double stress, const double strength) {
        return std::max(0., stress) / std::max(strength, least);
      };
      return std::max(ratio(-point.pressure, law->tensile_strength),
                      ratio(std::abs(point.shear),
                            law->bond_strength(std::max(0., point.pressure))));
    }
  } // namespace internal
} // namespace NMM
