// Directions of growth and equivalent intensity factors.

#include <nmm/fracture/energy_release_criterion.h>
#include <nmm/fracture/hoop_stress_criterion.h>
#include <nmm/fracture/kink_factors.h>
#include <nmm/fracture/local_symmetry_criterion.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace NMM;

namespace
{
  constexpr double degree = dealii::numbers::PI / 180.;


  // Closed form; the last one is pure shear.
  TEST(GrowthCriteria, HoopStress)
  {
    const HoopStressCriterion criterion;
    const double              cases[][4] = {{1., 0., 0., 1.},
                                            {1., 0.5, -40.2078, 1.282795},
                                            {1., 1., -53.1301, 1.788854},
                                            {1., 2., -61.3418, 2.900537},
                                            {0., 1., -70.5288, 1.154701}};
    for (const auto &[K_I, K_II, angle, equivalent] : cases)
      for (const double side : {1., -1.})
      {
        const auto verdict = criterion.judge(K_I, side * K_II);
        EXPECT_NEAR(verdict.angle / degree, side * angle, 1e-4);
        EXPECT_NEAR(verdict.equivalent_intensity, equivalent, 1e-6);
      }
    EXPECT_LE(criterion.judge(-1., 0.).equivalent_intensity, 0.);
  }


  // Up to 45 degrees: singular integral equations. Beyond: cracks with a kink of 1e-4 of their
  // half-length under shear, computed by this library.
  TEST(GrowthCriteria, KinkFactors)
  {
    const double cases[][5] = {{30., .90175, -.72984, .24024, .79714},
                               {45., .79093, -.99811, .32320, .57265}};
    for (const auto &[angle, F_11, F_12, F_21, F_22] : cases)
    {
      const KinkFactors F = kink_factors(angle * degree);
      EXPECT_NEAR(F.F_11, F_11, 3e-4) << angle;
      EXPECT_NEAR(F.F_12, F_12, 3e-4) << angle;
      EXPECT_NEAR(F.F_21, F_21, 3e-4) << angle;
      EXPECT_NEAR(F.F_22, F_22, 3e-4) << angle;
    }
    EXPECT_NEAR(kink_factors(60. * degree).F_12, -1.1679, 2e-4);
    EXPECT_NEAR(kink_factors(70.529 * degree).F_12, -1.2233, 2e-4);
  }


  TEST(GrowthCriteria, LocalSymmetry)
  {
    const LocalSymmetryCriterion criterion;
    for (const double K_II : {-2., -0.3, 0., 0.1, 1.})
    {
      const auto        verdict = criterion.judge(1., K_II);
      const KinkFactors F       = kink_factors(verdict.angle);
      EXPECT_NEAR(F.F_21 + F.F_22 * K_II, 0., 1e-12);
      EXPECT_NEAR(verdict.equivalent_intensity, F.F_11 + F.F_12 * K_II, 1e-12);
      EXPECT_LE(verdict.angle * K_II, 0.);
      EXPECT_GE(verdict.equivalent_intensity, 1. - 1e-12);
    }
  }


  // The largest of many angles, asked one by one. Under shear alone the direction of
  // local symmetry is 77.3 degrees (Amestoy and Leblond 1992), that of most release less.
  TEST(GrowthCriteria, EnergyRelease)
  {
    const EnergyReleaseCriterion criterion;
    for (const double K_II : {-1., 0., 0.2, 0.7})
    {
      const auto verdict = criterion.judge(1., K_II);
      for (double angle = -1.5; angle < 1.5; angle += 1e-3)
      {
        const KinkFactors F = kink_factors(angle);
        EXPECT_LE(std::hypot(F.F_11 + F.F_12 * K_II, F.F_21 + F.F_22 * K_II),
                  (1. + 1e-9) * verdict.equivalent_intensity);
      }
      EXPECT_LE(verdict.angle * K_II, 0.);
    }
    EXPECT_NEAR(criterion.judge(0., 1.).angle / degree, -76., 1.);
    EXPECT_NEAR(LocalSymmetryCriterion().judge(0., 1.).angle / degree,
                -77.3,
                0.1);
  }
} // namespace
