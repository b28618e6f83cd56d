// Loads and supports on a side that two domains share act on the domain whose boundary
// bears their name.

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  constexpr double modulus = 1e3, pressure = 1e-3, lift = pressure / modulus;

  enum class Overlap
  {
    full,
    partial
  };


  /// A box with its sides named after @p name.
  void
  add_domain(Geometry          &geometry,
             const std::string &name,
             const Point<2>    &lower,
             const Point<2>    &upper)
  {
    Geometry box;
    add_box(box, lower, upper);
    for (Curve curve : box.curves())
    {
      curve.name = name + "." + curve.name;
      geometry.add(std::move(curve));
    }
  }


  /// A unit square and one on it, or half beside it. No Poisson's ratio, so that each
  /// is in uniaxial stress when it is pressed between its top and its bottom.
  std::unique_ptr<Model>
  two_squares(const Overlap overlap, const bool lower_is_first)
  {
    const double left = overlap == Overlap::full ? 0. : 0.4;
    Geometry     geometry;
    for (const bool is_lower : {lower_is_first, !lower_is_first})
      if (is_lower)
        add_domain(geometry, "lower", {0., 0.}, {1., 1.});
      else
        add_domain(geometry, "upper", {left, 1.}, {left + 1., 2.});
    auto model               = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.6, {}, 11.),
                                         2,
                                         Stabilization::aggregation,
                                         MPI_COMM_WORLD);
    model->problem.materials = {material("rock", modulus, 0., 1.)};
    return model;
  }


  template <typename F>
  void
  for_each_arrangement(const F &f)
  {
    for (const Overlap overlap : {Overlap::full, Overlap::partial})
      for (const bool lower_is_first : {true, false})
      {
        SCOPED_TRACE((overlap == Overlap::full ? "full, " : "partial, ") +
                     std::string(lower_is_first ? "lower" : "upper") +
                     " domain first");
        f(overlap, lower_is_first);
      }
  }


  enum class Method
  {
    small,
    finite
  };


  DisplacementField
  solve(Model &model, const Method method)
  {
    if (method == Method::small)
    {
      model.solve();
      return *model.field;
    }
    const auto       elasticity = finite_elasticity(model);
    NonlinearStatics statics(*elasticity);
    statics.run(LoadSteps::equal(1));
    return {model.covers, model.problem, statics.solution()};
  }


  Tensor<1, 2>
  displacement(const Model             &model,
               const DisplacementField &field,
               const Point<2>          &x)
  {
    const auto [element, xi] = model.locate(x);
    return field.displacement(element, xi);
  }


  /// Of points beside the common side, one in each domain, divided by the lift.
  std::pair<double, double>
  relative_lifts(const Model &model, const DisplacementField &field)
  {
    constexpr double beside = 1e-9;
    return {displacement(model, field, {0.7, 1. - beside})[1] / lift,
            displacement(model, field, {0.7, 1. + beside})[1] / lift};
  }


  BoundaryCondition
  lifted(const std::string &curve, const double height)
  {
    return condition(Type::displacement,
                     curve,
                     vector_function([height](auto &) {
                       return Tensor<1, 2>({0., height});
                     }));
  }
} // namespace


// Strains of 1e-6 make finite displacements differ by so much from small ones.
constexpr double tolerance = 1e-5;

TEST(CommonSides, LoadsActOnTheDomainThatIsNamed)
{
  for_each_arrangement([](const Overlap overlap, const bool lower_is_first) {
    const auto model = two_squares(overlap, lower_is_first);
    for (const Type type :
         {Type::pressure, Type::follower_pressure, Type::traction})
      for (const Method method : {Method::small, Method::finite})
        for (const auto &[lower, upper] : {std::make_pair(true, false),
                                           std::make_pair(false, true),
                                           std::make_pair(true, true)})
        {
          model->problem.boundary_conditions = {
            condition(Type::displacement, "lower.bottom"),
            condition(Type::displacement, "upper.top")};
          const auto press = [&](const std::string &curve, const double push) {
            model->problem.boundary_conditions.push_back(
              type == Type::traction
                ? condition(type, curve, vector_function([push](auto &) {
                              return Tensor<1, 2>({0., push});
                            }))
                : condition(type, curve, constant(pressure)));
          };
          if (lower)
            press("lower.top", -pressure);
          if (upper)
            press("upper.bottom", pressure);
          const auto [below, above] =
            relative_lifts(*model, solve(*model, method));
          EXPECT_NEAR(below, lower ? -1. : 0., tolerance);
          EXPECT_NEAR(above, upper ? 1. : 0., tolerance);
        }
  });
}


TEST(CommonSides, SupportsHoldTheDomainThatIsNamed)
{
  for_each_arrangement([](const Overlap overlap, const bool lower_is_first) {
    const auto model = two_squares(overlap, lower_is_first);
    for (const Method method : {Method::small, Method::finite})
    {
      model->problem.boundary_conditions = {
        condition(Type::displacement, "lower.bottom"),
        lifted("lower.top", -lift),
        condition(Type::displacement, "upper.top")};
      auto lifts = relative_lifts(*model, solve(*model, method));
      EXPECT_NEAR(lifts.first, -1., tolerance);
      EXPECT_NEAR(lifts.second, 0., tolerance);

      // each its own
      model->problem.boundary_conditions.push_back(
        lifted("upper.bottom", 2. * lift));
      lifts = relative_lifts(*model, solve(*model, method));
      EXPECT_NEAR(lifts.first, -1., tolerance);
      EXPECT_NEAR(lifts.second, 2., tolerance);

      // a support of one domain holds no other one
      model->problem.boundary_conditions = {
        condition(Type::displacement, "lower.top")};
      EXPECT_THROW(solve(*model, method), NumericalFailure);
    }
  });
}


// A block under pressure all around on a foundation that does not feel it.
TEST(CommonSides, PressureOnABlockLeavesItsFoundationAlone)
{
  Geometry geometry;
  add_domain(geometry, "ground", {-1., -1.}, {2., 0.});
  geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "block");
  Model model(std::move(geometry), mesh_parameters(0.6, {}, 11.), 2);
  model.problem.materials           = {material("rock", modulus, 0.)};
  model.problem.boundary_conditions = {
    condition(Type::displacement, "ground.bottom"),
    condition(Type::pressure, "block", constant(pressure))};
  const auto fix = [&](const Point<2> &point, const bool x) {
    FixedPoint fixed;
    fixed.point         = point;
    fixed.components[0] = x;
    model.problem.fixed_points.push_back(fixed);
  };
  fix({0.3, 0.5}, true);
  fix({0.7, 0.5}, false);
  const DisplacementField field = solve(model, Method::small);
  // shrinks by p / E in all directions about the line that is held
  EXPECT_NEAR(displacement(model, field, {0.3, 0.9})[1] / lift, -0.4, 1e-8);
  EXPECT_NEAR(displacement(model, field, {0.9, 0.1})[0] / lift, -0.6, 1e-8);
  EXPECT_LT(displacement(model, field, {0.5, -1e-9}).norm() / lift, 1e-8);
}


// A free block gets the momentum of the pressure on it, and the other one none.
TEST(CommonSides, LoadsInMotion)
{
  constexpr double h = 1e-3;
  for_each_arrangement([](const Overlap overlap, const bool lower_is_first) {
    for (const bool presses_lower : {true, false})
      for (const Method method : {Method::small, Method::finite})
      {
        Body body;
        body.model   = two_squares(overlap, lower_is_first);
        Model &model = *body.model;
        model.problem.boundary_conditions = {
          condition(Type::pressure,
                    presses_lower ? "lower.top" : "upper.bottom",
                    constant(pressure))};
        const auto expect_motion = [&](const DisplacementField &field) {
          const Point<2> below(0.5, 0.5), above(0.9, 1.5);
          const double   pressed =
            displacement(model, field, presses_lower ? below : above)[1];
          const Tensor<1, 2> other =
            displacement(model, field, presses_lower ? above : below);
          EXPECT_NE(pressed, 0.);
          EXPECT_LT(other.norm(), 1e-12 * std::abs(pressed));
        };
        const double momentum = (presses_lower ? -1. : 1.) * pressure * h;
        if (method == Method::small)
          body.make_small();
        else
          body.make_finite();
        TimeIntegrator integrator(*body.mechanics,
                                  TimeScheme::energy_momentum());
        integrator.initialize();
        step(integrator, h);
        expect_motion(body.field(integrator.state().u));
        EXPECT_NEAR(integrator.account().linear_momentum[1],
                    momentum,
                    1e-9 * pressure * h);
      }
  });
}


// A support in motion: the upper block stands on nothing and falls, while the lower
// one is held by its top.
TEST(CommonSides, SupportsInMotion)
{
  constexpr double h = 0.1, g = 10.;
  for_each_arrangement([](const Overlap overlap, const bool lower_is_first) {
    for (const bool is_small : {true, false})
    {
      Body body;
      body.model                        = two_squares(overlap, lower_is_first);
      Model &model                      = *body.model;
      model.problem.gravity[1]          = -g;
      model.problem.boundary_conditions = {
        condition(Type::displacement, "lower.top")};
      if (is_small)
        body.make_small();
      else
        body.make_finite();
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      integrator.initialize();
      step(integrator, h);
      const DisplacementField field = body.field(integrator.state().u);
      // a rigid body; the mid-point rule is exact for a constant force
      EXPECT_NEAR(displacement(model, field, {0.7, 1. + 1e-9})[1],
                  -0.5 * g * h * h,
                  1e-9 * g * h * h);
      // a weak condition gives way by about weight over modulus, 1e-2 m on 1e3 Pa/m, at
      // the most
      EXPECT_LT(displacement(model, field, {0.7, 1. - 1e-9}).norm(),
                1e-2 * g * h * h);
    }
  });
}
