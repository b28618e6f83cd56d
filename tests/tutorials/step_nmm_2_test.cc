// The paper's step-by-step scheme, which step-nmm-2 compares with Newton's method.

#include <nmm/materials/material.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <step-nmm-2/incremental_elasticity.h>

using namespace NMM;
using namespace NMM::Test;
using StepNMM2::IncrementalElasticity;

namespace
{
  using Type = BoundaryCondition::Type;

  /// A unit square on a turned mesh, whose sides move by @p exact.
  std::unique_ptr<Model>
  moved_square(const Material                                      &material,
               const std::function<Tensor<1, 2>(const Point<2> &)> &exact)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    auto model                 = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.3, {}, 9.),
                                         2);
    model->problem.plane_state = PlaneState::plane_strain;
    model->problem.materials   = {material};
    for (const std::string side : {"left", "right", "top", "bottom"})
      model->problem.boundary_conditions.push_back(
        condition(Type::displacement, side, vector_function(exact)));
    return model;
  }


  double
  displacement_error(const Model                                         &model,
                     const IncrementalElasticity                         &body,
                     const std::function<Tensor<1, 2>(const Point<2> &)> &exact)
  {
    return compute_errors({model.covers, model.problem, body.displacements()},
                          exact,
                          [](const Point<2> &) {
                            return SymmetricTensor<2, 2>();
                          })
      .displacement;
  }


  constexpr double length = 10.;

  /// The cantilever of the paper's Fig. 10.
  std::unique_ptr<Model>
  cantilever(const bool follower, const double cell_size)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {length, 1.});
    auto model = std::make_unique<Model>(
      std::move(geometry),
      mesh_parameters(cell_size, Tensor<1, 2>({0.03, 0.02}), 7.),
      2);
    constexpr double youngs_modulus = 120000.;
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
  tip_deflection(const Model &model, const DisplacementField &field)
  {
    const unsigned int element =
      model.manifold_mesh.find_element({length - 1e-9, 0.5});
    return -field.displacement(element,
                               model.mathematical_mesh.real_to_reference(
                                 model.manifold_mesh.cell(element),
                                 {length, 0.5}))[1] /
           length;
  }


  /// The same after @p n equal steps to @p load_factor.
  double
  deflection_by_increments(const Model       &model,
                           const unsigned int n,
                           const double       load_factor)
  {
    IncrementalElasticity incremental(model.covers,
                                      *model.quadrature,
                                      model.constraints,
                                      model.problem);
    for (unsigned int k = 1; k <= n; ++k)
      incremental.step(load_factor * k / n);
    return tip_deflection(
      model, {model.covers, model.problem, incremental.displacements()});
  }
} // namespace


// The paper's scheme is of first order in the step.
TEST(Incremental, FirstOrderInTheStep)
{
  for (const bool follower : {false, true})
  {
    SCOPED_TRACE(follower ? "follower" : "dead");
    const auto model = cantilever(follower, 0.5);
    // a tenth of the load: small strains, so that the laws agree
    const auto       elasticity = finite_elasticity(*model);
    NonlinearStatics statics(*elasticity);
    statics.run(LoadSteps::equal(1, 0.1));
    const double expected =
      tip_deflection(*model,
                     {model->covers, model->problem, statics.solution()});
    const double w10 = deflection_by_increments(*model, 10, 0.1),
                 w20 = deflection_by_increments(*model, 20, 0.1),
                 w40 = deflection_by_increments(*model, 40, 0.1);
    EXPECT_NEAR((w10 - w20) / (w20 - w40), 2., 0.2);
    // extrapolated; what is left is the difference of the laws at strains of
    // 0.03
    EXPECT_NEAR(2. * w40 - w20, expected, 3e-3 * expected);
    EXPECT_GT(std::abs(w10 - expected), 2e-3 * expected);
  }
}


// At K = 10 a hundred steps are 8e-3 off the solid of cantilever.csv.
TEST(Incremental, AHundredStepsOfTheCantilever)
{
  const auto model = cantilever(/* follower = */ false, 0.33);
  EXPECT_NEAR(deflection_by_increments(*model, 100, 1.),
              0.711962,
              2e-2 * 0.711962);
}


// A step is a straight line: a block turned by prescribed displacements
// follows them exactly, although their map is a rotation times sqrt(1 + t^2).
// Its initial stress turns with it, by 45 degrees in the end, and the growth
// adds equal stress in all directions.
TEST(Incremental, StressTurnsWithTheBlock)
{
  Material rock             = material();
  rock.initial_stress[0][0] = 100.;
  const auto turn           = [](const Point<2> &x) {
    return Tensor<1, 2>({-x[1], x[0]});
  };
  const auto            model = moved_square(rock, turn);
  IncrementalElasticity incremental(model->covers,
                                    *model->quadrature,
                                    model->constraints,
                                    model->problem);
  for (unsigned int k = 1; k <= 10; ++k)
    incremental.step(0.1 * k);
  EXPECT_LT(displacement_error(*model, incremental, turn), 1e-9);
  ASSERT_FALSE(incremental.stresses().empty());
  double largest = 0.;
  for (const SymmetricTensor<2, 2> &stress : incremental.stresses())
    largest = std::max(largest,
                       std::max(std::abs(stress[0][1] - 50.),
                                std::abs(stress[0][0] - stress[1][1])));
  // rounding of gradients times E
  EXPECT_LT(largest, 1e-8);
}


// Two steps of a stretch by half of the length: the strains are 0.25 / 1 and 0.25 / 1.25, the
// stresses lambda + 2 mu = 1.2 and lambda = 0.4 times their sum.
TEST(Incremental, StrainsOfStepsAreOnTheCurrentLength)
{
  const auto stretch = [](const Point<2> &x) {
    return Tensor<1, 2>({0.5 * x[0], 0.});
  };
  const auto model = moved_square(material("rubber", 1., 0.25), stretch);
  IncrementalElasticity incremental(model->covers,
                                    *model->quadrature,
                                    model->constraints,
                                    model->problem);
  incremental.step(0.5);
  incremental.step(1.);
  EXPECT_LT(displacement_error(*model, incremental, stretch), 1e-9);
  ASSERT_FALSE(incremental.stresses().empty());
  for (const SymmetricTensor<2, 2> &stress : incremental.stresses())
  {
    EXPECT_NEAR(stress[0][0], 0.54, 1e-7);
    EXPECT_NEAR(stress[1][1], 0.18, 1e-7);
    EXPECT_NEAR(stress[0][1], 0., 1e-7);
  }
}


TEST(Incremental, RefusesWhatItDoesNotKnow)
{
  const auto model = cantilever(/* follower = */ false, 0.5);
  model->problem.boundary_conditions[0].components[1] = false;
  EXPECT_THROW(IncrementalElasticity(model->covers,
                                     *model->quadrature,
                                     model->constraints,
                                     model->problem),
               InputError);
}
