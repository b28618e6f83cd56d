#ifndef nmm_source_output_double_points_h
#define nmm_source_output_double_points_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The file @p vtu of deal.II with the positions of its points in double precision [m]. deal.II
    /// writes them in single precision, in which points of a map a few centimetres apart are the
    /// same. @p points are in the order of the file.
    std::string
    with_double_points(const std::string                   &vtu,
                       const std::vector<dealii::Point<2>> &points);

    /// The record @p pvtu of parallel files, which says that points have double precision.
    std::string
    with_double_points(const std::string &pvtu);
  } // namespace internal
} // namespace NMM

#endif
