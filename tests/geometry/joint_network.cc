#include <nmm/geometry/joint_network.h>

#include "test_helpers.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace NMM;
using namespace geometry_test;

namespace
{
  Geometry
  square(const double size)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {size, 0.}, {size, size}, {0., size}},
                         "square");
    return geometry;
  }


  JointSet
  make_set(const std::string &name, const double dip, const double spacing)
  {
    JointSet set;
    set.name    = name;
    set.dip     = dip;
    set.spacing = spacing;
    return set;
  }


  PhysicalMesh
  cut(Geometry geometry, const std::vector<JointSet> &sets)
  {
    for (const JointSet &set : sets)
      for (Curve &joint : make_joints(set, geometry))
        geometry.add(std::move(joint));
    return PhysicalMesh(std::move(geometry));
  }


  double
  length(const Curve &joint)
  {
    return joint.start().distance(joint.end());
  }


  /// Length of the part of a joint inside the square from 0 to @p size.
  double
  length_inside(const Curve &joint, const double size)
  {
    const Point d     = Point(joint.end() - joint.start());
    double      first = 0., last = 1.;
    for (unsigned int c = 0; c < 2; ++c)
    {
      if (d[c] == 0.)
      {
        if (joint.start()[c] < 0. || joint.start()[c] > size)
          return 0.;
        continue;
      }
      const double a = -joint.start()[c] / d[c];
      const double b = (size - joint.start()[c]) / d[c];
      first          = std::max(first, std::min(a, b));
      last           = std::min(last, std::max(a, b));
    }
    return std::max(0., last - first) * d.norm();
  }


  // A spacing d that divides the square gives (size/d)^2 equal blocks, and with an
  // offset lines lie elsewhere.
  TEST(JointNetwork, ThroughGoingSetsMakeRectangles)
  {
    JointSet flat   = make_set("flat", 0., 2.);
    flat.offset     = 1.;
    const auto mesh = cut(square(10.), {flat, make_set("steep", 90., 2.5)});
    // rows of height 1, 2, 2, 2, 2, 1 in columns of 2.5; 0 and 10 are boundaries
    EXPECT_EQ(mesh.n_blocks(), 6u * 4u);
    unsigned int n_low = 0;
    for (const auto &region : mesh.regions())
    {
      const bool is_low = region.area < 3.;
      n_low += is_low;
      // coordinates are multiples of 2^-37
      EXPECT_NEAR(region.area, is_low ? 2.5 : 5., 1e-9);
    }
    EXPECT_EQ(n_low, 8u);
    EXPECT_TRUE(mesh.notices().empty());
    EXPECT_EQ(mesh.dangling_ends().n_kept, 0u);
    std::set<std::string> names;
    for (const Curve &curve : mesh.curves())
      names.insert(curve.name);
    EXPECT_EQ(names, (std::set<std::string>{"flat", "square", "steep"}));
  }


  // What is outside of a domain that is no rectangle does not count, exactly.
  TEST(JointNetwork, IsClippedToTheSolid)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {4., 0.}, {0., 4.}}, "triangle");
    geometry.add_circle({1., 1.}, 0.25, "bore", CurveRole::hole);
    const auto mesh = cut(std::move(geometry), {make_set("steep", 90., 1.)});
    // at x = 1, 2, 3; the bore lies on the first one
    EXPECT_EQ(mesh.n_blocks(), 4u);
    EXPECT_NEAR(total_area(mesh), 8. - dealii::numbers::PI / 16., 1e-12);
    EXPECT_EQ(mesh.dangling_ends().n_kept, 0u);
    EXPECT_TRUE(mesh.notices().empty());
  }


  // Crossings of the joints inside an L of three quarters of a square, counted, against
  // the estimate: lines along its edges count as a whole or not, which is a spacing by
  // the size, below 1 %; the area is known to 1 %. Traces cross at random: their number
  // of about 5,600 scatters by its root at most, 1.4 %.
  TEST(JointNetwork, CrossingsAreEstimated)
  {
    Geometry geometry;
    geometry.add_polygon(
      {{0., 0.}, {100., 0.}, {100., 50.}, {50., 50.}, {50., 100.}, {0., 100.}},
      "L");
    std::vector<JointSet> sets = {make_set("a", 0., 0.5),
                                  make_set("b", 60., 0.7)};
    for (const double persistence : {1., 0.55})
    {
      SCOPED_TRACE(persistence);
      for (JointSet &set : sets)
      {
        set.persistence  = persistence;
        set.trace_length = persistence < 1. ? 3. : 0.;
      }
      const auto a        = make_joints(sets[0], geometry),
                 b        = make_joints(sets[1], geometry);
      unsigned int n      = 0;
      double       length = 0.;
      for (const Curve &flat : a)
      {
        const double y = flat.start()[1];
        if (y >= 0. && y <= 100.)
          length += std::max(0.,
                             std::min(flat.end()[0], y <= 50. ? 100. : 50.) -
                               std::max(flat.start()[0], 0.));
        for (const Curve &steep : b)
        {
          // where the second one is at the height of the first one
          const double t = (y - steep.start()[1]) /
                           (steep.end()[1] - steep.start()[1]),
                       x = steep.start()[0] +
                           t * (steep.end()[0] - steep.start()[0]);
          n += t >= 0. && t <= 1. && x >= flat.start()[0] &&
               x <= flat.end()[0] && x >= 0. && y >= 0. && x <= 100. &&
               y <= 100. && (x <= 50. || y <= 50.);
        }
      }
      EXPECT_NEAR(estimate_length({sets[0]}, geometry), length, 0.04 * length);
      EXPECT_NEAR(estimate_crossings(sets, geometry), n, 0.04 * n);
    }
    sets[1].dip = sets[0].dip;
    EXPECT_EQ(estimate_crossings(sets, geometry), 0.);
  }


  TEST(JointNetwork, MeansOfScatteredSets)
  {
    JointSet set        = make_set("set", 30., 0.5);
    set.dip_scatter     = 5.;
    set.spacing_scatter = 0.5;
    for (const unsigned int seed : {1u, 2u, 77u})
    {
      SCOPED_TRACE(seed);
      set.seed          = seed;
      const auto joints = make_joints(set, square(100.));
      double     sum = 0., squares = 0.;
      for (const Curve &joint : joints)
      {
        const Point  d   = Point(joint.end() - joint.start());
        const double dip = std::atan2(d[1], d[0]) * 180. / dealii::numbers::PI;
        EXPECT_NEAR(dip, 30., 5. + 1e-9);
        sum += dip;
        squares += (dip - 30.) * (dip - 30.);
      }
      const double n = joints.size();
      // Uniform: deviation 5 / sqrt(3); four deviations of the mean, and of the
      // variance, which is 4 d^4 / 45.
      EXPECT_NEAR(sum / n, 30., 4. * 5. / std::sqrt(3. * n));
      EXPECT_NEAR(squares / n, 25. / 3., 4. * std::sqrt(4. * 625. / 45. / n));
    }
  }


  TEST(JointNetwork, SpacingKeepsItsMean)
  {
    JointSet set        = make_set("set", 0., 0.5);
    set.spacing_scatter = 0.8;
    const auto joints   = make_joints(set, square(100.));
    double     smallest = 10., largest = 0.;
    for (unsigned int i = 1; i < joints.size(); ++i)
    {
      const double spacing = joints[i].start()[1] - joints[i - 1].start()[1];
      smallest             = std::min(smallest, spacing);
      largest              = std::max(largest, spacing);
    }
    const double mean = (joints.back().start()[1] - joints.front().start()[1]) /
                        (joints.size() - 1.);
    // both ends are moved by at most 0.4 of a spacing
    EXPECT_NEAR(mean, 0.5, 0.8 * 0.5 / (joints.size() - 1.));
    EXPECT_GE(smallest, 0.5 * 0.2 - 1e-9);
    EXPECT_LE(largest, 0.5 * 1.8 + 1e-9);
    // it does scatter: of 200 triangular numbers some are in the outer parts
    EXPECT_LT(smallest, 0.5 * 0.5);
    EXPECT_GT(largest, 0.5 * 1.5);
  }


  // P21 = p / s, P20 = p / (s L), and lengths within their limits.
  TEST(JointNetwork, PersistenceAndIntensities)
  {
    JointSet set             = make_set("set", 20., 0.8);
    set.persistence          = 0.7;
    set.trace_length         = 2.5;
    set.trace_length_scatter = 0.4;
    constexpr double size    = 100.;
    for (const unsigned int seed : {3u, 4u})
    {
      SCOPED_TRACE(seed);
      set.seed         = seed;
      double length_21 = 0., sum = 0.;
      int    n_middles = 0, n_whole = 0;
      for (const Curve &joint : make_joints(set, square(size)))
      {
        length_21 += length_inside(joint, size);
        const Point middle =
          joint.start() + 0.5 * (joint.end() - joint.start());
        n_middles += middle[0] > 0. && middle[0] < size && middle[1] > 0. &&
                     middle[1] < size;
        if (std::abs(length_inside(joint, size) - length(joint)) < 1e-9)
        {
          EXPECT_GE(length(joint), 2.5 * 0.6 - 1e-9);
          EXPECT_LE(length(joint), 2.5 * 1.4 + 1e-9);
          sum += length(joint);
          ++n_whole;
        }
      }
      // 125 lines of up to 106 m with 30 traces each: 3500 traces. Deviation of
      // a length 0.4 / sqrt(3); the border cuts 400 m / (0.8 m) places in two.
      EXPECT_NEAR(length_21 / (size * size), 0.7 / 0.8, 0.01 * 0.7 / 0.8);
      EXPECT_NEAR(n_middles / (size * size),
                  0.7 / (0.8 * 2.5),
                  0.01 * 0.7 / (0.8 * 2.5));
      EXPECT_NEAR(sum / n_whole,
                  2.5,
                  4. * 2.5 * 0.4 / std::sqrt(3. * n_whole) + 0.01);
    }
  }


  TEST(JointNetwork, TracesOfALineDoNotMeet)
  {
    JointSet set             = make_set("set", 0., 1.);
    set.persistence          = 0.9;
    set.trace_length         = 3.;
    set.trace_length_scatter = 1. / 0.9 - 1.;
    const auto joints        = make_joints(set, square(50.));
    for (unsigned int i = 1; i < joints.size(); ++i)
    {
      const bool is_next = joints[i].start()[1] == joints[i - 1].start()[1];
      EXPECT_TRUE(!is_next ||
                  joints[i].start()[0] >= joints[i - 1].end()[0] - 1e-9);
    }
  }


  // The numbers are part of the interface: the same on every machine.
  TEST(JointNetwork, TheSameSeedMeansTheSameNetwork)
  {
    JointSet set             = make_set("set", 25., 1.);
    set.dip_scatter          = 10.;
    set.spacing_scatter      = 0.3;
    set.persistence          = 0.6;
    set.trace_length         = 2.;
    set.trace_length_scatter = 0.5;
    set.seed                 = 12345;
    const auto joints        = make_joints(set, square(8.));
    const auto again         = make_joints(set, square(8.));
    ASSERT_EQ(joints.size(), again.size());
    for (unsigned int i = 0; i < joints.size(); ++i)
    {
      EXPECT_EQ(joints[i].start(), again[i].start());
      EXPECT_EQ(joints[i].end(), again[i].end());
    }
    double sum = 0.;
    for (const Curve &joint : joints)
      sum += joint.start()[0] + 2. * joint.end()[1];
    // found once, frozen
    EXPECT_EQ(joints.size(), 30u);
    EXPECT_NEAR(sum, 357.58431661107898, 1e-9);
    set.seed         = 12346;
    const auto other = make_joints(set, square(8.));
    EXPECT_TRUE(other.size() != joints.size() ||
                other.front().start() != joints.front().start());
  }


  // A larger solid has more of the same network.
  TEST(JointNetwork, DoesNotDependOnTheSolid)
  {
    JointSet set        = make_set("set", 0., 1.);
    set.spacing_scatter = 0.5;
    std::set<double> small, large;
    for (const Curve &joint : make_joints(set, square(5.)))
      small.insert(joint.start()[1]);
    for (const Curve &joint : make_joints(set, square(50.)))
      large.insert(joint.start()[1]);
    // the unit coordinates are rounded to depends on the size
    for (const double y : small)
      EXPECT_NEAR(*large.lower_bound(y - 1e-9), y, 1e-9);
  }


  // Drawn joints that reach a micrometre beyond the layers of a set divide the rock in the
  // coordinates of a map, too: the set is rounded as coordinates are there, by 1e-9 m.
  TEST(JointNetwork, DividesTheRockAnywhere)
  {
    // The offset keeps the layers away from the corners of the rock.
    constexpr double beyond = 1e-6, offset = 0.3;
    const double     angle    = 30. * dealii::numbers::PI / 180.;
    const Point      along    = {std::cos(angle), std::sin(angle)};
    const Point      across   = {-std::sin(angle), std::cos(angle)};
    const auto       n_blocks = [&](const Point &origin) {
      Geometry geometry;
      geometry.add_polygon({origin,
                            origin + Point(20., 0.),
                            origin + Point(20., 12.),
                            origin + Point(0., 12.)},
                           "rock");
      for (const double s : {6., 10., 14.})
      {
        const Point from(origin + s * along + (offset - beyond) * across);
        geometry.add_polyline({from, from + Point((2. + 2. * beyond) * across)},
                              "cross",
                              CurveRole::joint);
      }
      JointSet layers = make_set("layers", 30., 2.);
      layers.offset   = origin * across + offset;
      return cut(std::move(geometry), {layers}).n_blocks();
    };
    const unsigned int expected = n_blocks({0., 0.});
    EXPECT_EQ(n_blocks({0., 1e4}), expected);
    EXPECT_EQ(n_blocks({5e5, 6.7e6}), expected);
  }


  // A region is no part of the physical mesh: joints end on its border exactly, and
  // where it runs along a fault there is no gap.
  TEST(JointNetwork, WithinARegion)
  {
    Geometry geometry = square(10.);
    // rises by 1/3: no double lies exactly on it
    geometry.add_polyline({{0., 3.}, {10., 10. / 3. + 3.}},
                          "fault",
                          CurveRole::joint);
    Curve region;
    region.name   = "below";
    region.pieces = {CurvePiece::segment({0., 0.}, {10., 0.}),
                     CurvePiece::segment({10., 0.}, {10., 10. / 3. + 3.}),
                     CurvePiece::segment({10., 10. / 3. + 3.}, {0., 3.}),
                     CurvePiece::segment({0., 3.}, {0., 0.})};
    geometry.add_region(region);
    JointSet set    = make_set("set", 80., 1.5);
    set.within      = "below";
    const auto mesh = cut(geometry, {set});
    // all of the set's parts divide what is below, and the rest is one block
    unsigned int n_above = 0;
    double       above   = 0.;
    for (const auto &r : mesh.regions())
      if (r.inside[1] > 3. + r.inside[0] / 3.)
      {
        ++n_above;
        above += r.area;
      }
    EXPECT_EQ(n_above, 1u);
    EXPECT_NEAR(above, 100. - 10. * (3. + 10. / 3. + 3.) / 2., 1e-9);
    EXPECT_EQ(mesh.n_blocks(), 1u + 8u);
    EXPECT_EQ(mesh.dangling_ends().n_kept, 0u);
  }


  TEST(JointNetwork, WithinADomain)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {4., 0.}, {4., 4.}, {0., 4.}}, "left");
    geometry.add_polygon({{4., 0.}, {8., 0.}, {8., 4.}, {4., 4.}}, "right");
    JointSet set    = make_set("set", 0., 1.);
    set.within      = "right";
    const auto mesh = cut(geometry, {set});
    EXPECT_EQ(mesh.n_blocks(), 1u + 4u);
    set.within = "middle";
    expect_parts(error_of([&]() { cut(geometry, {set}); }),
                 {"'set'", "'middle'", "region"});
  }


  // A crack with a tip at each end, a stub on it, and a joint that divides.
  TEST(JointNetwork, DanglingEnds)
  {
    Geometry geometry = square(4.);
    geometry.add_polyline({{0., 2.}, {4., 2.}}, "through", CurveRole::joint);
    geometry.add_polyline({{1., 2.}, {1., 3.}}, "stub", CurveRole::joint);
    geometry.add_polyline({{2., 0.5}, {3., 0.5}}, "crack", CurveRole::joint);
    const PhysicalMesh kept(geometry);
    EXPECT_EQ(kept.dangling_ends().n_kept, 3u);
    EXPECT_NEAR(kept.dangling_ends().length_kept, 2., 1e-14);
    EXPECT_EQ(kept.n_blocks(), 2u);

    for (Curve &curve : geometry.curves())
      curve.drops_ends = curve.role == CurveRole::joint;
    const PhysicalMesh dropped(geometry);
    EXPECT_EQ(dropped.dangling_ends().n_kept, 0u);
    EXPECT_EQ(dropped.dangling_ends().n_dropped, 3u);
    EXPECT_NEAR(dropped.dangling_ends().length_dropped, 2., 1e-14);
    EXPECT_EQ(dropped.n_blocks(), 2u);
    EXPECT_NEAR(total_area(dropped), 16., 1e-14);
    // the foot of the stub is no corner of the joint any more: without it
    // nothing would have been there
    Geometry plain = square(4.);
    plain.add_polyline({{0., 2.}, {4., 2.}}, "through", CurveRole::joint);
    EXPECT_EQ(dropped.notices().size(), PhysicalMesh(plain).notices().size());
  }


  // An excavation may reach beyond the solid and overlap another one.
  TEST(Regions, Excavations)
  {
    Geometry   geometry = square(4.);
    const auto add_pit  = [&](const std::string &name, const double x) {
      Curve pit;
      pit.name       = name;
      pit.role       = CurveRole::hole;
      pit.is_clipped = true;
      pit.pieces     = {CurvePiece::segment({x, 3.}, {x + 1., 3.}),
                        CurvePiece::segment({x + 1., 3.}, {x + 1., 5.}),
                        CurvePiece::segment({x + 1., 5.}, {x, 5.}),
                        CurvePiece::segment({x, 5.}, {x, 3.})};
      geometry.add(pit);
    };
    add_pit("first", 1.);
    add_pit("second", 1.5);
    const PhysicalMesh mesh(geometry);
    EXPECT_EQ(mesh.n_blocks(), 1u);
    EXPECT_NEAR(total_area(mesh), 16. - 1.5, 1e-14);
  }


  TEST(Regions, Materials)
  {
    Geometry geometry = square(4.);
    geometry.add_polyline({{0., 2.}, {4., 2.}}, "seam", CurveRole::joint);
    Curve region;
    region.name   = "top";
    region.pieces = {CurvePiece::circle({2., 4.}, 1.9)};
    geometry.add_region(region);
    geometry.add_material_region("top", "soil");
    const PhysicalMesh mesh(geometry);
    ASSERT_EQ(mesh.regions().size(), 2u);
    for (const auto &r : mesh.regions())
      EXPECT_EQ(r.material, r.inside[1] > 2. ? 0u : invalid_index);
    EXPECT_EQ(mesh.material_names(), std::vector<std::string>{"soil"});
    expect_parts(error_of([&]() { geometry.add_region(region); }),
                 {"'top'", "two"});
    expect_parts(error_of(
                   [&]() { geometry.add_material_region("base", "soil"); }),
                 {"'base'"});
    region.name   = "far";
    region.pieces = {CurvePiece::circle({20., 4.}, 1.)};
    geometry.add_region(region);
    geometry.add_material_region("far", "soil");
    expect_parts(error_of([&]() { PhysicalMesh m(geometry); }),
                 {"'far'", "'soil'"});
  }


  TEST(JointNetwork, BadSets)
  {
    const auto expect = [](const auto                     &change,
                           const std::vector<std::string> &parts) {
      JointSet set = make_set("set", 0., 1.);
      change(set);
      expect_parts(error_of([&]() { set.check(); }), parts);
    };
    expect([](JointSet &s) { s.spacing = 0.; }, {"'set'", "spacing", "0 m"});
    expect([](JointSet &s) { s.spacing = -2.; }, {"spacing", "-2 m"});
    expect([](JointSet &s) { s.persistence = 0.; }, {"persistence", "0"});
    expect([](JointSet &s) { s.persistence = 1.5; }, {"persistence", "1.5"});
    expect([](JointSet &s) { s.persistence = 0.5; }, {"trace length", "0 m"});
    expect([](JointSet &s) { s.trace_length = 2.; }, {"trace length"});
    expect([](JointSet &s) { s.spacing_scatter = 1.; }, {"scatter", "1"});
    expect([](JointSet &s) { s.dip_scatter = -1.; }, {"dip", "-1"});
    expect(
      [](JointSet &s) {
        s.persistence          = 0.8;
        s.trace_length         = 1.;
        s.trace_length_scatter = 0.3;
      },
      {"scatter", "0.3", "0.25"});
    JointSet set = make_set("set", 0., 1e-9);
    expect_parts(error_of([&]() { make_joints(set, square(1.)); }),
                 {"'set'", "traces"});
  }

} // namespace
