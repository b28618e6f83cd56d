// The nearest faces of a point, and the parts into which faces are divided.
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <contact/detection/corner_rules.h>
#include <contact/detection/narrow_phase.h>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;
    using Place = ContactSurface::Place;
    using namespace CornerRules;

    namespace
    {
      /// Fraction of an edge beyond a corner within which a nearest point is as good as one on the
      /// edge.
      double
      inside_slack(const ContactSurface::Corner corner, const double slack)
      {
        return corner == ContactSurface::Corner::convex ||
                   corner == ContactSurface::Corner::end
                 ? std::max(slack, 0.)
                 : 0.;
      }


      /// Fraction of an edge by which it is continued beyond an end with this corner.
      double
      extension(const ContactSurface::Corner corner, const double slack)
      {
        switch (corner)
        {
          case ContactSurface::Corner::smooth:
          case ContactSurface::Corner::concave:
            return beyond_end;
          default:
            return slack;
        }
      }


      /// Slack of a master in NarrowPhase::project().
      double
      slack_of(const unsigned int master,
               const double       slack,
               const unsigned int home)
      {
        return slack < 0. || master == home || home == NarrowPhase::any_edge
                 ? slack
                 : beyond_rounding;
      }


      /// The corner past which at most a few edges lead from one edge to the other, since some of them
      /// may be slivers; smooth if there is none.
      ContactSurface::Corner
      corner_between(const ContactSurface &surface,
                     const unsigned int    edge,
                     const unsigned int    other)
      {
        const auto &edges = surface.edges();
        for (const auto &[from, to] :
             {std::make_pair(edge, other), std::make_pair(other, edge)})
        {
          auto         corner = ContactSurface::Corner::smooth;
          unsigned int e      = from;
          for (unsigned int i = 0;
               i < most_edges_of_corner && e != invalid_index;
               ++i)
          {
            if (e == to)
              return corner;
            const auto at_end = edges[e].at_end;
            if (at_end == ContactSurface::Corner::convex ||
                (at_end == ContactSurface::Corner::concave &&
                 corner == ContactSurface::Corner::smooth))
              corner = at_end;
            e = edges[e].next;
          }
        }
        return ContactSurface::Corner::smooth;
      }


      bool
      meet_in_convex_corner(const ContactSurface &surface,
                            const unsigned int    edge,
                            const unsigned int    other)
      {
        return corner_between(surface, edge, other) ==
               ContactSurface::Corner::convex;
      }
    } // namespace


    double
    NarrowPhase::along_face(const double facing)
    {
      const double x =
        std::min(1.,
                 std::max(0.,
                          (facing - least_facing_along) /
                            (all_facing_along - least_facing_along)));
      return x * x * (3. - 2. * x);
    }


    bool
    NarrowPhase::find_nearest(const unsigned int     edge,
                              const ContactPosition &x,
                              double                &t,
                              Place                 &place) const
    {
      const ContactPosition start = surface->place(edge, 0.).x;
      const Tensor<1, 2>    chord = surface->place(edge, 1.).x - start;
      t                           = ((x - start) * chord) / chord.norm_square();
      t = std::min(1. + beyond_end, std::max(-beyond_end, t));

      constexpr unsigned int max_iterations = 30;
      // Rounding of differences of positions relative to the length, and of the parameter.
      const double tolerance =
        2e-16 * (2. + (x.way.norm() + start.way.norm()) / chord.norm());
      for (unsigned int i = 0; i < max_iterations; ++i)
      {
        place                      = surface->place(edge, t);
        const Tensor<1, 2> d       = x - place.x;
        const double       square  = place.a.norm_square();
        const double       bending = d * place.b;
        // Beyond the centre of curvature the nearest point is no minimum; continue along the
        // tangent.
        const double change =
          (d * place.a) / (bending < 0.9 * square ? square - bending : square);
        if (!std::isfinite(change))
          return false;
        t += std::min(0.5, std::max(-0.5, change));
        if (std::abs(t - 0.5) > 3.)
          return false;
        if (std::abs(change) <= tolerance)
          break;
      }
      place = surface->place(edge, t);
      return true;
    }


    std::vector<NarrowPhase::Division>
    NarrowPhase::divisions(const unsigned int position,
                           const unsigned int n_parts) const
    {
      const unsigned int    slave = search->slaves()[position];
      std::vector<Division> found;
      for (const unsigned int master : search->masters(position))
        for (const unsigned int end : {0U, 1U})
        {
          if (n_parts > 1 && !search->is_corner(master, end))
            continue;
          const ContactPosition x          = surface->place(master, end).x;
          const double          pair_reach = search->reach_of(slave, master);
          double                t;
          Place                 place;
          if (!surface->is_further(slave, x, pair_reach, 0., 0.) &&
              find_nearest(slave, x, t, place) && t > same_division &&
              t < 1. - same_division && place.x.distance(x) <= pair_reach &&
              along_face(
                -(place.normal() * surface->place(master, end).normal())) > 0.)
            found.push_back(
              {t,
               search->is_corner(master, end) ? master : invalid_index,
               end,
               false});
        }
      // Whether something is in reach of the last two divisions.
      bool is_before = false, is_here = false;
      for (unsigned int i = 0; n_parts > 1 && i <= n_parts; ++i)
      {
        const bool is_next =
          is_in_reach(position, surface->place(slave, i / double(n_parts)).x);
        if (i > 1 && (is_before || is_here || is_next))
          found.push_back({(i - 1) / double(n_parts), invalid_index, 0, true});
        is_before = is_here;
        is_here   = is_next;
      }
      // Of divisions at the same place, those with corners come first.
      std::sort(found.begin(),
                found.end(),
                [](const Division &a, const Division &b) {
                  return std::tie(a.s, a.master) < std::tie(b.s, b.master);
                });
      std::vector<Division> result(1);
      for (const Division &division : found)
        if (division.s - result.back().s >= same_division)
          result.push_back(division);
        else if (result.size() > 1 && result.back().master == invalid_index)
          result.back() = division;
      result.emplace_back();
      result.back().s = 1.;
      return result;
    }


    bool
    NarrowPhase::is_in_reach(const unsigned int     position,
                             const ContactPosition &x) const
    {
      const unsigned int slave = search->slaves()[position];
      for (const unsigned int master : search->masters(position))
      {
        const double pair_reach = search->reach_of(slave, master);
        double       t;
        Place        place;
        if (!surface->is_further(master, x, pair_reach, 0., 0.) &&
            find_nearest(master, x, t, place) &&
            surface->place(master, std::clamp(t, 0., 1.)).x.distance(x) <=
              pair_reach)
          return true;
      }
      return false;
    }


    double
    NarrowPhase::relative_curvature(const unsigned int edge,
                                    const unsigned int other) const
    {
      double sum = 0.;
      for (const unsigned int e : {edge, other})
        if (surface->edges()[e].radius != 0.)
          sum += 1. / surface->edges()[e].radius;
      return sum;
    }


    double
    NarrowPhase::largest_curvature(const unsigned int position) const
    {
      const unsigned int slave  = search->slaves()[position];
      double             result = 0.;
      for (const unsigned int master : search->masters(position))
      {
        const double curvature = relative_curvature(slave, master);
        if (curvature <= result)
          continue;
        for (const double s : {0., 0.5, 1.})
        {
          const Place here = surface->place(slave, s);
          double      t;
          Place       there;
          if (find_nearest(master, here.x, t, there) &&
              along_face(-(here.normal() * there.normal())) > 0.)
            result = curvature;
        }
      }
      return result;
    }


    ContactProjection
    NarrowPhase::project(const Place                                &place,
                         const dealii::ArrayView<const unsigned int> masters,
                         const double                                slack,
                         const unsigned int                          home,
                         const AdmittedContact &admitted) const
    {
      const unsigned int body =
        home < any_edge ? surface->edges()[home].body : invalid_index;
      return project_within(
        place, masters, {slack, home, body}, reach(), admitted);
    }


    ContactProjection
    NarrowPhase::project_corner(
      const Place                                &slave_place,
      const Tensor<1, 2>                         &other_normal,
      const dealii::ArrayView<const unsigned int> masters,
      const unsigned int                          entrance,
      const AdmittedContact                      &admitted) const
    {
      // Faces at nearly a right angle, and faces that look the same way, do not touch.
      const double least_facing = admitted.least_facing;

      const Tensor<1, 2> slave_normal = slave_place.normal();
      boost::container::small_vector<ContactProjection, 8> near;
      for (const unsigned int master : masters)
      {
        const ContactSurface::Edge &edge = surface->edges()[master];
        ContactProjection           now;
        now.master          = master;
        const double before = extension(edge.at_start, beyond_rounding);
        const double after  = extension(edge.at_end, beyond_rounding);
        if (surface->is_further(
              master, slave_place.x, reach(), before, after) ||
            !find_nearest(master, slave_place.x, now.t, now.place) ||
            now.t < -before || now.t > 1. + after)
          continue;
        now.normal = now.place.normal();
        now.gap    = (slave_place.x - now.place.x) * now.normal;
        if (std::abs(now.gap) <= reach())
          near.push_back(now);
      }
      const unsigned int n = near.size();

      ContactProjection best;
      for (unsigned int i = 0; i < n; ++i)
      {
        ContactProjection &now = near[i];
        if (-(now.normal * slave_normal) <= least_facing ||
            !admitted.holds(now))
          continue;
        if (now.gap < 0. && now.master == entrance)
          return now;
        now.gap = std::max(now.gap,
                           now.gap < 0. ? gap_beyond_corner(now.master,
                                                            slave_place.x,
                                                            slave_normal,
                                                            other_normal)
                                        : now.gap);
        // The corner came in through a face that only its other edge faces, or it touches that
        // face.
        bool is_of_other_edge = false;
        for (unsigned int j = 0; j < n && now.gap < 0. && admitted.is_bound();
             ++j)
          is_of_other_edge =
            is_of_other_edge ||
            (near[j].gap > now.gap &&
             -(near[j].normal * slave_normal) <= least_facing &&
             -(near[j].normal * other_normal) > least_facing &&
             meet_in_convex_corner(*surface, now.master, near[j].master));
        if (is_of_other_edge)
          continue;
        // The point is outside if it is in front of the other face of the master's corner.
        for (unsigned int j = 0; j < n && now.gap < 0.; ++j)
          if (near[j].gap >= 0. &&
              can_separate(near[j].normal, slave_normal, other_normal) &&
              meet_in_convex_corner(*surface, now.master, near[j].master))
            now.gap = near[j].gap;
        const bool is_inside = now.gap < 0., best_is_inside = best.gap < 0.;
        if (best.master == invalid_index ||
            (is_inside != best_is_inside
               ? is_inside
               : std::abs(now.gap) < std::abs(best.gap) - same_gap * reach()))
          best = now;
      }
      return best;
    }


    /// The edge is found by its direction. The feet of points next to a master's corner are beyond
    /// the end of an edge that is not parallel, and where corners of two bodies have passed each
    /// other the nearer one would be found for both. Corners that are far behind the slave are
    /// excluded.
    unsigned int
    NarrowPhase::edge_beside(const unsigned int position,
                             const Division    &division,
                             const double       s_inside) const
    {
      if (division.master == invalid_index)
        return invalid_index;
      const auto &corner = surface->edges()[division.master];
      const Place slave =
        surface->place(search->slaves()[position], division.s);
      if ((surface->place(division.master, division.end).x - slave.x) *
            slave.normal() <=
          -behind_division * reach())
        return invalid_index;
      for (const auto &[edge, end] :
           {std::make_pair(division.master, division.end),
            std::make_pair(division.end == 0 ? corner.previous : corner.next,
                           1 - division.end)})
      {
        if (edge == invalid_index)
          continue;
        const Place        place   = surface->place(edge, end);
        const Tensor<1, 2> inwards = end == 0 ? place.a : -place.a;
        if (along_face(-(slave.normal() * place.normal())) > 0. &&
            (s_inside - division.s) * (inwards * slave.a) > 0.)
          return edge;
      }
      return invalid_index;
    }


    unsigned int
    NarrowPhase::face_at(const unsigned int position, const double s) const
    {
      AdmittedContact admitted;
      admitted.least_facing = least_facing_along;
      return project_within(surface->place(search->slaves()[position], s),
                            search->masters(position),
                            {},
                            reach_of_piece * reach(),
                            admitted)
        .master;
    }


    double
    NarrowPhase::end_slack(const unsigned int position,
                           const Division    &division,
                           const double       s_inside,
                           unsigned int      &master) const
    {
      const double s = division.s;
      master         = edge_beside(position, division, s_inside);
      if (master != invalid_index)
        return beyond_division;

      master = face_at(position, s + inside_of_piece * (s_inside - s));
      return master == invalid_index ? -beyond_division : beyond_division;
    }


    unsigned int
    NarrowPhase::find_home(const unsigned int position,
                           const double       s,
                           const unsigned int master) const
    {
      const auto             &edges = surface->edges();
      const unsigned int      slave = search->slaves()[position];
      const ContactProjection result =
        project_within(surface->place(slave, s),
                       search->masters(position),
                       {end_of_home, any_edge, edges[master].body},
                       reach(),
                       AdmittedContact());
      if (result.master == invalid_index)
        return invalid_index;
      const double beyond =
        edges[result.master].length * std::max({0., -result.t, result.t - 1.});
      const double size =
        1. / std::sqrt(std::abs(dealii::determinant(edges[slave].inverse)));
      return beyond <= end_of_home * size ? result.master : invalid_index;
    }


    ContactProjection
    NarrowPhase::project_within(
      const Place                                &slave_place,
      const dealii::ArrayView<const unsigned int> masters,
      const Masters                              &which,
      const double                                largest_gap,
      const AdmittedContact                      &admitted) const
    {
      const Tensor<1, 2> slave_normal = slave_place.normal();
      ContactProjection  best;
      double             best_overshoot = 0.;
      double             best_facing    = 0.;
      // Far sides: faces that look the same way as the point's normal, with their gaps.
      boost::container::small_vector<std::pair<unsigned int, double>, 16>
        outside;
      for (const unsigned int master : masters)
      {
        const ContactSurface::Edge &edge = surface->edges()[master];
        if (which.body != invalid_index && edge.body != which.body)
          continue;
        const double slack  = slack_of(master, which.slack, which.home);
        const double before = extension(edge.at_start, slack);
        const double after  = extension(edge.at_end, slack);
        // The master is neither in contact nor a far side.
        if (surface->is_further(master,
                                slave_place.x,
                                largest_gap,
                                std::max(before, beyond_end),
                                std::max(after, beyond_end)))
          continue;
        ContactProjection now;
        now.master = master;
        if (!find_nearest(master, slave_place.x, now.t, now.place))
          continue;
        now.normal          = now.place.normal();
        const double facing = -(now.normal * slave_normal);
        now.gap             = (slave_place.x - now.place.x) * now.normal;
        if (facing < far_side_facing && now.t >= -beyond_end &&
            now.t <= 1. + beyond_end)
          outside.emplace_back(master, now.gap);
        if (facing <= admitted.least_facing ||
            std::abs(now.gap) > largest_gap || !admitted.holds(now) ||
            now.t < -before || now.t > 1. + after)
          continue;
        // Distance of the nearest point beyond the ends of the edge [m].
        const double overshoot =
          edge.length *
          std::max({0.,
                    -now.t - inside_slack(edge.at_start, slack),
                    now.t - 1. - inside_slack(edge.at_end, slack)});
        bool       is_better = best.master == invalid_index;
        const bool is_corner =
          !is_better && corner_between(*surface, best.master, master) !=
                          ContactSurface::Corner::smooth;
        // Where corners of both bodies coincide, neither a small slip nor the closure of springs
        // moves a point to the face round the corner; after a larger slip the slave is divided
        // there.
        const double same_overshoot =
          is_corner ? end_of_home * edge.length : same_gap * reach();
        if (!is_better && std::abs(overshoot - best_overshoot) > same_overshoot)
          is_better = overshoot < best_overshoot;
        else if (is_corner)
          is_better = facing > best_facing + same_gap;
        else if (!is_better)
        {
          const double difference = std::abs(now.gap) - std::abs(best.gap);
          is_better               = std::abs(difference) > same_gap * reach()
                                      ? difference < 0.
                                      : facing > best_facing + same_gap;
        }
        if (is_better)
        {
          best           = now;
          best_overshoot = overshoot;
          best_facing    = facing;
        }
      }
      // Where corners meet, rounding must not decide which of two sides of a body is nearer.
      if (best.master == invalid_index || best.gap >= -same_gap * reach())
        return best;
      const ContactSurface::Edge &edge    = surface->edges()[best.master];
      constexpr auto              concave = ContactSurface::Corner::concave;
      // At the tip of a wedge the springs may be compressed by more than the wedge is thick. A point
      // whose piece was laid on this face stays with it there.
      const bool is_at_tip =
        best.master == which.home &&
        (best.t < end_of_home || best.t > 1. - end_of_home);
      for (const auto &[far, gap] : outside)
        if (
          surface->edges()[far].body == edge.body &&
          std::abs(gap) < -best.gap && (gap > 0. || admitted.is_bound()) &&
          !(is_at_tip && meet_in_convex_corner(*surface, far, best.master)) &&
          // Exclude the two faces of a notch, which have the body on either side.
          !(far == edge.previous && edge.at_start == concave) &&
          !(far == edge.next && edge.at_end == concave))
          return ContactProjection();
      return best;
    }
  } // namespace internal
} // namespace NMM
