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
   * What a picture shows: coloured quadratic triangles and lines, each vertex with
   * its place in the reference configuration and its displacement [m]. Drawn at
   * position + deformation_scale * displacement.
   */
  struct PictureData
  {
    struct Vertex
    {
      dealii::Point<2>     position;
      dealii::Tensor<1, 2> displacement;

      dealii::Point<2>
      at(const double scale) const
      {
        return position + scale * displacement;
      }

      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &position &displacement;
      }
    };

    /// Vertices in the order of QuadraticTriangle.
    struct Triangle
    {
      std::array<Vertex, 6> vertices;
      std::array<double, 6> values;

      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &vertices &values;
      }
    };
    using Polyline = std::vector<Vertex>;

    /// A force between faces, shown as a bar.
    struct Bar
    {
      enum Kind
      {
        sticks,
        slips,
        bonded
      };

      Vertex foot;
      /// Traction on the face [Pa].
      dealii::Tensor<1, 2> traction;
      Kind                 kind = sticks;

      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &foot &traction &kind;
      }
    };

    std::vector<Triangle> triangles;
    /// Boundaries and joints, interfaces, lines of the mathematical mesh, and of
    /// rigid obstacles, which are on the left.
    std::vector<Polyline> outlines, interfaces, mesh_lines, obstacles;
    std::vector<Bar>      contacts;

    /// Other values of the triangles, in their order.
    struct Layer
    {
      Quantity                           quantity;
      std::vector<std::array<double, 6>> values;

      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &quantity &values;
      }
    };
    /// Those of PictureParameters::animation_quantities.
    std::vector<Layer> layers;

    /// Factor on displacements [-].
    double deformation_scale = 0.;

    /// For Boost's archives, in which an animation keeps its frames.
    template <typename Archive>
    void
    serialize(Archive &archive, unsigned int)
    {
      archive &triangles &outlines &interfaces &mesh_lines &obstacles &contacts
        &layers &deformation_scale;
    }
  };


  /**
   * What pictures of one series have in common, so that they can follow each
   * other in the same place and in the same colours, and what one of them says
   * beside its title.
   */
  struct PictureFrame
  {
    /// Part of the plane that is shown, lower and upper corner [m]; else that of
    /// the deformed triangles. What is outside is cut off.
    std::optional<std::pair<dealii::Point<2>, dealii::Point<2>>> view;
    /// Values at the ends of the colour bar; else those of PictureParameters.
    std::optional<std::pair<double, double>> range;
    /// Traction that the longest bar of contact stands for [Pa]; else the largest
    /// one there is.
    std::optional<double> bar_scale;
    /// Right of the title, e.g. the time.
    std::string note;
  };


  /**
   * What any number of pictures span together: the first of two passes over a
   * series. Cost: O(triangles) per picture.
   */
  class PictureExtents
  {
  public:
    /// Add a picture with its displacements times @p scale.
    void
    add(const PictureData &data, double scale);

    /// Box of all deformed triangles so far, and of obstacles as far as they are
    /// near, wider by @p margin of its larger side in each direction [m]; a unit
    /// box if there are none.
    std::pair<dealii::Point<2>, dealii::Point<2>>
    view(double margin = 0.) const;

    /// Smallest and largest finite value so far; a constant is not spread by its
    /// rounding errors. (0, 0) if there are none. Triangles smaller than a thousandth of all do
    /// not count, unless all are.
    std::pair<double, double>
    range() const;

    /// Largest displacement of a triangle's vertex, not scaled [m].
    double
    largest_displacement() const;

    /// Largest traction in contact [Pa].
    double
    largest_traction() const;

  private:
    dealii::Point<2> lower{1e300, 1e300}, upper{-1e300, -1e300};
    /// Bounding box of obstacles [m]; then ranges of what is drawn.
    dealii::Point<2> rigid_lower{1e300, 1e300}, rigid_upper{-1e300, -1e300};
    double           traction = 0.;
    double           minimum = 1e300, maximum = -1e300;
    double           largest = 0.;
  };

  /// Factor on displacements that makes the largest one 5 % of the diagonal of the
  /// solid's box or a little less: 1, 2 or 5 times a power of ten; 0 where
  /// displacements are rounding errors.
  double
  choose_deformation_scale(
    double largest_displacement,
    double diagonal,
    double smallest_hole = std::numeric_limits<double>::infinity());

  /// Shorter side of the box around the smallest hole; infinity: there is none [m].
  double
  smallest_hole(const PhysicalMesh &mesh);

  /// Collect what all ranks have to draw on rank 0. Arcs are sampled finely.
  PictureData
  make_picture_data(const CoverSystem       &covers,
                    const FieldTriangles    &triangles,
                    const FieldEvaluator    *evaluator,
                    const PictureParameters &parameters);

  /**
   * Draw a PNG: the triangles with smooth shading in a perceptually uniform
   * colour map, lines over them, title and colour bar. Two pictures with the same
   * width and the same view in @p frame have the same size.
   * @throws OutputFailure.
   */
  void
  draw_picture(const PictureData       &data,
               const PictureParameters &parameters,
               const std::string       &title,
               const std::string       &file_name,
               const PictureFrame      &frame = {});

  /// The same as the bytes of a PNG file. Without alpha channel, and with
  /// @p n_colours steps of the colour map: fewer make a smaller file.
  std::string
  draw_picture_in_memory(const PictureData       &data,
                         const PictureParameters &parameters,
                         const std::string       &title,
                         const PictureFrame      &frame     = {},
                         unsigned int             n_colours = 1024);

  /// Colour of @p value in [0, 1] as red, green, blue in [0, 1] (viridis).
  std::array<double, 3>
  colour_map(double value);

  /// Round numbers in [@p min, @p max], about @p n of them: 1, 2 or 5 times a
  /// power of ten apart.
  std::vector<double>
  round_ticks(double min, double max, unsigned int n);

  /// Texts of ascending numbers: four digits, or as many as it takes to tell
  /// neighbours apart, at most twelve.
  std::vector<std::string>
  tick_labels(const std::vector<double> &ticks);
} // namespace NMM

#endif
