// Loads, stiffnesses and lengths do not decide whether statics with contact converges.

#include <cmath>
#include <contact/contact_model.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Strain energy of three blocks between two rigid abutments under their own weight,
  /// in parts of weight^2 over stiffness.
  double
  solve_arch(const double weight, const double modulus)
  {
    const auto place = [](const double r, const double degrees) {
      const double angle = degrees * dealii::numbers::PI / 180.;
      return Point<2>(r * std::cos(angle), r * std::sin(angle));
    };
    Geometry              geometry;
    std::vector<Point<2>> corners;
    const double          angles[4] = {30., 70., 110., 150.};
    for (unsigned int i = 0; i < 4; ++i)
      corners.push_back(place(1.5, angles[i]));
    for (unsigned int i = 0; i < 4; ++i)
      corners.push_back(place(1., angles[3 - i]));
    for (unsigned int i = 0; i < corners.size(); ++i)
      geometry.add(single_piece_curve(
        "side" + std::to_string(i),
        CurvePiece::segment(corners[i], corners[(i + 1) % 8])));
    for (const unsigned int i : {1U, 2U})
    {
      Curve joint =
        single_piece_curve("joint" + std::to_string(i),
                           CurvePiece::segment(place(1., angles[i]),
                                               place(1.5, angles[i])));
      joint.role  = CurveRole::joint;
      joint.state = JointState::open;
      geometry.add(joint);
    }
    Bodies::Options options;
    options.obstacles = {obstacle("right", {place(1.7, 30.), place(0.8, 30.)}),
                         obstacle("left",
                                  {place(0.8, 150.), place(1.7, 150.)})};
    Bodies bodies(std::move(geometry), options);
    bodies.problem.materials                   = {material()};
    bodies.problem.materials[0].youngs_modulus = modulus;
    bodies.problem.materials[0].density        = weight;
    bodies.problem.gravity                     = Point<2>(0., -1.);
    ContactParameters parameters        = contact_parameters(100. * modulus);
    coulomb(parameters).shear_stiffness = 3. * modulus;
    coulomb(parameters).friction        = 0.7;
    bodies.start(parameters);
    const auto steps = bodies.statics->run(LoadSteps());
    EXPECT_EQ(steps.size(), 1U) << weight << ' ' << modulus;
    return bodies.static_solid->strain_energy_at(bodies.statics->solution(),
                                                 1.) *
           modulus / (weight * weight);
  }


  /// Springs give way by 1e-3 to 1e-18 m, positions are rounded to 1e-16 m. Strains of
  /// the stiffest load, 1e-5, change directions by as much.
  TEST(ContactScales, TenDecadesOfWeightAndStiffness)
  {
    const double expected = solve_arch(1., 1e10);
    EXPECT_GT(expected, 0.);
    for (int k = -5; k <= 5; ++k)
    {
      EXPECT_NEAR(solve_arch(std::pow(10., k), 1e10), expected, 1e-4 * expected)
        << k;
      EXPECT_NEAR(solve_arch(1., std::pow(10., 10 + k)),
                  expected,
                  1e-4 * expected)
        << k;
    }
  }


  /// A block on a slope of 15 degrees sticks or slides at friction angles that are 0.03
  /// degrees, or 0.2 % of their tangent, off. Within that the elastic block gives way at its
  /// lower edge.
  TEST(ContactScales, BlockAtTheLimitOfFriction)
  {
    const double degree = dealii::numbers::PI / 180.;
    for (const double angle : {14.97, 15.03, 15.1})
    {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      Bodies::Options options;
      options.obstacles = {obstacle("floor", {{10., 0.}, {-10., 0.}})};
      Bodies bodies(std::move(geometry), options);
      bodies.problem.materials                   = {material()};
      bodies.problem.materials[0].youngs_modulus = 1e9;
      bodies.problem.materials[0].density        = 2500.;
      bodies.problem.gravity =
        9.81 * Point<2>(std::sin(15. * degree), -std::cos(15. * degree));
      ContactParameters parameters        = contact_parameters(1e11);
      coulomb(parameters).shear_stiffness = 3e9;
      coulomb(parameters).friction        = std::tan(angle * degree);
      bodies.start(parameters);
      if (angle < 15.)
        EXPECT_THROW(bodies.statics->run(LoadSteps()), NumericalFailure);
      else
      {
        const auto steps = bodies.statics->run(LoadSteps());
        EXPECT_NEAR(-steps.back().contact.force[0] /
                      steps.back().contact.force[1],
                    std::tan(15. * degree),
                    1e-6);
      }
    }
  }
} // namespace
