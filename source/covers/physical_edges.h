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

    /// Edges of the physical mesh with the solid on one side at least, each once and
    /// without neighbour, mesh edge and curve set: what is left of the curves when what
    /// reaches outside of the solid is cut off.
    std::vector<ElementEdge>
    solid_edges(const PhysicalMesh &physical_mesh);

    /**
     * The edges of the physical mesh that bound a region or lie in one, numbered
     * through, and found by region. All cutting starts from them: what is made
     * of a region costs in proportion to that region.
     * Cost: one walk over the arrangement.
     */
    class PhysicalEdges
    {
    public:
      struct Edge
      {
        /// Regions to the left and right of the edge run from its left to its
        /// right end (upwards if vertical), invalid_index outside the solid.
        std::array<unsigned int, 2> regions;
        /// A piece of the physical mesh that the edge lies on.
        unsigned int piece = invalid_index;
        /// Whether it lies on a line exactly.
        bool is_linear = true;
        /// Of an arc with a straight shape: how far it is from that, at most 1.1e-8 of its
        /// length [m].
        double sagitta = 0.;
        /// If so: that piece's ends, the left one first. They are what
        /// is given, so that the edge lies exactly on the line through them.
        std::array<dealii::Point<2>, 2> line;
        /// Its left and its right end, indices into vertices().
        std::array<unsigned int, 2> vertices;
        /// All pieces that it lies on, an index into curve_sets().
        unsigned int curve_set = invalid_index;
        /// The edge in doubles, from its left to its right end; without
        /// neighbour, mesh edge and curve set. Straight if it is so up to rounding,
        /// see is_nearly_straight().
        ElementEdge shape;
      };

      explicit PhysicalEdges(const PhysicalMesh &physical_mesh);
      ~PhysicalEdges();

      const std::vector<Edge> &
      edges() const;

      /// Ends of edges in doubles: nowhere does an edge end otherwise [m].
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
