#ifndef nmm_output_picture_h
#define nmm_output_picture_h

#include <nmm/output/field_samples.h>
#include <nmm/output/picture_data.h>
#include <nmm/output/picture_scale.h>

#include <deal.II/lac/vector.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * The settings that the pictures of a series share, so that they show the same part of the plane
   * in the same colours, and a note for each of them.
   */
  struct PictureFrame
  {
    /// Part of the plane that is shown, lower and upper corner [m]; if not given, the box of
    /// the deformed triangles. What is outside is cut off.
    std::optional<std::pair<dealii::Point<2>, dealii::Point<2>>> view;
    /// Values at the ends of the colour bar; if not given, those of PictureParameters.
    std::optional<std::pair<double, double>> range;
    /// Traction of the longest contact bar [Pa]; if not given, the largest one in the picture.
    std::optional<double> bar_scale;
    /// Text to the right of the title, e.g. the time.
    std::string note;
    /// Name and unit of what colours the picture; if empty, those of PictureParameters::quantity.
    std::string quantity;
  };


  /**
   * Collects the extents of any number of pictures: the first of two passes over a
   * series. Cost: O(triangles) per picture.
   */
  class PictureExtents
  {
  public:
    /// Adds a picture with its displacements times @p scale [-].
    void
    add(const PictureData &data, double scale);

    /// Lower and upper corner of a box [m] around all deformed triangles so far, and around
    /// obstacles that are near. The box is enlarged by @p margin times its larger side [-] in each
    /// direction. It is the unit box if there are no triangles.
    std::pair<dealii::Point<2>, dealii::Point<2>>
    view(double margin = 0.) const;

    /// Smallest and largest finite value so far; (0, 0) if there is none. They are equal if they
    /// differ by rounding errors only. Triangles smaller than a thousandth of the solid
    /// are left out, unless all are.
    std::pair<double, double>
    range() const;

    /// Largest displacement of a vertex of a triangle, without scaling [m].
    double
    largest_displacement() const;

    /// Largest contact traction [Pa]; 0 if there is none.
    double
    largest_traction() const;

  private:
    dealii::Point<2> lower{1e300, 1e300}, upper{-1e300, -1e300};
    /// Bounding box of obstacles [m].
    dealii::Point<2> rigid_lower{1e300, 1e300}, rigid_upper{-1e300, -1e300};
    double           traction = 0.;
    double           minimum = 1e300, maximum = -1e300;
    double           largest = 0.;
  };

  /**
   * Draws a picture into the PNG file @p file_name: the triangles with smooth shading in a
   * perceptually uniform colour map, lines over them, title and colour bar. Two pictures with the
   * same width and the same view in @p frame have the same size.
   * @throws OutputFailure if the file cannot be written.
   */
  void
  draw_picture(const PictureData       &data,
               const PictureParameters &parameters,
               const std::string       &title,
               const std::string       &file_name,
               const PictureFrame      &frame = {});

  /// Draws the same picture and returns the bytes of the PNG file. It has no alpha channel, and
  /// @p n_colours steps of the colour map; fewer steps make the file smaller.
  std::string
  draw_picture_in_memory(const PictureData       &data,
                         const PictureParameters &parameters,
                         const std::string       &title,
                         const PictureFrame      &frame     = {},
                         unsigned int             n_colours = 1024);

  /**
   * Draws a scalar field with one unknown for each cover, such as a temperature, into the PNG file
   * @p file_name. @p unknowns are those of all covers, on each rank; @p quantity is name and unit
   * of the field, for the colour bar. Collective.
   * @throws OutputFailure if the file cannot be written.
   */
  void
  draw_scalar_picture(const CoverSystem            &covers,
                      const dealii::Vector<double> &unknowns,
                      const std::string            &quantity,
                      const std::string            &title,
                      const std::string            &file_name);
} // namespace NMM

#endif
