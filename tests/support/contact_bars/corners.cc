#include <deal.II/base/timer.h>

#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      constexpr double soft_rock_modulus = 1e8;

      /// A polygon whose mean is @p center, turned by @p angle.
      std::vector<Point<2>>
      square(const Point<2> &center, const double half_diagonal)
      {
        return {center + Tensor<1, 2>({0., -half_diagonal}),
                center + Tensor<1, 2>({half_diagonal, 0.}),
                center + Tensor<1, 2>({0., half_diagonal}),
                center + Tensor<1, 2>({-half_diagonal, 0.})};
      }


      /// Loss of symmetry, energy and penetration: in every scenario.
      void
      add_account(const std::string &name,
                  const double       energy,
                  const double       size,
                  const Run         &run,
                  Measurements      &measurements)
      {
        measurements.add(7,
                         name,
                         "worst balance [J/m]",
                         run.worst_balance,
                         0.,
                         energy,
                         1e-5,
                         run);
        measurements.add(7,
                         name,
                         "largest penetration [m]",
                         run.largest_penetration,
                         0.,
                         size,
                         1e-2,
                         run);
      }


      /// Momentum to the side and spin of the upper square, and how fast it rises.
      struct Fall
      {
        Tensor<1, 2> velocity;
        double       spin = 0.;
      };


      Fall
      fall(const Corners     &corners,
           const double       offset,
           const bool         is_obstacle,
           const std::string &name,
           Measurements      &measurements)
      {
        constexpr double R = 0.5, gap = 0.005, V = 0.5;
        Geometry         geometry;
        add_block(geometry, "upper", square({offset, R + gap}, R));
        Bodies::Options options;
        options.cell_size           = 0.4;
        options.mesh_of_every_block = false;
        options.communicator        = corners.communicator;
        if (is_obstacle)
        {
          auto lower = square({0., -R}, R);
          lower.push_back(lower.front());
          options.obstacles = {obstacle("lower", lower)};
        }
        else
          add_block(geometry, "lower", square({0., -R}, R));
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials = {
          material("rock", soft_rock_modulus, 0.2, rock_density)};
        bodies.start(contact_parameters(10. * soft_rock_modulus / 0.4, 0.03),
                     Kinematics::finite);
        const unsigned int upper =
          is_obstacle ? 0
                      : (bodies.mesh.block(
                          bodies.mesh.find_element(Point<2>(offset, R + gap))));
        bodies.integrate(TimeScheme::energy_momentum(),
                         bodies.zero(),
                         bodies.values([&](const Point<2> &,
                                           const unsigned int block) {
                           return Tensor<1, 2>({0., block == upper ? -V : 0.});
                         }));
        const double energy = bodies.integrator->account().kinetic;
        const Run    run    = bodies.run(2e-4, 0.06 * corners.duration);
        add_account(name, energy, R, run, measurements);
        Fall result;
        result.velocity = bodies.velocity(upper) / V;
        result.spin     = bodies.angular_velocity(upper) * R / V;
        if (offset == 0.)
        {
          measurements.add(7,
                           name,
                           "velocity to the side [-]",
                           result.velocity[0],
                           0.,
                           1.,
                           1e-8,
                           run);
          measurements.add(7, name, "spin [-]", result.spin, 0., 1., 1e-8, run);
        }
        measurements.add(7,
                         name,
                         is_obstacle ? "rebound over fall [-]"
                                     : "what remains of the fall [-]",
                         result.velocity[1],
                         is_obstacle ? 1. : 0.,
                         1.,
                         offset == 0. ? 0.3 : 0.,
                         run);
        return result;
      }
    } // namespace


    void
    fall_on_vertex(const Corners &corners, Measurements &measurements)
    {
      fall(corners, 0., true, "vertex on rigid vertex", measurements);
      fall(corners, 0., false, "vertex on vertex", measurements);
      // beside it the square slides off to its side, and the mirror image to the other
      constexpr double beside = 0.01;
      const Fall       right =
        fall(corners, beside, true, "vertex right of vertex", measurements);
      const Fall left =
        fall(corners, -beside, true, "vertex left of vertex", measurements);
      measurements.add(7,
                       "vertex beside vertex",
                       "goes to its side [-]",
                       right.velocity[0] > 0.1 ? 1. : 0.,
                       1.,
                       1.,
                       0.5,
                       Run());
      measurements.add(7,
                       "vertex beside vertex",
                       "sum of mirror images [-]",
                       std::abs(right.velocity[0] + left.velocity[0]) +
                         std::abs(right.velocity[1] - left.velocity[1]) +
                         std::abs(right.spin + left.spin),
                       0.,
                       1.,
                       1e-6,
                       Run());
    }


    namespace
    {
      /// A block of 0.5 m that slides to the right over x = 0.
      void
      slide(const Corners                    &corners,
            const std::vector<RigidObstacle> &floor,
            const double                      slope,
            const double                      friction,
            const std::string                &name,
            Measurements                     &measurements)
      {
        constexpr double size = 0.5, V = 1.;
        Geometry         geometry;
        add_block(
          geometry,
          "block",
          {{-0.7, 0.}, {-0.7 + size, 0.}, {-0.7 + size, size}, {-0.7, size}});
        Bodies::Options options;
        options.cell_size    = 0.4;
        options.rotation     = 7.;
        options.communicator = corners.communicator;
        options.obstacles    = floor;
        MovingBodies body(std::move(geometry), options);
        body.problem.materials = {
          material("rock", soft_rock_modulus, 0.2, rock_density)};
        body.problem.gravity = Tensor<1, 2>({0., -standard_gravity});
        ContactParameters parameters =
          contact_parameters(10. * soft_rock_modulus / 0.4, 0.02);
        body.start(parameters, Kinematics::finite);
        const Vector u               = body.find_rest(0.01);
        coulomb(parameters).friction = friction;
        body.start(parameters, Kinematics::finite);
        body.integrate(TimeScheme::energy_momentum(),
                       u,
                       body.values([&](const Point<2> &, unsigned int) {
                         return Tensor<1, 2>({V, 0.});
                       }));
        const double energy     = body.integrator->account().kinetic;
        double       worst_spin = 0., highest = -1.;
        const Run    run =
          body.run(1e-3, (slope == 0. ? 0.9 : 1.2) * corners.duration, [&]() {
            worst_spin =
              std::max(worst_spin, std::abs(body.angular_velocity(0)));
            highest = std::max(highest, body.displacement(0)[1]);
            return true;
          });
        add_account(name, energy, size, run, measurements);
        if (slope == 0.)
        {
          // the corner of a floor that begins there is higher than the block's base by
          // the 5e-6 m that its springs give way: g delta / V^2 = 5e-5
          const bool is_one_floor = floor.size() == 1;
          measurements.add(7,
                           name,
                           "velocity behind the edge [m/s]",
                           body.velocity(0)[0],
                           V,
                           0.,
                           is_one_floor ? 1e-6 : 5e-5,
                           run);
          measurements.add(7,
                           name,
                           "largest spin [rad/s]",
                           worst_spin,
                           0.,
                           V / size,
                           is_one_floor ? 1e-4 : 1e-3,
                           run);
          return;
        }
        measurements.add(7,
                         name,
                         "highest rise of the centre [m]",
                         std::max(0., highest),
                         0.,
                         size,
                         1e-3,
                         run);
        // the way its bottom looks: along the slope, but for what it rocks
        const DynamicState &state = body.integrator->state();
        const Tensor<1, 2>  edge =
          Tensor<1, 2>({0.9 * size, 0.}) +
          body.value_at(state.u, {-0.7 + 0.95 * size, 0.01}) -
          body.value_at(state.u, {-0.7 + 0.05 * size, 0.01});
        measurements.add(7,
                         name,
                         "tilt in the end [degrees]",
                         std::atan2(edge[1], edge[0]) * 180. /
                           dealii::numbers::PI,
                         -slope,
                         slope,
                         0.25,
                         run);
      }
    } // namespace


    void
    slide_off_edge(const Corners &corners, Measurements &measurements)
    {
      slide(corners,
            {obstacle("floor", {{9., 0.}, {0., 0.}, {-9., 0.}})},
            0.,
            0.,
            "over an edge in line",
            measurements);
      slide(corners,
            {obstacle("left",
                      {{0., 0.}, {-9., 0.}, {-9., -1.}, {0., -1.}, {0., 0.}}),
             obstacle("right",
                      {{9., 0.}, {0., 0.}, {0., -1.}, {9., -1.}, {9., 0.}})},
            0.,
            0.,
            "onto the next block in line",
            measurements);
      const double   slope = 15.;
      const Point<2> down(9., -9. * std::tan(degrees(slope)));
      for (const double friction : {0., 0.1})
        slide(corners,
              {obstacle("floor", {down, {0., 0.}, {-9., 0.}})},
              slope,
              friction,
              friction == 0. ? "off an edge, smooth" : "off an edge, rough",
              measurements);
    }


    void
    drop_into_notch(const Corners &corners, Measurements &measurements)
    {
      // half of the angle, and depth [m]
      const double    half = degrees(30.), depth = 1.;
      const double    a = std::tan(half);
      Bodies::Options options;
      options.cell_size    = 0.5;
      options.communicator = corners.communicator;
      RigidObstacle right =
        obstacle("notch", {{2. * a, 2.}, {0., 0.}, {-2. * a, 2.}});
      options.obstacles = {right};
      const auto make   = [&](const double gap) {
        Geometry geometry;
        add_block(geometry,
                  "wedge",
                  {{0., gap},
                   {a * depth, depth + gap},
                   {-a * depth, depth + gap}});
        auto body =
          std::make_unique<MovingBodies>(std::move(geometry), options);
        body->problem.materials = {
          material("rock", soft_rock_modulus, 0.2, rock_density)};
        body->problem.gravity = Tensor<1, 2>({0., -standard_gravity});
        body->start(contact_parameters(10. * soft_rock_modulus / 0.5, 0.03),
                    Kinematics::finite);
        return body;
      };
      const double weight = rock_density * standard_gravity * a * depth * depth;
      {
        const auto        body = make(0.);
        const std::string name = "wedge at rest in a notch";
        dealii::Timer     timer;
        const Vector      u = body->find_rest(0.01);
        Run               run;
        run.seconds             = timer.wall_time();
        run.n_steps             = body->integrator->state().step;
        run.largest_penetration = body->contact->report().largest_penetration;
        // by the sides' normals: each bears W / (2 sin half)
        double sides[2] = {0., 0.};
        for (const ContactPoint &point : body->contact->points())
          if (point.state != ContactState::open)
            sides[point.normal[0] > 0. ? 0 : 1] +=
              point.weight * point.pressure;
        for (double &side : sides)
          side = dealii::Utilities::MPI::sum(side, corners.communicator);
        for (const unsigned int i : {0U, 1U})
          measurements.add(7,
                           name,
                           i == 0 ? "force of the left side [N/m]"
                                  : "force of the right side [N/m]",
                           sides[i],
                           0.5 * weight / std::sin(half),
                           0.,
                           1e-6,
                           run);
        measurements.add(7,
                         name,
                         "largest penetration [m]",
                         run.largest_penetration,
                         0.,
                         depth,
                         1e-3,
                         run);
      }
      const auto        body = make(0.02);
      const std::string name = "wedge dropped into a notch";
      body->integrate(TimeScheme::energy_momentum());
      double    spin = 0., aside = 0.;
      const Run run = body->run(1e-3, 0.5 * corners.duration, [&]() {
        spin  = std::max(spin, std::abs(body->angular_velocity(0)));
        aside = std::max(aside, std::abs(body->velocity(0)[0]));
        return true;
      });
      add_account(name, weight * 0.02, depth, run, measurements);
      const double speed = std::sqrt(2. * standard_gravity * 0.02);
      measurements.add(
        7, name, "velocity to the side [m/s]", aside, 0., speed, 1e-6, run);
      measurements.add(
        7, name, "spin [rad/s]", spin, 0., speed / depth, 1e-6, run);
    }


    namespace
    {
      void
      compress_four(const Corners &corners,
                    const double   tolerance,
                    Measurements  &measurements)
      {
        Geometry geometry;
        add_named_box(geometry, "", {-1., -1.}, {1., 1.});
        geometry.add_polyline({{-1., 0.}, {0., 0.}, {1., 0.}},
                              "across",
                              CurveRole::joint);
        geometry.add_polyline({{0., -1.}, {0., 0.}, {0., 1.}},
                              "up",
                              CurveRole::joint);
        Bodies::Options options;
        options.cell_size    = 0.5;
        options.rotation     = 11.;
        options.communicator = corners.communicator;
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials = {
          material("rock", soft_rock_modulus, 0.2, rock_density)};
        constexpr double p                 = 1e5;
        using Type                         = BoundaryCondition::Type;
        bodies.problem.boundary_conditions = {
          condition(Type::normal_displacement, "bottom"),
          condition(Type::normal_displacement, "left"),
          condition(Type::pressure, "right", constant(p)),
          condition(Type::pressure, "top", constant(p))};
        ContactParameters parameters =
          contact_parameters(10. * soft_rock_modulus / 0.5, 0.05);
        parameters.penetration_tolerance = tolerance;
        bodies.start(parameters, Kinematics::small);
        Run           run;
        dealii::Timer timer;
        run.n_steps = bodies.statics->run(LoadSteps::equal(1)).size();
        run.seconds = timer.wall_time();
        const Vector           &u     = bodies.statics->solution();
        double                  error = 0.;
        const DisplacementField field(bodies.covers, bodies.problem, u);
        const auto [first, last] = bodies.covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
        {
          SymmetricTensor<2, 2> stress =
            field.stress(e,
                         bodies.mesh.mathematical_mesh().real_to_reference(
                           bodies.mesh.cell(e), bodies.inner_point(e)));
          stress[0][0] += p;
          stress[1][1] += p;
          error = std::max(error, stress.norm());
        }
        error = dealii::Utilities::MPI::max(error, corners.communicator);
        // the springs give way by p / eps, and blocks overlap by as much where
        // four of them meet
        const double      give = p / coulomb(parameters).normal_stiffness;
        const std::string name = std::string("four blocks pressed together") +
                                 (tolerance > 0. ? "; augmented" : "; penalty");
        measurements.add(7,
                         name,
                         "error of the stress [Pa]",
                         error,
                         0.,
                         p,
                         tolerance > 0. ? 1e-3 : 0.,
                         run);
        measurements.add(7,
                         name,
                         "largest penetration [m]",
                         bodies.contact->report().largest_penetration,
                         tolerance > 0. ? 0. : give,
                         give,
                         tolerance > 0. ? 1e-3 : 2e-2,
                         run);
      }
    } // namespace


    void
    meet_in_a_point(const Corners &corners, Measurements &measurements)
    {
      for (const double tolerance : {0., 1e-9})
        compress_four(corners, tolerance, measurements);

      // four squares fly there along the diagonals
      constexpr double size = 0.5, gap = 0.005, V = 0.5;
      Geometry         geometry;
      for (const double x : {-1., 1.})
        for (const double y : {-1., 1.})
        {
          const Point<2> lower(x > 0. ? gap : -gap - size,
                               y > 0. ? gap : -gap - size);
          add_block(geometry,
                    std::string(y > 0. ? "upper" : "lower") +
                      (x > 0. ? " right" : " left"),
                    {lower,
                     lower + Tensor<1, 2>({size, 0.}),
                     lower + Tensor<1, 2>({size, size}),
                     lower + Tensor<1, 2>({0., size})});
        }
      Bodies::Options options;
      options.cell_size    = 0.4;
      options.communicator = corners.communicator;
      MovingBodies bodies(std::move(geometry), options);
      bodies.problem.materials = {
        material("rock", soft_rock_modulus, 0.2, rock_density)};
      bodies.start(contact_parameters(10. * soft_rock_modulus / 0.4, 0.03),
                   Kinematics::finite);
      std::vector<Tensor<1, 2>> sides(4);
      for (const double x : {-1., 1.})
        for (const double y : {-1., 1.})
          sides[bodies.mesh.block(bodies.mesh.find_element(
            Point<2>(x * 0.5 * size, y * 0.5 * size)))] = Tensor<1, 2>({x, y});
      bodies.integrate(TimeScheme::energy_momentum(),
                       bodies.zero(),
                       bodies.values(
                         [&](const Point<2> &, const unsigned int block) {
                           return -V * sides[block];
                         }));
      const double      energy = bodies.integrator->account().kinetic;
      const std::string name   = "four blocks flying to a point";
      const Run         run    = bodies.run(2e-4, 0.06 * corners.duration);
      add_account(name, energy, size, run, measurements);
      // the same for all, mirrored
      const Tensor<1, 2> first = bodies.velocity(0);
      double             worst = 0., spin = 0., rebound = 0.;
      for (unsigned int b = 0; b < 4; ++b)
      {
        const Tensor<1, 2> v = bodies.velocity(b);
        for (unsigned int c = 0; c < 2; ++c)
        {
          worst =
            std::max(worst,
                     std::abs(v[c] * sides[b][c] - first[c] * sides[0][c]));
          rebound += v[c] * sides[b][c] / 8.;
        }
        spin = std::max(spin, std::abs(bodies.angular_velocity(b)));
      }
      // the meshes of the four are not mirror images: 3.8, 1.6 and 0.5 % with cells
      // of 0.4, 0.2 and 0.1 m
      measurements.add(
        7, name, "asymmetry of velocities [m/s]", worst, 0., V, 5e-2, run);
      measurements.add(
        7, name, "rebound over approach [-]", rebound / V, 1., 1., 0.1, run);
      measurements.add(7, name, "spin [rad/s]", spin, 0., V / size, 0., run);
      measurements.add(7,
                       name,
                       "total momentum [kg/s]",
                       bodies.integrator->account().linear_momentum.norm(),
                       0.,
                       bodies.mass(0) * V,
                       1e-9,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
