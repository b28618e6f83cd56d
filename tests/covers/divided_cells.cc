// Cells near straight edges are divided by themselves: the same elements as by the exact
// arrangement.

#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/own_meshes.h>

#include <algorithm>
#include <cmath>
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
  /// On meshes of several parts, points of both sides that differ by rounding are merged, and an
  /// edge between points that are the same doubles is left out: rounding decides about so short
  /// edges.
  bool
  counts(const ManifoldMesh &mesh, const ElementEdge &edge)
  {
    return mesh.mathematical_mesh().n_parts() == 1 ||
           edge.start.distance(edge.end) > 1e-13;
  }


  /// Region, numbers of edges, of those on curves and of those with a neighbour, pieces that
  /// lie on its edges, number of joined elements, area.
  using Summary = std::tuple<unsigned int,
                             unsigned int,
                             unsigned int,
                             unsigned int,
                             std::vector<unsigned int>,
                             unsigned int,
                             double>;

  std::vector<Summary>
  elements_of(const ManifoldMesh &mesh, const unsigned int cell)
  {
    std::vector<Summary> result;
    for (const unsigned int e : mesh.cell_elements(cell))
    {
      unsigned int              n_edges = 0, n_on_curves = 0, n_neighbors = 0;
      std::vector<unsigned int> pieces;
      for (const ElementEdge &edge : mesh.edges(e))
      {
        if (!counts(mesh, edge))
          continue;
        ++n_edges;
        n_neighbors += edge.neighbor != invalid_index;
        if (edge.curve_set == invalid_index)
          continue;
        ++n_on_curves;
        const auto &set = mesh.curve_set(edge.curve_set);
        pieces.insert(pieces.end(), set.begin(), set.end());
      }
      std::sort(pieces.begin(), pieces.end());
      result.emplace_back(mesh.region(e),
                          n_edges,
                          n_on_curves,
                          n_neighbors,
                          pieces,
                          mesh.joined(e).size(),
                          mesh.area(e));
    }
    std::sort(result.begin(), result.end());
    return result;
  }


  /// Edges between two elements are the same doubles from both sides. Returns how many there
  /// are.
  unsigned int
  expect_shared_ends(const ManifoldMesh &mesh)
  {
    const auto part = [&](const unsigned int element) {
      return mesh.mathematical_mesh().cell_part(mesh.cell(element));
    };
    unsigned int n = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
    {
      const auto edges = mesh.edges(e);
      for (unsigned int i = 0; i < edges.size(); ++i)
      {
        const ElementEdge &edge = edges[i];
        if (edge.neighbor == invalid_index || !counts(mesh, edge) ||
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
                                         (other.mesh_edge == edge.mesh_edge ||
                                          part(edge.neighbor) != part(e)) &&
                                         other.curve_set == edge.curve_set;
                                }))
          << "element " << e << ", edge " << i;
      }
    }
    return n;
  }


  /**
   * Compares both ways of cutting; returns the number of cells that curves come near.
   * @p has_distinct_points: no two corners of elements are the same doubles, so that
   * edges can be told from each other by their ends.
   */
  unsigned int
  compare(const PhysicalMesh              &physical,
          const MathematicalMesh          &cells,
          const std::vector<unsigned int> &region_to_part,
          const bool                       has_distinct_points = true)
  {
    const ManifoldMesh divided(cells, physical, region_to_part);
    const ManifoldMesh arranged(cells,
                                physical,
                                region_to_part,
                                Cutter::arrangement);

    EXPECT_EQ(divided.n_elements(), arranged.n_elements());
    EXPECT_EQ(divided.n_cells_cut_exactly(), arranged.n_cells_cut_exactly());
    EXPECT_EQ(CoverSystem(divided, MPI_COMM_SELF).n_covers(),
              CoverSystem(arranged, MPI_COMM_SELF).n_covers());
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
    {
      const auto a = elements_of(divided, c), b = elements_of(arranged, c);
      EXPECT_EQ(a.size(), b.size()) << "cell " << c;
      for (unsigned int i = 0; i < std::min(a.size(), b.size()); ++i)
      {
        EXPECT_EQ(std::get<0>(a[i]), std::get<0>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<1>(a[i]), std::get<1>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<2>(a[i]), std::get<2>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<3>(a[i]), std::get<3>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<4>(a[i]), std::get<4>(b[i])) << "cell " << c;
        EXPECT_EQ(std::get<5>(a[i]), std::get<5>(b[i])) << "cell " << c;
        // crossings are within few roundings of coordinates of about 1
        EXPECT_NEAR(std::get<6>(a[i]), std::get<6>(b[i]), 1e-15)
          << "cell " << c;
      }
    }
    EXPECT_EQ(expect_shared_ends(divided), expect_shared_ends(arranged));
    if (has_distinct_points)
    {
      EXPECT_NEAR(expect_matching_edges(divided),
                  expect_matching_edges(arranged),
                  1e-12);
    }
    return divided.n_cells_cut_exactly();
  }
} // namespace


TEST(DividedCells, AreThoseOfTheArrangement)
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
    n_cells += compare(physical, cells, {});
  }
  // the comparison took place: some 150 cells each
  EXPECT_GT(n_cells, 60U * 60U);
}


namespace
{
  /// A point in the square: anywhere, or a node of the mesh, or the middle of an edge, or
  /// one or two doubles away from it.
  Point<2>
  special_point(const MathematicalMesh &mesh, Random &random)
  {
    while (true)
    {
      const auto &edge = mesh.edges()[random.below(mesh.edges().size())];
      Point<2>    a    = mesh.vertices()[edge.vertices[0]];
      switch (random.below(4))
      {
        case 0:
          a = {random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
          break;
        case 1:
          a = Point<2>(0.5 * (a + mesh.vertices()[edge.vertices[1]]));
          break;
        case 2:
          for (unsigned int d = 0; d < 2; ++d)
            for (unsigned int k = random.below(3); k > 0; --k)
              a[d] = std::nextafter(a[d], random.below(2) == 0 ? -1. : 2.);
          break;
        default:
          break;
      }
      if (a[0] > 0.05 && a[0] < 0.95 && a[1] > 0.05 && a[1] < 0.95)
        return a;
    }
  }


  /// Joints that end, cross and touch in cells, at their nodes and on their edges.
  void
  add_special_joints(Geometry               &geometry,
                     const MathematicalMesh &mesh,
                     Random                 &random,
                     const unsigned int      n_joints)
  {
    std::vector<std::pair<Point<2>, Point<2>>> joints;
    for (unsigned int j = 0; j < n_joints; ++j)
    {
      Point<2> a = special_point(mesh, random), b = special_point(mesh, random);
      switch (random.below(6))
      {
        case 0: {
          // along an edge of the mesh, from node to node or on
          const auto &edge = mesh.edges()[random.below(mesh.edges().size())];
          a                = mesh.vertices()[edge.vertices[0]];
          b                = mesh.vertices()[edge.vertices[1]];
          if (random.below(2) == 0)
            b = Point<2>(b + (b - a));
          break;
        }
        case 1:
          // from another joint
          if (!joints.empty())
          {
            const auto &other = joints[random.below(joints.size())];
            a                 = Point<2>(0.5 * (other.first + other.second));
          }
          break;
        case 2:
          // from the end of another one
          if (!joints.empty())
            a = joints[random.below(joints.size())].second;
          break;
        case 3: {
          // one of several through a point; sums of these numbers are exact
          const Point<2>             p(0.25 + 0.25 * random.below(3), 0.375);
          const dealii::Tensor<1, 2> d(
            {(1. + random.below(200)) / 1024., random.below(200) / 1024.});
          a = p - d;
          b = p + d;
          break;
        }
        case 4:
          // within some cell or two
          b = Point<2>(a + Tensor<1, 2>({random.uniform(-0.02, 0.02),
                                         random.uniform(-0.02, 0.02)}));
          break;
        default:
          break;
      }
      if (a.distance(b) < 1e-3 || std::min({a[0], a[1], b[0], b[1]}) < 0. ||
          std::max({a[0], a[1], b[0], b[1]}) > 1.)
        continue;
      joints.emplace_back(a, b);
      geometry.add_polyline({a, b},
                            "joint " + std::to_string(j),
                            CurveRole::joint);
    }
  }
} // namespace


TEST(DividedCells, AreThoseOfTheArrangementAtCoincidences)
{
  unsigned int n_cells = 0;
  for (unsigned int seed = 1000; seed < 1150; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random                 random(seed);
    const Geometry         box = make_box(1., 1.);
    const PhysicalMesh     square(Geometry{box});
    const MathematicalMesh cells =
      make_regular_mesh(square,
                        random_mesh(random, 0.0625, seed % 2 == 0),
                        1 + seed % 2);
    Geometry geometry = make_box(1., 1.);
    add_special_joints(geometry, cells, random, 2 + random.below(12));
    n_cells += compare(PhysicalMesh(Geometry{geometry}), cells, {}, false);
  }
  EXPECT_GT(n_cells, 150U * 60U);
}


// Regions on several parts, two of which have nodes and edges in common. With the disk, some cells
// of a part are arranged beside others that are divided.
TEST(DividedCells, AreThoseOfTheArrangementOnSeveralParts)
{
  unsigned int n_cells = 0;
  for (unsigned int seed = 2000; seed < 2080; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random             random(seed);
    const PhysicalMesh square(make_box(1., 1.));
    const bool         is_special = seed % 2 == 0;
    const auto         make_cells = [&](const double size) {
      return make_regular_mesh(square,
                               random_mesh(random, size, is_special),
                               1 + seed % 2);
    };
    const MathematicalMesh first    = make_cells(0.0625);
    Geometry               geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 4 + random.below(6), is_special);
    if (is_special)
      add_special_joints(geometry, first, random, 2 + random.below(8));
    if (seed % 4 >= 2)
      geometry.add_circle({0.3, 0.3}, 0.17, "disk", CurveRole::interface);
    const PhysicalMesh     physical(std::move(geometry));
    const MathematicalMesh cells =
      combine_meshes({make_mesh_part(first),
                      make_mesh_part(first),
                      make_mesh_part(make_cells(0.15))},
                     first.degree());
    std::vector<unsigned int> region_to_part;
    for (unsigned int r = 0; r < physical.regions().size(); ++r)
      region_to_part.push_back(random.below(3));
    n_cells += compare(physical, cells, region_to_part, !is_special);
  }
  EXPECT_GT(n_cells, 80U * 60U);
}


// Blocks with meshes of their own: those on one triangle lie in it without touching its sides. An
// inner block is a hole in another one, and a crack in it has no connection to its outline.
TEST(DividedCells, AreThoseOfTheArrangementOnOwnMeshes)
{
  unsigned int n_triangles = 0;
  for (unsigned int seed = 3000; seed < 3080; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 4 + random.below(13), seed % 2 == 0);
    if (seed % 4 == 1)
      geometry.add_circle({0.3, 0.3}, 0.17, "disk", CurveRole::interface);
    if (seed % 4 >= 2)
    {
      geometry.add_polygon({{0.6, 0.6}, {0.7, 0.63}, {0.67, 0.73}},
                           "inner block",
                           CurveRole::joint);
      geometry.add_polyline({{0.64, 0.64}, {0.66, 0.65}},
                            "crack",
                            CurveRole::joint);
    }
    const PhysicalMesh physical(std::move(geometry));
    OwnMeshParameters  parameters;
    parameters.regions.assign(physical.regions().size(),
                              {RegionMesh::Kind::own, 1 + seed % 3});
    const OwnMeshes own =
      make_own_meshes(std::make_unique<MathematicalMesh>(make_regular_mesh(
                        physical, random_mesh(random, 0.3, false), 2)),
                      physical,
                      parameters);
    compare(physical, *own.mathematical_mesh, own.region_to_part);
    for (unsigned int p = 1; p < own.mathematical_mesh->n_parts(); ++p)
    {
      const auto [first, end] = own.mathematical_mesh->part_cells(p);
      n_triangles += end == first + 1;
    }
  }
  EXPECT_GT(n_triangles, 300U);
}


TEST(DividedCells, BoundaryThatLeavesTheMeshIsRefused)
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
