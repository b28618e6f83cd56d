#ifndef nmm_scene_run_scene_h
#define nmm_scene_run_scene_h

#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>

#include <mpi.h>
#include <string>

namespace NMM
{
  /// What a run does beside what the scene says.
  struct SceneRunOptions
  {
    /// Folder for the results; it is made if it does not exist.
    std::string output;
    /// File of the checkpoint from which a motion or the growth of cracks continues; empty: none.
    std::string restart;
    /// Whether the scene is only read, cut and reported, without solving and without files.
    bool check_only = false;
  };

  /**
   * Solves the problem that a scene describes: it chooses the analysis, builds the model, reports
   * what was built, solves, and writes tables, fields and a picture to the folder for results.
   * Messages go to @p progress. Collective.
   *
   * @p has_output becomes true as soon as results begin to be written; pass it to
   * explain_exception() if this function throws.
   *
   * @throws InputError if the scene cannot be built, or if its analysis cannot continue from a
   * checkpoint; nothing has been written then.
   * @throws NumericalFailure if there is no solution; the results so far have been written.
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
