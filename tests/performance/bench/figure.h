#ifndef nmm_tests_performance_bench_figure_h
#define nmm_tests_performance_bench_figure_h

#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace Bench
  {
    /// Points joined by lines, logarithmic axes.
    struct Curve
    {
      std::string                            title;
      std::vector<std::pair<double, double>> points;
    };

    struct Panel
    {
      std::string        x_label;
      std::vector<Curve> curves;
      /// Small whole numbers along x, twice the one before at each mark.
      bool has_numbers = false;
    };

    /// Bars of stacked parts.
    struct Stack
    {
      std::string         title;
      std::vector<double> parts;
    };


    /**
     * A PNG file with up to three panels and a key; curves of equal place in their panels have
     * the same colour. Drawn by gnuplot.
     * @throws InputError if gnuplot fails.
     */
    void
    draw_curves(const std::string        &file_name,
                const std::string        &title,
                const std::string        &y_label,
                const std::vector<Panel> &panels);

    void
    draw_stacks(const std::string              &file_name,
                const std::string              &title,
                const std::vector<std::string> &part_names,
                const std::vector<Stack>       &stacks);
  } // namespace Bench
} // namespace NMM

#endif
