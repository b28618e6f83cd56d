#ifndef nmm_source_scene_static_start_h
#define nmm_source_scene_static_start_h

#include <nmm/analysis/equilibrium.h>
#include <nmm/analysis/motion.h>
#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>

#include <functional>
#include <memory>
#include <scene/contact_analysis.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The objects of a dynamic analysis that its start needs.
    struct StartInput
    {
      const Scene             &scene;
      const Solid             &solid;
      const ElasticityProblem &problem;
      /// Null without contact.
      ContactAnalysis *contact;
      /// The start is a stage of it.
      Progress &progress;
    };


    /// A relaxation from which a motion starts. Loads keep their values of t = 0 while its time advances.
    struct StartRelaxation
    {
      /// The objects of @p input must outlive this one.
      explicit StartRelaxation(const StartInput &input);

      Motion motion;
      /// Length of the first step [s] if the relaxation goes on from a state that the integrator
      /// was given, else 0.
      double continued_step = 0.;
      /// Called before each step with its length [s], if given.
      std::function<void(double)> before_step;
    };


    struct StartReport
    {
      unsigned int n_steps = 0, n_iterations = 0;
      /// InelasticTerms::internal_state(); empty if all materials are elastic.
      std::vector<char> material_state;
      /// FurtherTerms::save() of bolts.
      std::vector<char> term_state;
      /// Blocks that stages have removed.
      std::vector<unsigned int> removed_blocks;
    };


    /// "stage 'bench', load factors 1 to 2".
    std::string
    describe_stage(const Scene &scene, unsigned int stage);


    /// Parameters of Newton's method for time steps and relaxation, with signs of life.
    NewtonParameters
    motion_newton_parameters(const Scene &scene, Progress &progress);


    /**
     * Finds the equilibrium from which a dynamic analysis starts, if it does not start undeformed. If the
     * scene has stages, it is that at the end of the last one.
     * Loads, supports and obstacles are those of t = 0, before any release
     * and without motion of the ground. The contact keeps its history from the start: anchors of
     * the stick state and broken bonds. Returns the displacements of owned unknowns [m].
     * Collective. @throws NumericalFailure if there is no equilibrium.
     */
    ForceTerm::Vector
    find_start(const StartInput &input, StartReport &report);


    /// As find_start(), by a relaxation that may have begun already.
    ForceTerm::Vector
    find_start(const StartInput &input,
               StartRelaxation  &relaxation,
               StartReport      &report);
  } // namespace internal
} // namespace NMM

#endif
