#include "expected_values.h"

#include "cases.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
  /// NaN for a cell that is no number, since the run has none there.
  double
  to_number(const std::string &cell)
  {
    std::istringstream stream(cell);
    double             value;
    return stream >> value ? value : std::nan("");
  }


  /// Rows of a table with a column @p key, as "<table>/<key>/<column>" and, of the
  /// last one, "<table>/last/<column>".
  void
  read_steps(const fs::path                &file_name,
             const std::string             &table,
             const std::string             &key_column,
             std::map<std::string, double> &values)
  {
    std::ifstream file(file_name);
    std::string   line;
    while (std::getline(file, line) && line[0] == '#')
      ;
    const auto columns = split(line, ',');
    const auto position =
      std::find(columns.begin(), columns.end(), key_column) - columns.begin();
    while (std::getline(file, line))
    {
      const auto fields = split(line, ',');
      for (const std::string &key : {fields.at(position), std::string("last")})
        for (std::size_t i = 0; i < fields.size(); ++i)
          values[table + "/" + key + "/" + columns.at(i)] =
            to_number(fields[i]);
    }
  }
} // namespace


std::vector<std::string>
case_names()
{
  std::vector<std::string> names;
  for (const std::string folder : {"", "reports/"})
    for (const auto &entry : fs::directory_iterator(cases_dir + folder))
      if (fs::exists(entry.path() / "expected.csv"))
        names.push_back(folder + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}


std::vector<std::string>
fracture_case_names()
{
  std::vector<std::string> names;
  for (const std::string &name : case_names())
    if (name.rfind("reports/", 0) != 0 &&
        read_text(read_case(name).scene).find("subsection Fracture\n") !=
          std::string::npos)
      names.push_back(name);
  return names;
}


std::string
read_text(const std::string &file_name)
{
  std::ifstream in(file_name);
  return {std::istreambuf_iterator<char>(in), {}};
}


Case
read_case(const std::string &name)
{
  Case          result;
  std::ifstream file(cases_dir + name + "/expected.csv");
  for (std::string line; std::getline(file, line);)
  {
    const auto directive = [&](const std::string &key) {
      return line.rfind("# " + key + ":", 0) == 0
               ? split(line.substr(key.size() + 3), '|')
               : std::vector<std::string>();
    };
    if (const auto scene = directive("scene"); !scene.empty())
      result.scene = cases_dir + name + "/" + scene.front();
    else if (const auto arguments = directive("arguments"); !arguments.empty())
      result.arguments = arguments;
    else if (const auto ranks = directive("ranks"); !ranks.empty())
      result.n_ranks = std::stoul(ranks.front());
    else if (const auto code = directive("exit code"); !code.empty())
      result.exit_code = std::stoi(code.front());
    else if (const auto build = directive("build"); !build.empty())
      result.is_long = build.front() == "Release";
    else if (const auto says = directive("says"); !says.empty())
      result.says = says;
    else if (!line.empty() && line[0] != '#' && line.rfind("name,", 0) != 0)
    {
      const auto fields = split(line, ',');
      // A tolerance or source left out is a mistake in the case.
      if (fields.size() < 5 || fields[4].empty())
        throw std::runtime_error("incomplete row of " + name + ": " + line);
      std::string source = line;
      for (unsigned int i = 0; i < 4; ++i)
        source.erase(0, source.find(',') + 1);
      source.erase(std::remove(source.begin(), source.end(), '"'),
                   source.end());
      result.rows.push_back({fields[0],
                             std::stod(fields[1]),
                             std::stod(fields[2]),
                             std::stod(fields[3]),
                             source});
    }
  }
  return result;
}


std::map<std::string, double>
read_results(const fs::path &directory)
{
  std::map<std::string, double> values;
  std::ifstream                 summary(directory / "summary.csv");
  std::string                   line;
  if (!std::getline(summary, line) || line != "name,value,unit")
    throw std::runtime_error("no summary.csv in " + directory.string());
  while (std::getline(summary, line))
  {
    const auto fields = split(line, ',');
    values[fields[0]] = std::stod(fields[1]);
  }

  for (const char *table : {"history", "probes-history"})
    read_steps(directory / (std::string(table) + ".csv"),
               table,
               "step",
               values);
  read_steps(directory / "tips.csv", "tips", "tip", values);
  read_steps(directory / "growth.csv", "growth", "step", values);

  std::ifstream probes(directory / "probes.csv");
  if (!std::getline(probes, line))
    return values;
  const auto columns = split(line, ',');
  while (std::getline(probes, line))
  {
    const auto fields = split(line, ',');
    for (std::size_t i = 2; i < fields.size(); ++i)
      values["probes/" + fields[0] + "/" + fields[1] + "/" + columns[i]] =
        to_number(fields[i]);
  }
  return values;
}


std::vector<std::string>
split(const std::string &line, const char separator)
{
  std::vector<std::string> fields;
  std::istringstream       stream(line);
  for (std::string field; std::getline(stream, field, separator);)
  {
    const auto first = field.find_first_not_of(' ');
    fields.push_back(
      first == std::string::npos
        ? ""
        : field.substr(first, field.find_last_not_of(' ') - first + 1));
  }
  return fields;
}
