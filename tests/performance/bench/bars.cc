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
      /// A number that must not exceed another one (or not fall below it).
      struct Bar
      {
        std::string what;
        double      measured = none, limit = none;
        bool        is_least = false;
        std::string detail;
        /// Why, if it is missed.
        std::string reason = {};
      };


      std::string
      verdict(const Bar &bar)
      {
        if (std::isnan(bar.measured))
          return "not measured";
        const bool holds =
          bar.is_least ? bar.measured >= bar.limit : bar.measured <= bar.limit;
        return holds ? "pass" : "**miss**";
      }


      /// The first row of a case with a method that begins so; an empty one if there is none.
      Row
      find(const std::vector<Row> &rows,
           const std::string      &name,
           const std::string      &method)
      {
        for (const Row &row : rows)
          if (row.name.compare(0, name.size(), name) == 0 &&
              row.method.compare(0, method.size(), method) == 0)
            return row;
        return Row();
      }


      std::string
      cost_of_cut_elements(const Row &own, const Row &whole, const Row &theirs)
      {
        const double n         = own.cut_elements - whole.cut_elements;
        const auto   per_piece = [&](double Row::*stage) {
          return text_of(1e6 * (own.*stage - whole.*stage) / n, 2);
        };
        return "without joints it would hold (" +
               text_of(whole.total / theirs.total) + "); each of the " +
               text_of(n) + " cut elements takes " + per_piece(&Row::total) +
               " us, of which cutting " + per_piece(&Row::cutting) +
               ", covers " + per_piece(&Row::covers) + " and quadrature " +
               per_piece(&Row::quadrature) + ", while deal.II spends " +
               text_of(1e6 * theirs.total / theirs.elements, 2) +
               " us on a cell. Covers are those with the constraints of small "
               "ones; quadrature is finding the rules and asking for each once";
      }


      std::string
      bytes_of_cut_elements(const Row &own, const Row &whole, const Row &theirs)
      {
        const auto bytes = [](const double memory, const double n) {
          constexpr double megabyte = 1024. * 1024.;
          return text_of(megabyte * memory / n) + " bytes";
        };
        return "a whole element keeps " +
               bytes(whole.live_memory, whole.elements) +
               ", a cut one, with its corners, its links and the constraints "
               "of its covers, " +
               bytes(own.live_memory - whole.live_memory,
                     own.cut_elements - whole.cut_elements) +
               " more; deal.II keeps " +
               bytes(theirs.live_memory, theirs.elements) + " for a cell";
      }


      void
      add_cutting(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        const auto with_joints = select(rows, [](const Row &row) {
          return row.name.compare(0, 8, "cut mesh") == 0 &&
                 row.name != "cut mesh 0 joints";
        });
        const auto without     = select(rows, "cut mesh 0 joints");
        const Row  own         = find(with_joints, "cut mesh", "cutting");
        const Row  theirs      = find(with_joints, "cut mesh", "Triangulation");
        const Row  whole       = find(without, "cut mesh", "cutting");
        const Row  scalar      = find(rows, "scalar cut mesh", "cutting"),
                  their_scalar = find(rows, "scalar cut mesh", "Triangulation");
        const std::string mesh =
          text_of(theirs.elements) + " cells, " +
          own.name.substr(std::min<std::size_t>(9, own.name.size()));
        std::ostringstream time, memory, per_cell;
        time << "cutting " << text_of(own.cutting) << " s, covers "
             << text_of(own.covers) << " s, quadrature "
             << text_of(own.quadrature) << " s against " << text_of(theirs.mesh)
             << " s and " << text_of(theirs.covers) << " s; "
             << text_of(own.cut_elements) << " of " << text_of(own.elements)
             << " elements cut; for a scalar "
             << text_of(scalar.total / their_scalar.total);
        bars.push_back(
          {"1: cutting, covers and quadrature over deal.II's "
           "Triangulation and DoFHandler, time, " +
             mesh,
           own.total / theirs.total,
           1.,
           false,
           time.str(),
           cost_of_cut_elements(own, whole, theirs)});
        memory << "kept: " << text_of(own.live_memory) << " MB against "
               << text_of(theirs.live_memory) << " MB; at the peak "
               << text_of(own.own_peak_memory) << " and "
               << text_of(theirs.own_peak_memory) << " MB";
        bars.push_back({"1: the same, memory",
                        own.live_memory / theirs.live_memory,
                        1.,
                        false,
                        memory.str(),
                        bytes_of_cut_elements(own, whole, theirs)});
        per_cell << "the mesh without joints, " << text_of(whole.elements)
                 << " elements of which " << text_of(whole.cut_elements)
                 << " at the boundary, in " << text_of(whole.total) << " s";
        bars.push_back({"1: per uncut cell [us]",
                        1e6 * whole.total / whole.elements,
                        2.,
                        false,
                        per_cell.str()});
      }


      void
      add_assembly(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        const auto members     = select(rows, "assembly");
        const Row  own         = find(members, "", "manifold");
        const Row  theirs      = find(members, "", "fitted");
        const auto per_element = [](const double seconds, const Row &row) {
          return 1e6 * seconds / row.elements;
        };
        std::ostringstream detail;
        detail << text_of(per_element(own.assembly, own)) << " us against "
               << text_of(per_element(theirs.assembly, theirs)) << " us at "
               << text_of(own.unknowns) << " and " << text_of(theirs.unknowns)
               << " unknowns; with the sparsity pattern "
               << text_of(per_element(own.assembly + own.sparsity, own))
               << " us against "
               << text_of(
                    per_element(theirs.assembly + theirs.sparsity, theirs))
               << " us";
        bars.push_back({"2: assembly per element over deal.II's FEValues loop",
                        per_element(own.assembly, own) /
                          per_element(theirs.assembly, theirs),
                        1.2,
                        false,
                        detail.str()});
      }


      void
      add_large_rings(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        const Row one = find(rows, "ring of 91000", "");
        bars.push_back({"3: quarter ring, curves to displacements [s]",
                        one.total,
                        0.8,
                        false,
                        text_of(one.unknowns) + " unknowns, L2 errors in the "
                                                "table of the ring"});
        const auto growing = select(rows, "ring that grows");
        if (growing.size() < 2)
          return;
        const Row         &small = growing[0], &large = growing[1];
        std::ostringstream iterations, time;
        iterations << text_of(large.iterations) << " at "
                   << text_of(large.unknowns) << " unknowns, "
                   << text_of(small.iterations) << " at "
                   << text_of(small.unknowns);
        bars.push_back({"3: CG + ML iterations, growth",
                        large.iterations / small.iterations,
                        1.5,
                        false,
                        iterations.str()});
        time << text_of(large.total) << " s against " << text_of(small.total)
             << " s";
        const auto per_unknown = [](const Row &row) {
          return text_of(1e9 * row.solution / (row.iterations * row.unknowns));
        };
        // ten times the unknowns may take fourteen times as long
        constexpr double allowed = 1.4;
        bars.push_back({"3: time, growth",
                        large.total / small.total,
                        allowed * large.unknowns / small.unknowns,
                        false,
                        time.str(),
                        "an iteration takes " + per_unknown(large) +
                          " ns per unknown instead of " + per_unknown(small) +
                          ", and there are more of them"});
      }


      std::string
      reason_of_ranks(const Row &one, const Row &two)
      {
        const auto every_rank = [](const Row &row) {
          return row.geometry + row.mesh + row.cutting + row.covers;
        };
        const auto serial = [&](const Row &row) {
          return every_rank(row) +
                 (std::isnan(row.analysis) ? 0. : row.analysis);
        };
        const auto pair = [&](double Row::*stage) {
          return text_of(one.*stage) + " and " + text_of(two.*stage) + " s";
        };
        return "on one rank and two, what every rank makes for itself takes " +
               text_of(every_rank(one)) + " and " + text_of(every_rank(two)) +
               " s, assembly " + pair(&Row::assembly) +
               (one.analysis > 0.
                  ? ", ordering and symbolic factorization, which is of one "
                    "rank, " +
                      pair(&Row::analysis)
                  : std::string()) +
               ", factorization " + pair(&Row::factorization) + ", solution " +
               pair(&Row::solution) +
               "; if all that is not of every rank or of one were halved, two "
               "ranks would be " +
               text_of(one.total /
                         (serial(one) + 0.5 * (one.total - serial(one))),
                       2) +
               " times as fast";
      }


      double
      largest_difference(const std::string &a, const std::string &b)
      {
        std::istringstream first(a), second(b);
        double             largest = 0., size = 0.;
        for (double x, y; first >> x && second >> y;)
        {
          largest = std::max(largest, std::abs(x - y));
          size    = std::max(size, std::abs(x));
        }
        return size > 0. ? largest / size : none;
      }


      void
      add_ranks(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        const auto members = select(rows, "ring on ranks");
        for (const Row &two : members)
          for (const Row &one : members)
            if (one.ranks == 1. && two.ranks == 2. && one.solver == two.solver)
            {
              std::ostringstream detail;
              detail << text_of(two.unknowns)
                     << " unknowns: " << text_of(one.total)
                     << " s on one rank, " << text_of(two.total) << " s on two";
              bars.push_back({"4: two ranks, times as fast, " + one.solver,
                              one.total / two.total,
                              1.6,
                              true,
                              detail.str(),
                              reason_of_ranks(one, two)});
              bars.push_back(
                {"4: difference of the displacements, " + one.solver,
                 largest_difference(one.probes, two.probes),
                 1e-10,
                 false,
                 "largest of nine points over the largest displacement"});
            }
      }


      void
      add_weak_form(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        const Row library = find(rows, "weak form", "assemble_at_rest"),
                  values  = find(rows, "weak form", "ElementValues; matrix"),
                  deal_ii = find(rows, "weak form", "ElementValues; deal.II");
        const auto with_pattern = [](const Row &row) {
          return row.sparsity + row.assembly;
        };
        bars.push_back(
          {"6: assembly with ElementValues over the library's own, " +
             text_of(library.elements) + " elements",
           values.assembly / library.assembly,
           1.3,
           false,
           text_of(values.assembly) + " s against " +
             text_of(library.assembly) + " s, " +
             text_of(library.cut_elements) +
             " elements cut; into deal.II's matrix " +
             text_of(deal_ii.assembly / library.assembly) +
             ", with the sparsity pattern " +
             text_of(with_pattern(deal_ii) / with_pattern(library)),
           "the library integrates products of reference gradients, whole "
           "elements share these, and a user's loop goes over points"});
      }


      void
      add_output(const std::vector<Row> &rows, std::vector<Bar> &bars)
      {
        for (const Row &row : select(rows, "output"))
        {
          std::ostringstream detail;
          detail << text_of(row.output) << " s of " << text_of(row.total)
                 << " s; " << text_of(row.unknowns) << " unknowns, "
                 << text_of(row.steps) << " steps with "
                 << text_of(row.iterations) << " iterations";
          bars.push_back(
            {"5: share of the output, a file per 20 steps, " + row.kinematics,
             row.output / row.total,
             0.1,
             false,
             detail.str(),
             "a step is one substitution here, " +
               text_of(1e3 * row.solution / row.steps, 2) +
               " ms; a file, with its recovered stresses, takes as long as " +
               text_of(20. * row.output / row.solution, 2) + " steps"});
        }
      }
    } // namespace


    void
    write_bars(std::ostream &out, const std::vector<Row> &rows)
    {
      std::vector<Bar> bars;
      add_cutting(rows, bars);
      add_assembly(rows, bars);
      add_large_rings(rows, bars);
      add_ranks(rows, bars);
      add_output(rows, bars);
      add_weak_form(rows, bars);
      const bool is_full = rows.front().size == "full";
      out << "## Requirements\n\n";
      if (!is_full)
        out << "These runs are smaller than what is asked for: `./setup.sh "
               "bench full` measures the sizes meant.\n\n";
      out << "| | measured | at most (least) | | how "
             "|\n|---|---|---|---|---|\n";
      for (const Bar &bar : bars)
        out << "| " << bar.what << " | "
            << (std::abs(bar.measured) < 1e-3 ? error_text(bar.measured)
                                              : text_of(bar.measured))
            << " | "
            << (bar.limit < 1e-3 ? error_text(bar.limit) : text_of(bar.limit))
            << (bar.is_least ? " (least)" : "") << " | " << verdict(bar)
            << " | " << bar.detail << " |\n";
      out << '\n';
      for (const Bar &bar : bars)
        if (verdict(bar) == "**miss**" && !bar.reason.empty())
          out << "- Missed: " << bar.what << ". Why: " << bar.reason << ".\n";
      out << '\n';
    }
  } // namespace Bench
} // namespace NMM
