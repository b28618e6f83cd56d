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
   * Finds blocks that have left the scene, i.e. lie outside of all its limits with
   * the ends and middles of their faces (arcs: with a point every 10 degrees).
   * Blocks that are tied to each other leave together.
   *
   * Cost: O(faces times edges of the limits) per call of find().
   *
   * Lifetime: the cover system must outlive this object.
   */
  class LeavingBlocks
  {
  public:
    /// A block and the box around its faces where it is now [m].
    struct Departure
    {
      unsigned int     block = 0;
      dealii::Point<2> lower, upper;
    };

    /**
     * @p limits: closed curves; the scene is what any of them encloses.
     * @p ties: blocks that are tied to each other, in pairs; each rank may know
     * some of them. Collective.
     */
    LeavingBlocks(
      const CoverSystem                                        &covers,
      const std::vector<Curve>                                 &limits,
      const std::vector<std::pair<unsigned int, unsigned int>> &ties = {});

    /// Blocks outside where displacements are @p field, without those that are
    /// @p gone already; ascending, the same on all ranks. Collective.
    std::vector<Departure>
    find(const DisplacementField         &field,
         const std::vector<unsigned int> &gone = {}) const;

    /// Is @p x enclosed by any of the limits?
    bool
    is_within(const dealii::Point<2> &x) const;

  private:
    /// A point of a face of this rank's elements, in the reference configuration.
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
    /// The lowest one of the blocks a block is tied to.
    std::vector<unsigned int> block_to_group;
  };
} // namespace NMM

#endif
