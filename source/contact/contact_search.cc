#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <contact/contact_search.h>
#include <contact/corner_rules.h>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;
    using Place = ContactSurface::Place;
    using namespace CornerRules;

    namespace
    {
      namespace bg    = boost::geometry;
      using BoxCorner = bg::model::point<double, 2, bg::cs::cartesian>;
      using Box       = bg::model::box<BoxCorner>;
      using Entry     = std::pair<Box, unsigned int>;

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


      /// Bounding box of an edge, enlarged by how far it may bulge between the sampled points and
      /// by @p margin [m].
      Box
      box_of(const ContactSurface &surface,
             const unsigned int    edge,
             const double          margin)
      {
        constexpr unsigned int n = 4;
        double                 lower[2], upper[2], bulge = 0.;
        for (unsigned int i = 0; i <= n; ++i)
        {
          const Place place = surface.place(edge, i / double(n));
          bulge             = std::max(bulge, place.b.norm() / (8. * n * n));
          for (unsigned int c = 0; c < 2; ++c)
          {
            lower[c] = i == 0 ? place.x[c] : std::min(lower[c], place.x[c]);
            upper[c] = i == 0 ? place.x[c] : std::max(upper[c], place.x[c]);
          }
        }
        bulge += margin;
        return Box(BoxCorner(lower[0] - bulge, lower[1] - bulge),
                   BoxCorner(upper[0] + bulge, upper[1] + bulge));
      }
    } // namespace


    ContactSearch::ContactSearch(const ContactSurface     &surface,
                                 std::vector<unsigned int> slave_priority,
                                 const bool                only_vertices)
      : surface(&surface)
      , ranks(std::move(slave_priority))
      , only_vertices(only_vertices)
      , masters_begin(1, 0)
    {
      for (unsigned int body = ranks.size(); body < surface.n_bodies(); ++body)
        ranks.push_back(body);
      // A direction that is unlikely to be parallel to a face.
      const Tensor<1, 2> side({0.8390715290764524, 0.5440211108893698});
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
        edge_to_side.push_back(surface.reference_place(e, 0.5).normal() * side);
    }


    ContactSearch::~ContactSearch() = default;


    bool
    ContactSearch::comes_first(const unsigned int edge,
                               const unsigned int other) const
    {
      if (surface->is_rigid(edge) || surface->is_rigid(other))
        return surface->is_rigid(other);
      const unsigned int body       = surface->edges()[edge].body;
      const unsigned int other_body = surface->edges()[other].body;
      if (body == other_body)
      {
        // Compare with a tolerance: all edges of a straight face must be on one side, so that none
        // of them is paired with the edge next to its counterpart.
        constexpr double same = 1e-9;
        const double     more = edge_to_side[edge] - edge_to_side[other];
        return std::abs(more) > same ? more > 0. : edge < other;
      }
      return ranks[body] != ranks[other_body] ? ranks[body] < ranks[other_body]
                                              : body < other_body;
    }


    bool
    ContactSearch::is_corner(const unsigned int edge,
                             const unsigned int end) const
    {
      const auto &at   = surface->edges()[edge];
      const auto  kind = end == 0 ? at.at_start : at.at_end;
      return kind == ContactSurface::Corner::convex ||
             (kind == ContactSurface::Corner::end && surface->is_rigid(edge)) ||
             (kind == ContactSurface::Corner::smooth && only_vertices &&
              at.radius != 0. && !surface->is_rigid(edge));
    }


    double
    ContactSearch::along_face(const double facing)
    {
      const double x =
        std::min(1.,
                 std::max(0.,
                          (facing - least_facing_along) /
                            (all_facing_along - least_facing_along)));
      return x * x * (3. - 2. * x);
    }


    bool
    ContactSearch::may_touch(const unsigned int edge,
                             const unsigned int other) const
    {
      const bool is_rigid = surface->is_rigid(edge);
      if (is_rigid || surface->is_rigid(other))
        return is_rigid != surface->is_rigid(other);
      const auto &edges = surface->edges();
      if (edges[edge].body != edges[other].body)
        return true;
      if (edge == other)
        return false;
      // Neighbours do not touch, except both faces next to the tip of a crack.
      if (edges[edge].next == other || edges[edge].previous == other)
        return edges[edge].start == edges[other].end &&
               edges[edge].end == edges[other].start &&
               edges[edge].center == edges[other].center;
      // Faces of one body that look the same way do not turn to face each other before the next
      // search for candidates.
      bool may_face = false;
      for (const double s : {0., 0.5, 1.})
        for (const double t : {0., 0.5, 1.})
          may_face = may_face || surface->place(edge, s).normal() *
                                     surface->place(other, t).normal() <
                                   same_way_of_body;
      if (!may_face)
        return false;
      // The far side of a thin body is no candidate: faces of one body that can touch later are in
      // front of each other in the reference configuration.
      const Place  here   = surface->reference_place(edge, 0.5);
      const Place  there  = surface->reference_place(other, 0.5);
      const double inside = 1e-9 * (edges[edge].length + edges[other].length);
      return (here.x - there.x) * there.normal() >= -inside &&
             (there.x - here.x) * here.normal() >= -inside;
    }


    namespace
    {
      Box
      inflated(const Box &box, const double reach)
      {
        const auto &lower = box.min_corner(), &upper = box.max_corner();
        return Box(BoxCorner(lower.get<0>() - reach, lower.get<1>() - reach),
                   BoxCorner(upper.get<0>() + reach, upper.get<1>() + reach));
      }
    } // namespace


    void
    ContactSearch::append(const unsigned int               edge,
                          const unsigned int               corner,
                          const std::vector<unsigned int> &masters)
    {
      if (masters.empty())
        return;
      slave_edges.push_back(edge);
      corners.push_back(corner);
      master_edges.insert(master_edges.end(), masters.begin(), masters.end());
      masters_begin.push_back(master_edges.size());
    }


    bool
    ContactSearch::update(const double new_reach)
    {
      // If the kept reach is larger than this many times the new one, there are too many
      // candidates.
      constexpr double far = 4.;

      begin_positions.resize(3 * surface->edges().size());
      for (unsigned int i = 0; i < begin_positions.size(); ++i)
        begin_positions[i] = surface->place(i / 3, 0.5 * (i % 3)).x;
      if (broad_reach > 0. && broad_reach <= far * new_reach &&
          new_reach + 2. * largest_distance(known_positions) <= broad_reach)
      {
        reach = new_reach;
        return false;
      }
      search(new_reach);
      return true;
    }


    void
    ContactSearch::search(const double new_reach)
    {
      constexpr double margin = 0.5;

      reach                = new_reach;
      broad_reach          = (1. + margin) * new_reach;
      const unsigned int n = surface->edges().size();
      std::vector<Box>   boxes;
      std::vector<Entry> entries;
      boxes.reserve(n);
      entries.reserve(n);
      known_positions.resize(3 * n);
      for (unsigned int e = 0; e < n; ++e)
      {
        boxes.push_back(box_of(*surface, e, 0.));
        if (!surface->is_absent(e))
          entries.emplace_back(boxes.back(), e);
        for (unsigned int i = 0; i < 3; ++i)
          known_positions[3 * e + i] = surface->place(e, 0.5 * i).x;
      }
      const bg::index::rtree<Entry, bg::index::rstar<16>> tree(entries);

      slave_edges.clear();
      corners.clear();
      master_edges.clear();
      masters_begin.assign(1, 0);
      const auto [first, last] = surface->locally_owned_edges();
      std::vector<unsigned int> found;
      const auto find = [&](const unsigned int e, const Box &box, auto accept) {
        found.clear();
        for (auto entry = tree.qbegin(bg::index::intersects(box));
             entry != tree.qend();
             ++entry)
        {
          ++counts.n_boxes;
          if (accept(entry->second) && may_touch(e, entry->second))
            found.push_back(entry->second);
        }
        counts.n_candidates += found.size();
        std::sort(found.begin(), found.end());
      };
      for (unsigned int e = first; e < last && !only_vertices; ++e)
      {
        if (surface->is_absent(e))
          continue;
        find(e, inflated(boxes[e], broad_reach), [&](const unsigned int m) {
          return comes_first(e, m);
        });
        append(e, 2, found);
      }
      const bool has_obstacles = dealii::Utilities::MPI::this_mpi_process(
                                   surface->cover_system().communicator()) == 0;
      for (unsigned int e = 0; e < n; ++e)
        if ((e >= first && e < last) || (has_obstacles && surface->is_rigid(e)))
          for (unsigned int end = 0; end < 2; ++end)
          {
            if (surface->is_absent(e) || !is_corner(e, end))
              continue;
            const ContactPosition &x = known_positions[3 * e + 2 * end];
            const BoxCorner        corner(x[0], x[1]);
            find(e,
                 inflated(Box(corner, corner), broad_reach),
                 [](unsigned int) { return true; });
            append(e, end, found);
          }
    }


    const std::vector<unsigned int> &
    ContactSearch::slaves() const
    {
      return slave_edges;
    }


    dealii::ArrayView<const unsigned int>
    ContactSearch::masters(const unsigned int position) const
    {
      return {master_edges.data() + masters_begin[position],
              masters_begin[position + 1] - masters_begin[position]};
    }


    void
    ContactSearch::begin(const Begin where)
    {
      if (where == Begin::unchanged && !accepted_positions.empty())
        return;
      accepted_positions.resize(
        where == Begin::unknown ? 0 : 3 * surface->edges().size());
      for (unsigned int i = 0; i < accepted_positions.size(); ++i)
        accepted_positions[i] =
          where == Begin::reference
            ? surface->reference_place(i / 3, 0.5 * (i % 3)).x
            : surface->place(i / 3, 0.5 * (i % 3)).x;
    }


    double
    ContactSearch::largest_distance(
      const std::vector<ContactPosition> &positions) const
    {
      double square = 0.;
      for (unsigned int i = 0; i < positions.size(); ++i)
        square = std::max(
          square,
          surface->place(i / 3, 0.5 * (i % 3)).x.distance_square(positions[i]));
      return std::sqrt(square);
    }


    void
    ContactSearch::find_motions_since_begin(std::vector<double> &motions) const
    {
      motions.assign(accepted_positions.size() / 3, 0.);
      for (unsigned int i = 0; i < accepted_positions.size(); ++i)
        motions[i / 3] = std::max(motions[i / 3],
                                  surface->place(i / 3, 0.5 * (i % 3))
                                    .x.distance(accepted_positions[i]));
    }


    bool
    ContactSearch::find_nearest(const unsigned int     edge,
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


    std::vector<ContactSearch::Division>
    ContactSearch::divisions(const unsigned int position,
                             const unsigned int n_parts) const
    {
      const unsigned int    slave = slave_edges[position];
      std::vector<Division> found;
      for (const unsigned int master : masters(position))
        for (const unsigned int end : {0U, 1U})
        {
          if (n_parts > 1 && !is_corner(master, end))
            continue;
          const ContactPosition x = surface->place(master, end).x;
          double                t;
          Place                 place;
          if (!surface->is_further(slave, x, reach, 0., 0.) &&
              find_nearest(slave, x, t, place) && t > same_division &&
              t < 1. - same_division && place.x.distance(x) <= reach &&
              along_face(
                -(place.normal() * surface->place(master, end).normal())) > 0.)
            found.push_back(
              {t, is_corner(master, end) ? master : invalid_index, end, false});
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
    ContactSearch::is_in_reach(const unsigned int     position,
                               const ContactPosition &x) const
    {
      for (const unsigned int master : masters(position))
      {
        double t;
        Place  place;
        if (!surface->is_further(master, x, reach, 0., 0.) &&
            find_nearest(master, x, t, place) &&
            surface->place(master, std::clamp(t, 0., 1.)).x.distance(x) <=
              reach)
          return true;
      }
      return false;
    }


    double
    ContactSearch::relative_curvature(const unsigned int edge,
                                      const unsigned int other) const
    {
      double sum = 0.;
      for (const unsigned int e : {edge, other})
        if (surface->edges()[e].radius != 0.)
          sum += 1. / surface->edges()[e].radius;
      return sum;
    }


    double
    ContactSearch::largest_curvature(const unsigned int position) const
    {
      const unsigned int slave  = slave_edges[position];
      double             result = 0.;
      for (const unsigned int master : masters(position))
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


    bool
    ContactSearch::meet_in_convex_corner(const unsigned int edge,
                                         const unsigned int other) const
    {
      return corner_between(edge, other) == ContactSurface::Corner::convex;
    }


    /// Some of the edges between both may be slivers.
    ContactSurface::Corner
    ContactSearch::corner_between(const unsigned int edge,
                                  const unsigned int other) const
    {
      const auto &edges = surface->edges();
      for (const auto &[from, to] :
           {std::make_pair(edge, other), std::make_pair(other, edge)})
      {
        auto         corner = ContactSurface::Corner::smooth;
        unsigned int e      = from;
        for (unsigned int i = 0; i < most_edges_of_corner && e != invalid_index;
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


    ContactProjection
    ContactSearch::project(const Place                                &place,
                           const dealii::ArrayView<const unsigned int> masters,
                           const double                                slack,
                           const unsigned int                          home,
                           const AdmittedContact &admitted) const
    {
      const unsigned int body =
        home < any_edge ? surface->edges()[home].body : invalid_index;
      return project_within(place, masters, slack, home, body, reach, admitted);
    }


    ContactProjection
    ContactSearch::project_corner(
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
        if (surface->is_further(master, slave_place.x, reach, before, after) ||
            !find_nearest(master, slave_place.x, now.t, now.place) ||
            now.t < -before || now.t > 1. + after)
          continue;
        now.normal = now.place.normal();
        now.gap    = (slave_place.x - now.place.x) * now.normal;
        if (std::abs(now.gap) <= reach)
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
             meet_in_convex_corner(now.master, near[j].master));
        if (is_of_other_edge)
          continue;
        // The point is outside if it is in front of the other face of the master's corner.
        for (unsigned int j = 0; j < n && now.gap < 0.; ++j)
          if (near[j].gap >= 0. &&
              can_separate(near[j].normal, slave_normal, other_normal) &&
              meet_in_convex_corner(now.master, near[j].master))
            now.gap = near[j].gap;
        const bool is_inside = now.gap < 0., best_is_inside = best.gap < 0.;
        if (best.master == invalid_index ||
            (is_inside != best_is_inside
               ? is_inside
               : std::abs(now.gap) < std::abs(best.gap) - same_gap * reach))
          best = now;
      }
      return best;
    }


    /// The edge is found by its direction. The feet of points next to a master's corner are beyond
    /// the end of an edge that is not parallel, and where corners of two bodies have passed each
    /// other the nearer one would be found for both. Corners that are far behind the slave are
    /// excluded.
    unsigned int
    ContactSearch::edge_beside(const unsigned int position,
                               const Division    &division,
                               const double       s_inside) const
    {
      if (division.master == invalid_index)
        return invalid_index;
      const auto &corner = surface->edges()[division.master];
      const Place slave  = surface->place(slave_edges[position], division.s);
      if ((surface->place(division.master, division.end).x - slave.x) *
            slave.normal() <=
          -behind_division * reach)
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
    ContactSearch::face_at(const unsigned int position, const double s) const
    {
      AdmittedContact admitted;
      admitted.least_facing = least_facing_along;
      return project_within(surface->place(slave_edges[position], s),
                            masters(position),
                            0.,
                            invalid_index,
                            invalid_index,
                            reach_of_piece * reach,
                            admitted)
        .master;
    }


    double
    ContactSearch::end_slack(const unsigned int position,
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


    double
    ContactSearch::extension(const ContactSurface::Corner corner,
                             const double                 slack)
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


    double
    ContactSearch::slack_of(const unsigned int master,
                            const double       slack,
                            const unsigned int home)
    {
      return slack < 0. || master == home || home == any_edge ? slack
                                                              : beyond_rounding;
    }


    unsigned int
    ContactSearch::find_home(const unsigned int position,
                             const double       s,
                             const unsigned int master) const
    {
      const auto             &edges  = surface->edges();
      const unsigned int      slave  = slave_edges[position];
      const ContactProjection result = project_within(surface->place(slave, s),
                                                      masters(position),
                                                      end_of_home,
                                                      any_edge,
                                                      edges[master].body,
                                                      reach,
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
    ContactSearch::project_within(
      const Place                                &slave_place,
      const dealii::ArrayView<const unsigned int> masters,
      const double                                given_slack,
      const unsigned int                          home,
      const unsigned int                          body,
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
        if (body != invalid_index && edge.body != body)
          continue;
        const double slack  = slack_of(master, given_slack, home);
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
          !is_better &&
          corner_between(best.master, master) != ContactSurface::Corner::smooth;
        // Where corners of both bodies coincide, neither a small slip nor the closure of springs
        // moves a point to the face round the corner; after a larger slip the slave is divided
        // there.
        const double same_overshoot =
          is_corner ? end_of_home * edge.length : same_gap * reach;
        if (!is_better && std::abs(overshoot - best_overshoot) > same_overshoot)
          is_better = overshoot < best_overshoot;
        else if (is_corner)
          is_better = facing > best_facing + same_gap;
        else if (!is_better)
        {
          const double difference = std::abs(now.gap) - std::abs(best.gap);
          is_better               = std::abs(difference) > same_gap * reach
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
      if (best.master == invalid_index || best.gap >= -same_gap * reach)
        return best;
      const ContactSurface::Edge &edge    = surface->edges()[best.master];
      constexpr auto              concave = ContactSurface::Corner::concave;
      // At the tip of a wedge the springs may be compressed by more than the wedge is thick. A point
      // whose piece was laid on this face stays with it there.
      const bool is_at_tip = best.master == home && (best.t < end_of_home ||
                                                     best.t > 1. - end_of_home);
      for (const auto &[far, gap] : outside)
        if (
          surface->edges()[far].body == edge.body &&
          std::abs(gap) < -best.gap && (gap > 0. || admitted.is_bound()) &&
          !(is_at_tip && meet_in_convex_corner(far, best.master)) &&
          // Exclude the two faces of a notch, which have the body on either side.
          !(far == edge.previous && edge.at_start == concave) &&
          !(far == edge.next && edge.at_end == concave))
          return ContactProjection();
      return best;
    }
  } // namespace internal
} // namespace NMM
