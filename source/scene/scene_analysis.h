#ifndef nmm_source_scene_scene_analysis_h
#define nmm_source_scene_scene_analysis_h

#include <nmm/fracture/tip_cover.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/solid.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/probes.h>
#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <scene/contact_analysis.h>
#include <scene/crack_growth.h>
#include <scene/crack_tips.h>
#include <scene/state_series.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The analysis of a scene, from geometry to files: the part that all kinds of analysis share.
     * The order of calls is build(), print_report(), open(), solve(), verify(), write(). All
     * input errors are thrown by build(), so that nothing is written for a scene that is
     * wrong.
     *
     * Lifetime: the scene and the progress display must outlive it.
     */
    class SceneAnalysis
    {
    public:
      /// @p restart is the file of the checkpoint from which to continue; empty for none.
      SceneAnalysis(const Scene &scene,
                    Progress    &progress,
                    MPI_Comm     communicator,
                    std::string  restart = "");

      virtual ~SceneAnalysis() = default;

      /// Cuts the solid, makes covers and quadrature, and checks the problem. @throws
      /// InputError for a scene that is wrong.
      void
      build();

      /// Prints notices, the changes made by cleaning, and counts.
      void
      print_report();

      /// Prepares the folder for results; @p directory must outlive this object. Results of an
      /// earlier run there are removed, unless that run is continued.
      void
      open(const OutputDirectory &directory);

      /// Solves the problem, and may write results of steps. @throws NumericalFailure if there is
      /// no solution.
      virtual void
      solve() = 0;

      /// Adds errors, energies and other checks of the solution to the summary.
      virtual void
      verify() = 0;

      /// Writes all files that the scene asks for; without a solution, those that need none.
      void
      write();

    protected:
      const Scene &scene;
      Progress    &progress;
      MPI_Comm     communicator;
      /// The checkpoint from which to continue; empty for none.
      const std::string restart;
      Summary           summary;
      /// Whether the problem is solved completely. If not, there may still be an evaluator
      /// of the last accepted state.
      bool is_solved = false;

      /// The present geometry, if cracks grow.
      Geometry geometry;

      /// Sizes of cells that a graded mesh has beside those of the scene and of the present tips.
      std::vector<LocalSize> further_sizes;

      // Each object refers to those above it.
      std::vector<CleaningAction>         cleaning_actions;
      std::vector<std::string>            scene_notices;
      std::shared_ptr<const PhysicalMesh> physical_mesh;
      std::unique_ptr<Solid>              solid;
      ElasticityProblem                   problem;
      /// Null without contact.
      std::unique_ptr<ContactAnalysis> contact;
      std::unique_ptr<ProbePoints>     probes;
      /// Covers of crack tips, if the analysis can have them.
      std::vector<std::unique_ptr<TipCover>> tip_covers;
      /// Null unless the scene asks for intensity factors.
      std::unique_ptr<CrackTips> crack_tips;
      /// Increments of a derived analysis; null unless cracks grow.
      const GrowthTable                 *growth_table = nullptr;
      std::unique_ptr<DisplacementField> field;
      std::unique_ptr<StressRecovery>    recovery;
      std::unique_ptr<FieldEvaluator>    evaluator;
      /// The folder for results; null before open().
      const OutputDirectory       *directory = nullptr;
      std::unique_ptr<StateSeries> series;

      /// Makes everything for a geometry, from the physical mesh to the system, and replaces what
      /// was made before. @throws InputError for a geometry that is wrong.
      void
      build(Geometry geometry);

      /// Destroys all that build() makes, in reverse order; files remain open.
      virtual void
      clear();

      /// A solid that was replaced by one that is cut further. Each object refers to those above it.
      struct FormerSolid
      {
        std::unique_ptr<Solid>           solid;
        std::unique_ptr<ContactAnalysis> contact;
      };

      /// Writes the list of what cleaning has changed, if it has changed anything.
      void
      write_cleaning() const;

      /// Releases the solid, which outlives the next build() so that its state can be carried over.
      /// The equations must have been destroyed before, or be destroyed by clear().
      FormerSolid
      release_solid();

      /// The problem with the loads of the present state.
      virtual ElasticityProblem
      problem_now() const
      {
        return problem;
      }

      /// Computes the intensity factors of all crack tips from `field`, if the scene asks for them.
      /// Collective.
      void
      compute_intensity_factors();

      /// The cracks in the state of `evaluator`, for files and pictures. Null without a state or
      /// intensity factors of the present tips. Collective.
      std::unique_ptr<CrackSample>
      sample_cracks() const;

      /// Whether this run continues an earlier one whose results are in the folder. Collective.
      bool
      continues_in_folder() const;

      /// The file to which checkpoints are written.
      std::string
      checkpoint_file() const;

      /// Tells the largest of the forces @p forces that are out of balance in the undeformed state
      /// [N/m], on owned unknowns, if the initial stress varies or comes from weight. Collective.
      void
      report_initial_balance(
        const dealii::TrilinosWrappers::MPI::Vector &forces);

      bool
      is_first_rank() const;

      /// Elastic energy of `field` with small displacements, without initial stress and without
      /// what tip covers contribute [J]. Collective.
      virtual double
      small_strain_energy() const;

      /// Runs @p action on rank 0; if it throws, all ranks throw. See NMM::on_first_rank().
      void
      on_first_rank(const std::function<void()> &action) const;

    private:
      /// Increments by which cracks have grown in an earlier part of this run, from its checkpoint.
      virtual std::vector<Increment>
      earlier_increments()
      {
        return {};
      }

      /// Lets the cracks of `geometry` grow by the increments of an earlier part of this run. The
      /// geometry is then that of which the solid was made there, bit by bit. @throws InputError if
      /// they do not fit.
      void
      replay(const std::vector<Increment> &increments);

      /// Makes the physical mesh of a geometry, problem and tips; the first part of build().
      void
      make_physical_mesh(Geometry geometry);

      /// @throws InputError for loads on cracks that do not turn with them, in finite kinematics with intensity
      /// factors.
      void
      check_loads_on_cracks() const;

      /// Sets the present geometry to the curves of the physical mesh. The cut may have moved a
      /// curve onto another one that coincides with it within rounding.
      void
      keep_geometry();

      /// Whether an element is no longer a part of the solid.
      virtual bool
      is_removed(unsigned int /*element*/) const
      {
        return false;
      }

      /// Further checks of the problem, before anything is cut.
      virtual void
      check_problem()
      {
      }

      /// Whether the equations can have the functions of tip covers.
      virtual bool
      can_have_tip_covers() const
      {
        return false;
      }

      /// Makes tip covers, and the physical mesh again with their circles.
      void
      add_tip_covers(Geometry geometry);

      /// Makes the equations, after covers and quadrature were made.
      virtual void
      make_system() = 0;

      /// Prepares the folder, and opens files that are written during solve().
      virtual void
      open_files();

      /// Time [s] or load factor [-] of the last accepted state.
      virtual double
      last_value() const
      {
        return 0.;
      }

      /// Note in the picture of a run that failed.
      virtual std::string
      unsolved_note() const
      {
        return "not solved";
      }

      void
      add_counts();

      /// Adds the numbers of joints that bound no block, and of small blocks, to the summary.
      void
      add_block_counts();

      std::vector<std::string>
      block_notices() const;

      /// The crack tip without a cover in the largest cell of all such tips, and the size of that cell [m]; the size is
      /// 0 if there is no tip.
      std::pair<dealii::Point<2>, double>
      tip_in_the_largest_cell() const;

      /// Cuts the solid on the mesh that the scene asks for.
      std::unique_ptr<Solid>
      make_solid();

      void
      write_summary();
    };
  } // namespace internal
} // namespace NMM

#endif
