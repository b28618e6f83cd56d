#include "cutting.h"

#include <nmm/base/exceptions.h>

#include "arranged_cells.h"
#include "divided_cells.h"
#include <algorithm>
#include <memory>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// Set the region of untouched cells; those that share an edge lie in the same region.
      void
      flood_untouched_cells(const CellNeighbors &neighbors,
                            const std::pair<unsigned int, unsigned int> &cells,
                            const std::vector<unsigned char>            &state,
                            std::vector<unsigned int> &cell_region)
      {
        std::vector<unsigned int> stack;
        for (unsigned int c = cells.first; c < cells.second; ++c)
          if (cell_region[c] != invalid_index)
            stack.push_back(c);
        while (!stack.empty())
        {
          const unsigned int c = stack.back();
          stack.pop_back();
          for (const unsigned int other : neighbors[c])
            if (other != invalid_index &&
                state[other] == CellState::untouched &&
                cell_region[other] == invalid_index)
            {
              cell_region[other] = cell_region[c];
              stack.push_back(other);
            }
        }
      }
    } // namespace


    CellNeighbors
    find_neighbors(const MathematicalMesh &mesh)
    {
      CellNeighbors neighbors(mesh.n_cells());
      const auto   &edges = mesh.edges();
      for (unsigned int c = 0; c < neighbors.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
        {
          const auto &cells = edges[mesh.cell_edges(c)[i]].cells;
          neighbors[c][i]   = cells[cells[0] == c ? 1 : 0];
        }
      return neighbors;
    }


    void
    cut(const PartToCut            &part,
        const CellNeighbors        &neighbors,
        const NearEdges            &near,
        std::vector<unsigned char> &state,
        Cutting                    &cutting)
    {
      const auto [first, end] = part.cells;
      for (unsigned int c = first; c < end; ++c)
        if (near[c - first].size() > 0)
          state[c] = CellState::arranged;
      const NearEdges none;
      DividedCells    divided(part,
                           part.cutter == Cutter::arrangement ? none : near,
                           state,
                           cutting);
      divided.number_elements(cutting);
      std::unique_ptr<ArrangedCells> arranged;
      if (std::find(state.begin() + first,
                    state.begin() + end,
                    CellState::arranged) != state.begin() + end)
        arranged =
          std::make_unique<ArrangedCells>(part, state, divided, cutting);
      divided.label_beside(state, cutting.cell_region);
      flood_untouched_cells(neighbors, part.cells, state, cutting.cell_region);
      divided.append_edges(state, arranged.get(), cutting);
      if (arranged != nullptr)
        arranged->append_edges();

      // A curve that leaves the mesh has left it through an edge of an element.
      for (const unsigned int e : part.edges)
        AssertThrow(cutting.is_met[e],
                    InputError("a part of the solid lies outside the "
                               "mathematical mesh",
                               to_string(
                                 part.physical_edges->edges()[e].shape.start),
                               "give a mesh that covers it"));
    }


    double
    element_area(const Cutting &cutting, const unsigned int element)
    {
      const Cutting::Element &e = cutting.elements[element];
      if (element >= cutting.n_packed)
        return enclosed_area(
          ArrayView<const ElementEdge>(cutting.edges.data() + e.first_edge,
                                       e.end_edge - e.first_edge));
      std::vector<ElementEdge> edges(e.end_edge - e.first_edge);
      for (unsigned int i = 0; i < edges.size(); ++i)
      {
        edges[i].start = cutting.packed_edges.starts[e.first_edge + i];
        edges[i].end =
          cutting.packed_edges
            .starts[i + 1 < edges.size() ? e.first_edge + i + 1 : e.first_edge];
      }
      return enclosed_area(
        ArrayView<const ElementEdge>(edges.data(), edges.size()));
    }
  } // namespace internal
} // namespace NMM
