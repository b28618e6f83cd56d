#include "figure.h"

#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      const char *const      colors[] = {"#1f4e9c",
                                         "#c0392b",
                                         "#e08e0b",
                                         "#2e8b57",
                                         "#7d3c98",
                                         "#16a0b8",
                                         "#7f7f7f",
                                         "#8b5a2b",
                                         "#d66ba0",
                                         "#5b6b1f",
                                         "#000000",
                                         "#90c0f0",
                                         "#d9d9d9",
                                         "#f0d090"};
      constexpr unsigned int n_colors = sizeof(colors) / sizeof(colors[0]);
      const int              marks[]  = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12};
      constexpr unsigned int n_marks  = sizeof(marks) / sizeof(marks[0]);


      std::string
      style(const unsigned int i)
      {
        std::ostringstream text;
        text << "with linespoints lw 1.5 pt " << marks[i % n_marks] << " lc '"
             << colors[i % n_colors] << "'";
        return text.str();
      }


      /// gnuplot's strings in single quotes.
      std::string
      quoted(const std::string &text)
      {
        std::string result = "'";
        for (const char c : text)
          result += c == '\'' ? std::string("''") : std::string(1, c);
        return result + "'";
      }


      void
      run_gnuplot(const std::string &script)
      {
        const std::filesystem::path file =
          std::filesystem::temp_directory_path() / "nmm-bench.gp";
        std::ofstream(file) << script;
        AssertThrow(std::system(("gnuplot " + quoted(file.string())).c_str()) ==
                      0,
                    InputError("gnuplot failed",
                               file.string(),
                               "see that gnuplot is installed"));
        std::filesystem::remove(file);
      }


      bool
      can_be_drawn(const std::pair<double, double> &point)
      {
        return point.first > 0. && point.second > 0. &&
               std::isfinite(point.first) && std::isfinite(point.second);
      }


      std::string
      powers_of_two()
      {
        std::ostringstream text;
        for (unsigned int n = 1; n <= 4096; n *= 2)
          text << (n == 1 ? "" : ", ") << n;
        return text.str();
      }


      /// 1, 2 and 5 times powers of ten.
      std::string
      round_numbers()
      {
        std::ostringstream text;
        for (int power = -4; power <= 4; ++power)
          for (const double factor : {1., 1.5, 2., 3., 5., 7.})
            text << (text.str().empty() ? "" : ", ")
                 << factor * std::pow(10., power);
        return text.str();
      }


      /// Hardly more than the points need, as gnuplot's command.
      template <typename Coordinate>
      std::string
      range(const std::string &axis,
            const Panel       &panel,
            const Coordinate  &coordinate)
      {
        double least = 1e300, largest = 0.;
        for (const Curve &curve : panel.curves)
          for (const auto &point : curve.points)
            if (can_be_drawn(point))
            {
              least   = std::min(least, coordinate(point));
              largest = std::max(largest, coordinate(point));
            }
        std::ostringstream text;
        if (largest > 0.)
          text << "set " << axis << "range [" << least / 1.15 << ':'
               << 1.15 * largest << "]\n";
        return text.str();
      }
    } // namespace


    void
    draw_curves(const std::string        &file_name,
                const std::string        &title,
                const std::string        &y_label,
                const std::vector<Panel> &panels)
    {
      // Up to two panels stand in a row above the key; of more, the key takes the
      // place of one.
      const bool         is_row = panels.size() <= 2;
      std::ostringstream script, key;
      script << "set terminal pngcairo size 1250," << (is_row ? 640 : 950)
             << " font 'DejaVu Sans,12' "
                "noenhanced\n"
             << "set output " << quoted(file_name) << '\n'
             << "set multiplot " << (is_row ? "" : "layout 2,2 ") << "title "
             << quoted(title) << '\n'
             << "set logscale xy\nset format x '%.0e'\nset format y '%.0e'\n"
             << "set grid\nset ylabel " << quoted(y_label) << '\n';
      for (unsigned int p = 0; p < panels.size(); ++p)
      {
        std::ostringstream plot;
        for (unsigned int c = 0; c < panels[p].curves.size(); ++c)
        {
          const Curve       &curve = panels[p].curves[c];
          std::ostringstream data;
          for (const auto &point : curve.points)
            if (can_be_drawn(point))
              data << point.first << ' ' << point.second << '\n';
          if (p == 0)
            key << (c == 0 ? "plot " : ", ") << "NaN " << style(c) << " title "
                << quoted(curve.title);
          if (data.str().empty())
            continue;
          script << "$d" << p << '_' << c << " << EOD\n"
                 << data.str() << "EOD\n";
          plot << (plot.str().empty() ? "plot " : ", ") << "$d" << p << '_' << c
               << " using 1:2 " << style(c) << " notitle";
        }
        if (is_row)
          script << "set size " << 1. / panels.size() << ",0.72\nset origin "
                 << static_cast<double>(p) / panels.size() << ",0.22\n";
        if (panels[p].has_numbers)
          script << "set format '%g'\nset xtics (" << powers_of_two()
                 << ")\nset ytics (" << round_numbers() << ")\nunset mxtics\n"
                 << range("x",
                          panels[p],
                          [](const auto &point) { return point.first; })
                 << range("y", panels[p], [](const auto &point) {
                      return point.second;
                    });
        script << "set xlabel " << quoted(panels[p].x_label) << '\n'
               << plot.str() << '\n';
      }
      script << "unset logscale\nunset border\nunset tics\nunset grid\n"
                "unset xlabel\nunset ylabel\nset xrange [0:1]\nset yrange "
                "[0:1]\n"
             << (is_row ? "set size 1,0.2\nset origin 0,0.01\nset key center "
                          "center Left reverse horizontal maxcols 3\n"
                        : "set key center center Left reverse\n")
             << key.str() << "\nunset multiplot\n";
      run_gnuplot(script.str());
    }


    void
    draw_stacks(const std::string              &file_name,
                const std::string              &title,
                const std::vector<std::string> &part_names,
                const std::vector<Stack>       &stacks)
    {
      std::ostringstream script;
      script << "set terminal pngcairo size 1250,750 font 'DejaVu Sans,12' "
                "noenhanced\n"
             << "set output " << quoted(file_name) << '\n'
             << "set title " << quoted(title) << '\n'
             << "set style data histograms\nset style histogram rowstacked\n"
                "set style fill solid 0.85 border -1\nset boxwidth 0.7\n"
                "set ylabel 'share of the time [%]'\nset yrange [0:100]\n"
                "set xtics rotate by -25\nset key outside right\nset grid y\n"
             << "$d << EOD\n";
      for (const Stack &stack : stacks)
      {
        double sum = 0.;
        for (const double part : stack.parts)
          sum += std::isnan(part) ? 0. : part;
        script << '"' << stack.title << '"';
        for (const double part : stack.parts)
          script << ' ' << (std::isnan(part) ? 0. : 100. * part / sum);
        script << '\n';
      }
      script << "EOD\nplot ";
      for (unsigned int i = 0; i < part_names.size(); ++i)
        script << (i == 0 ? "" : ", ") << "$d using " << i + 2
               << (i == 0 ? ":xtic(1)" : "") << " lc '" << colors[i % n_colors]
               << "' title " << quoted(part_names[i]);
      script << '\n';
      run_gnuplot(script.str());
    }
  } // namespace Bench
} // namespace NMM
