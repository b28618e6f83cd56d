#ifndef nmm_output_progress_h
#define nmm_output_progress_h

#include <deal.II/base/mpi.h>

#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * Prints the stages of a program and their times. On a terminal
   * the running stage is shown and its line is completed when it ends; otherwise
   * one plain line is printed per stage. Only rank 0 prints. Times are wall-clock
   * times of this rank, which waits for the others at the end of each stage.
   */
  class Progress
  {
  public:
    /// Prints to @p out, which must outlive this object. @p is_terminal says whether lines can be
    /// overwritten. Stages are collective on @p communicator.
    Progress(std::ostream &out, bool is_terminal, MPI_Comm communicator);

    /// A stage, which lasts from construction to destruction. A stage within another one is
    /// part of the latter: it has no line and no time of its own.
    class Stage
    {
    public:
      /// Begins a stage of @p progress, which must outlive it.
      Stage(Progress &progress, std::string name);
      ~Stage();
      Stage(const Stage &) = delete;
      Stage &
      operator=(const Stage &) = delete;

      /// Sets a few words that are printed beside the time when the stage ends.
      void
      remark(const std::string &text);

      /// Shows the progress of long work. On a terminal it is shown beside the name of the stage,
      /// a few times a second; otherwise a line is printed every ten seconds. @p text is called
      /// only when a line is shown; it makes the words from the time since the start [s]. The
      /// line is cut to the width of the terminal, or to 80 characters.
      void
      update(const std::function<std::string(double seconds)> &text);

    private:
      friend class Progress;

      void
      show(const std::function<std::string(double seconds)> &text);

      Progress                             &progress;
      bool                                  is_part;
      std::string                           name, text;
      std::chrono::steady_clock::time_point start, last_shown, last_news;
      int                                   n_exceptions;
    };

    /// Shows @p text beside the running stage, as Stage::update() does, if five seconds have passed
    /// since the last call of this function that showed something, of Stage::update() or of
    /// message(): a sign of life from the inside of a long step.
    void
    show_alive(const std::function<std::string()> &text);

    /// Prints a line of its own on rank 0.
    void
    message(const std::string &text);

    /// Completed stages with their times [s], in the order in which they ended.
    const std::vector<std::pair<std::string, double>> &
    times() const;

  private:
    std::ostream &out;
    bool          is_terminal;
    MPI_Comm      communicator;
    bool          prints;
    unsigned int  n_running = 0;
    /// The stage that runs and is no part of another one, or null.
    Stage                                      *running = nullptr;
    std::vector<std::pair<std::string, double>> stage_times;
  };

  /// Merges notices that differ only in numbers, or in quoted names that contain a digit: the
  /// first one is kept, with the number of the others.
  std::vector<std::string>
  merge_alike(const std::vector<std::string> &notices);

  /// @p text, cut to @p width characters with " ..." at its end if it is longer.
  std::string
  cut_to_width(const std::string &text, std::size_t width);

  /// Largest memory that this process has used so far [MB], summed over ranks. Collective.
  double
  peak_memory(MPI_Comm communicator);
} // namespace NMM

#endif
