// A free square turned at constant angular velocity through 100 revolutions of 36
// steps: what each scheme does to its area, energy and angular momentum. Prints a
// table and writes it as CSV; argument 1: number of revolutions, argument 2: the
// file. The mesh is offset and turned against the square.

#include <nmm/base/program.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <dynamics/dynamic_model.h>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr unsigned int n_per_revolution = 36;
  constexpr double       omega            = 1.;

  /// rho omega^2 L^2 / E = 1e-10: a block of rock of 1 m turning some 5
  /// times a minute.
  Body
  square()
  {
    return box({-0.5, -0.5}, {0.5, 0.5}, 0.4, material("rock", 1e10, 0.25, 1.));
  }


  RigidVelocity
  spin()
  {
    RigidVelocity velocity;
    velocity.angular_velocity = omega;
    return velocity;
  }


  struct Row
  {
    std::string  scheme;
    unsigned int n_steps = 0, n_iterations = 0;
    double       area = 0., energy = 0., angular_momentum = 0., seconds = 0.;
    std::string  remark;
  };


  /// Largest change of the area, and changes of energy and momentum in the end.
  Row
  run(const TimeScheme &scheme, const double h, const unsigned int n)
  {
    Body body = square();
    body.make_finite();
    TimeIntegrator integrator(*body.mechanics, scheme);
    integrator.initialize(body.zero(), body.velocity(spin()));
    const Account start = integrator.account();
    const double  area  = body.area(integrator.state().u);
    Row           row;
    row.scheme = scheme.name;
    dealii::Timer timer;
    for (; row.n_steps < n; ++row.n_steps)
    {
      const StepReport report = integrator.try_step(h);
      if (!report.converged)
      {
        row.remark = report.reason;
        break;
      }
      row.n_iterations += report.n_iterations;
      integrator.accept();
      row.area =
        std::max(row.area,
                 std::abs(body.area(integrator.state().u) / area - 1.));
    }
    row.seconds        = timer.wall_time();
    const Account &end = integrator.account();
    row.energy =
      (end.kinetic + end.strain) / (start.kinetic + start.strain) - 1.;
    row.angular_momentum = end.angular_momentum / start.angular_momentum - 1.;
    return row;
  }
} // namespace


int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  const unsigned int    revolutions = argc > 1 ? std::stoi(argv[1]) : 100;
  const unsigned int    n           = revolutions * n_per_revolution;
  const double          angle = 2. * dealii::numbers::PI / n_per_revolution;
  // midpoint rules turn by 2 atan(omega h / 2) in a step
  const double h_midpoint = 2. * std::tan(0.5 * angle) / omega;
  const double h          = angle / omega;

  std::ostringstream table;
  table << "scheme,steps,iterations,area,energy,angular_momentum,seconds,"
           "remark\n";
  table.precision(3);
  const auto add = [&](const Row &row) {
    table << row.scheme << ',' << row.n_steps << ',' << row.n_iterations << ','
          << row.area << ',' << row.energy << ',' << row.angular_momentum << ','
          << row.seconds << ",\"" << row.remark << "\"\n";
    std::cout << row.scheme << " done after " << row.seconds << " s"
              << std::endl;
  };
  add(run(TimeScheme::energy_momentum(), h_midpoint, n));
  add(run(TimeScheme::newmark(), h, n));
  add(run(TimeScheme::generalized_alpha(0.8), h, n));
  add(run(TimeScheme::constant_acceleration(), h, n));
  std::cout << table.str();
  if (argc > 2)
    std::ofstream(argv[2]) << table.str();
}
