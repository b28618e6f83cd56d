#ifndef nmm_output_picture_h
#define nmm_output_picture_h

#include <nmm/output/field_samples.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * The content of a picture: coloured quadratic triangles, lines, and bars for contact forces.
   * Vertices are drawn at position + deformation_scale * displacement.
   *
   * The functions `serialize` write or read the content by one of Boost's archives, in which an
   * animation stores its frames.
   */
  struct PictureData
  {
    /// A point of a triangle or line.
    struct Vertex
    {
      /// Position in the reference configuration [m].
      dealii::Point<2> position;
      /// Displacement without scaling [m].
      dealii::Tensor<1, 2> displacement;

      /// Position in a picture with the factor @p scale on displacements [m].
      dealii::Point<2>
      at(const double scale) const
      {
        return position + scale * displacement;
      }

      /// Writes or reads the vertex.
      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &position &displacement;
      }
    };

    /// A quadratic triangle.
    struct Triangle
    {
      /// Vertices in the order of QuadraticTriangle.
      std::array<Vertex, 6> vertices;
      /// Values at the vertices that give the colours, in the unit of the quantity.
      std::array<double, 6> values;

      /// Writes or reads the triangle.
      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &vertices &values;
      }
    };
    /// Vertices that are joined by straight lines, in order.
    using Polyline = std::vector<Vertex>;

    /// A contact traction, drawn as a bar whose length is proportional to it.
    struct Bar
    {
      /// The state of the contact point, which gives the colour of the bar.
      enum Kind
      {
        sticks,
        slips,
        bonded
      };

      /// The contact point, where the bar begins.
      Vertex foot;
      /// Traction on the solid [Pa]; the bar points in this direction.
      dealii::Tensor<1, 2> traction;
      /// Whether the point sticks, slips or is bonded.
      Kind kind = sticks;

      /// Writes or reads the bar.
      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &foot &traction &kind;
      }
    };

    /// The coloured triangles.
    std::vector<Triangle> triangles;
    /// Boundaries and joints.
    std::vector<Polyline> outlines;
    /// Interfaces between materials.
    std::vector<Polyline> interfaces;
    /// Edges of the mathematical mesh.
    std::vector<Polyline> mesh_lines;
    /// Faces of rigid obstacles, which are on the left of the lines.
    std::vector<Polyline> obstacles;
    /// Contact tractions.
    std::vector<Bar> contacts;
    /// Crack tips, which are marked by rings.
    std::vector<Vertex> tips;
    /// Crack faces that have grown during the analysis, drawn in a stronger line.
    std::vector<Polyline> grown_faces;

    /// Values of another quantity at the vertices of the triangles.
    struct Layer
    {
      /// The quantity that the values belong to.
      Quantity quantity;
      /// Values at the six vertices of each triangle, in the order of `triangles`.
      std::vector<std::array<double, 6>> values;

      /// Writes or reads the layer.
      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &quantity &values;
      }
    };
    /// The quantities of PictureParameters::animation_quantities.
    std::vector<Layer> layers;

    /// Factor on displacements [-].
    double deformation_scale = 0.;

    /// Writes or reads all of the content.
    template <typename Archive>
    void
    serialize(Archive &archive, unsigned int)
    {
      archive &triangles &outlines &interfaces &mesh_lines &obstacles &contacts
        &tips &grown_faces &layers &deformation_scale;
    }
  };


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

  /// Factor on displacements [-] with which the largest one appears as 5 % of the @p diagonal of
  /// the solid's box [m] or a little less, and does not close the smallest hole [m]. It is 1, 2 or
  /// 5 times a power of ten, or 0 if displacements are rounding errors.
  double
  choose_deformation_scale(
    double largest_displacement,
    double diagonal,
    double smallest_hole = std::numeric_limits<double>::infinity());

  /// Shorter side of the box around the smallest hole [m]; infinity if there is no hole.
  double
  smallest_hole(const PhysicalMesh &mesh);

  /// Makes the content of a picture and gathers it from all ranks on rank 0. Arcs are sampled
  /// finely. If @p evaluator is null, lines are not displaced. Collective.
  PictureData
  make_picture_data(const CoverSystem       &covers,
                    const FieldTriangles    &triangles,
                    const FieldEvaluator    *evaluator,
                    const PictureParameters &parameters);

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

  /// Colour of the viridis map at @p value in [0, 1], as red, green and blue in [0, 1].
  std::array<double, 3>
  colour_map(double value);

  /// About @p n round numbers in [@p min, @p max], whose distance is 1, 2 or 5 times a
  /// power of ten.
  std::vector<double>
  round_ticks(double min, double max, unsigned int n);

  /// Texts of the ascending numbers @p ticks. They have four digits, or as many as are needed to
  /// distinguish neighbours, but at most twelve.
  std::vector<std::string>
  tick_labels(const std::vector<double> &ticks);
} // namespace NMM

#endif
