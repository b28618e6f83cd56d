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
    /// Statics of small displacements, which is one linear problem.
    class StaticAnalysis : public SceneAnalysis
    {
    public:
      using SceneAnalysis::SceneAnalysis;

      void
      solve() override;

      /// Adds the errors against the exact solution and the strain energy to the summary.
      void
      verify() override;

    protected:
      /// Solves the linear problem, and computes the intensity factors of crack tips.
      void
      solve_problem();

      /// Makes field, recovery, evaluator and intensity factors of a solution.
      virtual void
      show(const dealii::TrilinosWrappers::MPI::Vector &solution);

      void
      make_system() override;

      bool
      can_have_tip_covers() const override;

      double
      small_strain_energy() const override;

      void
      clear() override;

      /// Makes the exact solution, if the scene has one. @throws InputError if it does not
      /// match the problem.
      void
      check_problem() override;

    private:
      std::optional<ThickRing>          exact_solution;
      std::unique_ptr<StaticElasticity> elasticity;

      /// Adds the condition number and the weakest point to the summary, and prints a warning if it
      /// is above the limit.
      void
      estimate_condition();

      void
      add_errors();
    };
  } // namespace internal
} // namespace NMM

#endif
