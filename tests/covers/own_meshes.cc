#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/element_support.h>
#include <nmm/covers/own_meshes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "matching.h"
#include "support/random_scenes.h"
#include <gtest/gtest.h>
#include <set>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  struct Model
  {
    PhysicalMesh physical;
    OwnMeshes    own;

    Model(Geometry                     geometry,
          const RegularMeshParameters &parameters,
          const OwnMeshParameters     &own_parameters = {})
      : physical(std::move(geometry))
      , own(make_own_meshes(std::make_unique<MathematicalMesh>(
                              make_regular_mesh(physical, parameters, 2)),
                            physical,
                            own_parameters))
    {
    }

    unsigned int
    region_at(const Point<2> &x) const
    {
      const unsigned int e = own.manifold_mesh->find_element(x);
      return e == invalid_index ? e : own.manifold_mesh->region(e);
    }

    /// Largest share of an element of the region in its cell.
    double
    best_filling(const unsigned int region) const
    {
      double best = 0.;
      for (unsigned int e = 0; e < own.manifold_mesh->n_elements(); ++e)
        if (own.manifold_mesh->region(e) == region)
          best = std::max(best,
                          own.manifold_mesh->area(e) /
                            own.mathematical_mesh->cell_area(
                              own.manifold_mesh->cell(e)));
      return best;
    }

    /// Largest support of an element of the region.
    double
    best_support(const unsigned int region) const
    {
      double best = 0.;
      for (unsigned int e = 0; e < own.manifold_mesh->n_elements(); ++e)
        if (own.manifold_mesh->region(e) == region)
          best = std::max(best, element_support(*own.manifold_mesh, e));
      return best;
    }

    /// Cells that hold elements of the region.
    unsigned int
    n_cells(const unsigned int region) const
    {
      unsigned int n = 0;
      for (unsigned int c = 0; c < own.mathematical_mesh->n_cells(); ++c)
        for (const unsigned int e : own.manifold_mesh->cell_elements(c))
          if (own.manifold_mesh->region(e) == region)
          {
            ++n;
            break;
          }
      return n;
    }
  };

  void
  add_square(Geometry          &geometry,
             const Point<2>    &center,
             const double       size,
             const double       angle,
             const std::string &name,
             const CurveRole    role)
  {
    std::vector<Point<2>> corners;
    for (unsigned int i = 0; i < 4; ++i)
    {
      const double a = angle + (0.25 + 0.5 * i) * dealii::numbers::PI;
      corners.push_back(center + std::sqrt(0.5) * size *
                                   Tensor<1, 2>({std::cos(a), std::sin(a)}));
    }
    geometry.add_polygon(corners, name, role);
  }
} // namespace


TEST(OwnMeshes, NothingHappensWhereNothingIsNeeded)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0.37, 0.), Point<2>(0.52, 1.)},
                        "joint",
                        CurveRole::joint);
  const PhysicalMesh physical(std::move(geometry));
  auto               main_mesh = std::make_unique<MathematicalMesh>(
    make_regular_mesh(physical, skew_mesh(0.1), 2));
  const MathematicalMesh *address = main_mesh.get();
  const OwnMeshes         own = make_own_meshes(std::move(main_mesh), physical);
  EXPECT_EQ(own.mathematical_mesh.get(), address);
  EXPECT_EQ(&own.manifold_mesh->mathematical_mesh(), address);
  EXPECT_TRUE(own.region_to_part.empty());
  EXPECT_TRUE(own.notices.empty());
}


TEST(OwnMeshes, ThinLayerBetweenTwoJoints)
{
  const double h = 0.1;
  for (const double thickness : {1e-3 * h, 1e-6 * h, 1e-9 * h})
    for (const double slope : {0., 0.3, 1.})
    {
      SCOPED_TRACE(thickness);
      SCOPED_TRACE(slope);
      Geometry     geometry = make_box(1., 1.);
      const double y        = 0.4321 - 0.4 * slope;
      const double up       = thickness * std::sqrt(1. + slope * slope);
      geometry.add_polyline({Point<2>(0., y), Point<2>(1., y + slope)},
                            "lower",
                            CurveRole::joint);
      geometry.add_polyline({Point<2>(0., y + up),
                             Point<2>(1., y + up + slope)},
                            "upper",
                            CurveRole::joint);
      const Model model(std::move(geometry), skew_mesh(h));
      ASSERT_EQ(model.own.region_to_part.size(), 3u);
      unsigned int layer = invalid_index;
      for (unsigned int r = 0; r < 3; ++r)
        if (model.own.region_to_part[r] != 0)
          layer = r;
      ASSERT_NE(layer, invalid_index);
      const double area = model.physical.regions()[layer].area;
      EXPECT_GT(model.best_filling(layer), 0.25);
      // h is the longest edge of a cell
      EXPECT_LE(model.n_cells(layer), 2. * std::ceil(1.5 / h));
      const std::vector<double> areas = region_areas(*model.own.manifold_mesh);
      for (unsigned int r = 0; r < 3; ++r)
        EXPECT_NEAR(areas[r], model.physical.regions()[r].area, 1e-14);
      // coordinates of size 1 are rounded: so is the thickness
      EXPECT_NEAR(areas[layer] / area, 1., 1e-12 + 1e-14 / thickness);
      // two joints, from both sides, and what is of them in the box
      const double part = std::min(1., (1. - y) / std::max(slope, 1e-3)) -
                          std::max(0., -y / std::max(slope, 1e-3));
      EXPECT_NEAR(expect_matching_edges(*model.own.manifold_mesh),
                  4. * part * std::sqrt(1. + slope * slope),
                  4. * thickness + 1e-12);
      EXPECT_EQ(n_connected_sets(*model.own.manifold_mesh), 3u);
      ASSERT_EQ(model.own.notices.size(), 1u);
      EXPECT_NE(model.own.notices[0].find("one row of halved rectangles"),
                std::string::npos)
        << model.own.notices[0];
      EXPECT_EQ(model.region_at(model.physical.regions()[layer].inside), layer);

      // the affine map keeps its accuracy: a point of the layer comes back
      for (unsigned int e = 0; e < model.own.manifold_mesh->n_elements(); ++e)
        if (model.own.manifold_mesh->region(e) == layer)
        {
          const MathematicalMesh &mesh = *model.own.mathematical_mesh;
          const unsigned int      c    = model.own.manifold_mesh->cell(e);
          const Tensor<2, 2> unit = invert(mesh.jacobian(c)) * mesh.jacobian(c);
          EXPECT_NEAR((unit - unit_symmetric_tensor<2>()).norm(), 0., 1e-6);
        }
    }
}


TEST(OwnMeshes, TinyBlockOfItsOwnOrCutByJoints)
{
  const double h = 0.2;
  for (const double size : {1e-1, 1e-2, 1e-4, 1e-6})
    for (const CurveRole role : {CurveRole::joint, CurveRole::boundary})
    {
      SCOPED_TRACE(size);
      Geometry geometry = make_box(1., 1.);
      // its own closed domain lies in a hole of the frame
      const Point<2> center(0.4321, 0.5678);
      if (role == CurveRole::boundary)
        add_square(
          geometry, center, 1.5 * size * h, 0.3, "hole", CurveRole::hole);
      add_square(geometry, center, size * h, 0.3, "block", role);
      const Model        model(std::move(geometry), skew_mesh(h));
      const unsigned int block = model.region_at(center);
      ASSERT_NE(block, invalid_index);
      ASSERT_EQ(model.own.region_to_part.size(), 2u);
      EXPECT_EQ(model.own.region_to_part[block], 1u);
      EXPECT_EQ(model.own.region_to_part[1 - block], 0u);
      // one triangle, twelve unknowns
      EXPECT_EQ(model.own.mathematical_mesh->part_cells(1).second -
                  model.own.mathematical_mesh->part_cells(1).first,
                1u);
      // a square fills at most half of a triangle
      EXPECT_GT(model.best_filling(block), 0.4);
      EXPECT_LT(model.best_filling(block), 0.5);
      const std::vector<double> areas = region_areas(*model.own.manifold_mesh);
      EXPECT_NEAR(areas[block] / (size * size * h * h),
                  1.,
                  1e-12 + 1e-15 / (size * h));
      EXPECT_NEAR(expect_matching_edges(*model.own.manifold_mesh),
                  role == CurveRole::joint ? 8. * size * h : 0.,
                  1e-14);
      const CoverSystem covers(*model.own.manifold_mesh, MPI_COMM_SELF);
      for (unsigned int e = 0; e < model.own.manifold_mesh->n_elements(); ++e)
      {
        if (model.own.manifold_mesh->region(e) != block)
          continue;
        for (const unsigned int k : covers.covers(e))
          EXPECT_LT(covers.node(k).distance(center), 3. * size * h);
      }
    }
}


TEST(OwnMeshes, DiskShapedTinyInclusion)
{
  const double radius   = 0.003;
  Geometry     geometry = make_box(1., 1.);
  geometry.add_circle(Point<2>(0.4, 0.6), radius, "disk", CurveRole::interface);
  const Model        model(std::move(geometry), skew_mesh(0.2));
  const unsigned int disk = model.region_at(Point<2>(0.4, 0.6));
  EXPECT_EQ(model.n_cells(disk), 1u);
  // an equilateral triangle around a circle is filled to 0.6046, made larger
  // by a factor 1.08 to 0.5184
  EXPECT_NEAR(model.best_filling(disk),
              dealii::numbers::PI / std::sqrt(27.) / 1.1664,
              0.005);
  EXPECT_NEAR(region_areas(*model.own.manifold_mesh)[disk] /
                (dealii::numbers::PI * radius * radius),
              1.,
              1e-12);
  EXPECT_NEAR(expect_matching_edges(*model.own.manifold_mesh),
              4. * dealii::numbers::PI * radius,
              1e-14);
}


TEST(OwnMeshes, BentLayerIsHalvedUntilItIsFilled)
{
  // a shell of a tenth of a cell
  Geometry geometry = make_box(1., 1.);
  geometry.add_circle(Point<2>(0.5, 0.5), 0.3, "inner", CurveRole::interface);
  geometry.add_circle(Point<2>(0.5, 0.5), 0.31, "outer", CurveRole::interface);
  const Model        model(std::move(geometry), skew_mesh(0.1));
  const unsigned int shell = model.region_at(Point<2>(0.805, 0.5));
  ASSERT_EQ(model.own.region_to_part.size(), 3u);
  EXPECT_NE(model.own.region_to_part[shell], 0u);
  EXPECT_GE(model.best_filling(shell), 0.25);
  EXPECT_NEAR(region_areas(*model.own.manifold_mesh)[shell],
              dealii::numbers::PI * (0.31 * 0.31 - 0.09),
              1e-13);
  // cells inside and outside of the shell are left out
  const auto [first, end] = model.own.mathematical_mesh->part_cells(1);
  EXPECT_LT(end - first, 2 * model.n_cells(shell));
}


// A large block, one that the main mesh resolves as well as asked for, a long one
// and one that is all by itself: each gets what its choice says.
TEST(OwnMeshes, ChosenRegionByRegion)
{
  using Kind = RegionMesh::Kind;
  Geometry                                   geometry;
  const std::array<std::array<double, 4>, 4> boxes = {{{{0., 0., 4., 4.}},
                                                       {{5., 0., 1., 1.}},
                                                       {{7., 0., 2., 0.4}},
                                                       {{10., 0., 1., 1.}}}};
  const std::vector<std::string> names = {"large", "small", "long", "last"};
  for (unsigned int i = 0; i < boxes.size(); ++i)
  {
    const auto &[x, y, w, h] = boxes[i];
    geometry.add_polygon({Point<2>(x, y),
                          Point<2>(x + w, y),
                          Point<2>(x + w, y + h),
                          Point<2>(x, y + h)},
                         names[i]);
  }
  const PhysicalMesh          physical(geometry);
  std::array<unsigned int, 4> regions;
  for (unsigned int i = 0; i < boxes.size(); ++i)
  {
    const auto &[x, y, w, h] = boxes[i];
    regions[i] = find_region(physical, {x + 0.9 * w, y + 0.1 * h});
    ASSERT_LT(regions[i], 4u);
  }
  EXPECT_EQ(std::set<unsigned int>(regions.begin(), regions.end()).size(), 4u);
  EXPECT_EQ(find_region(physical, {4.5, 0.5}), invalid_index);
  EXPECT_NEAR(largest_extent(physical), 4., 1e-12);

  // cells of the blocks that have a mesh of their own
  const auto check = [&](const std::array<RegionMesh, 4>   &choices,
                         const std::array<bool, 4>         &has_own,
                         const std::array<unsigned int, 4> &n_cells) {
    OwnMeshParameters parameters;
    parameters.regions.resize(4);
    for (unsigned int i = 0; i < 4; ++i)
      parameters.regions[regions[i]] = choices[i];
    const Model model(geometry, skew_mesh(0.5), parameters);
    for (unsigned int i = 0; i < 4; ++i)
    {
      const auto &map = model.own.region_to_part;
      EXPECT_EQ(!map.empty() && map[regions[i]] != 0, has_own[i]) << names[i];
      if (has_own[i])
      {
        EXPECT_EQ(model.n_cells(regions[i]), n_cells[i]) << names[i];
      }
    }
  };
  const RegionMesh one{Kind::automatic, 1}, two{Kind::automatic, 2},
    four{Kind::automatic, 4}, eight{Kind::automatic, 8},
    main{Kind::main_mesh, 0}, needed, own{Kind::own, 0}, own_one{Kind::own, 1};
  // cells of 0.5 are small enough for one and two across a block of 1
  check({one, one, one, one}, {false, false, false, false}, {});
  check({two, two, two, two}, {false, false, false, false}, {});
  // 4 x 4 and, across a block of 2 by 0.4, 8 x 2 halved rectangles
  check({four, four, four, four}, {false, true, false, true}, {0, 32, 0, 32});
  check({eight, eight, eight, main},
        {false, true, true, false},
        {0, 128, 32, 0});
  // whatever the main mesh is like
  check({own_one, main, own_one, needed},
        {true, false, true, false},
        {1, 0, 1, 0});
  check({main, own, main, main}, {false, true, false, false}, {0, 8, 0, 0});

  OwnMeshParameters wrong;
  wrong.regions = {one, one};
  EXPECT_THROW(Model(geometry, skew_mesh(0.5), wrong), InputError);
  wrong.regions = {one, one, {Kind::automatic, 0}, one};
  EXPECT_THROW(Model(geometry, skew_mesh(0.5), wrong), InputError);
}


// A crack that ends inside is no border, and arcs are.
TEST(OwnMeshes, RegionsAreFound)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_polyline({Point<2>(0., 0.5), Point<2>(0.7, 0.5)},
                        "crack",
                        CurveRole::joint);
  Curve lens;
  lens.name   = "lens";
  lens.role   = CurveRole::interface;
  lens.pieces = {CurvePiece::circle({0.75, 0.75}, 0.125)};
  geometry.add(lens);
  const PhysicalMesh physical(std::move(geometry));
  const unsigned int outside = find_region(physical, {0.1, 0.1});
  const unsigned int inside  = find_region(physical, {0.75, 0.86});
  EXPECT_NEAR(physical.regions()[inside].area,
              dealii::numbers::PI / 64.,
              1e-12);
  EXPECT_NE(inside, outside);
  for (const Point<2> &x :
       {Point<2>(0.1, 0.9), Point<2>(0.65, 0.66), Point<2>(0.85, 0.45)})
    EXPECT_EQ(find_region(physical, x), outside) << x;
}


TEST(OwnMeshes, SayWhatCannotBeFilled)
{
  Geometry geometry = make_box(1., 1.);
  geometry.add_circle(Point<2>(0.5, 0.5), 0.3, "inner", CurveRole::interface);
  geometry.add_circle(Point<2>(0.5, 0.5),
                      0.30001,
                      "outer",
                      CurveRole::interface);
  const Model model(std::move(geometry), skew_mesh(0.1));
  ASSERT_EQ(model.own.notices.size(), 1u);
  EXPECT_NE(model.own.notices[0].find("threshold"), std::string::npos)
    << model.own.notices[0];
  EXPECT_NEAR(
    region_areas(
      *model.own.manifold_mesh)[model.region_at(Point<2>(0.800005, 0.5))],
    dealii::numbers::PI * (0.30001 * 0.30001 - 0.09),
    1e-13);
}


TEST(OwnMeshes, RandomNetworks)
{
  unsigned int n_own = 0;
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random   random(seed);
    Geometry geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 20, seed % 3 == 0);
    OwnMeshParameters parameters;
    parameters.every_region = seed % 5 == 0;
    const Model               model(std::move(geometry),
                      random_mesh(random, 0.25, seed % 4 == 0),
                      parameters);
    const std::vector<double> areas = region_areas(*model.own.manifold_mesh);
    for (unsigned int r = 0; r < areas.size(); ++r)
    {
      EXPECT_NEAR(areas[r], model.physical.regions()[r].area, 1e-13);
      // joints make convex regions only: those that the main mesh does not hold
      // well can fill another
      const bool on_main_mesh =
        model.own.region_to_part.empty() || model.own.region_to_part[r] == 0;
      EXPECT_GE(on_main_mesh ? model.best_support(r) / parameters.threshold
                             : model.best_filling(r) / parameters.filling,
                1.)
        << "region at " << model.physical.regions()[r].inside;
    }
    expect_matching_edges(*model.own.manifold_mesh);
    EXPECT_EQ(n_connected_sets(*model.own.manifold_mesh), areas.size());
    n_own += model.own.mathematical_mesh->n_parts() - 1;
  }
  EXPECT_GT(n_own, 200u);
}


TEST(OwnMeshes, AreTheSameOnAllRanksMPI)
{
  Random   random(7);
  Geometry geometry = make_box(1., 1.);
  add_random_joints(geometry, random, 20, false);
  const Model model(std::move(geometry), skew_mesh(0.3));
  EXPECT_GT(model.own.mathematical_mesh->n_parts(), 5u);
  const CoverSystem covers(*model.own.manifold_mesh, MPI_COMM_WORLD);
  // numbers that change with any coordinate, element or cover
  std::vector<double> numbers = {static_cast<double>(
                                   model.own.manifold_mesh->n_elements()),
                                 static_cast<double>(covers.n_covers())};
  for (const Point<2> &x : model.own.mathematical_mesh->vertices())
    numbers.push_back(x[0] + dealii::numbers::PI * x[1]);
  for (unsigned int e = 0; e < model.own.manifold_mesh->n_elements(); ++e)
    for (const ElementEdge &edge : model.own.manifold_mesh->edges(e))
      numbers.push_back(edge.start[0] + dealii::numbers::PI * edge.start[1] +
                        edge.neighbor);
  const auto all = Utilities::MPI::all_gather(MPI_COMM_WORLD, numbers);
  for (const std::vector<double> &others : all)
    EXPECT_EQ(others, numbers);
}


// Triangles of coordinates near 1e-9: what was nearly nothing had no mesh, and no
// filling that could be compared.
TEST(OwnMeshes, TinyCoordinates)
{
  Geometry geometry = parse_geometry(
    "boundary name=b POLYGON ((1e-09 0.0, 1e-09 1e-09, "
    "-3.5804183894449036e-18 3.7583083411548024e-10))\n"
    "joint LINESTRING (1.15625e-09 1.234375e-09, "
    "-1.5625000000000005e-10 -2.3437500000000003e-10)\n"
    "joint LINESTRING (5.46875e-10 8.125e-10, "
    "4.53125e-10 1.8750000000000002e-10)\n"
    "joint LINESTRING (1.234375e-09 -2.0312500000000006e-10, "
    "-2.3437500000000003e-10 1.2031250000000002e-09)",
    "test.wkt");
  RegularMeshParameters parameters;
  parameters.cell_size = 1.5e-10;
  parameters.pattern   = MeshPattern::right_angled;
  const Model model(std::move(geometry), parameters);
  double      area = 0.;
  for (unsigned int e = 0; e < model.own.manifold_mesh->n_elements(); ++e)
    area += model.own.manifold_mesh->area(e);
  // half of base times height, rounded some hundred times
  EXPECT_NEAR(area, 0.5 * 1e-9 * (1e-9 + 3.5804183894449036e-18), 1e-31);
}


// What an arc does outside of the solid costs nothing: this one leaves it at once and
// comes back from a distance of 2e8, as a drawing's bulge of 1e9 makes it do.
TEST(OwnMeshes, HugeArc)
{
  Geometry geometry = parse_geometry(
    "boundary name=b POLYGON ((0 0, 1 0, 1 1, 0 1))\n"
    "joint CIRCULARSTRING (0.3 0.5, 0.5 -200000000, 0.7 0.5)",
    "test.wkt");
  RegularMeshParameters parameters;
  parameters.cell_size = 0.3;
  const Model model(std::move(geometry), parameters);
  EXPECT_EQ(model.physical.n_blocks(), 1u);
  double area = 0.;
  for (unsigned int e = 0; e < model.own.manifold_mesh->n_elements(); ++e)
    area += model.own.manifold_mesh->area(e);
  EXPECT_NEAR(area, 1., 1e-12);
}
