#ifndef nmm_output_csv_series_h
#define nmm_output_csv_series_h

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  /// @p text as a cell of a CSV file. It is put between quotation marks if it contains a comma, a
  /// quotation mark, which is doubled, or the end of a line. If it begins with =, +, - or @ and is
  /// no number, an apostrophe precedes it, so that a spreadsheet does not run it as a formula.
  std::string
  quoted(const std::string &text);


  /// The shortest text that reads back as the same number, such as 0.03.
  std::string
  shortest_text(double number);


  /// A time or load factor with 14 digits at most, so that the rounding of a sum of steps does not show:
  /// 0.03 instead of 0.029999999999999999.
  std::string
  time_text(double time);


  /**
   * A CSV file to which rows are appended while a run goes on; it is valid after each of
   * them. A run that continues an earlier one removes the rows after its start.
   * For use on one rank.
   */
  class CsvSeries
  {
  public:
    /**
     * Makes a file that begins with the lines of @p head. If @p is_kept is given, those
     * rows of an earlier file follow for which it returns true. An incomplete last row, from a
     * run that was killed, is dropped. The earlier file is replaced in a single operation.
     * @throws OutputFailure if the file cannot be written.
     * @throws InputError if the earlier file has another head.
     */
    CsvSeries(std::string                                     file_name,
              const std::string                              &head,
              const std::function<bool(const std::string &)> &is_kept = {});

    /**
     * Makes a file with the columns time, step and @p columns, whose names are its first line. The
     * rows of an earlier file up to the step @p continue_after are kept; a negative number stands
     * for no earlier file.
     */
    CsvSeries(std::string                     file_name,
              const std::vector<std::string> &columns,
              int                             continue_after);

    /// Appends complete lines. @throws OutputFailure if they cannot be written.
    void
    append(const std::string &rows);

    /// Appends a row, with the time by time_text() and numbers by shortest_text().
    void
    append(double time, unsigned int step, const std::vector<double> &values);

  private:
    std::string   file_name;
    std::ofstream out;
  };
} // namespace NMM

#endif
