#include "report.h"

#include "figure.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>
#include <sstream>
#include <tuple>

namespace NMM
{
  namespace Bench
  {
    std::vector<Row>
    select(const std::vector<Row> &rows, const Filter &filter)
    {
      std::vector<Row> result;
      std::copy_if(rows.begin(),
                   rows.end(),
                   std::back_inserter(result),
                   filter);
      return result;
    }


    std::vector<Row>
    select(const std::vector<Row> &rows, const std::string &name)
    {
      return select(rows, [&](const Row &row) { return row.name == name; });
    }


    std::string
    text_of(const double number, const unsigned int digits)
    {
      if (std::isnan(number))
        return "-";
      std::ostringstream text;
      if (std::abs(number) < 10000.)
      {
        const bool is_whole =
          number == std::round(number) || std::abs(number) >= 1000.;
        text << std::setprecision(is_whole ? 0 : digits);
        if (is_whole)
          text << std::fixed;
        text << number;
        return text.str();
      }
      text << std::fixed << std::setprecision(0) << number;
      std::string result = text.str();
      for (int i = static_cast<int>(result.size()) - 3; i > 0; i -= 3)
        result.insert(i, ",");
      return result;
    }


    std::string
    error_text(const double error)
    {
      if (std::isnan(error))
        return "-";
      std::ostringstream text;
      text << std::scientific << std::setprecision(1) << error;
      return text.str();
    }


    namespace
    {
      /// What tells the rows of a case apart, beside their size.
      std::vector<std::string>
      features(const Row &row)
      {
        return {row.method,
                std::isnan(row.degree) ? "" : "p = " + text_of(row.degree),
                row.kinematics,
                row.enforcement,
                row.stabilization,
                row.solver,
                row.ranks == 1. ? "one rank" : text_of(row.ranks) + " ranks"};
      }


      /// Rows of a case that differ in size only, by what the rows of the case do not have in
      /// common; in the order of the first row.
      std::vector<std::pair<std::string, std::vector<Row>>>
      make_series(const std::vector<Row> &rows)
      {
        std::vector<bool> differs(features(Row()).size(), false);
        for (const Row &row : rows)
          for (unsigned int i = 0; i < differs.size(); ++i)
            if (features(row)[i] != features(rows.front())[i] &&
                !features(row)[i].empty())
              differs[i] = true;
        std::vector<std::pair<std::string, std::vector<Row>>> series;
        for (const Row &row : rows)
        {
          std::string title;
          for (unsigned int i = 0; i < differs.size(); ++i)
            if (differs[i] && !features(row)[i].empty())
              title += (title.empty() ? "" : ", ") + features(row)[i];
          if (title.empty())
            title = row.method;
          auto same =
            std::find_if(series.begin(), series.end(), [&](const auto &s) {
              return s.first == title;
            });
          if (same == series.end())
            same = series.insert(same, {title, {}});
          same->second.push_back(row);
        }
        return series;
      }


      /// A column of a table: what stands above it, and its cell of a row.
      struct Column
      {
        std::string                             title;
        std::function<std::string(const Row &)> cell;
      };


      /// The row of @p rows that differs from @p row in its case or solver only; an empty one if
      /// there is none.
      Row
      partner(const std::vector<Row> &rows, const Row &row)
      {
        const auto key = [](const Row &r) {
          return std::make_tuple(r.method,
                                 r.kinematics,
                                 r.enforcement,
                                 r.stabilization,
                                 text_of(r.degree),
                                 text_of(r.unknowns),
                                 text_of(r.steps));
        };
        for (const Row &other : rows)
          if (key(other) == key(row))
            return other;
        return Row();
      }


      /// A table of @p rows, and beside each one what differs in its partner among @p others.
      /// Columns without any value are left out.
      void
      write_series(std::ostream           &out,
                   const std::vector<Row> &rows,
                   const std::vector<Row> &others,
                   const std::string      &name_of_others)
      {
        std::vector<Column> columns;
        const auto          add = [&](const std::string &title,
                             double Row::*member,
                             std::string (*text)(double)) {
          columns.push_back(
            {title, [=](const Row &row) { return text(row.*member); }});
        };
        const auto add_other = [&](const std::string &title,
                                   double Row::*member,
                                   std::string (*text)(double)) {
          columns.push_back(
            {title + ", " + name_of_others, [=, &others](const Row &row) {
               return text(partner(others, row).*member);
             }});
        };
        const auto number = [](const double x) { return text_of(x); };
        const auto error  = [](const double x) { return error_text(x); };
        const Row &any    = rows.front();
        add("unknowns", &Row::unknowns, number);
        add("steps", &Row::steps, number);
        add("iterations", &Row::iterations, number);
        add("seconds", &Row::total, number);
        add("peak MB", &Row::own_peak_memory, number);
        add("error (" + any.error_kind + ")", &Row::error, error);
        add("error (" + any.second_error_kind + ")", &Row::second_error, error);
        if (!others.empty())
        {
          const bool is_same_case = others.front().name == any.name;
          if (is_same_case)
            add_other("iterations", &Row::iterations, number);
          add_other("seconds", &Row::total, number);
          if (is_same_case)
            add_other("peak MB", &Row::own_peak_memory, number);
          else
            add_other("error", &Row::error, error);
        }
        const auto is_empty = [&](const Column &column) {
          return std::all_of(rows.begin(), rows.end(), [&](const Row &row) {
            return column.cell(row) == "-";
          });
        };
        columns.erase(std::remove_if(columns.begin(), columns.end(), is_empty),
                      columns.end());

        out << '|';
        for (const Column &column : columns)
          out << " | " << column.title;
        out << " |\n|---";
        for (unsigned int i = 0; i < columns.size(); ++i)
          out << "|---";
        out << "|\n";
        for (const auto &[title, members] : make_series(rows))
          for (const Row &row : members)
          {
            out << "| " << title;
            for (const Column &column : columns)
              out << " | " << column.cell(row);
            out << " |\n";
          }
        out << '\n';
      }


      void
      draw_case(const std::vector<Row> &rows,
                const std::string      &title,
                const std::string      &file_name)
      {
        Panel seconds, unknowns, memory;
        seconds.x_label  = "seconds from the curves to the answer";
        unknowns.x_label = "unknowns";
        memory.x_label   = "memory that the run adds to the process [MB]";
        for (const auto &[name, members] : make_series(rows))
        {
          for (Panel *panel : {&seconds, &unknowns, &memory})
            panel->curves.push_back({name, {}});
          for (const Row &row : members)
          {
            seconds.curves.back().points.emplace_back(row.total, row.error);
            unknowns.curves.back().points.emplace_back(row.unknowns, row.error);
            memory.curves.back().points.emplace_back(row.own_peak_memory,
                                                     row.error);
          }
        }
        std::vector<Panel> panels = {seconds};
        for (const auto &[panel, member] :
             {std::make_pair(&unknowns, &Row::unknowns),
              std::make_pair(&memory, &Row::own_peak_memory)})
        {
          double low = 1e300, high = 0.;
          for (const Row &row : rows)
          {
            low  = std::fmin(low, row.*member);
            high = std::fmax(high, row.*member);
          }
          if (high > low)
            panels.push_back(*panel);
        }
        draw_curves(file_name,
                    title,
                    "relative error: " + rows.front().error_kind,
                    panels);
      }


      /// Where a curve of errors that fall with the seconds has the error @p error; none
      /// outside of it.
      double
      seconds_for(const std::vector<Row> &rows, const double error)
      {
        for (unsigned int i = 0; i + 1 < rows.size(); ++i)
          if (rows[i].error >= error && rows[i + 1].error <= error)
          {
            const double part = std::log(rows[i].error / error) /
                                std::log(rows[i].error / rows[i + 1].error);
            return rows[i].total *
                   std::pow(rows[i + 1].total / rows[i].total, part);
          }
        return none;
      }


      /// What each series needs for an error that most of them reach.
      void
      write_comparison(std::ostream &out, const std::vector<Row> &rows)
      {
        const auto                     series = make_series(rows);
        std::map<double, unsigned int> reached;
        for (const Row &row : rows)
          for (const auto &[title, members] : series)
            reached[row.error] += !std::isnan(row.error) &&
                                  !std::isnan(seconds_for(members, row.error));
        double       error = none;
        unsigned int most  = 1;
        for (const auto &[candidate, n] : reached)
          if (n > most)
          {
            error = candidate;
            most  = n;
          }
        if (std::isnan(error))
          return;
        out << "To come down to an error of " << error_text(error) << ": ";
        std::string separator;
        for (const auto &[title, members] : series)
        {
          const double seconds = seconds_for(members, error);
          double       least   = 1e300;
          for (const Row &row : members)
            least = std::fmin(least, row.error);
          out << separator << title << ' ';
          if (std::isnan(seconds))
            out << (least > error
                      ? "does not (" + error_text(least) + " at best here)"
                      : "has less in all runs here");
          else
            out << text_of(seconds, 2) << " s";
          separator = "; ";
        }
        out << ".\n\n";
      }


      struct Case
      {
        std::string name, title, file, text;
      };

      const Case cases[] = {
        {"ring",
         "Thick ring under inner pressure",
         "ring",
         "A quarter ring (the paper's Figs. 5-7) against Lame's solution, on "
         "meshes that do not fit it, uniform or with triangles of half the "
         "size at the inner circle; beside them deal.II's curved six-node "
         "triangles that fit it, with deal.II's MUMPS, which factorizes "
         "without regard to symmetry. The solver is MUMPS, beside it "
         "conjugate gradients with ML. One rank."},
        {"cantilever dead",
         "Cantilever under a load of constant direction",
         "cantilever-dead",
         "The paper's Fig. 10, deflection at K = 2, 4, ..., 10 against the "
         "fitted solid of `applications/step-nmm-2/cantilever.csv`; follower: "
         "the same under pressure that turns with the surface. `finite` is "
         "Newton's method in five steps, `incremental` the paper's many small "
         "ones on one mesh, `small` one linear solution. Dips of a curve are "
         "no accuracy: errors of mesh, steps and reference cancel there."},
        {"Hertz disk",
         "Cylinder on a rigid plate",
         "hertz",
         "Pressure over the contact against Hertz's at a half-width of a tenth "
         "of the radius; springs of the penalty "
         "method are three times as stiff as those of the augmented "
         "Lagrangian. A finite disk differs from Hertz's half-plane by 0.1 to "
         "0.2 %, so smaller errors of the force mean nothing."},
        {"cracked plate",
         "Energy of a plate with an edge crack",
         "cracked-plate",
         "A plate of 1 m x 4 m with a crack through half of its width, against "
         "the energy on a mesh of 0.02 m, halved down to 4e-8 m at the tip. "
         "Uniform meshes err in proportion to the edge length whatever the "
         "order; triangles halved towards the tip give the order back."},
        {"incline",
         "Block that slides down an incline",
         "incline",
         "30 degrees, friction angle 25 degrees, 2 m after the block has "
         "settled on its springs, against the rigid block's distance."},
        {"slope",
         "Slope of jointed rock that slides",
         "slope",
         "`applications/nmm/scenes/slope.prm` with a friction angle of 20 "
         "degrees, the first quarter of a second after its wall has been taken "
         "away, against a step of 2.5 ms. The energy balance is over the "
         "largest kinetic energy."}};


      /// Rows that stand beside those of a case, and what tells them apart.
      std::pair<std::vector<Row>, std::string>
      others_of(const Case &c, const std::vector<Row> &rows)
      {
        if (c.name == "ring")
          return {select(rows,
                         [&](const Row &row) {
                           return row.name == c.name && row.ranks == 1. &&
                                  row.solver == "CG + ML";
                         }),
                  "CG + ML"};
        if (c.name == "cantilever dead")
          return {select(rows, "cantilever follower"), "follower"};
        return {};
      }


      void
      write_head(std::ostream &out, const std::vector<Row> &rows)
      {
        const Row &row = rows.front();
        out
          << "# Speed against error\n\n"
             "    ./setup.sh bench "
          << row.size
          << "     # measures, and writes this page and its figures\n"
             "    build/release/bin/nmm-bench report "
             "tests/performance/performance.csv doc     # only writes\n\n"
             "Measured on "
          << row.date << ": " << row.cpu << ", " << row.versions
          << ", one BLAS thread. Wall times are the least of up to three runs "
             "and scatter by some ten percent; unknowns, steps and iterations "
             "hold everywhere. Seconds are from the curves to the "
             "answer, ratios of runs of the same session. \"Peak MB\" is what "
             "a run adds to the largest "
             "resident size of its process. "
             "`tests/performance/performance.csv` has all rows, with non-zeros "
             "and factor entries; `counts.csv` beside it has allocations and "
             "instructions of each element and contact point, by `nmm-bench "
             "counts`.\n\n";
      }
    } // namespace


    void
    write_report(const std::vector<Row> &rows, const std::string &directory)
    {
      const std::string images = directory + "/images";
      std::filesystem::create_directories(images);
      std::ostringstream out;
      write_head(out, rows);
      write_bars(out, rows);
      out << "## Error against seconds, unknowns and memory\n\n";
      for (const Case &c : cases)
      {
        const std::vector<Row> members = select(rows, c.name);
        if (members.empty())
          continue;
        const std::string image = "performance-" + c.file + ".png";
        draw_case(members, c.title, images + "/" + image);
        const auto [others, name_of_others] = others_of(c, rows);
        const std::vector<Row> alone = select(members, [](const Row &row) {
          return row.ranks == 1. || std::isnan(row.ranks);
        });
        out << "### " << c.title << "\n\n"
            << c.text << "\n\n![" << c.title << "](images/" << image << ")\n\n";
        write_comparison(out, alone);
        write_series(
          out,
          select(alone, [](const Row &row) { return row.solver != "CG + ML"; }),
          others,
          name_of_others);
      }
      write_stages(out, rows, images);
      write_threads(out, rows);
      write_ranks(out, rows, images);
      std::ofstream(directory + "/performance.md") << out.str();
    }
  } // namespace Bench
} // namespace NMM
