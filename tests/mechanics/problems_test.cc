// Problems with closed solutions: gravity, point forces, fixed points,
// interfaces.

#include <nmm/mechanics/thick_ring.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A column between smooth walls.
  Geometry
  column(const double height)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., height});
    return geometry;
  }
} // namespace


// A column under its own weight between smooth walls, plane strain: quadratic,
// hence exact. sigma_yy = -rho g (H - y), u_y = -rho g (H y - y^2 / 2) / M with
// M = lambda + 2 mu.
TEST(Problems, GravityColumnMPI)
{
  Model model(column(2.), mesh_parameters(0.23, {}, 11.), 2);
  model.problem.plane_state = PlaneState::plane_strain;
  model.problem.materials   = {material("rock", 1e9, 0.25, 2500.)};
  model.problem.gravity     = Tensor<1, 2>({0., -9.81});
  for (const char *side : {"left", "right", "bottom"})
    model.problem.boundary_conditions.push_back(
      condition(normal_displacement, side));
  model.solve();

  const double     lambda = 1e9 * 0.25 / (1.25 * 0.5), mu = 1e9 / 2.5;
  const double     weight = 2500. * 9.81, M = lambda + 2. * mu;
  const ErrorNorms errors = compute_errors(
    *model.field,
    [=](const Point<2> &x) {
      return Tensor<1, 2>({0., -weight * (2. * x[1] - x[1] * x[1] / 2.) / M});
    },
    [=](const Point<2> &x) {
      SymmetricTensor<2, 2> s;
      s[1][1] = -weight * (2. - x[1]);
      s[0][0] = s[1][1] * lambda / M;
      return s;
    });
  EXPECT_LT(errors.displacement, 1e-9);
  EXPECT_LT(errors.stress, 1e-8);
}


// The same column in two blocks of one material, the joint closed.
TEST(Problems, ClosedJointCarriesWeight)
{
  Geometry geometry = column(2.);
  geometry.add_polyline({{-0.1, 0.8}, {1.1, 1.1}},
                        "bed",
                        CurveRole::joint,
                        JointState::closed);
  Model model(std::move(geometry), mesh_parameters(0.23, {}, 11.), 2);
  model.problem.plane_state = PlaneState::plane_strain;
  model.problem.materials   = {material("rock", 1e9, 0.25, 2500.)};
  model.problem.gravity     = Tensor<1, 2>({0., -9.81});
  for (const char *side : {"left", "right", "bottom"})
    model.problem.boundary_conditions.push_back(
      condition(normal_displacement, side));
  model.solve();
  const double weight = 2500. * 9.81, M = 1e9 * 0.25 / (1.25 * 0.5) + 2e9 / 2.5;
  EXPECT_NEAR(model.displacement({0.4, 1.6})[1] /
                (-weight * (2. * 1.6 - 1.28) / M),
              1.,
              1e-9);
}


// Tension of two materials in a row, stiffness 1 : 1e6, interface oblique to
// the mesh. With nu = 0 the bar is one-dimensional and piecewise linear.
TEST(Problems, InterfaceWithContrast)
{
  for (const double contrast : {1e-6, 1., 1e6})
    for (const unsigned int degree : {1, 2})
    {
      SCOPED_TRACE("contrast " + std::to_string(contrast) + ", degree " +
                   std::to_string(degree));
      Geometry geometry = column(2.);
      geometry.add_polyline({{-0.1, 0.9}, {1.1, 0.9}},
                            "contact",
                            CurveRole::interface);
      geometry.add_material_point({0.5, 0.5}, "lower");
      geometry.add_material_point({0.5, 1.5}, "upper");
      Model model(std::move(geometry), mesh_parameters(0.21, {}, 17.), degree);
      model.problem.materials           = {material("lower", 1000., 0.),
                                           material("upper", 1000. * contrast, 0.)};
      model.problem.boundary_conditions = {
        condition(normal_displacement, "bottom"),
        condition(normal_displacement, "left"),
        condition(BoundaryCondition::Type::traction,
                  "top",
                  vector_function([](const Point<2> &) {
                    return Tensor<1, 2>({0., 10.});
                  }))};
      model.solve();
      const ErrorNorms errors = compute_errors(
        *model.field,
        [=](const Point<2> &x) {
          return Tensor<1, 2>({0.,
                               0.01 * std::min(x[1], 0.9) +
                                 0.01 / contrast * std::max(x[1] - 0.9, 0.)});
        },
        [](const Point<2> &) {
          SymmetricTensor<2, 2> s;
          s[1][1] = 10.;
          return s;
        });
      // the condition number grows by the contrast
      EXPECT_LT(errors.displacement, contrast == 1. ? 1e-10 : 1e-7);
      EXPECT_LT(errors.stress, contrast == 1. ? 1e-8 : 1e-5);
    }
}


// A ring of two layers, inner radius 1, interface c, outer radius 2: pressure q
// at the interface from equal displacements of both layers (Lame).
TEST(Problems, TwoLayerRing)
{
  for (const double contrast : {10., 1e6})
  {
    SCOPED_TRACE("contrast " + std::to_string(contrast));
    const double a = 1., b = 2., c = 1.43;
    Geometry     geometry = quarter_ring(a, b);
    const double s        = std::sqrt(0.5);
    geometry.add(
      single_piece_curve("layer",
                         CurvePiece::arc({c, 0}, {c * s, c * s}, {0, c}),
                         CurveRole::interface));
    geometry.add_material_point({1.2 * s, 1.2 * s}, "inner layer");
    geometry.add_material_point({1.8 * s, 1.8 * s}, "outer layer");
    Model model(std::move(geometry), mesh_parameters(0.05, {}, 13.), 2);
    model.problem.materials           = {material("inner layer", 1000.),
                                         material("outer layer", 1000. * contrast)};
    model.problem.boundary_conditions = {
      condition(normal_displacement, "bottom"),
      condition(normal_displacement, "left"),
      condition(BoundaryCondition::Type::pressure, "inner", constant(1.))};
    model.solve();

    // u(r) = A r + B / r per layer; sigma_r = 2 (lambda + mu) A - 2 mu B / r^2
    const PlaneElasticity e1 = model.problem.materials[0].plane_elasticity(
                            PlaneState::plane_stress),
                          e2 = model.problem.materials[1].plane_elasticity(
                            PlaneState::plane_stress);
    const auto coefficients = [](const PlaneElasticity &e,
                                 const double           r0,
                                 const double           r1,
                                 const double           p0,
                                 const double           p1) {
      const double A = (p0 * r0 * r0 - p1 * r1 * r1) / (r1 * r1 - r0 * r0) /
                       (2. * (e.lambda + e.mu));
      const double B =
        (p0 - p1) * r0 * r0 * r1 * r1 / (r1 * r1 - r0 * r0) / (2. * e.mu);
      return std::make_pair(A, B);
    };
    const auto u_at_c = [&](const std::pair<double, double> &AB) {
      return AB.first * c + AB.second / c;
    };
    // linear in q
    const double u1_0  = u_at_c(coefficients(e1, a, c, 1., 0.)),
                 u1_1  = u_at_c(coefficients(e1, a, c, 1., 1.)),
                 u2_1  = u_at_c(coefficients(e2, c, b, 1., 0.));
    const double q     = u1_0 / (u1_0 - u1_1 + u2_1);
    const auto   inner = coefficients(e1, a, c, 1., q),
               outer   = coefficients(e2, c, b, q, 0.);
    const auto layer   = [&](const double r) { return r < c ? inner : outer; };
    const ErrorNorms errors = compute_errors(
      *model.field,
      [&](const Point<2> &x) {
        const double r = x.norm();
        return Tensor<1, 2>((layer(r).first + layer(r).second / (r * r)) * x);
      },
      [&](const Point<2> &x) {
        const double           r    = x.norm();
        const PlaneElasticity &e    = r < c ? e1 : e2;
        const double           mean = 2. * (e.lambda + e.mu) * layer(r).first,
                     deviation      = 2. * e.mu * layer(r).second / (r * r);
        // sigma_r = mean - deviation, sigma_theta = mean + deviation
        const Tensor<1, 2>    n = x / r;
        SymmetricTensor<2, 2> sigma;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = i; j < 2; ++j)
            sigma[i][j] =
              (i == j ? mean + deviation : 0.) - 2. * deviation * n[i] * n[j];
        return sigma;
      });
    // the homogeneous ring at this mesh size has 3e-6 and 6e-4; here the
    // displacement goes down to a stiff layer, and its norm with it
    EXPECT_LT(errors.displacement, 2e-5);
    EXPECT_LT(errors.stress, 2e-3);
  }
}


// A square held by springs at three points so that it is statically determinate:
// reactions follow from equilibrium, spring displacements from reactions.
TEST(Problems, FixedPointsAndPointForceMPI)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 1.});
  Model model(std::move(geometry), mesh_parameters(0.21, {}, 7.), 2);
  model.problem.materials = {material("rock", 1e5, 0.2)};
  FixedPoint left, right;
  left.point                 = {0.2, 0.1};
  left.stiffness             = 300.;
  left.displacement          = Tensor<1, 2>({0.01, -0.02});
  right.point                = {0.8, 0.1};
  right.stiffness            = 500.;
  right.components[0]        = false;
  model.problem.fixed_points = {left, right};
  PointForce force;
  force.point                = {0.65, 0.9};
  force.force                = Tensor<1, 2>({3., -12.});
  model.problem.point_forces = {force};
  model.solve();

  // moments about the left point; the force's arm is (0.45, 0.8)
  const double moment = 0.45 * -12. - 0.8 * 3.;
  // support forces on the body, F = stiffness * (displacement - u)
  const double right_y = -moment / 0.6, left_y = 12. - right_y, left_x = -3.;
  const auto   owns = [&](const Point<2> &x) {
    const unsigned int e     = model.manifold_mesh.find_element(x);
    const auto [first, last] = model.covers.locally_owned_elements();
    return e >= first && e < last;
  };
  // equilibrium of the discrete solution is exact
  if (owns(left.point))
  {
    EXPECT_NEAR(model.displacement(left.point)[0], 0.01 - left_x / 300., 1e-9);
    EXPECT_NEAR(model.displacement(left.point)[1], -0.02 - left_y / 300., 1e-9);
  }
  if (owns(right.point))
  {
    EXPECT_NEAR(model.displacement(right.point)[1], -right_y / 500., 1e-9);
  }
}


// Initial stress relaxes when the sides are let go: uniform expansion.
TEST(Problems, InitialStressRelaxes)
{
  Model model(column(1.), mesh_parameters(0.3, {}, 5.), 1);
  model.problem.materials = {material("rock", 1000., 0.25)};
  model.problem.materials[0].initial_stress[0][0] = -20.;
  model.problem.boundary_conditions = {condition(normal_displacement, "bottom"),
                                       condition(normal_displacement, "left")};
  model.solve();
  // total stress 0: E eps_xx = 20, eps_yy = -nu eps_xx
  const Tensor<1, 2> u = model.displacement({0.9, 0.7});
  EXPECT_NEAR(u[0], 0.02 * 0.9, 1e-12);
  EXPECT_NEAR(u[1], -0.25 * 0.02 * 0.7, 1e-12);
  EXPECT_LT(model.stress({0.5, 0.5}).norm(), 1e-9);
}
