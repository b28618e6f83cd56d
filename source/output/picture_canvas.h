#ifndef nmm_source_output_picture_canvas_h
#define nmm_source_output_picture_canvas_h

#include <nmm/output/picture_data.h>
#include <nmm/output/picture_scale.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The layout of a picture [pixels], and the map from the plane [m] to pixels.
    struct Layout
    {
      int width, height;
      /// A thousandth of the width, with which line widths and fonts scale.
      double           unit;
      double           left, top, plot_width, plot_height;
      double           scale;
      dealii::Point<2> lower, center;

      dealii::Point<2>
      operator()(const dealii::Point<2> &x) const
      {
        return {left + 0.5 * plot_width + scale * (x[0] - center[0]),
                top + 0.5 * plot_height - scale * (x[1] - center[1])};
      }
    };


    /// A pixel image in Cairo's format ARGB32, with native byte order.
    struct Canvas
    {
      unsigned char *pixels;
      int            stride;
      /// First and last pixels that may be set.
      int left, right, top, bottom;

      void
      set(const int x, const int y, const std::uint32_t colour)
      {
        reinterpret_cast<std::uint32_t *>(pixels + y * stride)[x] = colour;
      }
    };


    /// @p n_colours equally spaced colours of colour_map(), as pixels.
    std::vector<std::uint32_t>
    make_colour_table(unsigned int n_colours);


    /// Fills a triangle with the colours of its values; the table spans the values from
    /// @p span.first on, over a width of @p span.second. @p scale is the factor on displacements.
    void
    fill_quadratic_triangle(const PictureData::Triangle      &triangle,
                            const Layout                     &layout,
                            double                            scale,
                            const std::pair<double, double>  &span,
                            const std::vector<std::uint32_t> &colours,
                            Canvas                           &canvas);
  } // namespace internal
} // namespace NMM

#endif
