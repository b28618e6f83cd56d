#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/numbers.h>

#include "matching.h"
#include "support/random_scenes.h"
#include <gtest/gtest.h>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  RegularMeshParameters
  mesh(const double      cell_size,
       const double      rotation = 0.,
       const MeshPattern pattern  = MeshPattern::right_angled)
  {
    RegularMeshParameters parameters;
    parameters.cell_size = cell_size;
    parameters.rotation  = rotation;
    parameters.pattern   = pattern;
    return parameters;
  }

  MathematicalMesh
  combine(const PhysicalMesh                       &physical,
          const std::vector<RegularMeshParameters> &parameters,
          const unsigned int                        degree = 2)
  {
    std::vector<MeshPart> parts;
    for (const RegularMeshParameters &p : parameters)
      parts.push_back(make_mesh_part(make_regular_mesh(physical, p, degree)));
    return combine_meshes(parts, degree);
  }
} // namespace


TEST(MeshParts, AreNumberedThrough)
{
  const PhysicalMesh     physical(make_box(1., 1.));
  const MathematicalMesh one = make_regular_mesh(physical, mesh(0.5), 2);
  const MathematicalMesh two = make_regular_mesh(physical, mesh(0.3, 20.), 2);
  const MathematicalMesh both =
    combine_meshes({make_mesh_part(one), make_mesh_part(two)}, 2);
  EXPECT_EQ(one.n_parts(), 1u);
  ASSERT_EQ(both.n_parts(), 2u);
  EXPECT_EQ(both.n_cells(), one.n_cells() + two.n_cells());
  EXPECT_EQ(both.n_mathematical_covers(),
            one.n_mathematical_covers() + two.n_mathematical_covers());
  EXPECT_EQ(both.edges().size(), one.edges().size() + two.edges().size());
  EXPECT_EQ(both.part_cells(1), std::make_pair(one.n_cells(), both.n_cells()));
  for (unsigned int c = 0; c < both.n_cells(); ++c)
  {
    const bool              first = c < one.n_cells();
    const MathematicalMesh &own   = first ? one : two;
    EXPECT_EQ(both.cell_part(c), first ? 0u : 1u);
    // cells and corners in the order given: right angles come first
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_EQ(
        both.vertices()[both.cell_vertices(c)[i]],
        own.vertices()[own.cell_vertices(first ? c : c - one.n_cells())[i]]);
  }
  for (const auto &edge : both.edges())
    if (edge.cells[0] != invalid_index && edge.cells[1] != invalid_index)
    {
      EXPECT_EQ(both.cell_part(edge.cells[0]), both.cell_part(edge.cells[1]));
    }
}


TEST(MeshParts, RefuseWhatDoesNotFit)
{
  EXPECT_THROW(combine_meshes({}, 2), InputError);
  EXPECT_THROW(combine_meshes({MeshPart()}, 2), InputError);
  const PhysicalMesh     physical(make_box(1., 1.));
  const MathematicalMesh cells = make_regular_mesh(physical, mesh(0.5), 2);
  EXPECT_THROW(ManifoldMesh(cells, physical, {1}), InputError);
  EXPECT_THROW(ManifoldMesh(cells, physical, {0, 0}), InputError);
}


TEST(MeshParts, EachPartMustCoverItsRegions)
{
  Geometry geometry = make_box(2., 1.);
  geometry.add_polyline({Point<2>(1., 0.), Point<2>(1., 1.)},
                        "joint",
                        CurveRole::joint);
  const PhysicalMesh physical(std::move(geometry));
  // part 1 covers the left half and a bit
  MeshPart part;
  part.vertices                = {Point<2>(-0.1, -0.1),
                                  Point<2>(1.2, -0.1),
                                  Point<2>(1.2, 1.1),
                                  Point<2>(-0.1, 1.1)};
  part.cells                   = {{{0, 1, 3}}, {{2, 3, 1}}};
  const MathematicalMesh cells = combine_meshes(
    {make_mesh_part(make_regular_mesh(physical, mesh(0.3), 2)), part}, 2);
  const unsigned int        left = physical.regions()[0].inside[0] < 1. ? 0 : 1;
  std::vector<unsigned int> region_to_part(2, 0);
  region_to_part[left] = 1;
  const ManifoldMesh manifold(cells, physical, region_to_part);
  EXPECT_NEAR(region_areas(manifold)[left], 1., 1e-14);
  EXPECT_THROW(ManifoldMesh(cells, physical, {1, 1}), InputError);
}


TEST(MeshParts, HoldOnlyTheElementsOfTheirRegions)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0.37, 0.), Point<2>(0.52, 1.)},
                        "joint",
                        CurveRole::joint);
  const PhysicalMesh     physical(std::move(geometry));
  const MathematicalMesh cells =
    combine(physical, {mesh(0.25), mesh(0.17, 31., MeshPattern::equilateral)});
  const ManifoldMesh manifold(cells, physical, {0, 1});
  EXPECT_NEAR(region_areas(manifold)[0], physical.regions()[0].area, 1e-14);
  EXPECT_NEAR(region_areas(manifold)[1], physical.regions()[1].area, 1e-14);
  for (unsigned int e = 0; e < manifold.n_elements(); ++e)
    EXPECT_EQ(cells.cell_part(manifold.cell(e)), manifold.region(e));
  // the joint, seen from both sides
  EXPECT_NEAR(expect_matching_edges(manifold),
              2. * std::hypot(0.15, 1.),
              1e-14);
  EXPECT_EQ(n_connected_sets(manifold), 2u);

  for (double x = 0.03; x < 1.; x += 0.09)
    for (double y = 0.03; y < 1.; y += 0.09)
    {
      const unsigned int e = manifold.find_element(Point<2>(x, y));
      ASSERT_NE(e, invalid_index);
      EXPECT_EQ(manifold.region(e), x < 0.37 + 0.15 * y ? 0u : 1u);
    }
}


TEST(MeshParts, SameMeshTwiceDividesNothing)
{
  // the joint lies on mesh lines of both parts: merged, not divided
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0., 0.5), Point<2>(1., 0.5)},
                        "joint",
                        CurveRole::joint);
  const PhysicalMesh     physical(std::move(geometry));
  const MathematicalMesh cells = combine(physical, {mesh(0.25), mesh(0.25)});
  const ManifoldMesh     manifold(cells, physical, {0, 1});
  EXPECT_EQ(manifold.n_elements(), 32u);
  unsigned int n_on_joint = 0;
  for (unsigned int e = 0; e < manifold.n_elements(); ++e)
  {
    EXPECT_TRUE(manifold.is_whole(e));
    for (const ElementEdge &edge : manifold.edges(e))
      n_on_joint +=
        edge.neighbor != invalid_index && edge.curve_set != invalid_index;
  }
  EXPECT_EQ(n_on_joint, 8u);
  EXPECT_NEAR(expect_matching_edges(manifold), 2., 1e-15);
  const CoverSystem covers(manifold, MPI_COMM_SELF);
  EXPECT_EQ(covers.n_covers(), 90u);
}


TEST(MeshParts, PointsAFewUlpApartAreMerged)
{
  // The mesh lines of both parts differ in the last place, and so do their
  // crossings with the curve; no edge may be left between those.
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    geometry.add_circle(Point<2>(random.uniform(0.4, 0.6), 0.5),
                        random.uniform(0.2, 0.35),
                        "disk",
                        CurveRole::interface);
    const PhysicalMesh          physical(std::move(geometry));
    const RegularMeshParameters parameters = random_mesh(random, 0.03, false);
    const MathematicalMesh single = make_regular_mesh(physical, parameters, 1);
    const MeshPart         part   = make_mesh_part(single);
    MeshPart               moved  = part;
    for (Point<2> &x : moved.vertices)
      x[1] = std::nextafter(x[1], 10.);
    const MathematicalMesh cells = combine_meshes({part, moved}, 1);
    const auto             count = [](const ManifoldMesh &manifold) {
      unsigned int n = 0;
      for (unsigned int e = 0; e < manifold.n_elements(); ++e)
        for (const ElementEdge &edge : manifold.edges(e))
          n += edge.is_arc();
      return n;
    };
    const ManifoldMesh manifold(cells, physical, {0, 1});
    EXPECT_EQ(count(manifold), count(ManifoldMesh(single, physical)));
    expect_matching_edges(manifold);
  }
}


TEST(MeshParts, ArcsHaveTheSameEdgesOnBothSides)
{
  for (const double radius : {0.31, 0.25, 0.02})
  {
    SCOPED_TRACE(radius);
    Geometry geometry = make_box(1., 1.);
    geometry.add_circle(Point<2>(0.5, 0.5),
                        radius,
                        "disk",
                        CurveRole::interface);
    const PhysicalMesh     physical(std::move(geometry));
    const MathematicalMesh cells =
      combine(physical,
              {mesh(0.1), mesh(0.083, 17., MeshPattern::equilateral)});
    for (const auto &region_to_part :
         {std::vector<unsigned int>{0, 1}, std::vector<unsigned int>{1, 0}})
    {
      const ManifoldMesh manifold(cells, physical, region_to_part);
      EXPECT_NEAR(expect_matching_edges(manifold),
                  4. * dealii::numbers::PI * radius,
                  1e-13);
      const std::vector<double> area = region_areas(manifold);
      for (unsigned int r = 0; r < 2; ++r)
        EXPECT_NEAR(area[r], physical.regions()[r].area, 1e-13);
      EXPECT_NEAR(std::min(area[0], area[1]),
                  dealii::numbers::PI * radius * radius,
                  1e-13);
    }
  }
}


TEST(MeshParts, RandomNetworksOnRandomParts)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 16, seed % 2 == 0);
    if (seed % 3 == 0)
      geometry.add_circle(Point<2>(0.5, 0.5),
                          0.25,
                          "disk",
                          CurveRole::interface);
    const PhysicalMesh physical(std::move(geometry));

    const unsigned int                 n_parts = 2 + random.below(3);
    std::vector<RegularMeshParameters> parameters;
    for (unsigned int p = 0; p < n_parts; ++p)
      parameters.push_back(
        random_mesh(random, random.uniform(0.05, 0.3), random.below(3) == 0));
    const MathematicalMesh    cells = combine(physical, parameters, 1);
    std::vector<unsigned int> region_to_part;
    for (unsigned int r = 0; r < physical.regions().size(); ++r)
      region_to_part.push_back(random.below(n_parts));

    const ManifoldMesh        manifold(cells, physical, region_to_part);
    const std::vector<double> area = region_areas(manifold);
    for (unsigned int r = 0; r < area.size(); ++r)
      EXPECT_NEAR(area[r], physical.regions()[r].area, 1e-13);
    for (unsigned int e = 0; e < manifold.n_elements(); ++e)
      EXPECT_EQ(cells.cell_part(manifold.cell(e)),
                region_to_part[manifold.region(e)]);

    // curves between regions are as long as on a mesh of one part
    const MathematicalMesh single = make_regular_mesh(physical, mesh(2.), 1);
    EXPECT_NEAR(expect_matching_edges(manifold),
                expect_matching_edges(ManifoldMesh(single, physical)),
                1e-11);
    EXPECT_EQ(n_connected_sets(manifold), physical.regions().size());
  }
}


TEST(MeshParts, CutOnlyWhatTheirRegionsTouch)
{
  // n x n blocks, each with a mesh of four cells: the work, counted in cells
  // that went through the exact cutter and in edges made, is linear
  double edges_per_block = 0.;
  for (const unsigned int n : {4, 8, 16})
  {
    Geometry geometry = make_box(n, n);
    for (unsigned int i = 1; i < n; ++i)
    {
      geometry.add_polyline({Point<2>(i, 0.), Point<2>(i, n)},
                            "v" + std::to_string(i),
                            CurveRole::joint);
      geometry.add_polyline({Point<2>(0., i), Point<2>(n, i)},
                            "h" + std::to_string(i),
                            CurveRole::joint);
    }
    const PhysicalMesh        physical(std::move(geometry));
    std::vector<MeshPart>     parts;
    std::vector<unsigned int> region_to_part;
    for (const auto &region : physical.regions())
    {
      const Point<2> c = region.inside;
      // four triangles around a centre
      MeshPart part;
      part.vertices = {c,
                       c + Tensor<1, 2>({-1.3, 0.}),
                       c + Tensor<1, 2>({0., -1.3}),
                       c + Tensor<1, 2>({1.3, 0.}),
                       c + Tensor<1, 2>({0., 1.3})};
      part.cells    = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 1}}};
      region_to_part.push_back(parts.size());
      parts.push_back(part);
    }
    const MathematicalMesh cells = combine_meshes(parts, 2);
    const ManifoldMesh     manifold(cells, physical, region_to_part);
    EXPECT_EQ(manifold.n_cells_cut_exactly(), 4u * n * n);
    EXPECT_EQ(manifold.n_elements(), 4u * n * n);
    EXPECT_NEAR(expect_matching_edges(manifold), 4. * n * (n - 1), 1e-11);
    std::size_t n_edges = 0;
    for (unsigned int e = 0; e < manifold.n_elements(); ++e)
      n_edges += manifold.edges(e).size();
    // inner blocks have more neighbours to be divided by
    const double per_block = static_cast<double>(n_edges) / (n * n);
    if (edges_per_block > 0.)
    {
      EXPECT_LT(per_block, 1.2 * edges_per_block);
    }
    edges_per_block = per_block;
  }
}
