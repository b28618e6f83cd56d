// What cannot touch in a step.
#include <algorithm>
#include <cmath>
#include <contact/contact_motion.h>
#include <contact/contact_search.h>
#include <limits>
#include <numeric>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      /// Of a face [rad], and what it counts by depth.
      constexpr double most_turn = 0.5, turn_factor = 1.25;
    } // namespace


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
      is_body_known.assign(surface.n_bodies(), false);
      body_motions.resize(surface.n_bodies());
      if (edge_to_body.size() == n)
        return;
      edge_to_body.clear();
      body_begins.assign(surface.n_bodies() + 2, 0);
      for (const ContactSurface::Edge &edge : surface.edges())
      {
        edge_to_body.push_back(edge.body);
        ++body_begins[edge.body + 2];
      }
      std::partial_sum(body_begins.begin(),
                       body_begins.end(),
                       body_begins.begin());
      edges_of_bodies.resize(n);
      for (unsigned int e = 0; e < n; ++e)
        edges_of_bodies[body_begins[edge_to_body[e] + 1]++] = e;
    }


    void
    ContactMotion::move(const ContactSurface &surface, const unsigned int edge)
    {
      // without begin() nobody asks
      if (motions.empty())
        return;
      motions[edge]                     = find_motion(surface, edge);
      is_body_known[edge_to_body[edge]] = false;
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
      const Motion &of_edge = motions[edge], &of_master = motions[master];
      if (of_master.turn > most_turn)
        return std::numeric_limits<double>::max();
      return (of_edge.center - of_master.center).norm() + of_edge.radius +
             of_master.radius + turn_factor * depth * of_master.turn;
    }


    const ContactMotion::Motion &
    ContactMotion::of_body(const unsigned int body)
    {
      Motion &result = body_motions[body];
      if (is_body_known[body])
        return result;
      const auto begin = edges_of_bodies.begin() + body_begins[body],
                 end   = edges_of_bodies.begin() + body_begins[body + 1];
      result           = Motion();
      if (begin != end)
        result.center = motions[*begin].center;
      for (auto edge = begin; edge != end; ++edge)
      {
        const Motion &of_edge = motions[*edge];
        result.radius =
          std::max(result.radius,
                   (of_edge.center - result.center).norm() + of_edge.radius);
        result.turn = std::max(result.turn, of_edge.turn);
      }
      is_body_known[body] = true;
      return result;
    }


    double
    ContactMotion::bound_of_bodies(const unsigned int body,
                                   const unsigned int other,
                                   const double       depth)
    {
      const Motion &a = of_body(body), &b = of_body(other);
      // a face may be the other one's master or slave
      const double turn = std::max(a.turn, b.turn);
      return turn > most_turn ? std::numeric_limits<double>::max()
                              : (a.center - b.center).norm() + a.radius +
                                  b.radius + turn_factor * depth * turn;
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
        // lengths of bodies: their squares do not overflow, and hypot() takes longer
        const double distance = std::sqrt(beside * beside + outside * outside);
        result                = std::min(result, distance - bend);
      }
      return std::max(0., result);
    }
  } // namespace internal
} // namespace NMM
