#include "exact_signs.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "exact_curves.h"
#include <optional>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      using FT = Kernel::FT;

      /// Relative error of the coordinates of a vertex in doubles, see to_double().
      constexpr double rounding_of_coordinates =
        8. * std::numeric_limits<double>::epsilon();


      /// Exact position of a vertex; empty if a coordinate is irrational.
      std::optional<Kernel::Point_2>
      rational(const PhysicalEdges &physical_edges, const unsigned int vertex)
      {
        const auto &x = physical_edges.exact_curves().points[vertex];
        if (x.x().is_extended() || x.y().is_extended())
          return {};
        return Kernel::Point_2(x.x().a0(), x.y().a0());
      }
    } // namespace


    int
    exact_orientation(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
      using P       = Doubles::Point_2;
      return CGAL::orientation(P(a[0], a[1]), P(b[0], b[1]), P(c[0], c[1]));
    }


    int
    exact_turn(const Point<2> &a,
               const Point<2> &b,
               const Point<2> &c,
               const Point<2> &d)
    {
      return CGAL::sign(
        CGAL::determinant(exact(b) - exact(a), exact(d) - exact(c)));
    }


    int
    orientation(const Point<2>      &a,
                const Point<2>      &b,
                const PhysicalEdges &physical_edges,
                const unsigned int   vertex)
    {
      const Point<2> &x  = physical_edges.vertices()[vertex];
      const double    dx = b[0] - a[0], dy = b[1] - a[1];
      const double    left = dx * (x[1] - a[1]), right = dy * (x[0] - a[0]);
      const double    bound =
        rounding_of_determinant * (std::abs(left) + std::abs(right)) +
        2. * rounding_of_coordinates *
          (std::abs(dx * x[1]) + std::abs(dy * x[0]));
      if (std::abs(left - right) > bound)
        return left > right ? 1 : -1;
      const std::optional<Kernel::Point_2> point =
        rational(physical_edges, vertex);
      return point ? CGAL::orientation(exact(a), exact(b), *point) : undecided;
    }


    int
    compare(const PhysicalEdges &physical_edges,
            const unsigned int   vertex,
            const Point<2>      &a)
    {
      const Point<2> &x = physical_edges.vertices()[vertex];
      if (std::abs(x[0] - a[0]) > 2. * rounding_of_coordinates * std::abs(x[0]))
        return x[0] > a[0] ? 1 : -1;
      const auto &point = physical_edges.exact_curves().points[vertex];
      const auto  in_x  = CGAL::compare(point.x(), FT(a[0]));
      return in_x != CGAL::EQUAL ? in_x : CGAL::compare(point.y(), FT(a[1]));
    }


    int
    compare_along(const Point<2>      &u,
                  const Point<2>      &v,
                  const PhysicalEdges &physical_edges,
                  const PointOnSide   &a,
                  const PointOnSide   &b)
    {
      const Kernel::Point_2  start = exact(u);
      const Kernel::Vector_2 side  = exact(v) - start;
      const auto parameter = [&](const PointOnSide &x) -> std::optional<FT> {
        if (x.vertex == invalid_index)
        {
          const Kernel::Vector_2 line = exact(x.q) - exact(x.p);
          const FT at_u = CGAL::determinant(line, start - exact(x.p));
          return -at_u / CGAL::determinant(line, side);
        }
        const std::optional<Kernel::Point_2> point =
          rational(physical_edges, x.vertex);
        if (!point)
          return {};
        return ((*point - start) * side) / side.squared_length();
      };
      const std::optional<FT> s = parameter(a), t = parameter(b);
      return s && t ? CGAL::compare(*t, *s) : undecided;
    }
  } // namespace internal
} // namespace NMM
