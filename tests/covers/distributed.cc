// Meshes of which each rank holds a part: the same elements, covers and roots as on the
// whole mesh, and no more than a part of them.

#include <nmm/base/exceptions.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/covers/rank_cells.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <support/random_scenes.h>
#include <support/same_elements.h>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  const MPI_Comm world = MPI_COMM_WORLD;

  RegularMeshParameters
  lattice(const double cell_size, const double rotation)
  {
    RegularMeshParameters parameters;
    parameters.cell_size = cell_size;
    parameters.offset    = Tensor<1, 2>({0.0123, 0.0321});
    parameters.rotation  = rotation;
    return parameters;
  }


  /// All ranks hold all of one mesh, and each its part of the other one.
  struct Both
  {
    Both(Geometry                     geometry,
         const RegularMeshParameters &parameters,
         const unsigned int           degree)
      : physical(std::move(geometry))
      , whole_cells(make_regular_mesh(physical, parameters, degree))
      , whole(whole_cells, physical)
      , whole_covers(whole, MPI_COMM_SELF)
      , part_cells(make_distributed_mesh(physical, parameters, degree, world))
      , part(part_cells, physical)
      , part_covers(part, world)
    {
      const SameElements same(whole);
      for (unsigned int e = 0; e < part.n_elements(); ++e)
        to_whole.push_back(same.find(part, e));
    }

    PhysicalMesh     physical;
    MathematicalMesh whole_cells;
    ManifoldMesh     whole;
    CoverSystem      whole_covers;
    MathematicalMesh part_cells;
    ManifoldMesh     part;
    CoverSystem      part_covers;
    /// By element of the part.
    std::vector<unsigned int> to_whole;
  };


  void
  expect_same_elements(const Both &both)
  {
    const auto [first, end] = both.part.owned_elements();
    EXPECT_EQ(Utilities::MPI::sum(end - first, world), both.whole.n_elements());
    EXPECT_EQ(Utilities::MPI::sum(both.part.n_cells_cut_exactly(), world),
              both.whole.n_cells_cut_exactly());
    EXPECT_EQ(both.part_cells.dof_handler().n_dofs(),
              both.whole_cells.n_mathematical_covers());
    double area = 0., whole_area = 0.;
    for (unsigned int e = 0; e < both.part.n_elements(); ++e)
    {
      ASSERT_NE(both.to_whole[e], invalid_index);
      EXPECT_EQ(both.part.is_whole(e), both.whole.is_whole(both.to_whole[e]));
      if (e >= first && e < end)
      {
        area += both.part.area(e);
        EXPECT_EQ(both.part.joined(e).size(),
                  both.whole.joined(both.to_whole[e]).size());
      }
    }
    for (const PhysicalMesh::Region &region : both.physical.regions())
      whole_area += region.area;
    EXPECT_NEAR(Utilities::MPI::sum(area, world), whole_area, 1e-12);
  }


  /// Local covers of the part and covers of the whole, one to one.
  std::vector<unsigned int>
  expect_same_covers(const Both &both)
  {
    EXPECT_EQ(both.part_covers.n_global_covers(), both.whole_covers.n_covers());
    EXPECT_EQ(Utilities::MPI::sum(
                both.part_covers.locally_owned_covers().n_elements(), world),
              both.part_covers.n_global_covers());
    std::vector<unsigned int> to_whole(both.part_covers.n_covers(),
                                       invalid_index);
    for (unsigned int e = 0; e < both.part.n_elements(); ++e)
      for (unsigned int i = 0; i < both.part_cells.n_covers_per_cell(); ++i)
      {
        unsigned int      &there = to_whole[both.part_covers.covers(e)[i]];
        const unsigned int here = both.whole_covers.covers(both.to_whole[e])[i];
        EXPECT_TRUE(there == invalid_index || there == here);
        there = here;
      }
    std::vector<unsigned int> sorted = to_whole;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());

    // and through all ranks: the whole's number of each global cover is the same
    std::vector<unsigned int> of_global(both.part_covers.n_global_covers(), 0);
    for (unsigned int k = 0; k < to_whole.size(); ++k)
      of_global[both.part_covers.global_cover(k)] = to_whole[k];
    std::vector<unsigned int> largest(of_global.size());
    Utilities::MPI::max(of_global, world, largest);
    for (unsigned int k = 0; k < to_whole.size(); ++k)
      EXPECT_EQ(largest[both.part_covers.global_cover(k)], to_whole[k]);
    return to_whole;
  }


  void
  expect_same_roots(Both &both, const std::vector<unsigned int> &cover_to_whole)
  {
    const Aggregation part  = aggregate(both.part_covers, 0.1),
                      whole = aggregate(both.whole_covers, 0.1);
    const auto [first, end] = both.part.owned_elements();
    for (unsigned int e = first; e < end; ++e)
    {
      ASSERT_LT(part.element_to_root[e], both.part.n_elements());
      EXPECT_EQ(both.to_whole[part.element_to_root[e]],
                whole.element_to_root[both.to_whole[e]]);
    }
    std::map<unsigned int, unsigned int> cover_to_root(
      whole.cover_to_root.begin(), whole.cover_to_root.end());
    unsigned int n_owned = 0;
    for (const auto &[cover, root] : part.cover_to_root)
    {
      const auto there = cover_to_root.find(cover_to_whole[cover]);
      ASSERT_NE(there, cover_to_root.end());
      EXPECT_EQ(there->second, both.to_whole[root]);
      n_owned += both.part_covers.locally_owned_covers().is_element(
        both.part_covers.global_cover(cover));
    }
    EXPECT_EQ(Utilities::MPI::sum(n_owned, world), cover_to_root.size());
    for (unsigned int k = 0; k < cover_to_whole.size(); ++k)
      EXPECT_EQ(part.is_free[k], whole.is_free[cover_to_whole[k]]);

    // each pair once, by the rank that owns its first element
    const GhostPenalty of_part  = make_ghost_penalty(both.part, 0.1),
                       of_whole = make_ghost_penalty(both.whole, 0.1);
    unsigned int n_pairs        = 0;
    for (const auto &[a, b] : of_part.pairs)
      if (a >= first && a < end)
      {
        ++n_pairs;
        const unsigned int x = both.to_whole[a], y = both.to_whole[b];
        EXPECT_TRUE(
          std::binary_search(of_whole.pairs.begin(),
                             of_whole.pairs.end(),
                             std::make_pair(std::min(x, y), std::max(x, y))));
      }
    EXPECT_EQ(Utilities::MPI::sum(n_pairs, world), of_whole.pairs.size());
  }


  void
  expect_same(Both &both)
  {
    expect_same_elements(both);
    if (Utilities::MPI::max(testing::Test::HasFatalFailure() ? 1 : 0, world))
      return;
    expect_same_roots(both, expect_same_covers(both));
  }
} // namespace


TEST(Distributed, RandomJointsMPI)
{
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 3 + random.below(10), seed % 2 == 1);
    // unrotated meshes of a round size meet snapped joints in their corners
    RegularMeshParameters parameters = lattice(0.05, 20. * seed);
    if (seed % 4 == 1)
    {
      parameters           = RegularMeshParameters();
      parameters.pattern   = MeshPattern::right_angled;
      parameters.cell_size = 1. / 16.;
    }
    Both both(std::move(geometry), parameters, 1 + seed / 2 % 2);
    expect_same(both);
  }
}


// Hardly anything of a thin comb is well supported, so that the best of it becomes a root, one
// after the other through all ranks.
TEST(Distributed, ThinArmsMPI)
{
  Geometry              geometry;
  std::vector<Point<2>> outline = {{0., 0.}};
  for (unsigned int i = 0; i < 7; ++i)
  {
    outline.emplace_back(0.1 + 0.3 * i, 0.);
    outline.emplace_back(0.1 + 0.3 * i, 0.9);
    outline.emplace_back(0.11 + 0.3 * i, 0.9);
    outline.emplace_back(0.11 + 0.3 * i, 0.);
  }
  outline.emplace_back(2., 0.);
  outline.emplace_back(2., -0.008);
  outline.emplace_back(0., -0.008);
  geometry.add_polygon(outline, "comb");
  for (const double rotation : {0., 11.})
  {
    Both both(geometry, lattice(0.06, rotation), 2);
    expect_same(both);
  }
}


// A rank inside a disk whose curves are far away.
TEST(Distributed, HoldsAPartOnlyMPI)
{
  Geometry geometry;
  geometry.add_circle(Point<2>(), 1., "rim", CurveRole::boundary);
  Both both(std::move(geometry), lattice(0.03, 8.), 2);
  expect_same(both);

  const RankCells   &cells   = *both.part_cells.rank_cells();
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(world);
  unsigned int       n_owned = 0;
  for (unsigned int c = 0; c < both.part_cells.n_cells(); ++c)
  {
    n_owned += cells.cell_to_owner[c] == cells.rank;
    EXPECT_EQ(both.part_cells.cell_iterator(c)->is_locally_owned(),
              cells.cell_to_owner[c] == cells.rank);
    EXPECT_EQ(both.part_cells.cell_iterator(c)->is_artificial(),
              cells.is_near[c] == 0);
  }
  // rows and columns are cut whole
  EXPECT_NEAR(n_owned,
              static_cast<double>(cells.n_global_cells) / n_ranks,
              0.05 * cells.n_global_cells);
  // the box of a rank has sides of at most 2 / 0.026 rows, with five around it, two cells each
  EXPECT_LE(both.part_cells.n_cells(), n_owned + 2 * 5 * 4 * (78 + 10));
  if (n_ranks > 1)
  {
    EXPECT_LT(both.part_cells.n_cells(), cells.n_global_cells);
  }
  EXPECT_EQ(Utilities::MPI::sum(n_owned, world), cells.n_global_cells);
}


TEST(Distributed, TooManyRanksMPI)
{
  const PhysicalMesh physical(make_box(1., 1.));
  // one parallelogram
  RegularMeshParameters parameters;
  parameters.pattern   = MeshPattern::right_angled;
  parameters.cell_size = 5.;
  parameters.offset    = Tensor<1, 2>({2.5, 2.5});
  const auto make      = [&]() {
    return make_distributed_mesh(physical, parameters, 2, world);
  };
  if (Utilities::MPI::n_mpi_processes(world) == 1)
    EXPECT_NO_THROW(make());
  else
    EXPECT_THROW(make(), InputError);
}


// A block smaller than the cells would get a mesh of its own.
TEST(Distributed, OwnMeshesAreRefusedMPI)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polygon({{2., 0.}, {2.001, 0.}, {2., 0.001}}, "crumb");
  const PhysicalMesh physical(std::move(geometry));
  const auto         make = [&]() {
    return std::make_unique<MathematicalMesh>(
      make_distributed_mesh(physical, lattice(0.1, 0.), 2, world));
  };
  EXPECT_THROW(make_own_meshes(make(), physical), InputError);
  OwnMeshParameters never;
  never.regions.assign(physical.regions().size(), RegionMesh());
  for (RegionMesh &region : never.regions)
    region.kind = RegionMesh::Kind::main_mesh;
  EXPECT_NO_THROW(make_own_meshes(make(), physical, never));
}
