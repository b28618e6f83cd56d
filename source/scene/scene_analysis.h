#ifndef nmm_source_scene_scene_analysis_h
#define nmm_source_scene_scene_analysis_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/probes.h>
#include <nmm/output/progress.h>
#include <nmm/quadrature/element_quadrature.h>
#include <nmm/scene/scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>
#include <scene/contact_analysis.h>
#include <scene/crack_tips.h>
#include <scene/state_series.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * A scene's analysis, from geometry to files: what all kinds have in common. The
     * order is fixed: build(), print_report(), open(), solve(), verify(), write(). All
     * input errors come out of build(), so that nothing is written for a scene that is
     * wrong.
     *
     * Lifetime: the scene and the progress display must outlive it.
     */
    class SceneAnalysis
    {
    public:
      SceneAnalysis(const Scene &scene,
                    Progress    &progress,
                    MPI_Comm     communicator);

      virtual ~SceneAnalysis() = default;

      /// Cut, make covers and quadrature, check the problem. @throws
      /// InputError.
      void
      build();

      /// Notices, changes made by cleaning, and counts.
      void
      print_report();

      /// Make the folder for results, which must outlive this object. Results of an
      /// earlier run there are removed, unless it is continued.
      void
      open(const OutputDirectory &directory);

      /// May write as it goes. @throws NumericalFailure.
      virtual void
      solve() = 0;

      /// What is known about the solution, into the summary.
      virtual void
      verify() = 0;

      /// All files the scene asks for; without a solution those that need none.
      void
      write();

    protected:
      const Scene &scene;
      Progress    &progress;
      MPI_Comm     communicator;
      Summary      summary;
      /// Is all that was asked for done? If not, there may still be an evaluator,
      /// of the last state that is known.
      bool is_solved = false;

      /// With cracks that grow: the geometry as it is now.
      Geometry geometry;

      // Each object refers to those above it.
      std::vector<CleaningAction>       cleaning_actions;
      std::vector<std::string>          own_mesh_notices;
      std::unique_ptr<PhysicalMesh>     physical_mesh;
      std::unique_ptr<MathematicalMesh> mathematical_mesh;
      std::unique_ptr<ManifoldMesh>     manifold_mesh;
      std::unique_ptr<CoverSystem>      covers;
      Aggregation                       aggregation;
      /// Null without contact.
      std::unique_ptr<ContactAnalysis>      contact;
      dealii::AffineConstraints<double>     constraints;
      std::unique_ptr<GhostPenalty>         ghost_penalty;
      std::unique_ptr<QuadratureCollection> quadrature;
      ElasticityProblem                     problem;
      std::unique_ptr<ProbePoints>          probes;
      /// Null unless the scene asks for intensity factors.
      std::unique_ptr<CrackTips>         crack_tips;
      std::unique_ptr<DisplacementField> field;
      std::unique_ptr<StressRecovery>    recovery;
      std::unique_ptr<FieldEvaluator>    evaluator;
      /// After open().
      const OutputDirectory       *directory = nullptr;
      std::unique_ptr<StateSeries> series;

      /// Make everything, from the physical mesh to the system, for a geometry; what was
      /// there before is gone. @throws InputError.
      void
      build(Geometry geometry);

      /// Drop all that build() makes, last things first; what is written goes on.
      virtual void
      clear();

      /// Of all crack tips, from `field`, if the scene asks for them. Collective.
      void
      compute_intensity_factors();

      bool
      is_first_rank() const;

      /// Elastic energy [J] of `field` in small displacements, initial stress left
      /// out. Collective.
      double
      small_strain_energy() const;

      /// Let the first rank do something that may throw: all ranks throw then.
      void
      on_first_rank(const std::function<void()> &action) const;

    private:
      /// Further checks of the problem, before anything is cut.
      virtual void
      check_problem()
      {
      }

      /// The equations, once covers and quadrature are there.
      virtual void
      make_system() = 0;

      /// Clear the folder, and begin files that are written during solve().
      virtual void
      open_files();

      /// Time or load factor of the last state that is known.
      virtual double
      last_value() const
      {
        return 0.;
      }

      /// Words for the picture of a run that failed.
      virtual std::string
      unsolved_note() const
      {
        return "not solved";
      }

      void
      add_counts();

      /// Joints that bound nothing and blocks that are small.
      void
      add_block_counts();

      std::vector<std::string>
      block_notices() const;

      /// Of all crack tips that in the largest cell, and the size of this [m]; 0 if
      /// there is none.
      std::pair<dealii::Point<2>, double>
      tip_in_the_largest_cell() const;

      void
      cut();

      void
      make_covers();

      void
      write_summary();
    };
  } // namespace internal
} // namespace NMM

#endif
