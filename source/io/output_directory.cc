#include <nmm/base/exceptions.h>
#include <nmm/io/output_directory.h>

#include <fstream>
#include <iomanip>
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
    // The nearest thing on the way that exists must be a writable folder.
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
  }


  namespace
  {
    bool
    starts_with(const std::string &name, const std::string &prefix)
    {
      return name.rfind(prefix, 0) == 0;
    }


    bool
    is_result(const std::string &name, const bool of_end_only)
    {
      const std::string extension = fs::path(name).extension().string();
      if (name == "summary.csv" || name == "probes.csv" ||
          name == "picture.png" || name == "contacts.vtp" ||
          name == "animation.html" ||
          (starts_with(name, "fields.") &&
           (extension == ".vtu" || extension == ".pvtu")))
        return true;
      if (of_end_only)
        return false;
      return name == "history.csv" || name == "probes-history.csv" ||
             name == "checkpoint.nmm" || name == "fields.pvd" ||
             name == "contacts.csv" || name == "contacts.pvd" ||
             name == "left-blocks.csv" || name == "animation.frames" ||
             (starts_with(name, "contacts-") && extension == ".vtp") ||
             (starts_with(name, "fields-") &&
              (extension == ".vtu" || extension == ".pvtu")) ||
             (starts_with(name, "picture-") && extension == ".png");
    }


    /// The name of what was being written when a run was killed.
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


  void
  OutputDirectory::remove_results(const bool of_end_only) const
  {
    std::vector<fs::path> results;
    for (const auto &entry : fs::directory_iterator(folder))
    {
      const std::string name  = entry.path().filename().string();
      const std::string whole = without_part(name);
      if (is_result(whole, of_end_only && whole == name))
        results.push_back(entry.path());
    }
    for (const fs::path &result : results)
      fs::remove(result);
  }


  void
  OutputDirectory::create() const
  {
    check();
    fs::create_directories(folder);
    remove_results(/* of_end_only = */ false);
  }


  void
  OutputDirectory::resume() const
  {
    check();
    fs::create_directories(folder);
    remove_results(/* of_end_only = */ true);
  }


  void
  OutputDirectory::write_file(
    const std::string                              &name,
    const std::function<void(const std::string &)> &write) const
  {
    const fs::path temporary = folder / ("." + name + ".part");
    try
    {
      write(temporary.string());
      fs::rename(temporary, folder / name);
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
      std::ofstream out(file_name);
      AssertThrow(out.good(), dealii::ExcFileNotOpen(file_name));
      write(out);
      out.close();
      AssertThrow(!out.fail(), dealii::ExcIO());
    });
  }


  void
  Summary::add(const std::string &name,
               const double       value,
               const std::string &unit)
  {
    rows.push_back({name, value, unit});
  }


  void
  Summary::write(std::ostream &out) const
  {
    out << "name,value,unit\n" << std::setprecision(12);
    for (const Row &row : rows)
      out << row.name << ',' << row.value << ',' << row.unit << '\n';
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
