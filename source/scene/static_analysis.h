#ifndef nmm_source_scene_static_analysis_h
#define nmm_source_scene_static_analysis_h

#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/thick_ring.h>

#include <memory>
#include <optional>
#include <scene/scene_analysis.h>

namespace NMM
{
  namespace internal
  {
    /// Small displacements: one linear problem.
    class StaticAnalysis : public SceneAnalysis
    {
    public:
      using SceneAnalysis::SceneAnalysis;

      void
      solve() override;

      /// Errors against the exact solution, strain energy.
      void
      verify() override;

    protected:
      /// The linear problem, and the intensity factors of crack tips.
      void
      solve_problem();

      /// Make field, recovery, evaluator and intensity factors those of a solution.
      void
      show(const dealii::TrilinosWrappers::MPI::Vector &solution);

      void
      make_system() override;

      void
      clear() override;

    private:
      std::optional<ThickRing>          exact_solution;
      std::unique_ptr<StaticElasticity> elasticity;

      /// The exact solution, if the scene has one. @throws InputError if it
      /// does not fit.
      void
      check_problem() override;

      /// Condition number and its place into the summary; a warning above the
      /// limit.
      void
      estimate_condition();

      void
      add_errors();
    };
  } // namespace internal
} // namespace NMM

#endif
