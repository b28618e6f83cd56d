// Mohr-Coulomb materials in the static equations of small displacements.

#include <nmm/materials/material.h>
#include <nmm/materials/mohr_coulomb_law.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/mechanics/static_elasticity.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <mechanics/rotated_frame.h>

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
               const MPI_Comm                            communicator,
               const PlaneState plane_state = PlaneState::plane_strain)
  {
    auto model = jointed_box(2, law, plane_state, 0.3, communicator);
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


/// Kinematics and plane states in all combinations.
class InelasticTheories
  : public testing::TestWithParam<std::tuple<Kinematics, PlaneState>>
{
protected:
  Kinematics kinematics  = std::get<0>(GetParam());
  PlaneState plane_state = std::get<1>(GetParam());

  /// The stress of the law, in small displacements or as Cauchy's stress at the place, for the
  /// displacement gradient @p H after @p state, which becomes that of @p H.
  InelasticLaw::Response
  expected_at(const Material     &material,
              const Tensor<2, 2> &H,
              MaterialState      &state) const
  {
    const bool             is_finite = kinematics == Kinematics::finite;
    InelasticLaw::Response r;
    internal::RotatedFrame frame;
    EXPECT_TRUE(frame.reinit(H) == Deformation::admissible);
    EXPECT_TRUE(material.inelastic_law(plane_state)
                  ->evaluate(is_finite ? frame.strain() : dealii::symmetrize(H),
                             state,
                             r) == Deformation::admissible);
    state = r.state;
    if (!is_finite)
      return r;
    const double J = dealii::determinant(frame.F);
    r.stress =
      dealii::symmetrize(
        internal::RotatedStress(frame, frame, r.stress).first_stress() *
        dealii::transpose(frame.F)) /
      (J * (1. + r.strain_zz));
    r.stress_zz /= J;
    return r;
  }
};

INSTANTIATE_TEST_SUITE_P(
  All,
  InelasticTheories,
  testing::Combine(testing::Values(Kinematics::small, Kinematics::finite),
                   testing::Values(PlaneState::plane_strain,
                                   PlaneState::plane_stress)));


/// A uniform strain that yields, prescribed all around: all stresses are those of the law for
/// the same path, also beside the tied joint, the interface, the crack and the boundary, where
/// Nitsche's tractions have to be those of the law.
TEST_P(InelasticTheories, UniformStrainMPI)
{
  const auto law   = mohr_coulomb(30., 1., 30.);
  auto       model = yielding_box(law, MPI_COMM_WORLD, plane_state);
  for (const char *side : {"bottom", "right", "top", "left"})
    model->problem.boundary_conditions.push_back(condition(
      BoundaryCondition::Type::displacement, side, vector_function(strained)));
  const auto       elasticity = finite_elasticity(*model);
  const auto       solid      = make_solid_at_rest(*elasticity, kinematics);
  NonlinearStatics statics(*solid, newton_parameters());
  statics.run(LoadSteps::equal(4));

  const Vector exact = interpolate(*model, strained);
  EXPECT_LT(relative_difference(statics.solution(), exact), 1e-8);

  Tensor<2, 2> gradient;
  gradient[0][0] = 0.004;
  gradient[0][1] = 0.001;
  gradient[1][0] = 0.002;
  gradient[1][1] = -0.006;
  InelasticLaw::Response expected;
  MaterialState          state;
  for (unsigned int step = 1; step <= 4; ++step)
    expected =
      expected_at(model->problem.materials[0], 0.25 * step * gradient, state);
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
TEST_P(InelasticTheories, TangentAgainstDifferences)
{
  auto model =
    yielding_box(mohr_coulomb(30., 1., 10.), MPI_COMM_SELF, plane_state);
  model->problem.materials[0].initial_stress[1][1] = -1.;
  model->problem.boundary_conditions.push_back(
    condition(BoundaryCondition::Type::displacement, "left"));
  const auto   elasticity = finite_elasticity(*model);
  const auto   solid      = make_solid_at_rest(*elasticity, kinematics);
  std::mt19937 generator(3);
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
  for (unsigned int sample = 0; sample < 20; ++sample)
  {
    // every other sample is a conserving step, whose tangent is that by the mean displacement
    const bool   is_conserving = sample % 2 == 1;
    const Vector begin = field(0.001), u = field(0.01), direction = field(1.);
    solid->begin_step({begin, u, 0., 1., 0.});
    const auto assemble = [&](const Vector &end, const Tangent tangent) {
      Trial trial   = Trial::step(begin, end, 0., 1., is_conserving);
      trial.tangent = tangent;
      AssembledForces forces;
      EXPECT_TRUE(solid->assemble(trial, forces) == Deformation::admissible);
      return forces;
    };
    const AssembledForces forces = assemble(u, Tangent::consistent);
    ASSERT_GT(solid->inelastic_terms()->totals().n_yielding, 10u);
    Vector expected(*forces.residual), owned(*forces.residual);
    owned = direction;
    forces.tangent->vmult(expected, owned);
    model->constraints.set_zero(expected);
    if (is_conserving)
      expected *= 0.5;
    const auto at = [&](const double share) {
      Vector moved(u), change(owned);
      change = u;
      change.add(share, owned);
      moved = change;
      return Vector(*assemble(moved, Tangent::none).residual);
    };
    Vector difference = at(step);
    difference -= at(-step);
    difference /= 2. * step;
    difference -= expected;
    // rounding of forces 1e-15 * E / step; some points are at kinks in some samples
    n_good += difference.l2_norm() < 1e-5 * expected.l2_norm();
  }
  EXPECT_GE(n_good, 16u);
}


/// A law that yields has no stress without its history.
TEST(Inelastic, WhatIsNotThereIsRefused)
{
  auto model = yielding_box(mohr_coulomb(30., 1., 10.), MPI_COMM_SELF);
  model->problem.boundary_conditions.push_back(
    condition(BoundaryCondition::Type::displacement, "left"));
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


namespace
{
  /// x -> R x, a rotation by 40 degrees.
  Tensor<1, 2>
  turned(const Tensor<1, 2> &x)
  {
    const double c = std::cos(40. * degrees), s = std::sin(40. * degrees);
    return Tensor<1, 2>({c * x[0] - s * x[1], s * x[0] + c * x[1]});
  }


  /// A block on a clamped bottom whose top is moved by 0.006 times @p size sideways and down, with a
  /// cohesion of @p size: strains are proportional to @p size, and the pattern of yielding does not
  /// depend on it in small displacements.
  struct ShearedBlock
  {
    ShearedBlock(const double size, const Kinematics kinematics)
    {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      model                    = std::make_unique<Model>(std::move(geometry),
                                      mesh_parameters(0.35, {}, 9.),
                                      2,
                                      Stabilization::aggregation,
                                      MPI_COMM_SELF);
      model->problem.materials = {material("rock", 1000., 0.2, 2.)};
      model->problem.materials[0].law = mohr_coulomb(30., size, 10.);
      const auto at_top               = [=](const Point<2> &) {
        return size * Tensor<1, 2>({0.006, -0.004});
      };
      model->problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "bottom"),
        condition(BoundaryCondition::Type::displacement,
                  "top",
                  vector_function(at_top))};
      elasticity = finite_elasticity(*model);
      solid      = make_solid_at_rest(*elasticity, kinematics);
      statics = std::make_unique<NonlinearStatics>(*solid, newton_parameters());
    }

    std::unique_ptr<Model>            model;
    std::unique_ptr<FiniteElasticity> elasticity;
    std::unique_ptr<SolidTerm>        solid;
    std::unique_ptr<NonlinearStatics> statics;
  };
} // namespace


/// Rock that has yielded is turned by 40 degrees: stresses turn with it, energy and plastic strain
/// stay, and nothing is dissipated. Both plane states.
TEST(InelasticRotation, StressTurnsWithTheRock)
{
  for (const PlaneState plane_state :
       {PlaneState::plane_strain, PlaneState::plane_stress})
  {
    auto model =
      yielding_box(mohr_coulomb(30., 1., 10.), MPI_COMM_SELF, plane_state);
    model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "left")};
    const auto      elasticity = finite_elasticity(*model);
    const auto      solid = make_solid_at_rest(*elasticity, Kinematics::finite);
    InelasticTerms &terms = *solid->inelastic_terms();
    const auto      bent  = [](const Point<2> &x) {
      return Tensor<1, 2>({0.006 * x[0] - 0.004 * x[0] * x[1],
                           0.002 * x[0] * x[0] - 0.003 * x[1]});
    };
    const Vector u = interpolate(*model, bent),
                 v = interpolate(*model, [&](const Point<2> &x) {
                   return turned(x + bent(x)) - Tensor<1, 2>(x);
                 });
    terms.accept(u);
    const double energy = solid->strain_energy_at(u, 1.);
    std::vector<std::vector<InelasticTerms::PointValues>> before;
    const unsigned int n = model->manifold_mesh.n_elements();
    for (unsigned int e = 0; e < n; ++e)
      before.push_back(terms.values(e));

    terms.accept(v);
    EXPECT_NEAR(terms.totals().dissipated, 0., 1e-12 * energy);
    // strain energies have rounding of 1e-16 of moduli times strain
    EXPECT_NEAR(solid->strain_energy_at(v, 1.), energy, 1e-10 * energy);
    unsigned int n_plastic = 0;
    for (unsigned int e = 0; e < n; ++e)
    {
      const auto after = terms.values(e);
      for (unsigned int q = 0; q < after.size(); ++q)
      {
        const auto &old = before[e][q];
        n_plastic += old.equivalent_plastic_strain > 0.;
        EXPECT_NEAR(after[q].equivalent_plastic_strain,
                    old.equivalent_plastic_strain,
                    1e-14);
        EXPECT_NEAR(after[q].stress_zz, old.stress_zz, 1e-10);
        // (R a) . sigma (R b) for axes a and b
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
          {
            Tensor<1, 2> a, b;
            a[i] = b[j] = 1.;
            EXPECT_NEAR(turned(a) * (after[q].stress * turned(b)),
                        old.stress[i][j],
                        1e-10);
          }
      }
    }
    EXPECT_GT(n_plastic, 100u);
  }
}


/// Both theories differ by the size of strains and rotations, relative to displacements.
TEST(InelasticRotation, SmallStrainsAgreeWithSmallDisplacements)
{
  double differences[2];
  for (unsigned int i = 0; i < 2; ++i)
  {
    ShearedBlock small(i == 0 ? 1. : 0.1, Kinematics::small),
      finite(i == 0 ? 1. : 0.1, Kinematics::finite);
    for (ShearedBlock *block : {&small, &finite})
      block->statics->run(LoadSteps::equal(4));
    EXPECT_GT(finite.solid->inelastic_terms()->totals().yielded_area, 0.2);
    differences[i] = relative_difference(finite.statics->solution(),
                                         small.statics->solution());
  }
  // the largest strains are some 0.02; first order
  EXPECT_LT(differences[0], 0.02);
  EXPECT_GT(differences[0], 1e-4);
  EXPECT_NEAR(differences[1] / differences[0], 0.1, 0.03);
}


/// A slow cycle of tractions that bend a column between its ends, held at points so that no weak
/// condition does work: the work of the tractions is what is stored and dissipated, but for the
/// error of steps, which is of first order.
TEST(InelasticRotation, WorkOfACycle)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 2.});
  Model model(std::move(geometry),
              mesh_parameters(0.4, {}, 9.),
              2,
              Stabilization::aggregation,
              MPI_COMM_SELF);
  model.problem.materials        = {material("rock", 1000., 0.2, 2.)};
  model.problem.materials[0].law = mohr_coulomb(30., 1., 10.);
  // within the strength, but beyond it where the distribution becomes linear
  for (const double sign : {-1., 1.})
    model.problem.boundary_conditions.push_back(condition(
      BoundaryCondition::Type::traction,
      sign > 0. ? "top" : "bottom",
      vector_function([=](const Point<2> &x) {
        return sign * Tensor<1, 2>(
                        {0., std::max(-3.3, std::min(1.1, 3.5 - 10. * x[0]))});
      })));
  FixedPoint left, right;
  left.point                 = Point<2>(0.2, 0.1);
  right.point                = Point<2>(0.8, 0.1);
  right.components[0]        = false;
  model.problem.fixed_points = {left, right};

  double errors[2];
  for (unsigned int i = 0; i < 2; ++i)
  {
    const auto elasticity = finite_elasticity(model);
    const auto solid      = make_solid_at_rest(*elasticity, Kinematics::finite);
    NonlinearStatics   statics(*solid, newton_parameters());
    const unsigned int n = i == 0 ? 10 : 20;
    LoadSteps          steps;
    steps.leaves_out_reached = false;
    steps.load_factors.clear();
    for (unsigned int k = 1; k <= 2 * n; ++k)
      steps.load_factors.push_back(double(k <= n ? k : 2 * n - k) / n);
    Vector last = statics.solution(), loads = solid->residual_at(last, 0.);
    loads -= solid->residual_at(last, 1.);
    double work = 0., dissipated = 0., factor = 0.;
    statics.run(steps, [&](const LoadStep &step, const Vector &u) {
      Vector change(loads), before(loads);
      change = u;
      before = last;
      change -= before;
      work += 0.5 * (factor + step.load_factor) * (loads * change);
      factor = step.load_factor;
      last   = u;
      dissipated += statics.dissipated();
    });
    const double stored = solid->strain_energy_at(last, 0.);
    EXPECT_GT(stored, 0.);
    EXPECT_GT(dissipated, stored);
    errors[i] = std::abs(work - stored - dissipated) / work;
  }
  EXPECT_LT(errors[0], 0.1);
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}
