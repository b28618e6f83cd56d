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
     * Label that an edge of PhysicalEdges carries beside those of the pieces it
     * lies on: physical_edge_flag + its number. Pieces have labels below it,
     * mesh edges have labels from mesh_edge_flag on.
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
      /// Curve of each physical edge, with all its labels.
      std::vector<Traits::X_monotone_curve_2> curves;
      /// By PhysicalEdges::vertices().
      std::vector<Traits::Point_2> points;
    };

    /**
     * Centre and signed radius of the circle that @p curve lies on, run along
     * from left to right or the other way (ElementEdge::radius); nothing happens
     * if it is straight.
     */
    void
    set_circle(const Traits::X_monotone_curve_2 &curve,
               bool                              left_to_right,
               const std::vector<CurvePiece>    &pieces,
               ElementEdge                      &edge);
  } // namespace internal
} // namespace NMM

#endif
