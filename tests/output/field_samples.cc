#include <nmm/output/field_samples.h>

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace NMM;

namespace
{
  FieldSample::Stress
  make_stress(const double xx,
              const double yy,
              const double xy,
              const double zz = 0.)
  {
    FieldSample::Stress stress;
    stress.in_plane[0][0] = xx;
    stress.in_plane[1][1] = yy;
    stress.in_plane[0][1] = xy;
    stress.zz             = zz;
    return stress;
  }


  TEST(FieldSamples, VonMisesOfKnownStates)
  {
    EXPECT_DOUBLE_EQ(von_mises_stress(make_stress(3., 0., 0.)), 3.);
    EXPECT_DOUBLE_EQ(von_mises_stress(make_stress(0., 0., 2.)),
                     2. * std::sqrt(3.));
    // A pressure from all sides, which needs sigma_zz.
    EXPECT_DOUBLE_EQ(von_mises_stress(make_stress(-5., -5., 0., -5.)), 0.);
  }


  TEST(FieldSamples, PrincipalStressesHaveTheTensorsInvariants)
  {
    const unsigned int seed = 20250117;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    for (unsigned int sample = 0; sample < 100; ++sample)
    {
      const auto stress =
        make_stress(uniform(random), uniform(random), uniform(random));
      const auto [first, second] = principal_stresses(stress);
      EXPECT_GE(first, second);
      // Sums and products of numbers up to 1: a few roundings.
      EXPECT_NEAR(first + second, dealii::trace(stress.in_plane), 1e-14);
      EXPECT_NEAR(first * second, dealii::determinant(stress.in_plane), 1e-14);
    }
  }


  TEST(FieldSamples, QuantitiesOfARotatedState)
  {
    // Uniaxial stress 1 along the direction of angle 0.3: radial there, hoop a
    // quarter turn further.
    const double c = std::cos(0.3), s = std::sin(0.3);
    FieldSample  sample;
    sample.recovered    = make_stress(c * c, s * s, c * s);
    sample.direct       = make_stress(7., 0., 0.);
    sample.displacement = dealii::Tensor<1, 2>({3., -4.});
    sample.velocity     = dealii::Tensor<1, 2>({-5., 12.});
    const ElementIds ids{2, 3, 1};

    PictureParameters parameters;
    parameters.center = dealii::Point<2>(1., 1.);
    const auto value_along =
      [&](const Quantity quantity, const double x, const double y) {
        return quantity_value(
          sample, ids, dealii::Point<2>(1. + x, 1. + y), parameters, quantity);
      };
    EXPECT_NEAR(value_along(Quantity::radial_stress, c, s), 1., 1e-15);
    EXPECT_NEAR(value_along(Quantity::hoop_stress, c, s), 0., 1e-15);
    EXPECT_NEAR(value_along(Quantity::hoop_stress, -s, c), 1., 1e-15);
    EXPECT_DOUBLE_EQ(value_along(Quantity::displacement, 0., 0.), 5.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::displacement_y, 0., 0.), -4.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::velocity, 0., 0.), 13.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::velocity_x, 0., 0.), -5.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::velocity_y, 0., 0.), 12.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::block, 0., 0.), 2.);
    EXPECT_DOUBLE_EQ(value_along(Quantity::material, 0., 0.), 1.);
    parameters.recovered = false;
    EXPECT_DOUBLE_EQ(value_along(Quantity::stress_xx, 0., 0.), 7.);
  }
} // namespace
