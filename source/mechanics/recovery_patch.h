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
     * The elements and covers around a corner cover that a recovered polynomial
     * is fitted to: the cover's elements, then ring by ring those that share a
     * corner cover with them. Rings do not go through covers that see both
     * sides of a joint, so a patch stays on one side.
     *
     * Samples are the nodes of free covers that a whole element uses. Other
     * nodes may lie outside the solid, where the displacement is only continued;
     * elements that are cut are to be sampled inside instead.
     */
    class RecoveryPatches
    {
    public:
      RecoveryPatches(const CoverSystem &covers,
                      const Aggregation &aggregation);

      /// Does the support of this corner cover hold both sides of a joint?
      bool
      sees_both_sides(unsigned int cover) const;

      /// Start a patch: the elements of @p cover.
      void
      start(unsigned int cover);

      /// Add a ring; false if there are no more elements.
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

      /// The patch being made: marks hold its number.
      unsigned int              patch_number = 0;
      std::vector<unsigned int> element_mark, sample_mark, corner_mark;
      std::vector<unsigned int> patch_elements, patch_cut_elements,
        patch_samples;
      std::size_t ring_begin = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
