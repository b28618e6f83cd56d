#ifndef nmm_dynamics_leaving_blocks_h
#define nmm_dynamics_leaving_blocks_h

#include <nmm/covers/cover_system.h>
#include <nmm/geometry/curve.h>
#include <nmm/mechanics/displacement_field.h>

#include <utility>
#include <vector>

namespace NMM
{
  /**
   * Finds blocks that have left the scene. A block has left if the ends and midpoints of all its
   * edges (on arcs a point every 10 degrees) are outside of all limits of the scene.
   * Blocks that are tied to each other leave together.
   *
   * Cost: O(number of edges times number of edges of the limits) per call of find().
   *
   * Lifetime: the cover system must outlive this object.
   */
  class LeavingBlocks
  {
  public:
    /// A block that has left, and the bounding box of its edges at the current positions.
    struct Departure
    {
      /// Number of the block, see ManifoldMesh::block().
      unsigned int block = 0;
      /// @{
      /// Lower left and upper right corner of the bounding box [m].
      dealii::Point<2> lower, upper;
      /// @}
    };

    /**
     * @p limits are closed curves; the scene is the union of the areas that they enclose.
     * @p ties are pairs of blocks that are tied to each other; each rank may know
     * some of them only. Collective.
     */
    LeavingBlocks(
      const CoverSystem                                        &covers,
      const std::vector<Curve>                                 &limits,
      const std::vector<std::pair<unsigned int, unsigned int>> &ties = {});

    /// Blocks that are outside at the displacements @p field, without those in @p gone, in
    /// ascending order; the same on all ranks. Collective.
    std::vector<Departure>
    find(const DisplacementField         &field,
         const std::vector<unsigned int> &gone = {}) const;

    /// Whether the point @p x is enclosed by any of the limits.
    bool
    is_within(const dealii::Point<2> &x) const;

  private:
    /// A point on an edge of a block, in an element of this rank and in the reference
    /// configuration: physical coordinates x [m] and reference coordinates xi of the cell.
    struct Sample
    {
      unsigned int     element, block;
      dealii::Point<2> x, xi;
    };

    using Polygon = std::vector<dealii::Point<2>>;

    void
    add_samples(unsigned int element);

    const CoverSystem   *covers;
    std::vector<Polygon> polygons;
    std::vector<Sample>  samples;
    /// For each block, the lowest number of all blocks tied to it, itself included.
    std::vector<unsigned int> block_to_group;
  };
} // namespace NMM

#endif
