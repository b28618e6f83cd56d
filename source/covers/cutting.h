#ifndef nmm_source_covers_cutting_h
#define nmm_source_covers_cutting_h

// Private: the steps of building a ManifoldMesh, free of CGAL types.

#include <nmm/covers/manifold_mesh.h>

#include "physical_edges.h"
#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    using Triangle = std::array<unsigned int, 3>;

    /**
     * Flags the triangles that a physical curve touches or approaches within rounding. Triangles
     * that are flagged without need only cost time; none is missed. @p triangles are corner
     * numbers, @p vertices in [m].
     */
    std::vector<unsigned char>
    find_triangles_near_curves(const std::vector<dealii::Point<2>> &vertices,
                               const std::vector<Triangle>         &triangles,
                               const PhysicalMesh &physical_mesh);

    /// The same for some of the triangles and edges. Rounding is that of coordinates up to @p scale
    /// [m].
    std::vector<unsigned char>
    find_triangles_near_edges(const std::vector<dealii::Point<2>> &vertices,
                              dealii::ArrayView<const Triangle>    triangles,
                              const std::vector<ElementEdge>      &edges,
                              double                               scale);

    /// For each triangle, the physical edges that touch it or approach it within rounding.
    struct NearEdges
    {
      /// The edges of triangle i are edges[first[i]], ..., edges[first[i + 1] - 1].
      std::vector<unsigned int> first, edges;

      dealii::ArrayView<const unsigned int>
      operator[](const unsigned int i) const
      {
        return dealii::ArrayView<const unsigned int>(edges.data() + first[i],
                                                     first[i + 1] - first[i]);
      }
    };

    NearEdges
    find_edges_near_triangles(const std::vector<dealii::Point<2>> &vertices,
                              dealii::ArrayView<const Triangle>    triangles,
                              const std::vector<ElementEdge>      &edges,
                              double                               scale);

    /// How a cell of the mathematical mesh is cut.
    namespace CellState
    {
      constexpr unsigned char untouched = 0;
      /// The cell is divided separately, see DividedCells.
      constexpr unsigned char divided = 1;
      /// The cell is cut by an arrangement, see ArrangedCells.
      constexpr unsigned char arranged = 2;
    } // namespace CellState

    /**
     * Result of the exact cutting. Elements are referred to by *codes*: a code below
     * whole_cell_flag is an index into elements, other codes are the untouched cell code -
     * whole_cell_flag, or invalid_index for none.
     */
    constexpr unsigned int whole_cell_flag = 1u << 31;

    /// Straight edges of elements with one loop: each edge ends where the next one of its element
    /// starts.
    struct PackedEdges
    {
      struct Beyond
      {
        /// Members of ElementEdge.
        unsigned int curve_set, neighbor, mesh_edge;
      };

      std::vector<dealii::Point<2>> starts;
      std::vector<Beyond>           beyond;
    };


    struct Cutting
    {
      struct Element
      {
        unsigned int cell, region;
        /// Whether there is no physical curve inside of the cell.
        bool         is_whole;
        unsigned int first_edge, end_edge;
      };

      /// Origin of an edge.
      struct EdgeOrigin
      {
        /// Ends, as indices into vertices.
        unsigned int start, end;
        /// Physical edge, an index for PhysicalEdges::edges(), or invalid_index.
        unsigned int physical_edge;
      };

      /// Connection of two elements (codes) across a piece of a mathematical edge without a
      /// physical curve.
      struct Link
      {
        unsigned int                mesh_edge;
        std::array<unsigned int, 2> elements;
      };

      std::vector<Element> elements;
      /// Number of elements of divided cells, which come first, if the mesh has only one part. They
      /// have packed_edges, the others edges.
      unsigned int             n_packed = 0;
      PackedEdges              packed_edges;
      std::vector<ElementEdge> edges;
      /// Origins of the edges, for match_parts().
      std::vector<EdgeOrigin>       origins;
      std::vector<dealii::Point<2>> vertices;
      /// Vertex at each vertex of a mathematical mesh of several parts that is a corner of a
      /// divided cell, else invalid_index.
      std::vector<unsigned int> corner_to_vertex;
      std::vector<Link>         links;
      /// Region of each untouched cell; invalid_index outside the solid.
      std::vector<unsigned int> cell_region;
      /// For each physical edge, whether it is an edge of some element.
      std::vector<unsigned char> is_met;
    };

    /// Cells beyond the three sides of each cell; invalid_index where there is none.
    using CellNeighbors = std::vector<std::array<unsigned int, 3>>;

    CellNeighbors
    find_neighbors(const MathematicalMesh &mesh);

    /// A part of the mathematical mesh, and the physical edges that cut it. All that it points to
    /// must outlive it.
    struct PartToCut
    {
      const MathematicalMesh *mesh;
      const PhysicalMesh     *physical_mesh;
      const PhysicalEdges    *physical_edges;
      /// Part of the mesh on which each region is; empty if there is only one.
      const std::vector<unsigned int> *region_to_part;
      Cutter                           cutter;

      unsigned int part;
      /// Cells of the part, first and past-the-end.
      std::pair<unsigned int, unsigned int> cells;
      /// Physical edges that bound the part's regions or lie in them, each once.
      std::vector<unsigned int> edges;
    };

    /**
     * Cuts the cells of a part that physical edges are near to, and appends elements, their edges
     * and their links to @p cutting. Its members cell_region and is_met must have the sizes of the
     * mesh and of the physical edges. Cells are divided separately where CellCutter can do so, and
     * other cells are arranged; see PartToCut::cutter. @p state is set for each cell. @throws
     * InputError where the part's regions extend beyond it.
     */
    void
    cut(const PartToCut            &part,
        const CellNeighbors        &neighbors,
        const NearEdges            &near,
        std::vector<unsigned char> &state,
        Cutting                    &cutting);

    /**
     * Along physical edges between regions on different parts, divides the edges of elements where
     * edges of the other side end. Both sides then have the same edges with the same coordinates,
     * and each edge knows its neighbour on the other side. Ends that differ by rounding only are
     * merged.
     */
    void
    match_parts(const PhysicalEdges             &physical_edges,
                const std::vector<unsigned int> &region_to_part,
                Cutting                         &cutting);

    /// Area of an element that was cut [m^2], never negative.
    double
    element_area(const Cutting &cutting, unsigned int element);

    /// Area that closed loops of edges enclose [m^2], never negative.
    double
    enclosed_area(dealii::ArrayView<const ElementEdge> edges);
  } // namespace internal
} // namespace NMM

#endif
