#ifndef nmm_scene_run_scene_h
#define nmm_scene_run_scene_h

#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>

#include <mpi.h>
#include <string>

namespace NMM
{
  struct SceneRunOptions
  {
    /// Folder for the results; made if it does not exist.
    std::string output;
    /// Checkpoint that a dynamic analysis continues from; empty: it starts anew.
    std::string restart;
    /// Read, cut and report, but do not solve, and write nothing.
    bool check_only = false;
  };

  /**
   * Solves the problem that a scene describes: chooses the analysis, builds the model, reports
   * what was built, solves, and writes tables, fields and a picture to the folder for results.
   * Messages go to @p progress. Collective.
   *
   * @p has_output becomes true as soon as results begin to be written; it is what
   * explain_exception() has to know.
   *
   * @throws InputError if the scene cannot be built, or if there is no analysis that the
   * checkpoint belongs to; nothing has been written then.
   * @throws NumericalFailure if there is no solution; what is known has been written.
   * @throws OutputFailure if results cannot be written.
   */
  void
  run_scene(const Scene           &scene,
            const SceneRunOptions &options,
            Progress              &progress,
            MPI_Comm               communicator,
            bool                  &has_output);
} // namespace NMM

#endif
