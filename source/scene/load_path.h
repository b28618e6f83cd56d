#ifndef nmm_source_scene_load_path_h
#define nmm_source_scene_load_path_h

#include <nmm/analysis/equilibrium.h>

#include <scene/contact_analysis.h>

namespace NMM
{
  namespace internal
  {
    /// A state of a LoadPath.
    struct LoadingState
    {
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      /// [-]; 0 for a solid without loads.
      double load_factor = 0.;
      /// Displacements of owned unknowns [m].
      Vector         displacement;
      ContactHistory history;
      /// Energy that friction has dissipated so far [J/m].
      double friction_work = 0.;
    };


    /**
     * The loading of elastic blocks, with contact or with finite displacements, to load factors that are
     * not known beforehand. It begins without loads, or with the state of a solid that was cut
     * further since. Since friction depends on the history, a load factor between the first and the
     * last one makes the loading begin again; one further away from the first one continues
     * it. It is reached in one step, unless the loading begins without loads and the scene has load
     * steps of its own.
     *
     * Lifetime: the arguments must outlive this object.
     */
    class LoadPath
    {
    public:
      using Vector = LoadingState::Vector;

      /// @p contact is null without one.
      LoadPath(const Scene             &scene,
               const Solid             &solid,
               const ElasticityProblem &problem,
               ContactAnalysis         *contact,
               Progress                &progress);

      /// Makes the loading begin with @p carried. The solution at its load factor, once it was
      /// asked for, takes its place.
      void
      continue_from(LoadingState carried);

      /// The displacements at the load factor @p load_factor [m], with relevant unknowns, valid
      /// until the next call. The contact analysis has taken the state. @throws NumericalFailure
      /// if there is no equilibrium, naming the block that moves.
      const Vector &
      solve(double load_factor);

      /// The state of the last solution.
      LoadingState
      state() const;

      /// The equations.
      const Equilibrium &
      equations() const
      {
        return equilibrium;
      }

    private:
      const Scene     &scene;
      const Solid     &solid;
      ContactAnalysis *contact;
      Equilibrium      equilibrium;
      /// The state with which the loading begins.
      LoadingState first;
      /// Whether the loading has begun.
      bool has_begun = false;

      void
      begin_anew();
    };
  } // namespace internal
} // namespace NMM

#endif
