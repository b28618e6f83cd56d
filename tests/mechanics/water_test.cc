#include <nmm/mechanics/water.h>

#include <deal.II/base/function_lib.h>

#include "model.h"
#include <gtest/gtest.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/edge_tables.h>
#include <mechanics/point_terms.h>

using namespace NMM;
using namespace NMM::Test;

// The loads of water: pressure below a table, on outer faces, in joints, and in pores.
namespace
{
  constexpr double gamma_w = 9810.;

  std::shared_ptr<const dealii::Function<2>>
  below(const std::vector<Point<2>> &line)
  {
    return hydrostatic_pressure({line_by_points(line, "table"), gamma_w});
  }


  /// A block of 3 by 2 with its lower left corner in (1, 1), turned by 20 degrees, and an open and a
  /// tied joint through it.
  std::unique_ptr<Model>
  turned_block()
  {
    const double c = std::cos(0.35), s = std::sin(0.35);
    const auto   at = [&](const double x, const double y) {
      return Point<2>(1. + c * x - s * y, 1. + s * x + c * y);
    };
    const Point<2> corners[4] = {at(0, 0), at(3, 0), at(3, 2), at(0, 2)};
    Geometry       geometry;
    for (unsigned int i = 0; i < 4; ++i)
      geometry.add(single_piece_curve(
        i == 0 ? "base" : "rim",
        CurvePiece::segment(corners[i], corners[(i + 1) % 4])));
    geometry.add(single_piece_curve(
      "open", CurvePiece::segment(at(1.3, -1), at(1.3, 3)), CurveRole::joint));
    Curve tied = single_piece_curve("tied",
                                    CurvePiece::segment(at(-1, 1), at(4, 1)),
                                    CurveRole::joint);
    tied.state = JointState::closed;
    geometry.add(tied);
    auto model                 = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.8, {}, 7.),
                                         2);
    model->problem.plane_state = PlaneState::plane_strain;
    model->problem.materials   = {material("rock", 1e9, 0.25, 2000.)};
    model->problem.gravity     = Tensor<1, 2>({0., -10.});
    return model;
  }


  /// The resultant of each boundary condition and, last, of the weight, on all blocks or on those
  /// with the first or second half along the base.
  std::vector<Tensor<1, 2>>
  resultants(const Model &model)
  {
    const internal::CurveConditions conditions(model.manifold_mesh,
                                               model.problem);
    const internal::PointTerms      points(model.covers, model.problem);
    internal::DeadLoads             loads(
      model.covers, *model.quadrature, model.problem, conditions, points);
    std::vector<internal::DeadLoads::Load> all = loads.boundary_conditions;
    all.push_back(loads.gravity);
    std::vector<Tensor<1, 2>> result;
    for (const internal::DeadLoads::Load &load : all)
    {
      Tensor<1, 2> sum;
      for (const Tensor<1, 2> &force : load.forces)
        sum += force;
      result.push_back(sum);
    }
    return result;
  }


  void
  expect_near(const Tensor<1, 2> &a,
              const Tensor<1, 2> &b,
              const double        tolerance)
  {
    EXPECT_NEAR(a[0], b[0], tolerance);
    EXPECT_NEAR(a[1], b[1], tolerance);
  }
} // namespace


TEST(Water, PressureGrowsBelowTheTable)
{
  const auto p = below({{0., 4.}, {10., 9.}});
  EXPECT_EQ(p->value({-3., 1.}), gamma_w * 3.);
  EXPECT_EQ(p->value({-3., 5.}), 0.);
  EXPECT_NEAR(p->value({4., 2.}), gamma_w * 4., 1e-10);
  EXPECT_EQ(p->value({12., 2.}), gamma_w * 7.);
  // slope of the table 1/2; the difference over 1e-6 has a rounding of 1e-9
  expect_near(p->gradient({4., 2.}), Tensor<1, 2>({0.5, -1.}) * gamma_w, 1e-4);
  EXPECT_EQ(p->gradient({4., 7.}).norm(), 0.);
  EXPECT_THROW(line_by_points({{1., 2.}, {1., 3.}}, "table"), InputError);
}


TEST(Water, LiftsASubmergedBlockByItsVolume)
{
  const auto model = turned_block();
  Water      water;
  water.table = water.in_joints = below({{0., 7.}});
  add_water(water, model->physical_mesh, Kinematics::small, model->problem);
  const auto R = resultants(*model);
  ASSERT_EQ(R.size(), 3u);
  // sums of forces of the order of 1e5, to rounding
  constexpr double tolerance = 1e-8;
  expect_near(R[0], Tensor<1, 2>({0., gamma_w * 6.}), tolerance);
  expect_near(R[1], Tensor<1, 2>(), tolerance);
  expect_near(R[2], Tensor<1, 2>({0., -2000. * 10. * 6.}), tolerance);
}


TEST(Water, PressesOnNamedFacesOnly)
{
  const auto model = turned_block();
  Water      water;
  water.table                        = below({{0., 7.}});
  model->problem.boundary_conditions = {
    condition(BoundaryCondition::Type::displacement, "base")};
  {
    // the base is held
    ElasticityProblem problem = model->problem;
    add_water(water, model->physical_mesh, Kinematics::finite, problem);
    ASSERT_EQ(problem.boundary_conditions.size(), 2u);
    EXPECT_EQ(problem.boundary_conditions[1].type,
              BoundaryCondition::Type::follower_pressure);
    for (const std::string &name : *problem.boundary_conditions[1].curves)
      EXPECT_EQ(name, "rim");
    EXPECT_NO_THROW(problem.check(model->physical_mesh));
  }
  water.faces = {"base"};
  add_water(water, model->physical_mesh, Kinematics::small, model->problem);
  // mean pressure times area along the inward normal
  const double c = std::cos(0.35), s = std::sin(0.35);
  const double p = gamma_w * (7. - 1. - 1.5 * s);
  expect_near(resultants(*model)[1], 3. * p * Tensor<1, 2>({-s, c}), 1e-8);
  water.faces = {"open"};
  EXPECT_THROW(
    add_water(water, model->physical_mesh, Kinematics::small, model->problem),
    InputError);
}


TEST(Water, InPoresExertsBuoyancyAndSeepage)
{
  const auto model                        = turned_block();
  model->problem.materials[0].wet_density = 2300.;
  const ElasticityProblem dry             = model->problem;
  Water                   water;
  water.fills_pores = true;
  water.table = water.in_joints = below({{0., 7.}, {10., 9.}});
  add_water(water, model->physical_mesh, Kinematics::small, model->problem);
  // faces and joints are free, since their pressure is that in pores
  ASSERT_EQ(model->problem.boundary_conditions.size(), 0u);
  // the difference of the table has a relative rounding of 1e-9
  expect_near(resultants(*model).back(),
              6. * Tensor<1, 2>({-0.2 * gamma_w, gamma_w - 2300. * 10.}),
              1e-4);
  // a drain in the joint takes the difference
  model->problem  = dry;
  water.in_joints = std::make_shared<dealii::Functions::ZeroFunction<2>>();
  add_water(water, model->physical_mesh, Kinematics::small, model->problem);
  ASSERT_EQ(model->problem.boundary_conditions.size(), 1u);
  const Point<2> x(2., 3.);
  EXPECT_EQ(model->problem.boundary_conditions[0].value->value(x),
            -water.table->value(x));
}
