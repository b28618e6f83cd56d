#include <deal.II/base/timer.h>

#include <cmath>
#include <random>
#include <sstream>
#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      constexpr double pi = dealii::numbers::PI;

      /// Convex polygons of 3 to 7 corners, or stars of 5 to 8, some 0.7 m wide, one
      /// above the other; a gap below each.
      Geometry
      polygons(std::mt19937 &generator, const unsigned int n)
      {
        std::uniform_real_distribution<double> random(-1., 1.);
        Geometry                               geometry;
        double                                 height = 0.;
        for (unsigned int i = 0; i < n; ++i)
        {
          const bool         is_convex = generator() % 2 == 0;
          const unsigned int n_corners =
            is_convex ? 3 + generator() % 5 : 5 + generator() % 4;
          const double          R     = 0.35 + 0.15 * random(generator);
          const double          phase = pi * random(generator);
          const double          x     = 0.3 * random(generator);
          std::vector<Point<2>> corners;
          double                lowest = 0., highest = 0.;
          for (unsigned int j = 0; j < n_corners; ++j)
          {
            const double r     = is_convex || j % 2 == 0
                                   ? R
                                   : R * (0.55 + 0.1 * random(generator));
            const double shift = is_convex ? 0.25 * random(generator) : 0.;
            const double angle = phase + 2. * pi * (j + shift) / n_corners;
            corners.emplace_back(r * std::cos(angle), r * std::sin(angle));
            lowest  = j == 0 ? corners[j][1] : std::min(lowest, corners[j][1]);
            highest = j == 0 ? corners[j][1] : std::max(highest, corners[j][1]);
          }
          height += 0.05 + 0.05 * (random(generator) + 1.);
          for (Point<2> &corner : corners)
            corner += Point<2>(x, height - lowest);
          height += highest - lowest;
          add_block(geometry, "block " + std::to_string(i), corners);
        }
        return geometry;
      }


      struct Drop
      {
        Run    run;
        double gain = 0., energy = 0.;
        /// Of the bodies, and what the springs at a corner give way by when all of
        /// the energy of motion presses one corner of the shortest edge: both its
        /// points have a twelfth of the edge's length, at 60 degrees half of it; where a
        /// face nearly lies on another one, less.
        double overlap = 0., elastic_overlap = 0.;
      };


      Drop
      drop_one(const Drops &drops, const unsigned int seed)
      {
        constexpr double                       gravity = 9.81, density = 2500.;
        std::mt19937                           generator(seed);
        std::uniform_real_distribution<double> random(-1., 1.);
        const unsigned int                     n = 1 + generator() % 3;
        Geometry              geometry           = polygons(generator, n);
        const double          tilt               = 0.2 * random(generator);
        MovingBodies::Options options;
        options.cell_size           = 3.;
        options.mesh_of_every_block = true;
        options.communicator        = drops.communicator;
        options.obstacles = {obstacle("floor", {{20., 0.}, {-20., 0.}})};
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials = {
          material("rock", drops.youngs_modulus, 0.2, density)};
        bodies.problem.gravity =
          Tensor<1, 2>({gravity * std::sin(tilt), -gravity * std::cos(tilt)});
        ContactParameters parameters =
          contact_parameters(20. * drops.youngs_modulus, 0.05);
        coulomb(parameters).friction =
          std::tan((15. + 15. * (random(generator) + 1.)) * pi / 180.);
        coulomb(parameters).dilation =
          drops.dilation * coulomb(parameters).friction;
        coulomb(parameters).dilation_limit = drops.dilation_limit;
        coulomb(parameters).normal_damping = coulomb(parameters).shear_damping =
          2. * drops.dashpot *
          std::sqrt(coulomb(parameters).normal_stiffness * density * 0.5);
        bodies.start(parameters, Kinematics::finite);
        bodies.integrate(TimeScheme::energy_momentum());

        Drop       result;
        const auto energy = [&]() {
          const Account &account = bodies.integrator->account();
          return account.kinetic + account.strain + account.conditions -
                 account.external_work;
        };
        double last     = energy();
        result.run      = bodies.run(drops.step, drops.duration, [&]() {
          const double now = energy();
          // also false for what is no number
          if (!(now - last <= result.gain))
            result.gain = now - last;
          last = now;
          result.energy =
            std::max(result.energy, bodies.integrator->account().kinetic);
          result.overlap =
            std::max(result.overlap, bodies.surface.largest_overlap());
          return std::isfinite(now);
        });
        double shortest = std::numeric_limits<double>::max();
        for (const auto &edge : bodies.surface.edges())
          shortest = std::min(shortest, edge.length);
        result.elastic_overlap =
          std::sqrt(2. * result.energy /
                    (coulomb(parameters).normal_stiffness * shortest / 12.));
        return result;
      }
    } // namespace


    void
    drop_polygons(const Drops &drops, Measurements &measurements)
    {
      Run                total;
      double             worst_gain = 0., worst_balance = 0., overlap = 0.;
      double             overlap_ratio = 0.;
      unsigned int       n_failed      = 0;
      std::ostringstream failures;
      for (unsigned int seed = drops.first_seed;
           seed < drops.first_seed + drops.n_drops;
           ++seed)
      {
        const Drop drop = drop_one(drops, seed);
        total += drop.run;
        const double scale = std::max(drop.energy, 1.);
        worst_balance = std::max(worst_balance, drop.run.worst_balance / scale);
        if (!(drop.gain / scale <= worst_gain))
          worst_gain = drop.gain / scale;
        overlap = std::max(overlap, drop.overlap);
        overlap_ratio =
          std::max(overlap_ratio, drop.overlap / (drop.elastic_overlap + 1e-6));
        if (!drop.run.failure.empty())
        {
          ++n_failed;
          failures << " seed " << seed << ": " << drop.run.failure << ";";
        }
      }
      const std::string name =
        std::to_string(drops.n_drops) + " drops from seed " +
        std::to_string(drops.first_seed) + failures.str();
      measurements.add(
        8, name, "drops that did not end", n_failed, 0., 1., 0.5, total);
      measurements.add(8,
                       name,
                       "largest gain of energy in a step [kinetic]",
                       worst_gain,
                       0.,
                       1.,
                       1e-9,
                       total);
      measurements.add(
        8, name, "worst balance [kinetic]", worst_balance, 0., 1., 1e-4, total);
      measurements.add(
        8, name, "steps cut", total.n_cuts, 0., total.n_steps, 0., total);
      measurements.add(
        8, name, "largest overlap of bodies [m]", overlap, 0., 1., 0., total);
      measurements.add(8,
                       name,
                       "overlap over what springs give way by",
                       overlap_ratio,
                       0.,
                       1.,
                       2.,
                       total);
    }
  } // namespace ContactBars
} // namespace NMM
