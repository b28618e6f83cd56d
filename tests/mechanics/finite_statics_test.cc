// Solutions in finite kinematics: exact states, limits, the
// cantilever of step-nmm-2, failures.

#include <nmm/materials/material.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <sstream>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  double
  displacement_error(const Model                                         &model,
                     const Vector                                        &u,
                     const std::function<Tensor<1, 2>(const Point<2> &)> &exact)
  {
    const DisplacementField field(model.covers, model.problem, u);
    return compute_errors(field,
                          exact,
                          [](const Point<2> &) {
                            return SymmetricTensor<2, 2>();
                          })
      .displacement;
  }


  /// The cantilever of the paper's Fig. 10.
  constexpr double length = 10., height = 1., youngs_modulus = 120000.;

  std::unique_ptr<Model>
  cantilever(const bool         follower,
             const double       cell_size,
             const unsigned int degree       = 2,
             const MPI_Comm     communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {length, height});
    auto model = std::make_unique<Model>(
      std::move(geometry),
      mesh_parameters(cell_size, Tensor<1, 2>({0.03, 0.02}), 7.),
      degree,
      Stabilization::aggregation,
      communicator);
    model->problem.materials        = {material("beam", youngs_modulus, 0.2)};
    model->problem.materials[0].law = material_law("St. Venant-Kirchhoff");
    // K = 10 at load factor 1
    const double P = 10. * youngs_modulus / 12. / std::pow(length, 3);
    model->problem.boundary_conditions = {
      condition(Type::displacement, "left")};
    for (const std::string side : {"top", "bottom"})
      model->problem.boundary_conditions.push_back(
        follower ? condition(Type::follower_pressure,
                             side,
                             constant(side == "top" ? P / 2. : -P / 2.))
                 : condition(Type::traction, side, vector_function([P](auto &) {
                               return Tensor<1, 2>({0., -P / 2.});
                             })));
    return model;
  }


  /// -v / L of the middle of the end.
  double
  tip_deflection(const Model &model, const Vector &u)
  {
    const DisplacementField field(model.covers, model.problem, u);
    const Point<2>          tip(length, height / 2.);
    const unsigned int      element =
      model.manifold_mesh.find_element({length - 1e-9, height / 2.});
    const auto [first, last] = model.covers.locally_owned_elements();
    const double w =
      element >= first && element < last
        ? -field.displacement(element,
                              model.mathematical_mesh.real_to_reference(
                                model.manifold_mesh.cell(element), tip))[1] /
            length
        : -1e300;
    return dealii::Utilities::MPI::max(w, model.covers.communicator());
  }


  /// solid_w_over_L by K, from the table of step-nmm-2.
  std::map<double, double>
  reference(const std::string &load)
  {
    std::ifstream            file(NMM_SOURCE_DIR
                       "/applications/step-nmm-2/cantilever.csv");
    std::map<double, double> result;
    for (std::string line; std::getline(file, line);)
    {
      std::vector<std::string> cells;
      std::istringstream       in(line);
      for (std::string cell; std::getline(in, cell, ',');)
        cells.push_back(cell);
      if (cells.size() == 9 && cells[0] == load && !cells[7].empty())
        result[std::stod(cells[1])] = std::stod(cells[7]);
    }
    return result;
  }
} // namespace


// A homogeneous deformation given on the outline, with interfaces and joints
// tied in between, is exact on any cut.
TEST(FiniteStatics, HomogeneousDeformationMPI)
{
  const auto exact = [](const Point<2> &x) {
    return Tensor<1, 2>(
      {0.1 + 0.2 * x[0] + 0.3 * x[1], -0.2 - 0.25 * x[0] - 0.1 * x[1]});
  };
  for (const std::shared_ptr<const MaterialLaw> &law :
       {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
    for (const PlaneState state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      for (const unsigned int degree : {1, 2})
      {
        const auto model                 = jointed_box(degree, law, state);
        model->problem.materials[1]      = model->problem.materials[0];
        model->problem.materials[1].name = "soil";
        for (const std::string side : {"left", "right", "top", "bottom"})
          model->problem.boundary_conditions.push_back(
            condition(Type::displacement, side, vector_function(exact)));
        const auto       elasticity = finite_elasticity(*model);
        NonlinearStatics statics(*elasticity);
        statics.run(LoadSteps::equal(2));
        // tolerance of Newton's method, squared by the last iteration, times a
        // condition number of 1e4
        EXPECT_LT(displacement_error(*model, statics.solution(), exact), 1e-9);
      }
}


// Uniaxial stress by a dead traction: S_11 = E E_11 for St. Venant-Kirchhoff.
TEST(FiniteStatics, UniaxialTractionMPI)
{
  for (const unsigned int degree : {1, 2})
  {
    const auto model                 = jointed_box(degree,
                                   material_law("St. Venant-Kirchhoff"),
                                   PlaneState::plane_stress);
    model->problem.materials[1]      = model->problem.materials[0];
    model->problem.materials[1].name = "soil";
    const double E11 = 0.25, E = 1000., nu = 0.2;
    const double l1                    = std::sqrt(1. + 2. * E11),
                 l2                    = std::sqrt(1. - 2 * nu * E11);
    model->problem.boundary_conditions = {
      condition(Type::normal_displacement, "left"),
      condition(Type::normal_displacement, "bottom"),
      condition(Type::traction, "right", vector_function([=](auto &) {
                  return Tensor<1, 2>({l1 * E * E11, 0.});
                }))};
    const auto       elasticity = finite_elasticity(*model);
    NonlinearStatics statics(*elasticity);
    statics.run(LoadSteps::equal(2));
    EXPECT_LT(displacement_error(
                *model,
                statics.solution(),
                [=](const Point<2> &x) {
                  return Tensor<1, 2>({(l1 - 1.) * x[0], (l2 - 1.) * x[1]});
                }),
              1e-9);
    // W = E E_11^2 / 2
    EXPECT_NEAR(elasticity->energies().strain,
                2. * 0.5 * E * E11 * E11,
                1e-9 * E);
  }
}


// Follower pressure on all free sides: F = lambda I with S = -p I, from
// P N = -p cof(F) N.
TEST(FiniteStatics, FollowerPressureOnAllSidesMPI)
{
  const auto model                 = jointed_box(2,
                                 material_law("St. Venant-Kirchhoff"),
                                 PlaneState::plane_strain);
  model->problem.materials[1]      = model->problem.materials[0];
  model->problem.materials[1].name = "soil";
  const PlaneElasticity e =
    model->problem.materials[0].plane_elasticity(PlaneState::plane_strain);
  const double p                     = 150.;
  const double lambda                = std::sqrt(1. - p / (e.lambda + e.mu));
  model->problem.boundary_conditions = {
    condition(Type::normal_displacement, "left"),
    condition(Type::normal_displacement, "bottom"),
    condition(Type::follower_pressure, "top", constant(p)),
    condition(Type::follower_pressure, "right", constant(p))};
  const auto elasticity = finite_elasticity(*model);
  EXPECT_FALSE(elasticity->tangent_is_symmetric());
  NonlinearStatics statics(*elasticity);
  statics.run(LoadSteps::equal(1));
  EXPECT_LT(displacement_error(*model,
                               statics.solution(),
                               [=](const Point<2> &x) {
                                 return (lambda - 1.) * Tensor<1, 2>(x);
                               }),
            1e-9);
}


// Linear statics, and load steps with small displacements, are one theory, also under an initial
// stress of a tenth of Young's modulus, whose geometric stiffness would change the displacements by
// about as much. The tolerance is that of Newton's method.
TEST(FiniteStatics, SmallDisplacementsAreOneTheoryMPI)
{
  const auto model =
    jointed_box(2, default_material_law(), PlaneState::plane_strain);
  for (Material &m : model->problem.materials)
  {
    m.initial_stress[0][0] = -0.1 * m.youngs_modulus;
    m.initial_stress[1][1] = -0.03 * m.youngs_modulus;
    m.initial_stress[0][1] = 0.02 * m.youngs_modulus;
  }
  model->problem.gravity             = Tensor<1, 2>({0., -1.});
  model->problem.boundary_conditions = {
    condition(Type::displacement, "left", vector_function([](auto &x) {
                return Tensor<1, 2>({0.01 * x[1], 0.});
              })),
    condition(Type::follower_pressure, "top", constant(1.)),
    condition(Type::pressure, "right", constant(2.))};
  model->solve();
  const auto       elasticity = finite_elasticity(*model);
  const auto       solid = make_solid_at_rest(*elasticity, Kinematics::small);
  NonlinearStatics statics(*solid);
  statics.run(LoadSteps::equal(1));
  EXPECT_LT(relative_difference(statics.solution(), model->system->solution()),
            1e-8);
  // the residual element by element, which does not use the matrix
  elasticity->assemble_linearized(model->system->solution(), 1.);
  EXPECT_LT(elasticity->residual().l2_norm(), 1e-9 * elasticity->force_scale());
}


// At small loads all kinematics agree, to the order of the strain.
TEST(FiniteStatics, SmallLoadsMPI)
{
  for (const std::shared_ptr<const MaterialLaw> &law :
       {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
  {
    const auto   model     = jointed_box(2, law, PlaneState::plane_strain);
    const double size      = 1e-6;
    model->problem.gravity = Tensor<1, 2>({0., -size});
    model->problem.boundary_conditions = {
      condition(Type::displacement, "left", vector_function([=](auto &x) {
                  return Tensor<1, 2>({size * 1e-3 * x[1], 0.});
                })),
      condition(Type::follower_pressure, "top", constant(size)),
      condition(Type::pressure, "right", constant(2. * size))};
    model->solve();
    const auto       elasticity = finite_elasticity(*model);
    NonlinearStatics statics(*elasticity);
    const auto       report = statics.run(LoadSteps::equal(1));
    EXPECT_LE(report[0].newton.iterations.size(), 2u);
    EXPECT_LT(relative_difference(statics.solution(),
                                  model->system->solution()),
              1e-6);
  }
}


TEST(FiniteStatics, CantileverAgainstReference)
{
  for (const bool follower : {false, true})
  {
    SCOPED_TRACE(follower ? "follower" : "dead");
    const auto model    = cantilever(follower, 0.33);
    const auto expected = reference(follower ? "follower" : "dead");
    ASSERT_EQ(expected.size(), 5u);
    const auto       elasticity = finite_elasticity(*model);
    NonlinearStatics statics(*elasticity);
    unsigned int     n_iterations = 0, n_steps = 0;
    statics.run(LoadSteps::equal(5),
                [&](const LoadStep &step, const Vector &u) {
                  const auto it =
                    expected.lower_bound(10. * step.load_factor - 1e-6);
                  // 1,100 unknowns; corners singular
                  EXPECT_NEAR(tip_deflection(*model, u) / it->second, 1., 6e-4);
                  n_iterations += step.n_iterations;
                  ++n_steps;
                });
    EXPECT_EQ(n_steps, 5u);
    // 20 measured
    EXPECT_LE(n_iterations, 25u);
  }
}


// The answer does not depend on how the load was put on, nor on how Newton's
// method was helped.
TEST(FiniteStatics, IndependentOfLoadSteps)
{
  for (const bool follower : {false, true})
  {
    const auto model = cantilever(follower, 0.5);
    const auto solve = [&](const LoadSteps        &steps,
                           const NewtonParameters &parameters = {}) {
      const auto       elasticity = finite_elasticity(*model);
      NonlinearStatics statics(*elasticity, parameters);
      statics.run(steps);
      EXPECT_EQ(statics.load_factor(), 1.);
      return statics.solution();
    };
    const Vector expected = solve(LoadSteps::equal(5));
    EXPECT_LT(relative_difference(solve(LoadSteps::equal(1)), expected), 1e-8);
    EXPECT_LT(relative_difference(solve(LoadSteps::equal(17)), expected), 1e-8);
    LoadSteps steps            = LoadSteps::equal(6);
    steps.extrapolation_degree = 2;
    NewtonParameters plain;
    plain.use_increment = false;
    EXPECT_LT(relative_difference(solve(steps, plain), expected), 1e-8);
    // four iterations do not suffice for one step: it is divided
    NewtonParameters few;
    few.max_iterations = 4;
    EXPECT_LT(relative_difference(solve(LoadSteps::equal(1), few), expected),
              1e-8);
  }
}


TEST(FiniteStatics, FailureSaysWhereAndWhyMPI)
{
  const auto       model      = cantilever(false, 0.7);
  const auto       elasticity = finite_elasticity(*model);
  NewtonParameters few;
  few.max_iterations = 2;
  NonlinearStatics statics(*elasticity, few);
  LoadSteps        steps = LoadSteps::equal(1);
  steps.min_step         = 0.2;
  try
  {
    statics.run(steps);
    FAIL() << "no exception";
  }
  catch (const NumericalFailure &failure)
  {
    const std::string message = failure.message();
    EXPECT_NE(message.find("load factor 0.2, after 0"), std::string::npos)
      << message;
    EXPECT_NE(message.find("no convergence in 2 iterations"), std::string::npos)
      << message;
    EXPECT_NE(message.find("residuals"), std::string::npos) << message;
  }
  EXPECT_EQ(statics.load_factor(), 0.);

  steps.load_factors = {0.5, 0.5};
  EXPECT_THROW(statics.run(steps), InputError);
}


// Plain Newton steps of this size can end where the left side is torn off by
// most of an element: a stationary point of Nitsche's potential but no solution.
// With the bound on the jump the answer does not depend on the way; with one
// that no solution meets, every step is refused.
TEST(FiniteStatics, SolutionsThatMissConditionsAreRefusedMPI)
{
  const auto model                   = jointed_box(2,
                                 material_law("St. Venant-Kirchhoff"),
                                 PlaneState::plane_stress);
  model->problem.gravity             = Tensor<1, 2>({0., -5.});
  model->problem.boundary_conditions = {condition(Type::displacement, "left"),
                                        condition(Type::follower_pressure,
                                                  "right",
                                                  constant(-50.))};
  const auto solve = [&](const double max_jump, const bool use_increment) {
    NewtonParameters parameters;
    parameters.use_increment    = use_increment;
    parameters.max_iterations   = 25;
    LoadSteps steps             = LoadSteps::equal(2);
    steps.max_jump              = max_jump;
    const auto       elasticity = finite_elasticity(*model);
    NonlinearStatics statics(*elasticity, parameters);
    statics.run(steps);
    return elasticity->energies().strain;
  };
  const double expected = solve(0.5, true);
  EXPECT_NEAR(solve(0.5, false), expected, 1e-8 * expected);
  EXPECT_THROW(solve(1e-12, true), NumericalFailure);
}


// A neo-Hookean block pushed by 30 % of its height at once, its soft half by
// more: steps are divided where an element would be turned inside out. (At 50 %
// the folds at the corners stop Newton's method on some meshes.)
TEST(FiniteStatics, StrongCompressionMPI)
{
  const auto model =
    jointed_box(2, material_law("neo-Hookean"), PlaneState::plane_strain);
  model->problem.boundary_conditions = {
    condition(Type::displacement, "bottom"),
    condition(Type::displacement, "top", vector_function([](auto &) {
                return Tensor<1, 2>({0.1, -0.3});
              }))};
  const auto       elasticity = finite_elasticity(*model);
  NonlinearStatics statics(*elasticity);
  const auto       report = statics.run(LoadSteps::equal(1));
  EXPECT_TRUE(report.back().is_asked);
  EXPECT_LT(report.back().newton.relative_residual, 1e-9);
  // three times the energy of small strains would be wrong
  EXPECT_GT(elasticity->energies().strain, 0.);
}


TEST(FiniteStatics, RanksAgreeMPI)
{
  const auto run = [](const MPI_Comm communicator) {
    const auto model                   = jointed_box(2,
                                   material_law("neo-Hookean"),
                                   PlaneState::plane_stress,
                                   0.22,
                                   communicator);
    model->problem.gravity             = Tensor<1, 2>({0., -20.});
    model->problem.boundary_conditions = {condition(Type::displacement, "left"),
                                          condition(Type::follower_pressure,
                                                    "right",
                                                    constant(-20.))};
    const auto              elasticity = finite_elasticity(*model);
    NonlinearStatics        statics(*elasticity);
    const auto              report = statics.run(LoadSteps::equal(2));
    const DisplacementField field(model->covers,
                                  model->problem,
                                  statics.solution());
    // by position: cover numbers depend on the ranks
    std::map<std::pair<long, long>, Tensor<1, 2>> values;
    const auto [first, last] = model->covers.locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      const Point<2> x =
        model->mathematical_mesh.reference_to_real(model->manifold_mesh.cell(e),
                                                   {1. / 3., 1. / 3.});
      values[{std::lround(1e6 * x[0]),
              2 * std::lround(1e6 * x[1]) +
                1000000000L * model->manifold_mesh.region(e)}] =
        field.displacement(e, {1. / 3., 1. / 3.});
    }
    return std::make_pair(values, report.back().newton.iterations.size());
  };
  const auto   serial = run(MPI_COMM_SELF), parallel = run(MPI_COMM_WORLD);
  unsigned int n = 0;
  for (const auto &[where, value] : parallel.first)
  {
    const auto it = serial.first.find(where);
    ASSERT_NE(it, serial.first.end());
    // rounding times the condition number; Newton's tolerance is met by far
    EXPECT_LT((value - it->second).norm(), 1e-9);
    ++n;
  }
  EXPECT_GT(n, 10u);
  EXPECT_EQ(serial.second, parallel.second);
}
