// Initial stress that varies, and the stress of weight.

#include <nmm/base/exceptions.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/in_situ_stress.h>
#include <nmm/mechanics/solid_term.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Components that are linear in x, or constant.
  class LinearStress : public dealii::Function<2>
  {
  public:
    explicit LinearStress(std::vector<std::array<double, 3>> coefficients)
      : dealii::Function<2>(coefficients.size())
      , coefficients(std::move(coefficients))
    {
    }

    double
    value(const Point<2> &x, const unsigned int component) const override
    {
      const auto &c = coefficients[component];
      return c[0] + c[1] * x[0] + c[2] * x[1];
    }

  private:
    std::vector<std::array<double, 3>> coefficients;
  };


  std::shared_ptr<const LinearStress>
  linear_stress(std::vector<std::array<double, 3>> coefficients)
  {
    return std::make_shared<const LinearStress>(std::move(coefficients));
  }


  /// What the solid gives for a step between two displacements.
  struct Forces
  {
    Vector residual, product;
    double energy;
  };


  Forces
  forces_of(Model &model, const Kinematics kinematics, const bool is_conserving)
  {
    const auto elasticity = finite_elasticity(model);
    const auto solid      = make_solid_at_rest(*elasticity, kinematics);
    const auto field      = [&](const double a, const double size) {
      return interpolate(model, [=](const Point<2> &x) {
        return size * Tensor<1, 2>({std::sin(2. * x[0] + a) * x[1],
                                    std::cos(x[0] - a) + x[0] * x[1]});
      });
    };
    const Vector begin = field(1., 2e-3), end = field(2., 3e-3);
    solid->begin_step({begin, end, 0., 1., 0.});
    Trial trial   = is_conserving ? Trial::step(begin, end, 0., 1., true)
                                  : Trial::at(end, 1.);
    trial.tangent = Tangent::consistent;
    AssembledForces forces;
    EXPECT_TRUE(solid->assemble(trial, forces) == Deformation::admissible);
    Vector owned(*forces.residual);
    owned = field(3., 1.);
    Vector product(owned);
    forces.tangent->vmult(product, owned);
    model.constraints.set_zero(product);
    return {*forces.residual, product, forces.strain_energy};
  }
} // namespace


// The same stress once as numbers and once as a function: same forces, tangents and energies, ties
// and conditions included. Laws have their own place for the numbers, so that this compares two
// programs.
TEST(VaryingInitialStress, OfConstantValueIsTheUniformOne)
{
  struct Case
  {
    std::string law;
    Kinematics  kinematics;
    bool        is_conserving;
  };
  const std::vector<Case> cases = {
    {"linear", Kinematics::small, false},
    {"St. Venant-Kirchhoff", Kinematics::finite, false},
    {"neo-Hookean", Kinematics::finite, false},
    {"St. Venant-Kirchhoff", Kinematics::finite, true},
    {"neo-Hookean", Kinematics::finite, true},
    {"Mohr-Coulomb", Kinematics::small, false},
    {"Mohr-Coulomb", Kinematics::finite, false},
    {"Mohr-Coulomb", Kinematics::finite, true}};
  for (const Case &c : cases)
    for (const PlaneState state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
    {
      SCOPED_TRACE(c.law +
                   (c.kinematics == Kinematics::finite ? " finite" : "") +
                   (c.is_conserving ? " conserving" : "") +
                   (state == PlaneState::plane_strain ? " plane strain" : ""));
      auto law = material_law(c.law)->clone();
      for (const LawParameter &parameter : law->parameters())
        if (parameter.key == "Cohesion")
          *parameter.value = 2.;
        else if (parameter.key == "Friction angle")
          *parameter.value = 0.5;
      const std::shared_ptr<const MaterialLaw> shared = std::move(law);

      auto model = jointed_box(2, shared, state, 0.3, MPI_COMM_SELF);
      model->problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "left"),
        condition(BoundaryCondition::Type::normal_displacement, "bottom")};
      const bool is_thick = state == PlaneState::plane_strain;
      for (const unsigned int m : {0, 1})
      {
        Material &material            = model->problem.materials[m];
        material.initial_stress[0][0] = -3. - m;
        material.initial_stress[0][1] = 0.5;
        material.initial_stress[1][1] = -2.;
        if (is_thick)
          material.given_initial_stress_zz = -2.5;
      }
      const Forces uniform = forces_of(*model, c.kinematics, c.is_conserving);
      for (const unsigned int m : {0, 1})
      {
        Material &material = model->problem.materials[m];
        std::vector<std::array<double, 3>> components = {{{-3. - m, 0., 0.}},
                                                         {{-2., 0., 0.}},
                                                         {{0.5, 0., 0.}}};
        if (is_thick)
          components.push_back({{-2.5, 0., 0.}});
        material.initial_stress          = 0.;
        material.given_initial_stress_zz = std::nullopt;
        material.varying_initial_stress  = linear_stress(components);
      }
      const Forces varying = forces_of(*model, c.kinematics, c.is_conserving);
      // rounding of stresses of E = 1000 in sums of some hundred terms
      EXPECT_LT(relative_difference(varying.residual, uniform.residual), 1e-11);
      EXPECT_LT(relative_difference(varying.product, uniform.product), 1e-11);
      if (!c.is_conserving)
      {
        EXPECT_NEAR(varying.energy,
                    uniform.energy,
                    1e-11 * std::abs(uniform.energy));
      }
    }
}


// Linear stress whose divergence is minus the body force does nothing: the linear displacement that
// the outline prescribes comes out to rounding, ties included, and outputs have both stresses.
TEST(VaryingInitialStress, InBalanceWithBodyForceDoesNothing)
{
  for (const unsigned int degree : {1, 2})
  {
    auto model                       = jointed_box(degree,
                             material_law("linear"),
                             PlaneState::plane_strain,
                             0.3,
                             MPI_COMM_SELF);
    model->problem.materials[1]      = model->problem.materials[0];
    model->problem.materials[1].name = "soil";
    const auto stress                = linear_stress(
      {{{100., 30., -20.}}, {{-50., 10., 40.}}, {{7., -5., 25.}}});
    for (Material &material : model->problem.materials)
      material.varying_initial_stress = stress;
    model->problem.body_force = vector_function([](const Point<2> &) {
      return Tensor<1, 2>({-(30. + 25.), -(-5. + 40.)});
    });
    const auto exact          = [](const Point<2> &x) {
      return Tensor<1, 2>(
        {0.02 * x[0] - 0.01 * x[1], 0.03 * x[0] + 0.01 * x[1] + 0.5});
    };
    for (const char *side : {"bottom", "right", "top", "left"})
      model->problem.boundary_conditions.push_back(condition(
        BoundaryCondition::Type::displacement, side, vector_function(exact)));
    model->solve();
    Tensor<2, 2> gradient;
    gradient[0][0]        = 0.02;
    gradient[0][1]        = -0.01;
    gradient[1][0]        = 0.03;
    gradient[1][1]        = 0.01;
    const Material  &rock = model->problem.materials[0];
    const ErrorNorms errors =
      compute_errors(*model->field, exact, [&](const Point<2> &x) {
        return rock.plane_elasticity(PlaneState::plane_strain)
                 .stress(gradient) +
               rock.initial_stress_at(x);
      });
    EXPECT_LT(errors.displacement, 2e-10);
    EXPECT_LT(errors.stress, 2e-8);
  }
}


TEST(VaryingInitialStress, WhatDoesNotFitIsRefused)
{
  Material rock               = material("rock", 1000., 0.3);
  rock.varying_initial_stress = linear_stress({{{1., 0., 0.}}, {{1., 0., 0.}}});
  EXPECT_THROW(rock.check(PlaneState::plane_strain), InputError);
  rock.varying_initial_stress = linear_stress(
    {{{1., 0., 0.}}, {{1., 0., 0.}}, {{1., 0., 0.}}, {{1., 0., 0.}}});
  EXPECT_NO_THROW(rock.check(PlaneState::plane_strain));
  EXPECT_THROW(rock.check(PlaneState::plane_stress), InputError);
  rock.initial_stress[0][0] = 1.;
  EXPECT_THROW(rock.check(PlaneState::plane_strain), InputError);
}


namespace
{
  /// A box of 10 m by 8 m with a layer whose border is an arc, and with a tunnel. Gravity is 10 m/s^2,
  /// so that "rock" weighs 20 N/m^3 and "soil" 10 N/m^3.
  std::unique_ptr<Model>
  ground()
  {
    auto model = std::make_unique<Model>(
      parse_geometry(
        "boundary name=rim material=rock POLYGON ((0 0, 10 0, 10 8, 0 8))\n"
        "hole name=tunnel CIRCLE (2 2, 1)\n"
        "interface name=lens material=soil CIRCLE (6 5, 2)\n"
        "joint name=crack LINESTRING (-1 1, 11 7)",
        ""),
      mesh_parameters(1.1, {}, 9.),
      2);
    model->problem.plane_state = PlaneState::plane_strain;
    model->problem.materials   = {material("rock", 1000., 0.25, 2.),
                                  material("soil", 300., 0.2, 1.)};
    model->problem.gravity     = Tensor<1, 2>({0., -10.});
    return model;
  }


  double
  vertical(const Model &model, const Point<2> &x)
  {
    return model.problem.materials[0].initial_stress_at(x)[1][1];
  }
} // namespace


TEST(InSituStress, IsTheWeightAbove)
{
  const auto model = ground();
  set_in_situ_stress({}, model->manifold_mesh, model->problem);
  // rounding of coordinates of a circle, times the weight
  constexpr double tolerance = 1e-11;
  EXPECT_NEAR(vertical(*model, {8.5, 3.}), -20. * 5., tolerance);
  EXPECT_NEAR(vertical(*model, {0., 0.}), -20. * 8., tolerance);
  EXPECT_NEAR(vertical(*model, {10., 0.}), -20. * 8., 1e-9);
  EXPECT_NEAR(vertical(*model, {5., 8.}), 0., tolerance);
  // below, in and above the lens, 1 m from its centre: half of the chord is sqrt(3)
  EXPECT_NEAR(vertical(*model, {7., 1.}),
              -20. * 7. + 10. * 2. * std::sqrt(3.),
              tolerance);
  EXPECT_NEAR(vertical(*model, {7., 5.}),
              -20. * 3. + 10. * std::sqrt(3.),
              tolerance);
  EXPECT_NEAR(vertical(*model, {7., 7.}), -20., tolerance);
  // the tunnel is excavated later
  EXPECT_NEAR(vertical(*model, {2., 0.5}), -20. * 7.5, tolerance);
  // ratios of each material, and across the plane
  const Material &rock = model->problem.materials[0],
                 &soil = model->problem.materials[1];
  EXPECT_NEAR(rock.initial_stress_at({8.5, 3.})[0][0], -100. / 3., tolerance);
  EXPECT_NEAR(soil.initial_stress_at({8.5, 3.})[0][0], -100. / 4., tolerance);
  EXPECT_EQ(rock.initial_stress_at({8.5, 3.})[0][1], 0.);
  EXPECT_NEAR(rock.initial_stress_zz_at({8.5, 3.}, PlaneState::plane_strain),
              -100. / 3.,
              tolerance);
  // a second stress
  EXPECT_THROW(set_in_situ_stress({}, model->manifold_mesh, model->problem),
               InputError);
}


TEST(InSituStress, ReachesUpToTheGroundLine)
{
  constexpr double tolerance = 1e-11;
  {
    // above the solid, and inclined
    const auto   model = ground();
    InSituStress stress;
    stress.K0                = 0.5;
    stress.K0_out_of_plane   = 0.75;
    stress.ground_line       = {{0., 10.}, {10., 20.}};
    stress.unit_weight_above = 5.;
    set_in_situ_stress(stress, model->manifold_mesh, model->problem);
    const double at_depth = -5. * 9. - 20. * 6.;
    EXPECT_NEAR(vertical(*model, {9., 2.}), at_depth - 2. * 5., tolerance);
    EXPECT_NEAR(vertical(*model, {0., 8.}), -10., tolerance);
    const Material &rock = model->problem.materials[0];
    EXPECT_NEAR(rock.initial_stress_at({9., 2.})[0][0],
                0.5 * (at_depth - 10.),
                tolerance);
    EXPECT_NEAR(rock.initial_stress_zz_at({9., 2.}, PlaneState::plane_strain),
                0.75 * (at_depth - 10.),
                tolerance);
  }
  {
    // in the solid: what is above is built later
    const auto   model = ground();
    InSituStress stress;
    stress.ground_line = {{0., 6.}};
    set_in_situ_stress(stress, model->manifold_mesh, model->problem);
    EXPECT_NEAR(vertical(*model, {9., 2.}), -20. * 4., tolerance);
    EXPECT_NEAR(vertical(*model, {9., 7.}), 0., tolerance);
    EXPECT_NEAR(vertical(*model, {6., 2.}), -10. * 3. - 20., tolerance);
  }
  InSituStress stress;
  stress.unit_weight_above = 5.;
  EXPECT_THROW(stress.check(PlaneState::plane_strain), InputError);
  stress.ground_line = {{1., 9.}, {1., 10.}};
  EXPECT_THROW(stress.check(PlaneState::plane_strain), InputError);
  stress.ground_line     = {{1., 9.}, {2., 10.}};
  stress.K0_out_of_plane = 1.;
  EXPECT_NO_THROW(stress.check(PlaneState::plane_strain));
  EXPECT_THROW(stress.check(PlaneState::plane_stress), InputError);
}
