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
      /// Untouched cells that share an edge lie in the same region.
      void
      flood_untouched_cells(const MathematicalMesh                      &mesh,
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
          for (const unsigned int e : mesh.cell_edges(c))
            for (const unsigned int other : mesh.edges()[e].cells)
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


    void
    cut(const MathematicalMesh          &mathematical_mesh,
        const PhysicalMesh              &physical_mesh,
        const PhysicalEdges             &physical_edges,
        const std::vector<unsigned int> &region_to_part,
        const PartToCut                 &part,
        const NearEdges                 &near,
        std::vector<unsigned char>      &state,
        Cutting                         &cutting)
    {
      const bool is_alone     = mathematical_mesh.n_parts() == 1;
      const auto [first, end] = part.cells;
      for (unsigned int c = first; c < end; ++c)
        if (near[c - first].size() > 0)
          state[c] = CellState::arranged;
      const NearEdges none;
      DividedCells    divided(mathematical_mesh,
                           physical_edges,
                           region_to_part,
                           part,
                           is_alone ? near : none,
                           state);
      divided.number_elements(cutting);
      std::unique_ptr<ArrangedCells> arranged;
      if (!is_alone || std::find(state.begin() + first,
                                 state.begin() + end,
                                 CellState::arranged) != state.begin() + end)
        arranged = std::make_unique<ArrangedCells>(mathematical_mesh,
                                                   physical_mesh,
                                                   physical_edges,
                                                   region_to_part,
                                                   part,
                                                   state,
                                                   divided,
                                                   cutting);
      divided.label_beside(state, cutting.cell_region);
      flood_untouched_cells(mathematical_mesh,
                            part.cells,
                            state,
                            cutting.cell_region);
      divided.append_edges(state, arranged.get(), cutting);
      if (arranged != nullptr)
        arranged->append_edges();

      // A curve that runs out of the mesh has done so through an edge of an element.
      if (mathematical_mesh.rank_cells() == nullptr)
        for (const unsigned int e : part.edges)
          AssertThrow(cutting.is_met[e],
                      InputError("a part of the solid lies outside the "
                                 "mathematical mesh",
                                 to_string(
                                   physical_edges.edges()[e].shape.start),
                                 "give a mesh that covers it"));
    }
  } // namespace internal
} // namespace NMM
