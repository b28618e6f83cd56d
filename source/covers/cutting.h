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
     * Triangles that a physical curve touches or comes within rounding of,
     * flagged per triangle. May flag a few too many (they cost time), never one
     * too few. @p triangles are corner numbers, @p vertices [m].
     */
    std::vector<unsigned char>
    find_triangles_near_curves(const std::vector<dealii::Point<2>> &vertices,
                               const std::vector<Triangle>         &triangles,
                               const PhysicalMesh &physical_mesh);

    /// The same for some triangles and some edges: rounding is that of
    /// coordinates of up to @p scale [m].
    std::vector<unsigned char>
    find_triangles_near_edges(const std::vector<dealii::Point<2>> &vertices,
                              dealii::ArrayView<const Triangle>    triangles,
                              const std::vector<ElementEdge>      &edges,
                              double                               scale);

    /// For each triangle the edges that touch it or come within rounding of it.
    struct NearEdges
    {
      /// Those of triangle i: edges[first[i]], ..., edges[first[i + 1] - 1].
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
      /// By itself, see DividedCells.
      constexpr unsigned char divided = 1;
      /// See ArrangedCells.
      constexpr unsigned char arranged = 2;
    } // namespace CellState

    /**
     * What the exact cutter finds. Elements are referred to by *codes*: below
     * whole_cell_flag an index into elements, else the untouched cell
     * code - whole_cell_flag, or invalid_index for none.
     */
    constexpr unsigned int whole_cell_flag = 1u << 31;

    /// Straight edges of elements with one loop: each ends where the next one of its
    /// element starts.
    struct PackedEdges
    {
      struct Beyond
      {
        /// See ElementEdge.
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
        /// No physical curve inside the cell.
        bool         is_whole;
        unsigned int first_edge, end_edge;
      };

      /// Where an edge comes from.
      struct EdgeOrigin
      {
        /// Ends, as indices into vertices.
        unsigned int start, end;
        /// Index for PhysicalEdges::edges(), or invalid_index.
        unsigned int physical_edge;
      };

      /// A piece of a mathematical edge that no physical curve blocks, between
      /// two elements (codes).
      struct Link
      {
        unsigned int                mesh_edge;
        std::array<unsigned int, 2> elements;
      };

      std::vector<Element> elements;
      /// The first ones are of divided cells: they have packed_edges, others edges.
      unsigned int             n_packed = 0;
      PackedEdges              packed_edges;
      std::vector<ElementEdge> edges;
      /// Of the edges, if the mesh has several parts.
      std::vector<EdgeOrigin>       origins;
      std::vector<dealii::Point<2>> vertices;
      std::vector<Link>             links;
      /// Region of each untouched cell; invalid_index outside the solid.
      std::vector<unsigned int> cell_region;
      /// By physical edge: is it an edge of some element?
      std::vector<unsigned char> is_met;
    };

    /// The cells beyond the sides of each cell; invalid_index beyond the mesh.
    using CellNeighbors = std::vector<std::array<unsigned int, 3>>;

    CellNeighbors
    find_neighbors(const MathematicalMesh &mesh);

    /// What one part of the mathematical mesh is cut with.
    struct PartToCut
    {
      unsigned int part;
      /// Its cells, first and past-the-end.
      std::pair<unsigned int, unsigned int> cells;
      /// Physical edges that bound or lie in the part's regions, each once.
      std::vector<unsigned int> edges;
    };

    /**
     * Cuts the cells of a part that edges are near to, and appends elements, their edges
     * and how they are joined to @p cutting, whose cell_region and is_met have the
     * sizes of the mesh and of the physical edges. Cells are divided by themselves where
     * that is possible, see CellCutter, and if the mesh has no other parts (what lies on
     * both sides of a curve between parts is matched by the vertices of arrangements);
     * else arranged. @p state is set by cell.
     * @throws InputError where the part's regions stick out of it.
     */
    void
    cut(const MathematicalMesh          &mathematical_mesh,
        const CellNeighbors             &neighbors,
        const PhysicalMesh              &physical_mesh,
        const PhysicalEdges             &physical_edges,
        const std::vector<unsigned int> &region_to_part,
        const PartToCut                 &part,
        const NearEdges                 &near,
        std::vector<unsigned char>      &state,
        Cutting                         &cutting);

    /**
     * Along physical edges between regions on different parts, divide the edges
     * of the elements on each side where those of the other side end, so that
     * both sides have the same edges, with the same doubles as ends, and tell
     * them their neighbours. Ends that are a few ulp apart become one.
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
