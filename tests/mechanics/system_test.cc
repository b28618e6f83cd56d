// The linear system: symmetry, solvers, ranks, and problems without a solution.

#include <gtest/gtest.h>
#include <linear_algebra/direct_solver.h>
#include <mechanics/model.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A box with a crack, a closed joint and an interface, two materials.
  std::unique_ptr<Model>
  loaded_jointed_box(const MPI_Comm communicator)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    geometry.add_polyline({{0.3, 0.2}, {0.7, 0.8}}, "crack", CurveRole::joint);
    geometry.add_polyline({{1.1, -0.1}, {1.25, 1.1}},
                          "tied",
                          CurveRole::joint,
                          JointState::closed);
    geometry.add_polyline({{-0.1, 0.55}, {2.1, 0.45}},
                          "layer",
                          CurveRole::interface);
    geometry.add_material_point({0.1, 0.1}, "rock");
    geometry.add_material_point({0.1, 0.9}, "soil");
    geometry.add_material_point({1.9, 0.1}, "rock");
    geometry.add_material_point({1.9, 0.9}, "soil");
    auto model               = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.09, {}, 9.),
                                         2,
                                         Stabilization::aggregation,
                                         communicator);
    model->problem.materials = {material("rock", 1000., 0.2, 2.),
                                material("soil", 50., 0.35, 1.)};
    model->problem.gravity   = Tensor<1, 2>({0., -1.});
    model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom"),
      condition(normal_displacement, "left"),
      condition(BoundaryCondition::Type::traction,
                "right",
                vector_function([](const Point<2> &x) {
                  return Tensor<1, 2>({std::sin(3. * x[1]), 0.5});
                }))};
    return model;
  }
} // namespace


TEST(System, IsSymmetric)
{
  const auto model = loaded_jointed_box(MPI_COMM_WORLD);
  model->solve();
  const auto &matrix  = model->system->system_matrix();
  double      largest = 0., difference = 0.;
  for (const auto &entry : matrix)
  {
    largest    = std::max(largest, std::abs(entry.value()));
    difference = std::max(difference,
                          std::abs(entry.value() -
                                   matrix.el(entry.column(), entry.row())));
  }
  EXPECT_GT(largest, 0.);
  EXPECT_LT(difference, 1e-13 * largest);
}


// A further constraint, on one component and with a value: that of the exact
// solution, which must stay exact.
TEST(System, InhomogeneousConstraintMPI)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 1.});
  Model      model(std::move(geometry), mesh_parameters(0.2, {}, 8.), 2);
  const auto exact = [](const Point<2> &x) {
    return Tensor<1, 2>({0.1 + 0.02 * x[1], 0.3 - 0.05 * x[0] + 0.01 * x[1]});
  };
  // of the element in the middle, which no aggregation touches
  const unsigned int cover =
    model.covers.covers(model.manifold_mesh.find_element({0.5, 0.5}))[3];
  dealii::AffineConstraints<double> further(
    model.covers.locally_relevant_dofs(2));
  if (model.covers.locally_relevant_covers().is_element(cover))
  {
    further.add_line(2 * cover + 1);
    further.set_inhomogeneity(2 * cover + 1,
                              exact(model.covers.node(cover))[1]);
  }
  further.close();
  model.constraints.merge(further);

  model.problem.materials           = {material()};
  model.problem.boundary_conditions = {
    condition(BoundaryCondition::Type::displacement,
              "left",
              vector_function(exact)),
    condition(BoundaryCondition::Type::displacement,
              "right",
              vector_function(exact)),
    condition(BoundaryCondition::Type::displacement,
              "bottom",
              vector_function(exact)),
    condition(BoundaryCondition::Type::displacement,
              "top",
              vector_function(exact))};
  model.solve();
  const PlaneElasticity e =
    model.problem.materials[0].plane_elasticity(PlaneState::plane_stress);
  const ErrorNorms errors =
    compute_errors(*model.field, exact, [&](const Point<2> &) {
      Tensor<2, 2> g;
      g[0][1] = 0.02;
      g[1][0] = -0.05;
      g[1][1] = 0.01;
      return e.stress(g);
    });
  EXPECT_LT(errors.displacement, 1e-10);
  EXPECT_LT(errors.stress, 1e-8);
}


TEST(System, RanksAgreeMPI)
{
  const auto parallel = loaded_jointed_box(MPI_COMM_WORLD);
  const auto serial   = loaded_jointed_box(MPI_COMM_SELF);
  parallel->solve();
  serial->solve();

  // covers are numbered alike
  ASSERT_EQ(parallel->covers.n_covers(), serial->covers.n_covers());
  const auto &A       = parallel->system->system_matrix();
  const auto &B       = serial->system->system_matrix();
  double      largest = 0., difference = 0.;
  for (const unsigned int row : parallel->covers.locally_owned_dofs(2))
  {
    EXPECT_EQ(A.row_length(row), B.row_length(row));
    for (auto entry = B.begin(row); entry != B.end(row); ++entry)
    {
      largest = std::max(largest, std::abs(entry->value()));
      difference =
        std::max(difference,
                 std::abs(entry->value() - A.el(row, entry->column())));
    }
  }
  EXPECT_LT(difference, 1e-12 * largest);

  double largest_u = 0., difference_u = 0.;
  for (const unsigned int k : parallel->covers.locally_relevant_covers())
  {
    largest_u    = std::max(largest_u, serial->field->nodal_value(k).norm());
    difference_u = std::max(
      difference_u,
      (serial->field->nodal_value(k) - parallel->field->nodal_value(k)).norm());
  }
  // rounding of the matrix times its condition number
  EXPECT_LT(difference_u, 1e-10 * largest_u);

  // the recovered stress too
  const StressRecovery recovered(*parallel->field, parallel->aggregation),
    expected(*serial->field, serial->aggregation);
  const auto [first, last] = parallel->covers.locally_owned_elements();
  double largest_s = 0., difference_s = 0.;
  for (unsigned int e = first; e < last; ++e)
  {
    const auto s = expected.stress(e, {0.3, 0.3});
    largest_s    = std::max(largest_s, s.norm());
    difference_s =
      std::max(difference_s, (recovered.stress(e, {0.3, 0.3}) - s).norm());
  }
  EXPECT_LT(difference_s, 1e-9 * largest_s);
}


TEST(System, DirectAndIterativeAgreeMPI)
{
  const auto             model = loaded_jointed_box(MPI_COMM_WORLD);
  LinearSolverParameters parameters;
  parameters.type                 = LinearSolverParameters::Type::direct;
  const LinearSolverReport direct = model->solve(parameters);
  EXPECT_TRUE(direct.direct);
  EXPECT_LT(direct.relative_residual, 1e-12);
  // more than the rounding of a number, less than that times a condition number of some 1e5
  EXPECT_GT(direct.rounding_effect, 2.2e-16);
  EXPECT_LT(direct.rounding_effect, 1e-10);
  std::vector<Tensor<1, 2>> expected;
  for (const unsigned int k : model->covers.locally_relevant_covers())
    expected.push_back(model->field->nodal_value(k));

  parameters.type                    = LinearSolverParameters::Type::iterative;
  const LinearSolverReport iterative = model->solve(parameters);
  EXPECT_FALSE(iterative.direct);
  EXPECT_GT(iterative.n_iterations, 0u);
  EXPECT_LT(iterative.relative_residual, 1e-10);
  double       largest = 0., difference = 0.;
  unsigned int i = 0;
  for (const unsigned int k : model->covers.locally_relevant_covers())
  {
    largest = std::max(largest, expected[i].norm());
    difference =
      std::max(difference, (model->field->nodal_value(k) - expected[i]).norm());
    ++i;
  }
  // residual 1e-11 times the condition number that is left
  EXPECT_LT(maximum_over_ranks(difference), 1e-7 * maximum_over_ranks(largest));
}


// The cautious estimate is larger than the effect of products that are each wrong by their rounding,
// since it has the largest displacement everywhere and counts loads as a second sum of products;
// but not 20 times as large, where most displacements are above a fifth of the largest.
TEST(System, RoundingEffectIsCautious)
{
  const auto             model    = loaded_jointed_box(MPI_COMM_WORLD);
  const double           cautious = model->solve().rounding_effect;
  const auto            &matrix   = model->system->system_matrix();
  const auto            &rhs      = model->system->system_rhs();
  internal::DirectSolver solver;
  solver.factorize(matrix);
  auto x = rhs, rounding = rhs;
  solver.solve(rhs, x);
  std::mt19937                generator(7);
  std::bernoulli_distribution is_positive;
  for (unsigned int i = 0; i < matrix.m(); ++i)
  {
    double sum = std::abs(rhs(i));
    for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
      sum += std::abs(entry->value() * x(entry->column()));
    rounding(i) = (is_positive(generator) ? 2.2e-16 : -2.2e-16) * sum;
  }
  solver.solve(rounding, rounding);
  const double effect = rounding.l2_norm() / x.l2_norm();
  EXPECT_LT(effect, cautious);
  EXPECT_GT(effect, 0.05 * cautious);
}


TEST(System, IterationThatStopsEarlyIsReportedMPI)
{
  const auto             model = loaded_jointed_box(MPI_COMM_WORLD);
  LinearSolverParameters parameters;
  parameters.type           = LinearSolverParameters::Type::iterative;
  parameters.max_iterations = 2;
  try
  {
    model->solve(parameters);
    FAIL() << "no exception";
  }
  catch (const NumericalFailure &failure)
  {
    EXPECT_NE(failure.message().find("2 iterations"), std::string::npos)
      << failure.message();
  }
}


// Above the limit the automatic choice is iterative; what does not converge is solved
// directly after all.
TEST(System, AutomaticSolverMPI)
{
  const auto             model = loaded_jointed_box(MPI_COMM_WORLD);
  LinearSolverParameters parameters;
  LinearSolverReport     report = model->solve(parameters);
  EXPECT_TRUE(report.direct);
  EXPECT_EQ(report.n_iterations, 0u);

  parameters.direct_limit = model->covers.n_covers();
  report                  = model->solve(parameters);
  EXPECT_FALSE(report.direct);
  EXPECT_GT(report.n_iterations, 0u);

  parameters.max_iterations = 2;
  report                    = model->solve(parameters);
  EXPECT_TRUE(report.direct);
  EXPECT_EQ(report.n_iterations, 2u);
  // as in DirectAndIterativeAgreeMPI: rounding
  EXPECT_LT(report.relative_residual, 1e-12);
  // Unknowns count, and covers that are aggregated have none.
  unsigned int n_unknowns = 0;
  for (const auto i : model->covers.locally_owned_dofs(2))
    n_unknowns += !model->constraints.is_constrained(i);
  n_unknowns = dealii::Utilities::MPI::sum(n_unknowns, MPI_COMM_WORLD);
  ASSERT_LT(n_unknowns, 2 * model->covers.n_covers());
  parameters.direct_limit = n_unknowns;
  EXPECT_EQ(model->solve(parameters).n_iterations, 0u);
  parameters.direct_limit = n_unknowns - 1;
  EXPECT_EQ(model->solve(parameters).n_iterations, 2u);
}


namespace
{
  std::string
  floating_message(const std::vector<BoundaryCondition> &conditions,
                   const std::vector<FixedPoint>        &fixed_points,
                   const JointState                      joint)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    geometry.add_polyline({{1.2, -0.1}, {1.3, 1.1}},
                          "split",
                          CurveRole::joint,
                          joint);
    Model model(std::move(geometry), mesh_parameters(0.2, {}, 3.), 2);
    model.problem.materials           = {material("granite")};
    model.problem.boundary_conditions = conditions;
    model.problem.fixed_points        = fixed_points;
    model.problem.gravity             = Tensor<1, 2>({0., -1.});
    try
    {
      model.solve();
    }
    catch (const NumericalFailure &failure)
    {
      return failure.message();
    }
    return "";
  }


  FixedPoint
  fixed(const Point<2> &x, const bool hold_x = true, const bool hold_y = true)
  {
    FixedPoint point;
    point.point         = x;
    point.components[0] = hold_x;
    point.components[1] = hold_y;
    return point;
  }
} // namespace


TEST(System, FloatingBlocksAreNamedMPI)
{
  using testing::AssertionFailure;
  const auto contains = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "\"" << text << "\"";
  };
  const auto clamped = condition(BoundaryCondition::Type::displacement, "left");

  // held on the left only: the right block is free unless the joint is closed
  const std::string right = floating_message({clamped}, {}, JointState::open);
  EXPECT_TRUE(contains(right, "floats freely"));
  EXPECT_TRUE(contains(right, "nothing holds it"));
  EXPECT_TRUE(contains(right, "granite"));
  EXPECT_EQ(floating_message({clamped}, {}, JointState::closed), "");

  // one fixed point leaves the rotation
  EXPECT_TRUE(
    contains(floating_message({}, {fixed({0.5, 0.4})}, JointState::closed),
             "rotate"));
  EXPECT_EQ(floating_message({},
                             {fixed({0.5, 0.4}), fixed({1.5, 0.4}, false)},
                             JointState::closed),
            "");
  // two springs along the line through them do not stop the rotation
  EXPECT_TRUE(contains(floating_message({},
                                        {fixed({0.5, 0.4}),
                                         fixed({1.5, 0.4}, true, false)},
                                        JointState::closed),
                       "rotate"));
  // rollers
  EXPECT_TRUE(
    contains(floating_message({condition(normal_displacement, "bottom")},
                              {},
                              JointState::closed),
             "move along x"));
  EXPECT_TRUE(
    contains(floating_message({condition(normal_displacement, "left"),
                               condition(normal_displacement, "right")},
                              {},
                              JointState::closed),
             "move along y"));
}


TEST(System, RollersOnACircleLeaveTheRotation)
{
  Geometry geometry;
  geometry.add_circle({0.3, 0.2}, 1., "rim", CurveRole::boundary);
  Model model(std::move(geometry), mesh_parameters(0.3), 2);
  model.problem.materials           = {material()};
  model.problem.boundary_conditions = {condition(normal_displacement, "rim")};
  EXPECT_THROW(model.solve(), NumericalFailure);
}
