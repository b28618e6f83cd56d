// What cannot touch in a step.
#include <algorithm>
#include <cmath>
#include <contact/contact_motion.h>
#include <contact/contact_search.h>
#include <limits>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    void
    ContactMotion::begin(const ContactSurface &surface)
    {
      const unsigned int n = surface.edges().size();
      at_begin.resize(n);
      for (unsigned int e = 0; e < n; ++e)
        at_begin[e] = surface.edge_displacement(e);
      motions.resize(n);
      rigid_edges.clear();
      for (unsigned int e = 0; e < n; ++e)
      {
        motions[e] = find_motion(surface, e);
        if (surface.is_rigid(e))
          rigid_edges.push_back(e);
      }
    }


    void
    ContactMotion::move(const ContactSurface &surface, const unsigned int edge)
    {
      // without begin() nobody asks
      if (!motions.empty())
        motions[edge] = find_motion(surface, edge);
    }


    void
    ContactMotion::move_obstacles(const ContactSurface &surface)
    {
      for (const unsigned int edge : rigid_edges)
        move(surface, edge);
    }


    ContactMotion::Motion
    ContactMotion::find_motion(const ContactSurface &surface,
                               const unsigned int    edge) const
    {
      Motion                                 result;
      const ContactSurface::EdgeDisplacement now =
        surface.edge_displacement(edge);
      const auto        &before = at_begin[edge].d;
      const auto        &at     = surface.edges()[edge];
      const Tensor<1, 2> d[3]   = {now.d[0] - before[0],
                                   now.d[1] - before[1],
                                   now.d[2] - before[2]};
      const Tensor<1, 2> slope  = d[1] + d[2];
      const Tensor<1, 2> chord  = at.end - at.start + before[1] + before[2];
      const double       c_1 = slope.norm(), c_2 = d[2].norm();
      result.center = d[0] + 0.5 * d[1] + 0.25 * d[2];
      result.radius =
        at.radius != 0. ? std::numeric_limits<double>::max() : c_1 + c_2;
      result.turn = (c_1 + 2. * c_2) / chord.norm();
      return result;
    }


    double
    ContactMotion::bound(const unsigned int edge,
                         const unsigned int master,
                         const double       depth) const
    {
      constexpr double most = 0.5, turn_factor = 1.25;

      const Motion &of_edge = motions[edge], &of_master = motions[master];
      if (of_master.turn > most)
        return std::numeric_limits<double>::max();
      return (of_edge.center - of_master.center).norm() + of_edge.radius +
             of_master.radius + turn_factor * depth * of_master.turn;
    }


    double
    ContactSearch::clearance(
      const Point<2>                             &x,
      const dealii::ArrayView<const unsigned int> masters,
      const double                                given_slack,
      const unsigned int                          home) const
    {
      double result = std::numeric_limits<double>::max();
      for (const unsigned int master : masters)
      {
        const ContactSurface::Edge &edge = surface->edges()[master];
        if (edge.radius != 0.)
          return 0.;
        const double before =
          extension(edge.at_start, slack_of(master, given_slack, home));
        const double after =
          extension(edge.at_end, slack_of(master, given_slack, home));
        const ContactSurface::EdgeDisplacement displacement =
          surface->edge_displacement(master);
        const auto        &d      = displacement.d;
        const Tensor<1, 2> way    = x - edge.start - d[0];
        const Tensor<1, 2> chord  = edge.end - edge.start + d[1] + d[2];
        const double       length = chord.norm();
        const double       along  = way * chord / length;
        const double across = (way[0] * chord[1] - way[1] * chord[0]) / length;
        // the place is on the chord but for d_2 t (t - 1), |t (t - 1)| <= 3/4, and normals
        // turn along it
        const double bend   = d[2].norm() * (0.75 + 3. * reach / length);
        const double beside = std::max(
          {0., -before * length - along, along - (1. + after) * length});
        const double outside = std::max({0., across, -across - reach});
        result = std::min(result, std::hypot(beside, outside) - bend);
      }
      return std::max(0., result);
    }
  } // namespace internal
} // namespace NMM
