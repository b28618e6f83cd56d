#include "figure.h"
#include "report.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      struct Stage
      {
        const char *name;
        double Row::*seconds;
      };

      const Stage stages[] = {{"geometry", &Row::geometry},
                              {"mesh", &Row::mesh},
                              {"cutting", &Row::cutting},
                              {"covers", &Row::covers},
                              {"quadrature", &Row::quadrature},
                              {"sparsity", &Row::sparsity},
                              {"assembly", &Row::assembly},
                              {"analysis", &Row::analysis},
                              {"factorization", &Row::factorization},
                              {"solution", &Row::solution},
                              {"contact search", &Row::search},
                              {"contact terms", &Row::contact},
                              {"output", &Row::output}};


      double
      rest(const Row &row)
      {
        double sum = 0.;
        for (const Stage &stage : stages)
          sum += std::isnan(row.*stage.seconds) ? 0. : row.*stage.seconds;
        return std::max(0., row.total - sum);
      }


      std::string
      describe(const Row &row)
      {
        std::string text = row.name;
        for (const std::string &part :
             {row.kinematics, row.enforcement, row.solver})
          if (!part.empty() && part != "MUMPS")
            text += ", " + part;
        return text + " (" + text_of(row.unknowns) + ")";
      }


      /// The slowest manifold run of each kind of these cases on one rank, if its stages are known.
      std::vector<Row>
      slowest(const std::vector<Row> &rows)
      {
        const std::set<std::string> names = {"ring",
                                             "cantilever dead",
                                             "Hertz disk",
                                             "cracked plate",
                                             "slope",
                                             "output"};
        std::vector<Row>            result;
        for (const Row &row : rows)
        {
          if (names.count(row.name) == 0 ||
              row.method.compare(0, 8, "manifold") != 0 || row.ranks != 1. ||
              row.degree != 2. || std::isnan(row.factorization))
            continue;
          auto same =
            std::find_if(result.begin(), result.end(), [&](const Row &other) {
              return other.name == row.name &&
                     other.kinematics == row.kinematics &&
                     other.enforcement == row.enforcement &&
                     other.solver == row.solver;
            });
          if (same == result.end())
            result.push_back(row);
          else if (row.total > same->total)
            *same = row;
        }
        return result;
      }
    } // namespace


    void
    write_stages(std::ostream           &out,
                 const std::vector<Row> &rows,
                 const std::string      &image_directory)
    {
      const std::vector<Row>   chosen = slowest(rows);
      std::vector<std::string> names;
      for (const Stage &stage : stages)
        names.push_back(stage.name);
      names.push_back("rest");
      std::vector<Stack> stacks;
      out << "## Where the time goes\n\n"
             "Seconds of the slowest run of each kind, second order, on one "
             "rank. Making the preconditioner counts as factorization, "
             "iterations as solution. Of the Hertz disk, contact search and "
             "terms are one of them times their number, factorization is what "
             "is left; of the slope, solution is the equilibrium before, and "
             "covers contain mesh, cutting and quadrature.\n\n"
             "![Shares of the stages](images/performance-stages.png)\n\n| "
             "(unknowns) | total";
      for (const std::string &name : names)
        out << " | " << name;
      out << " |\n|---|---";
      for (unsigned int i = 0; i < names.size(); ++i)
        out << "|---";
      out << "|\n";
      for (const Row &row : chosen)
      {
        stacks.push_back({describe(row), {}});
        out << "| " << describe(row) << " | " << text_of(row.total);
        for (const Stage &stage : stages)
        {
          out << " | " << text_of(row.*stage.seconds);
          stacks.back().parts.push_back(row.*stage.seconds);
        }
        out << " | " << text_of(rest(row)) << " |\n";
        stacks.back().parts.push_back(rest(row));
      }
      out << '\n';
      draw_stacks(image_directory + "/performance-stages.png",
                  "Shares of the stages, slowest runs",
                  names,
                  stacks);
    }
  } // namespace Bench
} // namespace NMM
