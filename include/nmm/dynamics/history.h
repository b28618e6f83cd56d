#ifndef nmm_dynamics_history_h
#define nmm_dynamics_history_h

#include <nmm/dynamics/step_control.h>

#include <fstream>
#include <string>
#include <vector>

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
     * step @p continue_after taken away. @p further_columns come last.
     * @throws OutputFailure, or InputError if the file is no history.
     */
    explicit History(const std::string              &filename,
                     MPI_Comm                        communicator,
                     int                             continue_after  = -1,
                     const std::vector<std::string> &further_columns = {});

    /// The current state, reached by @p record; a default record for the start.
    void
    write(const TimeIntegrator      &integrator,
          const StepRecord          &record,
          const std::vector<double> &further_values = {});

  private:
    std::string   filename;
    unsigned int  n_further;
    bool          writes;
    std::ofstream out;
  };
} // namespace NMM

#endif
