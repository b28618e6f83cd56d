// Contact in time steps: forces that conserve energy.
#include <nmm/contact/assembly/time_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/contact.h>
#include <mechanics/nodal_values.h>
#include <utility>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

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


  ContactTimeStep::ContactTimeStep(Contact &contact)
    : contact(&contact)
    , data(contact.data.get())
  {
  }


  void
  ContactTimeStep::begin(const Vector &u, const double time)
  {
    Data &d = *data;
    d.enter(Data::Stage::step_begun, d.is_within_step());
    if (!d.is_moving())
      d.problem = d.is_geometry_frozen()
                    ? Data::Problem::motion_of_frozen_geometry
                    : Data::Problem::motion;
    d.matrix.begin_step();
    d.step.nodal_expected.clear();
    d.step.time_begin = time;
    contact->set_time(time);
    // Points that have moved between the last step and this one do not dilate.
    d.slip_is_frozen = true;
    contact->assemble(u, false);
    d.slip_is_frozen = false;
    if (d.is_geometry_frozen())
      d.keep_cohesion();
    if (!d.memory.has_accepted_state)
      d.memory.energies_of_pairs =
        sum_energies(d.closed_springs(), d.communicator);
    d.keep_energies();
    d.step.end = d.step.middle = d.surface->state();
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      d.point_data[q].gap_begin =
        d.points[q].gap - opening_before(d.points[q], d.point_data[q]);
      d.point_data[q].master_begin = d.points[q].master;
      d.point_data[q].shear_begin  = d.points[q].shear;
      // The anchor of a point that slides or has no shear follows from its shear. Anchors that are
      // interpolated between those of other points may be far away.
      ContactPoint &point = d.points[q];
      if (!d.transmits_shear || point.master == invalid_index ||
          point.state == ContactState::stick || point.is_bonded)
        continue;
      if (point.state == ContactState::open)
        point.shear = d.point_data[q].shear_begin = 0.;
      const double length = d.surface->place(point.master, point.t).a.norm();
      point.stick_edge    = point.master;
      point.stick_t       = point.t;
      point.stick_t -= (point.shear - initial_shear(point, d.point_data[q])) /
                       (d.point_data[q].law->shear_spring() * length);
    }
    d.stage = Data::Stage::step_begun;
  }


  void
  Contact::Data::keep_cohesion()
  {
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      PointData &fixed     = point_data[q];
      fixed.keeps_cohesion = true;
      if (fixed.law != nullptr && !fixed.law->depends_on_slip())
        fixed.kept_cohesion = fixed.law->cohesion_at(points[q].pressure).value;
    }
  }


  Tensor<1, 2>
  Contact::Data::relative_motion(const unsigned int       q,
                                 const ContactProjection &projection) const
  {
    const unsigned int n_obstacles = step.obstacle_changes.size();
    Tensor<1, 2>       motion;
    const auto         add = [&](const unsigned int                  edge,
                         const ContactSurface::WeightValues &f,
                         const double                        sign) {
      if (surface->is_rigid(edge))
        motion +=
          sign * step.obstacle_changes[surface->edges()[edge].body -
                                       (surface->n_bodies() - n_obstacles)];
      const auto covers = surface->covers(edge);
      for (unsigned int i = 0; i < f.n; ++i)
        motion += sign * f.w[i] *
                  (step.end.nodal[covers[i]] - step.nodal_begin[covers[i]]);
    };
    ContactSurface::Weights master;
    surface->weights(projection.master, projection.t, master);
    add(points[q].edge, point_data[q].weights, 1.);
    add(projection.master, master, -1.);
    return motion;
  }


  void
  Contact::Data::find_pressure_between(const unsigned int q,
                                       const double       opening,
                                       ContactTraction   &traction)
  {
    ContactPoint     &point = points[q];
    PointData        &fixed = point_data[q];
    const ContactLaw &law   = *fixed.law;
    // A master that is found within the step, or that the point reaches round a corner, pushes back
    // as far as the point moves from now on. The energy stored against a master that is left behind
    // is lost. So new masters do not create energy. Gaps here do not include the opening of this
    // step by dilation.
    const double least  = least_motion();
    const double rise   = fixed.dilation.opening - opening_before(point, fixed);
    const double motion = opening - rise;
    double       g_0    = fixed.gap_begin - fixed.offset;
    double       g_1    = fixed.gap_end - fixed.offset;
    const bool   is_new = fixed.master_begin == invalid_index;
    if (is_new)
      g_0 = std::max(0., fixed.gap_end - motion);
    const bool begin_moves = is_new && g_0 > 0.;
    bool       is_followed = false;
    fixed.offset_end       = is_new ? 0. : fixed.offset;
    bool is_lost           = fixed.master_end == invalid_index;
    if (!is_lost &&
        std::abs(g_1 - g_0 - motion) > 0.5 * std::abs(opening) + least)
    {
      is_followed      = true;
      g_1              = g_0 + motion;
      fixed.offset_end = std::min(0., fixed.gap_end - g_1);
      is_lost          = fixed.gap_end > g_1;
      if (is_lost)
        fixed.offset_end = std::min(0., fixed.gap_end);
    }
    if (is_lost)
      g_1 = 0.;

    const ContactLaw::Response mean =
      mean_pressure(law, point.is_bonded, g_0, g_1);
    double derivative = mean.derivative, by_begin = 0.;
    point.pressure = mean.value;
    if (begin_moves)
      by_begin = mean_pressure(law, point.is_bonded, g_1, g_0).derivative;
    if (is_lost)
    {
      fixed.normal_loss = point.weight * law.energy(std::max(0., -g_0));
      point.pressure = derivative = by_begin = 0.;
    }
    const double spring = point.pressure;
    if (spring > 0. && law.normal_damping > 0.)
    {
      const double c = law.normal_damping / step.length;
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
    const double gap_by_opening = is_followed && !begin_moves ? 1. : 0.;
    const double gap_by_gap =
      is_followed && !begin_moves ? 0. : fixed.dilation.by_gap;
    fixed.pressure_by_gap =
      factor * (derivative + (begin_moves ? by_begin : 0.)) * gap_by_gap;
    fixed.pressure_by_opening =
      factor * (derivative * gap_by_opening - (begin_moves ? by_begin : 0.));
    if (factor == 1. + more && !begin_moves)
    {
      // Dilation changes the gap and the motion by the same amount.
      if (!is_followed)
        fixed.pressure_by_gap += point.pressure * opening / square;
      fixed.pressure_by_opening +=
        point.pressure *
        ((gap_by_opening - 1.) * opening / square +
         (g_1 - g_0 - motion) * (least * least - opening * opening) /
           (square * square));
    }
    fixed.pressure_by_gap *= point.weight;
    fixed.pressure_by_opening *= point.weight;
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
  }


  void
  Contact::Data::differentiate_step(const unsigned int       q,
                                    const ContactProjection &projection,
                                    const ContactKinematics &f,
                                    double                  *pressure_change,
                                    double *half_slip_change) const
  {
    const PointData &fixed  = point_data[q];
    const auto       covers = surface->covers(projection.master);

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
      pressure_change[k] =
        fixed.pressure_by_gap * normal[component_of(k)] *
        (k < 2 * f.n_slave ? fixed.weights.w[cover_of(k)]
                           : -weights.w[cover_of(k) - f.n_slave]);

    // Derivatives of motion . n and motion . tau in the middle of the step. There n, tau and the
    // foot change half as much as at the end.
    const Tensor<1, 2> motion = relative_motion(q, projection);
    Tensor<1, 2>       stretch;
    surface->weights(projection.master, projection.t, weights);
    for (unsigned int i = 0; i < weights.n; ++i)
      stretch -= weights.dw[i] *
                 (step.end.nodal[covers[i]] - step.nodal_begin[covers[i]]);
    const double along = motion * f.tangent, across = motion * f.normal;
    const double by_foot_along  = stretch * f.tangent,
                 by_foot_across = stretch * f.normal;
    for (unsigned int k = 0; k < f.n; ++k)
    {
      pressure_change[k] +=
        fixed.pressure_by_opening *
        (f.N[k] - 0.5 * along * f.C[k] + 0.5 * by_foot_across * f.D[k]);
      half_slip_change[k] =
        f.T[k] + 0.5 * across * f.C[k] + 0.5 * by_foot_along * f.D[k];
    }

    for (unsigned int k = 0; k < f.n; ++k)
      pressure_change[k] *= 2.;
  }


  /// Shear of a point in the step: the mean of the spring's shear before and after the slip
  /// @f$s@f$, and that of the dashpot, @f$q = q_0 + \epsilon_t s/2 + c_t s/h@f$. Its work q s is
  /// the change of q_0^2 / (2 eps_t) plus the dissipation of the dashpot, however faces turn in
  /// the step. The anchor determines q_0 of the next step.
  void
  Contact::Data::find_shear_between(const unsigned int       q,
                                    const ContactProjection &projection,
                                    const Tensor<1, 2>      &motion,
                                    const bool               was_slipping,
                                    ContactTraction         &traction)
  {
    ContactPoint     &point  = points[q];
    PointData        &fixed  = point_data[q];
    const ContactLaw &law    = *fixed.law;
    const double      length = projection.place.a.norm();
    const double      slip   = (motion * projection.place.a) / length;
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
      law.shear_spring() + 2. * law.shear_damping / step.length;
    find_shear(q,
               (is_coming ? 0. : fixed.shear_begin) + 0.5 * by_half_slip * slip,
               by_half_slip,
               was_slipping,
               traction);
    // That was the middle of the step, where half of the slip is reached.
    if (law.depends_on_slip())
      fixed.new_slip *= 2.;
    traction.shear_by_half_slip = traction.shear_stiffness;
    traction.shear_stiffness    = 0.;
    fixed.shear_work            = traction.shear * slip;
  }


  Contact::Data::PointEnd
  Contact::Data::find_end(const unsigned int q)
  {
    ContactPoint &point = points[q];
    PointData    &fixed = point_data[q];
    fixed.dilation      = Dilation();
    fixed.new_slip      = 0.;
    if (fixed.has_angle && point.weight == 0.)
    {
      fixed.master_end = invalid_index;
      fixed.gap_end    = reach;
    }
    else
    {
      const ContactSurface::Place slave = surface->place(point.edge, point.s);
      const ContactProjection     projection =
        projector.find_master(point, fixed, slave);
      fixed.master_end       = projection.master;
      fixed.t_end            = projection.t;
      fixed.normal_end       = projection.normal;
      fixed.dilation.opening = opening_before(point, fixed);
      if (fixed.master_begin != invalid_index &&
          projection.master != invalid_index &&
          goes_on(*surface, fixed.master_begin, projection.master))
        fixed.dilation = find_dilation(q, slave, projection);
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
    point.pressure = point.shear = 0.;
    point.state                  = ContactState::open;
    return {/* is_near = */ false, has_opened};
  }


  void
  Contact::Data::evaluate_between(const unsigned int q,
                                  const bool         with_tangent,
                                  PointForces       &forces)
  {
    forces.clear();
    ContactPoint      &point  = points[q];
    PointData         &fixed  = point_data[q];
    const ContactState before = point.state;
    point.pressure = point.shear        = 0.;
    point.state                         = ContactState::open;
    const ContactSurface::Place slave   = surface->place(point.edge, point.s);
    forces.projection                   = project(q, slave);
    const ContactProjection &projection = forces.projection;
    ContactTraction          traction;
    const double stored = std::max(0., fixed.offset - fixed.gap_begin);
    if (projection.master == invalid_index || point.weight == 0.)
    {
      if (fixed.law != nullptr)
        fixed.normal_loss = points[q].weight * fixed.law->energy(stored);
    }
    else
    {
      const Tensor<1, 2> motion = relative_motion(q, projection);
      find_pressure_between(q, motion * projection.normal, traction);
      if (point.pressure > 0. || point.is_bonded)
      {
        point.state = ContactState::slip;
        if (fixed.law->transmits_shear())
          find_shear_between(
            q, projection, motion, before == ContactState::slip, traction);
      }
    }
    forces.has_changed = before != point.state;
    forces.is_near     = point.state != ContactState::open;
    if (forces.is_near)
      find_forces(q, traction, with_tangent, forces);
  }


  void
  Contact::Data::set_step_states(const Vector &end)
  {
    std::vector<Tensor<1, 2>> &at_end = step.end.nodal;
    read_nodal_values(surface->cover_system(), end, chosen.covers(), at_end);
    chosen.for_each_cover(at_end.size(), [&](const unsigned int k) {
      step.middle.nodal[k] = 0.5 * (step.nodal_begin[k] + at_end[k]);
    });
    update_faces();
  }


  void
  Contact::Data::update_faces()
  {
    surface->set_state(step.end);
    chosen.for_each_edge([&](const unsigned int e) {
      surface->update(step.end, e);
      surface->update(step.middle, e);
    });
  }


  void
  Contact::Data::move_as_expected()
  {
    chosen.for_each_cover(step.nodal_expected.size(),
                          [&](const unsigned int k) {
                            step.end.nodal[k] = step.nodal_expected[k];
                          });
    update_faces();
  }


  void
  Contact::Data::find_ends()
  {
    step.near_points.clear();
    const std::vector<unsigned int> &numbers = chosen_points();
    for_each_in_order<PointEnd>(
      0,
      numbers.size(),
      [&](const unsigned int i, PointEnd &end) { end = find_end(numbers[i]); },
      [&](const unsigned int i, const PointEnd &end) {
        sums.add_changes(end.has_opened);
        if (end.is_near)
          step.near_points.push_back(numbers[i]);
      });
  }


  std::vector<unsigned int>
  Contact::Data::slaves_of(const std::vector<unsigned int> &numbers) const
  {
    std::vector<unsigned int> result;
    result.reserve(numbers.size());
    for (const unsigned int q : numbers)
      result.push_back(point_data[q].slave);
    return result;
  }


  void
  Contact::Data::couple_expected()
  {
    find_ends();
    matrix.couple_step(slaves_of(step.near_points));
  }


  std::vector<bool>
  ContactTimeStep::pressed_bodies() const
  {
    const Data       &d     = *data;
    const auto       &edges = d.surface->edges();
    std::vector<bool> result(d.surface->n_bodies(), false);
    for (const ContactPoint &point : d.points)
      if (point.pressure > 0.)
        result[edges[point.edge].body] = result[edges[point.master].body] =
          true;
    return result;
  }


  void
  ContactTimeStep::expect(const Vector &u)
  {
    read_nodal_values(data->surface->cover_system(),
                      u,
                      data->step.nodal_expected);
  }


  void
  ContactTimeStep::assemble(const Vector &end,
                            const double  time,
                            const bool    with_tangent,
                            BodyMatrix   *body_matrix)
  {
    Data &d = *data;
    d.enter(Data::Stage::step_assembled,
            d.stage == Data::Stage::step_begun ||
              d.stage == Data::Stage::step_assembled ||
              d.stage == Data::Stage::step_ended);
    d.sums.begin();
    if (d.is_idle)
    {
      d.matrix.clear_forces();
      return;
    }
    const unsigned int n_obstacles = d.surface->obstacles().size();
    d.step.obstacle_changes.resize(n_obstacles);
    d.surface->set_time(time);
    for (unsigned int i = 0; i < n_obstacles; ++i)
      d.step.obstacle_changes[i] = d.surface->obstacle_displacement(i);
    d.step.length          = time - d.step.time_begin;
    const bool on_one_rank = Parallel::n_mpi_processes(d.communicator) == 1;
    const bool is_sparse   = with_tangent && body_matrix == nullptr;
    const bool is_first =
      is_sparse && on_one_rank && !d.matrix.is_step_coupled();
    d.problem = Data::Problem::conserving_motion;
    d.set_admitted_depth();
    if (is_first)
    {
      if (d.step.nodal_expected.empty())
        d.set_step_states(end);
      else
        d.move_as_expected();
      d.couple_expected();
    }
    d.set_step_states(end);
    d.find_ends();

    d.surface->set_time(d.step.time_begin);
    for (unsigned int i = 0; i < n_obstacles; ++i)
      d.step.obstacle_changes[i] -= d.surface->obstacle_displacement(i);
    d.surface->set_time(d.step.time_begin, time);
    d.surface->set_state(d.step.middle);
    if (is_sparse && on_one_rank)
      d.matrix.couple(d.slaves_of(d.step.near_points));
    else if (is_sparse)
      d.matrix.couple_all();
    d.matrix.begin_assembly(with_tangent, body_matrix);
    d.add_points(d.step.near_points,
                 [&](const unsigned int q, Data::PointForces &forces) {
                   d.evaluate_between(q, with_tangent, forces);
                 });
    d.matrix.end_assembly();
    d.sums.end(d.points.size(), d.is_between());
  }


  void
  ContactTimeStep::restrict_to(const BlockSelection &blocks)
  {
    data->chosen.select(blocks);
    data->list_points_of_bodies();
  }


  double
  ContactTimeStep::work_of_obstacles(const double time_begin,
                                     const double time_end)
  {
    Data              &d      = *data;
    const unsigned int n      = d.surface->obstacles().size();
    const unsigned int first  = d.surface->n_bodies() - n;
    double             work   = 0.;
    bool               is_any = false;
    d.step.obstacle_changes.resize(n);
    d.surface->set_time(time_end);
    for (unsigned int i = 0; i < n; ++i)
      d.step.obstacle_changes[i] = d.surface->obstacle_displacement(i);
    d.surface->set_time(time_begin);
    for (unsigned int i = 0; i < n; ++i)
    {
      d.step.obstacle_changes[i] -= d.surface->obstacle_displacement(i);
      is_any = is_any || d.step.obstacle_changes[i].norm_square() > 0.;
    }
    d.surface->set_time(d.time);
    if (!is_any)
      return 0.;
    for (const ContactPoint &point : d.points)
      if (point.state != ContactState::open &&
          (d.surface->is_rigid(point.master) ||
           d.surface->is_rigid(point.edge)))
      {
        const bool         is_master = d.surface->is_rigid(point.master);
        const double       sign      = is_master ? 1. : -1.;
        const unsigned int edge      = is_master ? point.master : point.edge;
        const Tensor<1, 2> tangent =
          dealii::Point<2>(-point.normal[1], point.normal[0]);
        work += sign * point.weight *
                (point.pressure * point.normal - point.shear * tangent) *
                d.step.obstacle_changes[d.surface->edges()[edge].body - first];
      }
    return Parallel::sum(work, d.communicator);
  }
} // namespace NMM
