// What a contact point takes over from its projection: its master, weight, bond and anchor.
#include <nmm/contact/contact.h>

#include <algorithm>
#include <cmath>
#include <contact/contact.h>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

  namespace
  {
    /// Rounding of a difference of two positions on edges, one of which is @p place, in the reference
    /// configuration [m].
    double
    rounding_of(const ContactSurface::Place &place)
    {
      // The coordinates of both edges are rounded.
      constexpr double parts = 1e-15;
      return parts *
             (std::abs(place.x[0]) + std::abs(place.x[1]) + place.a.norm());
    }
  } // namespace


  ContactProjection
  Contact::Data::project_frozen(const unsigned int           q,
                                const ContactSurface::Place &slave)
  {
    FrozenPoint       &known      = frozen[q];
    ContactProjection &projection = known.projection;
    ContactPoint      &point      = points[q];
    if (!known.is_known)
    {
      projection     = project(q, slave);
      known.is_known = true;
      if (projection.master != invalid_index)
        known.gap =
          projection.gap - projector.gap_of_displacements(point, projection);
      return projection;
    }
    point.x = slave.x;
    if (projection.master == invalid_index)
      return projection;
    point.gap = projection.gap =
      projector.gap_of_displacements(point, projection) + known.gap;
    // Forces are those at the frozen place. The anchor after this state is accepted is the place
    // that the point has reached.
    const ContactSurface::Place place =
      surface->place(projection.master, projection.t);
    point.t =
      projection.t + ((slave.x - place.x) * place.a) / place.a.norm_square();
    return projection;
  }


  Tensor<1, 2>
  Contact::Data::way_from_stick(const unsigned int           q,
                                const ContactSurface::Place &slave) const
  {
    const ContactPoint &point = points[q];
    if (is_moving())
      return slave.x - surface->place(point.stick_edge, point.stick_t).x;
    const ContactSurface::Place from =
      surface->reference_place(point.stick_edge, point.stick_t);
    Tensor<1, 2> way = surface->reference_place(point.edge, point.s).x - from.x;
    if (way.norm() <= rounding_of(from))
      way = 0.;
    return way + surface->displacement(point.edge, point.s) -
           surface->displacement(point.stick_edge, point.stick_t);
  }


  double
  Contact::Data::new_anchor(const unsigned int       q,
                            const ContactProjection &projection) const
  {
    // Fraction of the reach within which places coincide in the reference configuration.
    constexpr double same = 1e-6;

    const double initial = initial_shear(points[q], point_data[q]);
    if (initial == 0.)
      return projection.t;
    const ContactPosition x =
      surface->reference_place(points[q].edge, points[q].s).x;
    double t = projection.t;
    for (unsigned int i = 0; i < 3; ++i)
    {
      const ContactSurface::Place place =
        surface->reference_place(projection.master, t);
      t += (x - place.x) * place.a / place.a.norm_square();
    }
    if (t >= -same && t <= 1. + same &&
        surface->reference_place(projection.master, t).x.distance(x) <=
          same * reach)
      return t;
    return projection.t + initial / (point_data[q].law->shear_spring() *
                                     projection.place.a.norm());
  }


  ContactProjection
  Contact::Data::project(const unsigned int           q,
                         const ContactSurface::Place &slave)
  {
    ContactPoint &point = points[q];
    PointData    &fixed = point_data[q];
    // The point has no share of the contact until points are made again.
    if (fixed.has_angle && point.weight == 0.)
      return ContactProjection();
    const ContactProjection projection =
      projector.project(point,
                        fixed,
                        slave,
                        !is_moving()   ? PointProjector::Positions::of_statics
                        : is_between() ? PointProjector::Positions::between
                                       : PointProjector::Positions::of_motion);
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
      point.weight *=
        projector.share(point, fixed, slave.normal(), projection.normal);
      fixed.has_angle = true;
      if (point.weight == 0.)
      {
        point.master    = invalid_index;
        point.gap       = reach;
        point.is_bonded = false;
        return ContactProjection();
      }
      constexpr double touching = 1e-6;
      if (!memory.has_accepted_state &&
          std::abs(projection.gap) <= touching * reach)
        point.is_bonded = laws(point.edge, projection.master).is_bond;
    }
    fixed.law = &laws(point.edge, projection.master);
    if (transmits_shear &&
        (point.stick_edge == invalid_index ||
         !goes_on(*surface, point.stick_edge, projection.master)))
    {
      point.stick_edge = projection.master;
      point.stick_t    = new_anchor(q, projection);
    }
    return projection;
  }
} // namespace NMM
