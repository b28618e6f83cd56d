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


  void
  OutputDirectory::create() const
  {
    check();
    fs::create_directories(folder);
    for (const auto &entry : fs::directory_iterator(folder))
    {
      const std::string name      = entry.path().filename().string();
      const std::string extension = entry.path().extension().string();
      const bool        is_field =
        (name.rfind("fields.", 0) == 0 || name.rfind("fields-", 0) == 0) &&
        (extension == ".vtu" || extension == ".pvtu" || extension == ".pvd");
      if (is_field || name == "summary.csv" || name == "probes.csv" ||
          name == "history.csv" || name == "picture.png")
        fs::remove(entry.path());
    }
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
