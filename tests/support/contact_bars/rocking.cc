#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      /// Time in which a rigid block on its corner falls from a tilt to upright,
      /// without the small angles of Housner's formula: the integral of
      /// d theta / sqrt(2 p^2 (cos(alpha - tilt) - cos(alpha - theta))).
      double
      rigid_quarter_period(const double alpha,
                           const double tilt,
                           const double p)
      {
        // theta = tilt (1 - s^2) takes the root's singularity away
        constexpr unsigned int n   = 2000;
        double                 sum = 0.;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double s     = (i + 0.5) / n;
          const double theta = tilt * (1. - s * s);
          const double rate =
            std::sqrt(2. * (std::cos(alpha - tilt) - std::cos(alpha - theta)));
          sum += 2. * tilt * s / rate / n;
        }
        return sum / p;
      }
    } // namespace


    void
    rock(const Rocking &rocking, Measurements &measurements)
    {
      constexpr double density = 2500.;
      const double     alpha = rocking.alpha, tilt = rocking.tilt,
                   R          = rocking.half_diagonal;
      const double width      = 2. * R * std::sin(alpha),
                   height     = 2. * R * std::cos(alpha);
      const double          p = std::sqrt(0.75 * standard_gravity / R);
      Geometry              geometry;
      std::vector<Point<2>> corners = {{0., 0.}};
      if (rocking.hollow > 0.)
        corners.emplace_back(0.5 * width, rocking.hollow * width);
      for (const Point<2> &x :
           {Point<2>(width, 0.), Point<2>(width, height), Point<2>(0., height)})
        corners.push_back(x);
      add_block(geometry, "block", corners);
      Bodies::Options options;
      options.cell_size = rocking.cell_size;
      options.obstacles = {obstacle("floor", {{100., 0.}, {-100., 0.}})};
      MovingBodies block(std::move(geometry), options);
      block.problem.materials = {
        material("rock", rocking.youngs_modulus, 0.2, density)};
      block.problem.gravity        = Tensor<1, 2>({0., -standard_gravity});
      ContactParameters parameters = contact_parameters(
        rocking.penalty * rocking.youngs_modulus / rocking.cell_size, 0.02 * R);
      coulomb(parameters).friction = 1.;
      coulomb(parameters).normal_damping =
        2. * rocking.dashpot *
        std::sqrt(coulomb(parameters).normal_stiffness * density * height);
      coulomb(parameters).shear_damping = coulomb(parameters).normal_damping;
      block.start(parameters, Kinematics::finite);

      // turned about the right corner, clockwise
      const Point<2> corner(width, 0.);
      const Vector   u = block.values([&](const Point<2> &x, unsigned int) {
        const Tensor<1, 2> d = x - corner;
        return Tensor<1, 2>(
          {(std::cos(tilt) - 1.) * d[0] + std::sin(tilt) * d[1],
           -std::sin(tilt) * d[0] + (std::cos(tilt) - 1.) * d[1]});
      });
      block.integrate(rocking.scheme, u, block.zero(), rocking.damping);

      // the tilt, positive to the right: mean turn of the middle line
      const Point<2> bottom(0.5 * width, 0.05 * height),
        top(0.5 * width, 0.95 * height);
      const double theory = std::acosh(1. / (1. - tilt / alpha)) / p;
      double       last = tilt, last_time = 0., crossing = 0., peak = 0.;
      const auto   watch = [&]() {
        const DynamicState &state = block.integrator->state();
        const Tensor<1, 2>  line  = (top - bottom) +
                                  block.value_at(state.u, top) -
                                  block.value_at(state.u, bottom);
        const double theta = std::atan2(line[0], line[1]);
        if (crossing == 0. && theta <= 0.)
          crossing =
            last_time + (state.time - last_time) * last / (last - theta);
        if (crossing > 0. && state.time < crossing + 2. * theory)
          peak = std::max(peak, -theta);
        last      = theta;
        last_time = state.time;
        return true;
      };
      const Run run = block.run(rocking.step, rocking.duration * theory, watch);

      std::ostringstream name;
      name << "rocking" << (rocking.hollow > 0. ? " on two corners" : "")
           << "; alpha " << alpha << "; tilt " << tilt << "; E "
           << rocking.youngs_modulus << "; step " << rocking.step << "; "
           << rocking.name;
      measurements.add(5,
                       name.str(),
                       "quarter period against rigid block [s]",
                       crossing,
                       rigid_quarter_period(alpha, tilt, p),
                       0.,
                       0.,
                       run);
      measurements.add(5,
                       name.str(),
                       "quarter period against Housner [s]",
                       crossing,
                       theory,
                       0.,
                       0.,
                       run);
      const double energy = std::cos(alpha - tilt) - std::cos(alpha);
      measurements.add(5,
                       name.str(),
                       "energy left by impact against Housner [-]",
                       (std::cos(alpha - peak) - std::cos(alpha)) / energy,
                       std::pow(1. - 1.5 * std::pow(std::sin(alpha), 2), 2),
                       0.,
                       0.,
                       run);
      measurements.add(5,
                       name.str(),
                       "worst balance [J/m]",
                       run.worst_balance,
                       0.,
                       block.mass(0) * standard_gravity * R * energy,
                       0.,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
