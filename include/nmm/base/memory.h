#ifndef nmm_base_memory_h
#define nmm_base_memory_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

namespace NMM
{
  /// Memory a process can still have, and what bounds it.
  struct AvailableMemory
  {
    double      bytes;
    std::string bound;
  };

  /**
   * The least of: memory that is available on the machine (swap included), what the
   * control groups of this process leave, both divided by @p n_processes that
   * share them, and what the limits of this process leave (address space, data).
   */
  AvailableMemory
  available_memory(unsigned int n_processes = 1);

  /// The same on the rank that has least, where the ranks of one machine share its
  /// memory. Collective.
  AvailableMemory
  available_memory(MPI_Comm communicator);

  /**
   * To be called before memory is asked for. @p needed: estimate for this process
   * [bytes]; @p purpose: what it is for, "1e9 cells". @p remedy gets by how many
   * times that is too much. @throws InputError if there is less. Not collective.
   */
  void
  require_memory(double                                           needed,
                 const AvailableMemory                           &available,
                 const std::string                               &purpose,
                 const std::string                               &where,
                 const std::function<std::string(double excess)> &remedy);
} // namespace NMM

#endif
