// Analyses of one solid after another: equilibrium, relaxation, motion, stages, factor of safety.

#include <nmm/analysis/simulation.h>
#include <nmm/base/exceptions.h>
#include <nmm/geometry/geometry.h>
#include <nmm/mechanics/static_elasticity.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double gravity = 10., density = 2000., modulus = 1e9;


  Solid
  make_solid(const std::string &text,
             const double       cell_size,
             const MPI_Comm     communicator = MPI_COMM_WORLD)
  {
    RegularMeshParameters mesh;
    mesh.cell_size = cell_size;
    mesh.rotation  = 7.;
    return Solid(parse_geometry(text, "a test"), mesh, communicator);
  }


  SimulationParameters
  rock_under_gravity()
  {
    SimulationParameters result;
    Material             rock{"rock", modulus, 0.2};
    rock.density               = density;
    result.problem.plane_state = PlaneState::plane_strain;
    result.problem.materials   = {rock};
    result.problem.gravity[1]  = -gravity;
    return result;
  }


  /// Two square blocks of 1 m side on top of each other, the lower one held at its bottom.
  Solid
  make_stack()
  {
    return make_solid(
      "boundary name=bottom material=rock LINESTRING (0 0, 1 0)\n"
      "boundary name=sides LINESTRING (1 0, 1 2, 0 2, 0 0)\n"
      "joint name=bed LINESTRING (-1 1, 2 1)",
      0.4);
  }


  SimulationParameters
  stack_under_gravity()
  {
    SimulationParameters result        = rock_under_gravity();
    result.problem.boundary_conditions = {
      {"held", "bottom", BoundaryCondition::Type::displacement, nullptr}};
    result.contact.emplace();
    result.contact->choices.law = coulomb_friction(0.5);
    return result;
  }


  /// The largest difference of two vectors of relevant unknowns, of all ranks.
  double
  difference(const Simulation::Vector &a, const Simulation::Vector &b)
  {
    double largest = 0.;
    for (const auto i : a.locally_owned_elements())
      largest = std::max(largest, std::abs(a(i) - b(i)));
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }


  // A problem without contact has the solution of the linear system.
  TEST(Simulation, EquilibriumIsThatOfLinearElasticityMPI)
  {
    const Solid plate = make_solid(
      "boundary name=bottom material=rock LINESTRING (0 0, 1 0)\n"
      "boundary name=sides LINESTRING (1 0, 1 1, 0 1, 0 0)\n"
      "hole name=bore CIRCLE (0.5 0.5, 0.2)",
      0.13);
    SimulationParameters pulled        = rock_under_gravity();
    pulled.problem.boundary_conditions = {
      {"held", "bottom", BoundaryCondition::Type::displacement, nullptr}};
    Simulation simulation(plate, pulled);
    simulation.equilibrate();

    StaticElasticity linear(plate.covers(),
                            plate.quadrature(),
                            plate.constraints(),
                            pulled.problem);
    linear.assemble();
    linear.solve({});
    // Nitsche's penalties are the same, and both systems are solved directly.
    EXPECT_LT(difference(simulation.displacement(), linear.solution()),
              1e-9 * linear.solution().linfty_norm());
    EXPECT_EQ(simulation.load_factor(), 1.);
  }


  // Rest is the same, whether it is found by load steps or by relaxation, and remains in motion.
  TEST(Simulation, StackRests)
  {
    const Solid                stack = make_stack();
    const SimulationParameters given = stack_under_gravity();
    Simulation                 loaded(stack, given), dropped(stack, given);
    loaded.equilibrate(LoadSteps::equal(2));
    const Simulation::Vector rest    = loaded.displacement();
    const double             largest = rest.linfty_norm();
    // the compression of the column by its weight, rho g h^2 / 2 E', bounds the displacement from below
    EXPECT_GT(largest, 0.8 * density * gravity * 4. / (2. * modulus));
    // the pressure at the bed is the weight of the upper block
    EXPECT_NEAR(loaded.contact()->last_state().report.energy, 0., 1.);
    EXPECT_EQ(loaded.contact()->last_state().report.n_slip, 0u);

    RelaxationParameters relaxation;
    relaxation.step             = 0.01;
    relaxation.tolerance        = 1e-9;
    relaxation.max_displacement = 1.;
    dropped.relax(relaxation);
    // The paths differ, but nothing slips on either of them.
    EXPECT_LT(difference(rest, dropped.displacement()), 1e-5 * largest);

    StepControlParameters steps;
    steps.initial_step = 1e-3;
    unsigned int n     = 0;
    loaded.observe([&](const Simulation &) { ++n; });
    loaded.advance(0.01, steps);
    loaded.advance(0.01, steps);
    EXPECT_NEAR(loaded.time(), 0.02, 1e-12);
    EXPECT_EQ(n, 20u);
    // Newton's method leaves 1e-9 of the forces.
    EXPECT_LT(difference(rest, loaded.displacement()), 1e-6 * largest);

    loaded.equilibrate();
    EXPECT_LT(difference(rest, loaded.displacement()), 1e-6 * largest);
  }


  // A block on a plane with the slope 20 degrees slides when tan 30 / F is less than tan 20.
  TEST(Simulation, FactorOfSafetyOfABlockOnASlope)
  {
    const double slope  = 20. * dealii::numbers::PI / 180.,
                 strong = std::tan(30. * dealii::numbers::PI / 180.);
    const auto at       = [&](const double along, const double above) {
      std::ostringstream text;
      text.precision(17);
      text << along * std::cos(slope) - above * std::sin(slope) << ' '
           << along * std::sin(slope) + above * std::cos(slope);
      return text.str();
    };
    const Solid block =
      make_solid("boundary name=face material=rock POLYGON ((" + at(0., 0.) +
                   ", " + at(1., 0.) + ", " + at(1., 1.) + ", " + at(0., 1.) +
                   "))",
                 0.6);
    SimulationParameters given = rock_under_gravity();
    RigidObstacle        plane;
    plane.name   = "plane";
    plane.pieces = {
      CurvePiece::segment({3. * std::cos(slope), 3. * std::sin(slope)},
                          {-3. * std::cos(slope), -3. * std::sin(slope)})};
    given.contact.emplace();
    given.contact->obstacles   = {plane};
    given.contact->choices.law = coulomb_friction(strong);
    given.contact->choices.use = ContactUse::relaxation;
    Simulation           simulation(block, given);
    RelaxationParameters trial;
    trial.step               = 0.01;
    trial.tolerance          = 1e-6;
    trial.max_displacement   = 0.01;
    const auto expect_factor = [&]() {
      const SafetyFactor factor = simulation.find_safety_factor(trial);
      EXPECT_GT(strong / std::tan(slope), factor.stands_at * (1. - 2e-3));
      EXPECT_LT(strong / std::tan(slope), factor.moves_at * (1. + 2e-3));
    };
    expect_factor();
    // what the trials did is forgotten
    EXPECT_EQ(simulation.displacement().linfty_norm(), 0.);

    // The same from the state of rest, as often as one likes.
    simulation.equilibrate(LoadSteps::equal(2));
    const Simulation::Vector rest = simulation.displacement();
    EXPECT_GT(rest.linfty_norm(), 0.);
    expect_factor();
    expect_factor();
    EXPECT_EQ(difference(rest, simulation.displacement()), 0.);
  }


  // The upper block is taken away, and what is left of the motion is that of the lower one.
  TEST(Simulation, StageThenMotion)
  {
    const Solid                stack = make_stack();
    const SimulationParameters given = stack_under_gravity();
    Simulation                 simulation(stack, given);
    simulation.equilibrate();
    StageChange change;
    change.removed_blocks = {stack.manifold_mesh().block(
      stack.manifold_mesh().find_element({0.5, 1.5}))};
    change.released       = 0.5;
    simulation.apply(change);
    simulation.equilibrate(LoadSteps::equal(2));
    StepControlParameters steps;
    steps.initial_step = 1e-3;
    EXPECT_THROW(simulation.advance(0.01, steps), InputError);
    simulation.apply(StageChange());
    simulation.equilibrate();

    const Solid lower = make_solid(
      "boundary name=bottom material=rock LINESTRING (0 0, 1 0)\n"
      "boundary name=sides LINESTRING (1 0, 1 1, 0 1, 0 0)",
      0.4);
    SimulationParameters alone = given;
    alone.contact.reset();
    Simulation of_lower(lower, alone);
    of_lower.equilibrate();
    const auto top_of = [](const Simulation &of) {
      const auto [element, xi] = of.solid().locate({0.5, 0.999});
      return of.field().displacement(element, xi)[1];
    };
    // The meshes differ; the displacement of a column under its weight is nearly quadratic.
    EXPECT_NEAR(top_of(simulation) / top_of(of_lower), 1., 2e-3);

    const double before = top_of(simulation);
    simulation.advance(0.01, steps);
    EXPECT_NEAR(top_of(simulation) / before, 1., 1e-6);
  }
} // namespace
