#ifndef nmm_source_geometry_overlaps_h
#define nmm_source_geometry_overlaps_h

#include <nmm/geometry/curve.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Make segments that run along each other within rounding coincide exactly: the
     * ends of each become vertices of the other one. Lines that are drawn
     * twice, with rounded digits, cross or leave each other and enclose strips. A closed
     * strip is found by its area (TinyFaces). A strip that opens into a
     * block, because a line ends there, is part of a large face and is found here.
     *
     * An end is on a segment if its distance is at most
     * @f[ \delta = 32\,\varepsilon M, @f]
     * M being the largest coordinate in the common part of both bounding boxes. A
     * strip of the length l and this width encloses @f$ l\,\delta @f$, which is
     * area_rounding() of its two long sides. Two segments run along each other if
     * two of their four ends are on the other one and further apart than
     * @f$ 16\,\delta @f$; the distance of segments is convex, so that they are within
     * @f$ \delta @f$ in between, too. A joint that only ends within rounding
     * of another one is not changed. Vertices do not move;
     * segments are bent by at most @f$ \delta @f$ for each inserted vertex.
     *
     * With @p unites_joints, two joints of one state are one line if they are within a millionth
     * of the shorter segment's length, which then takes the place of @f$ \delta @f$.
     *
     * Arcs and circles are not changed, nor are two parts of one boundary or hole,
     * which must not overlap. A boundary or hole gets no vertex within
     * @f$ 2\,\delta @f$ of one that it has.
     * Cost: O(n log n + pairs of segments whose boxes intersect).
     * @return a sentence for the user, empty if nothing was changed.
     */
    std::string
    unite_overlaps(std::vector<Curve> &curves, bool unites_joints);
  } // namespace internal
} // namespace NMM

#endif
