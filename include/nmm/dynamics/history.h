#ifndef nmm_dynamics_history_h
#define nmm_dynamics_history_h

#include <nmm/dynamics/step_control.h>

#include <fstream>
#include <string>

namespace NMM
{
  /**
   * Writes history.csv: a row per step with time, step, size, iterations, energies, their
   * balance and momenta; a first line that begins with # names units. All
   * per unit thickness. The file is complete after each row. Rank 0 writes.
   */
  class History
  {
  public:
    /**
     * A new file, or, to continue from a checkpoint, @p filename with the rows after
     * step @p continue_after taken away.
     * @throws InputError if the file cannot be written or is no history.
     */
    explicit History(const std::string &filename,
                     MPI_Comm           communicator,
                     int                continue_after = -1);

    /// The current state, reached by @p record; a default record for the start.
    void
    write(const TimeIntegrator &integrator, const StepRecord &record);

  private:
    std::string   filename;
    bool          writes;
    std::ofstream out;
  };
} // namespace NMM

#endif
