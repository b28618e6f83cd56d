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
    /// Scene::make_problem() and, after that, Scene::add_water().
    class StagedConditions
    {
    public:
      /// Those before the first stage: all but the loads that a stage adds before any removes them,
      /// and of the tables of water, each of which acts by @p n_of_a_table conditions, the first one.
      StagedConditions(const SceneParameters &parameters,
                       unsigned int           n_of_a_table);

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
      unsigned int           n_of_a_table;
      LoadAmplitudes         current;
      /// Where the conditions of the table that acts begin.
      std::size_t present_table = 0;

      /// Lets the table of water that acts now do so, or not any more.
      void
      set_table(bool acts);

      /// Lets the load @p name act, or the load or support no longer.
      void
      set(const std::string &name, bool acts);
    };
  } // namespace internal
} // namespace NMM

#endif
