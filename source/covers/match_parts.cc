#include "cutting.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// An edge of an element on a physical edge that separates parts.
      struct Side
      {
        unsigned int physical_edge;
        /// 0 if the element is to the left of the physical edge, 1 if it is to the right.
        unsigned int side;
        /// Its vertices at the left and right end.
        unsigned int left, right;
        unsigned int edge, element;
      };


      /// Part of a divided edge, by its vertices at the left and right.
      struct NewEdge
      {
        unsigned int left, right, neighbor;
      };


      class Matcher
      {
      public:
        Matcher(const PhysicalEdges             &physical_edges,
                const std::vector<unsigned int> &region_to_part,
                Cutting                         &cutting)
          : physical_edges(physical_edges)
          , region_to_part(region_to_part)
          , cutting(cutting)
          , edge_to_new(cutting.edges.size(), {0, 0})
        {
        }

        void
        match();

      private:
        std::vector<Side>
        find_sides() const;

        /// Compute the common refinement of both sides of a physical edge.
        void
        match_edge(const std::array<std::vector<Side>, 2> &chains);

        void
        rebuild_edges();

        const PhysicalEdges             &physical_edges;
        const std::vector<unsigned int> &region_to_part;
        Cutting                         &cutting;
        std::vector<NewEdge>             new_edges;
        /// Range of new edges that replaces each edge; empty if the edge is kept.
        std::vector<std::pair<unsigned int, unsigned int>> edge_to_new;
        /// Side of each edge that is replaced.
        std::vector<unsigned char> edge_side;
      };


      std::vector<Side>
      Matcher::find_sides() const
      {
        std::vector<Side> sides;
        for (unsigned int e = 0; e < cutting.elements.size(); ++e)
        {
          const Cutting::Element &element = cutting.elements[e];
          for (unsigned int i = element.first_edge; i < element.end_edge; ++i)
          {
            const Cutting::EdgeOrigin &origin = cutting.origins[i];
            if (origin.physical_edge == invalid_index)
              continue;
            const auto &regions =
              physical_edges.edges()[origin.physical_edge].regions;
            if (regions[0] == invalid_index || regions[1] == invalid_index ||
                region_to_part[regions[0]] == region_to_part[regions[1]])
              continue;
            // An element is to the left of its own edges.
            if (element.region == regions[0])
              sides.push_back(
                {origin.physical_edge, 0, origin.start, origin.end, i, e});
            else
              sides.push_back(
                {origin.physical_edge, 1, origin.end, origin.start, i, e});
          }
        }
        std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
          return std::tie(a.physical_edge, a.side, a.left) <
                 std::tie(b.physical_edge, b.side, b.left);
        });
        return sides;
      }


      /// Edges of one side in the order in which they follow each other, by exact comparison of
      /// their left vertices; coordinates in doubles may tie.
      std::vector<Side>
      chain(const std::vector<Side>::const_iterator begin,
            const std::vector<Side>::const_iterator end)
      {
        std::vector<unsigned int> right;
        for (auto s = begin; s != end; ++s)
          right.push_back(s->right);
        std::sort(right.begin(), right.end());
        auto              next = std::find_if(begin, end, [&](const Side &s) {
          return !std::binary_search(right.begin(), right.end(), s.left);
        });
        std::vector<Side> result;
        while (next != end)
        {
          result.push_back(*next);
          const unsigned int vertex = next->right;
          next                      = std::lower_bound(begin,
                                  end,
                                  vertex,
                                  [](const Side &s, const unsigned int v) {
                                    return s.left < v;
                                  });
          if (next != end && next->left != vertex)
            next = end;
        }
        Assert(result.size() == static_cast<std::size_t>(end - begin),
               ExcInternalError());
        return result;
      }


      void
      Matcher::match_edge(const std::array<std::vector<Side>, 2> &chains)
      {
        const ElementEdge &shape =
          physical_edges.edges()[chains[0].front().physical_edge].shape;
        // Both sides begin and end where the physical edge does.
        for (const std::vector<Side> &chain : chains)
        {
          cutting.vertices[chain.front().left] = shape.start;
          cutting.vertices[chain.back().right] = shape.end;
        }

        // The parameter grows along segments and along arcs up to half circles, at a rate of at
        // least 1, and is as exact as the coordinates.
        const auto parameter = [&](const unsigned int vertex) {
          const Point<2> &x = cutting.vertices[vertex];
          return x.distance(shape.start) - x.distance(shape.end);
        };
        double scale = 0.;
        for (unsigned int d = 0; d < 2; ++d)
          scale =
            std::max({scale, std::abs(shape.start[d]), std::abs(shape.end[d])});
        // Two vertices, each with an error of 8 epsilon in each coordinate.
        const double tolerance =
          64. * std::numeric_limits<double>::epsilon() * scale;

        // Merge the inner vertices of both sides. An interval starts at a vertex and lies on one
        // edge of each side.
        struct Interval
        {
          unsigned int               left;
          std::array<std::size_t, 2> on;
        };
        std::vector<Interval>      intervals;
        std::array<std::size_t, 2> on = {{0, 0}};
        intervals.push_back({chains[0].front().left, on});
        while (true)
        {
          std::array<double, 2> t;
          for (unsigned int s = 0; s < 2; ++s)
            t[s] = on[s] + 1 < chains[s].size()
                     ? parameter(chains[s][on[s]].right)
                     : std::numeric_limits<double>::max();
          if (on[0] + 1 == chains[0].size() && on[1] + 1 == chains[1].size())
            break;
          const unsigned int first  = t[0] <= t[1] ? 0 : 1;
          const unsigned int vertex = chains[first][on[first]].right;
          if (std::abs(t[0] - t[1]) <= tolerance)
          {
            const unsigned int other = chains[1 - first][on[1 - first]].right;
            cutting.vertices[other]  = cutting.vertices[vertex];
            ++on[1 - first];
          }
          ++on[first];
          intervals.push_back({vertex, on});
        }

        for (unsigned int s = 0; s < 2; ++s)
          for (std::size_t k = 0; k < intervals.size(); ++k)
          {
            const Side &here   = chains[s][intervals[k].on[s]],
                       &there  = chains[1 - s][intervals[k].on[1 - s]];
            auto &[first, end] = edge_to_new[here.edge];
            if (first == end)
              first = new_edges.size();
            new_edges.push_back({intervals[k].left,
                                 k + 1 < intervals.size()
                                   ? intervals[k + 1].left
                                   : chains[0].back().right,
                                 there.element});
            end                  = new_edges.size();
            edge_side[here.edge] = s;
          }
      }


      void
      Matcher::rebuild_edges()
      {
        std::vector<ElementEdge> edges;
        edges.reserve(cutting.edges.size() + new_edges.size());
        for (Cutting::Element &element : cutting.elements)
        {
          const unsigned int first_edge = edges.size();
          for (unsigned int i = element.first_edge; i < element.end_edge; ++i)
          {
            ElementEdge edge = cutting.edges[i];
            edge.start       = cutting.vertices[cutting.origins[i].start];
            edge.end         = cutting.vertices[cutting.origins[i].end];
            const auto [first, end]     = edge_to_new[i];
            const unsigned int n_new    = end - first;
            const std::size_t  n_before = edges.size();
            for (unsigned int k = 0; k < n_new; ++k)
            {
              // Elements on the right run along the physical edge in the reverse direction.
              const NewEdge &part =
                new_edges[edge_side[i] == 0 ? first + k : end - 1 - k];
              edge.start    = cutting.vertices[part.left];
              edge.end      = cutting.vertices[part.right];
              edge.neighbor = part.neighbor;
              if (edge_side[i] == 1)
                std::swap(edge.start, edge.end);
              // Distinct vertices can have the same doubles.
              if (edge.start != edge.end)
                edges.push_back(edge);
            }
            if (edges.size() == n_before)
              edges.push_back(edge);
          }
          element.first_edge = first_edge;
          element.end_edge   = edges.size();
        }
        cutting.edges = std::move(edges);
        cutting.origins.clear();
      }


      void
      Matcher::match()
      {
        const std::vector<Side> sides = find_sides();
        edge_side.assign(cutting.edges.size(), 0);
        for (auto begin = sides.begin(); begin != sides.end();)
        {
          const auto middle = std::find_if(begin,
                                           sides.end(),
                                           [&](const Side &s) {
                                             return s.physical_edge !=
                                                      begin->physical_edge ||
                                                    s.side == 1;
                                           }),
                     end =
                       std::find_if(middle, sides.end(), [&](const Side &s) {
                         return s.physical_edge != begin->physical_edge;
                       });
          Assert(middle != begin && middle != end, ExcInternalError());
          match_edge({{chain(begin, middle), chain(middle, end)}});
          begin = end;
        }
        rebuild_edges();
      }
    } // namespace


    void
    match_parts(const PhysicalEdges             &physical_edges,
                const std::vector<unsigned int> &region_to_part,
                Cutting                         &cutting)
    {
      Matcher(physical_edges, region_to_part, cutting).match();
    }
  } // namespace internal
} // namespace NMM
