#ifndef nmm_source_dynamics_checkpoint_file_h
#define nmm_source_dynamics_checkpoint_file_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * A file from which a run can continue. It is complete or not there, whenever the program is
     * killed, and a damaged one is recognized.
     *
     * File (little endian): "NMMSTATE", version, length of what follows, the members by to_bytes(),
     * and a 64-bit FNV-1a check sum of everything before. Rank 0 writes and reads.
     *
     * Who can write the file can make the check sum fit. Therefore what reads the members checks
     * all indices and lists, see require_in_checkpoint().
     */
    struct CheckpointFile
    {
      /// The kind of run that is saved, such as "a motion", for the message to who continues
      /// another one.
      std::string kind;
      /// What is needed to make the equations again.
      std::vector<char> preparation;
      /// The state of the equations.
      std::vector<char> state;

      /// Writes a temporary file beside @p filename, synchronizes it to disk and renames it.
      /// Collective. @throws OutputFailure, with the reason given by the system.
      void
      write(const std::string &filename, MPI_Comm communicator) const;

      /// Reads a file, on all ranks. Collective. @throws InputError, with the reason, for one that
      /// is missing, damaged, of another version, or of another kind than @p kind.
      static CheckpointFile
      read(const std::string &filename,
           MPI_Comm           communicator,
           const std::string &kind);
    };


    /// Refuses a checkpoint that is whole, but not that of the present scene. @throws InputError
    /// always.
    [[noreturn]] void
    refuse_checkpoint(const std::string &what, const std::string &filename);

  } // namespace internal
} // namespace NMM

#endif
