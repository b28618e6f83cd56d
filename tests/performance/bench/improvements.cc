#include "improvements.h"

#include "report.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

// What became faster: tables of measurements before and now.
namespace NMM
{
  namespace Bench
  {
    namespace
    {
      std::vector<std::string>
      cells_of(const std::string &line)
      {
        std::vector<std::string> cells;
        std::istringstream       in(line);
        for (std::string cell; std::getline(in, cell, ',');)
          cells.push_back(cell);
        return cells;
      }


      /// [us] for each element that joints cut; 0 if the table does not say.
      double
      per_cut_element(const std::vector<Row> &rows, double Row::*stage)
      {
        const Row *whole = nullptr, *cut = nullptr;
        for (const Row &row : rows)
          if (row.name == "cut mesh 0 joints" && row.size == "full" &&
              row.*stage > 0.)
            whole = &row;
          else if (row.name == "cut mesh 1000 joints" && row.*stage > 0.)
            cut = &row;
        return whole == nullptr || cut == nullptr
                 ? none
                 : 1e6 * (cut->*stage - whole->*stage) /
                     (cut->cut_elements - whole->cut_elements);
      }


      void
      write_line(std::ostream      &out,
                 const std::string &where,
                 const std::string &what,
                 const double       was,
                 const double       is)
      {
        // what is the same but for the scatter of times says nothing
        constexpr double scatter = 1.1;
        if (was > 0. && is > 0. && (was > scatter * is || is > scatter * was))
          out << "| " << where << " | " << what << " | " << text_of(was)
              << " | " << text_of(is) << " | " << text_of(was / is, 2)
              << " |\n";
      }


      void
      write_rows(std::ostream           &out,
                 const std::vector<Row> &before,
                 const std::vector<Row> &rows)
      {
        const std::pair<const char *, double Row::*> columns[] = {
          {"cutting [s]", &Row::cutting},
          {"covers [s]", &Row::covers},
          {"quadrature [s]", &Row::quadrature},
          {"contact terms [s]", &Row::contact},
          {"factorization or preconditioner [s]", &Row::factorization},
          {"solution [s]", &Row::solution},
          {"iterations", &Row::iterations},
          {"output [s]", &Row::output},
          {"together [s]", &Row::total},
          {"kept [MB]", &Row::live_memory},
          {"peak of the process above what it was [MB]",
           &Row::own_peak_memory}};
        for (const Row &old : before)
          for (const Row &row : rows)
            if (row.name == old.name && row.method == old.method &&
                row.kinematics == old.kinematics && row.ranks == old.ranks &&
                row.solver == old.solver && row.elements == old.elements &&
                (row.steps == old.steps ||
                 (std::isnan(row.steps) && std::isnan(old.steps))))
            {
              std::string where = row.name;
              for (const std::string &part : {row.kinematics, row.solver})
                where += part.empty() ? "" : ", " + part;
              where += ", " + text_of(row.elements) + " elements";
              for (const auto &[what, column] : columns)
                write_line(out, where, what, old.*column, row.*column);
            }
      }


      void
      write_heaps(std::ostream               &out,
                  const std::vector<HeapRow> &before,
                  const std::vector<HeapRow> &heaps)
      {
        const auto number = [](const HeapRow &row, const std::string &name) {
          const auto cell = row.find(name);
          return cell == row.end() || cell->second.empty()
                   ? none
                   : std::stod(cell->second);
        };
        for (const HeapRow &old : before)
          for (const HeapRow &row : heaps)
          {
            bool is_same = old.at("phase") == row.at("phase");
            for (const char *name : {"blocks",
                                     "elements_per_block",
                                     "end_s",
                                     "sleep_speed_m_per_s"})
            {
              // a table without the column is of when nothing slept
              const double was = number(old, name), is = number(row, name);
              is_same = is_same && (std::isnan(was) ? 0. : was) ==
                                     (std::isnan(is) ? 0. : is);
            }
            if (!is_same)
              continue;
            const std::string where =
              "heap of " + text_of(number(row, "blocks")) + " blocks of " +
              text_of(number(row, "elements_per_block")) +
              (number(row, "elements_per_block") == 1. ? " element, "
                                                       : " elements, ") +
              row.at("phase") + " until " + text_of(number(row, "end_s")) +
              " s";
            const std::pair<const char *, const char *> columns[] = {
              {"contact", "contact_us"},
              {"elements", "elements_us"},
              {"factorization", "factorization_us"},
              {"together", "us_per_block_and_step"}};
            for (const auto &[what, column] : columns)
              write_line(out,
                         where,
                         std::string(what) + ", per block and step [us]",
                         number(old, column),
                         number(row, column));
          }
      }
    } // namespace


    std::vector<HeapRow>
    read_heaps(const std::string &file_name)
    {
      std::ifstream            in(file_name);
      std::vector<HeapRow>     rows;
      std::vector<std::string> names;
      for (std::string line; std::getline(in, line);)
      {
        if (line.empty() || line[0] == '#')
          continue;
        const std::vector<std::string> cells = cells_of(line);
        if (names.empty())
        {
          names = cells;
          continue;
        }
        rows.emplace_back();
        for (unsigned int i = 0; i < std::min(cells.size(), names.size()); ++i)
          rows.back()[names[i]] = cells[i];
      }
      return rows;
    }


    void
    write_improvements(std::ostream           &out,
                       const Earlier          &earlier,
                       const std::vector<Row> &rows)
    {
      std::ostringstream table;
      write_rows(table, earlier.rows, rows);
      write_heaps(table, earlier.heaps_before, earlier.heaps);
      if (table.str().empty())
        return;
      const auto costs = [&](double Row::*stage) {
        return text_of(per_cut_element(earlier.rows, stage), 2) + " and " +
               text_of(per_cut_element(rows, stage), 2) + " us";
      };
      out
        << "## What became faster\n\n"
           "- Cutting: every cell near a curve went through the exact "
           "arrangement; now cells near straight edges are divided by "
           "themselves, with the exact signs of a few determinants, and only "
           "arcs and what lies wholly inside a cell is arranged (for each "
           "element that joints cut, before and now "
        << costs(&Row::cutting)
        << ").\n"
           "- Rules of cut elements: a well-shaped triangle takes the rule of "
           "triangles, a well-shaped quadrilateral two of them, instead of "
           "fitting moments, with fewer points ("
        << costs(&Row::quadrature)
        << ").\n"
           "- Covers: constraints of aggregated covers evaluate the weight "
           "functions once instead of once per component ("
        << costs(&Row::covers)
        << ").\n"
           "- Field files: numbers are stored, without zlib's search for what "
           "repeats.\n"
           "- Conjugate gradients of second order: smoothed aggregation "
           "of the whole matrix read it ten times an iteration; now "
           "displacements of first order on the same covers are the coarse "
           "space, cut elements are solved exactly, and the smoother keeps the "
           "matrix in single precision.\n"
           "- Contact and Newton's method: block rows, forces and contact of "
           "groups that are not being solved for are left alone, and systems "
           "of many small groups go to KLU. Steps of heaps are not quite the "
           "same "
           "before and now, since rounding decides which one is cut.\n\n"
           "Before: `tests/performance/performance-before.csv` and "
           "`performance-before-heap.csv`, written by `nmm-bench` and "
           "`nmm-heap` at earlier versions on this machine. What differs by "
           "less "
           "than a tenth is left out.\n\n"
        << "| | | before | now | ratio |\n|---|---|---|---|---|\n"
        << table.str()
        << "\nCallgrind cannot count the instructions of cutting: it does not "
           "know the "
           "rounding modes that CGAL's interval arithmetic needs, and "
           "topology comes out wrong under it.\n\n";
    }
  } // namespace Bench
} // namespace NMM
