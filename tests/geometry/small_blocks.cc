// Blocks that are smaller than an area become parts of their neighbours.

#include "test_helpers.h"
#include <algorithm>
#include <cmath>

using namespace geometry_test;

namespace
{
  NMM::PhysicalMesh
  merged(const std::string &text, const double area)
  {
    NMM::Geometry geometry = NMM::parse_geometry(text, "test.wkt");
    geometry.merge_blocks_below(area);
    return NMM::PhysicalMesh(std::move(geometry));
  }


  /// Areas of all blocks, ascending.
  std::vector<double>
  block_areas(const NMM::PhysicalMesh &mesh)
  {
    std::vector<double> areas(mesh.n_blocks(), 0.);
    for (const auto &region : mesh.regions())
      areas[region.block] += region.area;
    std::sort(areas.begin(), areas.end());
    return areas;
  }


  void
  expect_areas(const NMM::PhysicalMesh   &mesh,
               const std::vector<double> &expected)
  {
    const std::vector<double> areas = block_areas(mesh);
    ASSERT_EQ(areas.size(), expected.size());
    // Sums of a few areas of numbers up to 1.
    for (unsigned int i = 0; i < areas.size(); ++i)
      EXPECT_NEAR(areas[i], expected[i], 1e-14);
  }


  std::string
  material_at(const NMM::PhysicalMesh &mesh, const unsigned int region)
  {
    return mesh.material_names()[mesh.regions()[region].material];
  }
} // namespace


// A corner of 0.2 by 0.3 between two joints: 0.3 m of the boundary are common with
// the right block, 0.2 m with the upper one.
TEST(SmallBlocks, LongestJointVanishes)
{
  const std::string text = unit_square +
                           "joint name=v LINESTRING (0.2 0, 0.2 1)\n"
                           "joint name=h LINESTRING (0 0.3, 1 0.3)";
  expect_areas(merged(text, 0.), {0.06, 0.14, 0.24, 0.56});
  const auto mesh = merged(text, 0.1);
  expect_areas(mesh, {0.14, 0.3, 0.56});
  ASSERT_EQ(mesh.merged_blocks().size(), 1u);
  const NMM::CleaningAction &action = mesh.merged_blocks().front();
  EXPECT_EQ(action.kind, NMM::CleaningAction::Kind::merged_block);
  EXPECT_EQ(action.curve, "v");
  EXPECT_NEAR(action.area, 0.06, 1e-15);
  EXPECT_NEAR(action.distance, 0.3, 1e-15);
  EXPECT_TRUE(mesh.notices().empty());
  // The lower block has one region without a joint inside; the former joint leaves no tip.
  EXPECT_EQ(mesh.regions().size(), 3u);
  EXPECT_EQ(mesh.dangling_ends().n_kept, 0u);
}


// The limit is not reached at once: 0.02 + 0.04 is still below 0.07, and goes on into 0.14.
TEST(SmallBlocks, SmallestFirstUntilNoneIsSmall)
{
  const auto mesh = merged(unit_square +
                             "joint LINESTRING (0.02 0, 0.02 1)\n"
                             "joint LINESTRING (0.06 0, 0.06 1)\n"
                             "joint LINESTRING (0.2 0, 0.2 1)",
                           0.07);
  expect_areas(mesh, {0.2, 0.8});
  ASSERT_EQ(mesh.merged_blocks().size(), 2u);
  EXPECT_NEAR(mesh.merged_blocks()[0].area, 0.02, 1e-15);
  EXPECT_NEAR(mesh.merged_blocks()[1].area, 0.06, 1e-15);
}


TEST(SmallBlocks, IslandsAndHoles)
{
  // A block inside of another one, with a hole of its own.
  const std::string island = unit_square +
                             "joint POLYGON ((0.4 0.4, 0.6 0.4, 0.6 0.6, 0.4 "
                             "0.6))\n"
                             "hole POLYGON ((0.45 0.45, 0.55 0.45, 0.55 0.55, "
                             "0.45 0.55))";
  expect_areas(merged(island, 0.), {0.03, 0.96});
  expect_areas(merged(island, 0.05), {0.99});
  EXPECT_EQ(merged(island, 0.05).regions().size(), 1u);

  // Two halves of a disk, which become one, and then a part of the plate.
  const auto disk = merged(unit_square +
                             "joint name=rim CIRCLE (0.5 0.5, 0.125)\n"
                             "joint name=cut LINESTRING (0.375 0.5, 0.625 0.5)",
                           0.05);
  expect_areas(disk, {1.});
  EXPECT_EQ(disk.merged_blocks().size(), 2u);
  // A half of the rim is longer than the diameter.
  EXPECT_EQ(disk.merged_blocks()[0].curve, "rim");
  EXPECT_EQ(disk.dangling_ends().n_kept, 0u);
}


// A crack from a joint that vanishes has two tips.
TEST(SmallBlocks, CracksStay)
{
  const std::string text = unit_square +
                           "joint name=v LINESTRING (0.1 0, 0.1 1)\n"
                           "joint name=crack LINESTRING (0.1 0.5, 0.4 0.5)";
  EXPECT_EQ(merged(text, 0.).dangling_ends().n_kept, 1u);
  const auto mesh = merged(text, 0.2);
  expect_areas(mesh, {1.});
  EXPECT_EQ(mesh.dangling_ends().n_kept, 2u);
  ASSERT_EQ(mesh.dangling_ends().tips.size(), 2u);
  EXPECT_NEAR(mesh.dangling_ends().length_kept, 0.3, 1e-15);
  for (const Point &tip : mesh.dangling_ends().tips)
    EXPECT_NEAR(std::abs(tip[0] - 0.25), 0.15, 1e-15);
}


// An interface stays, and bonds what the joint on it separated.
TEST(SmallBlocks, InterfacesStay)
{
  const auto mesh = merged(
    "boundary material=a POLYGON ((0 0, 1 0, 1 1, 0 1))\n"
    "interface name=lens material=b CIRCLE (0.5 0.5, 0.1)\n"
    "joint name=rim CIRCLE (0.5 0.5, 0.1)",
    0.1);
  EXPECT_EQ(mesh.n_blocks(), 1u);
  ASSERT_EQ(mesh.regions().size(), 2u);
  EXPECT_EQ(material_at(mesh, 0), "a");
  EXPECT_EQ(material_at(mesh, 1), "b");
  EXPECT_NEAR(mesh.regions()[1].area, 0.01 * M_PI, 1e-14);
}


// A block has the material of its neighbour, also where a record names another one.
TEST(SmallBlocks, MaterialOfTheNeighbour)
{
  const std::string text =
    "boundary material=a POLYGON ((0 0, 1 0, 1 1, 0 1))\n"
    "joint LINESTRING (0.1 0, 0.1 1)\n"
    "material name=b POINT (0.05 0.5)";
  const auto mesh = merged(text, 0.2);
  ASSERT_EQ(mesh.regions().size(), 1u);
  EXPECT_EQ(material_at(mesh, 0), "a");
}


// What has no joint around it stays, and is named.
TEST(SmallBlocks, DomainsStay)
{
  const auto mesh =
    merged(unit_square +
             "boundary name=small POLYGON ((2 0, 2.1 0, 2.1 0.1, 2 0.1))",
           0.05);
  expect_areas(mesh, {0.01, 1.});
  ASSERT_EQ(mesh.notices().size(), 1u);
  expect_parts(mesh.notices().front(), {"0.01 m^2", "(2.05, 0.05)", "merged"});
}


// Two sets of joints with a mean of 0.01 m^2 a block; whatever the limit, the
// area is kept, and no block is smaller.
TEST(SmallBlocks, Networks)
{
  std::string text = unit_square;
  for (unsigned int i = 0; i < 12; ++i)
  {
    const double a = (i + 0.4 + 0.3 * std::sin(7. * i)) / 12.,
                 b = (i + 0.5 + 0.3 * std::cos(5. * i)) / 12.;
    text += "joint LINESTRING (" + std::to_string(a) + " -0.1, " +
            std::to_string(b) + " 1.1)\njoint LINESTRING (-0.1 " +
            std::to_string(b) + ", 1.1 " + std::to_string(a) + ")\n";
  }
  const unsigned int n = merged(text, 0.).n_blocks();
  EXPECT_GT(n, 120u);
  for (const double limit : {0.001, 0.003, 0.01, 0.03, 0.3})
  {
    SCOPED_TRACE(limit);
    const auto                mesh  = merged(text, limit);
    const std::vector<double> areas = block_areas(mesh);
    EXPECT_GE(areas.front(), limit);
    EXPECT_EQ(areas.size() + mesh.merged_blocks().size(), n);
    EXPECT_NEAR(total_area(mesh), 1., 1e-13);
    EXPECT_EQ(mesh.regions().size(), mesh.n_blocks());
  }
}


TEST(SmallBlocks, BadAreas)
{
  NMM::Geometry geometry;
  for (const double area : {-1., double(NAN), double(INFINITY)})
    EXPECT_THROW(geometry.merge_blocks_below(area), NMM::InputError);
}
