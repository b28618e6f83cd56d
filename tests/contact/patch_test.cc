// Contact patch test: blocks with unrelated meshes under uniform stress. What is
// uniform must stay so across straight and inclined interfaces.

#include <nmm/materials/material.h>

#include <contact/contact_model.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  constexpr double young = 1000., load = 1.;

  struct Case
  {
    std::string  name;
    unsigned int degree    = 2;
    bool         is_small  = true;
    bool         augmented = false;
    bool         own_mesh  = true;
    unsigned int n_blocks  = 2;
    /// The upper blocks carry the contact points.
    bool upper_is_slave = false;
  };


  std::string
  describe(const Case &c)
  {
    return c.name + ", degree " + std::to_string(c.degree) +
           (c.is_small ? ", small" : ", finite") +
           (c.augmented ? ", augmented" : ", penalty") +
           (c.own_mesh ? ", own meshes" : ", one mesh") + ", " +
           std::to_string(c.n_blocks) + " blocks" +
           (c.upper_is_slave ? ", upper slave" : "");
  }


  ContactParameters
  parameters_of(const Case &c, const Bodies &bodies)
  {
    ContactParameters parameters = contact_parameters(10. * young / 0.3);
    if (c.augmented)
      parameters.penetration_tolerance = 1e-13;
    parameters.slave_priority.resize(bodies.physical_mesh.n_blocks());
    std::vector<double> heights(parameters.slave_priority.size(), 0.);
    // ranks by height
    for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
      heights[bodies.mesh.block(e)] =
        std::max(heights[bodies.mesh.block(e)], bodies.inner_point(e)[1]);
    for (unsigned int b = 0; b < heights.size(); ++b)
      for (unsigned int a = 0; a < heights.size(); ++a)
        parameters.slave_priority[b] +=
          c.upper_is_slave ? heights[a] > heights[b] : heights[a] < heights[b];
    return parameters;
  }


  NewtonParameters
  newton_parameters()
  {
    NewtonParameters newton = ContactStatics::default_newton_parameters();
    // gaps are known to 2e-16 m, times the spring's stiffness: 1e-11 of the load
    newton.residual_tolerance = 1e-10;
    return newton;
  }


  /// Blocks in a box (0,0)-(2,2), divided by joints at the slope @p slope.
  std::unique_ptr<Bodies>
  jointed_column(const Case &c, const double slope)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 2.});
    for (unsigned int i = 1; i < c.n_blocks; ++i)
    {
      const double y = 2. * i / c.n_blocks + 0.013;
      geometry.add_polyline({{-0.1, y - 1.1 * slope}, {2.1, y + 1.1 * slope}},
                            "joint" + std::to_string(i),
                            CurveRole::joint,
                            JointState::open);
    }
    Bodies::Options options;
    options.degree              = c.degree;
    options.mesh_of_every_block = c.own_mesh;
    options.rotation            = 17.;
    options.cell_size           = 0.41;
    auto bodies = std::make_unique<Bodies>(std::move(geometry), options);
    for (Material &m : bodies->problem.materials)
      m.law = c.is_small ? m.law : material_law("neo-Hookean");
    return bodies;
  }


  SymmetricTensor<2, 2>
  stress(const double xx, const double yy)
  {
    SymmetricTensor<2, 2> result;
    result[0][0] = xx;
    result[1][1] = yy;
    return result;
  }


  /// Stress or gradients that should be uniform, relative to the load's.
  double
  relative_error(const Case                  &c,
                 const Bodies                &bodies,
                 const SymmetricTensor<2, 2> &expected)
  {
    return c.is_small ? bodies.stress_error(expected) / load
                      : bodies.gradient_spread() / (load / young);
  }


  std::vector<Case>
  all_cases(const std::string &name)
  {
    std::vector<Case> cases;
    for (const unsigned int degree : {1U, 2U})
      for (const bool is_small : {true, false})
        for (const bool augmented : {false, true})
          for (const bool own_mesh : {false, true})
            for (const bool upper : {false, true})
            {
              Case c;
              c.name           = name;
              c.degree         = degree;
              c.is_small       = is_small;
              c.augmented      = augmented;
              c.own_mesh       = own_mesh;
              c.upper_is_slave = upper;
              c.n_blocks       = upper ? 3 : 2;
              cases.push_back(c);
            }
    return cases;
  }


  TEST(ContactPatch, HorizontalJointsUnderPressure)
  {
    for (const Case &c : all_cases("horizontal"))
    {
      SCOPED_TRACE(describe(c));
      auto bodies                         = jointed_column(c, 0.);
      bodies->problem.boundary_conditions = {
        condition(Type::normal_displacement, "bottom"),
        condition(Type::pressure, "top", constant(load))};
      for (unsigned int i = 0; i < c.n_blocks; ++i)
        bodies->problem.fixed_points.push_back(
          guide({1., 2. * (i + 0.5) / c.n_blocks}, true));
      bodies->start(parameters_of(c, *bodies), c.is_small, newton_parameters());
      const auto steps = bodies->statics->run(LoadSteps::equal(1));
      // the law is that of plane strain: lateral stress is zero all the same
      const double error = relative_error(c, *bodies, stress(0., -load));
      EXPECT_LE(error, 1e-8);
      std::cout << describe(c) << ": " << error << " in "
                << steps.back().n_iterations << " iterations, penetration "
                << steps.back().contact.largest_penetration << std::endl;
    }
  }


  TEST(ContactPatch, InclinedJointsUnderHydrostaticPressure)
  {
    for (const Case &c : all_cases("hydrostatic"))
    {
      SCOPED_TRACE(describe(c));
      auto bodies                         = jointed_column(c, 0.3);
      bodies->problem.boundary_conditions = {
        condition(Type::normal_displacement, "bottom"),
        condition(Type::normal_displacement, "left"),
        condition(Type::pressure, "right", constant(load)),
        condition(Type::pressure, "top", constant(load))};
      bodies->start(parameters_of(c, *bodies), c.is_small, newton_parameters());
      const auto   steps = bodies->statics->run(LoadSteps::equal(1));
      const double error = relative_error(c, *bodies, stress(-load, -load));
      // springs let the blocks slide by 3e-5 of 0.4 at their corners
      EXPECT_LE(error, c.augmented ? 1e-8 : 1e-3);
      // a point that penetrates presses like its spring: none is listed that has no
      // share of the contact
      const double spring = bodies->contact->parameters().law->normal_stiffness;
      if (!c.augmented)
        for (const ContactPoint &point : bodies->contact->points())
          if (point.master != invalid_index && point.gap < 0.)
          {
            EXPECT_NEAR(point.pressure, -spring * point.gap, 1e-6 * load)
              << point.edge;
          }
      std::cout << describe(c) << ": " << error << " in "
                << steps.back().n_iterations << " iterations, penetration "
                << steps.back().contact.largest_penetration << std::endl;
    }
  }


  TEST(ContactPatch, InclinedJointsWithFriction)
  {
    for (const Case &c : all_cases("friction"))
    {
      SCOPED_TRACE(describe(c));
      auto bodies                         = jointed_column(c, 0.3);
      bodies->problem.boundary_conditions = {
        condition(Type::normal_displacement, "bottom"),
        condition(Type::pressure, "top", constant(load))};
      bodies->problem.fixed_points = {guide({1., 0.1}, true)};
      ContactParameters parameters = parameters_of(c, *bodies);
      coulomb(parameters).friction = 0.5;
      // shear has no multipliers: the elastic slip of 1e-5 moves the blocks'
      // corners apart, 3e-5 of a cell
      NewtonParameters newton = newton_parameters();
      if (c.augmented)
      {
        parameters.penetration_tolerance = 1e-11;
        newton.residual_tolerance        = 1e-9;
      }
      bodies->start(parameters, c.is_small, newton);
      const auto   steps = bodies->statics->run(LoadSteps::equal(1));
      const double error = relative_error(c, *bodies, stress(0., -load));
      EXPECT_LE(error, 1e-3);
      std::cout << describe(c) << ": " << error << " in "
                << steps.back().n_iterations << " iterations, penetration "
                << steps.back().contact.largest_penetration << std::endl;
    }
  }


  /// Boxes whose meshes and edges have nothing in common, with a gap between
  /// them that the upper one's top closes.
  TEST(ContactPatch, SeparateBoxesThatCloseAGap)
  {
    for (const Case &c : all_cases("gap"))
      if (c.n_blocks == 2 || c.own_mesh)
      {
        SCOPED_TRACE(describe(c));
        constexpr double gap = 0.01;
        Geometry         geometry;
        add_named_box(geometry, "lower ", {0., 0.}, {2., 1.});
        add_named_box(geometry, "upper ", {0., 1. + gap}, {2., 2. + gap});
        Bodies::Options options;
        options.degree              = c.degree;
        options.mesh_of_every_block = c.own_mesh;
        options.rotation            = 17.;
        options.cell_size           = 0.41;
        Bodies bodies(std::move(geometry), options);
        for (Material &m : bodies.problem.materials)
          m.law = c.is_small ? m.law : material_law("neo-Hookean");
        bodies.problem.boundary_conditions = {
          condition(Type::normal_displacement, "lower bottom"),
          condition(Type::normal_displacement,
                    "upper top",
                    constant(-gap - 2. * load / young))};
        bodies.problem.fixed_points = {guide({1., 0.1}, true),
                                       guide({1., 1.9}, true)};
        bodies.start(parameters_of(c, bodies), c.is_small, newton_parameters());
        const auto   steps = bodies.statics->run(LoadSteps::equal(1));
        const double error = bodies.gradient_spread() / (load / young);
        EXPECT_LE(error, 1e-8);
        std::cout << describe(c) << ": " << error << " in "
                  << steps.back().n_iterations << " iterations, penetration "
                  << steps.back().contact.largest_penetration << std::endl;
      }
  }


  /// Static contact keeps the rule of statics without: a solution whose conditions are missed by
  /// more than LoadSteps::max_jump is none.
  TEST(ContactPatch, MissedConditionsAreRefused)
  {
    const auto solve = [](const double max_jump) {
      Case c;
      c.is_small                          = false;
      c.n_blocks                          = 2;
      auto bodies                         = jointed_column(c, 0.);
      bodies->problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "bottom"),
        condition(BoundaryCondition::Type::displacement,
                  "top",
                  vector_function([](auto &) {
                    return Tensor<1, 2>({0., -0.02});
                  }))};
      bodies->start(parameters_of(c, *bodies), c.is_small);
      LoadSteps steps;
      steps.max_jump = max_jump;
      steps.min_step = 0.5;
      return bodies->statics->run(steps).size();
    };
    EXPECT_EQ(solve(0.5), 1u);
    EXPECT_THROW(solve(1e-12), NumericalFailure);
  }
} // namespace
