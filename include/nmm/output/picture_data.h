#ifndef nmm_output_picture_data_h
#define nmm_output_picture_data_h

#include <nmm/output/field_samples.h>

#include <array>
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

    /// A part of a bolt, drawn in a line whose width shows its force.
    struct BoltLine
    {
      /// The line.
      Polyline line;
      /// Axial force of one bolt, positive in tension [N].
      double force = 0.;

      /// Writes or reads the line.
      template <typename Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &line &force;
      }
    };
    /// Bolts and anchors.
    std::vector<BoltLine> bolts;

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
        &tips &grown_faces &bolts &layers &deformation_scale;
    }
  };


  /// Makes the content of a picture and gathers it from all ranks on rank 0. Arcs are sampled
  /// finely. If @p evaluator is null, lines are not displaced. Collective.
  PictureData
  make_picture_data(const CoverSystem       &covers,
                    const FieldTriangles    &triangles,
                    const FieldEvaluator    *evaluator,
                    const PictureParameters &parameters);
} // namespace NMM

#endif
