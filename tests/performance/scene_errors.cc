// Errors of scenes with cracks beside their unknowns and seconds.
//
//   nmm-scene-errors <table.csv> <page.md> <first line of the table>
//
// Runs each case of tests/scenes whose scene has a section Fracture, by the driver in a
// process of its own, and writes a row for each. Its error is that of the value which
// uses most of the deviation that expected.csv allows, the first one of those within 1 % of it.
// It is relative, or absolute where the reference is 0. Counts, which allow no deviation, are
// left out. Unknowns and elements are those of the last cut; the seconds, from curves to answers,
// are without output. In the page the table whose head write_page() names is replaced. Ends with
// exit code 3, and no file is changed, where a case fails.

#include <cmath>
#include <fstream>
#include <iostream>
#include <scenes/expected_values.h>
#include <scenes/run_driver.h>
#include <sstream>
#include <stdexcept>

namespace
{
  struct SceneError
  {
    std::string   scene;
    double        unknowns, elements, seconds;
    ExpectedValue expected;
    double        value, error, allowed;
  };


  /// Throws std::runtime_error if the driver ends otherwise than it should, a value is off by
  /// more than is allowed, or there is none but counts.
  SceneError
  run_case(const std::string &name)
  {
    const Case               scene     = read_case(name);
    const std::string        output    = fresh_output_dir(name);
    std::vector<std::string> arguments = scene.arguments;
    arguments.insert(arguments.end(), {"--output", output, scene.scene});
    const DriverResult run = run_driver(arguments, scene.n_ranks);
    if (run.exit_code != scene.exit_code)
      throw std::runtime_error(name + ": " + run.output);

    const auto values  = read_results(output);
    double     largest = -1.;
    SceneError worst{name,
                     values.at("unknowns"),
                     values.at("manifold_elements"),
                     values.at("time_total") - values.at("time_output"),
                     {},
                     0.,
                     0.,
                     0.};
    for (const ExpectedValue &row : scene.rows)
    {
      const double allowed = row.tolerance();
      const double error   = std::abs(values.at(row.name) - row.value);
      if (!(error <= allowed))
        throw std::runtime_error(name + ": " + row.name + " is off by " +
                                 std::to_string(error));
      if (allowed > 0. && row.name != "unknowns" &&
          !(error <= 1.01 * largest * allowed))
      {
        largest        = error / allowed;
        worst.expected = row;
        worst.value    = values.at(row.name);
        worst.error    = error / row.scale();
        worst.allowed  = allowed / row.scale();
      }
    }
    if (largest < 0.)
      throw std::runtime_error(name + ": no value but counts");
    return worst;
  }


  std::string
  two_digits(const double x)
  {
    std::ostringstream text;
    text.precision(2);
    text << x;
    return text.str();
  }


  void
  write_page(const std::string &page, const std::vector<SceneError> &rows)
  {
    const std::string table_head =
      "| scene | unknowns | seconds | largest error | allowed | reference |\n"
      "|---|---|---|---|---|---|\n";
    const std::string text  = read_text(page);
    const std::size_t begin = text.find(table_head);
    if (begin == std::string::npos)
      throw std::runtime_error(page + " has no table of scenes");
    const std::size_t end = text.find("\n\n", begin);

    std::ofstream out(page);
    out << text.substr(0, begin) << table_head;
    for (const SceneError &row : rows)
      out << "| `" << row.scene << "` | " << row.unknowns << " | "
          << two_digits(row.seconds) << " | " << two_digits(row.error)
          << " in `" << row.expected.name << "` | " << two_digits(row.allowed)
          << " | "
          << row.expected.source.substr(0, row.expected.source.find(';'))
          << " |\n";
    if (end != std::string::npos)
      out << text.substr(end + 1);
  }
} // namespace


int
main(int argc, char **argv)
{
  try
  {
    if (argc != 4)
      throw std::runtime_error(
        "say nmm-scene-errors <table.csv> <page.md> "
        "<first line of the table>");
    std::vector<SceneError> rows;
    std::ostringstream      table;
    table << argv[3]
          << "\nscene,unknowns,elements,seconds,name,value,reference,error,"
             "allowed,source\n";
    for (const std::string &name : fracture_case_names())
    {
      rows.push_back(run_case(name));
      const SceneError &row = rows.back();
      std::cout << name << ": " << row.error << " in " << row.expected.name
                << ", allowed " << row.allowed << std::endl;
      table << name << ',' << row.unknowns << ',' << row.elements << ','
            << row.seconds << ',' << row.expected.name << ',' << row.value
            << ',' << row.expected.value << ',' << row.error << ','
            << row.allowed << ",\"" << row.expected.source << "\"\n";
    }
    std::ofstream(argv[1]) << table.str();
    write_page(argv[2], rows);
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 3;
  }
  return 0;
}
