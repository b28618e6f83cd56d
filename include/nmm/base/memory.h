#ifndef nmm_base_memory_h
#define nmm_base_memory_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

namespace NMM
{
  /// The memory that a process can still allocate, and what limits it.
  struct AvailableMemory
  {
    /// The memory that is left [bytes], >= 0; the largest double if no limit is known.
    double bytes;
    /// What sets this limit, as part of a message, e.g. "the machine"; empty if there is no limit.
    std::string bound;
  };

  /**
   * The memory that this process can still allocate. It is the least of three numbers: the
   * memory that is available on the machine (swap included), what the control groups of this
   * process leave, and what the limits of this process leave (address space, data). The first
   * two are divided by the number of processes @p n_processes that share them.
   */
  AvailableMemory
  available_memory(unsigned int n_processes = 1);

  /// The smallest memory that is left for any rank of @p communicator, where the ranks on one
  /// machine share its memory. AvailableMemory::bound is that of the calling rank. Collective.
  AvailableMemory
  available_memory(MPI_Comm communicator);

  /**
   * Lets the linear algebra take its work space now, so that it is a part of the memory in use
   * afterwards. OpenBLAS takes 134 MB of address space for each thread in its first product of
   * matrices, and if a limit of the process (`ulimit -v`) does not leave them, it asks for them
   * without end. @throws InputError if they are not left.
   */
  void
  reserve_work_space();

  /**
   * Checks that there is enough memory, before a large allocation. @p needed is an estimate for
   * this process [bytes], @p purpose says what it is for, e.g. "1e9 cells", and @p where is the
   * place in the message. @p remedy makes the advice in the message from @p needed over the
   * memory that is available [-]. Not collective.
   * @throws InputError if @p needed exceeds @p available.
   */
  void
  require_memory(double                                           needed,
                 const AvailableMemory                           &available,
                 const std::string                               &purpose,
                 const std::string                               &where,
                 const std::function<std::string(double excess)> &remedy);
} // namespace NMM

#endif
