// Corners that overlap by the side do not touch the faces that they are far behind.
#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>

namespace NMM
{
  namespace ContactBars
  {
    /*
     * Two unit squares side by side, of which the right one comes from the side and goes
     * down: on 0.19 m of their sides they push each other apart, without
     * friction. While their sides overlap by millimetres, the lower right corner is 0.19 m
     * below the top of the left square, and the other way round, which is no contact:
     * what it would push is up. Both turn by the impact, which is not central, and their
     * normals by as much, some 0.02 while it lasts.
     */
    TEST(FacesBeside, DoNotTouch)
    {
      constexpr double E = 1e8, V = 1., common = 0.19, gap = 0.002;
      Geometry         geometry;
      add_block(geometry, "left", {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}});
      add_block(geometry,
                "right",
                {{1. + gap, 1. - common},
                 {2. + gap, 1. - common},
                 {2. + gap, 2. - common},
                 {1. + gap, 2. - common}});
      Bodies::Options options;
      options.cell_size           = 0.8;
      options.mesh_of_every_block = false;
      MovingBodies bodies(std::move(geometry), options);
      bodies.problem.materials = {material("rock", E, 0.2, 2500.)};
      // within reach of the tops
      bodies.start(contact_parameters(E, 0.3), Kinematics::finite);
      const unsigned int right =
        bodies.mesh.block(bodies.mesh.find_element(Point<2>(1.5, 1.5)));
      bodies.integrate(
        TimeScheme::energy_momentum(),
        bodies.zero(),
        bodies.values([&](const Point<2> &, const unsigned int block) {
          return block == right ? Tensor<1, 2>({-V, -V}) : Tensor<1, 2>();
        }));
      double     deepest = 0.;
      const auto run     = bodies.run(0.002, 0.03, [&]() {
        deepest = std::max(deepest, bodies.surface.largest_overlap());
        return true;
      });
      EXPECT_EQ(run.failure, "");
      // as rigid squares: what touches, r above and below their centres, changes its
      // velocity by 2 V; a little goes into vibration
      const double r = 0.5 * (1. - common);
      EXPECT_NEAR(bodies.velocity(right)[0],
                  -V + V / (1. + 6. * r * r),
                  0.02 * V);
      // without friction
      EXPECT_NEAR(bodies.velocity(right)[1], -V, 0.02 * V);
      // as deep as it is found by Boost.Geometry, not as deep as the faces behind
      EXPECT_NEAR(run.largest_penetration, deepest, 0.1 * deepest);
    }
  } // namespace ContactBars
} // namespace NMM
