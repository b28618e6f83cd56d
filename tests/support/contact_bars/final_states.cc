#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      std::vector<double>
      state_of(MovingBodies &bodies, const unsigned int n_blocks)
      {
        std::vector<double> result;
        const auto          append = [&](const Tensor<1, 2> &v) {
          result.push_back(v[0]);
          result.push_back(v[1]);
        };
        for (unsigned int b = 0; b < n_blocks; ++b)
        {
          append(bodies.displacement(b));
          append(bodies.velocity(b));
          result.push_back(bodies.angular_velocity(b));
        }
        const DynamicState &state   = bodies.integrator->state();
        const Account      &account = bodies.integrator->account();
        for (const double x : {state.u.l2_norm(),
                               state.v.l2_norm(),
                               account.kinetic,
                               account.strain,
                               account.conditions,
                               account.dissipated})
          result.push_back(x);
        return result;
      }


      Bodies::Options
      options_of(const MPI_Comm communicator, const double cell_size)
      {
        Bodies::Options options;
        options.cell_size    = cell_size;
        options.rotation     = 7.;
        options.communicator = communicator;
        return options;
      }


      constexpr double E = 1e8;


      /// Two blocks, one on the other, slide with friction and hit a wall.
      std::vector<double>
      pile(const MPI_Comm communicator)
      {
        Geometry geometry;
        add_block(geometry, "low", {{0., 0.}, {1., 0.}, {1., 0.5}, {0., 0.5}});
        add_block(geometry,
                  "high",
                  {{0.1, 0.505}, {0.7, 0.505}, {0.7, 0.9}, {0.1, 0.9}});
        Bodies::Options options = options_of(communicator, 0.3);
        options.obstacles       = {obstacle("floor", {{9., 0.}, {-9., 0.}}),
                                   obstacle("wall", {{1.01, 9.}, {1.01, -1.}})};
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials     = {material("rock", E, 0.2, 2500.)};
        bodies.problem.gravity       = Tensor<1, 2>({3., -9.81});
        ContactParameters parameters = contact_parameters(10. * E, 0.05);
        coulomb(parameters).friction = 0.2;
        bodies.start(parameters, Kinematics::finite);
        bodies.integrate(TimeScheme::energy_momentum());
        (void)bodies.run(2e-3, 0.1);
        return state_of(bodies, 2);
      }


      std::vector<double>
      disk(const MPI_Comm communicator)
      {
        Geometry geometry;
        geometry.add_circle({0., 1.}, 1., "disk", CurveRole::boundary);
        Bodies::Options options = options_of(communicator, 0.5);
        options.obstacles       = {obstacle("floor", {{9., 0.}, {-9., 0.}})};
        MovingBodies bodies(std::move(geometry), options);
        bodies.problem.materials     = {material("rock", E, 0.2, 2500.)};
        bodies.problem.gravity       = Tensor<1, 2>({0., -9.81});
        ContactParameters parameters = contact_parameters(10. * E, 0.05);
        coulomb(parameters).friction = 0.2;
        bodies.start(parameters, Kinematics::finite);
        bodies.integrate(TimeScheme::energy_momentum(),
                         bodies.zero(),
                         bodies.values([](const Point<2> &, unsigned int) {
                           return Tensor<1, 2>({1., 0.});
                         }));
        (void)bodies.run(5e-3, 0.15);
        return state_of(bodies, 1);
      }


      /// A bonded joint that breaks when a bar is pulled.
      std::vector<double>
      joint(const MPI_Comm communicator)
      {
        Geometry geometry;
        add_named_box(geometry, "", {0., 0.}, {2., 0.5});
        geometry.add_polyline({{0.8, 0.}, {1.1, 0.5}},
                              "joint",
                              CurveRole::joint);
        Bodies::Options options = options_of(communicator, 0.3);
        MovingBodies    bodies(std::move(geometry), options);
        bodies.problem.materials           = {material("rock", E, 0.2, 2500.)};
        bodies.problem.boundary_conditions = {
          condition(BoundaryCondition::Type::pressure, "left", constant(1e4)),
          condition(BoundaryCondition::Type::pressure,
                    "right",
                    constant(-1e4))};
        ContactParameters parameters = contact_parameters(10. * E, 0.05);
        coulomb(parameters).is_bond  = true;
        coulomb(parameters).friction = 0.3;
        coulomb(parameters).tensile_strength = coulomb(parameters).cohesion =
          1.2e4;
        bodies.start(parameters, Kinematics::small);
        bodies.integrate(TimeScheme::energy_momentum());
        (void)bodies.run(5e-4, 0.05);
        return state_of(bodies, 2);
      }
    } // namespace


    std::vector<std::pair<std::string, std::vector<double>>>
    final_states(const MPI_Comm communicator)
    {
      return {{"pile", pile(communicator)},
              {"disk", disk(communicator)},
              {"joint", joint(communicator)}};
    }
  } // namespace ContactBars
} // namespace NMM
