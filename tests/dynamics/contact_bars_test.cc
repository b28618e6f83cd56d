// Scenarios of contact in time with known outcome, at a small size; the full one is
// that of the program nmm-contact-bars.

#include <gtest/gtest.h>
#include <support/contact_bars/contact_bars.h>
#include <support/contact_bars/expect_holds.h>

namespace NMM
{
  namespace ContactBars
  {
    // A run that failed does not hold, whether there is a bound or not.
    TEST(ContactBars, FailedRunsDoNotHold)
    {
      ContactBars::Run failed;
      failed.failure = "no convergence";
      for (const double bound : {0., 0.1})
      {
        Measurements measurements(nullptr);
        measurements.add(
          1, "scenario", "way", 1., 1., 0., bound, ContactBars::Run());
        EXPECT_TRUE(measurements.all().back().holds());
        measurements.add(1, "scenario", "way", 1., 1., 0., bound, failed);
        EXPECT_FALSE(measurements.all().back().holds());
      }
    }


    // Falling onto its springs costs the block 3e-5 m of a way of 1 m.
    TEST(ContactBars, SlidesDownInclines)
    {
      Measurements measurements;
      Incline      incline;
      incline.begins_at_rest = false;
      incline.distance       = 1.;
      for (const double angle : {10., 60.})
      {
        incline.angle          = angle;
        incline.friction_angle = 0.5 * angle;
        slide_down_incline(incline, measurements);
      }
      // with much friction, too, if something takes the energy of the fall
      incline                = damped_incline();
      incline.distance       = 1.;
      incline.angle          = 60.;
      incline.friction_angle = 55.;
      incline.bound          = 1e-6;
      slide_down_incline(incline, measurements);
      expect_holds(measurements);
    }


    TEST(ContactBars, SticksToInclines)
    {
      Measurements measurements;
      Incline      incline;
      incline.n_steps = 200;
      incline.bound   = 1e-4;
      for (const auto &scheme :
           {TimeScheme::energy_momentum(), TimeScheme::generalized_alpha(0.5)})
        for (const double angle : {10., 60.})
        {
          incline.scheme         = scheme;
          incline.angle          = angle;
          incline.friction_angle = angle + 2.;
          stick_to_incline(incline, measurements);
        }
      incline                = damped_incline();
      incline.n_steps        = 200;
      incline.angle          = 60.;
      incline.friction_angle = 62.;
      // the time before it counts is short: vibrations have not quite gone
      incline.bound = 1e-3;
      stick_to_incline(incline, measurements);
      expect_holds(measurements);
    }


    // The front of the pulse is spread over half of a cell in a way of 40: 2 % with
    // cells of 0.5 m.
    TEST(ContactBars, BarsPartAfterImpact)
    {
      Measurements measurements;
      Impact       impact;
      impact.step            = 1e-3;
      impact.n_further_steps = 200;
      impact.bound           = 0.02;
      run_into_each_other(impact, measurements);
      expect_holds(measurements);
    }


    // Between heavy and light: a block that rocks falls as fast as a rigid one, and
    // loses what Housner says if its base touches in two corners, where dashpots take
    // what bounces otherwise.
    TEST(ContactBars, RocksLikeARigidBlock)
    {
      Measurements measurements;
      Rocking      rocking;
      rocking.youngs_modulus = 1e9;
      rocking.hollow         = 0.02;
      rocking.dashpot        = 3.;
      rocking.duration       = 3.2;
      rock(rocking, measurements);
      for (const Measurement &m : measurements.all())
        if (m.quantity.find("rigid") != std::string::npos)
        {
          EXPECT_NEAR(m.error, 0., 5e-3) << m.quantity;
        }
        else if (m.quantity.find("energy") != std::string::npos)
        {
          EXPECT_NEAR(m.error, 0., 0.03) << m.quantity;
        }
    }


    TEST(ContactBars, DisksSlideAndRoll)
    {
      Measurements measurements;
      Disk         disk;
#ifdef DEBUG
      constexpr double rolling = 0.1, sliding = 1.;
#else
      constexpr double rolling = 0.5, sliding = 3.;
#endif
      disk.duration = rolling;
      roll(disk, measurements);
      disk.spin     = 0.;
      disk.duration = sliding;
      roll(disk, measurements);
      expect_holds(measurements);
    }


    // Three of thirteen frequencies, over three decades.
    TEST(ContactBars, JointLetsWavesThrough)
    {
      Measurements measurements;
      JointWave    wave;
      wave.steps = 30.;
      for (const double frequency : {0.03, 1., 30.})
      {
        wave.frequency = frequency;
        transmit(wave, measurements);
      }
      expect_holds(measurements);
    }


    // In equilibrium from the start: what moves is what the tolerance of Newton's
    // method leaves.
    TEST(ContactBars, StackAtRest)
    {
      Measurements measurements;
      Stack        stack;
      stack.duration = 0.2;
      for (const auto kinematics : {Kinematics::small, Kinematics::finite})
      {
        stack.kinematics = kinematics;
        rest_in_a_stack(stack, measurements);
      }
      expect_holds(measurements);
    }


    TEST(ContactBars, RandomDrops)
    {
      Measurements measurements;
      Drops        drops;
      drops.n_drops  = 6;
      drops.duration = 0.8;
      drop_polygons(drops, measurements);
      std::cout << "seeds 0 to " << drops.n_drops - 1 << std::endl;
      // faces that ride up on each other bring no energy either
      drops.dilation       = 0.5;
      drops.dilation_limit = 0.05;
      drop_polygons(drops, measurements);
      expect_holds(measurements);
    }


    // A corner that presses turns so far in a step at 0.46 s that its gap changes otherwise than it moves:
    // 1e-4 of the energy of motion went without being counted.
    TEST(ContactBars, CornerThatTurns)
    {
      Measurements measurements;
      Drops        drops;
      drops.first_seed = 512;
      drops.n_drops    = 1;
      drops.duration   = 0.5;
      drop_polygons(drops, measurements);
      expect_holds(measurements);
      for (const Measurement &measurement : measurements.all())
        if (measurement.quantity == "worst balance [kinetic]")
        {
          EXPECT_LT(measurement.value, 1e-6);
        }
    }


    TEST(ContactBars, WedgeInANotch)
    {
      Measurements measurements;
      Corners      corners;
      corners.duration = 0.4;
      drop_into_notch(corners, measurements);
      expect_holds(measurements);
    }


    // The first ten of 1,000; one of them ends because no step is short enough.
    TEST(ContactBars, ShotsDoNotPassThroughWalls)
    {
      Measurements measurements;
      Shots        shots;
      shots.n_shots   = 10;
      shots.max_steps = 30;
      shoot_at_walls(shots, measurements);
      expect_holds(measurements);
    }


    TEST(ContactBars, VertexOnVertex)
    {
      Measurements measurements;
      fall_on_vertex(Corners(), measurements);
      expect_holds(measurements);
    }


    TEST(ContactBars, OverTheEdge)
    {
      Measurements measurements;
      slide_off_edge(Corners(), measurements);
      expect_holds(measurements);
    }


    TEST(ContactBars, FourBlocksMeet)
    {
      Measurements measurements;
      meet_in_a_point(Corners(), measurements);
      expect_holds(measurements);
    }


    /// Three blocks on a floor, the first of which slides towards the second; the third one falls
    /// beside them. Velocities at the end, and the iterations of all blocks and of those solved.
    std::vector<double>
    solve_three_blocks(const TimeScheme &scheme, const bool in_groups)
    {
      constexpr double E = 1e8;
      Geometry         geometry;
      add_block(geometry, "left", {{0., 0.}, {1., 0.}, {1., 0.5}, {0., 0.5}});
      add_block(geometry,
                "middle",
                {{1.05, 0.}, {2., 0.}, {2., 0.5}, {1.05, 0.5}});
      add_block(geometry,
                "right",
                {{4., 0.02}, {5., 0.02}, {5., 0.6}, {4., 0.6}});
      Bodies::Options options;
      options.cell_size = 0.3;
      options.obstacles = {obstacle("floor", {{9., 0.}, {-9., 0.}})};
      MovingBodies bodies(std::move(geometry), options);
      bodies.problem.materials     = {material("rock", E, 0.2, 2500.)};
      bodies.problem.gravity       = Tensor<1, 2>({0., -9.81});
      ContactParameters parameters = contact_parameters(10. * E, 0.05);
      coulomb(parameters).friction = 0.2;
      bodies.start(parameters, Kinematics::finite);
      NewtonParameters newton = TimeIntegrator::default_newton_parameters();
      newton.solves_groups_separately = in_groups;
      bodies.integrate(scheme,
                       bodies.zero(),
                       bodies.values(
                         [](const Point<2> &, const unsigned int block) {
                           return Tensor<1, 2>({block == 0 ? 2. : 0., 0.});
                         }),
                       {},
                       newton);
      StepControlParameters steps;
      steps.initial_step = 2e-3;
      double n_full = 0., n_iterations = 0.;
      StepControl(steps).run(*bodies.integrator,
                             0.1,
                             [&](const StepRecord &record) {
                               n_full += record.report.n_full_iterations;
                               n_iterations += record.report.n_iterations;
                               return true;
                             });
      if (in_groups)
        EXPECT_LT(n_full, 0.9 * n_iterations);
      else
        EXPECT_NEAR(n_full, n_iterations, 1e-9 * n_iterations);
      std::vector<double> result;
      for (unsigned int b = 0; b < 3; ++b)
        for (unsigned int c = 0; c < 2; ++c)
          result.push_back(bodies.velocity(b)[c]);
      return result;
    }


    // What Newton's method saves by groups changes nothing but rounding, and its tolerance of
    // 1e-9, which an impact and 50 steps magnify. The second block has converged, and is taken up
    // again, in the iterations in which the first one hits it.
    TEST(ContactBars, GroupsOfBlocksOrAllTogether)
    {
      for (const TimeScheme &scheme :
           {TimeScheme::energy_momentum(), TimeScheme::constant_acceleration()})
      {
        const auto in_groups = solve_three_blocks(scheme, true);
        const auto together  = solve_three_blocks(scheme, false);
        for (unsigned int i = 0; i < in_groups.size(); ++i)
          EXPECT_NEAR(in_groups[i], together[i], 1e-6) << scheme.name;
        // the second block was hit and the third one has landed
        EXPECT_GT(in_groups[2], 0.1) << scheme.name;
        EXPECT_GT(in_groups[5], -0.5) << scheme.name;
      }
    }


    // Bits of a repeated run; one rank and all ranks differ by rounding, which
    // impacts magnify.
    TEST(ContactBars, RepeatedRunAndRanksMPI)
    {
      const auto first  = final_states(MPI_COMM_WORLD);
      const auto second = final_states(MPI_COMM_WORLD);
      const auto alone  = final_states(MPI_COMM_SELF);
      for (unsigned int i = 0; i < first.size(); ++i)
        for (unsigned int j = 0; j < first[i].second.size(); ++j)
        {
          const double value = first[i].second[j];
          EXPECT_EQ(value, second[i].second[j]) << first[i].first << ", " << j;
          EXPECT_NEAR(value,
                      alone[i].second[j],
                      1e-6 * std::max(1e-3, std::abs(value)))
            << first[i].first << ", " << j;
        }
    }
  } // namespace ContactBars
} // namespace NMM
