#ifndef nmm_tests_support_hard_cases_table_h
#define nmm_tests_support_hard_cases_table_h

#include <sstream>
#include <string>
#include <support/hard_cases/hard_cases.h>
#include <vector>

namespace NMM
{
  namespace HardCases
  {
    /// The largest and, of condition numbers, also the smallest of many results.
    struct Worst
    {
      unsigned int n = 0, n_failures = 0, cg_iterations = 0;
      double       condition = 0., mass_condition = 0., displacement_error = 0.,
             energy_error = 0., smallest_fraction = 1.;

      void
      add(const Result &result);
    };

    /// Collects tables, prints them as they grow, and writes them at the end.
    class Report
    {
    public:
      void
      section(const std::string &title, const std::string &text);

      void
      header(const std::vector<std::string> &cells);

      void
      line(const std::vector<std::string> &cells);

      /// A line of the standard table: condition numbers, iterations and errors
      /// beside those of the uncut mesh.
      void
      row(const std::string &name,
          Stabilization      stabilization,
          const Result      &uncut,
          const Worst       &worst,
          const Worst       &patch);

      /// A line of the csv file.
      void
      csv(const std::string &name, const Result &result);

      /// Empty names: not written.
      void
      write(const std::string &markdown_file,
            const std::string &csv_file) const;

      /// With three digits.
      static std::string
      number(double value);

    private:
      std::ostringstream markdown, values;
      bool               has_standard_header = false;
    };
  } // namespace HardCases
} // namespace NMM

#endif
