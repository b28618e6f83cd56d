// What is thrown at thin things does not pass through them, or the run ends and says so.
#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      MovingBodies::Options
      options(std::vector<RigidObstacle> obstacles)
      {
        MovingBodies::Options result;
        result.cell_size           = 3.;
        result.mesh_of_every_block = true;
        result.obstacles           = std::move(obstacles);
        return result;
      }


      /// The last block, of blocks from left to right, falls at a speed.
      Run
      fall(MovingBodies     &bodies,
           const double      speed,
           const double      step,
           const double      end,
           const Kinematics  kinematics,
           const TimeScheme &scheme = TimeScheme::energy_momentum())
      {
        bodies.problem.materials = {
          material("rock", rock_modulus, 0.2, rock_density)};
        bodies.start(contact_parameters(20. * rock_modulus), kinematics);
        const unsigned int falling = bodies.physical_mesh.n_blocks() - 1;
        bodies.integrate(
          scheme,
          bodies.zero(),
          bodies.values([&](const Point<2> &, const unsigned int block) {
            return Tensor<1, 2>({0., block == falling ? -speed : 0.});
          }));
        return bodies.run(step, end);
      }
    } // namespace


    // In 0.02 s the block falls by twice the thickness of the wall.
    TEST(Crossings, BlockOnThinWall)
    {
      for (const auto kinematics : {Kinematics::small, Kinematics::finite})
        for (const auto &scheme : {TimeScheme::energy_momentum(),
                                   TimeScheme::generalized_alpha(0.5)})
        {
          Geometry geometry;
          add_block(geometry,
                    "block",
                    {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}});
          MovingBodies bodies(
            std::move(geometry),
            options({obstacle(
              "wall",
              {{-2., -1.1}, {3., -1.1}, {3., -1.}, {-2., -1.}, {-2., -1.1}})}));
          const auto run = fall(bodies, 10., 0.02, 0.3, kinematics, scheme);
          EXPECT_EQ(run.failure, "");
          EXPECT_GE(run.n_cuts, 1U);
          // it has bounced: what is lost goes into vibration
          EXPECT_GT(bodies.velocity(0)[1], 5.);
          EXPECT_GT(bodies.displacement(0)[1], -1.);
        }
    }


    // The first step takes the block 20 m or 2 km below the floor. Springs of 20 E / m stop a block
    // of 1 m within v sqrt(rho / (20 E)) = 0.35 m at the lower speed. At the higher one that would
    // be 35 m, through the block itself, so that the run ends.
    TEST(Crossings, FastBlockOnFloor)
    {
      for (const double speed : {1e3, 1e5})
      {
        Geometry geometry;
        add_block(geometry, "block", {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}});
        MovingBodies bodies(std::move(geometry),
                            options(
                              {obstacle("floor", {{30., -1.}, {-30., -1.}})}));
        const auto   run = fall(bodies, speed, 0.02, 0.1, Kinematics::finite);
        if (speed == 1e3)
          EXPECT_GT(bodies.displacement(0)[1], -1.4) << run.failure;
        else
          EXPECT_NE(run.failure.find("into 'floor'"), std::string::npos)
            << run.failure << bodies.displacement(0)[1];
      }
    }


    TEST(Crossings, ThinPlates)
    {
      constexpr double speed = 1e4;
      // in the first step the plate flies 0.6 m, just to the other one, or 3 m
      for (const double way : {0.6, 3.})
      {
        Geometry geometry;
        add_block(geometry,
                  "plate",
                  {{0., 0.}, {1., 0.}, {1., 0.01}, {0., 0.01}});
        add_block(geometry,
                  "other",
                  {{-1., -0.51}, {2., -0.51}, {2., -0.5}, {-1., -0.5}});
        MovingBodies bodies(std::move(geometry), options({}));
        const auto   run =
          fall(bodies, speed, way / speed, 9. / speed, Kinematics::finite);
        const double distance =
          0.5 + bodies.displacement(1)[1] - bodies.displacement(0)[1];
        // the last good state, if the run ends: not beyond the middle of the other plate
        EXPECT_GT(distance, -0.005) << way << ": " << run.failure;
      }
    }
  } // namespace ContactBars
} // namespace NMM
