#ifndef nmm_source_contact_law_point_springs_h
#define nmm_source_contact_law_point_springs_h

#include <nmm/contact/law/law.h>

#include <contact/state/point_data.h>

namespace NMM
{
  namespace internal
  {
    // What the springs of a contact point do by its law and what it remembers, without any
    // geometry. The law must be known where nothing else is said.

    /// Whether a point bears the initial stress: tension only as long as it is bonded. Any law.
    inline bool
    bears_initial_stress(const ContactPoint &point, const PointData &fixed)
    {
      return fixed.initial_pressure > 0. || point.is_bonded;
    }

    /// Shear of the initial stress [Pa], to which the spring adds. Any law.
    inline double
    initial_shear(const ContactPoint &point, const PointData &fixed)
    {
      return bears_initial_stress(point, fixed) ? fixed.initial_shear : 0.;
    }

    /// Closure of the normal spring by the initial stress [m].
    double
    initial_closure(const ContactPoint &point, const PointData &fixed);

    /// Opening by the slip at the last accepted state, and by the initial stress [m]; 0 without a
    /// law.
    double
    opening_before(const ContactPoint &point, const PointData &fixed);

    /// Pressure of the normal spring, and its derivative by the @p closure [m].
    ContactLaw::Response
    spring_pressure(const PointData &fixed, double closure);

    /// ContactLaw::strength(), with the cohesion that the point keeps.
    ContactLaw::Strength
    find_strength(const PointData &fixed, double pressure, double slip);

    /// Energy of the normal spring under a @p pressure [Pa], in J/m.
    double
    normal_energy(const ContactPoint &point,
                  const PointData    &fixed,
                  double              pressure);

    /// Energy of the shear spring under a @p shear [Pa], in J/m.
    double
    shear_energy(const ContactPoint &point,
                 const PointData    &fixed,
                 double              shear);

    /// Ratio of stress to strength of a bond; negative if the point is not bonded or has no law.
    /// Without strength any stress beyond rounding breaks the bond, which is that of the
    /// penetration @p rounding [m].
    double
    bond_ratio(const ContactPoint &point,
               const PointData    &fixed,
               double              rounding);
  } // namespace internal
} // namespace NMM

#endif
