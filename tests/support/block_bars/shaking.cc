#include <algorithm>
#include <cmath>
#include <random>
#include <support/block_bars/block_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace BlockBars
  {
    namespace
    {
      /// Like a record: sines of random phase between 0.5 and 6 Hz within an
      /// envelope, 0.6 g at most, given every 0.01 s; along the incline.
      TimeHistory
      ground_motion(const BaseMotion &motion)
      {
        constexpr unsigned int n_sines = 24;
        constexpr double       every = 0.01, largest = 0.6 * standard_gravity;
        std::mt19937           generator(motion.seed);
        const auto random = [&]() { return generator() / 4294967296.; };
        double     frequencies[n_sines], phases[n_sines];
        for (unsigned int i = 0; i < n_sines; ++i)
        {
          frequencies[i] = 0.5 + 5.5 * (i + random()) / n_sines;
          phases[i]      = 2. * dealii::numbers::PI * random();
        }
        std::vector<double> times, values;
        double              peak = 0.;
        for (unsigned int k = 0; k * every <= motion.duration; ++k)
        {
          const double t     = k * every;
          const double share = t / motion.duration;
          const double envelope =
            std::pow(std::sin(dealii::numbers::PI * std::sqrt(share)), 2);
          double value = 0.;
          for (unsigned int i = 0; i < n_sines; ++i)
            value += std::sin(2. * dealii::numbers::PI * frequencies[i] * t +
                              phases[i]);
          times.push_back(t);
          values.push_back(envelope * value);
          peak = std::max(peak, std::abs(values.back()));
        }
        for (double &value : values)
          value *= largest / peak;
        return TimeHistory(times, values);
      }


      /// Of a rigid block against the ground, by small explicit steps [m].
      double
      rigid_displacement(const BaseMotion &motion, const TimeHistory &ground)
      {
        const double angle = degrees(motion.angle);
        const double drive = standard_gravity * std::sin(angle);
        const double limit = standard_gravity * std::cos(angle) *
                             std::tan(degrees(motion.friction_angle));
        constexpr double h = 1e-5;
        double           x = 0., v = 0.;
        for (double t = 0.5 * h; t < motion.duration; t += h)
        {
          const double force = drive - ground(t);
          double       a     = 0.;
          if (v != 0.)
            a = force - std::copysign(limit, v);
          else if (std::abs(force) > limit)
            a = force - std::copysign(limit, force);
          const double next = v + h * a;
          // friction stops it and does not turn it round
          const double end = v * next < 0. ? 0. : next;
          x += 0.5 * h * (v + end);
          v = end;
        }
        return x;
      }
    } // namespace


    void
    shake_block(const BaseMotion &motion, Measurements &measurements)
    {
      const TimeHistory ground = ground_motion(motion);
      Geometry          geometry;
      add_block(geometry, "block", {{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}});
      Bodies::Options options;
      options.cell_size           = 10.;
      options.mesh_of_every_block = true;
      options.obstacles = {obstacle("floor", {{99., 0.}, {-99., 0.}})};
      MovingBodies block(std::move(geometry), options);
      block.problem.materials = {material("rock", 1e9, 0.2, 2500.)};
      const double angle      = degrees(motion.angle);
      block.problem.gravity =
        standard_gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
      ContactParameters parameters = contact_parameters(1e10, 0.05);
      coulomb(parameters).friction = std::tan(degrees(motion.friction_angle));

      // at rest before the ground moves
      block.start(parameters, Kinematics::small);
      const Vector u       = block.find_rest(0.01);
      const auto   history = block.contact->history();
      Loading      loading;
      loading.base_acceleration = [&](const double t) {
        return Tensor<1, 2>({ground(t), 0.});
      };
      block.start(parameters, Kinematics::small, loading);
      block.contact->restore_history(history);
      block.integrate(TimeScheme::generalized_alpha(0.5), u, block.zero());
      const double begin    = block.displacement(0)[0];
      const Run    run      = block.run(motion.step, motion.duration);
      const double expected = rigid_displacement(motion, ground);
      measurements.add(4,
                       "shaken block; seed " + std::to_string(motion.seed),
                       "way along the incline [m]",
                       block.displacement(0)[0] - begin,
                       expected,
                       0.,
                       motion.bound,
                       run);
    }
  } // namespace BlockBars
} // namespace NMM
