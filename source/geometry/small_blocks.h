#ifndef nmm_source_geometry_small_blocks_h
#define nmm_source_geometry_small_blocks_h

#include <nmm/geometry/geometry.h>
#include <nmm/geometry/physical_region.h>

#include "geometry/arrangement.h"
#include "geometry/face_labels.h"
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Merge blocks that are smaller than a limit, or slivers if that is asked for, into neighbours,
     * the smallest one first, until none is left that has a neighbour. The neighbour of a block is
     * the one with which it shares the longest boundary of joints; of equal ones (to 1e-9), the
     * first from the left.
     *
     * Each region of the small block becomes a part of the region of the neighbour with which it
     * shares the longest boundary that is a joint only, and has the material there. Joints vanish
     * between regions of one material, and on interfaces, which then bond the blocks. A joint
     * between regions of different materials that no interface separates remains: both materials
     * would meet without a curve between them.
     *
     * Areas that differ in the last digits count as equal, so that rounding does not decide about
     * the order.
     *
     * Cost: O(n log n) for n edges of blocks that are merged.
     */
    class SmallBlocks
    {
    public:
      /// Regions of FaceData::region, and their blocks and materials, are @p regions.
      SmallBlocks(const LabelledFaces        &faces,
                  const std::vector<Curve>   &curves,
                  std::vector<PhysicalRegion> regions,
                  double                      limit,
                  bool                        merges_slivers);

      /// The region that a region has become a part of, mostly itself.
      unsigned int
      owner(unsigned int region) const;

      /// The block to which a region belongs now; its number is that of one of its former blocks.
      unsigned int
      block(unsigned int region) const;

      /// Whether an edge of the faces has lost all of its curves.
      bool
      vanishes(unsigned int edge) const;

      /// Blocks that were merged, in this order.
      const std::vector<CleaningAction> &
      actions() const;

      /// A sentence that names the blocks that are small, but have no neighbour; empty if there are
      /// none.
      std::string
      notice() const;

      /// Remove the joints that vanish. Tips that arise, since a crack began at such a joint, are
      /// added to @p ends. Handles of the faces stay valid until edges are merged.
      void
      remove_joints(const std::vector<unsigned int> &piece_to_curve,
                    DanglingEnds                    &ends,
                    Arrangement                     &arrangement) const;

    private:
      /// A part of a joint between two regions.
      struct JointEdge
      {
        unsigned int edge, left, right;
        double       length;
        /// Whether an interface lies on the joint.
        bool is_interface;
        bool is_gone = false;
      };

      void
      collect_joints();
      bool
      is_small(unsigned int block) const;
      void
      merge_all();
      /// The block with the longest common boundary of joints, or invalid_index.
      unsigned int
      neighbor(unsigned int block) const;
      void
      merge(unsigned int block, unsigned int other);
      /// Let each region of @p block belong to a region of @p other.
      void
      unite_regions(unsigned int block, unsigned int other);
      /// The side of a joint that is in @p block, and the other side.
      std::pair<unsigned int, unsigned int>
      sides(const JointEdge &joint, unsigned int block) const;
      void
      find_new_tips(DanglingEnds &ends) const;

      const LabelledFaces      &faces;
      const std::vector<Curve> &curves;
      /// The regions before blocks were merged.
      const std::vector<PhysicalRegion> regions;
      const double                      limit;
      const bool                        merges_slivers;

      /// By region, and by block: the one that it has become a part of.
      mutable std::vector<unsigned int> region_parent, block_parent;
      std::vector<JointEdge>            joints;
      /// By block that is no part of another one: joints around it, its area [m^2], and its largest
      /// region before blocks were merged.
      std::vector<std::vector<unsigned int>> block_joints;
      std::vector<double>                    areas;
      std::vector<unsigned int>              largest;
      /// Whether all regions of a block are slivers.
      std::vector<bool>           is_sliver;
      std::vector<unsigned int>   stranded;
      std::vector<CleaningAction> all_actions;
      std::vector<bool>           edge_vanishes;
    };
  } // namespace internal
} // namespace NMM

#endif
