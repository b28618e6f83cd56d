#ifndef nmm_source_covers_physical_edges_h
#define nmm_source_covers_physical_edges_h

// Private: the edges of the physical mesh's arrangement, free of CGAL types.

#include <nmm/covers/manifold_mesh.h>

#include <array>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The exact curves; see source/covers/exact_curves.h.
    struct ExactCurves;

    /// Edges of the physical mesh with the solid on at least one side, each once, without
    /// neighbour, mesh edge and curve set. They are the curves without the parts outside of the
    /// solid.
    std::vector<ElementEdge>
    solid_edges(const PhysicalMesh &physical_mesh);

    /**
     * The edges of the physical mesh that bound a region or lie in one, numbered consecutively, and
     * sorted by region. All cutting starts from them, so that the cost for a region is proportional
     * to the size of that region.
     *
     * Cost: one traversal of the arrangement.
     */
    class PhysicalEdges
    {
    public:
      struct Edge
      {
        /// Regions to the left and right of the edge run from its left to its
        /// right end (upwards if vertical), invalid_index outside the solid.
        std::array<unsigned int, 2> regions;
        /// One of the pieces of the physical mesh on which the edge lies.
        unsigned int piece = invalid_index;
        /// Whether the edge lies exactly on a straight line.
        bool is_linear = true;
        /// Sagitta of an arc whose shape is straight [m], at most 1.1e-8 of its length.
        double sagitta = 0.;
        /// Ends of that piece, the left one first, if is_linear. They are input coordinates, so
        /// that the edge lies exactly on the line through them.
        std::array<dealii::Point<2>, 2> line;
        /// Left and right end of the edge, indices into vertices().
        std::array<unsigned int, 2> vertices;
        /// All pieces on which the edge lies, an index into curve_sets().
        unsigned int curve_set = invalid_index;
        /// The edge in doubles, from its left to its right end, without neighbour, mesh edge and
        /// curve set. It is straight if it is so up to rounding, see is_nearly_straight().
        ElementEdge shape;
      };

      explicit PhysicalEdges(const PhysicalMesh &physical_mesh);
      ~PhysicalEdges();

      const std::vector<Edge> &
      edges() const;

      /// Ends of all edges in doubles [m].
      const std::vector<dealii::Point<2>> &
      vertices() const;

      /// Sets of pieces, each sorted.
      const std::vector<std::vector<unsigned int>> &
      curve_sets() const;

      /// Edges that bound the region or lie in it, each once.
      dealii::ArrayView<const unsigned int>
      region_edges(unsigned int region) const;

      const ExactCurves &
      exact_curves() const;

    private:
      std::vector<Edge>                      all_edges;
      std::vector<dealii::Point<2>>          all_vertices;
      std::vector<std::vector<unsigned int>> all_curve_sets;
      std::vector<unsigned int>              edges_of_regions, first_of_region;
      std::unique_ptr<ExactCurves>           curves;
    };
  } // namespace internal
} // namespace NMM

#endif
