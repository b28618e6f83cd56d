#ifndef nmm_source_covers_cutting_h
#define nmm_source_covers_cutting_h

// Private: the steps of building a ManifoldMesh, free of CGAL types.

#include <nmm/covers/manifold_mesh.h>

#include "physical_edges.h"
#include <array>
#include <map>
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

    /// More than one edge.
    constexpr unsigned int several_edges = invalid_index - 1;

    /**
     * For each triangle the number of the only edge that touches it or comes within
     * rounding of it; several_edges, or invalid_index for none.
     */
    std::vector<unsigned int>
    find_edges_near_triangles(const std::vector<dealii::Point<2>> &vertices,
                              dealii::ArrayView<const Triangle>    triangles,
                              const std::vector<ElementEdge>      &edges,
                              double                               scale);

    /**
     * A cell that one straight physical edge runs through, in at one side and out at
     * another, clear of the corners, and that no other one comes near: it
     * needs no arrangement. The elements are a triangle at one corner and a
     * quadrilateral.
     */
    struct SimpleCut
    {
      unsigned int cell;
      unsigned int physical_edge;
      /// The corner that is alone on its side: sides `corner` and
      /// (corner + 2) % 3 of the cell are crossed.
      unsigned int corner;
      /// Is it to the left of the edge run from its left to its right end?
      bool corner_is_left;
    };

    /**
     * The cells of a mesh that are cut simply, in ascending order. All decisions have a
     * margin of many roundings; what is nearer is left to the arrangement.
     * @p only_edge: see find_edges_near_triangles().
     */
    std::vector<SimpleCut>
    find_simple_cuts(const MathematicalMesh          &mesh,
                     const PhysicalEdges             &physical_edges,
                     const std::vector<CurvePiece>   &pieces,
                     const std::vector<unsigned int> &only_edge,
                     double                           scale);

    /**
     * Where the straight line that @p piece lies on crosses the segment from @p u to
     * @p v; the same doubles whichever cell asks, if u and v come in the same order.
     * Within few roundings of the coordinates.
     */
    dealii::Point<2>
    crossing(const CurvePiece       &piece,
             const dealii::Point<2> &u,
             const dealii::Point<2> &v);

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

      std::vector<Element>                   elements;
      std::vector<ElementEdge>               edges;
      std::vector<EdgeOrigin>                origins;
      std::vector<dealii::Point<2>>          vertices;
      std::vector<Link>                      links;
      std::vector<std::vector<unsigned int>> curve_sets;
      /// Region of each untouched cell; invalid_index outside the solid.
      std::vector<unsigned int> cell_region;

      std::map<std::vector<unsigned int>, unsigned int> curve_set_to_index;
    };

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
     * Arrange the edges of @p touched cells of a part with its physical edges
     * exactly, but for those that are cut simply, read off elements, their edges and
     * how they are joined, and append them to @p cutting, whose cell_region has the
     * size of the mesh. Vertices of edges of @p simple_cuts are not numbered.
     * Cost: O(n log n) in the number of physical edges and arranged cells of the
     * part, plus O(1) for each of its cells.
     * @throws InputError where the part's regions stick out of it.
     */
    void
    cut(const MathematicalMesh           &mathematical_mesh,
        const PhysicalMesh               &physical_mesh,
        const PhysicalEdges              &physical_edges,
        const std::vector<unsigned int>  &region_to_part,
        const PartToCut                  &part,
        const std::vector<unsigned char> &touched,
        const std::vector<SimpleCut>     &simple_cuts,
        Cutting                          &cutting);

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

    /// Area that closed loops of edges enclose [m^2], never negative.
    double
    enclosed_area(dealii::ArrayView<const ElementEdge> edges);
  } // namespace internal
} // namespace NMM

#endif
