#ifndef nmm_source_covers_parts_to_cut_h
#define nmm_source_covers_parts_to_cut_h

// Private: which cells of the mathematical mesh are cut with which curves, and where those lie
// that are not.

#include "cutting.h"
#include "physical_edges.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The parts that have regions, each with its physical edges.
    std::vector<PartToCut>
    find_parts(const MathematicalMesh          &mesh,
               const PhysicalEdges             &physical_edges,
               const std::vector<unsigned int> &region_to_part,
               unsigned int                     n_regions);

    /// Coordinates are up to that large [m].
    double
    largest_coordinate(const dealii::BoundingBox<2> &box);

    /// The physical edges near each cell of a part; see largest_coordinate() for @p scale.
    NearEdges
    find_near_edges(const MathematicalMesh &mesh,
                    const PhysicalEdges    &physical_edges,
                    const PartToCut        &part,
                    double                  scale);

    /**
     * Untouched cells of a distributed mesh have a region if a touched cell is
     * among those they are connected with, or is known to be there: elsewhere no
     * curve runs through any cell of the connected set, and one point decides.
     */
    void
    label_far_cells(const MathematicalMesh           &mesh,
                    const PhysicalEdges              &physical_edges,
                    unsigned int                      n_regions,
                    const std::vector<unsigned char> &state,
                    std::vector<unsigned int>        &cell_region);
  } // namespace internal
} // namespace NMM

#endif
