#include <nmm/base/exceptions.h>
#include <nmm/base/program.h>
#include <nmm/base/stop.h>
#include <nmm/output/output_directory.h>
#include <nmm/scene/capabilities.h>
#include <nmm/scene/run_scene.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <scene/crack_growth_analysis.h>
#include <scene/dynamic_analysis.h>
#include <scene/nonlinear_analysis.h>
#include <scene/safety_factor_analysis.h>
#include <scene/static_analysis.h>

namespace NMM
{
  namespace
  {
    std::unique_ptr<internal::SceneAnalysis>
    make_analysis(const Scene       &scene,
                  Progress          &progress,
                  const MPI_Comm     communicator,
                  const std::string &restart)
    {
      const ModelParameters &model = scene.parameters().model;
      AssertThrow(restart.empty() || scene.parameters().may_be_continued(),
                  InputError("the scene has neither a dynamic analysis of "
                             "small or finite kinematics nor cracks that grow "
                             "in a static one, which could be continued",
                             "--restart " + restart,
                             "give the scene the checkpoint was written "
                             "with"));
      if (model.analysis == Analysis::safety_factor)
        return std::make_unique<internal::SafetyFactorAnalysis>(scene,
                                                                progress,
                                                                communicator);
      if (model.analysis != Analysis::statics)
        return std::make_unique<internal::DynamicAnalysis>(scene,
                                                           progress,
                                                           communicator,
                                                           restart);
      if (scene.parameters().fracture.n_increments > 0)
        return std::make_unique<internal::CrackGrowthAnalysis>(scene,
                                                               progress,
                                                               communicator,
                                                               restart);
      if (model.kinematics == Kinematics::small &&
          !scene.parameters().is_nonlinear())
        return std::make_unique<internal::StaticAnalysis>(scene,
                                                          progress,
                                                          communicator);
      return std::make_unique<internal::NonlinearAnalysis>(scene,
                                                           progress,
                                                           communicator);
    }


    /// Writes the results of a run that ends for this @p reason.
    void
    save(internal::SceneAnalysis &analysis, const std::string &reason)
    {
      try
      {
        analysis.write();
      }
      catch (const UserError &error)
      {
        AssertThrow(
          false, NumericalFailure(reason + "; and " + error.message(), "", ""));
      }
    }


    /// Solves the problem; if that fails, or if a signal ends it, writes the results so far and
    /// passes on the exception.
    void
    solve_or_save(internal::SceneAnalysis &analysis)
    {
      try
      {
        analysis.solve();
      }
      catch (const NumericalFailure &failure)
      {
        save(analysis, failure.message());
        throw;
      }
      catch (const Stopped &end)
      {
        save(analysis, end.message());
        throw;
      }
    }
  } // namespace


  void
  run_scene(const Scene           &scene,
            const SceneRunOptions &options,
            Progress              &progress,
            const MPI_Comm         communicator,
            bool                  &has_output)
  {
    const OutputDirectory directory(options.output);
    if (!options.check_only)
      on_first_rank(communicator, [&]() { directory.check(); });

    check_capabilities(scene.parameters(),
                       dealii::Utilities::MPI::n_mpi_processes(communicator));
    progress.message(scene.title());
    const auto analysis =
      make_analysis(scene, progress, communicator, options.restart);
    try
    {
      analysis->build();
    }
    catch (const NumericalFailure &failure)
    {
      // A check does not solve the problem, so a numerical failure of the set-up is no failure of
      // the check.
      if (!options.check_only)
        throw;
      progress.message("  warning: a run would end with exit code 3: " +
                       failure.message());
      return;
    }
    analysis->print_report();
    if (options.check_only)
      return;
    AssertThrow(!is_asked_to_stop(communicator),
                Stopped("stopped by a signal before the solution; nothing is "
                        "written",
                        "",
                        ""));

    analysis->open(directory);
    has_output = true;
    solve_or_save(*analysis);
    analysis->verify();
    analysis->write();
    progress.message("Results are in " + directory.path().string());
  }
} // namespace NMM
