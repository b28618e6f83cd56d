#include <algorithm>
#include <scene/load_path.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      EquilibriumParameters
      how_to_load(const Scene &scene, Progress &progress)
      {
        EquilibriumParameters how;
        how.kinematics = scene.parameters().model.kinematics;
        how.newton =
          show_iterations(scene.parameters().newton.newton, progress);
        return how;
      }
    } // namespace


    LoadPath::LoadPath(const Scene             &scene,
                       const Solid             &solid,
                       const ElasticityProblem &problem,
                       ContactAnalysis         *contact,
                       Progress                &progress)
      : scene(scene)
      , solid(solid)
      , contact(contact)
      , equilibrium(solid, problem, how_to_load(scene, progress), contact)
    {
    }


    void
    LoadPath::begin_anew()
    {
      equilibrium.begin_anew();
      if (first.load_factor > 0.)
        equilibrium.continue_from(first.load_factor,
                                  first.displacement,
                                  first.history,
                                  first.friction_work);
    }


    void
    LoadPath::continue_from(LoadingState carried)
    {
      has_begun = false;
      first     = std::move(carried);
    }


    LoadingState
    LoadPath::state() const
    {
      LoadingState state{equilibrium.load_factor(),
                         Vector(solid.covers().locally_owned_dofs(2),
                                solid.covers().communicator()),
                         contact != nullptr ? contact->contact().history()
                                            : ContactHistory(),
                         equilibrium.friction_work()};
      state.displacement = equilibrium.solution();
      return state;
    }


    const LoadPath::Vector &
    LoadPath::solve(const double load_factor)
    {
      const LoadStepParameters &given = scene.parameters().load_steps;
      LoadSteps                 steps;
      steps.load_factors       = {load_factor};
      steps.leaves_out_reached = false;
      const double reached     = equilibrium.load_factor();
      const bool   is_further =
        load_factor > reached
            ? reached >= first.load_factor
            : load_factor < reached && reached <= first.load_factor;
      if (!has_begun || !is_further)
      {
        begin_anew();
        if (first.load_factor == 0. &&
            (!given.load_factors.empty() ||
             given.n_steps != LoadStepParameters::default_n_steps))
        {
          steps.load_factors = given.load_steps().load_factors;
          const double scale = load_factor / steps.largest();
          for (double &factor : steps.load_factors)
            factor *= scale;
        }
      }
      constexpr double least_step = 0.5;
      steps.min_step              = std::max(given.min_step, least_step);
      // After a failure the next loading begins anew.
      has_begun = false;
      equilibrium.run(steps);
      has_begun = true;
      if (load_factor == first.load_factor)
        first = state();
      return equilibrium.solution();
    }
  } // namespace internal
} // namespace NMM
