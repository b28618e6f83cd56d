// The preconditioner of conjugate gradients: what it is made of, that it is symmetric and
// positive definite, and steps that depend neither on the mesh nor on how it is cut.

#include <Epetra_Vector.h>
#include <gtest/gtest.h>
#include <linear_algebra/two_level_preconditioner.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /// A disk in a box, tied to it and much softer, and a closed joint through both.
  std::unique_ptr<Model>
  disk_in_box(const double        cell_size,
              const Stabilization stabilization,
              const Tensor<1, 2> &offset,
              const double        rotation)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    geometry.add_circle({0.7, 0.5}, 0.31, "disk", CurveRole::interface);
    geometry.add_polyline({{-0.1, 0.41}, {2.1, 0.67}},
                          "joint",
                          CurveRole::joint,
                          JointState::closed);
    for (const double y : {0.1, 0.95})
      geometry.add_material_point({0.1, y}, "rock");
    for (const double y : {0.3, 0.7})
      geometry.add_material_point({0.7, y}, "soil");
    auto model =
      std::make_unique<Model>(std::move(geometry),
                              mesh_parameters(cell_size, offset, rotation),
                              2,
                              stabilization);
    model->problem.materials           = {material("rock", 1000., 0.2, 2.),
                                          material("soil", 20., 0.35, 1.)};
    model->problem.gravity             = Tensor<1, 2>({0., -1.});
    model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom"),
      condition(BoundaryCondition::Type::normal_displacement, "left")};
    model->system =
      std::make_unique<StaticElasticity>(model->covers,
                                         *model->quadrature,
                                         model->constraints,
                                         model->problem,
                                         model->ghost_penalty.get());
    model->system->assemble();
    return model;
  }


  /// Numbers in [-1, 1] that do not depend on the number of ranks.
  Vector
  some_vector(const Model &model, const unsigned int seed)
  {
    Vector result(model.covers.locally_owned_dofs(2),
                  model.covers.communicator());
    for (const auto i : model.covers.locally_owned_dofs(2))
      result[i] = std::sin(1.7 * i * (seed + 1) + seed);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }
} // namespace


// First order within second order: a linear function is one on both, and energies are
// equal.
TEST(Iterative, FirstOrderWithinSecondOrderMPI)
{
  const auto                   model  = disk_in_box(0.13,
                                 Stabilization::aggregation,
                                 Tensor<1, 2>({0.03, 0.01}),
                                 11.);
  const auto                  &matrix = model->system->system_matrix();
  const internal::LinearCovers linear_covers(matrix.trilinos_matrix(),
                                             model->covers,
                                             model->constraints);
  const Epetra_CrsMatrix      &P         = linear_covers.interpolation();
  const auto                  &of_linear = linear_covers.covers_of_unknowns();
  ASSERT_GT(P.NumGlobalCols(), static_cast<int>(matrix.m() / 6));
  ASSERT_LT(P.NumGlobalCols(), static_cast<int>(matrix.m() / 2));

  // u = (1 + 2x - y, 3 - x + 4y)
  const auto linear = [](const Point<2> &x, const unsigned int c) {
    return c == 0 ? 1. + 2. * x[0] - x[1] : 3. - x[0] + 4. * x[1];
  };
  Epetra_Vector v(P.DomainMap()), u(P.RangeMap());
  ASSERT_EQ(v.MyLength(), static_cast<int>(2 * of_linear.size()));
  for (int i = 0; i < v.MyLength(); ++i)
    v[i] = linear(model->covers.node(of_linear[i / 2]), i % 2);
  P.Multiply(false, v, u);
  unsigned int i = 0, n_constrained = 0;
  for (const auto dof : model->covers.locally_owned_dofs(2))
  {
    const bool is_constrained = model->constraints.is_constrained(dof);
    n_constrained += is_constrained ? 1 : 0;
    const double expected =
      is_constrained ? 0. : linear(model->covers.node(dof / 2), dof % 2);
    // rounding of numbers up to 10
    EXPECT_NEAR(u[i++], expected, 1e-13) << dof;
  }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_constrained, MPI_COMM_WORLD), 20u);

  // v P^T A P v = u A u, of functions without meaning
  for (int j = 0; j < v.MyLength(); ++j)
    v[j] = std::sin(3.1 * v.Map().GID(j));
  P.Multiply(false, v, u);
  Vector fine(model->covers.locally_owned_dofs(2), MPI_COMM_WORLD),
    product(fine);
  std::copy(u.Values(), u.Values() + u.MyLength(), fine.begin());
  matrix.vmult(product, fine);
  const auto coarse_matrix = linear_covers.multiply(matrix.trilinos_matrix());
  ASSERT_TRUE(coarse_matrix->RowMap().SameAs(P.DomainMap()));
  Epetra_Vector coarse_product(P.DomainMap());
  double        energy = 0.;
  coarse_matrix->Multiply(false, v, coarse_product);
  coarse_product.Dot(v, &energy);
  EXPECT_NEAR(energy, fine * product, 1e-12 * std::abs(energy));
}


TEST(Iterative, PreconditionerIsSymmetricAndPositiveMPI)
{
  for (const Stabilization stabilization : {Stabilization::aggregation,
                                            Stabilization::ghost_penalty,
                                            Stabilization::none})
  {
    SCOPED_TRACE(static_cast<int>(stabilization));
    const auto model =
      disk_in_box(0.13, stabilization, Tensor<1, 2>({0.03, 0.01}), 11.);
    const internal::TwoLevelPreconditioner preconditioner(
      model->system->system_matrix(), model->covers, model->constraints);
    for (unsigned int seed = 0; seed < 5; ++seed)
    {
      const Vector x = some_vector(*model, 2 * seed),
                   y = some_vector(*model, 2 * seed + 1);
      Vector px(x), py(y);
      preconditioner.vmult(px, x);
      preconditioner.vmult(py, y);
      const double xx = px * x, yy = py * y;
      EXPECT_GT(xx, 0.);
      EXPECT_GT(yy, 0.);
      // single precision, 6e-8, times the condition number of patches, up to 1e5
      EXPECT_NEAR(px * y, py * x, 1e-2 * std::sqrt(xx * yy));
    }
  }
}


// Places of the mesh at random, three sizes. Smoothed aggregation of the matrix of second order
// takes 40 to 76 steps here. On several ranks, which have a joint along their common
// side here, each solves its part of the cut elements that they share.
TEST(Iterative, StepsDependOnNeitherMeshNorCutsMPI)
{
  const unsigned int                     seed = 20261122;
  std::mt19937                           generator(seed);
  std::uniform_real_distribution<double> uniform(0., 1.);
  LinearSolverParameters                 parameters;
  parameters.type            = LinearSolverParameters::Type::iterative;
  unsigned int       largest = 0;
  const unsigned int allowed =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 ? 45 : 80;
  for (const double cell_size : {0.12, 0.06, 0.03})
    for (unsigned int place = 0; place < 4; ++place)
      for (const Stabilization stabilization :
           {Stabilization::aggregation, Stabilization::ghost_penalty})
      {
        const Tensor<1, 2> offset(
          {cell_size * uniform(generator), cell_size * uniform(generator)});
        const double rotation = 60. * uniform(generator);
        const auto   model =
          disk_in_box(cell_size, stabilization, offset, rotation);
        const LinearSolverReport report = model->system->solve(parameters);
        largest = std::max(largest, report.n_iterations);
        EXPECT_LT(report.relative_residual, 1e-10);
        EXPECT_LE(report.n_iterations, allowed)
          << "seed " << seed << ", cell size " << cell_size << ", place "
          << place << ", ghost penalty "
          << (stabilization == Stabilization::ghost_penalty);
      }
  RecordProperty("largest", largest);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "at most " << largest << " steps" << std::endl;
}
