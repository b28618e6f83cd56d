#include <nmm/base/exceptions.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/point_location.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/grid/grid_in.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include "cutting.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    using Kernel     = CGAL::Exact_predicates_inexact_constructions_kernel;
    using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
    using FaceBase   = CGAL::Delaunay_mesh_face_base_2<Kernel>;
    using Delaunay   = CGAL::Constrained_Delaunay_triangulation_2<
      Kernel,
      CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

    /**
     * Delaunay refinement splits a triangle until its longest edge is below a
     * bound; mean edges of the result are this share of the bound (measured).
     */
    constexpr double mean_over_bound = 0.67;

    /// sin^2 of the smallest angle the refinement surely reaches (20.7 degrees).
    constexpr double shape_bound = 0.125;


    /// CGAL's concept MeshingCriteria_2 with our size field.
    class Criteria
    {
    public:
      explicit Criteria(const SizeField &size)
        : size(&size)
      {
      }

      /// How badly a triangle needs splitting: size first, then shape.
      struct Quality
      {
        double size = 0., shape = 1.;

        bool
        operator<(const Quality &other) const
        {
          if (size > 1. || other.size > 1.)
            return size > other.size;
          return shape < other.shape;
        }
      };

      class Is_bad
      {
      public:
        explicit Is_bad(const SizeField &size)
          : size(&size)
        {
        }

        CGAL::Mesh_2::Face_badness
        operator()(const Quality &quality) const
        {
          if (quality.size > 1.)
            return CGAL::Mesh_2::IMPERATIVELY_BAD;
          return quality.shape < shape_bound ? CGAL::Mesh_2::BAD
                                             : CGAL::Mesh_2::NOT_BAD;
        }

        CGAL::Mesh_2::Face_badness
        operator()(const Delaunay::Face_handle &face, Quality &quality) const
        {
          const auto &a              = face->vertex(0)->point(),
                     &b              = face->vertex(1)->point(),
                     &c              = face->vertex(2)->point();
          std::array<double, 3> edge = {{CGAL::squared_distance(a, b),
                                         CGAL::squared_distance(b, c),
                                         CGAL::squared_distance(c, a)}};
          std::sort(edge.begin(), edge.end());
          const Point<2> center((a.x() + b.x() + c.x()) / 3.,
                                (a.y() + b.y() + c.y()) / 3.);
          quality.size = std::sqrt(edge[2]) * mean_over_bound / (*size)(center);
          // twice the area over the two longer edges
          const double area = CGAL::area(a, b, c);
          quality.shape     = 4. * area * area / (edge[1] * edge[2]);
          return (*this)(quality);
        }

      private:
        const SizeField *size;
      };

      Is_bad
      is_bad_object() const
      {
        return Is_bad(*size);
      }

    private:
      const SizeField *size;
    };


    double
    distance_from_box(const LocalSize &box, const Point<2> &x)
    {
      Tensor<1, 2> d;
      for (unsigned int i = 0; i < 2; ++i)
        d[i] = std::max({box.lower[i] - x[i], 0., x[i] - box.upper[i]});
      return d.norm();
    }


    /// A curve piece as an edge, so that one distance() serves both.
    ElementEdge
    to_edge(const CurvePiece &piece)
    {
      ElementEdge edge;
      edge.start = piece.start;
      edge.end   = piece.end;
      if (piece.kind == CurvePiece::Kind::arc)
      {
        edge.center = piece.center;
        edge.radius = std::copysign(piece.radius, swept_angle(piece));
      }
      return edge;
    }


    double
    distance(const CurvePiece &piece, const Point<2> &x)
    {
      return piece.kind == CurvePiece::Kind::circle
               ? std::abs(x.distance(piece.center) - piece.radius)
               : NMM::distance(to_edge(piece), x);
    }


    /// Cells that can touch the solid, as a new triangulation.
    std::unique_ptr<Triangulation<2>>
    without_outside(const MathematicalMesh &mesh,
                    const PhysicalMesh     &physical_mesh)
    {
      const std::vector<unsigned char> near =
        internal::find_cells_near_curves(mesh, physical_mesh);
      std::vector<unsigned int> new_vertex(mesh.vertices().size(),
                                           invalid_index);
      std::vector<Point<2>>     vertices;
      std::vector<CellData<2>>  cells;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &v = mesh.cell_vertices(c);
        if (!near[c] && !is_in_solid(physical_mesh,
                                     Point<2>((mesh.vertices()[v[0]] +
                                               mesh.vertices()[v[1]] +
                                               mesh.vertices()[v[2]]) /
                                              3.)))
          continue;
        CellData<2> cell(3);
        for (unsigned int i = 0; i < 3; ++i)
        {
          if (new_vertex[v[i]] == invalid_index)
          {
            new_vertex[v[i]] = vertices.size();
            vertices.push_back(mesh.vertices()[v[i]]);
          }
          cell.vertices[i] = new_vertex[v[i]];
        }
        cells.push_back(cell);
      }
      auto result = std::make_unique<Triangulation<2>>();
      result->create_triangulation(vertices, cells, SubCellData());
      return result;
    }


    std::unique_ptr<Triangulation<2>>
    to_triangulation(const Delaunay &delaunay)
    {
      std::map<Delaunay::Vertex_handle, unsigned int> vertex_to_index;
      std::vector<Point<2>>                           vertices;
      std::vector<CellData<2>>                        cells;
      for (const auto vertex : delaunay.finite_vertex_handles())
      {
        vertex_to_index[vertex] = vertices.size();
        vertices.emplace_back(vertex->point().x(), vertex->point().y());
      }
      for (const auto face : delaunay.finite_face_handles())
        if (face->is_in_domain())
        {
          CellData<2> cell(3);
          for (unsigned int i = 0; i < 3; ++i)
            cell.vertices[i] = vertex_to_index.at(face->vertex(i));
          cells.push_back(cell);
        }
      auto result = std::make_unique<Triangulation<2>>();
      result->create_triangulation(vertices, cells, SubCellData());
      return result;
    }
  } // namespace


  SizeField::SizeField(const PhysicalMesh  &physical_mesh,
                       GradedMeshParameters parameters_)
    : parameters(std::move(parameters_))
  {
    AssertThrow(std::isfinite(parameters.cell_size) &&
                  parameters.cell_size > 0.,
                InputError("the cell size " +
                             std::to_string(parameters.cell_size) +
                             " m is not positive",
                           "Mathematical mesh/Cell size",
                           "give the edge length of a triangle"));
    for (const LocalSize &local : parameters.local_sizes)
    {
      AssertThrow(local.size > 0. && local.growth > 0. && local.growth <= 1.,
                  InputError("a local size of " + std::to_string(local.size) +
                               " m that grows by " +
                               std::to_string(local.growth) + " per distance",
                             "Mathematical mesh/Local sizes",
                             "the size must be positive and the growth in "
                             "(0, 1]"));
      pieces_of_local_size.emplace_back();
      if (local.kind != LocalSize::Kind::curve)
        continue;
      for (unsigned int i = 0; i < physical_mesh.pieces().size(); ++i)
        if (physical_mesh.curves()[physical_mesh.piece_to_curve()[i]].name ==
            local.curve)
          pieces_of_local_size.back().push_back(physical_mesh.pieces()[i]);
      AssertThrow(!pieces_of_local_size.back().empty(),
                  InputError("there is no curve called '" + local.curve + "'",
                             "Mathematical mesh/Local sizes",
                             "name a curve of the geometry"));
    }
  }


  double
  SizeField::operator()(const Point<2> &x) const
  {
    double size = parameters.cell_size;
    for (unsigned int i = 0; i < parameters.local_sizes.size(); ++i)
    {
      const LocalSize &local = parameters.local_sizes[i];
      double           d     = 1e300;
      switch (local.kind)
      {
        case LocalSize::Kind::point:
          d = x.distance(local.point);
          break;
        case LocalSize::Kind::box:
          d = distance_from_box(local, x);
          break;
        case LocalSize::Kind::curve:
          for (const CurvePiece &piece : pieces_of_local_size[i])
            d = std::min(d, distance(piece, x));
          break;
      }
      size = std::min(size, local.size + local.growth * d);
    }
    return size;
  }


  MathematicalMesh
  make_graded_mesh(const PhysicalMesh         &physical_mesh,
                   const GradedMeshParameters &parameters,
                   const unsigned int          degree)
  {
    const SizeField       size(physical_mesh, parameters);
    const BoundingBox<2> &box = physical_mesh.bounding_box();
    // rounding must not leave a point of the solid uncovered
    const double margin =
      1e-3 *
      std::max({parameters.cell_size, box.side_length(0), box.side_length(1)});

    Delaunay                             delaunay;
    const std::array<Kernel::Point_2, 4> corners = {
      {Kernel::Point_2(box.lower_bound(0) - margin,
                       box.lower_bound(1) - margin),
       Kernel::Point_2(box.upper_bound(0) + margin,
                       box.lower_bound(1) - margin),
       Kernel::Point_2(box.upper_bound(0) + margin,
                       box.upper_bound(1) + margin),
       Kernel::Point_2(box.lower_bound(0) - margin,
                       box.upper_bound(1) + margin)}};
    for (unsigned int i = 0; i < 4; ++i)
      delaunay.insert_constraint(corners[i], corners[(i + 1) % 4]);

    CGAL::Delaunay_mesher_2<Delaunay, Criteria> mesher(delaunay,
                                                       Criteria(size));
    mesher.refine_mesh();
    CGAL::lloyd_optimize_mesh_2(delaunay,
                                CGAL::parameters::max_iteration_number = 10);

    const MathematicalMesh all(to_triangulation(delaunay), 1);
    return MathematicalMesh(without_outside(all, physical_mesh), degree);
  }


  MathematicalMesh
  read_gmsh_mesh(const std::string &file_name, const unsigned int degree)
  {
    std::ifstream file(file_name);
    AssertThrow(file,
                InputError("the mesh file cannot be read",
                           file_name,
                           "check its name and permissions"));
    auto      triangulation = std::make_unique<Triangulation<2>>();
    GridIn<2> reader(*triangulation);
    try
    {
      reader.read_msh(file);
    }
    catch (const std::exception &exception)
    {
      AssertThrow(false,
                  InputError("deal.II cannot read the mesh file (" +
                               std::string(exception.what()) + ")",
                             file_name,
                             "save it as gmsh format 2 or 4, ASCII, with "
                             "triangles only"));
    }
    return MathematicalMesh(std::move(triangulation), degree);
  }
} // namespace NMM
