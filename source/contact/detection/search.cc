#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <contact/detection/corner_rules.h>
#include <contact/detection/search.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;
    using Place = ContactSurface::Place;
    using namespace CornerRules;

    namespace
    {
      namespace bg    = boost::geometry;
      using BoxCorner = bg::model::point<double, 2, bg::cs::cartesian>;
      using Box       = bg::model::box<BoxCorner>;
      using Entry     = std::pair<Box, unsigned int>;

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


    void
    ContactSearch::set_reaches(const std::vector<double> &given)
    {
      AssertDimension(given.size(), surface->n_bodies());
      reaches = given;
      reach   = 2. * *std::max_element(given.begin(), given.end());
    }


    bool
    ContactSearch::update(const std::vector<double> &new_reaches)
    {
      // If the kept reach of a body is larger than this many times the new one, there are too many
      // candidates.
      constexpr double far = 4.;

      set_reaches(new_reaches);
      begin_positions = positions();
      bool is_kept    = !broad_reaches.empty();
      if (is_kept)
      {
        const std::vector<double> ways = distances(known_positions);
        for (unsigned int b = 0; b < reaches.size(); ++b)
          is_kept = is_kept && broad_reaches[b] <= far * reaches[b] &&
                    reaches[b] + ways[b] <= broad_reaches[b];
      }
      if (!is_kept)
        search(new_reaches);
      return !is_kept;
    }


    void
    ContactSearch::search(const std::vector<double> &new_reaches)
    {
      constexpr double margin = 0.5;

      set_reaches(new_reaches);
      broad_reaches = reaches;
      for (double &broad : broad_reaches)
        broad *= 1. + margin;
      const auto broad_reach = [&](const unsigned int edge) {
        return broad_reaches[surface->edges()[edge].body];
      };
      const unsigned int n = surface->edges().size();
      std::vector<Box>   boxes;
      std::vector<Entry> entries;
      boxes.reserve(n);
      entries.reserve(n);
      known_positions = positions();
      for (unsigned int e = 0; e < n; ++e)
      {
        boxes.push_back(box_of(*surface, e, 0.));
        if (!surface->is_absent(e))
          entries.emplace_back(inflated(boxes.back(), broad_reach(e)), e);
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
        find(e, inflated(boxes[e], broad_reach(e)), [&](const unsigned int m) {
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
                 inflated(Box(corner, corner), broad_reach(e)),
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


    std::vector<ContactPosition>
    ContactSearch::positions() const
    {
      std::vector<ContactPosition> result(3 * surface->edges().size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = surface->place(i / 3, 0.5 * (i % 3)).x;
      return result;
    }


    std::vector<double>
    ContactSearch::distances(const std::vector<ContactPosition> &from) const
    {
      std::vector<double> result(surface->n_bodies(), 0.);
      for (unsigned int i = 0; i < from.size(); ++i)
      {
        double &largest = result[surface->edges()[i / 3].body];
        largest =
          std::max(largest,
                   surface->place(i / 3, 0.5 * (i % 3)).x.distance(from[i]));
      }
      return result;
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
  } // namespace internal
} // namespace NMM
