#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/grid/tria_description.h>

#include "lattice.h"

namespace NMM
{
  using namespace dealii;


  MathematicalMesh
  make_regular_mesh(const PhysicalMesh          &physical_mesh,
                    const RegularMeshParameters &parameters,
                    const unsigned int           degree)
  {
    const internal::Lattice lattice =
      internal::make_lattice(physical_mesh.bounding_box(), parameters);

    std::vector<unsigned int> node_to_vertex((lattice.n[0] + 1) *
                                               (lattice.n[1] + 1),
                                             invalid_index);
    std::vector<Point<2>>     vertices;
    std::vector<CellData<2>>  cells;
    const auto vertex = [&](const std::int64_t i, const std::int64_t j) {
      unsigned int &v = node_to_vertex[j * (lattice.n[0] + 1) + i];
      if (v == invalid_index)
      {
        v = vertices.size();
        vertices.push_back(lattice.node(i, j));
      }
      return v;
    };
    const auto add_cell =
      [&](const unsigned int v0, const unsigned int v1, const unsigned int v2) {
        CellData<2> cell(3);
        cell.vertices = {v0, v1, v2};
        cells.push_back(std::move(cell));
      };
    for (const auto &[i, j] : internal::find_needed_parallelograms(
           physical_mesh, lattice, parameters))
    {
      const unsigned int v00 = vertex(i, j), v10 = vertex(i + 1, j),
                         v01 = vertex(i, j + 1), v11 = vertex(i + 1, j + 1);
      add_cell(v00, v10, v01);
      add_cell(v10, v11, v01);
    }

    auto triangulation = std::make_unique<Triangulation<2>>();
    triangulation->create_triangulation(vertices, cells, SubCellData());
    return MathematicalMesh(std::move(triangulation), degree);
  }
} // namespace NMM
