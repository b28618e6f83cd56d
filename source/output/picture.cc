#include <nmm/base/program.h>
#include <nmm/output/picture.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cairo.h>
#include <cmath>
#include <iomanip>
#include <memory>
#include <output/picture_canvas.h>
#include <output/picture_labels.h>
#include <sstream>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using internal::Canvas;
    using internal::draw_text;
    using internal::Layout;
    using internal::number_text;

    /// Width of the space for the colour bar right of the solid [thousandths of the picture width].
    constexpr double bar_space = 160.;


    Layout
    make_layout(const std::pair<Point<2>, Point<2>> &view,
                const unsigned int                   width)
    {
      const auto &[lower, upper] = view;
      Layout layout;
      layout.unit       = width / 1000.;
      layout.left       = 30. * layout.unit;
      layout.top        = 85. * layout.unit;
      layout.plot_width = width - layout.left - bar_space * layout.unit;
      layout.center     = Point<2>(0.5 * (lower + upper));
      const double size = std::max(upper[0] - lower[0], upper[1] - lower[1]);
      const double box_width  = std::max(upper[0] - lower[0], 1e-3 * size);
      const double box_height = std::max(upper[1] - lower[1], 1e-3 * size);
      // The solid is as wide as there is room, unless that makes the picture too tall.
      layout.scale = size > 0. ? std::min(layout.plot_width / box_width,
                                          1000. * layout.unit / box_height)
                               : 1.;
      layout.plot_width =
        std::max(layout.scale * box_width, 420. * layout.unit);
      layout.plot_height =
        std::max(layout.scale * box_height, 320. * layout.unit);
      layout.width = static_cast<int>(
        std::ceil(layout.left + layout.plot_width + bar_space * layout.unit));
      layout.height = static_cast<int>(
        std::ceil(layout.top + layout.plot_height + 30. * layout.unit));
      return layout;
    }


    /// How lines are drawn; the width is in units of the layout.
    struct Stroke
    {
      double                width;
      cairo_line_cap_t      cap;
      std::array<double, 4> colour;
    };


    void
    draw_lines(cairo_t                                  *cr,
               const std::vector<PictureData::Polyline> &lines,
               const Layout                             &layout,
               const double                              scale,
               const Stroke                             &stroke)
    {
      const auto &colour = stroke.colour;
      cairo_set_source_rgba(cr, colour[0], colour[1], colour[2], colour[3]);
      cairo_set_line_width(cr, stroke.width * layout.unit);
      cairo_set_line_cap(cr, stroke.cap);
      cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
      for (const PictureData::Polyline &line : lines)
      {
        for (std::size_t i = 0; i < line.size(); ++i)
        {
          const Point<2> x = layout(line[i].at(scale));
          if (i == 0)
            cairo_move_to(cr, x[0], x[1]);
          else
            cairo_line_to(cr, x[0], x[1]);
        }
        cairo_stroke(cr);
      }
    }


    /// Exponent of the power of ten that is taken out of the numbers at the colour bar, a multiple
    /// of three; 0 if the largest one is in [0.1, 1e4).
    int
    choose_exponent(const double minimum, const double maximum)
    {
      const double largest = std::max(std::abs(minimum), std::abs(maximum));
      if (largest == 0. || (largest >= 0.1 && largest < 1e4))
        return 0;
      return 3 * static_cast<int>(std::floor(std::log10(largest) / 3.));
    }


    std::string
    superscript(const int number)
    {
      static const std::array<const char *, 10> digits = {
        {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"}};
      std::string text = number < 0 ? "⁻" : "";
      for (const char c : std::to_string(std::abs(number)))
        text += digits[c - '0'];
      return text;
    }


    /// Draws a triangle at an end of the colour bar, which shows that values lie beyond it. Its
    /// base of this @p width is at (@p x, @p y) [pixels]; it is as high as @p height, downwards
    /// if that is positive.
    void
    draw_end_of_bar(cairo_t                     *cr,
                    const Point<2>              &x,
                    const double                 width,
                    const double                 height,
                    const std::array<double, 3> &colour)
    {
      cairo_move_to(cr, x[0], x[1]);
      cairo_line_to(cr, x[0] + 0.5 * width, x[1] + height);
      cairo_line_to(cr, x[0] + width, x[1]);
      cairo_close_path(cr);
      cairo_set_source_rgb(cr, colour[0], colour[1], colour[2]);
      cairo_fill_preserve(cr);
      cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
      cairo_stroke(cr);
    }


    /// Draws the colour bar. @p values are the least and the largest value in the picture; where
    /// they lie beyond an end of the bar, that ends in a triangle.
    void
    draw_colour_bar(cairo_t                         *cr,
                    const Layout                    &layout,
                    const double                     minimum,
                    const double                     maximum,
                    const std::pair<double, double> &values)
    {
      const double factor = std::pow(10., choose_exponent(minimum, maximum));
      const double u      = layout.unit;
      const double x      = layout.width - (bar_space - 30.) * u;
      const double width  = 26. * u;
      const double height = std::min(layout.plot_height, 560. * u);
      const double y      = layout.top + 0.5 * (layout.plot_height - height);

      const std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)>
                    gradient(cairo_pattern_create_linear(0., y + height, 0., y),
                 &cairo_pattern_destroy);
      constexpr int n_stops = 64;
      for (int i = 0; i <= n_stops; ++i)
      {
        const double t   = static_cast<double>(i) / n_stops;
        const auto   rgb = colour_map(t);
        cairo_pattern_add_color_stop_rgb(
          gradient.get(), t, rgb[0], rgb[1], rgb[2]);
      }
      cairo_rectangle(cr, x, y, width, height);
      cairo_set_source(cr, gradient.get());
      cairo_fill_preserve(cr);
      cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
      cairo_set_line_width(cr, u);
      cairo_stroke(cr);
      const double rounding = 1e-9 * (maximum - minimum);
      if (values.first < minimum - rounding)
        draw_end_of_bar(cr, {x, y + height}, width, 20. * u, colour_map(0.));
      if (values.second > maximum + rounding)
        draw_end_of_bar(cr, {x, y}, width, -20. * u, colour_map(1.));

      // Values that differ by rounding errors only count as equal.
      const double resolution =
        1e-10 * std::max(std::abs(minimum), std::abs(maximum));
      const bool                is_constant = maximum - minimum <= resolution;
      const std::vector<double> ticks =
        round_ticks(minimum, is_constant ? minimum : maximum, 7);
      std::vector<double> shown;
      for (const double tick : ticks)
        shown.push_back(tick / factor);
      const std::vector<std::string> labels = tick_labels(shown);
      for (unsigned int i = 0; i < ticks.size(); ++i)
      {
        const double position =
          is_constant ? 0.5 : (ticks[i] - minimum) / (maximum - minimum);
        const double tick_y = y + height * (1. - position);
        cairo_move_to(cr, x + width, tick_y);
        cairo_line_to(cr, x + width + 5. * u, tick_y);
        cairo_stroke(cr);
        draw_text(cr,
                  labels[i],
                  x + width + 9. * u,
                  tick_y + 5. * u,
                  {15. * u, 105. * u});
      }
    }


    /// The largest force of a bolt, of either sign [N].
    double
    largest_bolt_force(const PictureData &data)
    {
      double largest = 0.;
      for (const PictureData::BoltLine &bolt : data.bolts)
        largest = std::max(largest, std::abs(bolt.force));
      return largest;
    }


    std::string
    subtitle(const PictureData       &data,
             const PictureParameters &parameters,
             const PictureFrame      &frame,
             const int                exponent)
    {
      if (!frame.quantity.empty())
        return frame.quantity +
               (exponent == 0 ? "" : ", in 10" + superscript(exponent));
      const Quantity     quantity = parameters.quantity;
      std::ostringstream text;
      const bool         is_stress = quantity < Quantity::displacement;
      const bool         is_index =
        quantity == Quantity::block || quantity == Quantity::material;
      const std::string unit =
        is_stress ? parameters.stress_unit
        : quantity == Quantity::plastic_strain
          ? "-"
          : parameters.length_unit + (is_velocity(quantity) ? "/s" : "");
      if (is_stress && !parameters.recovered)
        text << "direct ";
      text << to_string(quantity);
      if (!is_index)
      {
        const std::string factor =
          exponent == 0 ? "" : "10" + superscript(exponent);
        const bool has_unit = quantity != Quantity::plastic_strain;
        text << " [" << factor << (has_unit && !factor.empty() ? " " : "")
             << (has_unit || factor.empty() ? unit : "") << ']';
      }
      if (data.deformation_scale != 0.)
      {
        // With this precision numbers below a million have no exponent.
        text << ", displacements × " << std::setprecision(6)
             << data.deformation_scale;
      }
      if (const double largest = largest_bolt_force(data); largest > 0.)
      {
        const int force = choose_exponent(0., largest);
        text << ", bolts up to " << number_text(largest / std::pow(10., force))
             << (force == 0 ? "" : " × 10" + superscript(force)) << ' '
             << parameters.stress_unit << ' ' << parameters.length_unit << "²";
      }
      return text.str();
    }


    /// Values at the ends of the colour bar.
    std::pair<double, double>
    value_range(const PictureExtents    &extents,
                const PictureParameters &parameters,
                const PictureFrame      &frame)
    {
      if (frame.range)
        return *frame.range;
      if (parameters.range_min < parameters.range_max)
        return {parameters.range_min, parameters.range_max};
      return extents.range();
    }


    using Surface =
      std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

    void
    fill(cairo_surface_t                 *surface,
         const PictureData               &data,
         const Layout                    &layout,
         const std::pair<double, double> &span,
         const unsigned int               n_colours)
    {
      cairo_surface_flush(surface);
      const double margin = 10. * layout.unit;
      Canvas       canvas{cairo_image_surface_get_data(surface),
                    cairo_image_surface_get_stride(surface),
                    static_cast<int>(layout.left - margin),
                    static_cast<int>(layout.left + layout.plot_width + margin),
                    static_cast<int>(layout.top - margin),
                    static_cast<int>(layout.top + layout.plot_height + margin)};
      canvas.left        = std::max(canvas.left, 0);
      canvas.top         = std::max(canvas.top, 0);
      canvas.right       = std::min(canvas.right, layout.width - 1);
      canvas.bottom      = std::min(canvas.bottom, layout.height - 1);
      const auto colours = internal::make_colour_table(n_colours);
      for (const PictureData::Triangle &triangle : data.triangles)
        internal::fill_quadratic_triangle(
          triangle, layout, data.deformation_scale, span, colours, canvas);
      cairo_surface_mark_dirty(surface);
    }


    const std::array<double, 3> &
    colour_of_bar(const PictureData::Bar::Kind kind)
    {
      static const std::array<double, 3> colours[] = {{{0.84, 0.10, 0.11}},
                                                      {{1.00, 0.50, 0.05}},
                                                      {{0.85, 0.20, 0.75}}};
      return colours[kind];
    }


    /// Cuts a straight line to the part that lies in the plot. Returns false if no part does.
    bool
    clip_to_plot(const Layout &layout, Point<2> &start, Point<2> &end)
    {
      const double   margin  = 30. * layout.unit;
      const double   low[2]  = {layout.left - margin, layout.top - margin};
      const double   high[2] = {layout.left + layout.plot_width + margin,
                                layout.top + layout.plot_height + margin};
      double         first = 0., last = 1.;
      const Point<2> from          = start;
      const dealii::Tensor<1, 2> d = end - start;
      for (unsigned int c = 0; c < 2; ++c)
      {
        if (d[c] == 0.)
        {
          if (from[c] < low[c] || from[c] > high[c])
            return false;
          continue;
        }
        const double a = (low[c] - from[c]) / d[c];
        const double b = (high[c] - from[c]) / d[c];
        first          = std::max(first, std::min(a, b));
        last           = std::min(last, std::max(a, b));
      }
      if (first >= last)
        return false;
      start = from + first * d;
      end   = from + last * d;
      return true;
    }


    /// Draws the faces of obstacles as lines with hatches on the left, where the rigid body is.
    void
    draw_obstacles(cairo_t *cr, const PictureData &data, const Layout &layout)
    {
      const double u       = layout.unit;
      const double spacing = 9. * u, size = 9. * u;
      cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
      for (const PictureData::Polyline &line : data.obstacles)
      {
        double passed = 0.;
        for (std::size_t i = 1; i < line.size(); ++i)
        {
          Point<2> a = layout(line[i - 1].at(data.deformation_scale));
          Point<2> b = layout(line[i].at(data.deformation_scale));
          if (!clip_to_plot(layout, a, b))
            continue;
          cairo_set_line_width(cr, 2.2 * u);
          cairo_move_to(cr, a[0], a[1]);
          cairo_line_to(cr, b[0], b[1]);
          cairo_stroke(cr);
          const double               length = a.distance(b);
          const dealii::Tensor<1, 2> d      = (b - a) / length;
          // The y-axis of pixels points downwards.
          const Point<2> hatch(size * (d[1] - d[0]), size * (-d[0] - d[1]));
          cairo_set_line_width(cr, 0.9 * u);
          double at = -passed;
          for (; at < length; at += spacing)
            if (at >= 0.)
            {
              const Point<2> x = a + at * d;
              cairo_move_to(cr, x[0], x[1]);
              cairo_line_to(cr, x[0] + hatch[0], x[1] + hatch[1]);
            }
          passed = length - (at - spacing);
          cairo_stroke(cr);
        }
      }
    }


    /// Draws a bar from each contact point in the direction of the traction on the solid.
    void
    draw_bars(cairo_t           *cr,
              const PictureData &data,
              const Layout      &layout,
              const double       largest)
    {
      if (!(largest > 0.))
        return;
      const double longest = 75. * layout.unit;
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
      // All rims are drawn first, since they would cover neighbouring bars.
      for (const bool is_rim : {true, false})
        for (const PictureData::Bar &bar : data.contacts)
        {
          const auto &colour = colour_of_bar(bar.kind);
          if (is_rim)
            cairo_set_source_rgba(cr, 1., 1., 1., 0.5);
          else
            cairo_set_source_rgb(cr, colour[0], colour[1], colour[2]);
          cairo_set_line_width(cr, (is_rim ? 2.8 : 1.6) * layout.unit);
          const Point<2> x      = layout(bar.foot.at(data.deformation_scale));
          const double   factor = longest / largest;
          cairo_move_to(cr, x[0], x[1]);
          cairo_line_to(cr,
                        x[0] + factor * bar.traction[0],
                        x[1] - factor * bar.traction[1]);
          cairo_stroke(cr);
        }
    }


    /// Draws the legend of the bars, right-adjusted beside the subtitle.
    void
    draw_legend_of_bars(cairo_t                 *cr,
                        const PictureData       &data,
                        const Layout            &layout,
                        const double             largest,
                        const PictureParameters &parameters)
    {
      const double      u        = layout.unit;
      const int         exponent = choose_exponent(0., largest);
      const std::string unit =
        (exponent == 0 ? "" : " × 10" + superscript(exponent)) + " " +
        parameters.stress_unit;
      const std::string text = "contact up to " +
                               number_text(largest / std::pow(10., exponent)) +
                               unit;
      static const char *const words[] = {"sticks", "slips", "bonded"};
      double                   x       = layout.width - 30. * u;
      for (int kind = 2; kind >= 0; --kind)
      {
        const bool is_there = std::any_of(data.contacts.begin(),
                                          data.contacts.end(),
                                          [&](const PictureData::Bar &bar) {
                                            return bar.kind == kind;
                                          });
        if (!is_there)
          continue;
        constexpr double text_width = 52., sample_width = 22., gap = 6.;
        x -= text_width * u;
        draw_text(cr, words[kind], x, 63. * u, {15. * u, text_width * u});
        const auto &colour =
          colour_of_bar(static_cast<PictureData::Bar::Kind>(kind));
        cairo_set_source_rgb(cr, colour[0], colour[1], colour[2]);
        cairo_set_line_width(cr, 3. * u);
        cairo_move_to(cr, x - gap * u, 58. * u);
        cairo_line_to(cr, x - (gap + sample_width) * u, 58. * u);
        cairo_stroke(cr);
        x -= (2. * gap + sample_width + 4.) * u;
      }
      draw_text(
        cr, text, x - 260. * u, 63. * u, {15. * u, 260. * u, false, true});
    }


    /// Draws a dark ring with a white rim about @p x [pixels]. The field at @p x remains visible.
    void
    draw_ring(cairo_t *cr, const Point<2> &x, const double unit)
    {
      for (const bool is_rim : {true, false})
      {
        if (is_rim)
          cairo_set_source_rgba(cr, 1., 1., 1., 0.8);
        else
          cairo_set_source_rgb(cr, 0.05, 0.05, 0.05);
        cairo_set_line_width(cr, (is_rim ? 3.4 : 1.4) * unit);
        cairo_new_sub_path(cr);
        cairo_arc(cr, x[0], x[1], 5. * unit, 0., 2. * dealii::numbers::PI);
        cairo_stroke(cr);
      }
    }


    /// Width of the lines of grown faces [thousandths of the picture width].
    constexpr double grown_face_width = 3.2;


    /// Width of a bolt without force, and what the largest force adds [thousandths of the picture
    /// width].
    constexpr double bolt_width = 1.2, bolt_width_of_force = 4.;


    /// White without force, orange in tension and blue in compression. Red are forces of contact.
    std::array<double, 4>
    bolt_colour(const double share)
    {
      const double rest = 1. - std::min(1., std::abs(share));
      return share >= 0.
               ? std::array<double, 4>{{1., 0.55 + 0.45 * rest, rest, 1.}}
               : std::array<double, 4>{{rest, rest, 1., 1.}};
    }


    /// The legend of crack tips and grown faces, below the plot.
    void
    draw_legend_of_cracks(cairo_t           *cr,
                          const PictureData &data,
                          const Layout      &layout)
    {
      const double u = layout.unit, y = layout.height - 10. * u;
      double       x = 30. * u;
      if (!data.tips.empty())
      {
        draw_ring(cr, Point<2>(x + 7. * u, y), u);
        draw_text(cr, "crack tip", x + 20. * u, y + 5. * u, {15. * u, 90. * u});
        x += 120. * u;
      }
      if (data.grown_faces.empty())
        return;
      cairo_set_line_width(cr, grown_face_width * u);
      cairo_move_to(cr, x, y);
      cairo_line_to(cr, x + 22. * u, y);
      cairo_stroke(cr);
      draw_text(
        cr, "grown crack", x + 30. * u, y + 5. * u, {15. * u, 110. * u});
    }


    void
    draw_all_lines(cairo_t           *cr,
                   const PictureData &data,
                   const Layout      &layout,
                   const double       largest_traction)
    {
      const double scale  = data.deformation_scale;
      const double margin = 10. * layout.unit;
      cairo_save(cr);
      cairo_rectangle(cr,
                      layout.left - margin,
                      layout.top - margin,
                      layout.plot_width + 2. * margin,
                      layout.plot_height + 2. * margin);
      cairo_clip(cr);
      draw_lines(cr,
                 data.mesh_lines,
                 layout,
                 scale,
                 {0.4, CAIRO_LINE_CAP_BUTT, {{1., 1., 1., 0.35}}});
      draw_lines(cr,
                 data.interfaces,
                 layout,
                 scale,
                 {1., CAIRO_LINE_CAP_BUTT, {{0.9, 0.9, 0.9, 0.9}}});
      draw_lines(cr,
                 data.outlines,
                 layout,
                 scale,
                 {1.4, CAIRO_LINE_CAP_ROUND, {{0.05, 0.05, 0.05, 1.}}});
      draw_lines(cr,
                 data.grown_faces,
                 layout,
                 scale,
                 {grown_face_width,
                  CAIRO_LINE_CAP_ROUND,
                  {{0.05, 0.05, 0.05, 1.}}});
      const double largest = largest_bolt_force(data);
      for (const PictureData::BoltLine &bolt : data.bolts)
      {
        const double share = largest > 0. ? bolt.force / largest : 0.;
        draw_lines(cr,
                   {bolt.line},
                   layout,
                   scale,
                   {bolt_width + bolt_width_of_force * std::abs(share),
                    CAIRO_LINE_CAP_BUTT,
                    bolt_colour(share)});
      }
      draw_obstacles(cr, data, layout);
      draw_bars(cr, data, layout, largest_traction);
      for (const PictureData::Vertex &tip : data.tips)
        draw_ring(cr, layout(tip.at(scale)), layout.unit);
      cairo_restore(cr);
    }


    Surface
    draw(const PictureData       &data,
         const PictureParameters &parameters,
         const std::string       &title,
         const PictureFrame      &frame,
         const unsigned int       n_colours)
    {
      PictureExtents extents;
      extents.add(data, data.deformation_scale);
      auto view = frame.view ? *frame.view : extents.view();
      if (const std::vector<double> &w = parameters.window; !w.empty())
        view = {{w[0], w[1]}, {w[2], w[3]}};
      const Layout layout = make_layout(view, parameters.picture_width);
      const auto [minimum, maximum] = value_range(extents, parameters, frame);

      Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                 layout.width,
                                                 layout.height),
                      &cairo_surface_destroy);
      const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr(
        cairo_create(surface.get()), &cairo_destroy);
      cairo_set_source_rgb(cr.get(), 1., 1., 1.);
      cairo_paint(cr.get());
      fill(surface.get(),
           data,
           layout,
           {minimum, maximum > minimum ? maximum - minimum : 1.},
           n_colours);
      const double largest =
        frame.bar_scale ? *frame.bar_scale : extents.largest_traction();
      draw_all_lines(cr.get(), data, layout, largest);

      const double u          = layout.unit;
      const double width      = layout.width - 60. * u;
      const double note_width = frame.note.empty() ? 0. : 0.35 * width;
      draw_text(
        cr.get(), title, 30. * u, 36. * u, {24. * u, width - note_width, true});
      if (!frame.note.empty())
        draw_text(cr.get(),
                  frame.note,
                  30. * u + width - note_width + 10. * u,
                  36. * u,
                  {22. * u, note_width - 10. * u, false, true});
      draw_text(
        cr.get(),
        subtitle(data, parameters, frame, choose_exponent(minimum, maximum)),
        30. * u,
        63. * u,
        {17. * u, data.contacts.empty() ? width : 0.52 * width});
      if (!data.contacts.empty())
        draw_legend_of_bars(cr.get(), data, layout, largest, parameters);
      draw_legend_of_cracks(cr.get(), data, layout);
      internal::draw_length_scale(cr.get(), layout, parameters.length_unit);
      if (parameters.quantity == Quantity::block)
        internal::draw_block_numbers(cr.get(), data, layout);
      if (parameters.quantity == Quantity::material &&
          !parameters.material_names.empty())
        internal::draw_names(cr.get(),
                             layout,
                             layout.width - (bar_space - 30.) * u,
                             {minimum, maximum},
                             parameters.material_names);
      else
        draw_colour_bar(cr.get(), layout, minimum, maximum, extents.range());
      cairo_surface_flush(surface.get());
      return surface;
    }


    cairo_status_t
    append(void *closure, const unsigned char *data, const unsigned int length)
    {
      static_cast<std::string *>(closure)->append(
        reinterpret_cast<const char *>(data), length);
      return CAIRO_STATUS_SUCCESS;
    }
  } // namespace


  void
  draw_picture(const PictureData       &data,
               const PictureParameters &parameters,
               const std::string       &title,
               const std::string       &file_name,
               const PictureFrame      &frame)
  {
    const Surface        surface = draw(data, parameters, title, frame, 1024);
    const cairo_status_t status =
      cairo_surface_write_to_png(surface.get(), file_name.c_str());
    AssertThrow(status == CAIRO_STATUS_SUCCESS, OutputFailure(file_name));
  }


  std::string
  draw_picture_in_memory(const PictureData       &data,
                         const PictureParameters &parameters,
                         const std::string       &title,
                         const PictureFrame      &frame,
                         const unsigned int       n_colours)
  {
    const Surface surface = draw(data, parameters, title, frame, n_colours);
    std::string   bytes;
    const cairo_status_t status =
      cairo_surface_write_to_png_stream(surface.get(), &append, &bytes);
    AssertThrow(status == CAIRO_STATUS_SUCCESS,
                dealii::ExcMessage(std::string("A picture cannot be made: ") +
                                   cairo_status_to_string(status)));
    return bytes;
  }
} // namespace NMM
