#ifndef nmm_dynamics_checkpoint_h
#define nmm_dynamics_checkpoint_h

#include <nmm/dynamics/time_integrator.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * Saves the state of a TimeIntegrator in a file without loss of digits, and restores it.
   * Unknowns are stored in global order, so that a file can be read on any number of ranks. On
   * the same number of ranks the continued run is bitwise identical to an uninterrupted one.
   *
   * The file has the fingerprints of discretization and scheme, and a check sum. Functions are
   * collective.
   */
  struct Checkpoint
  {
    /// Write a checkpoint. It is written to a temporary file beside @p filename, synchronized to
    /// disk and renamed, so that @p filename is complete whenever the program is killed.
    /// @p of_caller is what the caller needs to make the integrator again; see read_of_caller().
    /// @throws OutputFailure, with the reason given by the system.
    static void
    write(const TimeIntegrator    &integrator,
          const std::string       &filename,
          const std::vector<char> &of_caller = {});

    /// Return the bytes that the caller gave to write(). No integrator is needed, so that these
    /// bytes can say how to make it. @throws InputError, with the reason, for a file that is
    /// missing, damaged or of another version.
    static std::vector<char>
    read_of_caller(const std::string &filename, MPI_Comm communicator);

    /// Restore a checkpoint. The integrator must have been made for the same scene.
    /// @throws InputError, with the reason, for a file that is missing, damaged, of
    /// another version, discretization or scheme; the integrator is then
    /// unchanged.
    static void
    read(const std::string &filename, TimeIntegrator &integrator);
  };
} // namespace NMM

#endif
