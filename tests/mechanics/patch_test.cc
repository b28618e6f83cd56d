// Patch tests: fields that lie in the space must come out to rounding, however
// the mesh lies and joints run.

#include <gtest/gtest.h>
#include <mechanics/model.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  // Rounding of a direct solve: machine epsilon times a condition number near
  // 1e5 on these meshes, with a margin of 10.
  constexpr double tolerance = 2e-10;

  struct Setup
  {
    unsigned int  seed;
    unsigned int  degree;
    PlaneState    plane_state;
    Stabilization stabilization;
  };

  // The pentagon with three random closed joints or interfaces, some ending
  // inside, all tied; the exact field given on the boundary.
  void
  check_tied(const Setup &setup)
  {
    SCOPED_TRACE("seed " + std::to_string(setup.seed) + ", degree " +
                 std::to_string(setup.degree));
    std::mt19937                           generator(setup.seed);
    std::uniform_real_distribution<double> random(0., 1.);

    Geometry geometry;
    geometry.add_polygon(pentagon, "outline");
    for (unsigned int j = 0; j < 3; ++j)
    {
      std::vector<Point<2>> joint;
      for (unsigned int v = 0; v < 3; ++v)
        joint.emplace_back(-0.1 + 1.3 * random(generator),
                           1.2 * random(generator));
      geometry.add_polyline(joint,
                            "joint " + std::to_string(j),
                            j == 0 ? CurveRole::interface : CurveRole::joint,
                            JointState::closed);
    }
    Model model(std::move(geometry),
                mesh_parameters(0.17,
                                Tensor<1, 2>({0.17 * random(generator),
                                              0.17 * random(generator)}),
                                60. * random(generator)),
                setup.degree,
                setup.stabilization);

    const QuadraticField exact = random_field(generator, setup.degree);
    model.problem.plane_state  = setup.plane_state;
    model.problem.materials    = {material("rock", 1000., 0.3)};
    // constant initial stress must not disturb, ties included
    model.problem.materials[0].initial_stress[0][0] = -300.;
    model.problem.materials[0].initial_stress[0][1] = 100.;
    const PlaneElasticity elasticity =
      model.problem.materials[0].plane_elasticity(setup.plane_state);
    const Tensor<1, 2> f     = exact.body_force(elasticity);
    model.problem.body_force = vector_function([f](const auto &) { return f; });
    model.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement,
                "outline",
                vector_function([&exact](const Point<2> &x) {
                  return exact.displacement(x);
                }))};
    model.solve();

    const ErrorNorms errors = compute_errors(
      *model.field,
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) {
        return elasticity.stress(exact.gradient(x)) +
               model.problem.materials[0].initial_stress;
      });
    EXPECT_LT(errors.displacement, tolerance);
    // one derivative costs a factor 1/h
    EXPECT_LT(errors.stress, 100. * tolerance);
  }
} // namespace


TEST(PatchTest, TiedJointsPlaneStressMPI)
{
  for (unsigned int seed = 1; seed <= 12; ++seed)
    for (const unsigned int degree : {1, 2})
      check_tied(
        {seed, degree, PlaneState::plane_stress, Stabilization::aggregation});
}


TEST(PatchTest, TiedJointsPlaneStrain)
{
  for (unsigned int seed = 101; seed <= 106; ++seed)
    for (const unsigned int degree : {1, 2})
      check_tied(
        {seed, degree, PlaneState::plane_strain, Stabilization::aggregation});
}


// Open joints parallel to a uniaxial stress carry no traction anyway: cracks
// inside, a through joint, and each block held on its own.
TEST(PatchTest, OpenJointsAlongUniaxialStressMPI)
{
  for (unsigned int seed = 1; seed <= 8; ++seed)
    for (const unsigned int degree : {1, 2})
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", degree " +
                   std::to_string(degree));
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> random(0., 1.);
      Geometry                               geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      const double through = 0.45 + 0.1 * random(generator);
      geometry.add_polyline({{through, -0.1}, {through, 1.1}},
                            "through",
                            CurveRole::joint);
      for (const double x : {0.2, 0.75})
      {
        const double xx = x + 0.1 * random(generator);
        geometry.add_polyline({{xx, 0.2 * random(generator)},
                               {xx, 0.7 + 0.2 * random(generator)}},
                              "crack at " + std::to_string(xx),
                              CurveRole::joint);
      }
      Model        model(std::move(geometry),
                  mesh_parameters(0.13,
                                  Tensor<1, 2>({0.13 * random(generator),
                                                       0.13 * random(generator)}),
                                  60. * random(generator)),
                  degree);
      const double E = 1000., nu = 0.3, stress = 50.;
      model.problem.materials = {material("rock", E, nu)};
      const auto exact        = [=](const Point<2> &x) {
        return Tensor<1, 2>({-nu * stress / E * x[0], stress / E * x[1]});
      };
      model.problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement,
                  "bottom",
                  vector_function(exact)),
        condition(BoundaryCondition::Type::traction,
                  "top",
                  vector_function([=](const Point<2> &) {
                    return Tensor<1, 2>({0., stress});
                  }))};
      model.solve();
      const ErrorNorms errors =
        compute_errors(*model.field, exact, [=](const Point<2> &) {
          SymmetricTensor<2, 2> s;
          s[1][1] = stress;
          return s;
        });
      EXPECT_LT(errors.displacement, tolerance);
      EXPECT_LT(errors.stress, 100. * tolerance);
    }
}


// Without aggregation slivers make the system ill-conditioned, but the method
// stays consistent and coercive: cuts that are not extreme must still be exact.
TEST(PatchTest, WithoutAggregation)
{
  for (unsigned int seed = 201; seed <= 204; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(0., 1.);
    Geometry                               geometry;
    geometry.add_polygon(pentagon, "outline");
    Model                model(std::move(geometry),
                mesh_parameters(0.3,
                                Tensor<1, 2>({0.3 * random(generator),
                                                             0.3 * random(generator)}),
                                60. * random(generator)),
                2,
                Stabilization::none);
    const QuadraticField exact = random_field(generator, 2);
    model.problem.materials    = {material()};
    const PlaneElasticity elasticity =
      model.problem.materials[0].plane_elasticity(PlaneState::plane_stress);
    const Tensor<1, 2> f     = exact.body_force(elasticity);
    model.problem.body_force = vector_function([f](const auto &) { return f; });
    model.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement,
                "outline",
                vector_function([&exact](const Point<2> &x) {
                  return exact.displacement(x);
                }))};
    model.solve();
    const ErrorNorms errors = compute_errors(
      *model.field,
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) { return elasticity.stress(exact.gradient(x)); });
    // the condition number grows with the inverse square of the smallest
    // thickness, here some 1e-3 of a cell
    EXPECT_LT(errors.displacement, 1e-8);
  }
}


// A rigid motion of every block, small rotation included, has no stress.
TEST(PatchTest, RigidMotionHasNoStressMPI)
{
  Geometry geometry;
  geometry.add_polygon(pentagon, "outline");
  geometry.add_polyline({{0.2, 0.3}, {0.8, 0.7}}, "crack", CurveRole::joint);
  Model model(std::move(geometry), mesh_parameters(0.15, {}, 20.), 2);
  model.problem.materials = {material("rock", 1000., 0.3)};
  const auto rigid        = [](const Point<2> &x) {
    return Tensor<1, 2>({0.3 - 0.01 * x[1], -0.2 + 0.01 * x[0]});
  };
  model.problem.boundary_conditions = {condition(
    BoundaryCondition::Type::displacement, "outline", vector_function(rigid))};
  model.solve();
  const ErrorNorms errors =
    compute_errors(*model.field, rigid, [](const Point<2> &) {
      return SymmetricTensor<2, 2>();
    });
  EXPECT_LT(errors.displacement, tolerance);
  // absolute: E times the rounding of a gradient
  EXPECT_LT(errors.stress, 1000. * 100. * tolerance);
}
