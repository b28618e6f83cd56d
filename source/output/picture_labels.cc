#include <algorithm>
#include <cmath>
#include <map>
#include <output/picture_labels.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;

    void
    draw_text(cairo_t           *cr,
              const std::string &text,
              const double       x,
              const double       y,
              const TextStyle   &style)
    {
      cairo_select_font_face(cr,
                             "sans-serif",
                             CAIRO_FONT_SLANT_NORMAL,
                             style.is_bold ? CAIRO_FONT_WEIGHT_BOLD
                                           : CAIRO_FONT_WEIGHT_NORMAL);
      cairo_set_font_size(cr, style.size);
      cairo_text_extents_t extents;
      cairo_text_extents(cr, text.c_str(), &extents);
      if (extents.x_advance > style.max_width)
        cairo_set_font_size(cr,
                            style.size * style.max_width / extents.x_advance);
      cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
      cairo_move_to(cr,
                    style.is_right_adjusted
                      ? x + std::max(0., style.max_width - extents.x_advance)
                      : x,
                    y);
      cairo_show_text(cr, text.c_str());
    }


    void
    draw_length_scale(cairo_t           *cr,
                      const Layout      &layout,
                      const std::string &unit)
    {
      const double u       = layout.unit;
      const double longest = 0.2 * layout.plot_width / layout.scale;
      const double power   = std::pow(10., std::floor(std::log10(longest)));
      double       length  = power;
      for (const double factor : {2., 5.})
        if (factor * power <= longest)
          length = factor * power;
      const double end   = layout.left + layout.plot_width;
      const double start = end - length * layout.scale;
      const double y     = layout.height - 9. * u;
      cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
      cairo_set_line_width(cr, 1.4 * u);
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
      cairo_move_to(cr, start, y - 5. * u);
      cairo_line_to(cr, start, y);
      cairo_line_to(cr, end, y);
      cairo_line_to(cr, end, y - 5. * u);
      cairo_stroke(cr);
      constexpr double text_width = 110.;
      draw_text(cr,
                number_text(length) + ' ' + unit,
                start - (text_width + 8.) * u,
                y,
                {15. * u, text_width * u, false, true});
    }


    void
    draw_names(cairo_t                         *cr,
               const Layout                    &layout,
               const double                     x,
               const std::pair<double, double> &range,
               const std::vector<std::string>  &names)
    {
      const double u     = layout.unit;
      const double width = range.second - range.first;
      const double line  = std::min(26. * u, layout.plot_height / names.size());
      const auto   first = static_cast<unsigned int>(range.first);
      for (unsigned int i = first; i < names.size() && i <= range.second; ++i)
      {
        const double y = layout.top + (i - first) * line;
        const auto   colour =
          colour_map(width > 0. ? (i - range.first) / width : 0.);
        cairo_rectangle(cr, x, y, 26. * u, 0.7 * line);
        cairo_set_source_rgb(cr, colour[0], colour[1], colour[2]);
        cairo_fill_preserve(cr);
        cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
        cairo_set_line_width(cr, u);
        cairo_stroke(cr);
        draw_text(cr,
                  names[i],
                  x + 35. * u,
                  y + 0.6 * line,
                  {std::min(15. * u, 0.7 * line), 90. * u});
      }
    }


    void
    draw_block_numbers(cairo_t           *cr,
                       const PictureData &data,
                       const Layout      &layout)
    {
      // Area [pixels] and first moments of each block.
      std::map<int, std::array<double, 3>> blocks;
      for (const PictureData::Triangle &triangle : data.triangles)
      {
        std::array<Point<2>, 3> x;
        for (unsigned int i = 0; i < 3; ++i)
          x[i] = layout(triangle.vertices[i].at(data.deformation_scale));
        const dealii::Tensor<1, 2> a = x[1] - x[0], b = x[2] - x[0];
        const double area = 0.5 * std::abs(a[0] * b[1] - a[1] * b[0]);
        auto &block = blocks[static_cast<int>(std::lround(triangle.values[0]))];
        block[0] += area;
        for (unsigned int d = 0; d < 2; ++d)
          block[1 + d] += area * (x[0][d] + x[1][d] + x[2][d]) / 3.;
      }
      cairo_save(cr);
      cairo_rectangle(
        cr, layout.left, layout.top, layout.plot_width, layout.plot_height);
      cairo_clip(cr);
      const double size = 15. * layout.unit;
      for (const auto &[number, block] : blocks)
        if (block[0] > 4. * size * size)
        {
          const std::string    text = std::to_string(number);
          cairo_text_extents_t extents;
          cairo_set_font_size(cr, size);
          cairo_text_extents(cr, text.c_str(), &extents);
          const double x = block[1] / block[0] - 0.5 * extents.x_advance,
                       y = block[2] / block[0] + 0.4 * size;
          // The number is dark, so that it needs a light ground on dark colours.
          cairo_set_source_rgba(cr, 1., 1., 1., 0.7);
          cairo_rectangle(cr,
                          x - 0.2 * size,
                          y - 0.95 * size,
                          extents.x_advance + 0.4 * size,
                          1.2 * size);
          cairo_fill(cr);
          draw_text(cr, text, x, y, {size, 10. * size});
        }
      cairo_restore(cr);
    }
  } // namespace internal
} // namespace NMM
