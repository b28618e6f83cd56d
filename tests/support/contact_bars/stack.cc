#include <deal.II/base/timer.h>

#include <cmath>
#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      Geometry
      pile(const unsigned int n)
      {
        Geometry geometry;
        for (unsigned int i = 0; i < n; ++i)
          add_named_box(geometry,
                        "block" + std::to_string(i) + " ",
                        Point<2>(0., i),
                        Point<2>(1., i + 1.));
        return geometry;
      }
    } // namespace


    void
    rest_in_a_stack(const Stack &stack, Measurements &measurements)
    {
      MovingBodies::Options options;
      // a triangle for each block
      options.cell_size           = 2.5;
      options.mesh_of_every_block = true;
      options.communicator        = stack.communicator;
      options.obstacles = {obstacle("floor", {{10., 0.}, {-10., 0.}})};
      MovingBodies bodies(pile(stack.n_blocks), options);
      bodies.problem.materials = {
        material("rock", rock_modulus, 0.2, rock_density)};
      bodies.problem.gravity = Tensor<1, 2>({0., -standard_gravity});
      ContactParameters parameters =
        contact_parameters(10. * rock_modulus, 0.02);
      coulomb(parameters).friction       = std::tan(dealii::numbers::PI / 6.);
      coulomb(parameters).normal_damping = coulomb(parameters).shear_damping =
        2. * stack.dashpot *
        std::sqrt(coulomb(parameters).normal_stiffness * rock_density);
      Bodies &statics = bodies;
      statics.start(parameters, stack.kinematics == Kinematics::small);
      statics.statics->run(LoadSteps());
      const Vector rest(statics.statics->solution());

      // the contact goes on from where the statics left it
      bodies.make_model(make_solid(
        *bodies.elasticity, stack.kinematics, Loading(), bodies.mass()));
      Vector begin(bodies.zero());
      begin = rest;
      bodies.integrate(TimeScheme::energy_momentum(), begin, bodies.zero());

      const double weight =
        rock_density * standard_gravity * static_cast<double>(stack.n_blocks);
      double            drift = 0., force_error = 0.;
      const Run         run = bodies.run(stack.step, stack.duration, [&]() {
        Vector change(bodies.integrator->state().u);
        change -= begin;
        drift = std::max(drift, change.linfty_norm());
        force_error =
          std::max(force_error,
                   std::abs(bodies.force_of("floor")[1] / weight - 1.));
        return true;
      });
      const std::string name =
        "stack of " + std::to_string(stack.n_blocks) +
        (stack.kinematics == Kinematics::small ? ", small" : ", finite") +
        (stack.dashpot > 0. ? ", damped" : "");
      measurements.add(
        4, name, "largest drift [blocks]", drift, 0., 1., 1e-6, run);
      measurements.add(4,
                       name,
                       "largest error of the floor's force [weight]",
                       force_error,
                       0.,
                       1.,
                       1e-6,
                       run);
      measurements.add(
        4, name, "worst balance [J/m]", run.worst_balance, 0., 1., 0., run);
    }
  } // namespace ContactBars
} // namespace NMM
