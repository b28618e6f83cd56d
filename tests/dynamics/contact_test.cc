// Contact in time: friction on an incline, impact.
#include <nmm/contact/assembly/term.h>
#include <nmm/covers/aggregation.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace Test
  {
    namespace
    {
      constexpr double standard_gravity = 9.81;

      /// A body on faces: the contact has to be there before vectors are.
      struct TouchingBody
      {
        Body                             body;
        std::unique_ptr<ContactSurface>  surface;
        std::unique_ptr<Contact>         contact;
        std::unique_ptr<ContactTerm>     touch;
        std::unique_ptr<MechanicalModel> model;

        void
        make(const ContactParameters &parameters)
        {
          body.make_small();
          contact = std::make_unique<Contact>(*surface,
                                              body.model->constraints,
                                              parameters);
          touch = std::make_unique<ContactTerm>(body.solid->layout(), *contact);
          model = std::make_unique<MechanicalModel>(
            body.solid->layout(),
            std::vector<ForceTerm *>{body.solid.get(), touch.get()});
        }
      };


      /// A unit block on an incline, which gravity is turned for [rad].
      TouchingBody
      block_on_incline(const double incline, const double friction_angle)
      {
        const double   E = 1e9;
        TouchingBody   result;
        const Material rock = material("rock", E, 0.2, 2500.);
        result.body         = box({0., 0.}, {1., 1.}, 0.7, rock);
        result.body.model->problem.gravity =
          Tensor<1, 2>({standard_gravity * std::sin(incline),
                        -standard_gravity * std::cos(incline)});
        RigidObstacle floor;
        floor.name   = "floor";
        floor.pieces = {CurvePiece::segment({100., 0.}, {-100., 0.})};
        result.surface =
          std::make_unique<ContactSurface>(result.body.model->covers,
                                           std::vector<RigidObstacle>{floor});
        ContactParameters parameters;
        coulomb(parameters).normal_stiffness = 10. * E;
        coulomb(parameters).friction         = std::tan(friction_angle);
        parameters.reach                     = 0.02;
        result.make(parameters);
        return result;
      }


      double
      degrees(const double angle)
      {
        return angle * dealii::numbers::PI / 180.;
      }
    } // namespace


    // s = g (sin a - cos a tan phi) t^2 / 2. The block drops onto its springs at
    // first, by 3e-5 m: that is the tolerance, an eighth of the 1e-4 of the way
    // that is asked of long slides.
    TEST(ContactInTime, SlidesDownAnIncline)
    {
      const double   incline = degrees(30.), friction = degrees(20.);
      TouchingBody   block = block_on_incline(incline, friction);
      TimeIntegrator integrator(*block.model, TimeScheme::energy_momentum());
      StepControlParameters steps;
      steps.initial_step = 0.005;
      const double end   = 1.;
      double       worst = 0.;
      StepControl(steps).run(integrator, end, [&](const StepRecord &) {
        worst = std::max(worst, std::abs(integrator.account().balance));
        return true;
      });
      const double acceleration =
        standard_gravity *
        (std::sin(incline) - std::cos(incline) * std::tan(friction));
      const double way = 0.5 * acceleration * end * end;
      EXPECT_NEAR(integrator.state().u(0), way, 3e-5);
      // friction turns weight times way into heat: the account closes to the
      // tolerance of Newton's method, 1e-9 of the forces in each of 200 steps
      EXPECT_LE(worst, 1e-6 * integrator.account().kinetic);
      const double heat =
        2500. * standard_gravity * std::cos(incline) * std::tan(friction) * way;
      // the block hops by 1e-5 m on its springs, and friction acts in pulses of a
      // few steps of 200
      EXPECT_NEAR(integrator.account().dissipated, heat, 5e-3 * heat);
    }


    // The shear spring gives way by weight's share over its stiffness, 4e-7 m
    // over the whole face, as the block comes to rest; nothing creeps after that.
    TEST(ContactInTime, SticksToAnIncline)
    {
      TouchingBody   block = block_on_incline(degrees(15.), degrees(20.));
      TimeIntegrator integrator(*block.model,
                                TimeScheme::generalized_alpha(0.5));
      StepControlParameters steps;
      steps.initial_step = 0.005;
      const StepControl control(steps);
      control.run(integrator, 2.);
      const double at_rest = integrator.state().u(0);
      control.run(integrator, 4.);
      EXPECT_LT(std::abs(at_rest), 1e-3);
      EXPECT_NEAR(integrator.state().u(0), at_rest, 1e-12);
    }


    // Two bars of length L in longitudinal impact part after 2 L / c with their
    // velocities exchanged. Tolerances: the pulse's front is spread over half a cell of
    // 1 m in a way of 20 m, and a step is 1 % of the duration.
    TEST(ContactInTime, BarsInImpactExchangeTheirVelocities)
    {
      const double L = 10., c = 100., V = 0.1, opening = 0.01, E = 100.;
      Geometry     geometry;
      geometry.add_polygon({{0., 0.}, {L, 0.}, {L, 1.}, {0., 1.}}, "left");
      geometry.add_polygon({{L + opening, 0.},
                            {2. * L + opening, 0.},
                            {2. * L + opening, 1.},
                            {L + opening, 1.}},
                           "right");
      TouchingBody bars;
      bars.body.model = std::make_unique<Model>(std::move(geometry),
                                                mesh_parameters(1., {}, 6.),
                                                2);
      bars.body.model->problem.materials = {material("rock", E, 0., E / c / c)};
      bars.surface = std::make_unique<ContactSurface>(bars.body.model->covers);
      ContactParameters parameters;
      coulomb(parameters).normal_stiffness = 10. * E;
      parameters.reach                     = 0.02;
      bars.make(parameters);

      TimeIntegrator integrator(*bars.model, TimeScheme::energy_momentum());
      integrator.initialize(
        bars.body.zero(),
        interpolate_velocity(bars.body.model->covers,
                             bars.body.model->constraints,
                             [&](const Point<2> &, const unsigned int block) {
                               return Tensor<1, 2>({block == 0 ? V : -V, 0.});
                             }));
      const double          energy = integrator.account().kinetic;
      StepControlParameters steps;
      steps.initial_step = 0.002;
      double first = 0., last = 0., worst = 0.;
      StepControl(steps).run(integrator, 0.3, [&](const StepRecord &) {
        worst = std::max(worst, std::abs(integrator.account().balance));
        if (bars.contact->report().n_slip > 0)
        {
          last  = integrator.state().time;
          first = first > 0. ? first : last;
        }
        return true;
      });
      EXPECT_NEAR(first, opening / (2. * V), 0.003);
      EXPECT_NEAR(last - first, 2. * L / c, 0.03 * 2. * L / c);
      // to the tolerance of Newton's method, which is one of forces
      EXPECT_LE(worst, 1e-5 * energy);
      EXPECT_NEAR(integrator.account().linear_momentum[0], 0., 1e-9 * E * V);
      // all of what was kinetic is so again, but for waves that remain
      EXPECT_GE(integrator.account().kinetic, 0.95 * energy);
    }
  } // namespace Test
} // namespace NMM
