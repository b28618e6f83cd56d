#ifndef nmm_tests_covers_matching_h
#define nmm_tests_covers_matching_h

#include <nmm/covers/point_location.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace NMM
{
  namespace Testing
  {
    inline double
    length(const ElementEdge &edge)
    {
      return edge.is_arc() ? std::abs(edge.radius * swept_angle(edge))
                           : edge.start.distance(edge.end);
    }


    /**
     * Every edge with an element on its other side is there exactly once in the
     * other direction, bit for bit, with this element on its other side; and
     * every loop closes bit for bit. Returns the total length of such edges on
     * physical curves, both sides counted [m].
     */
    inline double
    expect_matching_edges(const ManifoldMesh &mesh)
    {
      using Key = std::array<double, 4>;
      std::map<std::pair<Key, unsigned int>, ElementEdge> edge_of;
      const auto key = [](const dealii::Point<2> &a,
                          const dealii::Point<2> &b) {
        return Key{{a[0], a[1], b[0], b[1]}};
      };
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const auto   edges     = mesh.edges(e);
        unsigned int loop_from = 0;
        for (unsigned int i = 0; i < edges.size(); ++i)
        {
          if (edges[i].end == edges[loop_from].start)
            loop_from = i + 1;
          else if (i + 1 == edges.size() || edges[i].end != edges[i + 1].start)
            ADD_FAILURE() << "the boundary of element " << e << " is open";
          // distinct vertices can be the same doubles: such edges have no twin
          if (edges[i].curve_set != invalid_index &&
              edges[i].start != edges[i].end)
          {
            const bool is_new =
              edge_of.insert({{key(edges[i].start, edges[i].end), e}, edges[i]})
                .second;
            EXPECT_TRUE(is_new || edges[i].is_arc()) << "element " << e;
          }
        }
      }
      double total = 0.;
      for (const auto &[where, edge] : edge_of)
      {
        if (edge.neighbor == invalid_index)
          continue;
        total += length(edge);
        const auto twin =
          edge_of.find({key(edge.end, edge.start), edge.neighbor});
        if (twin == edge_of.end())
        {
          ADD_FAILURE() << "an edge of element " << where.second << " at "
                        << edge.start << " has no twin in element "
                        << edge.neighbor;
          continue;
        }
        EXPECT_EQ(twin->second.neighbor, where.second);
        EXPECT_EQ(twin->second.radius, -edge.radius);
        EXPECT_EQ(twin->second.curve_set, edge.curve_set);
      }
      return total;
    }


    /// Sum of the element areas of each region [m^2].
    inline std::vector<double>
    region_areas(const ManifoldMesh &mesh)
    {
      std::vector<double> area(mesh.physical_mesh().regions().size(), 0.);
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        area[mesh.region(e)] += mesh.area(e);
      return area;
    }


    /// Sets of elements connected through joined(): regions, if all is right.
    inline unsigned int
    n_connected_sets(const ManifoldMesh &mesh)
    {
      std::vector<bool>         seen(mesh.n_elements(), false);
      std::vector<unsigned int> stack;
      unsigned int              n = 0;
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        if (!seen[e])
        {
          ++n;
          seen[e] = true;
          stack.push_back(e);
          while (!stack.empty())
          {
            const unsigned int here = stack.back();
            stack.pop_back();
            for (const auto &link : mesh.joined(here))
              if (!seen[link.neighbor])
              {
                seen[link.neighbor] = true;
                stack.push_back(link.neighbor);
              }
          }
        }
      return n;
    }
  } // namespace Testing
} // namespace NMM

#endif
