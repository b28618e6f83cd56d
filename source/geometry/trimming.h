#ifndef nmm_source_geometry_trimming_h
#define nmm_source_geometry_trimming_h

#include <nmm/geometry/geometry.h>
#include <nmm/geometry/physical_region.h>

#include "geometry/arrangement.h"
#include "geometry/face_labels.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Merge the two edges at vertices where nothing else meets any more, so that removed edges
    /// leave no vertices behind.
    void
    merge_edges(Arrangement &arrangement);

    /**
     * Remove the parts of curves that Curve::within excludes from the arrangement of @p curves,
     * exactly. The borders of @p regions are inserted, edges outside of them lose their joint, and
     * the borders are removed again. @throws InputError for a joint confined to neither a domain
     * nor a region.
     */
    void
    confine_joints(const std::vector<Curve>        &curves,
                   const std::vector<CurvePiece>   &pieces,
                   const std::vector<unsigned int> &piece_to_curve,
                   const std::vector<Curve>        &regions,
                   Arrangement                     &arrangement);

    /**
     * Measure the parts of joints that bound no block, and remove them where Curve::drops_ends is
     * set. The number of faces does not change, because the same face is on both sides. @p faces
     * are those of the arrangement before; they are invalid if anything was removed.
     */
    DanglingEnds
    drop_ends(const std::vector<Curve> &curves,
              const LabelledFaces      &faces,
              Arrangement              &arrangement);
  } // namespace internal
} // namespace NMM

#endif
