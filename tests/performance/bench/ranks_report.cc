#include "figure.h"
#include "report.h"
#include <algorithm>
#include <cmath>

// Rings on ranks.
namespace NMM
{
  namespace Bench
  {
    namespace
    {
      double
      solver_time(const Row &row)
      {
        return (std::isnan(row.analysis) ? 0. : row.analysis) +
               row.factorization + row.solution;
      }


      void
      write_table(std::ostream &out, const std::vector<Row> &rows)
      {
        out << "| | ranks | unknowns | total [s] | mesh, cutting, covers [s] | "
               "assembly and sparsity [s] | solver [s] | MB |\n"
               "|---|---|---|---|---|---|---|---|\n";
        for (const Row &row : rows)
        {
          out << "| " << row.solver;
          for (const double number : {row.ranks,
                                      row.unknowns,
                                      row.total,
                                      row.mesh + row.cutting + row.covers,
                                      row.assembly + row.sparsity,
                                      solver_time(row),
                                      row.rank_memory})
            out << " | " << text_of(number);
          out << " |\n";
        }
        out << '\n';
      }


      std::vector<Curve>
      make_curves(const std::vector<Row> &rows)
      {
        std::vector<Curve> curves;
        for (const Row &row : rows)
        {
          auto curve =
            std::find_if(curves.begin(), curves.end(), [&](const Curve &c) {
              return c.title == row.solver;
            });
          if (curve == curves.end())
            curve = curves.insert(curve, {row.solver, {}});
          curve->points.emplace_back(row.ranks, row.total);
        }
        return curves;
      }


      /// The speed on many ranks if what is shared out were shared out perfectly.
      void
      write_bounds(std::ostream &out, const std::vector<Row> &rows)
      {
        for (const Row &row : rows)
          if (row.ranks == 1.)
          {
            const double serial =
              row.geometry + row.mesh + row.cutting + row.covers +
              (std::isnan(row.analysis) ? 0. : row.analysis);
            out << "- " << row.solver
                << ": if what is shared out were shared out perfectly, n ranks "
                   "would be 1 / ("
                << text_of(serial / row.total, 2) << " + "
                << text_of(1. - serial / row.total, 2)
                << " / n) times as fast, never more than "
                << text_of(row.total / serial, 2) << " times.\n";
          }
        out << '\n';
      }
    } // namespace


    void
    write_ranks(std::ostream           &out,
                const std::vector<Row> &rows,
                const std::string      &image_directory)
    {
      const std::vector<Row> strong = select(rows, "strong scaling"),
                             weak   = select(rows, "weak scaling");
      if (strong.empty() || weak.empty())
        return;
      out
        << "## Ranks\n\n"
           "Ranks share out quadrature, assembly, factorization and solution; "
           "every rank makes mesh, elements and covers for itself, and the "
           "ordering before a factorization is the first rank's. Memory is "
           "that of mesh, elements, covers and rules, of the rank that has "
           "most. First the same ring on more ranks, then as many unknowns "
           "for each rank.\n\n";
      std::vector<Row> all = strong;
      all.insert(all.end(), weak.begin(), weak.end());
      write_table(out, all);
      write_bounds(out, strong);

      Panel strong_panel, weak_panel;
      strong_panel.has_numbers = weak_panel.has_numbers = true;
      strong_panel.x_label = "ranks, the same ring";
      strong_panel.curves  = make_curves(strong);
      weak_panel.x_label   = "ranks, as many unknowns for each";
      weak_panel.curves    = make_curves(weak);
      draw_curves(image_directory + "/performance-ranks.png",
                  "Rings on ranks",
                  "seconds",
                  {strong_panel, weak_panel});
      out << "![Rings on ranks](images/performance-ranks.png)\n\n";
    }
  } // namespace Bench
} // namespace NMM
