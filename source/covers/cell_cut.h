#ifndef nmm_source_covers_cell_cut_h
#define nmm_source_covers_cell_cut_h

// Private: one cell divided by straight physical edges, free of CGAL types.

#include <nmm/covers/manifold_mesh.h>

#include "exact_signs.h"
#include "physical_edges.h"
#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Divides one triangle by straight edges of the physical mesh, with exact topology.
     *
     * Physical edges meet at their ends only, and their ends are vertices of the
     * physical mesh. So what divides a cell are chords: from where an edge enters the
     * cell, or from its end inside, to where it leaves or to its other end. Signs
     * of a few determinants say which; they are decided by doubles where those suffice and
     * exactly where they do not. No point is constructed exactly but to order points on a
     * side that doubles cannot tell apart.
     *
     * The pieces of the sides and both directions of each chord are *half-edges* with
     * what they bound to their left: first those of the sides, counter-clockwise from
     * corner 0, then two for each chord, from the left end of its physical edge to
     * the right one and back. Faces are the loops of half-edges where each is followed
     * by the next one clockwise about its end.
     *
     * Not for arcs, nor for chords that do not hang together with the cell's boundary
     * (cracks and blocks inside a cell).
     * Cost: O(n^2) in the number of edges near the cell, of which there are few.
     */
    class CellCutter
    {
    public:
      /// Regions on other parts count as outside.
      CellCutter(const MathematicalMesh          &mesh,
                 const PhysicalEdges             &physical_edges,
                 const std::vector<unsigned int> &region_to_part,
                 unsigned int                     part);

      enum class Result
      {
        /// No physical edge has more than points in common with the cell.
        whole,
        divided,
        /// Left to the arrangement.
        not_divided
      };

      Result
      divide(unsigned int                                 cell,
             const dealii::ArrayView<const unsigned int> &edges);

      struct HalfEdge
      {
        /// Where it begins; its end is where the next one of the loop begins.
        dealii::Point<2> start;
        /// That it lies on, or invalid_index.
        unsigned int physical_edge;
        unsigned int face;
      };

      struct Face
      {
        /// Region of the physical mesh, or invalid_index.
        unsigned int region;
        /// Its half-edges are loops()[begin], ... , loops()[end - 1].
        unsigned int begin, end;
      };

      /// @name The last cell that was divided
      /// @{
      const std::vector<HalfEdge> &
      half_edges() const;

      /// Where the half-edges of side i begin; [3]: where those of chords do.
      const std::array<unsigned int, 4> &
      first_of_side() const;

      const std::vector<unsigned int> &
      loops() const;

      const std::vector<Face> &
      faces() const;
      /// @}

    private:
      struct Node
      {
        dealii::Point<2> x;
        /// Physical vertex, and physical edge that crosses a side; or invalid_index.
        unsigned int vertex, edge;
        /// Along the mathematical edge, wrong by less than `error`.
        double parameter, error;
      };

      struct Chord
      {
        unsigned int physical_edge;
        /// Nodes, the left one first.
        std::array<unsigned int, 2> ends;
      };

      /// Add what an edge has in common with the cell; false: not possible.
      bool
      add(unsigned int physical_edge);

      /// The same of one on whose line side @p side lies.
      void
      add_along(unsigned int physical_edge, unsigned int side);

      unsigned int
      vertex_on_side(unsigned int vertex, unsigned int side);

      unsigned int
      crossing_on_side(unsigned int physical_edge, unsigned int side);

      unsigned int
      vertex_inside(unsigned int vertex);

      bool
      sort_sides();

      void
      number_boundary();

      bool
      is_connected();

      /// Half-edges of chords that begin at each node, counter-clockwise.
      void
      order_chords();

      /// Does a half-edge of a chord point to the left of another one?
      bool
      comes_before(unsigned int a, unsigned int b, bool is_inside) const;

      void
      trace_faces();

      unsigned int
      start_node(unsigned int half_edge) const;

      unsigned int
      next(unsigned int half_edge) const;

      /// Of what is to the left of a half-edge on a physical edge.
      unsigned int
      region_beside(unsigned int half_edge) const;

      const MathematicalMesh          &mesh;
      const PhysicalEdges             &physical_edges;
      const std::vector<unsigned int> &region_to_part;
      unsigned int                     part;

      unsigned int                    cell = invalid_index;
      std::array<dealii::Point<2>, 3> corners;
      /// Does the side run from the lower to the higher vertex?
      std::array<bool, 3> is_forward;

      std::vector<Node>                        nodes;
      std::array<std::vector<unsigned int>, 3> side_nodes;
      std::vector<Chord>                       chords, along_sides;

      /// Nodes on the boundary, counter-clockwise, and where they are in it.
      std::vector<unsigned int>   boundary, node_to_boundary;
      std::array<unsigned int, 4> first_on_side;

      std::vector<unsigned int>  first_out, out, position_out;
      std::vector<unsigned char> is_reached;

      std::vector<HalfEdge>     half_edge_list;
      std::vector<unsigned int> loop_list;
      std::vector<Face>         face_list;
    };
  } // namespace internal
} // namespace NMM

#endif
