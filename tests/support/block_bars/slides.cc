#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <support/block_bars/block_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace BlockBars
  {
    namespace
    {
      // as good as rigid: thin ends of elastic wedges lift off, and with them cohesion
      constexpr double rock_weight = 25e3, youngs_modulus = 1e12,
                       stiffness = 1e10;


      SafetyFactor
      find_factor(const Slides            &slides,
                  MovingBodies            &blocks,
                  const ContactParameters &parameters,
                  Run                     &run)
      {
        RelaxationParameters relaxation;
        relaxation.step             = 0.01;
        relaxation.tolerance        = 1e-6;
        relaxation.max_displacement = 0.05;
        SafetyFactorParameters search;
        search.tolerance = slides.tolerance;
        dealii::Timer timer;
        const auto    result = find_safety_factor(
          [&](const double factor) {
            blocks.start(reduce_strength(parameters, factor),
                         Kinematics::small);
            blocks.integrate(TimeScheme::constant_acceleration());
            const StrengthTrial trial =
              try_to_stand(*blocks.integrator, relaxation, factor);
            run.n_steps += trial.n_steps;
            return trial;
          },
          search);
        run.seconds += timer.wall_time();
        return result;
      }
    } // namespace


    void
    slide_wedge(const Slides &slides, Measurements &measurements)
    {
      const double          angle = degrees(35.), length = 10., top = 3.;
      Geometry              geometry;
      const Bodies::Options options = [&]() {
        Bodies::Options result;
        result.cell_size           = 30.;
        result.mesh_of_every_block = true;
        result.obstacles = {obstacle("plane", {{99., 0.}, {-99., 0.}})};
        return result;
      }();
      add_block(geometry, "wedge", {{0., 0.}, {length, 0.}, {4., top}});
      MovingBodies wedge(std::move(geometry), options);
      wedge.problem.materials = {
        material("rock", youngs_modulus, 0.2, rock_weight / standard_gravity)};
      wedge.problem.gravity =
        standard_gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
      const double weight = 0.5 * rock_weight * length * top;
      for (const double cohesion : {0., 20e3})
      {
        ContactParameters parameters = contact_parameters(stiffness, 0.05);
        coulomb(parameters).friction = std::tan(degrees(30.));
        coulomb(parameters).cohesion = cohesion;
        Run                run;
        const SafetyFactor factor = find_factor(slides, wedge, parameters, run);
        measurements.add(3,
                         "wedge on a plane; cohesion " +
                           std::to_string(cohesion / 1e3) + " kPa",
                         "factor of safety",
                         factor.value(),
                         (cohesion * length + weight * std::cos(angle) *
                                                coulomb(parameters).friction) /
                           (weight * std::sin(angle)),
                         0.,
                         slides.bound,
                         run);
      }
    }


    namespace
    {
      /**
       * Mobilized friction t of an active block (weight @p active, plane @p alpha) and a
       * passive one (@p passive, @p beta) that meet in a vertical plane, t on
       * all three. N, M: normal forces of the planes, P: of the contact;
       * P = N (sin a - t cos a), N (cos a + t sin a) + t P = active,
       * P = M (t cos b - sin b), M (cos b + t sin b) - t P = passive.
       */
      double
      mobilized_friction(const double active,
                         const double alpha,
                         const double passive,
                         const double beta)
      {
        const auto drive = [&](const double t) {
          const double a = std::sin(alpha) - t * std::cos(alpha);
          return active * a / (std::cos(alpha) + t * std::sin(alpha) + t * a);
        };
        const auto hold = [&](const double t) {
          const double b = t * std::cos(beta) - std::sin(beta);
          return passive * b / (std::cos(beta) + t * std::sin(beta) - t * b);
        };
        double slides = std::tan(beta), stands = std::tan(alpha);
        for (unsigned int i = 0; i < 60; ++i)
        {
          const double t                         = 0.5 * (slides + stands);
          (drive(t) > hold(t) ? slides : stands) = t;
        }
        return stands;
      }
    } // namespace


    void
    slide_two_blocks(const Slides &slides, Measurements &measurements)
    {
      const double alpha = degrees(45.), beta = degrees(10.);
      const double length = 10., low = length * std::tan(beta), top = 8.;
      // without its tip, which would run against the flat plane
      const double high = top - low, tip = 0.4;
      Geometry     geometry;
      add_block(geometry,
                "passive",
                {{0., 0.}, {length, low}, {length, top}, {0., 6.}});
      add_block(geometry,
                "active",
                {{length, low + tip},
                 {length + tip, low + tip},
                 {length + high, top},
                 {length, top}});
      Bodies::Options options;
      options.cell_size           = 30.;
      options.mesh_of_every_block = true;
      options.obstacles           = {obstacle(
        "planes",
        {{length + 2. * high, top + high}, {length, low}, {-length, -low}})};
      MovingBodies blocks(std::move(geometry), options);
      blocks.problem.materials = {
        material("rock", youngs_modulus, 0.2, rock_weight / standard_gravity)};
      blocks.problem.gravity       = standard_gravity * Tensor<1, 2>({0., -1.});
      ContactParameters parameters = contact_parameters(stiffness, 0.05);
      coulomb(parameters).friction = std::tan(degrees(30.));
      Run                run;
      const SafetyFactor factor = find_factor(slides, blocks, parameters, run);
      measurements.add(
        3,
        "active and passive block",
        "factor of safety",
        factor.value(),
        coulomb(parameters).friction /
          mobilized_friction(0.5 * rock_weight * (high * high - tip * tip),
                             alpha,
                             rock_weight * length * 0.5 * (6. + high),
                             beta),
        0.,
        slides.bound,
        run);
    }
  } // namespace BlockBars
} // namespace NMM
