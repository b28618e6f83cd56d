#ifndef nmm_source_covers_parts_to_cut_h
#define nmm_source_covers_parts_to_cut_h

// Private: the parts of the mathematical mesh with their curves.

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
               const PhysicalMesh              &physical_mesh,
               const PhysicalEdges             &physical_edges,
               const std::vector<unsigned int> &region_to_part,
               Cutter                           cutter);

    /// Upper bound of the coordinates of a box [m].
    double
    largest_coordinate(const dealii::BoundingBox<2> &box);

    /// The physical edges near each cell of a part; see largest_coordinate() for @p scale.
    NearEdges
    find_near_edges(const PartToCut &part, double scale);
  } // namespace internal
} // namespace NMM

#endif
