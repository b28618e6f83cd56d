#include <algorithm>
#include <cmath>
#include <contact/step_clearances.h>
#include <limits>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      constexpr double infinity = std::numeric_limits<double>::max();
      /// Largest rotation for which the bound holds [rad], and the factor 5/4 in it.
      constexpr double most_turn = 0.5, turn_factor = 1.25;
      /// Least clearance as a fraction of the depth, to exclude rounding.
      constexpr double clear_by = 1e-6;
    } // namespace


    void
    StepClearances::begin(const ContactSurface     &given_surface,
                          const ContactSearch      &search,
                          std::vector<double>       given_clearances,
                          std::vector<unsigned int> given_bodies,
                          const double              given_depth)
    {
      surface       = &given_surface;
      depth         = given_depth;
      clearances    = std::move(given_clearances);
      point_to_body = std::move(given_bodies);
      list_edges_of_bodies();
      list_faced_bodies(search);
      at_begin.resize(surface->edges().size());
      for (unsigned int e = 0; e < at_begin.size(); ++e)
        at_begin[e] = surface->edge_displacement(e);
      note_motion();
    }


    void
    StepClearances::disable()
    {
      clearances.clear();
    }


    void
    StepClearances::note_motion()
    {
      if (surface == nullptr)
        return;
      motions.assign(surface->n_bodies(), Motion());
      bounds.assign(surface->n_bodies(), -1.);
    }


    bool
    StepClearances::is_clear(const unsigned int point, const double factor)
    {
      return point < clearances.size() && clearances[point] > 0. &&
             clearances[point] >
               factor * bound(point_to_body[point]) + clear_by * depth;
    }


    void
    StepClearances::list_edges_of_bodies()
    {
      const auto &edges = surface->edges();
      if (edges_of_bodies.size() == surface->n_bodies() &&
          at_begin.size() == edges.size())
        return;
      edges_of_bodies.assign(surface->n_bodies(), {});
      for (unsigned int e = 0; e < edges.size(); ++e)
        edges_of_bodies[edges[e].body].push_back(e);
    }


    void
    StepClearances::list_faced_bodies(const ContactSearch &search)
    {
      const auto &edges = surface->edges();
      faced_bodies.resize(surface->n_bodies());
      for (auto &bodies : faced_bodies)
        bodies.clear();
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        for (const unsigned int master : search.masters(i))
        {
          auto &faced = faced_bodies[edges[search.slaves()[i]].body];
          if (std::find(faced.begin(), faced.end(), edges[master].body) ==
              faced.end())
            faced.push_back(edges[master].body);
        }
    }


    StepClearances::Motion
    StepClearances::motion_of_edge(const unsigned int e) const
    {
      const ContactSurface::EdgeDisplacement now =
        surface->edge_displacement(e);
      const auto        &before = at_begin[e].d;
      const auto        &edge   = surface->edges()[e];
      const Tensor<1, 2> d[3]   = {now.d[0] - before[0],
                                   now.d[1] - before[1],
                                   now.d[2] - before[2]};
      const Tensor<1, 2> chord  = edge.end - edge.start + before[1] + before[2];
      const double       c_1 = (d[1] + d[2]).norm(), c_2 = d[2].norm();
      Motion             result;
      result.center = d[0] + 0.5 * d[1] + 0.25 * d[2];
      result.radius = edge.radius != 0. ? infinity : c_1 + c_2;
      result.turn   = (c_1 + 2. * c_2) / chord.norm();
      return result;
    }


    const StepClearances::Motion &
    StepClearances::motion_of_body(const unsigned int body)
    {
      Motion &result = motions[body];
      if (result.is_known)
        return result;
      result.is_known = true;
      bool is_first   = true;
      for (const unsigned int e : edges_of_bodies[body])
      {
        const Motion edge = motion_of_edge(e);
        if (is_first)
          result.center = edge.center;
        is_first = false;
        result.radius =
          std::max(result.radius,
                   (edge.center - result.center).norm() + edge.radius);
        result.turn = std::max(result.turn, edge.turn);
      }
      return result;
    }


    double
    StepClearances::bound(const unsigned int body)
    {
      if (bounds[body] >= 0.)
        return bounds[body];
      const Motion &a      = motion_of_body(body);
      double        result = 0.;
      for (const unsigned int other : faced_bodies[body])
      {
        const Motion &b = motion_of_body(other);
        // Either face may be the master.
        const double turn = std::max(a.turn, b.turn);
        result =
          std::max(result,
                   turn > most_turn ? infinity
                                    : (a.center - b.center).norm() + a.radius +
                                        b.radius + turn_factor * depth * turn);
      }
      return bounds[body] = result;
    }


    double
    ContactSearch::clearance(
      const Point<2>                             &x,
      const dealii::ArrayView<const unsigned int> masters,
      const double                                given_slack,
      const unsigned int                          home) const
    {
      double result = infinity;
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
        // The place differs from the chord by d_2 t (t - 1), with |t (t - 1)| <= 3/4, and the
        // normal turns along the edge.
        const double bend   = d[2].norm() * (0.75 + 3. * reach / length);
        const double beside = std::max(
          {0., -before * length - along, along - (1. + after) * length});
        const double outside = std::max({0., across, -across - reach});
        // Squares of these lengths cannot overflow; std::hypot() would be slower.
        const double distance = std::sqrt(beside * beside + outside * outside);
        result                = std::min(result, distance - bend);
      }
      return std::max(0., result);
    }
  } // namespace internal
} // namespace NMM
