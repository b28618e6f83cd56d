#include "element_triangles.h"

#include <algorithm>
#include <base/cross.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using dealii::Point;
      using dealii::Tensor;

      /// Computes the start of each edge in reference coordinates of the cell.
      void
      set_corners(const dealii::ArrayView<const ElementEdge> &edges,
                  const CellFrame                            &cell,
                  Point<2> (&corners)[4])
      {
        const Tensor<2, 2> to_reference = dealii::invert(cell.jacobian);
        for (unsigned int i = 0; i < edges.size(); ++i)
          corners[i] = Point<2>(to_reference * (edges[i].start - cell.origin));
      }


      double
      twice_the_area(const Point<2> &x, const Point<2> &y, const Point<2> &z)
      {
        return cross(y - x, z - x);
      }


      /// Whether a polygon in reference coordinates is neither too small nor too thin; @p longest
      /// is the square of its largest distance between corners.
      bool
      is_good(const double twice_the_area, const double longest)
      {
        constexpr double least_extent = 0.01, least_shape = 0.05;
        return longest > least_extent * least_extent &&
               twice_the_area > least_shape * longest;
      }


      ElementRule::Triangle
      make_triangle(const Point<2> &x, const Point<2> &y, const Point<2> &z)
      {
        return {x, {{y - x, z - x}}, twice_the_area(x, y, z)};
      }
    } // namespace


    Triangles
    find_triangles(const dealii::ArrayView<const ElementEdge> &edges,
                   const CellFrame                            &cell,
                   const unsigned int                          max_triangles)
    {
      const unsigned int n = edges.size();
      if (n < 3 || n > 4 || n - 2 > max_triangles)
        return Triangles::none;
      for (unsigned int i = 0; i < n; ++i)
        if (edges[i].is_arc() || edges[i].end != edges[(i + 1) % n].start)
          return Triangles::none;
      Point<2> x[4];
      set_corners(edges, cell, x);
      double longest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          longest = std::max(longest, x[i].distance_square(x[j]));
      if (n == 3)
        return is_good(twice_the_area(x[0], x[1], x[2]), longest)
                 ? Triangles::one
                 : Triangles::none;

      // The quadrilateral is divided along the diagonal whose triangles are more alike. One of
      // them may be thin, since its rounding errors are small compared with the element; it only
      // has to be so large that its points are inside.
      constexpr double least_part = 1e-8;
      const double     at_1       = twice_the_area(x[0], x[1], x[2]),
                   at_2           = twice_the_area(x[1], x[2], x[3]),
                   at_3           = twice_the_area(x[2], x[3], x[0]),
                   at_0           = twice_the_area(x[3], x[0], x[1]);
      if (std::min({at_0, at_1, at_2, at_3}) <= least_part * longest ||
          !is_good(at_1 + at_3, longest))
        return Triangles::none;
      return std::min(at_1, at_3) >= std::min(at_0, at_2)
               ? Triangles::two_from_0
               : Triangles::two_from_1;
    }


    unsigned int
    set_triangles(const Triangles                             kind,
                  const dealii::ArrayView<const ElementEdge> &edges,
                  const CellFrame                            &cell,
                  ElementRule::Triangle (&triangles)[2])
    {
      if (kind == Triangles::none)
        return 0;
      Point<2> x[4];
      set_corners(edges, cell, x);
      switch (kind)
      {
        case Triangles::one:
          triangles[0] = make_triangle(x[0], x[1], x[2]);
          return 1;
        case Triangles::two_from_0:
          triangles[0] = make_triangle(x[0], x[1], x[2]);
          triangles[1] = make_triangle(x[0], x[2], x[3]);
          return 2;
        case Triangles::two_from_1:
          triangles[0] = make_triangle(x[1], x[2], x[3]);
          triangles[1] = make_triangle(x[1], x[3], x[0]);
          return 2;
        default:
          return 0;
      }
    }
  } // namespace internal
} // namespace NMM
