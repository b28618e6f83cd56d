#ifndef nmm_source_geometry_trimming_h
#define nmm_source_geometry_trimming_h

#include <nmm/geometry/physical_mesh.h>

#include "geometry/arrangement.h"
#include "geometry/face_labels.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Vertices left where nothing else meets now: both edges become one, so that what
    /// was taken out leaves no corners behind.
    void
    merge_edges(Arrangement &arrangement);

    /**
     * Take what Curve::within says does not count out of the arrangement of
     * @p curves, exactly: the borders of @p regions are inserted, edges outside of
     * them lose their joint, and borders are taken out again.
     * @throws InputError for a joint confined to neither a domain nor a region.
     */
    void
    confine_joints(const std::vector<Curve>        &curves,
                   const std::vector<CurvePiece>   &pieces,
                   const std::vector<unsigned int> &piece_to_curve,
                   const std::vector<Curve>        &regions,
                   Arrangement                     &arrangement);

    /**
     * Count what bounds no block, and take it out where Curve::drops_ends says so.
     * The number of faces stays, because the same face is on both sides. @p faces are
     * those of the arrangement before; they are out of date if something was dropped.
     */
    PhysicalMesh::DanglingEnds
    drop_ends(const std::vector<Curve> &curves,
              const LabelledFaces      &faces,
              Arrangement              &arrangement);
  } // namespace internal
} // namespace NMM

#endif
