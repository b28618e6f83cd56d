#ifndef nmm_source_covers_exact_curves_h
#define nmm_source_covers_exact_curves_h

// Private: CGAL types shared by physical_edges.cc and cutting.cc.

#include "../geometry/arrangement.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * First label of physical edges. An edge of PhysicalEdges carries the label physical_edge_flag
     * + its number beside those of the pieces on which it lies. Pieces have smaller labels, mesh
     * edges have labels from mesh_edge_flag on.
     */
    constexpr Label physical_edge_flag = 1u << 30;

    inline bool
    is_piece(const Label label)
    {
      return label < physical_edge_flag;
    }

    inline bool
    is_physical_edge(const Label label)
    {
      return label >= physical_edge_flag && label < mesh_edge_flag;
    }

    struct ExactCurves
    {
      /// Exact curve of each physical edge, with all of its labels.
      std::vector<Traits::X_monotone_curve_2> curves;
      /// Exact points, in the order of PhysicalEdges::vertices().
      std::vector<Traits::Point_2> points;
    };

    /**
     * Get the centre and the signed radius (ElementEdge::radius) of the circle on which @p curve
     * lies, for the direction from left to right or the reverse one. Nothing is done if the curve
     * is straight.
     */
    void
    set_circle(const Traits::X_monotone_curve_2 &curve,
               bool                              left_to_right,
               const std::vector<CurvePiece>    &pieces,
               ElementEdge                      &edge);
  } // namespace internal
} // namespace NMM

#endif
