#ifndef nmm_source_geometry_face_measures_h
#define nmm_source_geometry_face_measures_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// An x-monotone arrangement edge in doubles, directed.
    struct DirectedEdge
    {
      dealii::Point<2> start, end;
      /// 0: straight; 1: arc, counterclockwise from start; -1: clockwise.
      int bulge = 0;
      /// Circle of an arc [m].
      dealii::Point<2> center;
      double           radius = 0.;
    };

    /// Length [m].
    double
    length(const DirectedEdge &edge);

    /**
     * Area [m^2] of the face to the left of closed chains of edges, by Green's
     * theorem about the first vertex: chords plus circular segments
     * @f[ \tfrac12 r^2(\theta-\sin\theta). @f]
     */
    double
    enclosed_area(const std::vector<DirectedEdge> &edges);

    /**
     * A point well inside of the same face: the middle of the longest vertical
     * chord among those half-way between successive vertex abscissae (the 64
     * widest gaps if there are more).
     * Cost: O(64 · edges).
     */
    dealii::Point<2>
    inside_point(const std::vector<DirectedEdge> &edges);

    /**
     * What rounding may change enclosed_area() by [m^2]: each vertex is within
     * @f$ 8\sqrt2\,\varepsilon M @f$ of its exact place (to_double()), M being the
     * largest coordinate, so that with some more for the sum
     * @f[ 16\,\varepsilon \sum_i l_i \max(M, R_i), @f]
     * l being lengths of edges and R radii of arcs (0 if straight). The boundary of
     * a face that encloses less is degenerate or runs the wrong way round once its
     * vertices are rounded, or would with other roundings.
     */
    double
    area_rounding(const std::vector<DirectedEdge> &edges);

    /// Smallest box around @p edges [m], which must not be empty.
    dealii::BoundingBox<2>
    bounding_box(const std::vector<DirectedEdge> &edges);
  } // namespace internal
} // namespace NMM

#endif
