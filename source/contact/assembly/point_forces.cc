// One contact point in an assembly: its projection, its traction by the law, its forces.
#include <cmath>
#include <contact/contact.h>
#include <limits>

namespace NMM
{
  using namespace internal;

  void
  Contact::Data::evaluate(const unsigned int q,
                          const bool         with_tangent,
                          PointForces       &forces)
  {
    ContactPoint               &point  = set.points[q];
    PointData                  &fixed  = set.data[q];
    const ContactState          before = point.state;
    const ContactSurface::Place slave  = surface->place(point.edge, point.s);
    forces.clear();
    forces.projection                   = updater.update(q, slave);
    const ContactProjection &projection = forces.projection;
    ContactTraction          traction;
    forces.is_near = projection.master != invalid_index && point.weight != 0.;
    forces.offset  = updater.is_between() ? fixed.offset_end : fixed.offset;
    if (forces.is_near)
      traction = tractions.find(
        updater.is_between()
          ? StepTractions::spring_at_end(fixed)
          : tractions.normal_spring(point, fixed, slave, projection),
        slave,
        projection,
        point,
        fixed);
    else
      set_open(point);
    forces.has_changed = before != point.state;
    if (point.state == ContactState::open)
      return;
    find_forces(q,
                kinematics(q, projection, fixed.law->transmits_shear()),
                traction,
                with_tangent,
                forces);
  }


  void
  Contact::Data::evaluate_between(const unsigned int q,
                                  const bool         with_tangent,
                                  PointForces       &forces)
  {
    ContactPoint      &point  = set.points[q];
    PointData         &fixed  = set.data[q];
    const ContactState before = point.state;
    forces.clear();
    forces.projection = updater.update(q, surface->place(point.edge, point.s));
    ContactTraction traction =
      step_tractions.find(forces.projection, point, fixed);
    forces.has_changed = before != point.state;
    forces.is_near     = point.state != ContactState::open;
    forces.offset      = fixed.offset_end;
    if (!forces.is_near)
      return;
    const ContactKinematics at =
      kinematics(q, forces.projection, /* with_turning = */ true);
    StepTractions::Changes changes;
    if (with_tangent)
      step_tractions.differentiate(
        fixed, forces.projection, at, changes, traction);
    find_forces(q, at, traction, with_tangent, forces);
  }


  ContactKinematics
  Contact::Data::kinematics(const unsigned int       q,
                            const ContactProjection &projection,
                            const bool               with_turning) const
  {
    ContactSurface::Weights master;
    surface->weights(projection.master, projection.t, master);
    ContactKinematics result(set.data[q].weights,
                             master,
                             projection.place,
                             projection.gap,
                             with_turning);
    if (updater.is_frozen())
      result.freeze();
    return result;
  }


  void
  Contact::Data::find_forces(const unsigned int       q,
                             const ContactKinematics &kinematics,
                             const ContactTraction   &traction,
                             const bool               with_tangent,
                             PointForces             &forces) const
  {
    // Relative rounding of a number, times the number of operations that a gap takes.
    constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();

    const ContactPoint      &point      = set.points[q];
    const PointData         &fixed      = set.data[q];
    const ContactProjection &projection = forces.projection;
    const double             sign =
      detection.search.comes_first(point.edge, projection.master) ? 1. : -1.;
    forces.has_forces = true;
    forces.energy     = traction.energy;
    forces.force      = sign * (traction.pressure * kinematics.normal -
                           traction.shear * kinematics.tangent);
    forces.rounding_square =
      std::pow(rounding * updater.size_of_terms(point, projection) *
                 traction.stiffness(),
               2);

    ContactLocalSystem &local = forces.local;
    local.n_covers            = 0;
    local.append(surface->covers(point.edge));
    local.append(surface->covers(projection.master));
    // The anchor matters only if something depends on the distance from it. In a step only dilation
    // does.
    ContactSurface::Weights stick;
    if (traction.shear_stiffness != 0. || traction.pressure_by_slip != 0.)
    {
      surface->weights(point.stick_edge, point.stick_t, stick);
      local.append(surface->covers(point.stick_edge));
    }
    local.clear();
    add_contact_point(kinematics,
                      traction,
                      &fixed.weights,
                      fixed.law->transmits_shear() ? &stick : nullptr,
                      with_tangent,
                      local);
  }
} // namespace NMM
