#ifndef nmm_source_geometry_face_measures_h
#define nmm_source_geometry_face_measures_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// An x-monotone edge of the arrangement in doubles, with a direction.
    struct DirectedEdge
    {
      dealii::Point<2> start, end;
      /// 0 for a straight edge, 1 for an arc that runs counter-clockwise from start, -1 for a
      /// clockwise one.
      int bulge = 0;
      /// Centre of an arc [m], and its radius [m].
      dealii::Point<2> center;
      double           radius = 0.;
    };

    /// Length of an edge [m].
    double
    length(const DirectedEdge &edge);

    /**
     * Area [m^2] of the face to the left of closed chains of edges, by Green's
     * theorem about the first vertex: the area of the chords' polygon plus circular segments
     * @f[ \tfrac12 r^2(\theta-\sin\theta). @f]
     */
    double
    enclosed_area(const std::vector<DirectedEdge> &edges);

    /**
     * A point well inside of the same face: the middle of the longest vertical chord among those
     * half-way between successive vertex abscissae (of the 64 widest gaps if there are more).
     *
     * Cost: O(64 · edges).
     */
    dealii::Point<2>
    inside_point(const std::vector<DirectedEdge> &edges);

    /**
     * Bound on the rounding error of enclosed_area() [m^2]. Each vertex is within
     * @f$ 8\sqrt2\,\varepsilon M @f$ of its exact position (to_double()), M being the
     * largest coordinate. With an allowance for the sum the bound is
     * @f[ 16\,\varepsilon \sum_i l_i \max(M, R_i), @f]
     * l being lengths of edges and R radii of arcs (0 if straight). If a face encloses less, its
     * boundary may be degenerate or run the wrong way round after its vertices are rounded.
     */
    double
    area_rounding(const std::vector<DirectedEdge> &edges);

    /// Smallest box around @p edges [m], which must not be empty.
    dealii::BoundingBox<2>
    bounding_box(const std::vector<DirectedEdge> &edges);
  } // namespace internal
} // namespace NMM

#endif
