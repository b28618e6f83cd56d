#include <nmm/base/exceptions.h>

#include "cutting.h"
#include <base/double_double.h>
#include <cmath>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// A piece's ends, the left one first.
      std::pair<Point<2>, Point<2>>
      from_left_to_right(const CurvePiece &piece)
      {
        const Point<2> &a = piece.start, &b = piece.end;
        return std::tie(a[0], a[1]) < std::tie(b[0], b[1])
                 ? std::make_pair(a, b)
                 : std::make_pair(b, a);
      }


      /// Distance of @p x to the left of the line from @p a to @p b [m], to rounding
      /// of coordinates.
      double
      distance_to_the_left(const Point<2> &a,
                           const Point<2> &b,
                           const Point<2> &x)
      {
        const Tensor<1, 2> d = b - a, r = x - a;
        return (d[0] * r[1] - d[1] * r[0]) / d.norm();
      }


      /// The product of two differences to twice the digits.
      DoubleDouble
      product_of_differences(const double a,
                             const double b,
                             const double c,
                             const double d)
      {
        const DoubleDouble first = two_sum(a, -b), second = two_sum(c, -d);
        return first * second.hi + first * second.lo;
      }


      /// (b - a) x (x - a)
      double
      twice_the_area(const Point<2> &a, const Point<2> &b, const Point<2> &x)
      {
        const DoubleDouble area =
          product_of_differences(b[0], a[0], x[1], a[1]) +
          -product_of_differences(b[1], a[1], x[0], a[0]);
        return area.hi;
      }
    } // namespace


    std::vector<SimpleCut>
    find_simple_cuts(const MathematicalMesh          &mesh,
                     const PhysicalEdges             &physical_edges,
                     const std::vector<CurvePiece>   &pieces,
                     const std::vector<unsigned int> &only_edge,
                     const double                     scale)
    {
      // Distances are wrong by some 1e-15 of the coordinates. A sliver thinner than a
      // millionth of its cell deserves exact arithmetic.
      constexpr double of_coordinates = 1e-9, of_cell = 1e-6;

      std::vector<SimpleCut> cuts;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const unsigned int e = only_edge[c];
        if (e == invalid_index || e == several_edges ||
            physical_edges.edges()[e].shape.is_arc())
          continue;
        const PhysicalEdges::Edge &edge = physical_edges.edges()[e];
        const auto [p, q] = from_left_to_right(pieces[edge.piece]);
        const double margin =
          std::max(of_coordinates * scale, of_cell * mesh.cell_diameter(c));
        const auto  &corners = mesh.cell_vertices(c);
        Point<2>     v[3];
        double       left[3];
        unsigned int n_left   = 0;
        bool         is_clear = true;
        for (unsigned int i = 0; i < 3; ++i)
        {
          v[i]    = mesh.vertices()[corners[i]];
          left[i] = distance_to_the_left(p, q, v[i]);
          n_left += left[i] > 0.;
          is_clear = is_clear && std::abs(left[i]) > margin;
        }
        if (!is_clear || n_left == 0 || n_left == 3)
          continue;
        unsigned int k = 0;
        while ((left[k] > 0.) != (n_left == 1))
          ++k;

        // each end beyond another one of the crossed sides
        const auto is_beyond = [&](const Point<2> &x, const unsigned int side) {
          return distance_to_the_left(v[side], v[(side + 1) % 3], x) < -margin;
        };
        const unsigned int first = k, second = (k + 2) % 3;
        const Point<2>    &a = edge.shape.start, &b = edge.shape.end;
        if ((is_beyond(a, first) && is_beyond(b, second)) ||
            (is_beyond(b, first) && is_beyond(a, second)))
          cuts.push_back({c, e, k, left[k] > 0.});
      }
      return cuts;
    }


    Point<2>
    crossing(const CurvePiece &piece, const Point<2> &u, const Point<2> &v)
    {
      const auto [p, q] = from_left_to_right(piece);
      const double a = twice_the_area(p, q, u), b = twice_the_area(p, q, v);
      const double t = a / (a - b);
      // from the nearer end
      return t < 0.5 ? u + t * (v - u) : v + (b / (b - a)) * (u - v);
    }
  } // namespace internal
} // namespace NMM
