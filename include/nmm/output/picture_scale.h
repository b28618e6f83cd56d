#ifndef nmm_output_picture_scale_h
#define nmm_output_picture_scale_h

#include <array>
#include <string>
#include <vector>

namespace NMM
{
  /// Colour of the viridis map at @p value in [0, 1], as red, green and blue in [0, 1].
  std::array<double, 3>
  colour_map(double value);

  /// About @p n round numbers in [@p min, @p max], whose distance is 1, 2 or 5 times a
  /// power of ten.
  std::vector<double>
  round_ticks(double min, double max, unsigned int n);

  /// Texts of the ascending numbers @p ticks. They have four digits, or as many as are needed to
  /// distinguish neighbours, but at most twelve.
  std::vector<std::string>
  tick_labels(const std::vector<double> &ticks);
} // namespace NMM

#endif
