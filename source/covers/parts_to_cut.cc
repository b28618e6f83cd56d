#include "parts_to_cut.h"

#include <nmm/covers/point_location.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    std::vector<PartToCut>
    find_parts(const MathematicalMesh          &mesh,
               const PhysicalMesh              &physical_mesh,
               const PhysicalEdges             &physical_edges,
               const std::vector<unsigned int> &region_to_part)
    {
      const auto part_of = [&](const unsigned int region) {
        return region_to_part.empty() ? 0u : region_to_part[region];
      };
      std::vector<PartToCut> parts;
      for (unsigned int p = 0; p < mesh.n_parts(); ++p)
        parts.push_back({&mesh,
                         &physical_mesh,
                         &physical_edges,
                         &region_to_part,
                         p,
                         mesh.part_cells(p),
                         {}});
      for (unsigned int r = 0; r < physical_mesh.regions().size(); ++r)
        for (const unsigned int e : physical_edges.region_edges(r))
        {
          // An edge between two regions of a part is taken once.
          const unsigned int left = physical_edges.edges()[e].regions[0];
          if (left == r || left == invalid_index || part_of(left) != part_of(r))
            parts[part_of(r)].edges.push_back(e);
        }
      parts.erase(std::remove_if(parts.begin(),
                                 parts.end(),
                                 [](const PartToCut &part) {
                                   return part.edges.empty();
                                 }),
                  parts.end());
      return parts;
    }


    double
    largest_coordinate(const BoundingBox<2> &box)
    {
      double largest = 0.;
      for (unsigned int d = 0; d < 2; ++d)
        largest = std::max({largest,
                            std::abs(box.lower_bound(d)),
                            std::abs(box.upper_bound(d))});
      return largest;
    }


    namespace
    {
      /// Lowest and highest coordinates of an edge.
      std::pair<Point<2>, Point<2>>
      extent(const MathematicalMesh &mesh)
      {
        std::pair<Point<2>, Point<2>> box(mesh.vertices()[0],
                                          mesh.vertices()[0]);
        for (const Point<2> &x : mesh.vertices())
          for (unsigned int d = 0; d < 2; ++d)
          {
            box.first[d]  = std::min(box.first[d], x[d]);
            box.second[d] = std::max(box.second[d], x[d]);
          }
        return box;
      }


      /// Whether the edge may have points in the box, with a margin of a millionth of its size.
      bool
      comes_near(const ElementEdge                   &edge,
                 const std::pair<Point<2>, Point<2>> &box)
      {
        // An arc lies within a radius of its ends, because it is at most a half circle.
        const double reach = std::abs(edge.radius);
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double margin = reach + 1e-6 * (box.second[d] - box.first[d]);
          if (std::max(edge.start[d], edge.end[d]) + margin < box.first[d] ||
              std::min(edge.start[d], edge.end[d]) - margin > box.second[d])
            return false;
        }
        return true;
      }
    } // namespace


    void
    label_far_cells(const MathematicalMesh           &mesh,
                    const PhysicalEdges              &physical_edges,
                    const unsigned int                n_regions,
                    const std::vector<unsigned char> &state,
                    std::vector<unsigned int>        &cell_region)
    {
      std::vector<unsigned char> seen(state);
      std::vector<unsigned int>  set;
      for (unsigned int start = 0; start < mesh.n_cells(); ++start)
      {
        if (seen[start])
          continue;
        set.assign(1, start);
        seen[start]     = 1;
        bool is_decided = false;
        for (unsigned int i = 0; i < set.size(); ++i)
          for (const unsigned int e : mesh.cell_edges(set[i]))
            for (const unsigned int c : mesh.edges()[e].cells)
              if (c == invalid_index)
                continue;
              else if (state[c])
                is_decided = true;
              else if (!seen[c])
              {
                seen[c] = 1;
                set.push_back(c);
              }
        if (is_decided)
          continue;
        const Point<2> x =
          mesh.reference_to_real(start, Point<2>(1. / 3., 1. / 3.));
        for (unsigned int r = 0; r < n_regions; ++r)
        {
          std::vector<ElementEdge> boundary;
          for (const unsigned int e : physical_edges.region_edges(r))
            if (physical_edges.edges()[e].regions[0] !=
                physical_edges.edges()[e].regions[1])
              boundary.push_back(physical_edges.edges()[e].shape);
          if (is_inside(ArrayView<const ElementEdge>(boundary.data(),
                                                     boundary.size()),
                        x))
          {
            for (const unsigned int c : set)
              cell_region[c] = r;
            break;
          }
        }
      }
    }


    NearEdges
    find_near_edges(const PartToCut &part, const double scale)
    {
      const MathematicalMesh   &mesh           = *part.mesh;
      const PhysicalEdges      &physical_edges = *part.physical_edges;
      std::vector<ElementEdge>  shapes;
      std::vector<unsigned int> shape_to_edge;
      shapes.reserve(part.edges.size());
      const bool is_distributed = mesh.rank_cells() != nullptr;
      const std::pair<Point<2>, Point<2>> box =
        is_distributed ? extent(mesh) : std::pair<Point<2>, Point<2>>();
      for (const unsigned int e : part.edges)
        if (!is_distributed || comes_near(physical_edges.edges()[e].shape, box))
        {
          shapes.push_back(physical_edges.edges()[e].shape);
          shape_to_edge.push_back(e);
        }
      const auto [first, end] = part.cells;
      NearEdges near          = find_edges_near_triangles(
        mesh.vertices(),
        ArrayView<const Triangle>(mesh.cells().data() + first, end - first),
        shapes,
        scale);
      for (unsigned int &edge : near.edges)
        edge = shape_to_edge[edge];
      return near;
    }
  } // namespace internal
} // namespace NMM
