#include <algorithm>
#include <cmath>
#include <contact/law/point_springs.h>
#include <contact/law/tractions.h>
#include <limits>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    namespace
    {
      /// Strength of a law that depends on the slip, after the additional slip s that this strength
      /// allows, @f$ S(p, \kappa + s) = |q| - k s @f$. q is the shear if nothing slides, and k [Pa/m]
      /// the stiffness of the spring. by_slip is the derivative of S by q, times k. The equation is
      /// solved by Newton's method with bisection; the root is between 0 and |q| / k.
      ContactLaw::Strength
      strength_after_slip(const ContactLaw &law,
                          const double      pressure,
                          const double      slip_before,
                          const double      trial,
                          const double      stiffness)
      {
        constexpr unsigned int max_iterations = 60;
        constexpr double       rounding       = 1e-14;

        ContactLaw::Strength strength = law.strength(pressure, slip_before);
        const double         most     = std::abs(trial) / stiffness;
        double               slip = 0., low = 0., high = most;
        if (std::abs(trial) <= strength.value)
          return strength;
        for (unsigned int i = 0; i < max_iterations; ++i)
        {
          const double excess =
            std::abs(trial) - stiffness * slip - strength.value;
          if (std::abs(excess) <= rounding * std::abs(trial))
            break;
          (excess > 0. ? low : high) = slip;
          slip += excess / (stiffness + strength.by_slip);
          if (!(slip > low && slip < high))
            slip = 0.5 * (low + high);
          strength = law.strength(pressure, slip_before + slip);
        }
        const double by_spring = strength.by_slip / stiffness;
        if (by_spring <= -1.)
          // The shear has jumped, so that there is no derivative.
          return {strength.value, strength.by_pressure, 0.};
        return {strength.value,
                strength.by_pressure / (1. + by_spring),
                strength.by_slip / (1. + by_spring)};
      }


      /// Shear of the spring of a point if nothing slides [Pa].
      double
      trial_shear(const ContactPoint      &point,
                  const PointData         &fixed,
                  const Tensor<1, 2>      &way_from_anchor,
                  const ContactProjection &projection)
      {
        return initial_shear(point, fixed) +
               fixed.law->shear_spring() *
                 (way_from_anchor * projection.place.a) /
                 projection.place.a.norm();
      }
    } // namespace


    Tractions::Tractions(const ContactSurface &surface,
                         const PointUpdater   &updater,
                         const PointProjector &projector,
                         const ContactMemory  &memory)
      : surface(&surface)
      , updater(&updater)
      , projector(&projector)
      , memory(&memory)
    {
    }


    Tractions::NormalSpring
    Tractions::normal_spring(const ContactPoint          &point,
                             PointData                   &fixed,
                             const ContactSurface::Place &slave,
                             const ContactProjection     &projection) const
    {
      const Dilation dilation = find_dilation(point, fixed, slave, projection);
      return {dilation, dilation.opening - projection.gap + fixed.offset};
    }


    ContactTraction
    Tractions::find(const NormalSpring          &normal,
                    const ContactSurface::Place &slave,
                    const ContactProjection     &projection,
                    ContactPoint                &point,
                    PointData                   &fixed) const
    {
      // Faces that touch count as closed in spite of rounding in their gap, so that a block that lies
      // on another one is held by it from the start. In statics the gap has no rounding.
      const double touching = updater->is_moving() ? 1e-13 : 0.;

      ContactTraction      traction;
      const ContactLaw    &law    = *fixed.law;
      ContactLaw::Response spring = spring_pressure(fixed, normal.closure);
      point.opening               = normal.dilation.opening;
      point.pressure              = point.multiplier + spring.value;
      const bool is_open =
        !point.is_bonded && point.pressure < -law.normal_stiffness * touching *
                                               projector->search_reach();
      if (is_open && fixed.kept_cohesion == 0.)
      {
        set_open(point);
        return traction;
      }
      // Cohesion that is kept acts without any pressure.
      if (is_open)
        spring.derivative = 0.;
      if (!point.is_bonded)
        point.pressure = std::max(point.pressure, 0.);
      traction.pressure = point.weight * point.pressure;
      traction.normal_stiffness =
        point.weight * spring.derivative * normal.dilation.by_gap;
      traction.pressure_by_slip =
        -point.weight * spring.derivative * normal.dilation.by_slip;
      traction.energy = normal_energy(point, fixed, point.pressure) -
                        normal_energy(point, fixed, point.multiplier);
      const bool was_slipping = point.state == ContactState::slip;
      point.state             = ContactState::slip;
      if (law.transmits_shear())
      {
        const Tensor<1, 2> way   = updater->way_from_anchor(point, slave);
        traction.normal_distance = way * projection.normal;
        find_shear(trial_shear(point, fixed, way, projection),
                   law.shear_spring(),
                   was_slipping,
                   point,
                   fixed,
                   traction);
        traction.energy += shear_energy(point, fixed, point.shear);
      }
      return traction;
    }


    Dilation
    Tractions::find_dilation(const ContactPoint          &point,
                             PointData                   &fixed,
                             const ContactSurface::Place &slave,
                             const ContactProjection     &projection) const
    {
      constexpr unsigned int max_iterations = 20;
      constexpr double       rounding       = 1e-14;

      Dilation          result;
      const ContactLaw &law = *fixed.law;
      fixed.new_slip        = 0.;
      result.opening        = opening_before(point, fixed);
      if (law.dilation == 0. || slip_is_frozen || point.is_bonded)
        return result;
      // Bodies that do not touch anywhere do not slide on each other.
      const auto &edges = surface->edges();
      if (memory->energies_of_pairs.count(std::minmax(
            edges[point.edge].body, edges[projection.master].body)) == 0)
        return result;
      const double most = law.dilation_limit == 0.
                            ? std::numeric_limits<double>::max()
                            : std::max(0., law.dilation_limit - fixed.slip);
      if (most == 0.)
        return result;

      // Trial shear and closure if nothing slides.
      const double eps     = law.shear_spring();
      const double trial   = trial_shear(point,
                                       fixed,
                                       updater->way_from_anchor(point, slave),
                                       projection);
      const double closure = result.opening + fixed.offset - projection.gap;
      // Solve |trial| - eps_t s = S(p(closure + tan psi s), kappa + s) for the slip s by Newton's
      // method, which needs one step if everything is linear.
      double slip = 0., by_closure = 0., h = 1.;
      bool   is_held = true;
      for (unsigned int i = 0; i < max_iterations; ++i)
      {
        const ContactLaw::Response spring =
          spring_pressure(fixed, closure + law.dilation * slip);
        const double pressure = point.multiplier + spring.value;
        is_held               = pressure > 0. || i == 0;
        if (!is_held)
          break;
        const ContactLaw::Strength strength =
          find_strength(fixed, pressure, fixed.slip + slip);
        const double excess = std::abs(trial) - eps * slip - strength.value;
        if (i == 0 && excess <= 0.)
          return result;
        by_closure = strength.by_pressure * spring.derivative;
        h          = eps + by_closure * law.dilation + strength.by_slip;
        if (h <= 0. || std::abs(excess) <= rounding * std::abs(trial))
          break;
        slip = std::max(0., slip + excess / h);
      }
      slip = std::min(most, slip);
      if (!is_held)
        slip = std::min(most, std::abs(trial) / eps);
      else if (slip < most && h > 0.)
      {
        result.by_gap  = 1. - by_closure * law.dilation / h;
        result.by_slip = -std::copysign(law.dilation * eps / h, trial);
      }
      fixed.new_slip = slip;
      result.opening += law.dilation * slip;
      return result;
    }


    void
    Tractions::find_shear(const double     trial,
                          const double     stiffness,
                          const bool       was_slipping,
                          ContactPoint    &point,
                          PointData       &fixed,
                          ContactTraction &traction) const
    {
      const ContactLaw &law = *fixed.law;
      // find_dilation() has already computed the slip if the law has dilation.
      const bool finds_slip =
        law.depends_on_slip() && law.dilation == 0. && !slip_is_frozen;
      if (finds_slip)
        fixed.new_slip = 0.;
      const ContactLaw::Strength strength =
        finds_slip
          ? strength_after_slip(
              law, point.pressure, fixed.slip, trial, stiffness)
          : find_strength(fixed, point.pressure, fixed.slip + fixed.new_slip);
      const double limit = strength.value;
      // The residual and its tangent are two assemblies at the same displacements.
      if (trial != point.spring_shear)
        point.has_turned = std::abs(trial) > limit && was_slipping &&
                           trial * point.spring_shear < 0.;
      point.spring_shear = trial;
      if (point.is_bonded || std::abs(trial) <= limit)
      {
        point.state              = ContactState::stick;
        point.shear              = trial;
        traction.shear_stiffness = point.weight * stiffness;
      }
      else
      {
        point.state = ContactState::slip;
        point.shear = trial > 0. ? limit : -limit;
        traction.shear_over_pressure =
          std::copysign(strength.by_pressure, trial);
        if (finds_slip)
        {
          traction.shear_stiffness = point.weight * strength.by_slip;
          fixed.new_slip           = (std::abs(trial) - limit) / stiffness;
        }
        // The point slides in alternating directions in the iterations, because the tangent stiffness
        // of sliding is too small. The secant stiffness is used instead.
        if (point.has_turned)
        {
          traction.shear_stiffness =
            point.weight * stiffness * limit / std::abs(trial);
          traction.pressure_by_slip = traction.shear_over_pressure = 0.;
        }
      }
      traction.shear = point.weight * point.shear;
    }
  } // namespace internal
} // namespace NMM
