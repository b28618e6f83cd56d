#ifndef nmm_tests_scenes_expected_values_h
#define nmm_tests_scenes_expected_values_h

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// Each folder beside this file, and below "reports" (what users of this program and of others
// reported), is a case: expected.csv says in comment lines which
// scene is run and how ("# scene:", "# arguments:", "# ranks:", "# exit code:") and what
// the run prints among other things ("# says:"), whether Debug leaves it out since it takes
// long there and other cases run the same code ("# build: Release"), and
// has the rows name, value, abs_tol, rel_tol, source of the value. Arguments and what
// is printed are separated by vertical bars. A name is a row
// of summary.csv, "probes/<probe>/<point>/<column>" of probes.csv, or
// "history/<step>/<column>" of history.csv, "probes-history/..." likewise; <step> may
// be "last", "tips/<tip>/<column>" of tips.csv, or "growth/<step>/<column>" of
// growth.csv. A value v passes if
// |v - expected| <= abs_tol + rel_tol * |expected|.

struct ExpectedValue
{
  std::string name;
  double      value, abs_tol, rel_tol;
  /// Where the value comes from, without quotation marks.
  std::string source;

  /// Largest deviation that is allowed.
  double
  tolerance() const
  {
    return abs_tol + rel_tol * std::abs(value);
  }

  /// What deviations are divided by for a report: 1 where the value is 0.
  double
  scale() const
  {
    return value == 0. ? 1. : std::abs(value);
  }
};

struct Case
{
  /// Its path, which begins with that of cases.h.
  std::string              scene;
  std::vector<std::string> arguments;
  unsigned int             n_ranks   = 1;
  int                      exit_code = 0;
  /// Whether it is left out in Debug.
  bool                       is_long = false;
  std::vector<std::string>   says;
  std::vector<ExpectedValue> rows;
};

/// Folders with an expected.csv, in alphabetical order.
std::vector<std::string>
case_names();

/// Those beside the reports whose scenes have a section Fracture.
std::vector<std::string>
fracture_case_names();

/// All of a file's text; empty if there is no file.
std::string
read_text(const std::string &file_name);

/// The case in the folder of that name. Throws std::runtime_error where a row lacks a
/// tolerance or a source.
Case
read_case(const std::string &name);

/// Values in the files of a run, by the names above; NaN where a cell is no number.
std::map<std::string, double>
read_results(const std::filesystem::path &directory);

/// Fields of a line, without blanks around them.
std::vector<std::string>
split(const std::string &line, char separator);

#endif
