#include <nmm/base/exceptions.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <support/hard_cases/table.h>

namespace NMM
{
  namespace HardCases
  {
    void
    Worst::add(const Result &result)
    {
      ++n;
      smallest_fraction = std::min(smallest_fraction, result.smallest_fraction);
      if (!result.failure.empty())
      {
        ++n_failures;
        return;
      }
      condition      = std::max(condition, result.stiffness_condition);
      mass_condition = std::max(mass_condition, result.mass_condition);
      cg_iterations  = std::max(cg_iterations, result.cg_iterations);
      // a NaN must not be overlooked
      const auto worse = [](const double a, const double b) {
        return b <= a ? a : b;
      };
      displacement_error = worse(displacement_error, result.displacement_error);
      energy_error       = worse(energy_error, result.energy_error);
    }


    std::string
    Report::number(const double value)
    {
      char text[40];
      std::snprintf(text, sizeof(text), "%.3g", value);
      return text;
    }


    void
    Report::section(const std::string &title, const std::string &text)
    {
      markdown << "\n## " << title << "\n\n" << text << "\n";
      std::cout << "\n" << title << std::endl;
      has_standard_header = false;
    }


    void
    Report::header(const std::vector<std::string> &cells)
    {
      markdown << "\n";
      line(cells);
      markdown << "|";
      for (std::size_t i = 0; i < cells.size(); ++i)
        markdown << "---|";
      markdown << "\n";
    }


    void
    Report::line(const std::vector<std::string> &cells)
    {
      markdown << "|";
      std::cout << "  ";
      for (const std::string &cell : cells)
      {
        markdown << " " << cell << " |";
        std::cout << cell << "  ";
      }
      markdown << "\n";
      std::cout << std::endl;
    }


    void
    Report::row(const std::string  &name,
                const Stabilization stabilization,
                const Result       &uncut,
                const Worst        &worst,
                const Worst        &patch)
    {
      if (!has_standard_header)
        header({"case",
                "stabilization",
                "smallest share of a cell",
                "condition, largest (uncut)",
                "mass matrix, largest (uncut)",
                "CG + ML iterations (uncut)",
                "L2 u / uncut",
                "energy norm / uncut",
                "patch tests",
                "failures"});
      has_standard_header = true;
      line({name,
            to_string(stabilization),
            number(worst.smallest_fraction),
            number(worst.condition) + " (" + number(uncut.stiffness_condition) +
              ")",
            number(worst.mass_condition) + " (" + number(uncut.mass_condition) +
              ")",
            std::to_string(worst.cg_iterations) + " (" +
              std::to_string(uncut.cg_iterations) + ")",
            number(worst.displacement_error / uncut.displacement_error),
            number(worst.energy_error / uncut.energy_error),
            number(patch.displacement_error),
            std::to_string(worst.n_failures + patch.n_failures) + " of " +
              std::to_string(worst.n + patch.n)});
    }


    void
    Report::csv(const std::string &name, const Result &result)
    {
      values << name << ",\"" << result.variant << "\","
             << to_string(result.stabilization) << "," << result.n_unknowns
             << "," << result.smallest_fraction << ","
             << result.stiffness_condition << "," << result.mass_condition
             << "," << result.cg_iterations << "," << result.displacement_error
             << "," << result.energy_error << ","
             << (result.failure.empty() ? 0 : 1) << "\n";
    }


    void
    Report::write(const std::string &markdown_file,
                  const std::string &csv_file) const
    {
      const auto open = [](const std::string &name) {
        std::ofstream file(name);
        AssertThrow(file.good(),
                    InputError("cannot write the file",
                               name,
                               "give a folder that exists"));
        return file;
      };
      if (!markdown_file.empty())
        open(markdown_file)
          << "# Hard cases\n\n"
             "Condition number, solver iterations and error when the mesh is "
             "cut badly:\n\n"
             "    build/release/bin/nmm-hard-cases --markdown "
             "doc/hard-cases.md --csv tests/performance/hard-cases.csv\n\n"
             "The csv file has every single result; the tests of "
             "`tests/hard_cases` assert bounds on the same cases at a smaller "
             "size. Second order, plane strain, nu = 0.3 where nothing else is "
             "said. Condition numbers are those of the stiffness (or mass) "
             "matrix after diagonal scaling, by Lanczos' iteration; errors are "
             "relative to the exact solution. \"Smallest share\" is the area "
             "of the smallest element over that of its cell. Patch tests: "
             "largest relative L2 error of u for linear and quadratic exact "
             "solutions. \"Failures\" are solutions that the program refuses "
             "as singular or inaccurate.\n"
          << markdown.str();
      if (!csv_file.empty())
        open(csv_file)
          << "case,variant,stabilization,unknowns,smallest_share,"
             "stiffness_condition,mass_condition,cg_iterations,rel_"
             "L2_u,rel_energy,failed\n"
          << values.str();
    }
  } // namespace HardCases
} // namespace NMM
