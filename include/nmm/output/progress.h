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
   * Says which stage a program is in and how long stages took. On a terminal
   * the running stage is shown and its line completed when it ends; otherwise
   * there is one plain line per stage. Only rank 0 prints. Times are wall-clock
   * times of this rank, which waits for the others at the end of each stage.
   */
  class Progress
  {
  public:
    Progress(std::ostream &out, bool is_terminal, MPI_Comm communicator);

    /// One stage, from construction to destruction. A stage within another one is a
    /// part of that: it has no line and no time of its own.
    class Stage
    {
    public:
      Stage(Progress &progress, std::string name);
      ~Stage();
      Stage(const Stage &) = delete;
      Stage &
      operator=(const Stage &) = delete;

      /// A few words shown beside the time.
      void
      remark(const std::string &text);

      /// How far long work has come: on a terminal beside the stage's name, a
      /// few times a second; else a line every ten seconds. @p text makes
      /// the words when they are shown, from the seconds since the start. The
      /// line is cut to the terminal's width, 80 characters without one.
      void
      update(const std::function<std::string(double seconds)> &text);

    private:
      Progress                             &progress;
      bool                                  is_part;
      std::string                           name, text;
      std::chrono::steady_clock::time_point start, last_update;
      int                                   n_exceptions;
    };

    /// A line of its own, from rank 0.
    void
    message(const std::string &text);

    /// Completed stages with their times [s], in order.
    const std::vector<std::pair<std::string, double>> &
    times() const;

  private:
    std::ostream                               &out;
    bool                                        is_terminal;
    MPI_Comm                                    communicator;
    bool                                        prints;
    unsigned int                                n_running = 0;
    std::vector<std::pair<std::string, double>> stage_times;
  };

  /// Keep only the first one of @p notices that differ in numbers, with their count.
  std::vector<std::string>
  merge_alike(const std::vector<std::string> &notices);

  /// @p text, if need be cut to @p width characters.
  std::string
  cut_to_width(const std::string &text, std::size_t width);

  /// Greatest memory this process has used [MB], summed over ranks.
  double
  peak_memory(MPI_Comm communicator);
} // namespace NMM

#endif
