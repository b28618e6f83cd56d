// The fields about a crack tip: each is elastic, in equilibrium, and free of stress on the
// faces of a straight crack.

#include <nmm/fracture/tip_field.h>

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace NMM;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  TipField::Values
  at(const TipField &field, const Point<2> &x)
  {
    return field.evaluate(x.norm(), std::atan2(x[1], x[0]));
  }


  TEST(TipField, IsElasticAndInEquilibrium)
  {
    const PlaneElasticity elasticity = {300., 200.};
    // Central differences of step h: h^2 times a third derivative, about 6 at r = 1, and
    // 1e-16 / h of rounding.
    constexpr double      h = 1e-5, tolerance = 1e-8;
    std::vector<TipField> fields = {
      TipField(TipField::Kind::point_force, elasticity)};
    for (const unsigned int n : {1, 2, 3, 4})
      for (const auto kind : {TipField::Kind::opening, TipField::Kind::sliding})
        fields.emplace_back(kind, elasticity, n);
    for (const TipField &field : fields)
    {
      for (const double theta : {-3., -1.3, 0.2, 1.5, 3.1})
      {
        const Point<2> x(0.9 * std::cos(theta), 0.9 * std::sin(theta));
        const auto     values = at(field, x);
        EXPECT_LT((values.stress - elasticity.stress(values.gradient)).norm(),
                  1e-13);
        Tensor<1, 2> divergence;
        for (unsigned int j = 0; j < 2; ++j)
        {
          const Tensor<1, 2> step = h * Point<2>::unit_vector(j);
          const auto up = at(field, x + step), down = at(field, x - step);
          for (unsigned int i = 0; i < 2; ++i)
          {
            EXPECT_NEAR((up.displacement[i] - down.displacement[i]) / (2. * h),
                        values.gradient[i][j],
                        tolerance);
            divergence[i] += values.stress_derivatives[j][i][j];
          }
          EXPECT_LT(((up.stress - down.stress) / (2. * h) -
                     values.stress_derivatives[j])
                      .norm(),
                    tolerance);
        }
        EXPECT_LT(divergence.norm(), 1e-14);
      }
      for (const double side : {-pi, pi})
      {
        const auto face = field.evaluate(0.7, side);
        EXPECT_NEAR(face.stress[0][1], 0., 1e-15);
        EXPECT_NEAR(face.stress[1][1], 0., 1e-15);
      }
    }
  }


  TEST(TipField, HasUnitStrength)
  {
    const PlaneElasticity elasticity = {300., 200.};
    const double          r          = 0.3;
    const double          unit       = 1. / std::sqrt(2. * pi * r);
    const auto            opening =
      TipField(TipField::Kind::opening, elasticity).evaluate(r, 0.);
    EXPECT_NEAR(opening.stress[1][1], unit, 1e-15);
    EXPECT_NEAR(opening.stress[0][1], 0., 1e-15);
    const auto sliding =
      TipField(TipField::Kind::sliding, elasticity).evaluate(r, 0.);
    EXPECT_NEAR(sliding.stress[0][1], unit, 1e-15);
    EXPECT_NEAR(sliding.stress[1][1], 0., 1e-15);

    // The crack opens: u_2 = 4 K_I / E' sqrt(r / (2 pi)) on its upper face.
    const auto face =
      TipField(TipField::Kind::opening, elasticity).evaluate(r, pi);
    EXPECT_NEAR(face.displacement[1],
                4. / plane_modulus(elasticity) * std::sqrt(r / (2. * pi)),
                1e-15);

    // The stress on a circle balances the force e_1.
    const TipField         force(TipField::Kind::point_force, elasticity);
    Tensor<1, 2>           sum;
    constexpr unsigned int n = 100;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double theta = pi * ((2. * i + 1.) / n - 1.);
      sum += 2. * pi * r / n *
             (force.evaluate(r, theta).stress *
              Point<2>(std::cos(theta), std::sin(theta)));
    }
    // the midpoint rule is exact for trigonometric polynomials
    EXPECT_NEAR(sum[0], -1., 1e-14);
    EXPECT_NEAR(sum[1], 0., 1e-14);
  }
} // namespace
