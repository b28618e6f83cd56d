#ifndef nmm_tests_quadrature_random_elements_h
#define nmm_tests_quadrature_random_elements_h

#include <nmm/quadrature/element_quadrature.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace NMM
{
  namespace Testing
  {
    using Points = std::vector<dealii::Point<2>>;

    inline ElementEdge
    straight(const dealii::Point<2> &a, const dealii::Point<2> &b)
    {
      ElementEdge edge;
      edge.start = a;
      edge.end   = b;
      return edge;
    }


    /// Arc of |radius| about @p center from angle @p from to @p to; radius < 0
    /// runs clockwise, from > to.
    inline ElementEdge
    arc(const dealii::Point<2> &center,
        const double            radius,
        const double            from,
        const double            to)
    {
      const double r = std::abs(radius);
      ElementEdge  edge =
        straight(center +
                   dealii::Point<2>(r * std::cos(from), r * std::sin(from)),
                 center + dealii::Point<2>(r * std::cos(to), r * std::sin(to)));
      edge.center = center;
      edge.radius = radius;
      return edge;
    }


    inline void
    append_loop(std::vector<ElementEdge> &edges, const Points &loop)
    {
      for (std::size_t i = 0; i < loop.size(); ++i)
        edges.push_back(straight(loop[i], loop[(i + 1) % loop.size()]));
    }


    class RandomElements
    {
    public:
      explicit RandomElements(const unsigned int seed)
        : engine(seed)
      {
      }

      double
      uniform(const double a, const double b)
      {
        return std::uniform_real_distribution<double>(a, b)(engine);
      }

      unsigned int
      integer(const unsigned int a, const unsigned int b)
      {
        return std::uniform_int_distribution<unsigned int>(a, b)(engine);
      }

      /// Counter-clockwise polygon, star-shaped about @p center; concave as soon
      /// as @p r_min is well below @p r_max.
      Points
      star(const dealii::Point<2> &center,
           const double            r_min,
           const double            r_max,
           const unsigned int      n)
      {
        Points       result;
        const double phase = uniform(0., 6.28);
        for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = phase + 2. * M_PI * (i + uniform(-0.2, 0.2)) / n;
          const double r     = uniform(r_min, r_max);
          result.push_back(center + dealii::Point<2>(r * std::cos(angle),
                                                     r * std::sin(angle)));
        }
        return result;
      }

      enum class Shape
      {
        triangle,
        convex,
        concave,
        hole,
        crack_from_boundary,
        inner_crack
      };

      /// In the unit disk.
      std::vector<ElementEdge>
      element(const Shape shape)
      {
        const dealii::Point<2>   o;
        std::vector<ElementEdge> edges;
        switch (shape)
        {
          case Shape::triangle:
            append_loop(edges, star(o, 1., 1., 3));
            break;
          case Shape::convex:
            append_loop(edges, star(o, 1., 1., integer(4, 8)));
            break;
          case Shape::concave:
            append_loop(edges, star(o, 0.2, 1., integer(4, 9)));
            break;
          case Shape::hole: {
            append_loop(edges, star(o, 0.7, 1., integer(4, 7)));
            // inside the incircle of every such polygon
            Points hole = star(o, 0.02, 0.1, integer(3, 5));
            std::reverse(hole.begin(), hole.end());
            append_loop(edges, hole);
            break;
          }
          case Shape::crack_from_boundary: {
            const Points outer = star(o, 0.3, 1., integer(3, 7));
            append_loop(edges, outer);
            // towards the centre of the star nothing is in the way
            const double           t = uniform(0.1, 0.9);
            const dealii::Point<2> tip((1. - t) * outer[0][0],
                                       (1. - t) * outer[0][1]);
            edges.push_back(straight(outer[0], tip));
            edges.push_back(straight(tip, outer[0]));
            break;
          }
          case Shape::inner_crack: {
            append_loop(edges, star(o, 0.7, 1., integer(4, 7)));
            const Points crack = star(o, 0.02, 0.1, 2);
            append_loop(edges, crack);
            break;
          }
        }
        return edges;
      }

      /// A cell somewhere around the unit disk: edges of length about @p size.
      CellFrame
      frame(const double size)
      {
        CellFrame    result;
        const double a = uniform(0., 6.28), b = a + uniform(0.6, 2.2);
        const double s        = size * uniform(0.7, 1.4);
        result.jacobian[0][0] = s * std::cos(a);
        result.jacobian[1][0] = s * std::sin(a);
        result.jacobian[0][1] = size * std::cos(b);
        result.jacobian[1][1] = size * std::sin(b);
        result.origin         = dealii::Point<2>() -
                        0.33 * (result.jacobian * dealii::Point<2>(1., 1.));
        return result;
      }

    private:
      std::mt19937_64 engine;
    };


    /// y = shift + R(angle) diag(1, squeeze) x scale, for vertices, centres of
    /// straight-edged elements.
    inline void
    transform(std::vector<ElementEdge> &edges,
              const double              squeeze,
              const double              angle,
              const double              scale,
              const dealii::Point<2>   &shift)
    {
      const double c = std::cos(angle), s = std::sin(angle);
      for (ElementEdge &edge : edges)
        for (dealii::Point<2> *p : {&edge.start, &edge.end})
        {
          const double x = scale * (*p)[0], y = scale * squeeze * (*p)[1];
          *p = angle == 0.
                 ? shift + dealii::Point<2>(x, y)
                 : shift + dealii::Point<2>(c * x - s * y, s * x + c * y);
        }
    }
  } // namespace Testing
} // namespace NMM

#endif
