#ifndef nmm_output_output_directory_h
#define nmm_output_output_directory_h

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class FolderLock;
  }

  /**
   * The folder to which results are written. Each file is written under a temporary
   * name and renamed when it is complete, so that no file is ever incomplete, and none is left
   * from an earlier run. Names of results are listed in the file `.nmm-results` of the folder, and
   * only files on this list are removed: files of the user's own stay, whatever their names.
   * From the first check on that finds the folder, no other run may write to it
   * while this object and its copies exist.
   */
  class OutputDirectory
  {
  public:
    /// Only keeps @p path; nothing is made or checked yet.
    explicit OutputDirectory(std::filesystem::path path);

    /// The path that was given to the constructor.
    const std::filesystem::path &
    path() const;

    /// Checks whether the folder can be made and written to; files and folders that are made for
    /// that are removed again. @throws InputError if it cannot, if another run writes to it, or if a
    /// folder in it has the name of a file of results.
    void
    check() const;

    /// Makes the folder, if it does not exist, and removes the results of an earlier run.
    /// @throws InputError as check().
    void
    create() const;

    /// Prepares the folder for the continuation of an earlier run: only the results that are
    /// written at the end of a run are removed, but not histories, series and the checkpoint.
    /// @throws InputError as check().
    void
    resume() const;

    /// The path of the file @p name, to which somebody else writes; the name is listed.
    /// @throws OutputFailure if the list cannot be written.
    std::string
    file(const std::string &name) const;

    /// Calls @p write with the name of a temporary file, and renames that to @p name.
    /// @throws OutputFailure if it cannot be renamed.
    void
    write_file(const std::string                              &name,
               const std::function<void(const std::string &)> &write) const;

    /// Calls @p write with a stream, whose text becomes the file @p name.
    /// @throws OutputFailure if the file cannot be written.
    void
    write_text(const std::string                         &name,
               const std::function<void(std::ostream &)> &write) const;

  private:
    void
    remove_results(bool of_end_only) const;

    /// A folder that has the name of a file of results; empty if there is none.
    std::string
    folder_in_the_way() const;

    /// Makes the folder and a file in it, and removes both. Returns the system's reason if
    /// that fails, else an empty string.
    std::string
    try_to_write() const;

    /// Keeps other runs out of the folder, if it exists. @throws InputError if one is in it.
    void
    lock() const;

    std::filesystem::path folder;
    /// Names that this object has put on the list.
    mutable std::set<std::string> listed;
    /// Null until lock() has been called for a folder that exists.
    mutable std::shared_ptr<internal::FolderLock> folder_lock;
  };


  /// The rows of summary.csv: name, value, unit.
  class Summary
  {
  public:
    /// Adds a row, or replaces the row with the same name. @p unit "-" stands for a number without
    /// unit.
    void
    add(const std::string &name, double value, const std::string &unit = "-");

    /// Writes the head "name,value,unit" and a line per row, with numbers of 12 digits.
    void
    write(std::ostream &out) const;

    /// A message that names a value that is not finite; empty if all are finite.
    std::string
    find_not_finite() const;

    /// The value of the row @p name, which must exist.
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
