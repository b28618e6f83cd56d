// Ghost penalty, mass matrix and condition number against closed solutions and
// dense linear algebra.

#include <nmm/linear_algebra/condition_number.h>
#include <nmm/mechanics/mass_matrix.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr Stabilization all[] = {Stabilization::aggregation,
                                   Stabilization::ghost_penalty,
                                   Stabilization::none};

  /// A disk with a joint across, on a mesh of @p cell_size at a general place.
  Model
  disk(const double        cell_size,
       const Stabilization stabilization,
       const MPI_Comm      communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    geometry.add_circle({0.3, -0.2}, 1., "rim", CurveRole::boundary);
    geometry.add_polyline({{-1., 0.1}, {1.5, 0.2}},
                          "joint",
                          CurveRole::joint,
                          JointState::closed);
    return Model(std::move(geometry),
                 mesh_parameters(cell_size, Tensor<1, 2>({0.07, 0.02}), 17.),
                 2,
                 stabilization,
                 communicator);
  }


  /// The displacement @p u as a vector of unknowns, constraints kept.
  dealii::TrilinosWrappers::MPI::Vector
  interpolate_unknowns(const Model &model,
                       const std::function<Tensor<1, 2>(const Point<2> &)> &u)
  {
    dealii::TrilinosWrappers::MPI::Vector result(
      model.covers.locally_owned_dofs(2), model.covers.communicator());
    for (const auto k : model.covers.locally_owned_covers())
      for (unsigned int c = 0; c < 2; ++c)
        if (!model.constraints.is_constrained(2 * k + c))
          result[2 * k + c] = u(model.covers.node(k))[c];
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  double
  quadratic_form(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                 const dealii::TrilinosWrappers::MPI::Vector  &x)
  {
    dealii::TrilinosWrappers::MPI::Vector y(x);
    matrix.vmult(y, x);
    return x * y;
  }
} // namespace


// Twice the kinetic energies of a translation and of a rotation: mass, and the
// moment of inertia of a disk, rho pi r^4 / 2 + m d^2. Rigid motions lie in the
// space, and ghost penalties do not see them.
TEST(Stabilization, MassOfRigidMotionsMPI)
{
  for (const Stabilization stabilization : all)
  {
    SCOPED_TRACE(static_cast<int>(stabilization));
    Model model             = disk(0.31, stabilization);
    model.problem.materials = {material("rock", 1000., 0.3, 2.5)};
    dealii::TrilinosWrappers::SparseMatrix mass;
    assemble_mass_matrix(model.covers,
                         *model.quadrature,
                         model.constraints,
                         model.problem,
                         model.ghost_penalty.get(),
                         mass);
    const double m = 2.5 * dealii::numbers::PI;
    EXPECT_NEAR(
      quadratic_form(mass,
                     interpolate_unknowns(model,
                                          [](const Point<2> &) {
                                            return Tensor<1, 2>({1., 0.});
                                          })),
      m,
      1e-12 * m);
    const double inertia = 0.5 * m + m * (0.3 * 0.3 + 0.2 * 0.2);
    EXPECT_NEAR(
      quadratic_form(mass,
                     interpolate_unknowns(model,
                                          [](const Point<2> &x) {
                                            return Tensor<1, 2>({-x[1], x[0]});
                                          })),
      inertia,
      1e-12 * inertia);
  }
}


// Quadratics are exact with the ghost penalty, too; without a factor the terms
// would still be consistent, so a second check: with it, the solution of a
// problem outside the space differs from that without.
TEST(Stabilization, GhostPenaltyKeepsQuadraticsMPI)
{
  std::mt19937         generator(11);
  const QuadraticField exact = random_field(generator, 2);
  for (const Stabilization stabilization : all)
  {
    SCOPED_TRACE(static_cast<int>(stabilization));
    Model model             = disk(0.31, stabilization);
    model.problem.materials = {material("rock", 1000., 0.3)};
    const PlaneElasticity e =
      model.problem.materials[0].plane_elasticity(PlaneState::plane_stress);
    const Tensor<1, 2> f     = exact.body_force(e);
    model.problem.body_force = vector_function([f](const auto &) { return f; });
    model.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement,
                "rim",
                vector_function([&exact](const Point<2> &x) {
                  return exact.displacement(x);
                }))};
    model.solve();
    const ErrorNorms errors = compute_errors(
      *model.field,
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) { return e.stress(exact.gradient(x)); });
    // unstabilized: slivers of 1e-4 of a cell cost digits
    const double tolerance =
      stabilization == Stabilization::none ? 1e-7 : 2e-10;
    EXPECT_LT(errors.displacement, tolerance);
    if (stabilization == Stabilization::ghost_penalty)
    {
      ASSERT_FALSE(model.ghost_penalty->pairs.empty());
      // the terms are there: a matrix without them differs
      const double     with = model.system->system_matrix().frobenius_norm();
      StaticElasticity plain(model.covers,
                             *model.quadrature,
                             model.constraints,
                             model.problem);
      plain.assemble();
      EXPECT_GT(std::abs(with / plain.system_matrix().frobenius_norm() - 1.),
                1e-6);
    }
  }
}


// Against all eigenvalues of the scaled matrix by dense linear algebra; the
// estimate's own tolerance is 1 %.
TEST(Stabilization, ConditionNumberIsSharp)
{
  for (const Stabilization stabilization : all)
  {
    SCOPED_TRACE(static_cast<int>(stabilization));
    Model model                       = disk(0.6, stabilization, MPI_COMM_SELF);
    model.problem.materials           = {material("rock", 1000., 0.3, 1.)};
    model.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "rim")};
    model.solve();
    const auto           &matrix = model.system->system_matrix();
    const ConditionNumber estimate =
      estimate_condition_number(matrix, model.covers, model.constraints, 1e-3);

    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < matrix.m(); ++i)
      if (!model.constraints.is_constrained(i))
        free.push_back(i);
    Eigen::MatrixXd scaled(free.size(), free.size());
    for (unsigned int i = 0; i < free.size(); ++i)
      for (unsigned int j = 0; j < free.size(); ++j)
        scaled(i, j) =
          matrix.el(free[i], free[j]) / std::sqrt(matrix.diag_element(free[i]) *
                                                  matrix.diag_element(free[j]));
    const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled,
                                                     Eigen::EigenvaluesOnly)
        .eigenvalues();
    EXPECT_NEAR(estimate.largest / eigenvalues(free.size() - 1), 1., 2e-3);
    EXPECT_NEAR(estimate.smallest / eigenvalues(0), 1., 2e-3);
  }
}


// The same start vector and so the same steps on any number of ranks.
TEST(Stabilization, ConditionNumberOnRanksMPI)
{
  ConditionNumber estimates[2];
  unsigned int    i = 0;
  for (const MPI_Comm communicator : {MPI_COMM_SELF, MPI_COMM_WORLD})
  {
    Model model = disk(0.21, Stabilization::ghost_penalty, communicator);
    model.problem.materials           = {material("rock", 1000., 0.3, 1.)};
    model.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "rim")};
    model.solve();
    estimates[i++] = estimate_condition_number(model.system->system_matrix(),
                                               model.covers,
                                               model.constraints);
  }
  // covers are numbered by rank, so the start differs; both are within 1 %
  EXPECT_NEAR(estimates[0].value() / estimates[1].value(), 1., 0.02);
}


// The weakest place is where the sliver is: right of x = 1 by 1e-4 of a cell.
TEST(Stabilization, WeakestPlaceIsTheSliver)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1.00002, 1.});
  RegularMeshParameters mesh;
  mesh.cell_size = 0.2;
  mesh.pattern   = MeshPattern::right_angled;
  mesh.offset    = Tensor<1, 2>({-0.50001, -0.5});
  Model model(std::move(geometry), mesh, 2, Stabilization::none, MPI_COMM_SELF);
  model.problem.materials           = {material()};
  model.problem.boundary_conditions = {
    condition(BoundaryCondition::Type::displacement, "left")};
  model.solve();
  const ConditionNumber estimate =
    estimate_condition_number(model.system->system_matrix(),
                              model.covers,
                              model.constraints);
  EXPECT_GT(estimate.value(), 1e8);
  ASSERT_NE(estimate.weakest_cover, invalid_index);
  EXPECT_GT(model.covers.node(estimate.weakest_cover)[0], 0.99);
}
