#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    /*
     * Rolling: a rigid disk goes on for ever. Sliding: friction mu m g slows it down
     * and turns it, mu m g R = I omega', I = m R^2 / 2, until v = omega R:
     * v_0 - mu g t = 2 mu g t after t = v_0 / (3 mu g), at v = 2 v_0 / 3, having come
     * 5 v_0^2 / (18 mu g) far.
     */
    void
    roll(const Disk &disk, Measurements &measurements)
    {
      constexpr double radius = 1., density = 2500., nu = 0.25,
                       pi = dealii::numbers::PI;
      Geometry geometry;
      geometry.add_circle({0., radius}, radius, "disk", CurveRole::boundary);
      Bodies::Options options;
      options.cell_size    = disk.cell_size;
      options.communicator = disk.communicator;
      options.obstacles    = {obstacle("floor", {{100., 0.}, {-100., 0.}})};
      MovingBodies body(std::move(geometry), options);
      body.problem.materials = {
        material("rock", disk.youngs_modulus, nu, density)};
      body.problem.gravity = Tensor<1, 2>({0., -standard_gravity});
      ContactParameters parameters =
        contact_parameters(disk.penalty * disk.youngs_modulus / disk.cell_size,
                           0.02 * radius);
      parameters.n_points = disk.n_points;

      // at rest on a smooth floor first
      body.start(parameters, Kinematics::finite);
      const Vector u       = body.find_rest(0.05);
      const double sinking = -body.value_at(u, Point<2>(0., 1e-9 * radius))[1];
      coulomb(parameters).friction = disk.friction;
      body.start(parameters, Kinematics::finite);
      const double V     = disk.velocity;
      const double omega = -disk.spin * V / radius;
      const Vector v     = body.values([&](const Point<2> &x, unsigned int) {
        return Tensor<1, 2>({V - omega * (x[1] - radius), omega * x[0]});
      });
      body.integrate(TimeScheme::energy_momentum(), u, v);
      const double start = body.displacement(0)[0];

      // how far the centre of an elastic cylinder comes nearer to a rigid plane
      // (Johnson, Contact Mechanics, 1985, eq. (5.56))
      const double modulus = disk.youngs_modulus / (1. - nu * nu);
      const double weight  = body.mass(0) * standard_gravity;
      const double square  = 4. * weight * radius / (pi * modulus);
      const double approach =
        weight / (pi * modulus * radius) *
        (2. * std::log(4. * radius / std::sqrt(square)) - 1.);

      std::ostringstream name;
      name << (disk.spin == 1. ? "rolling disk" : "sliding disk") << "; E "
           << disk.youngs_modulus << "; h " << disk.cell_size << "; points "
           << disk.n_points << "; step " << disk.step;
      const auto add = [&](const std::string &quantity,
                           const double       value,
                           const double       expected,
                           const double       bound,
                           const Run         &run) {
        measurements.add(
          5, name.str(), quantity, value, expected, 0., bound * approach, run);
      };
      const double energy = body.integrator->account().kinetic;
      Run          run;
      if (disk.spin == 1.)
      {
        run = body.run(disk.step, disk.duration);
        add("distance [m]",
            body.displacement(0)[0] - start,
            V * disk.duration,
            1.,
            run);
        add("velocity [m/s]", body.velocity(0)[0], V, 1., run);
        add("spin [rad/s]", body.angular_velocity(0), omega, 3., run);
      }
      else
      {
        const double mu_g = disk.friction * standard_gravity;
        const double time = V / (3. * mu_g);
        run               = body.run(disk.step, time);
        add("distance of sliding [m]",
            body.displacement(0)[0] - start,
            5. * V * V / (18. * mu_g),
            1.,
            run);
        add("velocity at its end [m/s]",
            body.velocity(0)[0],
            2. * V / 3.,
            1.,
            run);
        // then it swings about rolling on what holds it there
        const double x_1 = body.displacement(0)[0];
        const double t_1 = body.integrator->state().time;
        run += body.run(disk.step, t_1 + disk.duration * time);
        add("mean velocity later [m/s]",
            (body.displacement(0)[0] - x_1) /
              (body.integrator->state().time - t_1),
            2. * V / 3.,
            2.,
            run);
        add("spin later [rad/s]",
            body.angular_velocity(0),
            -2. * V / 3. / radius,
            0.,
            run);
      }
      measurements.add(5,
                       name.str(),
                       "worst balance [J/m]",
                       run.worst_balance,
                       0.,
                       energy,
                       1e-4,
                       run);
      measurements.add(5,
                       name.str(),
                       "sinking of the lowest point [m]",
                       sinking,
                       0.,
                       radius,
                       0.,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
