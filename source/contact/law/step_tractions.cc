#include <algorithm>
#include <cmath>
#include <contact/law/point_springs.h>
#include <contact/law/step_tractions.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    namespace
    {
      /// Mean pressure of a spring whose gap goes from g_0 to g_1, and its derivative by g_1: minus
      /// the change of the energy over that of the gap.
      ContactLaw::Response
      mean_pressure(const ContactLaw &law,
                    const bool        bears_tension,
                    const double      g_0,
                    const double      g_1)
      {
        ContactLaw::Response result;
        if (bears_tension || (g_0 <= 0. && g_1 <= 0.))
          result = law.mean_pressure(-g_0, -g_1);
        else if (g_0 < 0. || g_1 < 0.)
        {
          // The spring is closed at one end only.
          const double change = g_0 - g_1;
          const double d_0 = std::max(0., -g_0), d_1 = std::max(0., -g_1);
          result.value = (law.energy(d_1) - law.energy(d_0)) / change;
          result.derivative =
            ((d_1 > 0. ? law.pressure(d_1).value : 0.) - result.value) / change;
        }
        result.derivative = -result.derivative;
        return result;
      }
    } // namespace


    struct StepTractions::Gaps
    {
      /// At the beginning and the end of the step [m].
      double begin = 0., end = 0.;
      /// Whether the first follows from the gap at the end and the motion of the faces; whether the last
      /// follows from the first and that motion; and whether the energy of the spring is lost.
      bool begin_moves = false, is_followed = false, is_lost = false;
    };


    StepTractions::StepTractions(const ContactSurface &surface,
                                 const StepStates     &states,
                                 const PointProjector &projector,
                                 const Tractions      &tractions)
      : surface(&surface)
      , states(&states)
      , projector(&projector)
      , tractions(&tractions)
    {
    }


    StepTractions::PointEnd
    StepTractions::find_end(ContactPoint &point, PointData &fixed) const
    {
      const double reach = projector->search_reach();
      fixed.dilation     = Dilation();
      fixed.new_slip     = 0.;
      if (fixed.has_angle && point.weight == 0.)
      {
        fixed.master_end = invalid_index;
        fixed.gap_end    = reach;
      }
      else
      {
        const ContactSurface::Place slave = surface->place(point.edge, point.s);
        const ContactProjection     projection =
          projector->project_end(point, fixed, slave);
        fixed.master_end       = projection.master;
        fixed.t_end            = projection.t;
        fixed.normal_end       = projection.normal;
        fixed.dilation.opening = opening_before(point, fixed);
        if (fixed.master_begin != invalid_index &&
            projection.master != invalid_index &&
            goes_on(*surface, fixed.master_begin, projection.master))
          fixed.dilation =
            tractions->find_dilation(point, fixed, slave, projection);
        fixed.gap_end = projection.master == invalid_index
                          ? reach
                          : projection.gap - fixed.dilation.opening;
      }
      // These values hold if there is no contact in the middle of the step.
      fixed.shear_work = fixed.normal_loss = 0.;
      fixed.offset_end                     = std::min(0., fixed.gap_end);
      if (fixed.gap_begin < fixed.offset || fixed.gap_end < fixed.offset ||
          point.is_bonded)
        return {/* is_near = */ true, /* has_opened = */ false};
      const bool has_opened = point.state != ContactState::open;
      set_open(point);
      return {/* is_near = */ false, has_opened};
    }


    ContactTraction
    StepTractions::find(const ContactProjection &projection,
                        ContactPoint            &point,
                        PointData               &fixed) const
    {
      const bool      was_slipping = point.state == ContactState::slip;
      ContactTraction traction;
      set_open(point);
      if (projection.master == invalid_index || point.weight == 0.)
      {
        if (fixed.law != nullptr)
          fixed.normal_loss =
            point.weight *
            fixed.law->energy(std::max(0., fixed.offset - fixed.gap_begin));
        return traction;
      }
      ContactSurface::Weights master;
      surface->weights(projection.master, projection.t, master);
      states->add_motion(point.edge, fixed.weights, 1., traction.motion);
      states->add_motion(projection.master, master, -1., traction.motion);
      find_pressure(traction.motion * projection.normal,
                    point,
                    fixed,
                    traction);
      if (point.pressure > 0. || point.is_bonded)
      {
        point.state = ContactState::slip;
        if (fixed.law->transmits_shear())
          find_shear(projection, was_slipping, point, fixed, traction);
      }
      return traction;
    }


    /// A master that is found within the step, or that the point reaches round a corner, pushes back
    /// as far as the point moves from now on. The energy stored against a master that is left behind
    /// is lost. So new masters do not create energy.
    StepTractions::Gaps
    StepTractions::find_gaps(const double motion,
                             const double opening,
                             PointData   &fixed) const
    {
      Gaps gaps;
      gaps.begin        = fixed.gap_begin - fixed.offset;
      gaps.end          = fixed.gap_end - fixed.offset;
      const bool is_new = fixed.master_begin == invalid_index;
      if (is_new)
        gaps.begin = std::max(0., fixed.gap_end - motion);
      gaps.begin_moves = is_new && gaps.begin > 0.;
      fixed.offset_end = is_new ? 0. : fixed.offset;
      gaps.is_lost     = fixed.master_end == invalid_index;
      if (!gaps.is_lost && std::abs(gaps.end - gaps.begin - motion) >
                             0.5 * std::abs(opening) + least_motion())
      {
        gaps.is_followed = true;
        gaps.end         = gaps.begin + motion;
        gaps.is_lost     = fixed.gap_end > gaps.end;
        fixed.offset_end =
          std::min(0., fixed.gap_end - (gaps.is_lost ? 0. : gaps.end));
      }
      if (gaps.is_lost)
        gaps.end = 0.;
      return gaps;
    }


    void
    StepTractions::find_pressure(const double     opening,
                                 ContactPoint    &point,
                                 PointData       &fixed,
                                 ContactTraction &traction) const
    {
      const ContactLaw &law = *fixed.law;
      // Gaps do not include the opening of this step by dilation.
      const double least = least_motion();
      const double rise = fixed.dilation.opening - opening_before(point, fixed);
      const double motion = opening - rise;
      const Gaps   gaps   = find_gaps(motion, opening, fixed);
      const double g_0 = gaps.begin, g_1 = gaps.end;

      const ContactLaw::Response mean =
        mean_pressure(law, point.is_bonded, g_0, g_1);
      double derivative = mean.derivative, by_begin = 0.;
      point.pressure = mean.value;
      if (gaps.begin_moves)
        by_begin = mean_pressure(law, point.is_bonded, g_1, g_0).derivative;
      if (gaps.is_lost)
      {
        fixed.normal_loss = point.weight * law.energy(std::max(0., -g_0));
        point.pressure = derivative = by_begin = 0.;
      }
      const double spring = point.pressure;
      if (spring > 0. && law.normal_damping > 0.)
      {
        const double c = law.normal_damping / states->length();
        point.pressure += c * (std::max(0., -g_1) - std::max(0., -g_0));
        derivative -= g_1 < 0. ? c : 0.;
      }
      if (!point.is_bonded && point.pressure <= 0.)
        point.pressure = derivative = by_begin = 0.;

      // The gap of curved or turning faces does not change exactly by the normal motion; the factor
      // corrects that. Where nothing moves the ratio of both would be rounding.
      const double square = opening * opening + least * least;
      const double more   = (g_1 - g_0 - motion) * opening / square;
      const double factor = 1. + std::min(1., std::max(-0.5, more));

      // Derivatives of g_0 and g_1 by the gap at the end and by the normal motion.
      const double gap_by_opening =
        gaps.is_followed && !gaps.begin_moves ? 1. : 0.;
      const double gap_by_gap =
        gaps.is_followed && !gaps.begin_moves ? 0. : fixed.dilation.by_gap;
      traction.pressure_by_gap =
        factor * (derivative + (gaps.begin_moves ? by_begin : 0.)) * gap_by_gap;
      traction.pressure_by_opening =
        factor *
        (derivative * gap_by_opening - (gaps.begin_moves ? by_begin : 0.));
      if (factor == 1. + more && !gaps.begin_moves)
      {
        // Dilation changes the gap and the motion by the same amount.
        if (!gaps.is_followed)
          traction.pressure_by_gap += point.pressure * opening / square;
        traction.pressure_by_opening +=
          point.pressure *
          ((gap_by_opening - 1.) * opening / square +
           (g_1 - g_0 - motion) * (least * least - opening * opening) /
             (square * square));
      }
      traction.pressure_by_gap *= point.weight;
      traction.pressure_by_opening *= point.weight;
      // The work of dilation against the pressure is a part of the work of friction.
      fixed.normal_loss +=
        point.weight *
        (factor * (spring - point.pressure) * opening - spring * rise);
      // For faces that turn and hardly move along the normal, the factor is limited. Spring energy
      // that the force does not return is then lost, or appears as an error in the energy balance.
      fixed.normal_loss +=
        point.weight *
        std::max(0., spring * (g_1 - g_0 + rise - factor * opening));
      point.pressure *= factor;
      traction.pressure = point.weight * point.pressure;
      traction.pressure_by_slip =
        2. * point.weight * derivative * fixed.dilation.by_slip;
      traction.normal_distance = fixed.gap_end + fixed.dilation.opening;
      traction.by_turning      = 0.5 * traction.pressure / least;
    }


    /// Shear of a point in the step: the mean of the spring's shear before and after the slip
    /// @f$s@f$, and that of the dashpot, @f$q = q_0 + \epsilon_t s/2 + c_t s/h@f$. Its work q s is
    /// the change of q_0^2 / (2 eps_t) plus the dissipation of the dashpot, however faces turn in
    /// the step. The anchor determines q_0 of the next step.
    void
    StepTractions::find_shear(const ContactProjection &projection,
                              const bool               was_slipping,
                              ContactPoint            &point,
                              PointData               &fixed,
                              ContactTraction         &traction) const
    {
      const ContactLaw &law    = *fixed.law;
      const double      length = projection.place.a.norm();
      const double      slip = (traction.motion * projection.place.a) / length;
      const bool        is_coming =
        fixed.master_begin == invalid_index ||
        !goes_on(*surface, fixed.master_begin, projection.master) ||
        (fixed.gap_begin >= fixed.offset && !point.is_bonded);
      if (is_coming)
      {
        // The anchor is where the point was at the beginning of the step.
        point.stick_edge = projection.master;
        point.stick_t =
          projection.t +
          (initial_shear(point, fixed) / law.shear_spring() - 0.5 * slip) /
            length;
      }
      const double by_half_slip =
        law.shear_spring() + 2. * law.shear_damping / states->length();
      tractions->find_shear((is_coming ? 0. : fixed.shear_begin) +
                              0.5 * by_half_slip * slip,
                            by_half_slip,
                            was_slipping,
                            point,
                            fixed,
                            traction);
      // That was the middle of the step, where half of the slip is reached.
      if (law.depends_on_slip())
        fixed.new_slip *= 2.;
      traction.shear_by_half_slip = traction.shear_stiffness;
      traction.shear_stiffness    = 0.;
      fixed.shear_work            = traction.shear * slip;
    }


    void
    StepTractions::differentiate(const PointData         &fixed,
                                 const ContactProjection &projection,
                                 const ContactKinematics &f,
                                 Changes                 &changes,
                                 ContactTraction         &traction) const
    {
      const auto covers = surface->covers(projection.master);

      // Derivative by the displacements at the end, where the faces have turned since the middle of
      // the step.
      unsigned int master = projection.master;
      double       t      = projection.t;
      Tensor<1, 2> normal = f.normal;
      if (fixed.master_end != invalid_index)
      {
        const auto others = surface->covers(fixed.master_end);
        if (std::equal(
              covers.begin(), covers.end(), others.begin(), others.end()))
        {
          master = fixed.master_end;
          t      = fixed.t_end;
          normal = fixed.normal_end;
        }
      }
      ContactSurface::Weights weights;
      surface->weights(master, t, weights);
      for (unsigned int k = 0; k < f.n; ++k)
        changes.pressure[k] =
          traction.pressure_by_gap * normal[component_of(k)] *
          (k < 2 * f.n_slave ? fixed.weights.w[cover_of(k)]
                             : -weights.w[cover_of(k) - f.n_slave]);

      // Derivatives of motion . n and motion . tau in the middle of the step. There n, tau and the
      // foot change half as much as at the end.
      Tensor<1, 2> stretch;
      surface->weights(projection.master, projection.t, weights);
      for (unsigned int i = 0; i < weights.n; ++i)
        stretch -= weights.dw[i] * states->change(covers[i]);
      const double along          = traction.motion * f.tangent,
                   across         = traction.motion * f.normal;
      const double by_foot_along  = stretch * f.tangent,
                   by_foot_across = stretch * f.normal;
      for (unsigned int k = 0; k < f.n; ++k)
      {
        changes.pressure[k] +=
          traction.pressure_by_opening *
          (f.N[k] - 0.5 * along * f.C[k] + 0.5 * by_foot_across * f.D[k]);
        changes.half_slip[k] =
          f.T[k] + 0.5 * across * f.C[k] + 0.5 * by_foot_along * f.D[k];
      }

      for (unsigned int k = 0; k < f.n; ++k)
        changes.pressure[k] *= 2.;
      traction.pressure_change  = changes.pressure;
      traction.half_slip_change = changes.half_slip;
    }


  } // namespace internal
} // namespace NMM
