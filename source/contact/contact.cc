#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <contact/contact_data.h>
#include <mechanics/nodal_values.h>

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
    , constraints(&constraints)
    , parameters(parameters_in)
    , communicator(surface.cover_system().communicator())
    , search(surface, parameters_in.body_ranks)
    , laws((parameters.check(), surface), parameters)
    , has_friction(parameters.has_friction())
    , corner_weight(corner_weights(surface))
  {
    lobatto_rule(parameters.n_points, rule_points, rule_weights);
    if (parameters.reach == 0.)
    {
      double longest = 0.;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
        if (!surface.is_rigid(e))
          longest = std::max(longest, surface.edges()[e].length);
      parameters.reach = 0.1 * longest;
    }
    if (parameters.penetration_tolerance > 0.)
    {
      multiplier_space = std::make_unique<MultiplierSpace>(surface);
      multipliers.assign(multiplier_space->size(), 0.);
    }
    residual.reinit(surface.cover_system().locally_owned_dofs(2), communicator);
    nodal.assign(2 * surface.cover_system().n_covers(), 0.);
    surface.set_displacements(&nodal);
  }


  Contact::Contact(ContactSurface                          &surface,
                   const dealii::AffineConstraints<double> &constraints,
                   const ContactParameters                 &parameters)
    : data(std::make_unique<Data>(surface, constraints, parameters))
  {
  }


  Contact::~Contact() = default;


  void
  Contact::set_time(const double time)
  {
    data->time = time;
    data->surface->set_time(time);
  }


  void
  Contact::detect(const Vector &u, const double least_reach)
  {
    Data &d = *data;
    read_nodal_values(d.surface->cover_system(), u, d.nodal);
    d.reach      = std::max(least_reach, d.parameters.reach);
    d.is_between = false;
    d.search.update(d.reach);
    d.make_points();
    d.make_pattern();
  }


  bool
  Contact::needs_detection(const Vector &u)
  {
    read_nodal_values(data->surface->cover_system(), u, data->nodal);
    return data->search.movement() > 0.5 * data->reach;
  }


  bool
  Contact::is_idle() const
  {
    return data->is_idle;
  }


  void
  Contact::Data::make_points()
  {
    points.clear();
    point_data.clear();
    for (unsigned int i = 0; i < search.slaves().size(); ++i)
      if (search.corner(i) == Kind::along)
        add_points_of(i);
      else
        add_corner(i);
  }


  void
  Contact::Data::restore(ContactPoint      &point,
                         const PointData   &fixed,
                         const unsigned int slave) const
  {
    const auto sticking =
      stick_places.find(place_key(point.edge, fixed.corner));
    StickPlace stick;
    if (sticking != stick_places.end() &&
        find_stick_place(sticking->second, point.s, stick))
    {
      point.stick_edge = stick.edge;
      point.stick_t    = stick.t;
      point.is_bonded  = stick.is_bonded;
    }
    if (multiplier_space != nullptr && fixed.corner >= Kind::along)
      point.multiplier = multiplier_space->value(multipliers, slave, fixed.s);
  }


  void
  Contact::Data::add_corner(const unsigned int slave)
  {
    ContactPoint point;
    PointData    fixed;
    fixed.slave  = slave;
    fixed.corner = search.corner(slave);
    point.edge   = search.slaves()[slave];
    point.s      = fixed.corner;
    point.weight = corner_weight[2 * point.edge + fixed.corner];
    surface->weights(point.edge, point.s, fixed.weights);
    restore(point, fixed, point.edge);
    points.push_back(point);
    point_data.push_back(fixed);
  }


  void
  Contact::Data::add_points_of(const unsigned int slave)
  {
    const unsigned int edge      = search.slaves()[slave];
    const auto         divisions = search.divisions(slave);
    for (unsigned int i = 0; i + 1 < divisions.size(); ++i)
    {
      const ContactSearch::Division &begin = divisions[i];
      const ContactSearch::Division &end   = divisions[i + 1];
      const double at_start = search.end_slack(slave, begin.s, end.s);
      const double at_end   = search.end_slack(slave, end.s, begin.s);
      const double length   = end.s - begin.s;
      for (unsigned int q = 0; q < rule_points.size(); ++q)
      {
        const bool   is_last = q + 1 == rule_points.size();
        ContactPoint point;
        PointData    fixed;
        fixed.slave  = slave;
        fixed.s      = q == 0    ? begin.s
                       : is_last ? end.s
                                 : begin.s + rule_points[q] * length;
        fixed.slack  = q == 0               ? at_start
                       : is_last            ? at_end
                       : at_start == at_end ? at_start
                                            : 0.;
        point.edge   = edge;
        point.s      = fixed.s;
        point.weight = rule_weights[q] * length *
                       surface->reference_place(edge, fixed.s).a.norm();
        const ContactSearch::Division &at = q == 0 ? begin : end;
        if ((q == 0 || is_last) && fixed.slack > 0. &&
            at.master != invalid_index)
        {
          point.edge   = at.master;
          point.s      = at.end;
          fixed.corner = Kind::master_ends + at.end;
          fixed.home   = edge;
        }
        else if (fixed.slack > 0.)
        {
          // a master that ends here, or did before both have been strained
          constexpr double end_of_master = 0.01;
          fixed.home                     = search
                         .project(surface->place(edge, point.s),
                                  search.masters(slave),
                                  end_of_master,
                                  ContactSearch::any_edge)
                         .master;
        }
        surface->weights(point.edge, point.s, fixed.weights);
        restore(point, fixed, edge);
        if (fixed.corner > Kind::along && point.stick_edge == invalid_index)
          take_over_place(point, fixed, edge);
        points.push_back(point);
        point_data.push_back(fixed);
      }
    }
  }


  /// A corner that has come onto the slave sticks where the slave's point that it
  /// has met sticks to it, seen from the other side.
  void
  Contact::Data::take_over_place(ContactPoint      &point,
                                 const PointData   &fixed,
                                 const unsigned int slave) const
  {
    const auto sticking = stick_places.find(slave);
    StickPlace stick;
    if (sticking == stick_places.end() ||
        !find_stick_place(sticking->second, fixed.s, stick) ||
        stick.edge != point.edge)
      return;
    point.stick_edge = slave;
    point.stick_t    = fixed.s - (point.s - stick.t) *
                                surface->place(point.edge, point.s).a.norm() /
                                surface->place(slave, fixed.s).a.norm();
    point.is_bonded = stick.is_bonded;
  }


  /// Elements that are tied couple in the elasticity, whose pattern is to be within
  /// that of the contact.
  void
  Contact::Data::couple_ties()
  {
    const CoverSystem  &covers = surface->cover_system();
    const ManifoldMesh &mesh   = covers.manifold_mesh();
    const auto [first, last]   = covers.locally_owned_elements();
    const auto &curves         = mesh.physical_mesh().curves();
    const auto &piece_to_curve = mesh.physical_mesh().piece_to_curve();
    std::vector<unsigned int> both;
    for (unsigned int e = first; e < last; ++e)
      for (const ElementEdge &edge : mesh.edges(e))
      {
        if (edge.curve_set == invalid_index || edge.neighbor == invalid_index)
          continue;
        const auto &pieces = mesh.curve_set(edge.curve_set);
        if (std::all_of(pieces.begin(), pieces.end(), [&](const auto piece) {
              const Curve &curve = curves[piece_to_curve[piece]];
              return curve.role == CurveRole::joint &&
                     curve.state == JointState::open;
            }))
          continue;
        both.assign(covers.covers(e).begin(), covers.covers(e).end());
        both.insert(both.end(),
                    covers.covers(edge.neighbor).begin(),
                    covers.covers(edge.neighbor).end());
        block_system->couple({both.data(), both.size()});
      }
  }


  void
  Contact::Data::make_pattern()
  {
    is_idle =
      Parallel::max(search.slaves().empty() ? 0U : 1U, communicator) == 0U;
    if (is_idle)
      return;
    couplings.clear();
    for (unsigned int i = 0; i < search.slaves().size(); ++i)
    {
      const unsigned int slave = search.slaves()[i];
      const unsigned int begin = couplings.size();
      couplings.push_back(0);
      const auto append = [&](const unsigned int edge) {
        const auto covers = surface->covers(edge);
        couplings.insert(couplings.end(), covers.begin(), covers.end());
      };
      append(slave);
      for (const unsigned int master : search.masters(i))
        append(master);
      const auto append_places = [&](const unsigned int key) {
        const auto sticking = stick_places.find(key);
        if (sticking != stick_places.end())
          for (const StickPlace &place : sticking->second)
            if (!surface->is_rigid(place.edge))
              append(place.edge);
      };
      append_places(place_key(slave, search.corner(i)));
      if (search.corner(i) == Kind::along)
        for (const unsigned int master : search.masters(i))
          for (unsigned int end = 0; end < 2; ++end)
            append_places(place_key(master, Kind::master_ends + end));
      std::sort(couplings.begin() + begin + 1, couplings.end());
      couplings.erase(std::unique(couplings.begin() + begin + 1,
                                  couplings.end()),
                      couplings.end());
      couplings[begin] = couplings.size() - begin - 1;
    }
    const bool is_new = block_system == nullptr || couplings != known_couplings;
    if (Parallel::max(is_new ? 1U : 0U, communicator) == 0U)
      return;
    known_couplings = couplings;
    block_system =
      std::make_unique<BlockSystem>(surface->cover_system(), *constraints);
    for (unsigned int i = 0; i < couplings.size(); i += couplings[i] + 1)
      block_system->couple({couplings.data() + i + 1, couplings[i]});
    couple_ties();
    block_system->ignore_inhomogeneities();
    block_system->leave_empty_rows();
    block_system->build();
    matrix.clear();
    ++pattern_version;
  }


  /// Pressure, shear and what they depend on.
  ContactTraction
  Contact::Data::find_traction(const unsigned int           q,
                               const ContactSurface::Place &slave,
                               const ContactProjection     &projection)
  {
    // faces that touch are in contact, whatever rounding makes of their gap:
    // a block that lies on another one is held by it from the start
    constexpr double touching = 1e-9;

    ContactTraction   traction;
    ContactPoint     &point = points[q];
    const ContactLaw &law   = *point_data[q].law;
    const double      eps   = law.normal_stiffness;
    point.pressure =
      point.multiplier -
      eps * (projection.gap -
             (is_between ? point_data[q].offset_end : point_data[q].offset));
    if (!point.is_bonded && point.pressure < -eps * touching * reach)
    {
      point.pressure = point.shear = 0.;
      point.state                  = ContactState::open;
      return traction;
    }
    if (!point.is_bonded)
      point.pressure = std::max(point.pressure, 0.);
    traction.pressure         = point.weight * point.pressure;
    traction.normal_stiffness = point.weight * eps;
    report.energy +=
      point.weight *
      (point.pressure * point.pressure - point.multiplier * point.multiplier) /
      (2. * eps);
    const bool was_slipping = point.state == ContactState::slip;
    point.state             = ContactState::slip;
    if (law.has_friction())
    {
      find_shear(q, slave, projection, was_slipping, 0., traction);
      report.energy +=
        point.weight * point.shear * point.shear / (2. * law.shear_stiffness);
    }
    return traction;
  }


  void
  Contact::Data::find_shear(const unsigned int           q,
                            const ContactSurface::Place &slave,
                            const ContactProjection     &projection,
                            const bool                   was_slipping,
                            const double                 slip_rate,
                            ContactTraction             &traction)
  {
    ContactPoint      &point   = points[q];
    const ContactLaw  &law     = *point_data[q].law;
    const Tensor<1, 2> tangent = projection.place.a / projection.place.a.norm();
    const Tensor<1, 2> distance =
      slave.x - surface->place(point.stick_edge, point.stick_t).x;
    const double trial = law.shear_stiffness * (distance * tangent) +
                         law.shear_damping * slip_rate;
    const double limit =
      law.friction * point.pressure + (law.is_bond ? 0. : law.cohesion);
    // displacements are those in the middle of the step
    const double stiffness =
      point.weight *
      (law.shear_stiffness + (is_between ? 2. * law.shear_damping / step : 0.));
    traction.normal_distance = distance * projection.normal;
    // a residual and its tangent are two assemblies at the same displacements
    if (trial != point.spring_shear)
      point.has_turned = std::abs(trial) > limit && was_slipping &&
                         trial * point.spring_shear < 0.;
    point.spring_shear = trial;
    if (point.is_bonded || std::abs(trial) <= limit)
    {
      point.state              = ContactState::stick;
      point.shear              = trial;
      traction.shear_stiffness = stiffness;
    }
    else
    {
      point.state                  = ContactState::slip;
      point.shear                  = trial > 0. ? limit : -limit;
      traction.shear_over_pressure = trial > 0. ? law.friction : -law.friction;
      // it slides to and fro from one iteration to the next, because the tangent
      // of sliding does not hold it: the secant does
      if (point.has_turned)
        traction.shear_stiffness = stiffness * limit / std::abs(trial);
    }
    traction.shear = point.weight * point.shear;
  }


  namespace
  {
    /// Does one of the edges follow the other without a corner?
    bool
    goes_on_smoothly(const std::vector<ContactSurface::Edge> &edges,
                     const unsigned int                       edge,
                     const unsigned int                       other)
    {
      constexpr auto smooth = ContactSurface::Corner::smooth;
      return (edges[edge].next == other && edges[edge].at_end == smooth) ||
             (edges[edge].previous == other && edges[edge].at_start == smooth);
    }
  } // namespace


  ContactProjection
  Contact::Data::find_master(const unsigned int           q,
                             const ContactSurface::Place &slave) const
  {
    const PointData &fixed   = point_data[q];
    const auto       masters = search.masters(fixed.slave);
    if (fixed.corner == Kind::along)
      return search.project(slave, masters, fixed.slack, fixed.home);
    if (fixed.corner > Kind::along)
      return search.project(
        slave,
        dealii::ArrayView<const unsigned int>(&search.slaves()[fixed.slave], 1),
        fixed.slack,
        fixed.home);
    const auto entrance =
      entrances.find(place_key(points[q].edge, fixed.corner));
    return search.project_corner(slave,
                                 masters,
                                 entrance == entrances.end()
                                   ? invalid_index
                                   : entrance->second);
  }


  bool
  Contact::Data::goes_on(const unsigned int edge,
                         const unsigned int other) const
  {
    constexpr unsigned int n_edges = 4;
    constexpr auto         smooth  = ContactSurface::Corner::smooth;
    const auto            &edges   = surface->edges();
    if (edge == other)
      return true;
    for (const bool forward : {true, false})
    {
      unsigned int e = edge;
      for (unsigned int i = 0; i < n_edges && e != invalid_index; ++i)
      {
        const auto &at = edges[e];
        if ((forward ? at.at_end : at.at_start) != smooth)
          break;
        e = forward ? at.next : at.previous;
        if (e == other)
          return true;
      }
    }
    return false;
  }


  double
  Contact::Data::share(const unsigned int  q,
                       const Tensor<1, 2> &slave_normal,
                       const Tensor<1, 2> &master_normal) const
  {
    // faces that are not parallel touch over their projection only
    const double       facing = -(slave_normal * master_normal);
    double             along  = ContactSearch::along_face(facing);
    const unsigned int corner = point_data[q].corner;
    if (corner >= Kind::along)
      return facing * along;
    // a corner touches in a point if neither of its faces touches along its length
    const ContactSurface::Edge &edge  = surface->edges()[points[q].edge];
    const unsigned int          other = corner == 0 ? edge.previous : edge.next;
    if (other != invalid_index)
      along = std::max(along,
                       ContactSearch::along_face(
                         -(surface->place(other, 1. - corner).normal() *
                           master_normal)));
    return facing * (1. - along);
  }


  ContactProjection
  Contact::Data::project(const unsigned int           q,
                         const ContactSurface::Place &slave)
  {
    ContactPoint     &point      = points[q];
    PointData        &fixed      = point_data[q];
    ContactProjection projection = find_master(q, slave);
    // a piece ends where two edges of the master meet; its end stays with one of
    // them, since their normals differ a little and the iteration would not end
    if (fixed.corner == Kind::along && point.master != invalid_index &&
        projection.master != invalid_index &&
        goes_on_smoothly(surface->edges(), point.master, projection.master))
    {
      const ContactProjection last =
        search.project(slave,
                       dealii::ArrayView<const unsigned int>(&point.master, 1),
                       fixed.slack,
                       fixed.home);
      if (last.master != invalid_index)
        projection = last;
    }
    point.x      = slave.x;
    point.master = projection.master;
    if (projection.master == invalid_index)
    {
      point.gap = reach;
      return projection;
    }
    point.t      = projection.t;
    point.gap    = projection.gap;
    point.normal = projection.normal;
    if (!fixed.has_angle)
    {
      point.weight *= share(q, slave.normal(), projection.normal);
      fixed.has_angle           = true;
      constexpr double touching = 1e-6;
      if (is_virgin && std::abs(projection.gap) <= touching * reach)
        point.is_bonded = laws(point.edge, projection.master).is_bond;
    }
    fixed.law = &laws(point.edge, projection.master);
    if (has_friction && (point.stick_edge == invalid_index ||
                         !goes_on(point.stick_edge, projection.master)))
    {
      point.stick_edge = projection.master;
      point.stick_t    = projection.t;
    }
    return projection;
  }


  void
  Contact::Data::add_point(const unsigned int q, const bool with_tangent)
  {
    ContactPoint               &point  = points[q];
    const ContactState          before = point.state;
    const ContactSurface::Place slave  = surface->place(point.edge, point.s);
    const ContactProjection     projection = project(q, slave);
    if (projection.master == invalid_index || point.weight == 0.)
    {
      point.pressure = point.shear = 0.;
      point.state                  = ContactState::open;
      report.n_changes += before != point.state;
      return;
    }
    const ContactTraction traction = find_traction(q, slave, projection);
    report.n_changes += before != point.state;
    if (point.state != ContactState::open)
      hand_over(q, projection, traction, with_tangent);
  }


  void
  Contact::Data::hand_over(const unsigned int       q,
                           const ContactProjection &projection,
                           const ContactTraction   &traction,
                           const bool               with_tangent)
  {
    const ContactPoint &point = points[q];
    const PointData    &fixed = point_data[q];
    ++(point.state == ContactState::stick ? report.n_stick : report.n_slip);
    report.n_bonded += point.is_bonded;
    report.largest_penetration =
      std::max(report.largest_penetration, -projection.gap);
    deepest =
      std::max(deepest,
               (is_between ? fixed.offset_end : fixed.offset) - projection.gap);

    ContactSurface::Weights master, stick;
    surface->weights(projection.master, projection.t, master);
    const bool              with_friction = fixed.law->has_friction();
    const ContactKinematics kinematics(
      fixed.weights, master, projection.place, projection.gap, with_friction);
    const double sign =
      search.comes_first(point.edge, projection.master) ? 1. : -1.;
    report.force += sign * (traction.pressure * kinematics.normal -
                            traction.shear * kinematics.tangent);

    local.n_covers = 0;
    local.append(surface->covers(point.edge));
    local.append(surface->covers(projection.master));
    if (with_friction)
    {
      surface->weights(point.stick_edge, point.stick_t, stick);
      local.append(surface->covers(point.stick_edge));
    }
    local.clear();
    add_contact_point(kinematics,
                      traction,
                      &fixed.weights,
                      with_friction ? &stick : nullptr,
                      with_tangent,
                      local);
    const dealii::ArrayView<const unsigned int> covers(local.covers,
                                                       local.n_covers);
    if (with_tangent)
      block_system->add(covers, local.matrix, local.rhs);
    else
      block_system->add_rhs(covers, local.rhs);
  }


  void
  Contact::Data::reduce_report()
  {
    report.n_points = points.size();
    report.n_open   = report.n_points - report.n_stick - report.n_slip;
    if (Parallel::n_mpi_processes(communicator) == 1)
      return;
    for (unsigned int *count : {&report.n_points,
                                &report.n_open,
                                &report.n_stick,
                                &report.n_slip,
                                &report.n_bonded,
                                &report.n_changes})
      *count = Parallel::sum(*count, communicator);
    report.largest_penetration =
      Parallel::max(report.largest_penetration, communicator);
    deepest       = Parallel::max(deepest, communicator);
    report.energy = Parallel::sum(report.energy, communicator);
    report.force  = Parallel::sum(report.force, communicator);
  }


  void
  Contact::assemble(const Vector &u, const bool with_tangent)
  {
    Data &d   = *data;
    d.report  = ContactReport();
    d.deepest = 0.;
    if (d.is_idle)
    {
      d.residual = 0.;
      return;
    }
    read_nodal_values(d.surface->cover_system(), u, d.nodal);
    d.block_system->reset(with_tangent);
    for (unsigned int q = 0; q < d.points.size(); ++q)
      d.add_point(q, with_tangent);
    if (with_tangent)
      d.block_system->transfer(d.matrix, d.residual);
    else
      d.block_system->transfer_rhs(d.residual);
    d.reduce_report();
  }


  const Contact::Vector &
  Contact::residual() const
  {
    return data->residual;
  }


  const Contact::Matrix &
  Contact::tangent() const
  {
    return data->matrix;
  }


  unsigned int
  Contact::pattern_version() const
  {
    return data->pattern_version;
  }


  bool
  Contact::tangent_is_symmetric() const
  {
    return !data->has_friction;
  }


  const ContactReport &
  Contact::report() const
  {
    return data->report;
  }


  const std::vector<ContactPoint> &
  Contact::points() const
  {
    return data->points;
  }


  double
  Contact::augment()
  {
    Data &d = *data;
    Assert(d.multiplier_space != nullptr,
           dealii::ExcMessage("There is no penetration tolerance."));
    const MultiplierSpace &space  = *d.multiplier_space;
    const unsigned int     n      = space.size();
    const unsigned int     n_rule = d.rule_points.size();
    // integrals of spring pressure times function, of functions, and of stiffness
    // times function
    std::vector<double> sums(3 * n, 0.);
    // those of corners come last
    for (unsigned int begin = 0;
         begin < d.points.size() && d.point_data[begin].corner >= Data::along;
         begin += n_rule)
    {
      const unsigned int edge = d.search.slaves()[d.point_data[begin].slave];
      const double       length =
        (d.point_data[begin + n_rule - 1].s - d.point_data[begin].s) *
        d.surface->edges()[edge].length;
      for (unsigned int q = 0; q < n_rule; ++q)
      {
        const ContactPoint &point = d.points[begin + q];
        // beside the master, where there is nothing to penetrate
        if (point.master == invalid_index || point.weight == 0.)
          continue;
        const auto  &f      = space[edge];
        const double share  = f.share(d.point_data[begin + q].s);
        const double weight = d.rule_weights[q] * length;
        const double eps    = d.point_data[begin + q].law->normal_stiffness;
        const auto   add    = [&](const unsigned int i, const double value) {
          sums[i] -= eps * value * point.gap;
          sums[n + i] += value;
          sums[2 * n + i] += eps * value;
        };
        add(f.first, weight * (1. - share));
        add(f.second, weight * share);
      }
    }
    Parallel::sum(sums, d.communicator, sums);

    double change = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      double value = 0.;
      if (sums[n + i] > 0.)
        value = std::max(0., d.multipliers[i] + sums[i] / sums[n + i]);
      const double difference = std::abs(value - d.multipliers[i]);
      const double eps        = sums[n + i] > 0. ? sums[2 * n + i] / sums[n + i]
                                                 : d.parameters.normal_stiffness;
      change                  = std::max(change, difference / eps);
      d.multipliers[i]        = value;
    }
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      const Data::PointData &fixed = d.point_data[q];
      if (fixed.corner >= Data::along)
        d.points[q].multiplier =
          space.value(d.multipliers, d.search.slaves()[fixed.slave], fixed.s);
    }
    return change;
  }


  double
  Contact::Data::bond_ratio(const unsigned int q) const
  {
    const ContactPoint &point = points[q];
    const ContactLaw   *law   = point_data[q].law;
    if (!point.is_bonded || law == nullptr)
      return -1.;
    // without strength any stress beyond rounding is too much
    const auto ratio = [&](const double stress, const double strength) {
      const double least = 1e-9 * reach * law->normal_stiffness;
      return std::max(0., stress) / std::max(strength, least);
    };
    return std::max(ratio(-point.pressure, law->tensile_strength),
                    ratio(std::abs(point.shear),
                          law->cohesion +
                            law->friction * std::max(0., point.pressure)));
  }


  unsigned int
  Contact::break_bonds(const double share)
  {
    Data  &d       = *data;
    double largest = 0.;
    for (unsigned int q = 0; q < d.points.size(); ++q)
      largest = std::max(largest, d.bond_ratio(q));
    largest            = Parallel::max(largest, d.communicator);
    unsigned int count = 0;
    if (largest <= 1.)
      return 0;
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      const double ratio = d.bond_ratio(q);
      if (ratio <= 1. || ratio < share * largest)
        continue;
      ContactPoint     &point = d.points[q];
      const ContactLaw &law   = *d.point_data[q].law;
      const auto energy = [&](const double stress, const double stiffness) {
        return point.weight * stress * stress / (2. * stiffness);
      };
      if (point.pressure < 0.)
        d.broken_energy += energy(point.pressure, law.normal_stiffness);
      const double limit = law.friction * std::max(0., point.pressure);
      const double shear =
        std::copysign(std::min(limit, std::abs(point.shear)), point.shear);
      d.broken_energy += energy(point.shear, law.shear_stiffness) -
                         energy(shear, law.shear_stiffness);
      // it slides from now on: the place where it sticks is dragged along
      const double length =
        d.surface->place(point.stick_edge, point.stick_t).a.norm();
      point.stick_t += (point.shear - shear) / (law.shear_stiffness * length);
      point.shear     = shear;
      point.is_bonded = false;
      if (point.pressure < 0.)
      {
        point.pressure = 0.;
        point.state    = ContactState::open;
      }
      ++count;
      // points are made anew from these places
      const StickPlace place{point.s, point.stick_edge, point.stick_t, false};
      auto            &places =
        d.stick_places[d.place_key(point.edge, d.point_data[q].corner)];
      const auto at =
        std::lower_bound(places.begin(),
                         places.end(),
                         place,
                         [](const StickPlace &a, const StickPlace &b) {
                           return a.s < b.s;
                         });
      if (at != places.end() && at->s == place.s)
        *at = place;
      else
        places.insert(at, place);
    }
    return Parallel::sum(count, d.communicator);
  }


  double
  Contact::accept()
  {
    Data &d = *data;
    d.stick_places.clear();
    d.entrances.clear();
    for (unsigned int q = 0; q < d.points.size(); ++q)
      if (d.point_data[q].corner < Data::along &&
          d.points[q].state != ContactState::open)
        d.entrances[d.place_key(d.points[q].edge, d.point_data[q].corner)] =
          d.points[q].master;
    d.is_virgin = false;
    // the same on all ranks
    double dissipated =
      Parallel::this_mpi_process(d.communicator) == 0 ? d.detection_loss : 0.;
    d.detection_loss = 0.;
    if (d.is_between)
      for (const Data::PointData &fixed : d.point_data)
        dissipated += fixed.normal_loss;
    if (!d.has_friction)
    {
      d.energies_of_pairs = d.pair_energies();
      return Parallel::sum(dissipated, d.communicator);
    }
    (void)break_bonds();
    dissipated += d.broken_energy;
    d.broken_energy = 0.;
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      ContactPoint          &point = d.points[q];
      const Data::PointData &fixed = d.point_data[q];
      if (fixed.law == nullptr || !fixed.law->has_friction())
        continue;
      const double eps = fixed.law->shear_stiffness;
      if (d.is_between)
      {
        const double before =
          point.weight * fixed.shear_begin * fixed.shear_begin / (2. * eps);
        const double after = d.shear_energy(q);
        const double most  = std::max(0., before + fixed.shear_work);
        // no more is stored than has been put in: where it touches for the
        // first time the pressure, and with it the strength, has been lower
        if (after > most)
        {
          const double change = point.shear * (1. - std::sqrt(most / after));
          point.shear -= change;
          point.stick_t +=
            change /
            (eps * d.surface->place(point.stick_edge, point.stick_t).a.norm());
        }
        dissipated += fixed.shear_work + before - std::min(after, most);
      }
      if (point.master == invalid_index)
        continue;
      StickPlace place{point.s, point.master, point.t, point.is_bonded};
      if (point.state == ContactState::stick)
        place = {point.s, point.stick_edge, point.stick_t, point.is_bonded};
      else if (point.state == ContactState::slip)
      {
        const Tensor<1, 2> a = d.surface->place(point.master, point.t).a;
        place.t -= point.shear / (eps * a.norm());
        if (!d.is_between)
          dissipated +=
            point.weight * std::abs(point.shear) *
            std::abs(
              (point.x - d.surface->place(point.stick_edge, point.stick_t).x) *
                a / a.norm() -
              point.shear / eps);
      }
      auto &places =
        d.stick_places[d.place_key(point.edge, d.point_data[q].corner)];
      // both pieces that meet at a division have a point there
      if (places.empty() || places.back().s < point.s)
        places.push_back(place);
      point.stick_edge = place.edge;
      point.stick_t    = place.t;
    }
    d.energies_of_pairs = d.pair_energies();
    return Parallel::sum(dissipated, d.communicator);
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
