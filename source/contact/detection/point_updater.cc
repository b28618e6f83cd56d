#include <algorithm>
#include <cmath>
#include <contact/detection/point_updater.h>
#include <contact/law/point_springs.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    PointUpdater::PointUpdater(const ContactSurface    &surface,
                               const ContactParameters &parameters,
                               const ContactMemory     &memory,
                               const PointProjector    &projector,
                               PointSet                &set)
      : surface(&surface)
      , memory(&memory)
      , projector(&projector)
      , set(&set)
      , laws(surface, parameters)
      , has_anchors(parameters.transmit_shear())
    {
    }


    void
    PointUpdater::begin_step()
    {
      if (is_moving())
        positions = Positions::of_motion;
      if (frozen)
        frozen_points.assign(set->points.size(), FrozenPoint());
    }


    ContactProjection
    PointUpdater::update(const unsigned int           q,
                         const ContactSurface::Place &slave)
    {
      if (!frozen)
        return update_exactly(q, slave);
      FrozenPoint       &known      = frozen_points[q];
      ContactProjection &projection = known.projection;
      ContactPoint      &point      = set->points[q];
      if (!known.is_known)
      {
        projection     = update_exactly(q, slave);
        known.is_known = true;
        if (projection.master != invalid_index)
          known.gap =
            projection.gap - projector->gap_of_displacements(point, projection);
        return projection;
      }
      point.x = slave.x;
      if (projection.master == invalid_index)
        return projection;
      point.gap = projection.gap =
        projector->gap_of_displacements(point, projection) + known.gap;
      // Forces are those at the frozen place. The anchor after this state is accepted is the place
      // that the point has reached.
      const ContactSurface::Place place =
        surface->place(projection.master, projection.t);
      point.t =
        projection.t + ((slave.x - place.x) * place.a) / place.a.norm_square();
      return projection;
    }


    ContactProjection
    PointUpdater::update_exactly(const unsigned int           q,
                                 const ContactSurface::Place &slave)
    {
      ContactPoint &point = set->points[q];
      PointData    &fixed = set->data[q];
      // The point has no share of the contact until points are made again.
      if (fixed.has_angle && point.weight == 0.)
        return ContactProjection();
      const ContactProjection projection =
        projector->project(point, fixed, slave, positions);
      point.x      = slave.x;
      point.master = projection.master;
      point.gap    = projection.gap;
      if (projection.master == invalid_index ||
          (!fixed.has_angle && !take_share(slave, projection, point, fixed)))
      {
        point.master = invalid_index;
        point.gap    = projector->search_reach();
        return ContactProjection();
      }
      point.t      = projection.t;
      point.normal = projection.normal;
      fixed.law    = &laws(point.edge, projection.master);
      if (has_anchors &&
          (point.stick_edge == invalid_index ||
           !goes_on(*surface, point.stick_edge, projection.master)))
      {
        point.stick_edge = projection.master;
        point.stick_t    = new_anchor(point, fixed, projection);
      }
      return projection;
    }


    bool
    PointUpdater::take_share(const ContactSurface::Place &slave,
                             const ContactProjection     &projection,
                             ContactPoint                &point,
                             PointData                   &fixed) const
    {
      constexpr double touching = 1e-6;

      point.weight *=
        projector->share(point, fixed, slave.normal(), projection.normal);
      fixed.has_angle = true;
      if (point.weight == 0.)
        point.is_bonded = false;
      else if (!memory->has_accepted_state &&
               std::abs(projection.gap) <= touching * projector->search_reach())
        point.is_bonded = laws(point.edge, projection.master).is_bond;
      return point.weight != 0.;
    }


    double
    PointUpdater::new_anchor(const ContactPoint      &point,
                             const PointData         &fixed,
                             const ContactProjection &projection) const
    {
      // Fraction of the reach within which places coincide in the reference configuration.
      constexpr double same = 1e-6;

      const double initial = initial_shear(point, fixed);
      if (initial == 0.)
        return projection.t;
      const ContactPosition x = surface->reference_place(point.edge, point.s).x;
      double                t = projection.t;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const ContactSurface::Place place =
          surface->reference_place(projection.master, t);
        t += (x - place.x) * place.a / place.a.norm_square();
      }
      if (t >= -same && t <= 1. + same &&
          surface->reference_place(projection.master, t).x.distance(x) <=
            same * projector->search_reach())
        return t;
      return projection.t +
             initial / (fixed.law->shear_spring() * projection.place.a.norm());
    }


    Tensor<1, 2>
    PointUpdater::way_from_anchor(const ContactPoint          &point,
                                  const ContactSurface::Place &slave) const
    {
      // Rounding of the coordinates of two edges, relative to these coordinates.
      constexpr double rounding = 1e-15;

      if (is_moving())
        return slave.x - surface->place(point.stick_edge, point.stick_t).x;
      const ContactSurface::Place from =
        surface->reference_place(point.stick_edge, point.stick_t);
      Tensor<1, 2> way =
        surface->reference_place(point.edge, point.s).x - from.x;
      if (way.norm() <= rounding * (std::abs(from.x[0]) + std::abs(from.x[1]) +
                                    from.a.norm()))
        way = 0.;
      return way + surface->displacement(point.edge, point.s) -
             surface->displacement(point.stick_edge, point.stick_t);
    }


    double
    PointUpdater::size_of_terms(const ContactPoint      &point,
                                const ContactProjection &projection) const
    {
      // In statics gaps are those of displacements, otherwise the ways from the ends of edges add to
      // them.
      return is_moving()
               ? point.x.distance(surface->edges()[point.edge].start) +
                   projection.place.x.way.norm()
               : surface->displacement(point.edge, point.s).norm() +
                   surface->displacement(projection.master, projection.t)
                     .norm();
    }
  } // namespace internal
} // namespace NMM
