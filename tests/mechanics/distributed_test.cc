// Meshes of which each rank holds a part give what the whole mesh gives.

#include <nmm/covers/rank_cells.h>

#include <deal.II/distributed/tria_base.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>
#include <support/same_elements.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  struct Case
  {
    std::function<Geometry()>                geometry;
    RegularMeshParameters                    mesh;
    std::function<void(ElasticityProblem &)> set_problem;
  };


  std::unique_ptr<Model>
  make_model(const Case         &c,
             const unsigned int  degree,
             const Stabilization stabilization,
             const bool          is_distributed)
  {
    const MPI_Comm communicator =
      is_distributed ? MPI_COMM_WORLD : MPI_COMM_SELF;
    auto model = std::make_unique<Model>(
      c.geometry(),
      [&](const PhysicalMesh &mesh) {
        return is_distributed
                 ? make_distributed_mesh(mesh, c.mesh, degree, communicator)
                 : make_regular_mesh(mesh, c.mesh, degree);
      },
      stabilization,
      communicator);
    c.set_problem(model->problem);
    return model;
  }


  void
  expect_same(const Case         &c,
              const unsigned int  degree,
              const Stabilization stabilization)
  {
    const auto whole = make_model(c, degree, stabilization, false);
    const auto part  = make_model(c, degree, stabilization, true);
    namespace MPI    = dealii::Utilities::MPI;

    // the same cells, elements and covers, each owned once
    const auto [first, end] = part->covers.locally_owned_elements();
    EXPECT_EQ(MPI::sum(end - first, MPI_COMM_WORLD),
              whole->manifold_mesh.n_elements());
    EXPECT_EQ(part->covers.n_global_covers(), whole->covers.n_covers());
    EXPECT_EQ(part->mathematical_mesh.rank_cells()->n_global_cells,
              whole->mathematical_mesh.n_cells());
    EXPECT_EQ(part->mathematical_mesh.dof_handler().n_dofs(),
              whole->mathematical_mesh.n_mathematical_covers());
    unsigned int n_constrained = 0;
    for (const auto &[cover, root] : part->aggregation.cover_to_root)
      n_constrained += part->covers.locally_owned_covers().is_element(
        part->covers.global_cover(cover));
    EXPECT_EQ(MPI::sum(n_constrained, MPI_COMM_WORLD),
              whole->aggregation.cover_to_root.size());

    LinearSolverParameters solver;
    solver.type = LinearSolverParameters::Type::direct;
    whole->solve(solver);
    part->solve(solver);
    EXPECT_NEAR(part->system->system_matrix().frobenius_norm() /
                  whole->system->system_matrix().frobenius_norm(),
                1.,
                1e-12);

    const StressRecovery of_whole(*whole->field, whole->aggregation),
      of_part(*part->field, part->aggregation);
    double largest = 0., difference = 0., stress = 0., stress_difference = 0.;
    const Testing::SameElements same_elements(whole->manifold_mesh);
    for (unsigned int e = first; e < end; ++e)
    {
      const unsigned int same = same_elements.find(part->manifold_mesh, e);
      ASSERT_NE(same, invalid_index);
      for (const Point<2> &xi : {Point<2>(0.2, 0.3), Point<2>(0.6, 0.3)})
      {
        const Tensor<1, 2> u = whole->field->displacement(same, xi);
        largest              = std::max(largest, u.norm());
        difference =
          std::max(difference, (u - part->field->displacement(e, xi)).norm());
        const auto s = of_whole.stress(same, xi);
        stress       = std::max(stress, s.norm());
        stress_difference =
          std::max(stress_difference, (s - of_part.stress(e, xi)).norm());
      }
    }
    largest = maximum_over_ranks(largest);
    EXPECT_GT(largest, 0.);
    // the same system in another order of unknowns
    EXPECT_LT(maximum_over_ranks(difference), 1e-10 * largest);
    EXPECT_LT(maximum_over_ranks(stress_difference),
              1e-9 * maximum_over_ranks(stress));
    EXPECT_EQ(MPI::sum(of_part.n_direct(), MPI_COMM_WORLD) > 0,
              of_whole.n_direct() > 0);
  }


  Case
  ring()
  {
    Case c;
    c.geometry    = []() { return quarter_ring(1., 2.); };
    c.mesh        = mesh_parameters(0.05, Tensor<1, 2>({0.013, 0.007}), 7.);
    c.set_problem = [](ElasticityProblem &problem) {
      problem.materials           = {material()};
      problem.boundary_conditions = {
        condition(normal_displacement, "bottom"),
        condition(normal_displacement, "left"),
        condition(BoundaryCondition::Type::pressure, "inner", constant(3.))};
    };
    return c;
  }


  /// Two materials, a crack, a closed joint that ties, open ones that divide, and points.
  Case
  jointed_case()
  {
    Case c;
    c.geometry = []() {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {2., 1.});
      geometry.add_polyline({{0.3, 0.2}, {0.7, 0.8}},
                            "crack",
                            CurveRole::joint);
      geometry.add_polyline({{1.1, -0.1}, {1.25, 1.1}},
                            "tied",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_polyline({{0.95, -0.1}, {0.9, 1.1}},
                            "open",
                            CurveRole::joint);
      geometry.add_polyline({{-0.1, 0.55}, {2.1, 0.45}},
                            "layer",
                            CurveRole::interface);
      for (const double x : {0.1, 1.05, 1.9})
      {
        geometry.add_material_point({x, 0.1}, "rock");
        geometry.add_material_point({x, 0.9}, "soil");
      }
      return geometry;
    };
    c.mesh        = mesh_parameters(0.06, {}, 9.);
    c.set_problem = [](ElasticityProblem &problem) {
      problem.materials           = {material("rock", 1000., 0.2, 2.),
                                     material("soil", 50., 0.35, 1.)};
      problem.gravity             = Tensor<1, 2>({0., -1.});
      problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement,
                  "bottom",
                  vector_function([](const Point<2> &x) {
                    return Tensor<1, 2>({0.01 * x[0], 0.002 * x[0] * x[0]});
                  })),
        condition(normal_displacement, "left"),
        condition(BoundaryCondition::Type::traction,
                  "right",
                  vector_function([](const Point<2> &x) {
                    return Tensor<1, 2>({std::sin(3. * x[1]), 0.5});
                  }))};
      problem.point_forces = {{{1.03, 0.7}, Tensor<1, 2>({0.3, -0.2})}};
      FixedPoint fixed;
      fixed.point          = {1.5, 0.8};
      fixed.displacement   = Tensor<1, 2>({0.001, 0.});
      problem.fixed_points = {fixed};
    };
    return c;
  }
} // namespace


TEST(Distributed, RingMPI)
{
  for (const unsigned int degree : {1u, 2u})
    expect_same(ring(), degree, Stabilization::aggregation);
}


TEST(Distributed, RingWithGhostPenaltyMPI)
{
  expect_same(ring(), 2, Stabilization::ghost_penalty);
}


TEST(Distributed, JointsAndMaterialsMPI)
{
  expect_same(jointed_case(), 2, Stabilization::aggregation);
}


TEST(Distributed, JointsAndMaterialsWithGhostPenaltyMPI)
{
  expect_same(jointed_case(), 2, Stabilization::ghost_penalty);
}


// An open joint cuts the ring in two, of which one is held.
TEST(Distributed, FloatingBlockMPI)
{
  Case c     = ring();
  c.geometry = []() {
    Geometry geometry = quarter_ring(1., 2.);
    geometry.add_polyline({{-0.1, 1.2}, {1.9, 1.2}}, "cut", CurveRole::joint);
    return geometry;
  };
  const auto model = make_model(c, 2, Stabilization::aggregation, true);
  model->problem.boundary_conditions = {
    condition(BoundaryCondition::Type::displacement, "bottom")};
  try
  {
    model->solve();
    ADD_FAILURE() << "a block floats";
  }
  catch (const NumericalFailure &failure)
  {
    EXPECT_NE(failure.message().find("floats freely"), std::string::npos);
  }
}


// Conjugate gradients see the same matrix: as many steps, within the preconditioner's freedom.
TEST(Distributed, IterativeSolverMPI)
{
  const Case             c = ring();
  LinearSolverParameters solver;
  solver.type      = LinearSolverParameters::Type::iterative;
  const auto whole = make_model(c, 2, Stabilization::aggregation, false),
             part  = make_model(c, 2, Stabilization::aggregation, true);
  const LinearSolverReport of_whole = whole->solve(solver),
                           of_part  = part->solve(solver);
  EXPECT_NEAR(of_part.n_iterations,
              of_whole.n_iterations,
              0.2 * of_whole.n_iterations);
  EXPECT_LT(of_part.relative_residual, 1e-10);
}
