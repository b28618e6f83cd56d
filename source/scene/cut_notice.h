#ifndef nmm_source_scene_cut_notice_h
#define nmm_source_scene_cut_notice_h

#include <nmm/output/progress.h>
#include <nmm/solution/step_sequence.h>

namespace NMM
{
  namespace internal
  {
    /// Says once that steps are cut again and again, why, where and what to do, while a run that makes
    /// no way can still be stopped.
    class CutNotice
    {
    public:
      explicit CutNotice(Progress &progress)
        : progress(&progress)
      {
      }

      /// Takes account of an accepted step, before which steps were lost.
      void
      note(const LostSteps &lost);

    private:
      Progress *progress;
      /// Cuts so far, less one for every two accepted steps.
      double n_cuts    = 0.;
      bool   is_silent = false;
    };
  } // namespace internal
} // namespace NMM

#endif
