#include <nmm/base/exceptions.h>
#include <nmm/covers/mathematical_mesh.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using namespace dealii;

  struct MathematicalMesh::Data
  {
    std::unique_ptr<Triangulation<2>> triangulation;
    FE_SimplexP<2>                    fe;
    MappingFE<2>                      mapping;
    DoFHandler<2>                     dof_handler;

    std::vector<Point<2>>                    vertices;
    std::vector<std::array<unsigned int, 3>> cell_vertices;
    std::vector<std::array<unsigned int, 3>> cell_edges;
    std::vector<unsigned int>                cell_covers;
    std::vector<Edge>                        edges;
    std::vector<Point<2>>                    cover_nodes;

    /// First cell of each part, and the number of cells.
    std::vector<unsigned int> part_to_first_cell;

    /// See edge_to_local_covers().
    std::vector<std::array<unsigned int, 3>> edge_to_local_covers;

    Data(std::unique_ptr<Triangulation<2>> tria, const unsigned int degree)
      : triangulation(std::move(tria))
      , fe(degree)
      , mapping(FE_SimplexP<2>(1))
    {
    }

    void
    check_triangulation() const;

    void
    fill_cells();

    void
    fill_edges();
  };


  void
  MathematicalMesh::Data::check_triangulation() const
  {
    AssertThrow(triangulation->n_active_cells() > 0,
                InputError("the mathematical mesh has no cells",
                           "",
                           "give a triangulation that covers the solid"));
    AssertThrow(triangulation->all_reference_cells_are_simplex(),
                InputError("the mathematical mesh has cells that are no "
                           "triangles",
                           "",
                           "convert it, for example with "
                           "GridGenerator::convert_hypercube_to_simplex_mesh"));
    AssertThrow(!triangulation->has_hanging_nodes(),
                InputError("the mathematical mesh has hanging nodes",
                           "",
                           "use a conforming triangulation"));
  }


  void
  MathematicalMesh::Data::fill_cells()
  {
    const unsigned int n_cells = triangulation->n_active_cells();
    const unsigned int n_local = fe.n_dofs_per_cell();
    vertices                   = triangulation->get_vertices();
    cell_vertices.resize(n_cells);
    cell_covers.resize(n_cells * n_local);
    cover_nodes.resize(dof_handler.n_dofs());

    std::vector<types::global_dof_index> dofs(n_local);
    unsigned int                         c = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      for (unsigned int v = 0; v < 3; ++v)
        cell_vertices[c][v] = cell->vertex_index(v);

      const Tensor<1, 2> a =
        vertices[cell_vertices[c][1]] - vertices[cell_vertices[c][0]];
      const Tensor<1, 2> b =
        vertices[cell_vertices[c][2]] - vertices[cell_vertices[c][0]];
      AssertThrow(a[0] * b[1] - a[1] * b[0] > 0.,
                  InputError("cell " + std::to_string(c) +
                               " of the mathematical mesh is degenerate or "
                               "numbered clockwise",
                             to_string(vertices[cell_vertices[c][0]]),
                             "number its corners counter-clockwise"));

      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < n_local; ++i)
      {
        cell_covers[c * n_local + i] = dofs[i];
        cover_nodes[dofs[i]] =
          i < 3 ? vertices[cell_vertices[c][i]]
                : Point<2>(0.5 * (vertices[cell_vertices[c][i - 3]] +
                                  vertices[cell_vertices[c][(i - 2) % 3]]));
      }
      ++c;
    }
  }


  void
  MathematicalMesh::Data::fill_edges()
  {
    const unsigned int n_cells = cell_vertices.size();
    cell_edges.resize(n_cells);
    edges.reserve(triangulation->n_active_lines());

    // Active lines need not have consecutive numbers after a refinement by the user.
    std::vector<unsigned int> line_to_edge(triangulation->n_raw_lines(),
                                           invalid_index);
    unsigned int              c = 0;
    for (const auto &cell : triangulation->active_cell_iterators())
    {
      for (unsigned int i = 0; i < 3; ++i)
      {
        unsigned int      &edge = line_to_edge[cell->line_index(i)];
        const unsigned int v0   = cell_vertices[c][i],
                           v1   = cell_vertices[c][(i + 1) % 3];
        if (edge == invalid_index)
        {
          edge = edges.size();
          edges.push_back({{{std::min(v0, v1), std::max(v0, v1)}},
                           {{invalid_index, invalid_index}}});
        }
        // Corners are counter-clockwise, so that a cell lies to the left of its own edges.
        edges[edge].cells[v0 < v1 ? 0 : 1] = c;
        cell_edges[c][i]                   = edge;
      }
      ++c;
    }

    for (unsigned int i = 0; i < 3; ++i)
      edge_to_local_covers.push_back(
        {{i, (i + 1) % 3, fe.degree == 1 ? invalid_index : 3 + i}});
  }


  MathematicalMesh::MathematicalMesh(
    std::unique_ptr<Triangulation<2>> triangulation,
    const unsigned int                degree)
  {
    AssertThrow(degree == 1 || degree == 2,
                InputError("degree " + std::to_string(degree) +
                             " of the weight functions is not available",
                           "",
                           "choose 1 (first-order method) or 2"));
    data = std::make_unique<Data>(std::move(triangulation), degree);
    data->check_triangulation();
    data->dof_handler.reinit(*data->triangulation);
    data->dof_handler.distribute_dofs(data->fe);
    data->fill_cells();
    data->fill_edges();
    data->part_to_first_cell = {0, n_cells()};
  }


  namespace
  {
    std::unique_ptr<Triangulation<2>>
    copy(const Triangulation<2> &triangulation)
    {
      auto result = std::make_unique<Triangulation<2>>();
      result->copy_triangulation(triangulation);
      return result;
    }
  } // namespace


  MathematicalMesh::MathematicalMesh(const Triangulation<2> &triangulation,
                                     const unsigned int      degree)
    : MathematicalMesh(copy(triangulation), degree)
  {
  }


  MathematicalMesh::MathematicalMesh(MathematicalMesh &&) noexcept = default;

  MathematicalMesh::~MathematicalMesh() = default;


  const Triangulation<2> &
  MathematicalMesh::triangulation() const
  {
    return *data->triangulation;
  }


  const DoFHandler<2> &
  MathematicalMesh::dof_handler() const
  {
    return data->dof_handler;
  }


  const FiniteElement<2> &
  MathematicalMesh::fe() const
  {
    return data->fe;
  }


  const Mapping<2> &
  MathematicalMesh::mapping() const
  {
    return data->mapping;
  }


  unsigned int
  MathematicalMesh::degree() const
  {
    return data->fe.degree;
  }


  unsigned int
  MathematicalMesh::n_cells() const
  {
    return data->cell_vertices.size();
  }


  unsigned int
  MathematicalMesh::n_mathematical_covers() const
  {
    return data->cover_nodes.size();
  }


  unsigned int
  MathematicalMesh::n_covers_per_cell() const
  {
    return data->fe.n_dofs_per_cell();
  }


  unsigned int
  MathematicalMesh::n_parts() const
  {
    return data->part_to_first_cell.size() - 1;
  }


  unsigned int
  MathematicalMesh::cell_part(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    const auto &first = data->part_to_first_cell;
    return std::upper_bound(first.begin(), first.end(), cell) - first.begin() -
           1;
  }


  std::pair<unsigned int, unsigned int>
  MathematicalMesh::part_cells(const unsigned int part) const
  {
    AssertIndexRange(part, n_parts());
    return {data->part_to_first_cell[part], data->part_to_first_cell[part + 1]};
  }


  const std::vector<Point<2>> &
  MathematicalMesh::vertices() const
  {
    return data->vertices;
  }


  const std::array<unsigned int, 3> &
  MathematicalMesh::cell_vertices(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return data->cell_vertices[cell];
  }


  const std::vector<std::array<unsigned int, 3>> &
  MathematicalMesh::cells() const
  {
    return data->cell_vertices;
  }


  const unsigned int *
  MathematicalMesh::cell_covers(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return data->cell_covers.data() + cell * n_covers_per_cell();
  }


  const std::array<unsigned int, 3> &
  MathematicalMesh::cell_edges(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    return data->cell_edges[cell];
  }


  const std::vector<MathematicalMesh::Edge> &
  MathematicalMesh::edges() const
  {
    return data->edges;
  }


  const std::vector<std::array<unsigned int, 3>> &
  MathematicalMesh::edge_to_local_covers() const
  {
    return data->edge_to_local_covers;
  }


  Triangulation<2>::active_cell_iterator
  MathematicalMesh::cell_iterator(const unsigned int cell) const
  {
    AssertIndexRange(cell, n_cells());
    // Without refinement, the index on level 0 is the active index.
    if (data->triangulation->n_levels() == 1)
      return Triangulation<2>::active_cell_iterator(data->triangulation.get(),
                                                    0,
                                                    cell);
    auto iterator = data->triangulation->begin_active();
    std::advance(iterator, cell);
    return iterator;
  }


  const Point<2> &
  MathematicalMesh::cover_node(const unsigned int mathematical_cover) const
  {
    AssertIndexRange(mathematical_cover, n_mathematical_covers());
    return data->cover_nodes[mathematical_cover];
  }


  Tensor<2, 2>
  MathematicalMesh::jacobian(const unsigned int cell) const
  {
    const auto        &v = cell_vertices(cell);
    const Tensor<1, 2> a = data->vertices[v[1]] - data->vertices[v[0]];
    const Tensor<1, 2> b = data->vertices[v[2]] - data->vertices[v[0]];
    Tensor<2, 2>       j;
    j[0][0] = a[0];
    j[1][0] = a[1];
    j[0][1] = b[0];
    j[1][1] = b[1];
    return j;
  }


  Point<2>
  MathematicalMesh::real_to_reference(const unsigned int cell,
                                      const Point<2>    &x) const
  {
    return Point<2>(invert(jacobian(cell)) *
                    (x - data->vertices[cell_vertices(cell)[0]]));
  }


  Point<2>
  MathematicalMesh::reference_to_real(const unsigned int cell,
                                      const Point<2>    &xi) const
  {
    return data->vertices[cell_vertices(cell)[0]] + jacobian(cell) * xi;
  }


  double
  MathematicalMesh::cell_area(const unsigned int cell) const
  {
    return 0.5 * determinant(jacobian(cell));
  }


  double
  MathematicalMesh::cell_diameter(const unsigned int cell) const
  {
    const auto &v        = cell_vertices(cell);
    double      diameter = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      diameter =
        std::max(diameter,
                 data->vertices[v[i]].distance(data->vertices[v[(i + 1) % 3]]));
    return diameter;
  }


  MathematicalMesh
  combine_meshes(const std::vector<MeshPart> &parts, const unsigned int degree)
  {
    std::vector<Point<2>>     vertices;
    std::vector<CellData<2>>  cells;
    std::vector<unsigned int> part_to_first_cell(1, 0);
    for (const MeshPart &part : parts)
    {
      AssertThrow(!part.cells.empty(),
                  InputError("part " +
                               std::to_string(part_to_first_cell.size() - 1) +
                               " of the mathematical mesh has no cells",
                             "",
                             "leave it out"));
      // deal.II accepts no vertices without a cell.
      std::vector<unsigned int> to_combined(part.vertices.size(),
                                            invalid_index);
      for (const auto &corners : part.cells)
      {
        CellData<2> cell(3);
        for (unsigned int i = 0; i < 3; ++i)
        {
          unsigned int &v = to_combined[corners[i]];
          if (v == invalid_index)
          {
            v = vertices.size();
            vertices.push_back(part.vertices[corners[i]]);
          }
          cell.vertices[i] = v;
        }
        cells.push_back(std::move(cell));
      }
      part_to_first_cell.push_back(cells.size());
    }
    AssertThrow(!cells.empty(),
                InputError("the mathematical mesh has no cells",
                           "",
                           "give at least one part"));
    auto triangulation = std::make_unique<Triangulation<2>>();
    triangulation->create_triangulation(vertices, cells, SubCellData());
    MathematicalMesh mesh(std::move(triangulation), degree);
    mesh.data->part_to_first_cell = std::move(part_to_first_cell);
    return mesh;
  }


  MeshPart
  make_mesh_part(const MathematicalMesh &mesh)
  {
    return {mesh.vertices(), mesh.cells()};
  }
} // namespace NMM
