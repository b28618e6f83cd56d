#ifndef nmm_source_covers_cutting_h
#define nmm_source_covers_cutting_h

// Private: the steps of building a ManifoldMesh, free of CGAL types.

#include <nmm/covers/manifold_mesh.h>

#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Triangles that a physical curve touches or comes within rounding of,
     * flagged per triangle. May flag a few too many (they cost time), never one
     * too few. @p triangles are corner numbers, @p vertices [m].
     */
    std::vector<unsigned char>
    find_triangles_near_curves(
      const std::vector<dealii::Point<2>>            &vertices,
      const std::vector<std::array<unsigned int, 3>> &triangles,
      const PhysicalMesh                             &physical_mesh);

    /**
     * What the exact cutter finds. Elements are referred to by *codes*: below
     * whole_cell_flag an index into elements, else the untouched cell
     * code - whole_cell_flag, or invalid_index for none.
     */
    constexpr unsigned int whole_cell_flag = 1u << 31;

    struct Cutting
    {
      struct Element
      {
        unsigned int cell, region;
        /// No physical curve inside the cell.
        bool         is_whole;
        unsigned int first_edge, end_edge;
      };

      /// A piece of a mathematical edge that no physical curve blocks, between
      /// two elements (codes).
      struct Link
      {
        unsigned int                mesh_edge;
        std::array<unsigned int, 2> elements;
      };

      std::vector<Element>                   elements;
      std::vector<ElementEdge>               edges;
      std::vector<Link>                      links;
      std::vector<std::vector<unsigned int>> curve_sets;
      /// Region of each untouched cell; invalid_index outside the solid.
      std::vector<unsigned int> cell_region;
    };

    /**
     * Insert the edges of @p touched cells into the exact arrangement of the
     * physical mesh and read off elements, their edges and how they are joined.
     * @throws InputError where the solid sticks out of the mathematical mesh.
     */
    Cutting
    cut(const MathematicalMesh           &mathematical_mesh,
        const PhysicalMesh               &physical_mesh,
        const std::vector<unsigned char> &touched);
  } // namespace internal
} // namespace NMM

#endif
