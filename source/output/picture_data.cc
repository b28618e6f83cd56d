#include <nmm/covers/point_location.h>
#include <nmm/output/picture_data.h>
#include <nmm/output/picture_scale.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using Polyline = PictureData::Polyline;
    using Vertex   = PictureData::Vertex;

    double
    choose_scale(const CoverSystem       &covers,
                 const FieldTriangles    &triangles,
                 const PictureParameters &parameters)
    {
      if (parameters.deformation_scale >= 0.)
        return parameters.deformation_scale;
      const double largest = triangles.max_displacement(covers.communicator());
      const auto  &corners = covers.manifold_mesh()
                              .physical_mesh()
                              .bounding_box()
                              .get_boundary_points();
      const double size = corners.first.distance(corners.second);
      return choose_deformation_scale(
        largest, size, smallest_hole(covers.manifold_mesh().physical_mesh()));
    }


    /// Points along an edge, ends included, close enough to show its curvature
    /// and the displacement's.
    std::vector<Point<2>>
    sample_edge(const ElementEdge &edge)
    {
      std::vector<Point<2>> line;
      if (!edge.is_arc())
      {
        constexpr unsigned int n = 4;
        for (unsigned int k = 0; k <= n; ++k)
          line.push_back(edge.start + (static_cast<double>(k) / n) *
                                        (edge.end - edge.start));
        return line;
      }
      const double sweep = swept_angle(edge);
      const double first = angle_about(edge.center, edge.start);
      const auto   n =
        std::max(4u, static_cast<unsigned int>(std::abs(sweep) / 0.02));
      for (unsigned int k = 0; k <= n; ++k)
      {
        const double angle = first + sweep * k / n;
        line.push_back(edge.center + std::abs(edge.radius) *
                                       dealii::Tensor<1, 2>(
                                         {std::cos(angle), std::sin(angle)}));
      }
      return line;
    }


    /// Whether the edge lies on material interfaces only.
    bool
    is_interface(const ManifoldMesh &mesh, const ElementEdge &edge)
    {
      const PhysicalMesh              &physical = mesh.physical_mesh();
      const std::vector<unsigned int> &pieces = mesh.curve_set(edge.curve_set);
      return std::all_of(pieces.begin(), pieces.end(), [&](const auto piece) {
        return physical.curves()[physical.piece_to_curve()[piece]].role ==
               CurveRole::interface;
      });
    }


    /// Whether the edge lies on a curve that pictures show.
    bool
    is_on_curve(const ManifoldMesh &mesh, const ElementEdge &edge)
    {
      if (edge.curve_set == invalid_index)
        return false;
      const PhysicalMesh              &physical = mesh.physical_mesh();
      const std::vector<unsigned int> &pieces = mesh.curve_set(edge.curve_set);
      return std::any_of(pieces.begin(), pieces.end(), [&](const auto piece) {
        return !physical.curves()[physical.piece_to_curve()[piece]]
                  .is_auxiliary;
      });
    }


    void
    insert(std::vector<double> &numbers, const Vertex &vertex)
    {
      numbers.insert(numbers.end(),
                     {vertex.position[0],
                      vertex.position[1],
                      vertex.displacement[0],
                      vertex.displacement[1]});
    }


    /// Reads a vertex from the four numbers from index @p i on, and advances @p i by four.
    Vertex
    extract(const std::vector<double> &numbers, std::size_t &i)
    {
      Vertex vertex;
      vertex.position        = Point<2>(numbers[i], numbers[i + 1]);
      vertex.displacement[0] = numbers[i + 2];
      vertex.displacement[1] = numbers[i + 3];
      i += 4;
      return vertex;
    }


    /// Lines as numbers for MPI: for each line, the number of its vertices and their coordinates.
    std::vector<double>
    pack(const std::vector<Polyline> &lines)
    {
      std::vector<double> numbers;
      for (const Polyline &line : lines)
      {
        numbers.push_back(static_cast<double>(line.size()));
        for (const Vertex &vertex : line)
          insert(numbers, vertex);
      }
      return numbers;
    }


    void
    gather_lines(const MPI_Comm communicator, std::vector<Polyline> &lines)
    {
      const auto all =
        dealii::Utilities::MPI::gather(communicator, pack(lines));
      lines.clear();
      for (const std::vector<double> &numbers : all)
        for (std::size_t i = 0; i < numbers.size();)
        {
          const auto n = static_cast<std::size_t>(numbers[i++]);
          lines.emplace_back();
          for (std::size_t k = 0; k < n; ++k)
            lines.back().push_back(extract(numbers, i));
        }
    }


    void
    gather_layers(const MPI_Comm                   communicator,
                  std::vector<PictureData::Layer> &layers)
    {
      for (PictureData::Layer &layer : layers)
      {
        const auto all =
          dealii::Utilities::MPI::gather(communicator, layer.values);
        layer.values.clear();
        for (const auto &part : all)
          layer.values.insert(layer.values.end(), part.begin(), part.end());
      }
    }


    void
    gather_triangles(const MPI_Comm                      communicator,
                     std::vector<PictureData::Triangle> &triangles)
    {
      std::vector<double> numbers;
      for (const PictureData::Triangle &triangle : triangles)
        for (unsigned int i = 0; i < 6; ++i)
        {
          insert(numbers, triangle.vertices[i]);
          numbers.push_back(triangle.values[i]);
        }
      const auto all = dealii::Utilities::MPI::gather(communicator, numbers);
      triangles.clear();
      for (const std::vector<double> &part : all)
        for (std::size_t i = 0; i < part.size();)
        {
          PictureData::Triangle triangle;
          for (unsigned int k = 0; k < 6; ++k)
          {
            triangle.vertices[k] = extract(part, i);
            triangle.values[k]   = part[i++];
          }
          triangles.push_back(triangle);
        }
    }


    /// Adds the outlines, interfaces and mesh lines of one element to @p data.
    template <typename Displacement>
    void
    add_lines(const ManifoldMesh &mesh,
              const unsigned int  element,
              const bool          with_mesh_lines,
              const Displacement &displacement,
              PictureData        &data)
    {
      const auto with_displacements = [&](const std::vector<Point<2>> &points) {
        Polyline line;
        for (const Point<2> &x : points)
          line.push_back({x, displacement(element, x)});
        return line;
      };
      for (const ElementEdge &edge : mesh.edges(element))
      {
        const bool is_physical = is_on_curve(mesh, edge);
        if (!is_physical && !with_mesh_lines)
          continue;
        auto &lines = !is_physical               ? data.mesh_lines
                      : is_interface(mesh, edge) ? data.interfaces
                                                 : data.outlines;
        lines.push_back(with_displacements(sample_edge(edge)));
      }
      if (mesh.edges(element).size() == 0 && with_mesh_lines)
      {
        const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
        const auto &v = mathematical_mesh.cell_vertices(mesh.cell(element));
        for (unsigned int i = 0; i < 3; ++i)
        {
          ElementEdge edge;
          edge.start = mathematical_mesh.vertices()[v[i]];
          edge.end   = mathematical_mesh.vertices()[v[(i + 1) % 3]];
          data.mesh_lines.push_back(with_displacements(sample_edge(edge)));
        }
      }
    }
  } // namespace


  PictureData
  make_picture_data(const CoverSystem       &covers,
                    const FieldTriangles    &triangles,
                    const FieldEvaluator    *evaluator,
                    const PictureParameters &parameters)
  {
    const ManifoldMesh &mesh = covers.manifold_mesh();
    PictureData         data;
    data.deformation_scale = choose_scale(covers, triangles, parameters);

    for (const Quantity quantity : parameters.animation_quantities)
      data.layers.push_back({quantity, {}});

    for (std::size_t t = 0; t < triangles.nodes.size(); ++t)
    {
      const ElementIds      ids = element_ids(mesh, triangles.elements[t]);
      PictureData::Triangle triangle;
      for (unsigned int i = 0; i < 6; ++i)
      {
        const FieldSample &sample = triangles.samples[t][i];
        const Point<2>    &x      = triangles.nodes[t][i];
        triangle.vertices[i]      = {x, sample.displacement};
        triangle.values[i] =
          quantity_value(sample, ids, x, parameters, parameters.quantity);
      }
      data.triangles.push_back(triangle);
      for (PictureData::Layer &layer : data.layers)
      {
        layer.values.emplace_back();
        for (unsigned int i = 0; i < 6; ++i)
          layer.values.back()[i] = quantity_value(triangles.samples[t][i],
                                                  ids,
                                                  triangles.nodes[t][i],
                                                  parameters,
                                                  layer.quantity);
      }
    }

    const auto displacement = [&](const unsigned int element,
                                  const Point<2>    &x) {
      return evaluator == nullptr ? dealii::Tensor<1, 2>()
                                  : evaluator->displacement(element, x);
    };
    const auto [first, last] = covers.locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
      if (evaluator == nullptr || evaluator->shows(element))
        add_lines(mesh, element, parameters.mesh_lines, displacement, data);

    if (dealii::Utilities::MPI::n_mpi_processes(covers.communicator()) > 1)
    {
      gather_triangles(covers.communicator(), data.triangles);
      gather_layers(covers.communicator(), data.layers);
      gather_lines(covers.communicator(), data.outlines);
      gather_lines(covers.communicator(), data.interfaces);
      gather_lines(covers.communicator(), data.mesh_lines);
    }
    return data;
  }
} // namespace NMM
