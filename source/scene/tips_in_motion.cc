#include <scene/current_stress.h>
#include <scene/dynamic_analysis.h>

namespace NMM
{
  namespace internal
  {
    // Intensity factors of a solid in motion.

    ElasticityProblem
    DynamicAnalysis::problem_now() const
    {
      const Loading    &loading = motion->parameters().loading;
      ElasticityProblem now =
        loading.amplitudes ? problem_at(problem, loading.amplitudes(time()))
                           : problem;
      if (loading.base_acceleration)
        now.gravity -= loading.base_acceleration(time());
      return now;
    }


    void
    DynamicAnalysis::compute_tips_in_motion()
    {
      if (!crack_tips)
        return;
      Vector relevant(displacement());
      relevant = motion->integrator().state().a;
      const DisplacementField u(solid->covers(), problem, displacement()),
        acceleration(solid->covers(), problem, relevant);
      TipLoading tip_loading;
      if (contact)
        tip_loading.contact_forces = contact->forces_on_faces();
      tip_loading.acceleration = [&](const unsigned int      element,
                                     const dealii::Point<2> &xi) {
        return acceleration.displacement(element, xi);
      };
      crack_tips->compute(u, problem_now(), tip_loading);
    }


    ElementStress
    DynamicAnalysis::stress_in_material_axes() const
    {
      return CurrentStress::in_material_axes(
        DisplacementField(solid->covers(), problem, displacement())
          .on_all_ranks(),
        motion->solid_term().elasticity(),
        scene.parameters().model.kinematics);
    }
  } // namespace internal
} // namespace NMM
