#ifndef nmm_source_scene_joint_water_h
#define nmm_source_scene_joint_water_h

#include <nmm/analysis/equilibrium.h>
#include <nmm/mechanics/joint_water_term.h>
#include <nmm/output/output_directory.h>
#include <nmm/scene/scene.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The water that flows in the joints of a scene: its force term, and the table joint-flow.csv with
    /// the last state.
    class SceneJointWater
    {
    public:
      /// That of @p scene, which must outlive this object; null if it has none.
      static std::unique_ptr<SceneJointWater>
      make(const Scene &scene);

      explicit SceneJointWater(const Scene &scene);

      /// Makes the term whose states are taken from then on, for steps of load or of time.
      TermMaker
      maker(bool is_at_rest);

      /// Repeats the last load step of @p equilibrium until the flow at its beginning gives the same
      /// pressures as the one before, to 1e-6 of the largest one. @throws NumericalFailure if it
      /// does not.
      void
      repeat_until_flow_agrees(
        Equilibrium                                            &equilibrium,
        const std::function<void(const ContactStep &,
                                 const Equilibrium::Vector &)> &after_step)
        const;

      /// What the last state was, for a row of progress.
      std::string
      progress() const;

      /// Writes the table with a row for each link. On one rank.
      void
      write(const OutputDirectory &directory) const;

      void
      add_to(Summary &summary) const;

    private:
      const Scene          *scene;
      const JointWaterTerm *term = nullptr;

      double
      largest_pressure() const;
    };


    /// The makers of terms in motion of which no table is written: bolts, and water that flows in
    /// joints.
    std::vector<TermMaker>
    further_terms(const Scene &scene);
  } // namespace internal
} // namespace NMM

#endif
