#ifndef nmm_output_picture_scale_h
#define nmm_output_picture_scale_h

#include <nmm/geometry/physical_mesh.h>

#include <array>
#include <limits>
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

  /// Factor on displacements [-] with which the largest one appears as 5 % of the @p diagonal of
  /// the solid's box [m] or a little less, and does not close the smallest hole [m]. It is 1, 2 or
  /// 5 times a power of ten, or 0 if displacements are rounding errors.
  double
  choose_deformation_scale(
    double largest_displacement,
    double diagonal,
    double smallest_hole = std::numeric_limits<double>::infinity());

  /// Shorter side of the box around the smallest hole, or around what a tied joint surrounds, which may
  /// be excavated [m]; infinity if there is neither.
  double
  smallest_hole(const PhysicalMesh &mesh);
} // namespace NMM

#endif
