#ifndef nmm_source_mechanics_recovery_patch_h
#define nmm_source_mechanics_recovery_patch_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The patch of elements and covers around a corner cover to which a recovered polynomial
     * is fitted: the elements of the cover, then ring by ring those that share a
     * corner cover with them. Rings are not extended through covers whose support contains both
     * sides of a joint, so that a patch stays on one side.
     *
     * Samples are the nodes of free covers of whole elements. Other
     * nodes may lie outside the solid, where the displacement is only extended; the caller has to
     * take samples inside of cut elements instead.
     *
     * Order of calls for each patch: start(), then widen() as often as needed.
     */
    class RecoveryPatches
    {
    public:
      RecoveryPatches(const CoverSystem &covers,
                      const Aggregation &aggregation);

      /// Whether the support of this corner cover contains both sides of a joint.
      bool
      sees_both_sides(unsigned int cover) const;

      /// Start a patch with the elements of @p cover.
      void
      start(unsigned int cover);

      /// Add a ring of elements. Returns false if there are no more elements.
      bool
      widen();

      /// Covers whose nodes are samples.
      const std::vector<unsigned int> &
      samples() const;

      /// Elements of the patch that are cut.
      const std::vector<unsigned int> &
      cut_elements() const;

    private:
      void
      add_element(unsigned int element);

      const CoverSystem        *covers;
      std::vector<bool>         both_sides, is_sample;
      std::vector<unsigned int> cover_elements_begin, cover_elements;

      /// Number of the current patch; items whose mark has this number belong to it.
      unsigned int              patch_number = 0;
      std::vector<unsigned int> element_mark, sample_mark, corner_mark;
      std::vector<unsigned int> patch_elements, patch_cut_elements,
        patch_samples;
      std::size_t ring_begin = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
