#ifndef nmm_scene_time_table_h
#define nmm_scene_time_table_h

#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * A table that grows by a row per time step, a CSV file whose first columns are
   * time and step; it is complete after each row. Numbers have 17 digits, so
   * that equal bits are equal text. Rank 0 writes.
   */
  class TimeTable
  {
  public:
    /**
     * A new file, or, to continue, @p filename with the rows after step
     * @p continue_after taken away, which replaces it in one go. @p columns are
     * those after time and step; @p comment, if not empty, is a first line.
     * @throws OutputFailure, or InputError if the file has other columns.
     */
    TimeTable(const std::string              &filename,
              const std::string              &comment,
              const std::vector<std::string> &columns,
              MPI_Comm                        communicator,
              int                             continue_after = -1);

    /// @throws OutputFailure.
    void
    write(double time, unsigned int step, const std::vector<double> &values);

  private:
    std::string   filename;
    unsigned int  n_columns;
    bool          writes;
    std::ofstream out;
  };
} // namespace NMM

#endif
