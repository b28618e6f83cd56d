// Forces and tangents of FiniteElasticity: derivatives against differences, term
// by term, and what rigid motion must not do.

#include <nmm/materials/material.h>

#include <gtest/gtest.h>
#include <mechanics/conserving_terms.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  /// Random displacements of covers, of the size of a twentieth of a cell: gradients
  /// of some 0.2.
  Vector
  random_displacement(const Model &model, const double size, std::mt19937 &g)
  {
    // the same numbers on every rank
    std::uniform_real_distribution<double> random(-size, size);
    std::vector<Tensor<1, 2>>              values(model.covers.n_covers());
    for (auto &v : values)
      for (unsigned int c = 0; c < 2; ++c)
        v[c] = random(g);
    Vector owned(model.covers.locally_owned_dofs(2),
                 model.covers.communicator());
    for (const auto k : model.covers.locally_owned_covers())
      for (unsigned int c = 0; c < 2; ++c)
        owned(2 * k + c) = values[k][c];
    owned.compress(dealii::VectorOperation::insert);
    model.constraints.distribute(owned);
    Vector result(model.covers.locally_owned_dofs(2),
                  model.covers.locally_relevant_dofs(2),
                  model.covers.communicator());
    result = owned;
    return result;
  }


  Vector
  sum(const Model &model, const Vector &u, const double s, const Vector &v)
  {
    Vector a(model.covers.locally_owned_dofs(2), model.covers.communicator()),
      b(a);
    a = u;
    b = v;
    a.add(s, b);
    Vector result(u);
    result = a;
    return result;
  }


  /// Owned values of @p v, 0 for constrained unknowns.
  Vector
  free_part(const Model &model, const Vector &v)
  {
    Vector result(model.covers.locally_owned_dofs(2),
                  model.covers.communicator());
    result = v;
    for (const auto k : model.covers.locally_owned_dofs(2))
      if (model.constraints.is_constrained(k))
        result(k) = 0.;
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  double
  potential(const FiniteElasticity &elasticity)
  {
    const FiniteElasticity::Energies &e = elasticity.energies();
    return e.strain + e.conditions + e.loads;
  }


  /// K v and r . v against central differences along random v. Returns the
  /// number of directions.
  unsigned int
  check_derivatives(Model &model, const unsigned int seed)
  {
    std::mt19937   generator(seed);
    constexpr auto load_factor = 0.7;
    const auto     elasticity  = finite_elasticity(model);
    const bool     symmetric   = elasticity->tangent_is_symmetric();
    // small enough that elements whose covers are continued from a root, with
    // weights of ten and more, stay away from inversion
    const Vector u = random_displacement(model, 0.02 * 0.22, generator);
    unsigned int n = 0;
    for (; n < 3; ++n)
    {
      const Vector v         = random_displacement(model, 1., generator);
      const Vector direction = free_part(model, v);

      EXPECT_TRUE(elasticity->assemble(u, load_factor, Tangent::consistent) ==
                  Deformation::admissible);
      Vector product(direction);
      elasticity->tangent().vmult(product, direction);
      const double work = elasticity->residual() * direction;

      constexpr double step = 1e-6;
      EXPECT_TRUE(elasticity->assemble(sum(model, u, step, v),
                                       load_factor,
                                       Tangent::none) ==
                  Deformation::admissible);
      Vector       difference = elasticity->residual();
      const double plus       = potential(*elasticity);
      EXPECT_TRUE(elasticity->assemble(sum(model, u, -step, v),
                                       load_factor,
                                       Tangent::none) ==
                  Deformation::admissible);
      difference -= elasticity->residual();
      const double minus = potential(*elasticity);
      difference *= 1. / (2. * step);
      const double scale = product.l2_norm();
      difference -= product;
      // third derivatives times step^2 / h^2, rounding 1e-16 / step; and the
      // 1e-8 of the law's difference quotient
      EXPECT_GT(scale, 0.);
      EXPECT_LT(difference.l2_norm(), 2e-7 * scale);
      if (symmetric)
      {
        EXPECT_NEAR((plus - minus) / (2. * step),
                    work,
                    1e-7 * (std::abs(work) + std::abs(plus) / step * 1e-9));
      }
    }
    return n;
  }


  SymmetricTensor<2, 2>
  test_stress()
  {
    SymmetricTensor<2, 2> stress;
    stress[0][0] = 20.;
    stress[0][1] = -30.;
    stress[1][1] = 10.;
    return stress;
  }


  const auto waves = vector_function([](const Point<2> &x) {
    return Tensor<1, 2>({0.02 * std::sin(3. * x[1]), 0.03 * x[0] * x[1]});
  });

  /// Each with all that is needed to hold the box.
  std::vector<std::pair<std::string, std::vector<BoundaryCondition>>>
  terms()
  {
    const auto clamped    = condition(Type::displacement, "left");
    auto       partial    = condition(Type::displacement, "right", waves);
    partial.components[0] = false;
    return {{"displacement", {condition(Type::displacement, "left", waves)}},
            {"one component", {clamped, partial}},
            {"normal displacement",
             {condition(Type::normal_displacement, "bottom", constant(0.02)),
              condition(Type::normal_displacement, "left")}},
            {"dead loads",
             {clamped,
              condition(Type::traction, "right", waves),
              condition(Type::pressure, "top", constant(20.))}},
            {"follower pressure",
             {clamped,
              condition(Type::follower_pressure, "top", constant(50.)),
              condition(Type::follower_pressure, "right", constant(-30.))}}};
  }
} // namespace


TEST(FiniteTerms, TangentAgainstDifferencesMPI)
{
  unsigned int n = 0, seed = 100;
  for (const std::shared_ptr<const MaterialLaw> &law :
       {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
    for (const PlaneState state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      for (const unsigned int degree : {1, 2})
        for (const auto &[name, conditions] : terms())
        {
          SCOPED_TRACE(name + ", seed " + std::to_string(++seed));
          const auto model                   = jointed_box(degree, law, state);
          model->problem.boundary_conditions = conditions;
          model->problem.gravity             = Tensor<1, 2>({1., -2.});
          model->problem.body_force          = waves;
          model->problem.materials[0].initial_stress = test_stress();
          model->problem.point_forces = {{{1.6, 0.7}, Tensor<1, 2>({3., 4.})}};
          FixedPoint fixed;
          fixed.point        = {0.9, 0.2};
          fixed.displacement = Tensor<1, 2>({0.01, 0.02});
          fixed.stiffness    = 500.;
          model->problem.fixed_points.push_back(fixed);
          n += check_derivatives(*model, seed);
        }
  EXPECT_EQ(n, 2u * 2u * 2u * 5u * 3u);
}


// At zero displacements the tangent is the matrix of small displacements, penalties and averages
// of ties included: also at a block that is small compared with the cells, whose ties would be too
// soft with the bounds of elements alone.
TEST(FiniteTerms, TangentAtRestIsThatOfSmallDisplacements)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 1.});
  geometry.add_polyline(
    {{0.52, 0.43}, {0.523, 0.43}, {0.523, 0.433}, {0.52, 0.433}, {0.52, 0.43}},
    "small",
    CurveRole::joint,
    JointState::closed);
  Model model(std::move(geometry), mesh_parameters(0.4, {}, 9.), 2);
  model.problem.materials           = {material()};
  model.problem.boundary_conditions = {
    condition(BoundaryCondition::Type::displacement, "left", nullptr)};
  StaticElasticity small(model.covers,
                         *model.quadrature,
                         model.constraints,
                         model.problem);
  small.assemble();
  const auto elasticity = finite_elasticity(model);
  const auto rest =
    interpolate(model, [](const Point<2> &) { return Tensor<1, 2>(); });
  ASSERT_TRUE(elasticity->assemble(rest, 1., Tangent::consistent) ==
              Deformation::admissible);

  // Rounding of sums whose terms are the penalties, in the order of assembly.
  std::mt19937 generator(7);
  for (unsigned int n = 0; n < 3; ++n)
  {
    const Vector direction =
      free_part(model, random_displacement(model, 1., generator));
    Vector expected(direction), product(direction);
    small.system_matrix().vmult(expected, direction);
    elasticity->tangent().vmult(product, direction);
    EXPECT_LT(relative_difference(product, expected), 1e-12);
  }
}


// A body turned by 90 degrees, prescribed displacements and springs turned
// with it: no force at all, on cut elements, interfaces and Nitsche's terms alike.
TEST(FiniteTerms, RigidRotationHasNoForceMPI)
{
  const auto turned = [](const Point<2> &x) {
    return Tensor<1, 2>({-x[1] - x[0] + 0.3, x[0] - x[1] - 0.7});
  };
  for (const std::shared_ptr<const MaterialLaw> &law :
       {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
    for (const unsigned int degree : {1, 2})
    {
      const auto model = jointed_box(degree, law, PlaneState::plane_stress);
      model->problem.boundary_conditions = {
        condition(Type::displacement, "left", vector_function(turned)),
        condition(Type::displacement, "bottom", vector_function(turned))};
      FixedPoint fixed;
      fixed.point        = {1.6, 0.8};
      fixed.displacement = turned(fixed.point);
      model->problem.fixed_points.push_back(fixed);
      const auto elasticity = finite_elasticity(*model);
      ASSERT_TRUE(elasticity->assemble(interpolate(*model, turned),
                                       1.,
                                       Tangent::consistent) ==
                  Deformation::admissible);
      // rounding of F, 1e-15, times the largest modulus and length; the springs
      // are 1000 times stiffer
      EXPECT_LT(elasticity->residual().linfty_norm(), 1e-9);
      // rounding of mu/2 (I_1 - 3)
      EXPECT_LT(std::abs(elasticity->energies().strain), 1e-15 * 1000.);
    }
}


// The pattern is made once: assembling something else in between changes
// nothing, to the last bit.
TEST(FiniteTerms, AssembledAgainIsTheSameMPI)
{
  std::mt19937 generator(5);
  const auto   model =
    jointed_box(2, material_law("neo-Hookean"), PlaneState::plane_strain);
  model->problem.boundary_conditions = {condition(Type::displacement, "left")};
  const auto   elasticity            = finite_elasticity(*model);
  const Vector u = random_displacement(*model, 0.01, generator),
               v = random_displacement(*model, 0.01, generator);
  ASSERT_TRUE(elasticity->assemble(u, 1., Tangent::consistent) ==
              Deformation::admissible);
  const Vector first = elasticity->residual();
  Vector       x(first), y(first), z(first);
  x = v;
  elasticity->tangent().vmult(y, x);
  ASSERT_TRUE(elasticity->assemble(v, 0.5, Tangent::consistent) ==
              Deformation::admissible);
  ASSERT_TRUE(elasticity->assemble(v, 0.5, Tangent::none) ==
              Deformation::admissible);
  ASSERT_TRUE(elasticity->assemble(u, 1., Tangent::consistent) ==
              Deformation::admissible);
  elasticity->tangent().vmult(z, x);
  y -= z;
  EXPECT_EQ(y.linfty_norm(), 0.);
  Vector again = elasticity->residual();
  again -= first;
  EXPECT_EQ(again.linfty_norm(), 0.);
}


// With the increment of the last iteration the tangent differs, and no longer
// where the increment vanishes.
TEST(FiniteTerms, IncrementChangesTheTangentOnly)
{
  std::mt19937 generator(6);
  const auto   model                 = jointed_box(2,
                                 material_law("St. Venant-Kirchhoff"),
                                 PlaneState::plane_stress);
  model->problem.boundary_conditions = {condition(Type::displacement, "left")};
  const auto   elasticity            = finite_elasticity(*model);
  const Vector u       = random_displacement(*model, 0.01, generator);
  const auto   entries = [&](const Vector *increment) {
    EXPECT_TRUE(elasticity->assemble(u, 1., Tangent::consistent, increment) ==
                Deformation::admissible);
    return std::make_pair(elasticity->tangent().frobenius_norm(),
                          elasticity->residual());
  };
  const auto plain = entries(nullptr);
  const auto same  = entries(&u);
  EXPECT_GT(std::abs(same.first - plain.first), 1e-6 * plain.first);
  EXPECT_EQ(relative_difference(same.second, plain.second), 0.);
  const Vector zero =
    interpolate(*model, [](const Point<2> &) { return Tensor<1, 2>(); });
  EXPECT_EQ(entries(&zero).first, plain.first);
}


TEST(FiniteTerms, AmplitudesScaleAndRelease)
{
  const auto model                   = jointed_box(2,
                                 material_law("St. Venant-Kirchhoff"),
                                 PlaneState::plane_stress);
  model->problem.boundary_conditions = {
    condition(Type::displacement, "left"),
    condition(Type::displacement, "right", waves),
    condition(Type::traction, "top", waves)};
  model->problem.gravity  = Tensor<1, 2>({0., -1.});
  const auto   elasticity = finite_elasticity(*model);
  std::mt19937 generator(7);
  const Vector u = random_displacement(*model, 0.01, generator);

  ASSERT_TRUE(elasticity->assemble(u, 2., Tangent::none) ==
              Deformation::admissible);
  const Vector   expected = elasticity->residual();
  LoadAmplitudes amplitudes;
  amplitudes.boundary_conditions = {2., 2., 2.};
  amplitudes.gravity             = 2.;
  elasticity->set_amplitudes(amplitudes);
  ASSERT_TRUE(elasticity->assemble(u, 1., Tangent::none) ==
              Deformation::admissible);
  EXPECT_LT(relative_difference(elasticity->residual(), expected), 1e-14);

  // without its first two conditions, the box does not notice a translation
  amplitudes.released_conditions = {true, true, false};
  elasticity->set_amplitudes(amplitudes);
  ASSERT_TRUE(elasticity->assemble(u, 1., Tangent::none) ==
              Deformation::admissible);
  const Vector released = elasticity->residual();
  const Vector moved    = sum(*model, u, 1., interpolate(*model, [](auto &) {
    return Tensor<1, 2>({5., -3.});
  }));
  ASSERT_TRUE(elasticity->assemble(moved, 1., Tangent::none) ==
              Deformation::admissible);
  EXPECT_LT(relative_difference(elasticity->residual(), released), 1e-11);
  EXPECT_GT(relative_difference(released, expected), 1e-3);

  amplitudes.point_forces = {1.};
  EXPECT_THROW(elasticity->set_amplitudes(amplitudes), InputError);
}


// Strains are rounded relative to themselves: a change by 1e-10 of a strain of 1e-8, which damping
// multiplies by 1e9, is as exact as 1e-16 / 1e-10 of it, and not lost beside the 1 of F = I + H.
TEST(FiniteTerms, DampingOfSmallStrainsIsNotRounded)
{
  const double damping = 1e9;
  Material     material;
  material.youngs_modulus = 2.;
  material.poissons_ratio = 0.25;
  const internal::ConservingLaw law(material.hyperelastic_law(
                                      PlaneState::plane_strain),
                                    dealii::SymmetricTensor<2, 2>());
  Tensor<2, 2>                  H_0;
  H_0[0][0]                                = 1e-8;
  const Tensor<2, 2>                H_1    = (1. + 1e-10) * H_0;
  const double                      change = H_1[0][0] - H_0[0][0];
  internal::ConservingLaw::Response response;
  ASSERT_EQ(law.evaluate(H_0, H_1, false, damping, response),
            Deformation::admissible);
  // E (1 - nu) / ((1 + nu) (1 - 2 nu)) = 2.4 of the strain 1e-8 and of its change
  EXPECT_NEAR(response.stress[0][0],
              2.4 * (1e-8 + damping * change),
              2.4 * 1e-5 * damping * 1e-18);
  EXPECT_NEAR(response.dissipated,
              2.4 * damping * change * change,
              1e-5 * response.dissipated);
}
