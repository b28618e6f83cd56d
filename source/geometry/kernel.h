#ifndef nmm_source_geometry_kernel_h
#define nmm_source_geometry_kernel_h

#include <deal.II/base/point.h>

#include <CGAL/Arr_circle_segment_traits_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

namespace NMM
{
  namespace internal
  {
    using Kernel     = CGAL::Exact_predicates_exact_constructions_kernel;
    using BaseTraits = CGAL::Arr_circle_segment_traits_2<Kernel>;

    /// The point of the same coordinates: doubles are rationals.
    inline Kernel::Point_2
    exact(const dealii::Point<2> &point)
    {
      return {point[0], point[1]};
    }

    /**
     * Convert an exact coordinate (a + b sqrt(c)) to the nearest double or a neighbour of it. The
     * relative error is at most 8 epsilon, however close two curves are. CGAL's default error of
     * 1e-5 for lazy numbers would move the corners of slivers.
     */
    double
    to_double(const BaseTraits::Point_2::CoordNT &coordinate);

    dealii::Point<2>
    to_double(const BaseTraits::Point_2 &point);
  } // namespace internal
} // namespace NMM

#endif
