#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <algorithm>
#include <contact/contact.h>
#include <string>

namespace NMM
{
  using namespace internal;

  namespace
  {
    /// The parameters after a check, with the value of a reach of 0.
    ContactParameters
    complete(const ContactParameters &parameters, const ContactSurface &surface)
    {
      parameters.check();
      const std::size_t n_edges = surface.edges().size();
      AssertThrow(
        parameters.initial_stress.empty() ||
          parameters.initial_stress.size() == n_edges,
        InputError("there are initial stresses of " +
                     std::to_string(parameters.initial_stress.size()) +
                     " faces, but there are " + std::to_string(n_edges),
                   "the contact parameters",
                   "take those of initial_stress_at_faces()"));
      ContactParameters result = parameters;
      if (result.reach != 0.)
        return result;
      for (unsigned int e = 0; e < n_edges; ++e)
        if (!surface.is_rigid(e))
          result.reach = std::max(result.reach, surface.edges()[e].length);
      result.reach *= 0.1;
      return result;
    }
  } // namespace


  Contact::Data::Data(ContactSurface                          &surface,
                      const dealii::AffineConstraints<double> &constraints,
                      const ContactParameters                 &parameters_in)
    : surface(&surface)
    , parameters(complete(parameters_in, surface))
    , chosen(surface)
    , states(surface, chosen)
    , multipliers(surface, parameters.penetration_tolerance)
    , detection(surface, parameters, multipliers, memory)
    , updater(surface, parameters, memory, detection.projector, set)
    , tractions(surface, updater, detection.projector, memory)
    , step_tractions(surface, states, detection.projector, tractions)
    , matrix(surface,
             constraints,
             detection.search,
             memory.stick_places,
             chosen)
    , sums(surface, detection.search, detection.maker)
  {
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
    data->states.set_time(time);
  }


  void
  Contact::freeze_geometry(const bool is_frozen)
  {
    Data &d = *data;
    if (d.detection.projector.admits_any_depth())
      return;
    if (is_frozen && !d.updater.is_frozen())
      d.stage = Data::Stage::created;
    d.updater.freeze(is_frozen);
    for (PointData &fixed : d.set.data)
    {
      fixed.keeps_cohesion = false;
      fixed.kept_cohesion  = 0.;
    }
  }


  void
  Contact::detect(const Vector &u, const std::vector<double> &least_reaches)
  {
    Data &d = *data;
    d.stage = Data::Stage::detected;
    d.states.move_to(u);
    d.states.set_begin();
    if (d.updater.is_moving())
      d.multipliers.forget_stiffening();
    d.detection.find_candidates(least_reaches, d.states);
    d.detection.make_points(d.set);
    d.updater.begin_step();
    if (!is_idle())
      d.matrix.update_candidates();
    d.chosen.clear_points();
    d.list_points_of_bodies();
  }


  bool
  Contact::is_detected() const
  {
    return data->stage != Data::Stage::created;
  }


  bool
  Contact::is_idle() const
  {
    return data->detection.is_idle();
  }


  void
  Contact::assemble(const Vector &u, const bool with_tangent)
  {
    Data &d = *data;
    d.enter(Data::Stage::assembled, d.stage != Data::Stage::created);
    d.sums.begin();
    if (is_idle())
    {
      d.matrix.clear_forces();
      return;
    }
    if (with_tangent)
      d.matrix.couple_all();
    d.states.move_to(u);
    // Motions with frozen geometry project points at the beginning of a step only.
    if (!d.updater.is_frozen() || !d.updater.is_moving())
      d.detection.projector.bound_new_contact();
    d.matrix.begin_assembly(with_tangent);
    d.add_points(d.chosen.chosen_points(d.set.points.size()),
                 [&](const unsigned int q, PointForces &forces) {
                   d.evaluate(q, with_tangent, forces);
                 });
  }


  std::vector<double>
  Contact::motions(const Vector &from, const Vector &to)
  {
    Data &d = *data;
    d.states.move_to(to);
    const std::vector<ContactPosition> positions =
      d.detection.search.positions();
    d.states.move_to(from);
    return d.detection.search.distances(positions);
  }


  void
  Contact::Data::list_points_of_bodies()
  {
    if (!chosen.has_to_list_points())
      return;
    const unsigned int n = surface->n_bodies() - static_cast<unsigned int>(
                                                   surface->obstacles().size());
    const ContactSearch &search = detection.search;
    const auto          &edges  = surface->edges();
    chosen.list_points(set.data.size(), [&](const auto &add) {
      for (unsigned int q = 0; q < set.data.size(); ++q)
      {
        const unsigned int position = set.data[q].slave;
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
    return is_idle() ? 0. : data->sums.rounding();
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
    return !data->parameters.transmit_shear();
  }


  const ContactReport &
  Contact::report() const
  {
    return data->sums.report();
  }


  const std::vector<ContactPoint> &
  Contact::points() const
  {
    return data->set.points;
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
