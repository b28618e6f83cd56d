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
     * Physical edges meet at their ends only, and their ends are vertices of the physical mesh. A
     * cell is therefore divided by chords. A chord begins where an edge enters the cell, or at the
     * edge's end inside, and ends where the edge leaves the cell, or at its other end. The signs of
     * a few determinants determine the chords. They are computed in doubles, and exactly if
     * rounding could change them. Points are constructed exactly only to order points on a side
     * that doubles cannot distinguish.
     *
     * The pieces of the sides and both directions of each chord are *half-edges*, with the face
     * that they bound on their left. The half-edges of the sides come first, counter-clockwise from
     * corner 0; then two for each chord, from the left end of its physical edge to the right one
     * and back. Faces are the loops of half-edges in which each one is followed by the next one
     * clockwise about its end.
     *
     * Chords that are not connected to the cell's boundary are supported if they are outlines of
     * blocks with no solid of the part around them. A loop of half-edges is then the whole boundary
     * of a face in the solid, as it is for connected chords. Arcs, and cracks and holes inside of a
     * cell are not supported.
     * Cost: O(n^2) in the number of edges near the cell, of which there are few.
     */
    class CellCutter
    {
    public:
      /// Prepare for the cells of one part. Regions on other parts count as outside of the solid.
      CellCutter(const MathematicalMesh          &mesh,
                 const PhysicalEdges             &physical_edges,
                 const std::vector<unsigned int> &region_to_part,
                 unsigned int                     part);

      enum class Result
      {
        /// Physical edges have at most points in common with the cell.
        whole,
        divided,
        /// The cell cannot be divided here, and is left to the arrangement.
        not_divided
      };

      Result
      divide(unsigned int                                 cell,
             const dealii::ArrayView<const unsigned int> &edges);

      struct HalfEdge
      {
        /// Start of the half-edge; it ends where the next one of the loop starts.
        dealii::Point<2> start;
        /// Physical edge on which the half-edge lies, or invalid_index.
        unsigned int physical_edge;
        unsigned int face;
        /// Number of the start among the points of the cell: 0, 1 and 2 are its corners.
        unsigned int node;
      };

      struct Face
      {
        /// Region of the physical mesh, or invalid_index.
        unsigned int region;
        /// Half-edges of the face: loops()[begin], ... , loops()[end - 1].
        unsigned int begin, end;
      };

      /// @name The last cell that was divided
      /// @{
      const std::vector<HalfEdge> &
      half_edges() const;

      /// First half-edge of each side i; entry [3] is the first one of the chords.
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
        /// Physical vertex at the node, and physical edge that crosses a side there; or
        /// invalid_index.
        unsigned int vertex, edge;
        /// Parameter along the mathematical edge [-], with an error of less than `error`.
        double parameter, error;
      };

      struct Chord
      {
        unsigned int physical_edge;
        /// Nodes at both ends, the left one first.
        std::array<unsigned int, 2> ends;
      };

      /// Add the parts that a physical edge has in common with the cell. Returns false if that is
      /// not possible.
      bool
      add(unsigned int physical_edge);

      /// The same for a physical edge that lies on the line of the side @p side.
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

      /// Find the nodes that are connected to the cell's boundary.
      void
      reach_nodes();

      /// Half-edges of chords that begin at each node, counter-clockwise.
      void
      order_chords();

      /// Whether a half-edge of a chord points to the left of another one.
      bool
      comes_before(unsigned int a, unsigned int b, bool is_inside) const;

      void
      trace_faces();

      /// Whether no face in the solid has more than one loop.
      bool
      has_simple_faces() const;

      unsigned int
      next(unsigned int half_edge) const;

      /// Region to the left of a half-edge on a physical edge.
      unsigned int
      region_beside(unsigned int half_edge) const;

      const MathematicalMesh          &mesh;
      const PhysicalEdges             &physical_edges;
      const std::vector<unsigned int> &region_to_part;
      unsigned int                     part;

      unsigned int                    cell = invalid_index;
      std::array<dealii::Point<2>, 3> corners;
      /// For each side, whether it runs from the lower to the higher vertex number.
      std::array<bool, 3> is_forward;

      std::vector<Node>                        nodes;
      std::array<std::vector<unsigned int>, 3> side_nodes;
      std::vector<Chord>                       chords, along_sides;

      /// Nodes on the boundary, counter-clockwise, and position of each node among them.
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
