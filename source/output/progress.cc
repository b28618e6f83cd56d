#include <nmm/output/progress.h>

#include <deal.II/base/utilities.h>

#include <exception>
#include <iomanip>
#include <map>
#include <output/wrapped.h>
#include <regex>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace NMM
{
  namespace
  {
    /// Number of characters in a line of the terminal; 80 if there is no terminal.
    std::size_t
    terminal_width()
    {
      winsize size;
      return isatty(STDOUT_FILENO) != 0 &&
                 ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0
               ? size.ws_col
               : 80;
    }


    double
    seconds_since(const std::chrono::steady_clock::time_point time)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                           time)
        .count();
    }
  } // namespace


  std::string
  cut_to_width(const std::string &text, const std::size_t width)
  {
    const std::string end = " ...";
    if (text.size() <= width || width <= end.size())
      return text.substr(0, width);
    return text.substr(0, width - end.size()) + end;
  }


  std::vector<std::string>
  merge_alike(const std::vector<std::string> &notices)
  {
    // The pattern matches numbers, and names between quotation marks that contain a digit.
    const std::regex number("'[^']*[0-9][^']*'|[-+]?[0-9.]+(e[-+]?[0-9]+)?");
    std::map<std::string, unsigned int> counts;
    std::vector<std::string>            forms;
    for (const std::string &notice : notices)
    {
      forms.push_back(std::regex_replace(notice, number, "#"));
      ++counts[forms.back()];
    }
    std::vector<std::string> result;
    for (std::size_t i = 0; i < notices.size(); ++i)
    {
      unsigned int &count = counts[forms[i]];
      if (count > 0)
        result.push_back(notices[i] +
                         (count > 1 ? " (and " + std::to_string(count - 1) +
                                        " more that differ in numbers only)"
                                    : ""));
      count = 0;
    }
    return result;
  }


  Progress::Progress(std::ostream  &out,
                     const bool     is_terminal,
                     const MPI_Comm communicator)
    : out(out)
    , is_terminal(is_terminal)
    , communicator(communicator)
    , prints(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }


  Progress::Stage::Stage(Progress &progress, std::string name)
    : progress(progress)
    , is_part(progress.n_running++ > 0)
    , name(std::move(name))
    , start(std::chrono::steady_clock::now())
    , last_shown(start)
    , last_news(start)
    , n_exceptions(std::uncaught_exceptions())
  {
    if (is_part)
      return;
    progress.running = this;
    if (progress.prints && progress.is_terminal)
      progress.out << "  " << this->name << " ..." << std::flush;
  }


  Progress::Stage::~Stage()
  {
    const bool failed = std::uncaught_exceptions() > n_exceptions;
    // After a failure there is no barrier, since other ranks may not have failed.
    if (!failed)
      MPI_Barrier(progress.communicator);
    --progress.n_running;
    if (is_part)
      return;
    progress.running     = nullptr;
    const double seconds = seconds_since(start);
    progress.stage_times.emplace_back(name, seconds);
    if (!progress.prints)
      return;

    std::ostringstream line;
    line << (progress.is_terminal ? "\r\033[K" : "") << "  " << std::left
         << std::setw(18) << name << std::right;
    if (failed)
      line << "    failed";
    else
      line << std::fixed << std::setprecision(3) << std::setw(8) << seconds
           << " s";
    if (!text.empty())
      line << "  " << text;
    progress.out << line.str() << std::endl;
  }


  void
  Progress::Stage::remark(const std::string &words)
  {
    text = words;
  }


  void
  Progress::Stage::update(
    const std::function<std::string(double seconds)> &words)
  {
    last_news = std::chrono::steady_clock::now();
    if (seconds_since(last_shown) >= (progress.is_terminal ? 0.2 : 10.))
      show(words);
  }


  /// Show the progress of the stage, on rank 0, unless it is a part of another one.
  void
  Progress::Stage::show(const std::function<std::string(double seconds)> &words)
  {
    last_shown = last_news = std::chrono::steady_clock::now();
    if (is_part || !progress.prints)
      return;
    const std::string line  = words(seconds_since(start));
    const std::size_t width = terminal_width();
    // The last column is left empty, since some terminals would begin a new line.
    if (progress.is_terminal)
      progress.out << "\r\033[K"
                   << cut_to_width("  " + name + " ... " + line, width - 1)
                   << std::flush;
    else
      progress.out << cut_to_width("    " + line, width) << std::endl;
  }


  void
  Progress::show_alive(const std::function<std::string()> &text)
  {
    if (running != nullptr && seconds_since(running->last_news) >= 5.)
      running->show([&](double) { return text(); });
  }


  void
  Progress::message(const std::string &text)
  {
    if (running != nullptr)
      running->last_news = std::chrono::steady_clock::now();
    // On a terminal the message overwrites the line of a running stage.
    if (prints)
      out << (is_terminal
                ? "\r\033[K" + internal::wrapped(text, terminal_width() - 1)
                : text)
          << std::endl;
  }


  const std::vector<std::pair<std::string, double>> &
  Progress::times() const
  {
    return stage_times;
  }


  double
  peak_memory(const MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats statistics;
    dealii::Utilities::System::get_memory_stats(statistics);
    return dealii::Utilities::MPI::sum(static_cast<double>(statistics.VmHWM),
                                       communicator) /
           1024.;
  }
} // namespace NMM
