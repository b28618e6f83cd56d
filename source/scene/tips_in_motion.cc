#include <deal.II/base/function.h>

#include <functional>
#include <memory>
#include <scene/dynamic_analysis.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    // Intensity factors of a solid in motion.
    namespace
    {
      /// Multiplies a function by a number; null stays null.
      void
      scale(std::shared_ptr<const dealii::Function<2>> &function,
            const double                                factor)
      {
        if (!function || factor == 1.)
          return;
        std::vector<std::function<double(const dealii::Point<2> &)>> components;
        for (unsigned int c = 0; c < function->n_components; ++c)
          components.emplace_back(
            [function, factor, c](const dealii::Point<2> &x) {
              return factor * function->value(x, c);
            });
        function =
          std::make_shared<dealii::FunctionFromFunctionObjects<2>>(components);
      }
    } // namespace


    ElasticityProblem
    DynamicAnalysis::problem_now() const
    {
      ElasticityProblem now = problem;
      if (loading.amplitudes)
      {
        const LoadAmplitudes amplitudes = loading.amplitudes(time());
        now.gravity *= amplitudes.gravity;
        scale(now.body_force, amplitudes.body_force);
        for (unsigned int i = 0; i < amplitudes.boundary_conditions.size(); ++i)
          scale(now.boundary_conditions[i].value,
                amplitudes.boundary_conditions[i]);
      }
      if (loading.base_acceleration)
        now.gravity -= loading.base_acceleration(time());
      return now;
    }


    void
    DynamicAnalysis::compute_tips_in_motion()
    {
      if (!crack_tips)
        return;
      Vector relevant(model->locally_owned(),
                      model->locally_relevant(),
                      communicator);
      relevant = integrator->state().a;
      const DisplacementField u(*covers, problem, displacement()),
        acceleration(*covers, problem, relevant);
      TipLoading tip_loading;
      if (contact)
        tip_loading.contact_forces = contact->forces_on_faces();
      tip_loading.acceleration = [&](const unsigned int      element,
                                     const dealii::Point<2> &xi) {
        return acceleration.displacement(element, xi);
      };
      crack_tips->compute(u, problem_now(), tip_loading);
    }
  } // namespace internal
} // namespace NMM
