#ifndef nmm_source_covers_arranged_cells_h
#define nmm_source_covers_arranged_cells_h

// Private: the cells of a part that are cut by an arrangement, free of CGAL types.

#include "cutting.h"
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class DividedCells;

    /**
     * Arranges the edges of the cells of a part that are in CellState::arranged with all
     * physical edges of the part, exactly, labels untouched cells beside them, and
     * appends their elements to @p cutting. On sides that they share with divided cells, they
     * take over the doubles of those.
     * Cost: O(n log n) in the number of physical edges and arranged cells of the
     * part, some 100 us for each cell.
     */
    class ArrangedCells
    {
    public:
      /// @p divided with numbered elements; all must outlive this.
      /// @throws InputError where the part's regions stick out of it.
      ArrangedCells(const MathematicalMesh           &mathematical_mesh,
                    const PhysicalMesh               &physical_mesh,
                    const PhysicalEdges              &physical_edges,
                    const std::vector<unsigned int>  &region_to_part,
                    const PartToCut                  &part,
                    const std::vector<unsigned char> &state,
                    const DividedCells               &divided,
                    Cutting                          &cutting);

      ~ArrangedCells();

      /// Code of the element at a piece of a side that a divided cell shares; pieces
      /// are numbered from the vertex with the lower number on. invalid_index: outside.
      unsigned int
      element(unsigned int mesh_edge, unsigned int piece) const;

      /// Edges of the elements, and all their links.
      void
      append_edges();

      struct Implementation;

    private:
      std::unique_ptr<Implementation> implementation;
    };
  } // namespace internal
} // namespace NMM

#endif
