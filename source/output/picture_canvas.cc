#include <algorithm>
#include <array>
#include <cmath>
#include <output/picture_canvas.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;

    namespace
    {
      /**
     * Fill a straight triangle with linearly varying values in [0, 1]. Each
     * pixel whose centre lies in it, or outside an edge by less than half a
     * pixel, is set: neighbours leave no seam and slivers do not vanish.
     * Outlines drawn later cover the rim.
     */
      void
      fill_triangle(const std::array<Point<2>, 3>    &p,
                    const std::array<double, 3>      &values,
                    const std::vector<std::uint32_t> &colours,
                    Canvas                           &canvas)
      {
        const double determinant = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                                   (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
        if (determinant == 0.)
          return;
        const auto [x_min, x_max] = std::minmax({p[0][0], p[1][0], p[2][0]});
        const auto [y_min, y_max] = std::minmax({p[0][1], p[1][1], p[2][1]});
        // Pixel i covers [i, i + 1].
        const auto pixel = [](const double x, const int first, const int last) {
          // The number is clamped first, since far outside it does not fit in an int.
          return static_cast<int>(
            std::floor(std::min<double>(std::max<double>(x, first), last)));
        };
        const int first_x = pixel(x_min, canvas.left, canvas.right + 1);
        const int last_x  = pixel(x_max, canvas.left - 1, canvas.right);
        const int first_y = pixel(y_min, canvas.top, canvas.bottom + 1);
        const int last_y  = pixel(y_max, canvas.top - 1, canvas.bottom);
        // Half a pixel across an edge, as a change of the barycentric coordinate of the opposite
        // corner.
        const auto slack = [&](const unsigned int i, const unsigned int j) {
          return 0.5 * p[i].distance(p[j]) / std::abs(determinant);
        };
        const double slack_0 = slack(1, 2);
        const double slack_1 = slack(2, 0);
        const double slack_2 = slack(0, 1);

        for (int y = first_y; y <= last_y; ++y)
          for (int x = first_x; x <= last_x; ++x)
          {
            const double dx = x + 0.5 - p[0][0];
            const double dy = y + 0.5 - p[0][1];
            const double l1 =
              (dx * (p[2][1] - p[0][1]) - dy * (p[2][0] - p[0][0])) /
              determinant;
            const double l2 =
              (dy * (p[1][0] - p[0][0]) - dx * (p[1][1] - p[0][1])) /
              determinant;
            if (l1 < -slack_1 || l2 < -slack_2 || l1 + l2 > 1. + slack_0)
              continue;
            const double value = values[0] + l1 * (values[1] - values[0]) +
                                 l2 * (values[2] - values[0]);
            const double position = std::min(1., std::max(0., value)) *
                                    (static_cast<double>(colours.size()) - 1.);
            canvas.set(x, y, colours[static_cast<std::size_t>(position + 0.5)]);
          }
      }


      /// The six quadratic shape functions, with nodes in the order of QuadraticTriangle.
      std::array<double, 6>
      shape_functions(const double l1, const double l2)
      {
        const double l0 = 1. - l1 - l2;
        return {{l0 * (2. * l0 - 1.),
                 l1 * (2. * l1 - 1.),
                 l2 * (2. * l2 - 1.),
                 4. * l0 * l1,
                 4. * l1 * l2,
                 4. * l2 * l0}};
      }
    } // namespace


    std::vector<std::uint32_t>
    make_colour_table(const unsigned int n_colours)
    {
      std::vector<std::uint32_t> table(std::max(2u, n_colours));
      for (std::size_t i = 0; i < table.size(); ++i)
      {
        const auto    rgb    = colour_map(static_cast<double>(i) /
                                    (static_cast<double>(table.size()) - 1.));
        std::uint32_t colour = 0xff;
        for (const double part : rgb)
          colour =
            (colour << 8) | static_cast<std::uint32_t>(255. * part + 0.5);
        table[i] = colour;
      }
      return table;
    }


    /// The triangle is split into straight triangles of a few pixels, which are filled.
    void
    fill_quadratic_triangle(const PictureData::Triangle      &triangle,
                            const Layout                     &layout,
                            const double                      scale,
                            const std::pair<double, double>  &span,
                            const std::vector<std::uint32_t> &colours,
                            Canvas                           &canvas)
    {
      std::array<Point<2>, 6> nodes;
      for (unsigned int k = 0; k < 6; ++k)
        nodes[k] = triangle.vertices[k].at(scale);
      double longest = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        longest =
          std::max(longest,
                   layout.scale * nodes[i].distance(nodes[(i + 1) % 3]));
      const int n =
        std::min(12, std::max(2, static_cast<int>(std::ceil(longest / 10.))));

      const auto at = [&](const int i, const int j) {
        const auto shape = shape_functions(static_cast<double>(i) / n,
                                           static_cast<double>(j) / n);
        Point<2>   x;
        double     value = 0.;
        for (unsigned int k = 0; k < 6; ++k)
        {
          x += shape[k] * nodes[k];
          value += shape[k] * triangle.values[k];
        }
        return std::make_pair(layout(x), (value - span.first) / span.second);
      };
      for (int j = 0; j < n; ++j)
        for (int i = 0; i + j < n; ++i)
        {
          const auto a = at(i, j), b = at(i + 1, j), c = at(i, j + 1);
          fill_triangle({{a.first, b.first, c.first}},
                        {{a.second, b.second, c.second}},
                        colours,
                        canvas);
          if (i + j + 1 < n)
          {
            const auto d = at(i + 1, j + 1);
            fill_triangle({{b.first, d.first, c.first}},
                          {{b.second, d.second, c.second}},
                          colours,
                          canvas);
          }
        }
    }
  } // namespace internal
} // namespace NMM
