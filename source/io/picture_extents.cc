#include <nmm/io/picture.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    /// 1, 2 or 5 times a power of ten, not larger than @p value.
    double
    rounded_down(const double value)
    {
      const double power = std::pow(10., std::floor(std::log10(value)));
      for (const double factor : {5., 2.})
        if (factor * power <= value)
          return factor * power;
      return power;
    }
  } // namespace


  double
  choose_deformation_scale(const double largest_displacement,
                           const double diagonal)
  {
    return largest_displacement > 1e-14 * diagonal
             ? rounded_down(0.05 * diagonal / largest_displacement)
             : 0.;
  }


  void
  PictureExtents::add(const PictureData &data, const double scale)
  {
    for (const PictureData::Triangle &triangle : data.triangles)
    {
      for (const PictureData::Vertex &vertex : triangle.vertices)
      {
        const Point<2> x = vertex.at(scale);
        for (unsigned int d = 0; d < 2; ++d)
          if (std::isfinite(x[d]))
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
        if (std::isfinite(vertex.displacement.norm()))
          largest = std::max(largest, vertex.displacement.norm());
      }
      for (const double value : triangle.values)
        if (std::isfinite(value))
        {
          minimum = std::min(minimum, value);
          maximum = std::max(maximum, value);
        }
    }
  }


  std::pair<Point<2>, Point<2>>
  PictureExtents::view(const double margin) const
  {
    if (!(lower[0] <= upper[0] && lower[1] <= upper[1]))
      return {Point<2>(0., 0.), Point<2>(1., 1.)};
    const double space =
      margin * std::max(upper[0] - lower[0], upper[1] - lower[1]);
    return {Point<2>(lower[0] - space, lower[1] - space),
            Point<2>(upper[0] + space, upper[1] + space)};
  }


  std::pair<double, double>
  PictureExtents::range() const
  {
    if (!(minimum <= maximum))
      return {0., 0.};
    if (maximum - minimum <=
        1e-9 * std::max(std::abs(minimum), std::abs(maximum)))
      return {minimum, minimum};
    return {minimum, maximum};
  }


  double
  PictureExtents::largest_displacement() const
  {
    return largest;
  }
} // namespace NMM
