// Faces that ride up on each other in time: motion, energy.

#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      /// A block of 3 x 1 on a floor that gravity is turned for.
      struct Slide
      {
        double     angle = 35., friction_angle = 20., dilation_angle = 8.;
        double     limit        = 0.;
        double     dashpot      = 0.1;
        Kinematics kinematics   = Kinematics::small;
        MPI_Comm   communicator = MPI_COMM_WORLD;
      };


      void
      start(MovingBodies &block, const Slide &slide, const bool is_held)
      {
        ContactParameters parameters =
          contact_parameters(10. * rock_modulus, 0.02);
        coulomb(parameters).friction =
          std::tan(degrees(is_held ? 80. : slide.friction_angle));
        if (!is_held)
        {
          coulomb(parameters).dilation =
            std::tan(degrees(slide.dilation_angle));
          coulomb(parameters).dilation_limit = slide.limit;
        }
        coulomb(parameters).normal_damping =
          2. * slide.dashpot *
          std::sqrt(coulomb(parameters).normal_stiffness * rock_density);
        coulomb(parameters).shear_damping = coulomb(parameters).normal_damping;
        block.start(parameters, slide.kinematics);
      }


      std::unique_ptr<MovingBodies>
      block_at_rest(const Slide &slide, const TimeScheme &scheme)
      {
        auto         block = block_on_floor(slide.communicator);
        const double angle = degrees(slide.angle);
        block->problem.gravity =
          standard_gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
        start(*block, slide, true);
        const Vector u = block->find_rest(0.01);
        start(*block, slide, false);
        block->integrate(scheme, u, block->zero());
        return block;
      }
    } // namespace


    // The block slides along a plane that rises by psi from the floor: with the normal
    // force m (g cos a + tan psi x'') and friction mu of it,
    // x'' = g (sin a - mu cos a) / (1 + mu tan psi).
    TEST(DilationInTime, RidesUpAsItSlides)
    {
      for (const Kinematics kinematics :
           {Kinematics::small, Kinematics::finite})
      {
        Slide slide;
        slide.kinematics = kinematics;
        const double mu  = std::tan(degrees(slide.friction_angle));
        const double psi = std::tan(degrees(slide.dilation_angle));
        const double a   = degrees(slide.angle);
        const auto block = block_at_rest(slide, TimeScheme::energy_momentum());
        const Tensor<1, 2> begin = block->displacement(0);
        constexpr double   end   = 0.5;
        const auto         run   = block->run(0.0025, end);
        const Tensor<1, 2> moved = block->displacement(0) - begin;
        const double       acceleration =
          standard_gravity * (std::sin(a) - mu * std::cos(a)) / (1. + mu * psi);
        const double way = 0.5 * acceleration * end * end;
        // it begins to slide all at once and swings on its springs, by 1e-6 m;
        // measured 6e-7, 1.2e-5 and 3e-5
        EXPECT_NEAR(moved[0], way, 1e-5 * way);
        EXPECT_NEAR(moved[1], psi * way, 1e-4 * psi * way);
        const double normal_force =
          3. * rock_density *
          (standard_gravity * std::cos(a) + psi * acceleration);
        const double heat    = (mu - psi) * normal_force * way;
        const auto  &account = block->integrator->account();
        EXPECT_NEAR(account.dissipated, heat, 1e-3 * heat);
        // to the tolerance of Newton's method in each of 200 steps
        EXPECT_LE(run.worst_balance, 1e-6 * account.kinetic);
        EXPECT_EQ(run.failure, "");
        std::cout << "way " << moved[0] / way - 1. << ", rise "
                  << moved[1] / (psi * way) - 1. << ", heat "
                  << account.dissipated / heat - 1. << ", balance "
                  << run.worst_balance / account.kinetic << ", "
                  << run.n_iterations << " iterations of " << run.n_steps
                  << " steps" << std::endl;
      }
    }


    // Beyond the limit the block goes on at the height that it has reached.
    TEST(DilationInTime, EndsAtItsLimit)
    {
      Slide slide;
      slide.limit          = 0.05;
      slide.dilation_angle = 5.;
      const auto block = block_at_rest(slide, TimeScheme::energy_momentum());
      const Tensor<1, 2> begin = block->displacement(0);
      const auto         run   = block->run(0.0025, 0.6);
      const Tensor<1, 2> moved = block->displacement(0) - begin;
      const double       rise  = std::tan(degrees(5.)) * slide.limit;
      EXPECT_GT(moved[0], 0.3);
      std::cout << "rise " << moved[1] / rise - 1. << ", balance "
                << run.worst_balance / block->integrator->account().kinetic
                << std::endl;
      // it is thrown up where the ramp ends, and comes back; it may still hop, by
      // 3e-5 m here
      EXPECT_NEAR(moved[1], rise, 0.02 * rise);
      EXPECT_LE(run.worst_balance, 1e-6 * block->integrator->account().kinetic);
      EXPECT_GE(block->integrator->account().dissipated, 0.);
    }


    // Schemes that do not conserve energy know dilation, too.
    TEST(DilationInTime, OtherSchemes)
    {
      Slide slide;
      slide.dashpot        = 0.;
      slide.dilation_angle = 4.;
      const double mu      = std::tan(degrees(slide.friction_angle));
      const double psi     = std::tan(degrees(slide.dilation_angle));
      const double a       = degrees(slide.angle);
      const auto   block =
        block_at_rest(slide, TimeScheme::generalized_alpha(0.5));
      const Tensor<1, 2> begin = block->displacement(0);
      block->run(0.0025, 0.4);
      const Tensor<1, 2> moved = block->displacement(0) - begin;
      const double       way   = 0.5 * standard_gravity *
                         (std::sin(a) - mu * std::cos(a)) / (1. + mu * psi) *
                         0.16;
      std::cout << "way " << moved[0] / way - 1. << ", rise "
                << moved[1] / (psi * way) - 1. << std::endl;
      // of second order, with damping of what steps do not resolve
      EXPECT_NEAR(moved[0], way, 5e-3 * way);
      EXPECT_NEAR(moved[1], psi * way, 5e-3 * psi * way);
    }
  } // namespace ContactBars
} // namespace NMM
