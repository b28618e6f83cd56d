#ifndef nmm_source_scene_staged_conditions_h
#define nmm_source_scene_staged_conditions_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/scene/scene_parameters.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /// The loads and supports that act in the stages of a scene, in the order of
    /// Scene::make_problem().
    class StagedConditions
    {
    public:
      /// Those before the first stage: all but the loads that a stage adds before any removes them.
      explicit StagedConditions(const SceneParameters &parameters);

      /// Makes the changes of a stage. Returns whether there are any.
      bool
      begin(const StageParameters &stage);

      /// Those of the last stage that has begun: the amplitude is 0 for loads that do not act, and
      /// removed supports are released. Lists are empty if no stage changes anything.
      const LoadAmplitudes &
      amplitudes() const
      {
        return current;
      }

    private:
      const SceneParameters &parameters;
      LoadAmplitudes         current;

      /// Lets the load @p name act, or the load or support no longer.
      void
      set(const std::string &name, bool acts);
    };
  } // namespace internal
} // namespace NMM

#endif
