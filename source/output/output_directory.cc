#include <nmm/base/program.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/output_directory.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <ios>
#include <output/folder_lock.h>
#include <system_error>
#include <unistd.h>

namespace NMM
{
  namespace fs = std::filesystem;

  OutputDirectory::OutputDirectory(fs::path path)
    : folder(std::move(path))
  {
  }


  const fs::path &
  OutputDirectory::path() const
  {
    return folder;
  }


  void
  OutputDirectory::check() const
  {
    const std::string where = "--output " + folder.string();
    AssertThrow(!folder.empty(),
                InputError("the output folder has no name",
                           where,
                           "name a folder"));
    // The nearest parent of the folder that exists must be a writable folder.
    fs::path        existing = fs::absolute(folder);
    std::error_code error;
    while (!fs::exists(existing, error) && existing.has_relative_path())
      existing = existing.parent_path();
    AssertThrow(fs::is_directory(existing, error),
                InputError("'" + existing.string() + "' is not a folder",
                           where,
                           "name a folder that exists or can be made"));
    AssertThrow(access(existing.c_str(), W_OK | X_OK) == 0,
                InputError("the folder '" + existing.string() +
                             "' cannot be written to",
                           where,
                           "change its permissions or name another one"));
    lock();
    const std::string in_the_way = folder_in_the_way();
    AssertThrow(
      in_the_way.empty(),
      InputError("a folder has the name '" + in_the_way +
                   "' of a file of results",
                 where,
                 "rename or remove it, or name another folder for the "
                 "results"));
    // Permissions do not tell whether a name is too long, or whether the file system is
    // read-only, full or virtual. A trial does.
    const std::string fault = try_to_write();
    AssertThrow(fault.empty(),
                InputError("files cannot be made there (" + fault + ")",
                           where,
                           "name a folder with shorter names, on a file system "
                           "that can be written to and has space left"));
  }


  std::string
  OutputDirectory::try_to_write() const
  {
    std::vector<fs::path> made;
    std::error_code       error;
    std::string           fault;
    fs::path              parent;
    for (const fs::path &name : fs::absolute(folder))
    {
      parent /= name;
      if (fs::exists(parent, error))
        continue;
      error.clear();
      if (!fs::create_directory(parent, error) || error)
      {
        fault = error ? error.message() : "it is not there after it was made";
        break;
      }
      made.push_back(parent);
    }
    if (fault.empty())
    {
      // mkstemp() makes a file with a new name, and never follows a link.
      std::string name = (folder / ".nmm-trial.XXXXXX").string();
      const int   file = mkstemp(name.data());
      if (file < 0 || ::write(file, "trial", 5) != 5)
        fault = std::strerror(errno);
      if (file >= 0)
      {
        close(file);
        fs::remove(name, error);
      }
    }
    for (auto path = made.rbegin(); path != made.rend(); ++path)
      fs::remove(*path, error);
    return fault;
  }


  namespace
  {
    /// Name of the file that lists the results in a folder.
    const char *const name_of_list = ".nmm-results";


    bool
    starts_with(const std::string &name, const std::string &prefix)
    {
      return name.rfind(prefix, 0) == 0;
    }


    bool
    is_result(const std::string &name, const bool of_end_only)
    {
      const std::string extension = fs::path(name).extension().string();
      if (name == "summary.csv" || name == "probes.csv" || name == "tips.csv" ||
          name == "tips.vtu" || name == "growth.csv" || name == "picture.png" ||
          name == "contacts.vtp" || name == "animation.html" ||
          name == "cleaning.csv" ||
          (starts_with(name, "fields.") &&
           (extension == ".vtu" || extension == ".pvtu")))
        return true;
      if (of_end_only)
        return false;
      return name == "history.csv" || name == "safety_factor.csv" ||
             name == "probes-history.csv" || name == "checkpoint.nmm" ||
             name == "fields.pvd" || name == "contacts.csv" ||
             name == "contacts.pvd" || name == "tips.pvd" ||
             name == "left-blocks.csv" || name == "animation.frames" ||
             (starts_with(name, "contacts-") && extension == ".vtp") ||
             (starts_with(name, "tips-") && extension == ".vtu") ||
             (starts_with(name, "fields-") &&
              (extension == ".vtu" || extension == ".pvtu")) ||
             (starts_with(name, "picture-") && extension == ".png");
    }


    /// The final name of a temporary file, which a killed run leaves; other names are unchanged.
    std::string
    without_part(std::string name)
    {
      const std::string part = ".part";
      if (name.size() > part.size() &&
          name.compare(name.size() - part.size(), part.size(), part) == 0)
      {
        name.resize(name.size() - part.size());
        if (name.front() == '.')
          name.erase(0, 1);
      }
      return name;
    }
  } // namespace


  std::string
  OutputDirectory::folder_in_the_way() const
  {
    std::error_code error;
    for (const auto &entry : fs::directory_iterator(folder, error))
    {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory(error) && is_result(without_part(name), false))
        return name;
    }
    return "";
  }


  void
  OutputDirectory::remove_results(const bool of_end_only) const
  {
    std::set<std::string> of_earlier_runs;
    {
      std::ifstream list(folder / name_of_list);
      for (std::string name; std::getline(list, name);)
        of_earlier_runs.insert(name);
    }
    std::vector<fs::path> results;
    for (const auto &entry : fs::directory_iterator(folder))
    {
      const std::string name  = entry.path().filename().string();
      const std::string whole = without_part(name);
      if (of_earlier_runs.count(whole) > 0 &&
          is_result(whole, of_end_only && whole == name))
        results.push_back(entry.path());
    }
    for (const fs::path &result : results)
      fs::remove(result);
    if (!of_end_only)
      fs::remove(folder / name_of_list);
  }


  void
  OutputDirectory::lock() const
  {
    std::error_code error;
    if (!folder_lock && fs::is_directory(folder, error))
      folder_lock = std::make_shared<internal::FolderLock>(folder);
  }


  void
  OutputDirectory::create() const
  {
    check();
    fs::create_directories(folder);
    lock();
    remove_results(/* of_end_only = */ false);
  }


  void
  OutputDirectory::resume() const
  {
    check();
    fs::create_directories(folder);
    lock();
    remove_results(/* of_end_only = */ true);
  }


  std::string
  OutputDirectory::file(const std::string &name) const
  {
    if (is_result(name, /* of_end_only = */ false) &&
        listed.insert(name).second)
    {
      errno = 0;
      std::ofstream list(folder / name_of_list, std::ios::app);
      list << name + '\n' << std::flush;
      AssertThrow(list.good(), OutputFailure((folder / name_of_list).string()));
    }
    return (folder / name).string();
  }


  void
  OutputDirectory::write_file(
    const std::string                              &name,
    const std::function<void(const std::string &)> &write) const
  {
    const std::string path      = file(name);
    const fs::path    temporary = folder / ("." + name + ".part");
    std::error_code   error;
    // If there is a link of this name, what it points to must not be overwritten.
    fs::remove(temporary, error);
    try
    {
      write(temporary.string());
      fs::rename(temporary, path, error);
      errno = error.value();
      AssertThrow(!error, OutputFailure(path));
    }
    catch (...)
    {
      std::error_code ignored;
      fs::remove(temporary, ignored);
      throw;
    }
  }


  void
  OutputDirectory::write_text(
    const std::string                         &name,
    const std::function<void(std::ostream &)> &write) const
  {
    write_file(name, [&](const std::string &file_name) {
      // The stream itself throws when it fails: what writes to it, such as deal.II, would throw
      // something else.
      try
      {
        errno = 0;
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.open(file_name);
        write(out);
        out.close();
      }
      catch (const std::ios_base::failure &)
      {
        AssertThrow(false, OutputFailure((folder / name).string()));
      }
    });
  }


  void
  Summary::add(const std::string &name,
               const double       value,
               const std::string &unit)
  {
    for (Row &row : rows)
      if (row.name == name)
      {
        row = {name, value, unit};
        return;
      }
    rows.push_back({name, value, unit});
  }


  void
  Summary::write(std::ostream &out) const
  {
    out << "name,value,unit\n" << std::setprecision(12);
    for (const Row &row : rows)
      out << quoted(row.name) << ',' << row.value << ',' << quoted(row.unit)
          << '\n';
  }


  std::string
  Summary::find_not_finite() const
  {
    for (const Row &row : rows)
      if (!std::isfinite(row.value))
        return "the result '" + row.name + "' is not finite";
    return "";
  }


  double
  Summary::value(const std::string &name) const
  {
    for (const Row &row : rows)
      if (row.name == name)
        return row.value;
    Assert(false, dealii::ExcMessage("no row '" + name + "' in the summary"));
    return 0.;
  }
} // namespace NMM
