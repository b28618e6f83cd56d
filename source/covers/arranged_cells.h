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
     * Cuts cells of a part by an exact arrangement. The edges of all cells in CellState::arranged
     * are arranged with all physical edges of the part, untouched cells beside them get their
     * regions, and the elements are appended to @p cutting. On sides in common with divided cells,
     * the coordinates of the divided cells are used.
     *
     * Cost: O(n log n) in the number of physical edges and arranged cells of the part, about 100 us
     * for each cell.
     */
    class ArrangedCells
    {
    public:
      /// Arrange and append the elements. The elements of @p divided must have numbers; all
      /// arguments must outlive this object. @throws InputError where regions of the part extend
      /// beyond it.
      ArrangedCells(const PartToCut                  &part,
                    const std::vector<unsigned char> &state,
                    const DividedCells               &divided,
                    Cutting                          &cutting);

      ~ArrangedCells();

      /// Code of the element at a piece of a side that a divided cell shares, or invalid_index
      /// outside the solid. Pieces are numbered from the vertex with the lower number.
      unsigned int
      element(unsigned int mesh_edge, unsigned int piece) const;

      /// Append the edges of the elements, and all their links.
      void
      append_edges();

      struct Implementation;

    private:
      std::unique_ptr<Implementation> implementation;
    };
  } // namespace internal
} // namespace NMM

#endif
