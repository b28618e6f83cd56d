// Motion on contact springs that stiffen.

#include <nmm/contact/law/barton_bandis_law.h>

#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      /// The closure d at which the joint has stored the work of the pressure of @p weight [Pa],
      /// V(d) = weight d, by bisection up to the largest closure.
      double
      closure_at_return(const BartonBandisLaw &law, const double weight)
      {
        double above = 0., below = 0.99 * law.largest_closure;
        for (unsigned int i = 0; i < 60; ++i)
        {
          const double middle = 0.5 * (above + below);
          (law.energy(middle) < weight * middle ? above : below) = middle;
        }
        return above;
      }
    } // namespace


    // A block is let go where it touches a rough joint, and swings on its hyperbola. Where it returns
    // the joint has stored the work of gravity; the block's own strain, 1e-4, changes that by
    // 0.2 %, and the largest closure is sampled in steps of a fiftieth of a period, within 0.3 %. When
    // the energy at the beginning of each step was kept as if springs were linear, each step lost
    // more of it than the one before, and the block sank through the floor.
    TEST(StiffeningSprings, BlockSwingsOnARoughJoint)
    {
      for (const Kinematics kinematics :
           {Kinematics::small, Kinematics::finite})
      {
        const auto block          = block_on_floor(MPI_COMM_WORLD);
        block->problem.gravity[1] = -standard_gravity;

        BartonBandisLaw law;
        law.normal_stiffness           = 1e6;
        law.largest_closure            = 0.02;
        law.joint_roughness            = 8.;
        law.joint_compressive_strength = 5e7;
        law.residual_angle             = 25.;
        ContactParameters parameters;
        parameters.reach = 0.1;
        parameters.law   = std::make_shared<BartonBandisLaw>(law);
        block->start(parameters, kinematics);
        block->integrate(TimeScheme::energy_momentum());

        const double closure =
          closure_at_return(law, rock_density * standard_gravity);
        const double work   = 3. * rock_density * standard_gravity * closure;
        double       lowest = 0., highest_later = -1.;
        const auto   run = block->run(0.0025, 1., [&]() {
          const double height = block->displacement(0)[1];
          lowest              = std::min(lowest, height);
          if (block->integrator->state().time > 0.5)
            highest_later = std::max(highest_later, height);
          return true;
        });
        EXPECT_EQ(run.failure, "");
        EXPECT_NEAR(-lowest, closure, 0.005 * closure);
        EXPECT_NEAR(highest_later, 0., 0.01 * closure);
        // to the tolerance of Newton's method in each of 400 steps
        EXPECT_LE(run.worst_balance, 1e-6 * work);
        std::cout << "closure " << -lowest / closure - 1. << ", return "
                  << highest_later / closure << ", balance "
                  << run.worst_balance / work << std::endl;
      }
    }
  } // namespace ContactBars
} // namespace NMM
