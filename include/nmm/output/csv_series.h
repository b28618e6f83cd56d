#ifndef nmm_output_csv_series_h
#define nmm_output_csv_series_h

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  /// A word as a cell of a CSV file: between quotation marks where it has a comma or such a
  /// mark, which is doubled.
  std::string
  quoted(const std::string &text);


  /**
   * A CSV file that grows by rows while a run goes on; it is complete after each of
   * them. A run that continues an earlier one takes away the rows after its start.
   * For use on one rank.
   */
  class CsvSeries
  {
  public:
    /**
     * A new file that begins with the lines of @p head. If @p is_kept is given, the
     * rows of an earlier file for which it is true follow, but for one that was cut off
     * by a kill; the file is replaced in one go.
     * @throws OutputFailure, or InputError if the earlier file has another head.
     */
    CsvSeries(std::string                                     file_name,
              const std::string                              &head,
              const std::function<bool(const std::string &)> &is_kept = {});

    /**
     * With the columns time, step and @p columns, below a line @p comment. Of an
     * earlier file the rows up to step @p continue_after are kept; negative: there
     * is none.
     */
    CsvSeries(std::string                     file_name,
              const std::string              &comment,
              const std::vector<std::string> &columns,
              int                             continue_after);

    /// Append whole lines. @throws OutputFailure.
    void
    append(const std::string &rows);

    /// Append a row of numbers with 17 digits, so that equal bits are equal text.
    void
    append(double time, unsigned int step, const std::vector<double> &values);

  private:
    std::string   file_name;
    std::ofstream out;
  };
} // namespace NMM

#endif
