#include <nmm/output/picture_scale.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <output/picture_scale.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    std::string
    number_text(const double value, const unsigned int n_digits)
    {
      std::ostringstream text;
      text << std::setprecision(n_digits) << value;
      return text.str();
    }
  } // namespace internal


  std::array<double, 3>
  colour_map(const double value)
  {
    // The colours are those of viridis (Smith & van der Walt) at eleven equal steps.
    static const std::array<std::array<double, 3>, 11> colours = {
      {{{0.267, 0.005, 0.329}},
       {{0.283, 0.141, 0.458}},
       {{0.254, 0.265, 0.530}},
       {{0.207, 0.372, 0.553}},
       {{0.164, 0.471, 0.558}},
       {{0.128, 0.567, 0.551}},
       {{0.135, 0.659, 0.518}},
       {{0.267, 0.749, 0.441}},
       {{0.478, 0.821, 0.318}},
       {{0.741, 0.873, 0.150}},
       {{0.993, 0.906, 0.144}}}};
    const double position =
      std::min(1., std::max(0., value)) * (colours.size() - 1.);
    const auto   i = std::min<std::size_t>(static_cast<std::size_t>(position),
                                         colours.size() - 2);
    const double t = position - static_cast<double>(i);
    std::array<double, 3> colour;
    for (unsigned int c = 0; c < 3; ++c)
      colour[c] = (1. - t) * colours[i][c] + t * colours[i + 1][c];
    return colour;
  }


  std::vector<double>
  round_ticks(const double min, const double max, const unsigned int n)
  {
    if (!(max > min))
      return {min};
    const double rough = (max - min) / n;
    const double power = std::pow(10., std::floor(std::log10(rough)));
    double       step  = 10. * power;
    for (const double factor : {5., 2., 1.})
      if (factor * power >= rough * (1. - 1e-9))
        step = factor * power;
    std::vector<double> ticks;
    for (double k = std::ceil(min / step - 1e-9); k * step <= max + 1e-9 * step;
         ++k)
      // Adding zero turns -0 into 0, which is printed without a sign.
      ticks.push_back(k * step + 0.);
    return ticks;
  }


  std::vector<std::string>
  tick_labels(const std::vector<double> &ticks)
  {
    std::vector<std::string> labels;
    for (unsigned int n_digits = 4; n_digits <= 12; ++n_digits)
    {
      labels.clear();
      for (const double tick : ticks)
        labels.push_back(internal::number_text(tick, n_digits));
      if (std::adjacent_find(labels.begin(), labels.end()) == labels.end())
        break;
    }
    return labels;
  }
} // namespace NMM
