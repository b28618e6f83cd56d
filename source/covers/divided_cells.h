#ifndef nmm_source_covers_divided_cells_h
#define nmm_source_covers_divided_cells_h

// Private: the cells of a part that are divided one by one, free of CGAL types.

#include "cell_cut.h"
#include "cutting.h"
#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class ArrangedCells;

    /**
     * Cells near straight physical edges, each divided separately by CellCutter. Both cells of a
     * mathematical edge find the same points on it, with the same coordinates and in the same
     * order, so that the pieces of a side are matched by their number.
     */
    class DividedCells
    {
    public:
      /**
       * Divides the cells of a part that have edges near them. @p state is set to
       * CellState::untouched if edges have only points in common with the cell, else to `divided`
       * or `arranged`. If the mesh has several parts, the vertices of the divided cells are
       * appended to @p cutting. Nothing is done if @p near is empty.
       */
      DividedCells(const PartToCut            &part,
                   const NearEdges            &near,
                   std::vector<unsigned char> &state,
                   Cutting                    &cutting);

      bool
      empty() const;

      /// Whether the mesh has several parts. Elements then have edges with origins for
      /// match_parts(), else packed edges, which need less memory.
      bool
      has_vertices() const;

      /// Set the regions of untouched cells beside divided ones.
      void
      label_beside(const std::vector<unsigned char> &state,
                   std::vector<unsigned int>        &cell_region) const;

      /// Append the faces inside of the solid to the elements of @p cutting.
      void
      number_elements(Cutting &cutting);

      /// Number of pieces of a side of a cell; pieces are numbered counter-clockwise.
      unsigned int
      n_pieces(unsigned int cell, unsigned int side) const;

      /// Code of the element at a piece, or invalid_index outside the solid.
      unsigned int
      element(unsigned int cell, unsigned int side, unsigned int piece) const;

      /// Start of a piece.
      const dealii::Point<2> &
      start(unsigned int cell, unsigned int side, unsigned int piece) const;

      /// Start of a piece as an index into Cutting::vertices, if has_vertices().
      unsigned int
      vertex(unsigned int cell, unsigned int side, unsigned int piece) const;

      /// Append the edges of the elements and their links, except links to arranged cells, which
      /// ArrangedCells appends. @throws InputError where the solid extends beyond the mesh.
      void
      append_edges(const std::vector<unsigned char> &state,
                   const ArrangedCells              *arranged,
                   Cutting                          &cutting) const;

    private:
      struct Cell
      {
        unsigned int cell, first_half_edge, first_face;
        /// First half-edge of each side i: first_half_edge + first_of_side[i].
        std::array<unsigned int, 4> first_of_side;
      };

      struct HalfEdge
      {
        dealii::Point<2> start;
        unsigned int     physical_edge, face;
      };

      struct Face
      {
        unsigned int region;
        /// First half-edge in loops; the last one is before that of the next face.
        unsigned int begin;
        /// Code of the element.
        unsigned int element;
      };

      void
      keep(unsigned int cell, const CellCutter &cutter);

      /// Number the vertices of the last cell that was kept.
      void
      number_vertices(const CellCutter &cutter, Cutting &cutting);

      /// Vertex at which a piece starts, from the other cell of the side; invalid_index if that has
      /// not been divided.
      unsigned int
      vertex_from_beyond(unsigned int cell,
                         unsigned int side,
                         unsigned int piece) const;

      const Cell &
      divided(unsigned int cell) const;

      /// Element beyond a piece of a side.
      unsigned int
      element_beyond(const Cell                       &cell,
                     unsigned int                      side,
                     unsigned int                      piece,
                     const std::vector<unsigned char> &state,
                     const ArrangedCells              *arranged,
                     const Cutting                    &cutting) const;

      /// Number of the edges of elements so far.
      std::size_t
      n_edges(const Cutting &cutting) const;

      /// Append an edge from the start of half-edge @p h to that of half-edge @p next.
      void
      append_edge(unsigned int               h,
                  unsigned int               next,
                  const PackedEdges::Beyond &beyond,
                  Cutting                   &cutting) const;

      const MathematicalMesh               &mesh;
      const PhysicalEdges                  &physical_edges;
      std::pair<unsigned int, unsigned int> part_cells;
      std::vector<unsigned int>             cell_to_divided;
      /// The cells, and one past the end.
      std::vector<Cell>     cells;
      std::vector<HalfEdge> half_edges;
      /// Start of each half-edge, an index into Cutting::vertices; empty if the mesh has one part.
      std::vector<unsigned int> half_edge_to_vertex;
      std::vector<unsigned int> loops;
      /// The faces, and one past the end.
      std::vector<Face> faces;
    };
  } // namespace internal
} // namespace NMM

#endif
