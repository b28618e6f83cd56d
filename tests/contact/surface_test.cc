// ContactSurface: which edge follows which, and places with their derivatives.

#include <contact/contact_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Corner = ContactSurface::Corner;

  /// A box with a round hole, a crack from the left side to the inside, a
  /// crack inside, and a joint through everything.
  std::unique_ptr<Bodies>
  cracked_box(const unsigned int degree)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {3., 1.});
    geometry.add_circle({1.6, 0.5}, 0.23, "hole", CurveRole::hole);
    geometry.add_polyline({{0., 0.5}, {0.6, 0.5}},
                          "notch",
                          CurveRole::joint,
                          JointState::open);
    geometry.add_polyline({{0.8, 0.2}, {1.1, 0.8}},
                          "inner crack",
                          CurveRole::joint,
                          JointState::open);
    geometry.add_polyline({{2.4, -0.1}, {2.5, 1.1}},
                          "joint",
                          CurveRole::joint,
                          JointState::open);
    Bodies::Options options;
    options.degree    = degree;
    options.cell_size = 0.31;
    options.rotation  = 7.;
    return std::make_unique<Bodies>(std::move(geometry), options);
  }


  TEST(ContactSurface, ChainsCloseAndMeasureTheBoundary)
  {
    const auto  bodies = cracked_box(2);
    const auto &edges  = bodies->surface.edges();
    // every face once: box, hole, both faces of cracks and joint
    double length = 0.;
    for (const auto &edge : edges)
      length += edge.length;
    const double pi      = dealii::numbers::PI;
    const double slanted = std::hypot(1., 0.1 / 1.2);
    EXPECT_NEAR(length,
                8. + 2. * pi * 0.23 + 2. * (0.6 + std::hypot(0.3, 0.6)) +
                  2. * slanted,
                1e-12);

    // loops: outline with the notch, hole, inner crack; the other block
    std::vector<bool>         is_done(edges.size(), false);
    std::vector<unsigned int> n_corners;
    unsigned int              n_concave = 0, n_convex = 0;
    for (unsigned int first = 0; first < edges.size(); ++first)
    {
      if (is_done[first])
        continue;
      n_corners.push_back(0);
      unsigned int e = first;
      do
      {
        ASSERT_FALSE(is_done[e]);
        is_done[e] = true;
        ASSERT_NE(edges[e].next, invalid_index);
        const auto &next = edges[edges[e].next];
        EXPECT_EQ(next.previous, e);
        EXPECT_EQ(next.start, edges[e].end);
        EXPECT_EQ(next.body, edges[e].body);
        EXPECT_EQ(next.at_start, edges[e].at_end);
        n_corners.back() += edges[e].at_end != Corner::smooth;
        n_concave += edges[e].at_end == Corner::concave;
        n_convex += edges[e].at_end == Corner::convex;
        e = edges[e].next;
      } while (e != first);
    }
    std::sort(n_corners.begin(), n_corners.end());
    // hole: none; inner crack: two tips; block on the right: four; outline: four,
    // two at the mouth of the notch and its tip
    EXPECT_EQ(n_corners, (std::vector<unsigned int>{0, 2, 4, 7}));
    EXPECT_EQ(n_concave, 3U);
    EXPECT_EQ(n_convex, 10U);
  }


  TEST(ContactSurface, PlacesAndDerivatives)
  {
    const unsigned int                     seed = 5;
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(-0.05, 0.05);
    for (const unsigned int degree : {1U, 2U})
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", degree " +
                   std::to_string(degree));
      auto                      bodies = cracked_box(degree);
      std::vector<Tensor<1, 2>> values(bodies->covers.n_covers());
      for (unsigned int k = 0; k < values.size(); ++k)
        for (unsigned int c = 0; c < 2; ++c)
          values[k][c] = random(generator);
      bodies->surface.set_displacements(&values);
      const DisplacementField field(bodies->covers, bodies->problem, values);
      const ContactSurface   &surface   = bodies->surface;
      unsigned int            n_samples = 0;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
        for (const double t : {0., 0.3, 1., -0.2, 1.1})
        {
          const auto         place   = surface.place(e, t);
          const auto         X       = surface.reference_place(e, t).x;
          const unsigned int element = surface.edges()[e].element;
          const Point<2>     xi =
            bodies->mesh.mathematical_mesh().real_to_reference(
              bodies->mesh.cell(element), X);
          EXPECT_LE((place.x - X - field.displacement(element, xi)).norm(),
                    1e-13);
          const double h    = 1e-4;
          const auto   plus = surface.place(e, t + h),
                     minus  = surface.place(e, t - h);
          // errors of differences: h^2 times third derivatives, rounding / h
          EXPECT_LE(((plus.x - minus.x) / (2. * h) - place.a).norm(), 1e-8);
          EXPECT_LE(((plus.a - minus.a) / (2. * h) - place.b).norm(), 1e-8);
          ++n_samples;
        }
      EXPECT_GT(n_samples, 250U);
    }
  }


  /// At a point where two corners of a block meet, each edge is followed by the
  /// next one of the same corner.
  TEST(ContactSurface, PinchPoint)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "one");
    geometry.add_polygon({{1., 1.}, {2., 1.}, {2., 2.}, {1., 2.}}, "two");
    Bodies::Options options;
    options.cell_size = 0.37;
    const Bodies bodies(std::move(geometry), options);
    const auto  &edges = bodies.surface.edges();
    unsigned int n     = 0;
    for (const auto &edge : edges)
    {
      ASSERT_NE(edge.next, invalid_index)
        << edge.start << " - " << edge.end << " of " << edge.body;
      EXPECT_EQ(edges[edge.next].body, edge.body);
      if (edge.end == Point<2>(1., 1.))
      {
        ++n;
        EXPECT_EQ(edge.at_end, Corner::convex);
      }
    }
    EXPECT_EQ(n, 2U);
  }


  /// A plate with a round hole, a block in the hole and one beside the plate, all of
  /// them in a box that is open above; by hand.
  TEST(ContactSurface, LargestOverlap)
  {
    const Point<2> center(1., 1.);
    Geometry       geometry;
    add_named_box(geometry, "plate ", {0., 0.}, {2., 2.});
    geometry.add_circle(center, 0.6, "hole", CurveRole::hole);
    add_named_box(geometry, "inner ", {0.8, 0.8}, {1.2, 1.2});
    add_named_box(geometry, "beside ", {2.1, 0.5}, {3., 1.5});
    Bodies::Options options;
    options.cell_size = 0.31;
    options.rotation  = 7.;
    options.obstacles = {
      obstacle("walls", {{3.2, 3.}, {3.2, -0.1}, {-0.1, -0.1}, {-0.1, 3.}})};
    Bodies             bodies(std::move(geometry), options);
    const unsigned int inner =
                         bodies.mesh.block(bodies.mesh.find_element(center)),
                       beside =
                         bodies.mesh.block(bodies.mesh.find_element({2.5, 1.}));
    const auto overlap = [&](const Tensor<1, 2> &of_plate,
                             const Tensor<1, 2> &of_inner,
                             const Tensor<1, 2> &of_beside) {
      std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
      for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
      {
        const unsigned int  block = bodies.mesh.block(e);
        const Tensor<1, 2> &u     = block == inner    ? of_inner
                                    : block == beside ? of_beside
                                                      : of_plate;
        for (const unsigned int cover : bodies.covers.covers(e))
          nodal[cover] = u;
      }
      bodies.surface.set_displacements(&nodal);
      return bodies.surface.largest_overlap();
    };
    const Tensor<1, 2> none;
    EXPECT_EQ(overlap(none, none, none), 0.);
    // its corner is in the plate; the hole is one of chords, half an edge long
    const double corner = 0.2 * std::sqrt(2.);
    for (const double way : {0.5, 0.6})
      EXPECT_NEAR(overlap(none,
                          Point<2>(way / std::sqrt(2.), way / std::sqrt(2.)),
                          none),
                  corner + way - 0.6,
                  0.01);
    // by both corners of the side
    EXPECT_NEAR(overlap(none, none, Point<2>(-0.13, 0.)), 0.03, 1e-12);
    // in the middle of the plate: beyond the hole is no more depth than to the hole
    EXPECT_NEAR(overlap(none, none, Point<2>(-0.5, -0.9)), 0.4, 1e-12);
    // a wall, the floor, its corner, and beyond the end of the walls
    EXPECT_NEAR(overlap(none, none, Point<2>(0.22, 0.)), 0.02, 1e-12);
    EXPECT_NEAR(overlap(Point<2>(0., -0.15), none, none), 0.05, 1e-12);
    EXPECT_NEAR(overlap(Point<2>(-0.14, -0.15), none, none),
                std::hypot(0.04, 0.05),
                1e-12);
    EXPECT_EQ(overlap(none, none, Point<2>(0.22, 3.)), 0.);
    // walls that have been released bound nothing
    std::vector<bool> is_absent(bodies.surface.n_bodies(), false);
    is_absent.back() = true;
    bodies.surface.set_absent_bodies(is_absent);
    EXPECT_EQ(overlap(none, none, Point<2>(0.22, 0.)), 0.);
  }
} // namespace
