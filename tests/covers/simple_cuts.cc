// Cells that one straight edge runs through are cut by themselves: the same elements as
// by the exact arrangement, which a second part of the mesh, far away, enforces.

#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>

#include <algorithm>
#include <covers/matching.h>
#include <gtest/gtest.h>
#include <support/random_scenes.h>
#include <tuple>

using namespace NMM;
using namespace NMM::Testing;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /// Region, number of edges, number of joined elements, area.
  using Summary = std::tuple<unsigned int, unsigned int, unsigned int, double>;

  std::vector<Summary>
  elements_of(const ManifoldMesh &mesh, const unsigned int cell)
  {
    std::vector<Summary> result;
    for (const unsigned int e : mesh.cell_elements(cell))
      result.emplace_back(mesh.region(e),
                          mesh.edges(e).size(),
                          mesh.joined(e).size(),
                          mesh.area(e));
    std::sort(result.begin(), result.end());
    return result;
  }


  /// Edges between two elements are the same doubles from both sides. Returns how many there
  /// are.
  unsigned int
  expect_shared_ends(const ManifoldMesh &mesh)
  {
    unsigned int n = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
    {
      const auto edges = mesh.edges(e);
      for (unsigned int i = 0; i < edges.size(); ++i)
      {
        const ElementEdge &edge = edges[i];
        if (edge.neighbor == invalid_index ||
            mesh.edges(edge.neighbor).size() == 0)
          continue;
        ++n;
        const auto beyond = mesh.edges(edge.neighbor);
        EXPECT_TRUE(std::any_of(beyond.begin(),
                                beyond.end(),
                                [&](const ElementEdge &other) {
                                  return other.neighbor == e &&
                                         other.start == edge.end &&
                                         other.end == edge.start &&
                                         other.mesh_edge == edge.mesh_edge &&
                                         other.curve_set == edge.curve_set;
                                }))
          << "element " << e << ", edge " << i;
      }
    }
    return n;
  }


  /// Compares both ways of cutting; returns the number of cells that curves come near.
  unsigned int
  compare(const Geometry &geometry, const MathematicalMesh &cells)
  {
    const PhysicalMesh physical(Geometry{geometry});
    MeshPart           far;
    far.vertices = {{100., 100.}, {101., 100.}, {100., 101.}};
    far.cells    = {{{0, 1, 2}}};
    const MathematicalMesh both =
      combine_meshes({make_mesh_part(cells), far}, cells.degree());
    const ManifoldMesh simple(cells, physical);
    const ManifoldMesh arranged(
      both, physical, std::vector<unsigned int>(physical.regions().size(), 0));

    EXPECT_EQ(simple.n_elements(), arranged.n_elements());
    EXPECT_EQ(simple.n_cells_cut_exactly(), arranged.n_cells_cut_exactly());
    EXPECT_EQ(CoverSystem(simple, MPI_COMM_SELF).n_covers(),
              CoverSystem(arranged, MPI_COMM_SELF).n_covers());
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
    {
      const auto a = elements_of(simple, c), b = elements_of(arranged, c);
      EXPECT_EQ(a.size(), b.size()) << "cell " << c;
      for (unsigned int i = 0; i < std::min(a.size(), b.size()); ++i)
      {
        EXPECT_EQ(std::get<0>(a[i]), std::get<0>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<1>(a[i]), std::get<1>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<2>(a[i]), std::get<2>(b[i])) << "cell " << c;
        // crossings are within few roundings of coordinates of about 1
        EXPECT_NEAR(std::get<3>(a[i]), std::get<3>(b[i]), 1e-15)
          << "cell " << c;
      }
    }
    EXPECT_EQ(expect_shared_ends(simple), expect_shared_ends(arranged));
    EXPECT_NEAR(expect_matching_edges(simple),
                expect_matching_edges(arranged),
                1e-12);
    return simple.n_cells_cut_exactly();
  }
} // namespace


TEST(SimpleCuts, AreThoseOfTheArrangement)
{
  unsigned int n_cells = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    // every third one has coincidences with the mesh and between joints
    const bool is_snapped = seed % 3 == 0;
    add_random_joints(geometry, random, 1 + random.below(6), is_snapped);
    if (seed % 4 == 1)
      geometry.add_circle({0.3, 0.3}, 0.17, "hole", CurveRole::hole);
    const PhysicalMesh     physical(Geometry{geometry});
    const MathematicalMesh cells =
      make_regular_mesh(physical,
                        random_mesh(random, 0.05, is_snapped),
                        1 + seed % 2);
    n_cells += compare(geometry, cells);
  }
  // the comparison took place: some 150 cells each
  EXPECT_GT(n_cells, 60U * 60U);
}


TEST(SimpleCuts, BoundaryThatLeavesTheMeshIsRefused)
{
  const Geometry     geometry = make_box(1., 1.);
  const PhysicalMesh physical(Geometry{geometry});
  MeshPart           part;
  // covers the corners of the square, but not all of its right side
  part.vertices                = {{-1., -1.}, {0.7, -1.}, {0.7, 2.}, {-1., 2.}};
  part.cells                   = {{{0, 1, 2}}, {{0, 2, 3}}};
  const MathematicalMesh cells = combine_meshes({part}, 2);
  EXPECT_THROW(ManifoldMesh(cells, physical), InputError);
}
