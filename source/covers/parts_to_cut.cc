#include "parts_to_cut.h"

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
               const std::vector<unsigned int> &region_to_part,
               const Cutter                     cutter)
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
                         cutter,
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


    NearEdges
    find_near_edges(const PartToCut &part, const double scale)
    {
      const MathematicalMesh  &mesh           = *part.mesh;
      const PhysicalEdges     &physical_edges = *part.physical_edges;
      std::vector<ElementEdge> shapes;
      shapes.reserve(part.edges.size());
      for (const unsigned int e : part.edges)
        shapes.push_back(physical_edges.edges()[e].shape);
      const auto [first, end] = part.cells;
      NearEdges near          = find_edges_near_triangles(
        mesh.vertices(),
        ArrayView<const Triangle>(mesh.cells().data() + first, end - first),
        shapes,
        scale);
      for (unsigned int &edge : near.edges)
        edge = part.edges[edge];
      return near;
    }
  } // namespace internal
} // namespace NMM
