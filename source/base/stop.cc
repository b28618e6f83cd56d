#include <nmm/base/stop.h>

#include <csignal>
#include <unistd.h>

namespace NMM
{
  namespace
  {
    volatile std::sig_atomic_t is_asked = 0;


    extern "C" void
    ask_to_stop(const int signal)
    {
      constexpr char text[] =
        "\nnmm: stops at the end of this step; a second signal ends it at "
        "once\n";
      is_asked = 1;
      std::signal(SIGINT, SIG_DFL);
      std::signal(SIGTERM, SIG_DFL);
      // Of the functions that print this is the one that a signal handler may call.
      if (write(STDERR_FILENO, text, sizeof(text) - 1) < 0)
        return;
      (void)signal;
    }
  } // namespace


  void
  stop_at_signals()
  {
    is_asked = 0;
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
  }


  bool
  is_asked_to_stop(const MPI_Comm communicator)
  {
    return dealii::Utilities::MPI::logical_or(is_asked != 0, communicator);
  }


  void
  stop_if_asked(const MPI_Comm communicator)
  {
    AssertThrow(!is_asked_to_stop(communicator),
                Stopped("stopped by a signal; what is known is written",
                        "",
                        ""));
  }
} // namespace NMM
