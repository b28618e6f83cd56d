// Mohr-Coulomb materials in the static equations of small displacements.

#include <nmm/materials/material_law.h>
#include <nmm/materials/mohr_coulomb_law.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/mechanics/static_elasticity.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double degrees = dealii::numbers::PI / 180.;

  std::shared_ptr<const MaterialLaw>
  mohr_coulomb(const double phi, const double c, const double psi)
  {
    auto law      = std::make_shared<MohrCoulombLaw>();
    law->friction = std::tan(phi * degrees);
    law->cohesion = c;
    law->dilation = std::tan(psi * degrees);
    return law;
  }


  /// The box with a crack and a tied joint, of one rock all over.
  std::unique_ptr<Model>
  yielding_box(const std::shared_ptr<const MaterialLaw> &law,
               const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    auto model =
      jointed_box(2, law, PlaneState::plane_strain, 0.3, communicator);
    model->problem.materials[1]      = model->problem.materials[0];
    model->problem.materials[1].name = "soil";
    return model;
  }


  NewtonParameters
  newton_parameters()
  {
    NewtonParameters newton;
    newton.max_iterations   = 25;
    newton.energy_tolerance = 1.;
    newton.always_search    = true;
    return newton;
  }


  Tensor<1, 2>
  strained(const Point<2> &x)
  {
    return Tensor<1, 2>(
      {0.004 * x[0] + 0.001 * x[1], 0.002 * x[0] - 0.006 * x[1]});
  }
} // namespace


/// A uniform strain that yields, prescribed all around: all stresses are those of the law for
/// the same path, also beside the tied joint, the interface, the crack and the boundary, where
/// Nitsche's tractions have to be those of the law.
TEST(Inelastic, UniformStrainMPI)
{
  const auto law   = mohr_coulomb(30., 1., 30.);
  auto       model = yielding_box(law);
  for (const char *side : {"bottom", "right", "top", "left"})
    model->problem.boundary_conditions.push_back(condition(
      BoundaryCondition::Type::displacement, side, vector_function(strained)));
  const auto       elasticity = finite_elasticity(*model);
  const auto       solid = make_solid_at_rest(*elasticity, Kinematics::small);
  NonlinearStatics statics(*solid, newton_parameters());
  statics.run(LoadSteps::equal(4));

  const Vector exact = interpolate(*model, strained);
  EXPECT_LT(relative_difference(statics.solution(), exact), 1e-8);

  const auto inelastic =
    model->problem.materials[0].inelastic_law(PlaneState::plane_strain);
  Tensor<2, 2> gradient;
  gradient[0][0] = 0.004;
  gradient[0][1] = 0.001;
  gradient[1][0] = 0.002;
  gradient[1][1] = -0.006;
  InelasticLaw::Response expected;
  for (unsigned int step = 1; step <= 4; ++step)
    ASSERT_TRUE(inelastic->evaluate(0.25 * step * dealii::symmetrize(gradient),
                                    MaterialState(expected.state),
                                    expected) == Deformation::admissible);
  EXPECT_FALSE(expected.is_elastic);
  const auto [first, last] = model->covers.locally_owned_elements();
  unsigned int n_points    = 0;
  for (unsigned int e = first; e < last; ++e)
    for (const InelasticTerms::PointValues &value :
         solid->inelastic_terms()->values(e))
    {
      ++n_points;
      EXPECT_LT((value.stress - expected.stress).norm(), 1e-6);
      EXPECT_NEAR(value.stress_zz, expected.stress_zz, 1e-6);
    }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_points, MPI_COMM_WORLD), 200u);
  // the whole box has yielded
  EXPECT_NEAR(solid->inelastic_terms()->totals().yielded_area, 2., 1e-10);
}


/// A column under its weight between smooth walls. Without cohesion and with a small Poisson's
/// ratio the lateral stress is the active one, sigma_h = sigma_v (1 - sin phi) / (1 + sin phi):
/// in both lateral directions, that is on an edge of the yield surface.
TEST(Inelastic, ColumnBetweenWallsMPI)
{
  constexpr double phi = 25.;
  Geometry         geometry;
  add_box(geometry, {0., 0.}, {1., 2.});
  Model model(std::move(geometry),
              mesh_parameters(0.45, {}, 9.),
              2,
              Stabilization::aggregation,
              MPI_COMM_WORLD);
  model.problem.plane_state      = PlaneState::plane_strain;
  model.problem.materials        = {material("soil", 1000., 0.1, 2.)};
  model.problem.materials[0].law = mohr_coulomb(phi, 0., 0.);
  model.problem.gravity          = Tensor<1, 2>({0., -10.});
  for (const char *side : {"bottom", "left", "right"})
    model.problem.boundary_conditions.push_back(
      condition(normal_displacement, side));
  const auto       elasticity = finite_elasticity(model);
  const auto       solid = make_solid_at_rest(*elasticity, Kinematics::small);
  NonlinearStatics statics(*solid, newton_parameters());
  statics.run(LoadSteps::equal(2));

  const double K_a =
    (1. - std::sin(phi * degrees)) / (1. + std::sin(phi * degrees));
  const ManifoldMesh &mesh = model.covers.manifold_mesh();
  const auto [first, last] = model.covers.locally_owned_elements();
  for (unsigned int e = first; e < last; ++e)
  {
    const auto  values = solid->inelastic_terms()->values(e);
    const auto &rule   = model.quadrature->rule(e);
    for (unsigned int q = 0; q < values.size(); ++q)
    {
      const double y =
        mesh.mathematical_mesh().reference_to_real(mesh.cell(e),
                                                   rule.point(q))[1];
      const double vertical = -20. * (2. - y);
      EXPECT_NEAR(values[q].stress[1][1], vertical, 1e-6);
      EXPECT_NEAR(values[q].stress[0][0], K_a * vertical, 1e-6);
      EXPECT_NEAR(values[q].stress_zz, K_a * vertical, 1e-6);
      EXPECT_NEAR(values[q].stress[0][1], 0., 1e-6);
    }
  }
}


/// An initial stress that nothing balances is released in proportion to the load factor. What has been
/// released stays so, whether loads become smaller or larger than 1. Elastic in effect, by a cohesion
/// that is far above the stress.
TEST(Inelastic, InitialStressIsReleasedOnceMPI)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 2.});
  Model model(std::move(geometry),
              mesh_parameters(0.45, {}, 9.),
              2,
              Stabilization::aggregation,
              MPI_COMM_WORLD);
  model.problem.plane_state      = PlaneState::plane_strain;
  model.problem.materials        = {material("rock", 1000., 0.1, 2.)};
  model.problem.materials[0].law = mohr_coulomb(30., 100., 0.);
  model.problem.materials[0].initial_stress[1][1] = -1.;
  for (const char *side : {"bottom", "left", "right"})
    model.problem.boundary_conditions.push_back(
      condition(normal_displacement, side));
  const auto       elasticity = finite_elasticity(model);
  const auto       solid = make_solid_at_rest(*elasticity, Kinematics::small);
  NonlinearStatics statics(*solid, newton_parameters());
  LoadSteps        steps;
  steps.load_factors       = {0.5, 1., 0.5, 2.};
  steps.leaves_out_reached = false;
  std::vector<Vector> u;
  statics.run(steps,
              [&](const LoadStep &, const Vector &now) { u.push_back(now); });
  ASSERT_EQ(u.size(), 4U);
  // u_y = y / E' with E' = E (1 - nu) / (1 + nu) / (1 - 2 nu), which expands the column again
  const Vector exact = interpolate(model, [](const Point<2> &x) {
    return Tensor<1, 2>({0., x[1] / (1000. * 0.9 / (1.1 * 0.8))});
  });
  // the tolerance of Newton's method
  EXPECT_LT(relative_difference(u[1], exact), 1e-8);
  EXPECT_LT(relative_difference(u[2], exact), 1e-8);
  EXPECT_LT(relative_difference(u[3], exact), 1e-8);
  Vector twice(exact);
  twice = u[0];
  Vector owned(model.covers.locally_owned_dofs(2), MPI_COMM_WORLD);
  owned = u[0];
  owned *= 2.;
  twice = owned;
  EXPECT_LT(relative_difference(twice, exact), 1e-8);
}


/// The derivative of all forces against central differences, ties and conditions included.
TEST(Inelastic, TangentAgainstDifferences)
{
  auto model = yielding_box(mohr_coulomb(30., 1., 10.), MPI_COMM_SELF);
  model->problem.materials[0].initial_stress[1][1] = -1.;
  model->problem.boundary_conditions.push_back(
    condition(BoundaryCondition::Type::displacement, "left"));
  const auto   elasticity = finite_elasticity(*model);
  const auto   solid      = make_solid_at_rest(*elasticity, Kinematics::small);
  StaticSystem system(*solid);
  system.set_load_factor(1.);
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> random(-1., 1.);
  const auto                             field = [&](const double size) {
    const double a = random(generator), b = random(generator);
    return interpolate(*model, [=](const Point<2> &x) {
      return size * Tensor<1, 2>({std::sin(2. * x[0] + a) * x[1] - b * x[0],
                                  std::cos(x[0] - b) * x[1] * a + x[0] * x[1]});
    });
  };
  constexpr double step   = 1e-8;
  unsigned int     n_good = 0;
  for (unsigned int sample = 0; sample < 10; ++sample)
  {
    const Vector u = field(0.01), direction = field(1.);
    ASSERT_TRUE(system.assemble(u, Tangent::consistent, nullptr) ==
                Deformation::admissible);
    ASSERT_GT(solid->inelastic_terms()->totals().n_yielding, 10u);
    Vector expected(system.residual()), owned(system.residual());
    owned = direction;
    system.tangent().vmult(expected, owned);
    model->constraints.set_zero(expected);
    const auto at = [&](const double share) {
      Vector moved(u), change(owned);
      change = u;
      change.add(share, owned);
      moved = change;
      EXPECT_TRUE(system.assemble(moved, Tangent::none, nullptr) ==
                  Deformation::admissible);
      return Vector(system.residual());
    };
    Vector difference = at(step);
    difference -= at(-step);
    difference /= 2. * step;
    difference -= expected;
    // rounding of forces 1e-15 * E / step; some points are at kinks in some samples
    n_good += difference.l2_norm() < 1e-5 * expected.l2_norm();
  }
  EXPECT_GE(n_good, 8u);
}


/// Large displacements and plane stress are refused.
TEST(Inelastic, WhatIsNotThereIsRefused)
{
  auto model = yielding_box(mohr_coulomb(30., 1., 10.), MPI_COMM_SELF);
  model->problem.boundary_conditions.push_back(
    condition(BoundaryCondition::Type::displacement, "left"));
  const auto elasticity = finite_elasticity(*model);
  EXPECT_THROW(make_solid_at_rest(*elasticity, Kinematics::finite), InputError);
  EXPECT_THROW(model->problem.materials[0].hyperelastic_law(
                 PlaneState::plane_strain),
               InputError);
  // Its initial stress would be lost in silence.
  StaticElasticity linear(model->covers,
                          *model->quadrature,
                          model->constraints,
                          model->problem);
  EXPECT_THROW(linear.assemble(), InputError);
}
