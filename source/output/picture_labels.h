#ifndef nmm_source_output_picture_labels_h
#define nmm_source_output_picture_labels_h

#include <cairo.h>
#include <output/picture_canvas.h>
#include <output/picture_scale.h>
#include <string>
#include <vector>

/// Texts of pictures, and what explains a picture beside its colour bar.
namespace NMM
{
  namespace internal
  {
    /// How a text is drawn: smaller than `size` if it would be wider than `max_width` [pixels].
    struct TextStyle
    {
      double size, max_width;
      bool   is_bold           = false;
      bool   is_right_adjusted = false;
    };

    /// Draws @p text with its base line at (@p x, @p y).
    void
    draw_text(cairo_t           *cr,
              const std::string &text,
              double             x,
              double             y,
              const TextStyle   &style);

    /// Draws a bar of a round length in the undeformed solid, at the right end below the plot.
    void
    draw_length_scale(cairo_t           *cr,
                      const Layout      &layout,
                      const std::string &unit);

    /// Draws a box in the colour of each material, with its name, at @p x from the left [pixels].
    /// The colour table spans numbers from @p minimum to @p maximum.
    void
    draw_names(cairo_t                         *cr,
               const Layout                    &layout,
               double                           x,
               const std::pair<double, double> &range,
               const std::vector<std::string>  &names);

    /// Writes the number of each block in its middle, where there is room.
    void
    draw_block_numbers(cairo_t           *cr,
                       const PictureData &data,
                       const Layout      &layout);
  } // namespace internal
} // namespace NMM

#endif
