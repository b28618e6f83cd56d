#include <deal.II/base/mpi.h>

#include <algorithm>
#include <contact/assembly/point_sums.h>
#include <contact/detection/corner_rules.h>
#include <contact/law/point_springs.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;
    namespace Parallel = dealii::Utilities::MPI;

    PointSums::PointSums(const ContactSurface &surface,
                         const ContactSearch  &search,
                         const PointMaker     &maker)
      : surface(&surface)
      , narrow(surface, search)
      , maker(&maker)
    {
    }


    void
    PointSums::begin()
    {
      of_points     = ContactReport();
      largest_depth = rounding_square = 0.;
    }


    void
    PointSums::add(const ContactPoint &point,
                   const PointData    &fixed,
                   const PointForces  &forces)
    {
      of_points.n_changes += forces.has_changed;
      of_points.energy += forces.energy;
      if (forces.is_near)
        note_depth(point, fixed, forces.projection);
      if (!forces.has_forces)
        return;
      ++(point.state == ContactState::stick ? of_points.n_stick
                                            : of_points.n_slip);
      of_points.n_bonded += point.is_bonded;
      largest_depth =
        std::max(largest_depth,
                 forces.offset + point.opening - initial_closure(point, fixed) -
                   forces.projection.gap);
      of_points.force += forces.force;
      rounding_square += forces.rounding_square;
    }


    void
    PointSums::end(const unsigned int n_points, const bool is_between)
    {
      ContactReport &report       = of_points;
      report.is_between           = is_between;
      report.n_points             = n_points;
      report.n_open               = n_points - report.n_stick - report.n_slip;
      const MPI_Comm communicator = surface->cover_system().communicator();
      if (Parallel::n_mpi_processes(communicator) == 1)
        return;
      for (unsigned int *count : {&report.n_points,
                                  &report.n_open,
                                  &report.n_stick,
                                  &report.n_slip,
                                  &report.n_bonded,
                                  &report.n_changes})
        *count = Parallel::sum(*count, communicator);
      for (double *depth : {&report.largest_penetration, &largest_depth})
        *depth = Parallel::max(*depth, communicator);
      for (double *sum : {&report.energy, &rounding_square})
        *sum = Parallel::sum(*sum, communicator);
      report.force = Parallel::sum(report.force, communicator);
    }


    /// The gap of a contact of relative curvature k at the distance d from a point is
    /// @f$ g + d\,t\cdot n + k d^2 / 2, @f$ t being the tangent of the slave and n the normal of the
    /// master. It is least at @f$ d = -t\cdot n / k. @f$
    std::pair<double, double>
    PointSums::deepest_beside(const ContactPoint      &point,
                              const PointData         &fixed,
                              const ContactProjection &projection) const
    {
      const double curvature =
        narrow.relative_curvature(point.edge, projection.master);
      if (fixed.corner != PointKind::along || curvature <= 0.)
        return {0., 0.};
      const Tensor<1, 2> a      = surface->place(point.edge, point.s).a;
      const double       length = a.norm();
      const double       way = -(a * projection.normal) / (curvature * length);
      const double       s   = point.s + way / length;
      if (s < 0. || s > 1. || std::abs(way) > fixed.piece_length)
        return {0., 0.};
      return {way, 0.5 * curvature * way * way};
    }


    void
    PointSums::note_depth(const ContactPoint      &point,
                          const PointData         &fixed,
                          const ContactProjection &projection)
    {
      // The largest penetration is taken over points with pressure, and where a round face is in the
      // other one between points that are not. This leaves out points that were found behind a face
      // without having passed it, which store no energy, and pieces of faces that are too short to
      // bear anything, because the other face of the corner does.
      // The closure by the initial stress is no penetration.
      const double opening = point.opening - initial_closure(point, fixed);
      double       depth   = opening - projection.gap;
      if (point.pressure <= 0. && depth > 0.)
        return;
      const auto [way, more] = deepest_beside(point, fixed, projection);
      depth += more;
      if (depth <= of_points.largest_penetration ||
          (fixed.corner >= PointKind::along &&
           fixed.piece_length <=
             CornerRules::shortest_piece * maker->size_at(fixed)))
        return;
      // A point is pushed out through the face by which it came in, which may be further away than
      // another face.
      if (opening == 0.)
      {
        const ContactSurface::Place here = surface->place(point.edge, point.s);
        const ContactSurface::Place deepest_place =
          way == 0. ? here
                    : surface->place(point.edge, point.s + way / here.a.norm());
        depth =
          std::min(depth,
                   narrow.depth_inside(fixed.slave,
                                       surface->edges()[projection.master].body,
                                       deepest_place.x));
      }
      of_points.largest_penetration =
        std::max(of_points.largest_penetration, depth);
    }
  } // namespace internal
} // namespace NMM
