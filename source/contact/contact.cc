#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <contact/contact.h>
#include <mechanics/nodal_values.h>
#include <utility>

namespace NMM
{
  using namespace internal;
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  Contact::Data::Data(ContactSurface                          &surface,
                      const dealii::AffineConstraints<double> &constraints,
                      const ContactParameters                 &parameters_in)
    : surface(&surface)
    , parameters(parameters_in)
    , communicator(surface.cover_system().communicator())
    , search(surface,
             parameters_in.slave_priority,
             parameters_in.integration == ContactIntegration::points)
    , laws((parameters.check(), surface), parameters)
    , transmits_shear(parameters.transmit_shear())
    , multipliers(surface, parameters.penetration_tolerance)
    , maker(surface, search, parameters, memory, multipliers)
    , projector(surface, search, maker, memory, parameters)
    , chosen(surface)
    , matrix(surface, constraints, search, memory.stick_places, chosen)
    , sums(surface, search, maker)
  {
    if (parameters.reach == 0.)
    {
      double longest = 0.;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
        if (!surface.is_rigid(e))
          longest = std::max(longest, surface.edges()[e].length);
      parameters.reach = 0.1 * longest;
    }
    AssertThrow(parameters.initial_stress.empty() ||
                  parameters.initial_stress.size() == surface.edges().size(),
                InputError("there are initial stresses of " +
                             std::to_string(parameters.initial_stress.size()) +
                             " faces, but there are " +
                             std::to_string(surface.edges().size()),
                           "the contact parameters",
                           "take those of initial_stress_at_faces()"));
    largest_initial_closure = bound_initial_closure();
    nodal.resize(surface.cover_system().n_covers());
    surface.set_displacements(&nodal);
  }


  double
  Contact::Data::bound_initial_closure() const
  {
    double pressure = 0.;
    for (unsigned int e = 0; e < parameters.initial_stress.size(); ++e)
      for (const double s : {0., 0.5, 1.})
      {
        const ContactSurface::Place place = surface->reference_place(e, s);
        const Tensor<1, 2>          n     = place.normal();
        pressure =
          std::max(pressure,
                   -n * (parameters.initial_stress[e].at(place.x) * n));
      }
    if (pressure == 0.)
      return 0.;
    double closure = parameters.law->penetration(pressure);
    for (const ContactPair &pair : parameters.pairs)
      closure = std::max(closure, pair.law->penetration(pressure));
    return std::min(closure, parameters.reach);
  }


  Contact::Contact(ContactSurface                          &surface,
                   const dealii::AffineConstraints<double> &constraints,
                   const ContactParameters                 &parameters)
    : data(std::make_unique<Data>(surface, constraints, parameters))
  {
  }


  Contact::~Contact() = default;


  void
  Contact::Data::move_to(const Vector &u)
  {
    read_nodal_values(surface->cover_system(), u, nodal);
    surface->set_displacements(&nodal);
  }


  void
  Contact::set_time(const double time)
  {
    data->time = time;
    data->surface->set_time(time);
  }


  void
  Contact::freeze_geometry(const bool is_frozen)
  {
    using Problem = Data::Problem;
    if (data->is_conserving())
      return;
    if (is_frozen && !data->is_geometry_frozen())
      data->stage = Data::Stage::created;
    for (Data::PointData &fixed : data->point_data)
    {
      fixed.keeps_cohesion = false;
      fixed.kept_cohesion  = 0.;
    }
    if (data->is_moving())
      data->problem =
        is_frozen ? Problem::motion_of_frozen_geometry : Problem::motion;
    else
      data->problem =
        is_frozen ? Problem::statics_of_frozen_geometry : Problem::statics;
  }


  void
  Contact::detect(const Vector &u, const std::vector<double> &least_reaches)
  {
    Data &d = *data;
    d.stage = Data::Stage::detected;
    d.move_to(u);
    d.step.nodal_begin   = d.nodal;
    d.step.time_detected = d.time;
    if (d.is_moving())
      d.multipliers.forget_stiffening();
    // What touches is found again, however deep it is and however little moves in the step.
    const double least =
      0.5 * std::max(d.parameters.reach, d.memory.touching_reach);
    // Faces that have parted by dilation are still in contact, and so are those that part by less
    // than the initial stress has closed them.
    const double parted =
      0.5 * (d.largest_opening() + d.largest_initial_closure);
    d.reaches.assign(d.surface->n_bodies(), least);
    for (unsigned int body = 0; body < least_reaches.size(); ++body)
      d.reaches[body] = std::max(least, least_reaches[body]);
    d.reach = 2. * *std::max_element(d.reaches.begin(), d.reaches.end());
    std::vector<double> searched = d.reaches;
    for (double &reach : searched)
      reach += parted;
    if (d.search.update(searched))
    {
      d.memory.searched_nodal   = d.nodal;
      d.memory.searched_time    = d.time;
      d.memory.searched_reaches = searched;
    }
    d.search.begin(!d.memory.has_accepted_state
                     ? ContactSearch::Begin::reference
                     : ContactSearch::Begin::unchanged);
    PointSet made = d.maker.make(/* with_faces_beside = */ d.is_conserving());
    d.points      = std::move(made.points);
    d.point_data  = std::move(made.data);
    d.projector.begin_step(d.reach, std::move(made.faces_beside));
    d.set_admitted_depth();
    if (d.is_geometry_frozen())
    {
      d.frozen.assign(d.points.size(), Data::FrozenPoint());
    }
    d.is_idle =
      Parallel::max(d.search.slaves().empty() ? 0U : 1U, d.communicator) == 0U;
    if (!d.is_idle)
      d.matrix.update_candidates();
    d.chosen.clear_points();
    d.list_points_of_bodies();
  }


  void
  Contact::Data::set_admitted_depth()
  {
    if (is_conserving())
      projector.admit_any_depth();
    else
      projector.bound_new_contact();
  }


  bool
  Contact::is_detected() const
  {
    return data->stage != Data::Stage::created;
  }


  bool
  Contact::is_idle() const
  {
    return data->is_idle;
  }


  double
  Contact::Data::largest_opening() const
  {
    if (!laws.has_dilation())
      return 0.;
    double slip = 0.;
    memory.stick_places.for_each(
      [&](unsigned int, const std::vector<StickPlace> &places) {
        for (const StickPlace &place : places)
          slip = std::max(slip, place.slip);
      });
    slip           = Parallel::max(slip, communicator);
    double opening = parameters.law->opening(slip);
    for (const ContactPair &pair : parameters.pairs)
      opening = std::max(opening, pair.law->opening(slip));
    return opening;
  }


  const std::vector<unsigned int> &
  Contact::Data::chosen_points()
  {
    listed_points.clear();
    chosen.for_each_point(points.size(), [&](const unsigned int q) {
      listed_points.push_back(q);
    });
    return listed_points;
  }


  void
  Contact::Data::evaluate(const unsigned int q,
                          const bool         with_tangent,
                          PointForces       &forces)
  {
    forces.clear();
    ContactPoint               &point  = points[q];
    const ContactState          before = point.state;
    const ContactSurface::Place slave  = surface->place(point.edge, point.s);
    forces.projection =
      is_geometry_frozen() ? project_frozen(q, slave) : project(q, slave);
    if (forces.projection.master == invalid_index || point.weight == 0.)
    {
      point.pressure = point.shear = 0.;
      point.state                  = ContactState::open;
      forces.has_changed           = before != point.state;
      return;
    }
    const ContactTraction traction =
      find_traction(q, slave, forces.projection, forces.energy);
    forces.has_changed = before != point.state;
    forces.is_near     = true;
    if (point.state != ContactState::open)
      find_forces(q, traction, with_tangent, forces);
  }


  void
  Contact::Data::find_forces(const unsigned int     q,
                             const ContactTraction &traction,
                             const bool             with_tangent,
                             PointForces           &forces) const
  {
    const ContactPoint      &point      = points[q];
    const PointData         &fixed      = point_data[q];
    const ContactProjection &projection = forces.projection;

    ContactSurface::Weights master, stick;
    surface->weights(projection.master, projection.t, master);
    const bool        with_friction = fixed.law->transmits_shear();
    ContactKinematics kinematics(fixed.weights,
                                 master,
                                 projection.place,
                                 projection.gap,
                                 with_friction || is_between());
    if (is_geometry_frozen())
      kinematics.freeze();
    const double sign =
      search.comes_first(point.edge, projection.master) ? 1. : -1.;
    forces.has_forces = true;
    forces.force      = sign * (traction.pressure * kinematics.normal -
                           traction.shear * kinematics.tangent);
    forces.rounding_square =
      std::pow(force_rounding(q, projection, traction), 2);

    ContactLocalSystem &local = forces.local;
    local.n_covers            = 0;
    local.append(surface->covers(point.edge));
    local.append(surface->covers(projection.master));
    // The anchor matters only if something depends on the distance from it. In a step only dilation
    // does.
    if (traction.shear_stiffness != 0. || traction.pressure_by_slip != 0.)
    {
      surface->weights(point.stick_edge, point.stick_t, stick);
      local.append(surface->covers(point.stick_edge));
    }
    local.clear();
    ContactTraction with_change = traction;
    double          pressure_change[ContactKinematics::max],
      half_slip_change[ContactKinematics::max];
    if (is_between() && with_tangent)
    {
      differentiate_step(
        q, projection, kinematics, pressure_change, half_slip_change);
      with_change.pressure_change  = pressure_change;
      with_change.half_slip_change = half_slip_change;
    }
    add_contact_point(kinematics,
                      with_change,
                      &fixed.weights,
                      with_friction ? &stick : nullptr,
                      with_tangent,
                      local);
  }


  void
  Contact::Data::take_point(const unsigned int q, PointForces &forces)
  {
    sums.add(points[q], point_data[q], forces, is_between());
    if (!forces.has_forces)
      return;
    matrix.add(forces.local);
  }


  double
  Contact::Data::force_rounding(const unsigned int       q,
                                const ContactProjection &projection,
                                const ContactTraction   &traction) const
  {
    // Relative rounding of a number, times the number of operations that a gap takes.
    constexpr double relative = 8. * std::numeric_limits<double>::epsilon();

    const ContactPoint &point = points[q];
    const PointData    &fixed = point_data[q];
    // In statics gaps are those of displacements, otherwise the ways from the ends of edges add to
    // them.
    const double size =
      is_moving()
        ? point.x.distance(surface->edges()[point.edge].start) +
            projection.place.x.way.norm()
        : surface->displacement(point.edge, point.s).norm() +
            surface->displacement(projection.master, projection.t).norm();
    double stiffness =
      (1. + std::abs(traction.shear_over_pressure)) *
        (traction.normal_stiffness + std::abs(traction.pressure_by_slip)) +
      traction.shear_stiffness + std::abs(traction.shear_by_half_slip);
    if (is_between())
      stiffness +=
        (1. + std::abs(traction.shear_over_pressure)) *
        (std::abs(fixed.pressure_by_gap) + std::abs(fixed.pressure_by_opening) +
         // see find_pressure_between()
         0.5 * traction.pressure / least_motion());
    return relative * size * stiffness;
  }


  void
  Contact::assemble(const Vector &u, const bool with_tangent)
  {
    Data &d = *data;
    d.enter(d.is_between() ? Data::Stage::step_ended : Data::Stage::assembled,
            d.stage != Data::Stage::created);
    d.sums.begin();
    if (d.is_idle)
    {
      d.matrix.clear_forces();
      return;
    }
    if (with_tangent)
      d.matrix.couple_all();
    d.move_to(u);
    // Motions with frozen geometry project points at the beginning of a step only.
    if (d.problem != Data::Problem::motion_of_frozen_geometry)
      d.set_admitted_depth();
    d.matrix.begin_assembly(with_tangent);
    d.add_points(d.chosen_points(),
                 [&](const unsigned int q, Data::PointForces &forces) {
                   d.evaluate(q, with_tangent, forces);
                 });
    d.matrix.end_assembly();
    d.sums.end(d.points.size(), d.is_between());
  }


  std::vector<double>
  Contact::motions(const Vector &from, const Vector &to)
  {
    Data &d = *data;
    d.move_to(to);
    const std::vector<ContactPosition> positions = d.search.positions();
    d.move_to(from);
    return d.search.distances(positions);
  }


  void
  Contact::Data::list_points_of_bodies()
  {
    if (!chosen.has_to_list_points())
      return;
    const unsigned int n = surface->n_bodies() - static_cast<unsigned int>(
                                                   surface->obstacles().size());
    const auto &edges = surface->edges();
    chosen.list_points(points.size(), [&](const auto &add) {
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        const unsigned int position = point_data[q].slave;
        const unsigned int slave    = edges[search.slaves()[position]].body;
        if (slave < n)
          add(q, slave);
        unsigned int last = slave;
        for (const unsigned int master : search.masters(position))
          if (edges[master].body < n && edges[master].body != last)
            add(q, last = edges[master].body);
      }
    });
  }


  const Contact::Vector &
  Contact::residual() const
  {
    return data->matrix.residual();
  }


  double
  Contact::force_rounding() const
  {
    return data->is_idle ? 0. : data->sums.rounding();
  }


  void
  Contact::add_to_tangent(const Matrix &other)
  {
    data->matrix.add_to_tangent(other);
  }


  const Contact::Matrix &
  Contact::tangent() const
  {
    return data->matrix.tangent();
  }


  Contact::Matrix &
  Contact::tangent()
  {
    return data->matrix.tangent();
  }


  unsigned int
  Contact::pattern_version() const
  {
    return data->matrix.pattern_version();
  }


  bool
  Contact::tangent_is_symmetric() const
  {
    return !data->transmits_shear;
  }


  const ContactReport &
  Contact::report() const
  {
    return data->sums.report();
  }


  const std::vector<ContactPoint> &
  Contact::points() const
  {
    return data->points;
  }


  const ContactParameters &
  Contact::parameters() const
  {
    return data->parameters;
  }


  const ContactSurface &
  Contact::surface() const
  {
    return *data->surface;
  }
} // namespace NMM
