#include "figure.h"
#include "report.h"
#include <algorithm>
#include <cmath>
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


      /// The slowest manifold run of each kind on one rank.
      std::vector<Row>
      slowest(const std::vector<Row> &rows)
      {
        std::vector<Row> result;
        for (const Row &row : rows)
        {
          if (row.method.compare(0, 8, "manifold") != 0 || row.ranks != 1. ||
              row.degree != 2. || std::isnan(row.unknowns))
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


      void
      write_costliest(std::ostream &out, const std::vector<Row> &rows)
      {
        struct Place
        {
          double      seconds, share;
          std::string where;
        };
        std::vector<Place> places;
        for (const Row &row : rows)
          for (const Stage &stage : stages)
            if (row.*stage.seconds > 0.)
              places.push_back(
                {row.*stage.seconds,
                 row.*stage.seconds / row.total,
                 std::string(stage.name) + " in " + describe(row)});
        std::sort(places.begin(),
                  places.end(),
                  [](const Place &a, const Place &b) {
                    return a.seconds > b.seconds;
                  });
        constexpr unsigned int n = 5;
        out << "The " << n << " costliest places: ";
        for (unsigned int i = 0; i < std::min<std::size_t>(n, places.size());
             ++i)
          out << (i == 0 ? "" : "; ") << places[i].where << ", "
              << text_of(places[i].seconds) << " s or "
              << text_of(100. * places[i].share, 2) << " %";
        out << ".\n\n";
      }


      /// Stages that every rank does for the whole mesh, and those of one rank.
      double
      replicated(const Row &row)
      {
        return row.geometry + row.mesh + row.cutting + row.covers;
      }


      double
      serial(const Row &row)
      {
        return replicated(row) + (std::isnan(row.analysis) ? 0. : row.analysis);
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
             "rank. Making the "
             "preconditioner counts as factorization, iterations as solution. "
             "Of the Hertz disk, contact search and terms are "
             "what one of them takes at the solution times their number, "
             "factorization is "
             "what is left and includes substitutions; of the slope, solution "
             "is the equilibrium before, and making the mesh, cutting and "
             "quadrature count as covers; of "
             "the paper's incremental steps only the sum is known (rest).\n\n"
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
      write_costliest(out, chosen);
      draw_stacks(image_directory + "/performance-stages.png",
                  "Shares of the stages, slowest runs",
                  names,
                  stacks);
    }


    void
    write_scaling(std::ostream &out, const std::vector<Row> &rows)
    {
      const auto members = select(rows, "ring on ranks");
      out << "## Ranks\n\n"
             "Cells are shared out among ranks: quadrature, assembly, "
             "factorization and solution are of a rank's own "
             "elements and unknowns; the analysis before a factorization, an "
             "ordering and symbolic factorization, is the first rank's. The "
             "mesh, the manifold elements and the "
             "numbers of their covers "
             "are the same on every rank, and are made by each: that takes as "
             "long on many ranks "
             "as on one, and its memory is there as many times as there are "
             "ranks.\n\n"
             "| | ranks | total [s] | made by every rank [s] | quadrature | "
             "sparsity | assembly | ordering | "
             "factorization | solution | peak MB, all ranks |\n"
             "|---|---|---|---|---|---|---|---|---|---|---|\n";
      for (const Row &row : members)
        out << "| " << row.solver << ", " << text_of(row.unknowns)
            << " unknowns | " << text_of(row.ranks) << " | "
            << text_of(row.total) << " | " << text_of(replicated(row)) << " | "
            << text_of(row.quadrature) << " | " << text_of(row.sparsity)
            << " | " << text_of(row.assembly) << " | " << text_of(row.analysis)
            << " | " << text_of(row.factorization) << " | "
            << text_of(row.solution) << " | " << text_of(row.own_peak_memory)
            << " |\n";
      out << '\n';
      for (const Row &row : members)
        if (row.ranks == 1.)
        {
          const double s = serial(row);
          out << "With " << row.solver
              << ", if what is shared out were shared out perfectly, n ranks "
                 "would be "
                 "1 / ("
              << text_of(s / row.total, 2) << " + "
              << text_of(1. - s / row.total, 2) << " / n) times as fast: ";
          std::string separator;
          for (const double n : {2., 4., 8., 16.})
          {
            out << separator
                << text_of(row.total / (s + (row.total - s) / n), 2) << " on "
                << n;
            separator = ", ";
          }
          out << ", never more than " << text_of(row.total / s, 2) << ".\n\n";
        }
    }
  } // namespace Bench
} // namespace NMM
