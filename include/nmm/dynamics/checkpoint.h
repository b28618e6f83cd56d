#ifndef nmm_dynamics_checkpoint_h
#define nmm_dynamics_checkpoint_h

#include <nmm/dynamics/time_integrator.h>

#include <string>

namespace NMM
{
  /**
   * The integrator's state in a file, bit by bit. Unknowns are in global order, so
   * that any number of ranks can read what another one wrote; bits on
   * continuing are the same for the same number of ranks.
   *
   * File (little endian): "NMMSTATE", version, length of what follows, the
   * fingerprint of the discretization and of the scheme, state, and a 64-bit
   * FNV-1a sum of everything before. Rank 0 writes and reads.
   */
  struct Checkpoint
  {
    /// Written beside @p filename, synchronized to disk and renamed: whenever the
    /// program is killed, the file is the last complete one.
    /// @throws OutputFailure.
    static void
    write(const TimeIntegrator &integrator, const std::string &filename);

    /// @throws InputError, with the reason, for a file that is missing, damaged, of
    /// another version, discretization or scheme; the integrator is then
    /// unchanged.
    static void
    read(const std::string &filename, TimeIntegrator &integrator);
  };
} // namespace NMM

#endif
