#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      void
      start(MovingBodies  &block,
            const Incline &incline,
            const double   friction_angle)
      {
        ContactParameters parameters =
          contact_parameters(10. * rock_modulus, 0.02);
        coulomb(parameters).friction = std::tan(degrees(friction_angle));
        coulomb(parameters).normal_damping =
          2. * incline.dashpot *
          std::sqrt(coulomb(parameters).normal_stiffness * rock_density);
        coulomb(parameters).shear_damping = coulomb(parameters).normal_damping;
        block.start(parameters, Kinematics::small);
      }


      std::unique_ptr<MovingBodies>
      make_block(const Incline &incline)
      {
        Geometry     geometry;
        const double length = incline.length;
        add_block(geometry,
                  "block",
                  {{0., 0.}, {length, 0.}, {length, 1.}, {0., 1.}});
        Bodies::Options options;
        options.cell_size    = 0.7;
        options.rotation     = 17.;
        options.offset[0]    = 0.217;
        options.offset[1]    = 0.119;
        options.communicator = incline.communicator;
        options.obstacles    = {obstacle("floor", {{99., 0.}, {-99., 0.}})};
        auto block =
          std::make_unique<MovingBodies>(std::move(geometry), options);
        block->problem.materials = {
          material("rock", rock_modulus, 0.2, rock_density)};
        const double angle = degrees(incline.angle);
        block->problem.gravity =
          standard_gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
        start(*block, incline, incline.friction_angle);
        return block;
      }


      std::string
      describe(const Incline &incline)
      {
        std::ostringstream text;
        text << incline.angle << " degrees; friction " << incline.friction_angle
             << "; " << incline.scheme.name;
        return text.str();
      }
    } // namespace


    Incline
    damped_incline()
    {
      Incline incline;
      incline.begins_at_rest    = false;
      incline.dashpot           = 1.;
      incline.stiffness_damping = 2e-3;
      incline.settling          = 0.5;
      return incline;
    }


    void
    slide_down_incline(const Incline &incline, Measurements &measurements)
    {
      const auto   block = make_block(incline);
      const double angle = degrees(incline.angle);
      const double acceleration =
        standard_gravity *
        (std::sin(angle) -
         std::cos(angle) * std::tan(degrees(incline.friction_angle)));
      const double end = std::sqrt(2. * incline.distance / acceleration);
      // at rest while friction holds it
      Vector u = block->zero();
      if (incline.begins_at_rest)
      {
        start(*block, incline, 80.);
        u = block->find_rest(0.01);
        start(*block, incline, incline.friction_angle);
      }
      block->integrate(incline.scheme,
                       u,
                       block->zero(),
                       {0., incline.stiffness_damping});
      Run run;
      if (incline.settling > 0.)
        run += block->run(incline.step, incline.settling);
      const double x_0   = block->displacement(0)[0];
      const double v_0   = block->velocity(0)[0];
      const double begin = block->integrator->state().time;
      run += block->run(incline.step, begin + end);
      const double      time = block->integrator->state().time - begin;
      const std::string name =
        std::string(incline.begins_at_rest ? "slides: "
                                           : "falls and slides: ") +
        describe(incline);
      measurements.add(2,
                       name,
                       "distance [m]",
                       block->displacement(0)[0] - x_0 - v_0 * time,
                       incline.distance,
                       0.,
                       incline.bound,
                       run);
      if (incline.settling > 0.)
        measurements.add(2,
                         name,
                         "distance with the fall [m]",
                         block->displacement(0)[0],
                         0.5 * acceleration *
                           dealii::Utilities::fixed_power<2>(begin + time),
                         0.,
                         0.,
                         run);
      measurements.add(2,
                       name,
                       "worst balance [J/m]",
                       run.worst_balance,
                       0.,
                       block->integrator->account().kinetic,
                       incline.scheme.is_conserving ? 1e-6 : 0.,
                       run);
    }


    void
    stick_to_incline(const Incline &incline, Measurements &measurements)
    {
      const auto   block = make_block(incline);
      const double give  = rock_density * standard_gravity *
                          std::sin(degrees(incline.angle)) /
                          (10. * rock_modulus);
      Run run;
      if (incline.begins_at_rest)
      {
        const Vector u = block->find_rest(0.01);
        block->integrate(incline.scheme,
                         u,
                         block->zero(),
                         {0., incline.stiffness_damping});
      }
      else
      {
        block->integrate(incline.scheme, {0., incline.stiffness_damping});
        // until it lies on its springs
        run += block->run(incline.step, 1.);
      }
      const double start = block->displacement(0)[0];
      const double begin = block->integrator->state().time;
      double       creep = 0.;
      run +=
        block->run(incline.step, begin + incline.n_steps * incline.step, [&]() {
          creep = std::max(creep, std::abs(block->displacement(0)[0] - start));
          return true;
        });
      const std::string name =
        std::string("sticks") +
        (incline.begins_at_rest ? ": " : " after a fall: ") + describe(incline);
      measurements.add(
        2, name, "farthest creep [m]", creep, 0., give, incline.bound, run);
      measurements.add(2,
                       name,
                       "creep in the end [m]",
                       block->displacement(0)[0] - start,
                       0.,
                       give,
                       incline.bound,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
