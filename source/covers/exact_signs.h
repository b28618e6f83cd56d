#ifndef nmm_source_covers_exact_signs_h
#define nmm_source_covers_exact_signs_h

// Private: signs of determinants, exact, free of CGAL types.

#include <deal.II/base/point.h>

#include "physical_edges.h"
#include <cmath>
#include <limits>

namespace NMM
{
  namespace internal
  {
    /// @name Exact arithmetic for signs that the floating-point filters below do not decide @{
    int
    exact_orientation(const dealii::Point<2> &a,
                      const dealii::Point<2> &b,
                      const dealii::Point<2> &c);

    int
    exact_turn(const dealii::Point<2> &a,
               const dealii::Point<2> &b,
               const dealii::Point<2> &c,
               const dealii::Point<2> &d);
    /// @}


    /// Bound on the rounding error of a sum of two products of differences of doubles, relative to
    /// the sum of the absolute values of the products. Shewchuk, Discrete Comput. Geom. 18 (1997),
    /// has (3 + 16 eps) eps, his eps being half of ours, for an expression with one rounding less.
    constexpr double rounding_of_determinant =
      4. * std::numeric_limits<double>::epsilon();


    /// Sign of (b - a) x (c - a): positive if c is to the left of the line from a to b.
    inline int
    orientation(const dealii::Point<2> &a,
                const dealii::Point<2> &b,
                const dealii::Point<2> &c)
    {
      const double left        = (b[0] - a[0]) * (c[1] - a[1]),
                   right       = (b[1] - a[1]) * (c[0] - a[0]);
      const double determinant = left - right;
      const double bound =
        rounding_of_determinant * (std::abs(left) + std::abs(right));
      return determinant > bound    ? 1
             : determinant < -bound ? -1
                                    : exact_orientation(a, b, c);
    }


    /// Sign of (b - a) x (d - c): positive if the second direction is to the left of the
    /// first.
    inline int
    turn(const dealii::Point<2> &a,
         const dealii::Point<2> &b,
         const dealii::Point<2> &c,
         const dealii::Point<2> &d)
    {
      const double left        = (b[0] - a[0]) * (d[1] - c[1]),
                   right       = (b[1] - a[1]) * (d[0] - c[0]);
      const double determinant = left - right;
      const double bound =
        rounding_of_determinant * (std::abs(left) + std::abs(right));
      return determinant > bound    ? 1
             : determinant < -bound ? -1
                                    : exact_turn(a, b, c, d);
    }


    /// Value for a sign that rational numbers cannot decide, because the end of an arc is
    /// irrational.
    constexpr int undecided = 2;

    /**
     * Sign of (b - a) x (x - a) for a vertex x of the physical mesh, which need not
     * have doubles as coordinates; or `undecided`.
     */
    int
    orientation(const dealii::Point<2> &a,
                const dealii::Point<2> &b,
                const PhysicalEdges    &physical_edges,
                unsigned int            vertex);

    /// Sign of x - a in lexicographic order for a vertex x of the physical mesh.
    int
    compare(const PhysicalEdges    &physical_edges,
            unsigned int            vertex,
            const dealii::Point<2> &a);


    /// A point inside a side u v of a cell: the crossing with the straight line through p and q, or
    /// a vertex of the physical mesh.
    struct PointOnSide
    {
      dealii::Point<2> p, q;
      /// Vertex of the physical mesh; invalid_index for a crossing.
      unsigned int vertex = invalid_index;
    };

    /// Whether @p a is nearer to u than @p b: 1 if it is, -1 if it is not, 0 if both are equal; or
    /// `undecided`.
    int
    compare_along(const dealii::Point<2> &u,
                  const dealii::Point<2> &v,
                  const PhysicalEdges    &physical_edges,
                  const PointOnSide      &a,
                  const PointOnSide      &b);
  } // namespace internal
} // namespace NMM

#endif
