#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <sstream>
#include <support/contact_bars/contact_bars.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      enum class Wall
      {
        rigid,
        deformable,
        /// The boundary of half of the plane.
        line
      };


      /// What follows from a seed. The wall stands at 0 < x < thickness, and the block is
      /// thrown at it from the left.
      struct Shot
      {
        Wall   wall      = Wall::rigid;
        double thickness = 0., speed = 0., step = 0., spin = 0.;
        /// Of the way that the block flies [rad].
        double                direction = 0.;
        std::vector<Point<2>> corners;
        Point<2>              center;
      };


      /// Half of the wall's height: what bounces does not come round its ends [m].
      constexpr double wall_height = 20.;

      /// Of the circle that the block's corners are on [m].
      constexpr double radius = 0.3;


      Shot
      make_shot(const unsigned int seed)
      {
        std::mt19937                           generator(seed);
        std::uniform_real_distribution<double> random(0., 1.);
        Shot                                   shot;
        const double                           kind = random(generator);
        shot.wall                                   = kind < 0.4 ? Wall::rigid
                                                      : kind < 0.9 ? Wall::deformable
                                                                   : Wall::line;
        shot.thickness = std::pow(10., -3. + 3. * random(generator));
        shot.speed     = std::pow(10., -1. + 3. * random(generator));
        // speed times step over thickness
        const double ratio = std::pow(10., -1. + 4. * random(generator));
        const double way   = ratio * shot.thickness;
        shot.step          = way / shot.speed;
        shot.direction     = 0.8 * (2. * random(generator) - 1.);
        // half of the shots spin, at most by 2.5 rad in a step, and at most as fast at
        // their corners as they fly
        constexpr double largest_turn = 2.5;
        if (random(generator) < 0.5)
          shot.spin = (2. * random(generator) - 1.) *
                      std::min(shot.speed / radius, largest_turn / shot.step);
        const unsigned int n     = 3 + generator() % 4;
        const double       phase = 2. * dealii::numbers::PI * random(generator);
        double             right = 0.;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = phase + 2. * dealii::numbers::PI *
                                         (i + 0.3 * random(generator)) / n;
          shot.corners.emplace_back(radius * std::cos(angle),
                                    radius * std::sin(angle));
          right = std::max(right, shot.corners.back()[0]);
        }
        // it reaches the wall in the first three steps, at about y = 0
        const double flight =
          (0.01 + 3. * random(generator)) * way * std::cos(shot.direction);
        shot.center =
          Point<2>(-right - flight, -flight * std::tan(shot.direction));
        for (Point<2> &corner : shot.corners)
          corner += shot.center;
        return shot;
      }


      /// Distance of a point from an edge [m], and the same with a sign, negative behind it: from
      /// chords, the nearest of which are divided again.
      std::pair<double, double>
      distance_from(const Point<2>       &x,
                    const ContactSurface &surface,
                    const unsigned int    edge)
      {
        constexpr unsigned int n = 8, n_levels = 3;
        double                 distance = 0., gap = 0., first = 0., last = 1.;
        for (unsigned int level = 0; level < n_levels; ++level)
        {
          const double size = (last - first) / n, begin = first;
          distance = std::numeric_limits<double>::max();
          for (unsigned int i = 0; i < n; ++i)
          {
            const double       s     = begin + i * size;
            const Point<2>     a     = surface.place(edge, s).x;
            const Tensor<1, 2> chord = surface.place(edge, s + size).x - a;
            const double       t =
              std::clamp(((x - a) * chord) / chord.norm_square(), 0., 1.);
            const Tensor<1, 2> way = x - a - t * chord;
            if (way.norm() >= distance)
              continue;
            distance = way.norm();
            gap      = (way[0] * chord[1] - way[1] * chord[0]) / chord.norm();
            first    = std::max(0., s - size);
            last     = std::min(1., s + 2. * size);
          }
        }
        return {distance, gap};
      }


      /// Deepest place of a corner of the block beyond the middle of the wall, over its
      /// thickness [-]: 0 there, where it would be pushed out on the other side; 1 where it
      /// comes out.
      double
      way_through(const Shot &shot, const ContactSurface &surface)
      {
        const auto &edges  = surface.edges();
        double      result = -std::numeric_limits<double>::max();
        for (unsigned int corner = 0; corner < edges.size(); ++corner)
        {
          if (edges[corner].body != 0)
            continue;
          const Point<2> x = surface.place(corner, 0.).x;
          // nearest places of the near and of the far side
          std::pair<double, double> near(std::numeric_limits<double>::max(),
                                         0.),
            far = near;
          for (unsigned int e = 0; e < edges.size(); ++e)
          {
            const double side = surface.reference_place(e, 0.5).normal()[0];
            if (edges[e].body != 0 && std::abs(side) > 0.5)
            {
              auto &nearest = side > 0. ? far : near;
              nearest       = std::min(nearest, distance_from(x, surface, e));
            }
          }
          // a half of the plane has no far side: the block is half inside
          result = std::max(result,
                            shot.wall == Wall::line
                              ? -near.second / radius
                              : (near.first - far.first) / shot.thickness);
        }
        return result;
      }


      Run
      run_shot(const Shot &shot, const unsigned int max_steps, double &through)
      {
        constexpr double      modulus = 1e10, density = 2500.;
        MovingBodies::Options options;
        options.cell_size           = 3.;
        options.mesh_of_every_block = true;
        Geometry geometry;
        add_block(geometry, "block", shot.corners);
        const double T = shot.thickness, H = wall_height;
        if (shot.wall == Wall::deformable)
          add_block(geometry, "wall", {{0., -H}, {T, -H}, {T, H}, {0., H}});
        else if (shot.wall == Wall::rigid)
          options.obstacles = {
            obstacle("wall", {{0., -H}, {T, -H}, {T, H}, {0., H}, {0., -H}})};
        else
          options.obstacles = {obstacle("wall", {{0., H}, {0., -H}})};
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials = {material("rock", modulus, 0.2, density)};
        bodies.start(contact_parameters(20. * modulus, 0.05),
                     Kinematics::finite);
        const Tensor<1, 2> velocity({shot.speed * std::cos(shot.direction),
                                     shot.speed * std::sin(shot.direction)});
        bodies.integrate(TimeScheme::energy_momentum(),
                         bodies.zero(),
                         bodies.values(
                           [&](const Point<2> &x, const unsigned int block) {
                             const Tensor<1, 2> d = x - shot.center;
                             return block == 0
                                      ? velocity + shot.spin *
                                                     Tensor<1, 2>({-d[1], d[0]})
                                      : Tensor<1, 2>();
                           }));

        // long enough to pass through the wall, had it not been there
        const double way = shot.speed * shot.step;
        const double end =
          shot.step *
          (4. + std::min(20., (T + (T < way ? 10. * T : 0.)) / way));
        Run                   result;
        StepControlParameters steps;
        steps.initial_step = shot.step;
        dealii::Timer timer;
        through = -std::numeric_limits<double>::max();
        try
        {
          StepControl(steps).run(
            *bodies.integrator, end, [&](const StepRecord &record) {
              ++result.n_steps;
              result.n_cuts += record.n_cuts;
              result.n_iterations += record.report.n_iterations;
              through = std::max(through, way_through(shot, bodies.surface));
              return result.n_steps < max_steps;
            });
        }
        catch (const NumericalFailure &failure)
        {
          result.failure = failure.message();
        }
        result.seconds = timer.wall_time();
        return result;
      }
    } // namespace


    void
    shoot_at_walls(const Shots &shots, Measurements &measurements)
    {
      Run                total;
      unsigned int       n_through = 0, n_failed = 0;
      double             largest = -1.;
      std::ostringstream list;
      for (unsigned int seed = shots.first_seed;
           seed < shots.first_seed + shots.n_shots;
           ++seed)
      {
        double     through = 0.;
        const Shot shot    = make_shot(seed);
        Run        run     = run_shot(shot, shots.max_steps, through);
        if (shots.is_verbose)
          std::cout << "seed " << seed << " wall " << int(shot.wall)
                    << " thickness " << shot.thickness << " speed "
                    << shot.speed << " step " << shot.step << " spin "
                    << shot.spin << ": " << run.n_steps << " steps, "
                    << run.n_cuts << " cut, " << run.seconds
                    << " s, through by " << through << " " << run.failure
                    << std::endl;
        n_failed += !run.failure.empty();
        run.failure.clear();
        total += run;
        largest = std::max(largest, through);
        if (through > 0.5)
        {
          ++n_through;
          list << " " << seed;
        }
      }
      const std::string name = std::to_string(shots.n_shots) +
                               " shots from seed " +
                               std::to_string(shots.first_seed);
      measurements.add(10,
                       name + (n_through > 0 ? ", through:" + list.str() : ""),
                       "shots that pass through a wall",
                       n_through,
                       0.,
                       1.,
                       0.5,
                       total);
      measurements.add(10,
                       name,
                       "shots that no step was short enough for",
                       n_failed,
                       0.,
                       shots.n_shots,
                       0.,
                       total);
      measurements.add(10,
                       name,
                       "furthest beyond the middle of a wall [thickness]",
                       largest,
                       0.,
                       1.,
                       0.,
                       total);
      measurements.add(
        10, name, "steps cut", total.n_cuts, 0., total.n_steps, 0., total);
    }
  } // namespace ContactBars
} // namespace NMM
