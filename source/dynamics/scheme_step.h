#ifndef nmm_source_dynamics_scheme_step_h
#define nmm_source_dynamics_scheme_step_h

#include <nmm/dynamics/dynamic_state.h>
#include <nmm/dynamics/time_scheme.h>

#include <linear_algebra/chosen_items.h>

namespace NMM
{
  namespace internal
  {
    /// A step of a TimeScheme from a state: how velocities and accelerations follow from
    /// displacements, and at which time and with which factors the terms of the equations act.
    /// Lifetime: the state must outlive this object.
    class SchemeStep
    {
    public:
      using Vector = MechanicalModel::Vector;

      /// @throws InputError for coefficients of the scheme that are out of range.
      SchemeStep(const TimeScheme   &scheme,
                 const DynamicState &begin,
                 const ModelLayout  &layout);

      /// Begin a step of @p h [s] with a prediction of u.
      void
      predict(double h);

      /// Compute v and a from u in @p rows.
      void
      set_rates(const ChosenItems &rows);

      /// Write a_{1 - alpha_m} into @p result in @p rows.
      void
      mix_accelerations(const ChosenItems &rows, Vector &result) const
      {
        mix(a, scheme.alpha_m, begin->a, rows, result);
      }

      /// Write v_{1 - alpha_f} into @p result in @p rows.
      void
      mix_velocities(const ChosenItems &rows, Vector &result) const
      {
        mix(v, scheme.alpha_f, begin->v, rows, result);
      }

      /// Derivative of the displacements in r with respect to u [-]. The equations are divided by it,
      /// so that the tangent of the terms is a summand of their derivative.
      double
      stiffness_factor() const
      {
        return 1. - scheme.alpha_f;
      }

      /// Derivative of v_{1 - alpha_f} with respect to u over stiffness_factor() [1/s].
      double
      damping_factor() const
      {
        return scheme.gamma / (scheme.beta * length);
      }

      /// Derivative of a_{1 - alpha_m} with respect to u over stiffness_factor() [1/s^2].
      double
      mass_factor() const
      {
        return (1. - scheme.alpha_m) /
               (stiffness_factor() * scheme.beta * length * length);
      }

      /// Time of the loads unless the forces are conserving [s].
      double
      time_of_forces() const
      {
        return begin->time + stiffness_factor() * length;
      }

      double
      end_time() const
      {
        return begin->time + length;
      }

      /// Share of the closing forces in the equations [-].
      double
      closing_share() const;

      /// Share of the closing forces in the work of the step [-].
      double
      closing_share_in_work() const;

      /// Factor of the change of accelerations in StepReport::error [s^2].
      double
      error_factor() const;

      TimeScheme scheme;
      /// Length of the step [s].
      double length = 0.;
      /// Displacements, velocities and accelerations at the end, owned unknowns.
      Vector u, v, a;

    private:
      void
      mix(const Vector      &x,
          double             alpha,
          const Vector      &x_0,
          const ChosenItems &rows,
          Vector            &result) const;

      const DynamicState *begin;
    };
  } // namespace internal
} // namespace NMM

#endif
