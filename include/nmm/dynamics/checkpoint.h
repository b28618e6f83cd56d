#ifndef nmm_dynamics_checkpoint_h
#define nmm_dynamics_checkpoint_h

#include <nmm/dynamics/time_integrator.h>

#include <string>

namespace NMM
{
  /**
   * Saves the state of a TimeIntegrator in a file without loss of digits, and restores it.
   * Unknowns are stored in global order, so that a file can be read on any number of ranks. On
   * the same number of ranks the continued run is bitwise identical to an uninterrupted one.
   *
   * File (little endian): "NMMSTATE", version, length of what follows, the
   * fingerprints of the discretization and of the scheme, the state, and a 64-bit
   * FNV-1a check sum of everything before. Rank 0 writes and reads. Functions are collective.
   */
  struct Checkpoint
  {
    /// Write a checkpoint. It is written to a temporary file beside @p filename, synchronized to
    /// disk and renamed, so that @p filename is complete whenever the program is killed.
    /// @throws OutputFailure, with the reason given by the system.
    static void
    write(const TimeIntegrator &integrator, const std::string &filename);

    /// Restore a checkpoint. The integrator must have been made for the same scene.
    /// @throws InputError, with the reason, for a file that is missing, damaged, of
    /// another version, discretization or scheme; the integrator is then
    /// unchanged.
    static void
    read(const std::string &filename, TimeIntegrator &integrator);
  };
} // namespace NMM

#endif
