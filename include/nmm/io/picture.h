#ifndef nmm_io_picture_h
#define nmm_io_picture_h

#include <nmm/io/field_samples.h>

#include <array>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * What a picture shows: coloured quadratic triangles and lines, all on the
   * deformed shape [m].
   */
  struct PictureData
  {
    struct Triangle
    {
      QuadraticTriangle     nodes;
      std::array<double, 6> values;
    };
    using Polyline = std::vector<dealii::Point<2>>;

    std::vector<Triangle> triangles;
    /// Boundaries and joints, interfaces, lines of the mathematical mesh.
    std::vector<Polyline> outlines, interfaces, mesh_lines;
    /// Factor on displacements [-].
    double deformation_scale = 0.;
  };

  /// Collect what all ranks have to draw on rank 0. Arcs are sampled finely.
  PictureData
  make_picture_data(const CoverSystem      &covers,
                    const FieldTriangles   &triangles,
                    const FieldEvaluator   *evaluator,
                    const OutputParameters &parameters);

  /**
   * Draw a PNG: the triangles with smooth shading in a perceptually uniform
   * colour map, lines over them, title and colour bar.
   * @throws ExcFileNotOpen-like deal.II exceptions if the file cannot be written.
   */
  void
  draw_picture(const PictureData      &data,
               const OutputParameters &parameters,
               const std::string      &title,
               const std::string      &file_name);

  /// Colour of @p value in [0, 1] as red, green, blue in [0, 1] (viridis).
  std::array<double, 3>
  colour_map(double value);

  /// Round numbers in [@p min, @p max], about @p n of them: 1, 2 or 5 times a
  /// power of ten apart.
  std::vector<double>
  round_ticks(double min, double max, unsigned int n);
} // namespace NMM

#endif
