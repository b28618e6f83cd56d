#ifndef nmm_base_stop_h
#define nmm_base_stop_h

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

/// Programs that end at the end of a step when a signal asks them to.
namespace NMM
{
  /**
   * A signal has asked the program to stop. The state is that at the end of a step, and what is
   * known of it is written. Programs end with exit code 4.
   */
  class Stopped : public UserError
  {
  public:
    /// See UserError::UserError().
    using UserError::UserError;
  };

  /// From now on the signals SIGINT (Ctrl-C) and SIGTERM ask the program to stop at the end of the
  /// present step; see is_asked_to_stop(). A second signal ends the program at once.
  void
  stop_at_signals();

  /// Whether a signal has asked any rank to stop. Collective.
  bool
  is_asked_to_stop(MPI_Comm communicator);

  /// @throws Stopped, on all ranks, if a signal has asked any rank to stop. Collective.
  void
  stop_if_asked(MPI_Comm communicator);
} // namespace NMM

#endif
