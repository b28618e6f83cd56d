// Bolts in motion: energy and momentum are accounted for while the bond slips, and a run that
// continues from a checkpoint takes the same steps.

#include <nmm/dynamics/checkpoint.h>
#include <nmm/mechanics/bolt_term.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Two squares that lie side by side, without contact.
  Body
  two_squares()
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "first");
    geometry.add_polygon({{1., 0.}, {2., 0.}, {2., 1.}, {1., 1.}}, "second");
    Body body;
    body.model                    = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.4, {}, 9.),
                                         2);
    body.model->problem.materials = {material("rock", 1e4, 0.2, 1.)};
    return body;
  }


  Bolt
  dowel()
  {
    Bolt bolt;
    bolt.name            = "dowel";
    bolt.path            = {{0.1, 0.45}, {1.3, 0.55}, {1.9, 0.5}};
    bolt.youngs_modulus  = 1e4;
    bolt.area            = 0.02;
    bolt.bond_stiffness  = 300.;
    bolt.bond_strength   = 4.;
    bolt.dowel_stiffness = 30.;
    return bolt;
  }


  // The squares are drawn apart, and turn about each other.
  TEST(BoltsInMotion, AccountClosesAndContinues)
  {
    const std::string   file    = "bolt_checkpoint.nmm";
    const double        initial = 20.5;
    std::vector<double> forces;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
      for (const bool is_continued : {false, true})
      {
        Body body = two_squares();
        if (kinematics == Kinematics::small)
          body.make_small();
        else
          body.make_finite();
        BoltTerm        bolts(body.model->covers,
                       body.solid->layout(),
                       {dowel()},
                       kinematics);
        MechanicalModel model(body.solid->layout(), {body.solid.get(), &bolts});
        TimeIntegrator  integrator(model, TimeScheme::energy_momentum());
        if (is_continued)
          Checkpoint::read(file, integrator);
        else
          integrator.initialize(body.zero(),
                                body.velocity([](const Point<2> &x) {
                                  return x[0] > 1. ? Tensor<1, 2>({6., 2.})
                                                   : Tensor<1, 2>({0., -1.});
                                }));
        const double moment   = integrator.account().angular_momentum,
                     momentum = integrator.account().linear_momentum[0];
        for (unsigned int i = is_continued ? 30 : 0; i < 60; ++i)
        {
          if (i == 30 && !is_continued)
            Checkpoint::write(integrator, file);
          step(integrator, 0.01);
          // the tolerance of Newton's method in 60 steps
          ASSERT_NEAR(integrator.account().balance, 0., 1e-7 * initial);
          ASSERT_NEAR(integrator.account().linear_momentum[0], momentum, 1e-6);
          if (kinematics == Kinematics::finite)
          {
            ASSERT_NEAR(integrator.account().angular_momentum, moment, 1e-5);
          }
        }
        const BoltReport report = bolts.reports(integrator.state().u)[0];
        EXPECT_GT(report.slipped_length, 0.2);
        EXPECT_GT(std::abs(report.crossings[0].dowel_force), 0.);
        forces.push_back(report.crossings[0].force);
      }
    EXPECT_EQ(forces[0], forces[1]);
    EXPECT_EQ(forces[2], forces[3]);
  }
} // namespace
