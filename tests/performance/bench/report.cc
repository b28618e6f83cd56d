#include "report.h"

#include "figure.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

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


      void
      write_series(std::ostream &out, const std::vector<Row> &rows)
      {
        const Row &any = rows.front();
        out << "| | elements | unknowns | non-zeros | factor entries | steps | "
               "iterations | seconds | peak MB | error ("
            << any.error_kind << ")";
        const bool has_second = !any.second_error_kind.empty();
        if (has_second)
          out << " | error (" << any.second_error_kind << ")";
        out << " |\n|---|---|---|---|---|---|---|---|---|---|"
            << (has_second ? "---|" : "") << '\n';
        for (const auto &[title, members] : make_series(rows))
          for (const Row &row : members)
          {
            out << "| " << title;
            for (const double number : {row.elements,
                                        row.unknowns,
                                        row.nonzeros,
                                        row.factor_entries,
                                        row.steps,
                                        row.iterations,
                                        row.total,
                                        row.own_peak_memory})
              out << " | " << text_of(number);
            out << " | " << error_text(row.error);
            if (has_second)
              out << " | " << error_text(row.second_error);
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
         "meshes that "
         "do not fit it, regular or with triangles of half the size at the "
         "inner circle; "
         "beside them deal.II's own curved six-node triangles that fit it, "
         "solved by "
         "deal.II's interface to MUMPS, which factorizes without regard to "
         "symmetry and has "
         "twice the work. Seconds are from the curves to the displacements."},
        {"cantilever dead",
         "Cantilever under a load of constant direction",
         "cantilever-dead",
         "The paper's Fig. 10, deflection at K = 2, 4, ..., 10 against the "
         "fitted solid of "
         "`applications/step-nmm-2/cantilever.csv`: `finite` is Newton's "
         "method in five "
         "steps, `incremental` the paper's many small ones on one mesh, "
         "`small` one linear "
         "solution, which knows nothing of large displacements. A dip of a "
         "curve is no accuracy: what mesh, steps and reference lack cancels "
         "there; "
         "the level at its end counts."},
        {"cantilever follower",
         "Cantilever under a load that turns with it",
         "cantilever-follower",
         "The same with pressure on the deformed surface."},
        {"Hertz disk",
         "Cylinder on a rigid plate",
         "hertz",
         "Pressure over the contact against Hertz's at a half-width of a tenth "
         "of the radius; "
         "springs of the penalty method are three times as stiff as those of "
         "the augmented "
         "Lagrangian. A finite disk differs from Hertz's half-plane by 0.1 to "
         "0.2 %: "
         "errors of the force below that mean nothing."},
        {"cracked plate",
         "Energy of a plate with an edge crack",
         "cracked-plate",
         "A plate of 1 m x 4 m with a crack through half of its width, an open "
         "joint that ends "
         "inside, against the energy on a mesh of 0.02 m, halved down to 4e-8 "
         "m at the "
         "tip. Uniform "
         "meshes err in proportion to the edge length whatever the order, as "
         "sqrt(r) "
         "at the tip has it; triangles halved towards the tip give the order "
         "back."},
        {"incline",
         "Block that slides down an incline",
         "incline",
         "30 degrees, friction angle 25 degrees, 2 m after the block has "
         "settled on its "
         "springs, against the rigid block's way; sizes are time steps."},
        {"slope",
         "Slope of jointed rock that slides",
         "slope",
         "`applications/nmm/scenes/slope.prm` with a friction angle of 20 "
         "degrees, the first quarter of a second "
         "after its wall has been taken away. Error: way of the centre of mass "
         "against that of a step of 2.5 ms; balance: error of the energy "
         "account over the "
         "largest kinetic energy. Sizes are time steps."}};


      void
      write_head(std::ostream &out, const std::vector<Row> &rows)
      {
        const Row &row = rows.front();
        out
          << "# Speed against error\n\n"
          << "Made by `./setup.sh bench " << row.size
          << "` from `tests/performance/performance.csv`, on " << row.date
          << ": " << row.cpu << ", " << row.versions
          << ", one BLAS thread. The program is `nmm-bench`, in "
             "`tests/performance/bench`.\n\n"
             "Times are wall times, the least of up to three runs (of what "
             "takes longer than two seconds: of two; than ten: of one); they "
             "hold for this machine and scatter "
             "by some ten percent. Elements, "
             "unknowns, non-zeros, factor entries, steps and iterations hold "
             "everywhere. \"Peak MB\" is by how much a run raises the largest "
             "resident size of its process above what it was before, summed "
             "over "
             "ranks.\n\n";
      }
    } // namespace


    void
    write_report(const std::vector<Row>   &rows,
                 const std::vector<Count> &counts,
                 const std::string        &directory)
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
        out << "### " << c.title << "\n\n"
            << c.text << "\n\n![" << c.title << "](images/" << image << ")\n\n";
        write_comparison(out, members);
        write_series(out, members);
      }
      write_stages(out, rows, images);
      report_counts(out, counts);
      write_threads(out, rows);
      write_scaling(out, rows);
      write_distribution(out, rows, images);
      std::ofstream(directory + "/performance.md") << out.str();
    }
  } // namespace Bench
} // namespace NMM
