// Places where cracks start: exact stresses around a hole and in a corner.

#include <nmm/fracture/crack_start.h>

#include <cmath>
#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Stress [Pa], a function of the point [m].
  using StressField = std::function<SymmetricTensor<2, 2>(const Point<2> &)>;

  /// The places where cracks start in a solid of one material with the given stress.
  std::vector<CrackStart>
  find_starts(const std::string           &text,
              const double                 cell_size,
              const Material              &material,
              const StressField           &stress,
              const double                 spacing,
              const BoundaryCondition     &condition = {},
              const std::vector<Point<2>> &taken     = {})
  {
    RegularMeshParameters mesh;
    mesh.cell_size = cell_size;
    const Model       model(parse_geometry(text, ""), mesh, 2);
    ElasticityProblem problem;
    problem.materials = {material};
    if (!condition.curve.empty())
      problem.boundary_conditions = {condition};
    return find_crack_starts(
      model.covers,
      problem,
      [&](const unsigned int element, const Point<2> &xi) {
        const ManifoldMesh &elements = model.manifold_mesh;
        return stress(
          elements.mathematical_mesh().reference_to_real(elements.cell(element),
                                                         xi));
      },
      spacing,
      taken);
  }


  Material
  rock(const double toughness, const double strength)
  {
    Material result          = material("rock", 1000., 0.3);
    result.toughness         = toughness;
    result.fracture_strength = strength;
    return result;
  }


  /// Components of a tensor that is given in the directions of r and theta at the angle theta.
  SymmetricTensor<2, 2>
  from_polar(const double theta,
             const double rr,
             const double tt,
             const double rt)
  {
    const double          c = std::cos(theta), s = std::sin(theta);
    SymmetricTensor<2, 2> result;
    result[0][0] = rr * c * c + tt * s * s - 2. * rt * s * c;
    result[1][1] = rr * s * s + tt * c * c + 2. * rt * s * c;
    result[0][1] = (rr - tt) * s * c + rt * (c * c - s * s);
    return result;
  }


  const std::string plate_with_hole =
    "boundary name=outline POLYGON ((-3 -3, 3 -3, 3 3, -3 3))\n"
    "hole name=hole CIRCLE (0 0, 1)\n";

  constexpr double load_angle = 0.4;

  /// Kirsch's stress around a hole of radius 1 under a unit tension in the direction of load_angle.
  SymmetricTensor<2, 2>
  kirsch_stress(const Point<2> &x)
  {
    const double r2 = 1. / x.norm_square(), r4 = r2 * r2,
                 theta = std::atan2(x[1], x[0]),
                 two   = 2. * (theta - load_angle);
    return from_polar(theta,
                      0.5 * (1. - r2) +
                        0.5 * (1. - 4. * r2 + 3. * r4) * std::cos(two),
                      0.5 * (1. + r2) - 0.5 * (1. + 3. * r4) * std::cos(two),
                      -0.5 * (1. + 2. * r2 - 3. * r4) * std::sin(two));
  }
} // namespace


TEST(CrackStart, TheMeanAheadOfATipIsTheStrengthAtItsToughness)
{
  // The mean of K (2 pi r)^(-1/2) over L is K (2 / (pi L))^(1/2).
  const Material material = rock(2., 3.);
  const double   mean =
    material.toughness *
    std::sqrt(2. / (dealii::numbers::PI * averaging_length(material)));
  EXPECT_NEAR(mean, material.fracture_strength, 1e-14);
}


TEST(CrackStart, CracksStartOnBothSidesOfAHole)
{
  // L = 0.5 with this toughness.
  const double L      = 0.5;
  const auto material = rock(2. * std::sqrt(0.5 * dealii::numbers::PI * L), 2.);
  const auto starts =
    find_starts(plate_with_hole, 0.3, material, kirsch_stress, 0.5);
  ASSERT_EQ(starts.size(), 2u);
  // The mean of 1 + 1 / (2 r^2) + 3 / (2 r^4) from 1 to 1 + L.
  const double end = 1. + L;
  const double exact =
    1. + (0.5 * (1. - 1. / end) + 0.5 * (1. - 1. / (end * end * end))) / L;
  double product = 1.;
  for (const CrackStart &start : starts)
  {
    // The rule has an error of some 1e-6; the place is found to 1e-4 of an edge, at which the
    // stress has a maximum.
    EXPECT_NEAR(start.mean_stress, exact, 1e-5 * exact);
    EXPECT_NEAR(start.drive, start.mean_stress / 2., 1e-14);
    EXPECT_NEAR(start.point.norm(), 1., 1e-12);
    const Tensor<1, 2> load({std::cos(load_angle), std::sin(load_angle)});
    EXPECT_NEAR(start.point * load, 0., 1e-2);
    EXPECT_NEAR(start.direction * load, 0., 1e-2);
    EXPECT_NEAR(start.direction * start.point, 1., 1e-3);
    product *= start.point * Tensor<1, 2>({-load[1], load[0]});
  }
  EXPECT_LT(product, 0.);

  // None starts near a place that is taken.
  const auto others = find_starts(plate_with_hole,
                                  0.3,
                                  material,
                                  kirsch_stress,
                                  0.5,
                                  {},
                                  {starts[0].point + Tensor<1, 2>({0.2, 0.2})});
  for (const CrackStart &other : others)
    EXPECT_GT(other.point.distance(starts[0].point), 0.2);
  ASSERT_FALSE(others.empty());
  EXPECT_LT(others[0].point.distance(starts[1].point), 1e-12);
}


TEST(CrackStart, ACrackStartsFromTheCornerOfANotch)
{
  // Williams' symmetric field in a corner of 270 degrees, opening towards (-1, -1).
  const double lambda = 0.54448373678246, half = 0.75 * dealii::numbers::PI,
               middle = 0.25 * dealii::numbers::PI;
  const double c =
    std::cos((lambda - 1.) * half) / std::cos((lambda + 1.) * half);
  const auto stress = [&](const Point<2> &x) {
    const double theta = std::atan2(x[1], x[0]), phi = theta - middle,
                 r = x.norm();
    // F, F' and F'' of Airy's function r^(lambda + 1) F(phi).
    const double p = lambda + 1., m = lambda - 1.;
    const double F  = std::cos(m * phi) - c * std::cos(p * phi),
                 dF = -m * std::sin(m * phi) + c * p * std::sin(p * phi),
                 ddF =
                   -m * m * std::cos(m * phi) + c * p * p * std::cos(p * phi);
    return std::pow(r, lambda - 1.) *
           from_polar(theta, ddF + p * F, lambda * p * F, -lambda * dF);
  };
  const double L        = 0.2;
  const auto   material = rock(std::sqrt(0.5 * dealii::numbers::PI * L), 1.);
  const auto   starts   = find_starts(
    "boundary name=outline POLYGON ((-1 0, 0 0, 0 -1, 1 -1, 1 1, -1 1))",
    0.3,
    material,
    stress,
    3.);
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_NEAR(starts[0].point.norm(), 0., 1e-12);
  // Both are found with 1e-3, and the stress across the crack has a maximum there.
  EXPECT_NEAR(starts[0].direction[0], std::sqrt(0.5), 5e-3);
  EXPECT_NEAR(starts[0].direction[1], std::sqrt(0.5), 5e-3);
  const double exact = (lambda + 1.) * (1. - c) * std::pow(L, lambda - 1.);
  // In the root of the distance the integrand is the power 0.09, with an infinite derivative in
  // the corner: the rule is 1e-3 off there.
  EXPECT_NEAR(starts[0].mean_stress, exact, 2e-3 * exact);
}


TEST(CrackStart, NoCrackStartsAlongItsBoundary)
{
  // Stress across the lower and upper side only: a line along one of them has the same mean
  // stress as all others from the left or right side.
  SymmetricTensor<2, 2> uniform;
  uniform[1][1]       = 1.;
  const double L      = 0.2;
  const auto   starts = find_starts(
    "boundary name=outline POLYGON ((0 0, 1 0, 1 1, 0 1))",
    0.13,
    rock(std::sqrt(0.5 * dealii::numbers::PI * L), 1.),
    [&](const Point<2> &) { return uniform; },
    0.05);
  ASSERT_FALSE(starts.empty());
  for (const CrackStart &start : starts)
  {
    const Point<2> end = start.point + L * start.direction;
    EXPECT_GE(std::min(end[1], 1. - end[1]), 0.0999 * L);
  }
}


TEST(CrackStart, NoCrackStartsWhereNoneCan)
{
  EXPECT_TRUE(
    find_starts(plate_with_hole, 0.3, rock(2., 0.), kirsch_stress, 0.5)
      .empty());

  // Compression along the load; the tension across it is a third.
  const auto compressed = [](const Point<2> &x) {
    return -1. * kirsch_stress(x);
  };
  const auto starts =
    find_starts(plate_with_hole, 0.3, rock(0.2, 1.), compressed, 0.5);
  ASSERT_EQ(starts.size(), 2u);
  for (const CrackStart &start : starts)
    EXPECT_LT(start.mean_stress, 1.);

  // A crack ahead of one of both places takes it away; a support takes away both.
  const double       along = load_angle + dealii::numbers::PI_2;
  const Point<2>     ahead(1.1 * std::cos(along), 1.1 * std::sin(along));
  std::ostringstream joint;
  joint.precision(17);
  joint << plate_with_hole << "joint LINESTRING (" << ahead[0] - 0.8 << " "
        << ahead[1] << ", " << ahead[0] + 0.8 << " " << ahead[1] << ")";
  const auto others =
    find_starts(joint.str(), 0.3, rock(0.5, 1.), kirsch_stress, 1.);
  ASSERT_FALSE(others.empty());
  EXPECT_LT(others[0].point[1] * ahead[1], 0.);

  BoundaryCondition held;
  held.curve = "hole";
  held.type  = BoundaryCondition::Type::displacement;
  for (const CrackStart &start : find_starts(
         plate_with_hole, 0.3, rock(2., 1.), kirsch_stress, 0.5, held))
    EXPECT_GT(start.point.norm(), 2.9);
}
