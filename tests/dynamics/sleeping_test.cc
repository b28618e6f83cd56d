// Blocks that sleep: when, what it costs, who wakes them, and what it changes.
#include <nmm/dynamics/checkpoint.h>

#include <cstdio>
#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace Test
  {
    namespace
    {
      using namespace ContactBars;

      constexpr double h = 0.005;


      /// Three squares of 1 m: two that lie on each other on the floor, and one that
      /// falls on them from @p height, 0.2 m to their right.
      std::unique_ptr<MovingBodies>
      stack(const double height)
      {
        Geometry     geometry;
        unsigned int i = 0;
        for (const double y : {0., 1., 2. + height})
        {
          const double x = i == 2 ? 0.2 : 0.;
          add_block(geometry,
                    "block " + std::to_string(i++),
                    {{x, y}, {x + 1., y}, {x + 1., y + 1.}, {x, y + 1.}});
        }
        MovingBodies::Options options;
        options.cell_size           = 2.5;
        options.mesh_of_every_block = true;
        options.obstacles = {obstacle("floor", {{4., 0.}, {-3., 0.}})};
        auto bodies =
          std::make_unique<MovingBodies>(std::move(geometry), options);
        bodies->problem.materials = {
          material("rock", rock_modulus, 0.2, rock_density)};
        bodies->problem.gravity = Tensor<1, 2>({0., -standard_gravity});
        ContactParameters parameters =
          contact_parameters(10. * rock_modulus, 0.05);
        coulomb(parameters).friction       = std::tan(degrees(30.));
        coulomb(parameters).normal_damping = coulomb(parameters).shear_damping =
          0.2 *
          std::sqrt(coulomb(parameters).normal_stiffness * rock_density * 0.5);
        bodies->start(parameters, Kinematics::finite);
        // rock that rings for ever would not sleep
        RayleighDamping damping;
        damping.stiffness = 1e-3;
        bodies->integrate(TimeScheme::energy_momentum(), damping);
        return bodies;
      }


      void
      run(TimeIntegrator &integrator, const double end)
      {
        StepControlParameters control;
        control.initial_step = h;
        control.min_step     = 1e-4 * h;
        StepRecord record;
        while (StepControl(control).advance(integrator, end, record))
          ;
      }


      // Two lie from 0 on and sleep soon; what falls from 0.5 m arrives after 0.32 s.
      TEST(Sleeping, SleepsUntilTouched)
      {
        auto            sleepy = stack(0.5), awake = stack(0.5);
        SleepParameters parameters;
        parameters.time = 0.1;
        sleepy->integrator->let_blocks_sleep(parameters);
        const double fall = std::sqrt(2. * 0.5 / standard_gravity);

        run(*sleepy->integrator, fall - 0.02);
        run(*awake->integrator, fall - 0.02);
        EXPECT_EQ(sleepy->integrator->n_asleep(), 2u);
        EXPECT_EQ(sleepy->velocity(0).norm(), 0.);
        // the falling one alone is solved for
        const StepReport report = sleepy->integrator->try_step(0.5 * h);
        EXPECT_TRUE(report.converged) << report.reason;
        EXPECT_NEAR(report.n_full_iterations, report.n_iterations / 3., 1e-12);
        // what does not sleep differs by nothing, what does by less than its speed
        // has left, g rho / eps_n = 2.5 um and less
        EXPECT_NEAR(sleepy->displacement(2)[1],
                    awake->displacement(2)[1],
                    1e-9);
        EXPECT_NEAR(sleepy->displacement(1)[1],
                    awake->displacement(1)[1],
                    3e-6);

        run(*sleepy->integrator, fall + 0.02);
        EXPECT_EQ(sleepy->integrator->n_asleep(), 0u);
        EXPECT_GT(sleepy->velocity(1).norm(), 0.);

        // the heap comes to rest, asleep, where the other one does; what it does in
        // between is a matter of how it was struck
        run(*sleepy->integrator, 3.);
        run(*awake->integrator, 3.);
        EXPECT_EQ(sleepy->integrator->n_asleep(), 3u);
        for (unsigned int b = 0; b < 3; ++b)
        {
          const Tensor<1, 2> difference =
            sleepy->displacement(b) - awake->displacement(b);
          // springs give way by some um; hops after the blow end within centimetres
          EXPECT_NEAR(difference[1], 0., 1e-4) << "block " << b;
          EXPECT_NEAR(difference[0], 0., 0.05) << "block " << b;
        }
        // an account of all that was released, m g 0.5 m, with what sleep took
        const Account &account = sleepy->integrator->account();
        EXPECT_EQ(account.kinetic, 0.);
        EXPECT_NEAR(account.balance / (rock_density * standard_gravity * 0.5),
                    0.,
                    1e-6);
      }


      // Everybody sleeps, and the next day is that of one who has not been stopped.
      TEST(Sleeping, ContinuesWithTheSameBits)
      {
        SleepParameters parameters;
        parameters.time      = 0.1;
        const char *filename = "sleeping-checkpoint.bin";
        auto whole = stack(0.5), begun = stack(0.5), continued = stack(0.5);
        for (auto *bodies : {&whole, &begun, &continued})
          (*bodies)->integrator->let_blocks_sleep(parameters);
        run(*begun->integrator, 0.2);
        ASSERT_EQ(begun->integrator->n_asleep(), 2u);
        Checkpoint::write(*begun->integrator, filename);
        Checkpoint::read(filename, *continued->integrator);
        std::remove(filename);
        EXPECT_EQ(continued->integrator->n_asleep(), 2u);
        for (auto *bodies : {&whole, &continued})
        {
          run(*(*bodies)->integrator, 0.2);
          run(*(*bodies)->integrator, 0.6);
        }
        const auto &expected = whole->integrator->state().u;
        const auto &found    = continued->integrator->state().u;
        for (const auto i : expected.locally_owned_elements())
          ASSERT_EQ(found(i), expected(i)) << "unknown " << i;
      }


      TEST(Sleeping, RefusesWhatItCannotDo)
      {
        auto            bodies = stack(0.5);
        SleepParameters parameters;
        parameters.speed = 0.;
        EXPECT_THROW(bodies->integrator->let_blocks_sleep(parameters),
                     InputError);
      }
    } // namespace
  }   // namespace Test
} // namespace NMM
