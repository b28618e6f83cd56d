// Scenarios of contact in time with known outcome, at full size. Argument 1: which
// group (2: incline, 3: impact, 4: stacks, 5: rocking and rolling, 6: joint wave,
// 7: corners, 8: random drops, 9: repeated runs, shots: shots at
// walls; 0: all), argument 2: the file for the table.

#include <nmm/base/program.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <support/contact_bars/contact_bars.h>

using namespace NMM;
using namespace NMM::ContactBars;

namespace
{
  /// An undamped block that slides with friction flutters and hops, and 1e-9 degrees of
  /// friction decide how: the bar is for the mean of twelve such runs.
  void
  flutter(Incline incline, Measurements &measurements)
  {
    constexpr unsigned int n     = 12;
    const double           angle = incline.friction_angle;
    double                 sum = 0., largest = 0.;
    incline.bound = 0.;
    for (unsigned int k = 1; k <= n; ++k)
    {
      incline.friction_angle = angle + 1e-9 * k;
      Measurements run;
      slide_down_incline(incline, run);
      const double error = std::abs(run.all().front().error);
      sum += error;
      largest = std::max(largest, error);
    }
    std::ostringstream name;
    name << "falls and slides, undamped, " << n << " runs: " << incline.angle
         << " degrees; friction " << angle << " + 1e-9, 2e-9, ...";
    measurements.add(
      2, name.str(), "mean error [-]", sum / n, 0., 1., 1e-4, {});
    measurements.add(
      2, name.str(), "largest error [-]", largest, 0., 1., 0., {});
  }


  void
  inclines(Measurements &measurements)
  {
    Incline incline;
    incline.begins_at_rest = false;
    for (const double angle : {10., 20., 30., 40., 50., 60.})
    {
      incline.angle          = angle;
      incline.friction_angle = 0.;
      slide_down_incline(incline, measurements);
      incline.friction_angle = 0.5 * angle;
      flutter(incline, measurements);
      Incline damped   = damped_incline();
      damped.angle     = angle;
      Incline undamped = incline;
      undamped.bound   = 0.;
      for (const double friction_angle :
           std::set<double>{0.5 * angle, angle - 5.})
      {
        damped.friction_angle = undamped.friction_angle = friction_angle;
        slide_down_incline(damped, measurements);
        // for comparison
        slide_down_incline(undamped, measurements);
      }
    }
    for (const auto &scheme :
         {TimeScheme::energy_momentum(), TimeScheme::generalized_alpha(0.5)})
      for (const double angle : {10., 20., 30., 40., 50., 60.})
        for (const bool begins_at_rest : {true, false})
        {
          Incline sticking = begins_at_rest ? Incline() : damped_incline();
          sticking.begins_at_rest = begins_at_rest;
          sticking.bound          = 1.;
          sticking.scheme         = scheme;
          sticking.angle          = angle;
          sticking.friction_angle = angle + 2.;
          stick_to_incline(sticking, measurements);
        }
  }


  void
  impacts(Measurements &measurements)
  {
    Impact impact;
    for (const double cell_size : {0.25, 0.125})
    {
      impact.cell_size = cell_size;
      impact.step      = 2e-3 * cell_size;
      run_into_each_other(impact, measurements);
    }
    impact.kinematics = Kinematics::finite;
    impact.cell_size  = 0.25;
    impact.step       = 5e-4;
    run_into_each_other(impact, measurements);
  }


  void
  stacks(Measurements &measurements)
  {
    Stack stack;
    for (const unsigned int n : {10, 30})
      for (const auto kinematics : {Kinematics::small, Kinematics::finite})
        for (const double dashpot : {0., 0.3})
        {
          stack.n_blocks   = n;
          stack.kinematics = kinematics;
          stack.dashpot    = dashpot;
          rest_in_a_stack(stack, measurements);
        }
  }


  void
  drops(Measurements &measurements)
  {
    Drops parameters;
    parameters.n_drops = 250;
    for (unsigned int i = 0; i < 4; ++i)
    {
      parameters.first_seed = 250 * i;
      drop_polygons(parameters, measurements);
    }
  }


  /// The stiffer the disk, the finer the mesh and the points its contact needs.
  void
  roll_stiffer_and_stiffer(Disk disk, Measurements &measurements)
  {
    roll(disk, measurements);
    disk.youngs_modulus *= 4.;
    disk.cell_size *= 0.5;
    disk.n_points = 16;
    disk.step     = 2e-3;
    roll(disk, measurements);
    disk.youngs_modulus *= 4.;
    disk.n_points = 20;
    disk.step     = 1e-3;
    roll(disk, measurements);
  }


  void
  rolling(Measurements &measurements)
  {
    roll_stiffer_and_stiffer(Disk(), measurements);
  }


  void
  sliding_disks(Measurements &measurements)
  {
    Disk disk;
    disk.spin = 0.;
    roll_stiffer_and_stiffer(disk, measurements);
  }


  void
  rocking(Measurements &measurements)
  {
    Rocking rocking;
    rocking.youngs_modulus = 1e9;
    rocking.step           = 5e-4;
    for (const double hollow : {0., 0.02})
      for (const double alpha : {0.25, 0.15})
      {
        rocking.hollow  = hollow;
        rocking.alpha   = alpha;
        rocking.tilt    = 0.4 * alpha;
        rocking.dashpot = 0.;
        rocking.scheme  = TimeScheme::energy_momentum();
        rocking.name    = "conserving";
        rock(rocking, measurements);
        rocking.dashpot = 3.;
        rocking.name    = "conserving with dashpots";
        rock(rocking, measurements);
        rocking.dashpot = 0.;
        rocking.scheme  = TimeScheme::generalized_alpha(0.5);
        rocking.name    = "generalized alpha 0.5";
        rock(rocking, measurements);
      }
    rocking.hollow         = 0.;
    rocking.alpha          = 0.25;
    rocking.tilt           = 0.1;
    rocking.youngs_modulus = 1e10;
    rocking.step           = 2e-4;
    rocking.scheme         = TimeScheme::energy_momentum();
    rocking.name           = "conserving";
    rock(rocking, measurements);
  }


  void
  waves(Measurements &measurements)
  {
    JointWave wave;
    for (unsigned int i = 0; i <= 12; ++i)
    {
      wave.frequency = 0.03 * std::pow(10., 0.25 * i);
      transmit(wave, measurements);
    }
  }


  void
  corners(Measurements &measurements)
  {
    const Corners parameters;
    fall_on_vertex(parameters, measurements);
    slide_off_edge(parameters, measurements);
    drop_into_notch(parameters, measurements);
    meet_in_a_point(parameters, measurements);
  }


  void
  shots(Measurements &measurements)
  {
    Shots parameters;
    parameters.n_shots = 100;
    for (unsigned int i = 0; i < 10; ++i)
    {
      parameters.first_seed = 100 * i;
      shoot_at_walls(parameters, measurements);
      std::cout << std::flush;
    }
  }


  /// A repeated run against the first one.
  void
  repeated(Measurements &measurements)
  {
    dealii::Timer timer;
    const auto    first  = final_states(MPI_COMM_WORLD);
    const auto    second = final_states(MPI_COMM_WORLD);
    const auto    alone  = final_states(MPI_COMM_SELF);
    Run           run;
    run.seconds = timer.wall_time();
    for (unsigned int i = 0; i < first.size(); ++i)
    {
      double repeat = 0., ranks = 0.;
      for (unsigned int j = 0; j < first[i].second.size(); ++j)
      {
        const double a = first[i].second[j];
        repeat += a == second[i].second[j] ? 0. : 1.;
        ranks = std::max(ranks,
                         std::abs(a - alone[i].second[j]) /
                           std::max(1e-3, std::abs(a)));
      }
      const std::string name =
        first[i].first + " on " +
        std::to_string(
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
        " ranks";
      measurements.add(9,
                       name,
                       "numbers that differ in a repetition",
                       repeat,
                       0.,
                       1.,
                       0.5,
                       run);
      measurements.add(
        9, name, "difference from one rank [-]", ranks, 0., 1., 1e-6, run);
    }
  }
} // namespace


int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  const std::string     which = argc > 1 ? argv[1] : "0";
  const bool            is_first =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  Measurements measurements(is_first ? &std::cout : nullptr);
  const std::pair<std::string, void (*)(Measurements &)> groups[] = {
    {"2", inclines},
    {"3", impacts},
    {"4", stacks},
    {"5-rocking", rocking},
    {"5-rolling", rolling},
    {"5-sliding", sliding_disks},
    {"6", waves},
    {"7", corners},
    {"8", drops},
    {"9", repeated},
    {"shots", shots}};
  for (const auto &[name, group] : groups)
    if (which == "0" || name.compare(0, which.size(), which) == 0)
    {
      try
      {
        group(measurements);
      }
      catch (const InputError &error)
      {
        std::cout << error.message() << std::endl;
      }
      catch (const NumericalFailure &failure)
      {
        std::cout << failure.message() << std::endl;
      }
    }
  if (is_first && argc > 2)
  {
    std::ofstream csv(argv[2]);
    measurements.write_csv(csv);
  }
}
