#ifndef nmm_output_output_directory_h
#define nmm_output_output_directory_h

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * The folder results are written to. Each file is written under a temporary
   * name and renamed when it is complete, so that whatever happens no file is
   * half written or older than its neighbours.
   */
  class OutputDirectory
  {
  public:
    explicit OutputDirectory(std::filesystem::path path);

    const std::filesystem::path &
    path() const;

    /// @throws InputError if the folder cannot be made or written to, or folders
    /// have names of results. What is made to find out is removed again.
    void
    check() const;

    /// Make the folder and remove the results of an earlier run.
    void
    create() const;

    /// Make the folder if need be, to continue an earlier run: remove only what
    /// that wrote at its end, not histories, series and checkpoint.
    void
    resume() const;

    /// @p write gets the temporary file's name. @throws OutputFailure.
    void
    write_file(const std::string                              &name,
               const std::function<void(const std::string &)> &write) const;

    void
    write_text(const std::string                         &name,
               const std::function<void(std::ostream &)> &write) const;

  private:
    void
    remove_results(bool of_end_only) const;

    /// Name of a folder where a file of results belongs; empty: none.
    std::string
    folder_in_the_way() const;

    /// Make the folder and a file in it, and remove both; the system's reason if
    /// that cannot be done.
    std::string
    try_to_write() const;

    std::filesystem::path folder;
  };


  /// The rows of summary.csv: name, value, unit.
  class Summary
  {
  public:
    /// A row of that name that there is already is replaced.
    void
    add(const std::string &name, double value, const std::string &unit = "-");

    /// "name,value,unit" and a line per row, numbers with 12 digits.
    void
    write(std::ostream &out) const;

    /// Which value is not finite; empty: all are.
    std::string
    find_not_finite() const;

    /// The value called @p name; it must exist.
    double
    value(const std::string &name) const;

  private:
    struct Row
    {
      std::string name;
      double      value;
      std::string unit;
    };
    std::vector<Row> rows;
  };
} // namespace NMM

#endif
