// The laws: derivatives against differences, limits, frame indifference.

#include <nmm/materials/hyperelastic_law.h>
#include <nmm/materials/material.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  const std::shared_ptr<const MaterialLaw> laws[] =
    {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")};
  constexpr PlaneState states[] = {PlaneState::plane_stress,
                                   PlaneState::plane_strain};

  Material
  test_material(const std::shared_ptr<const MaterialLaw> &law,
                const bool                                has_initial_stress)
  {
    Material m = material("m", 1000., 0.3);
    m.law      = law;
    if (has_initial_stress)
    {
      m.initial_stress[0][0] = 30.;
      m.initial_stress[0][1] = -20.;
      m.initial_stress[1][1] = 50.;
    }
    return m;
  }


  Tensor<2, 2>
  rotation(const double angle)
  {
    Tensor<2, 2> R;
    R[0][0] = R[1][1] = std::cos(angle);
    R[1][0]           = std::sin(angle);
    R[0][1]           = -R[1][0];
    return R;
  }


  /// A displacement gradient with entries up to 0.35.
  template <typename Generator>
  Tensor<2, 2>
  random_gradient(Generator &generator)
  {
    std::uniform_real_distribution<double> random(-0.35, 0.35);
    Tensor<2, 2>                           H;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        H[i][j] = random(generator);
    return H;
  }


  HyperelasticLaw::Response
  evaluate(const HyperelasticLaw &law, const Tensor<2, 2> &H)
  {
    HyperelasticLaw::Response response;
    EXPECT_TRUE(law.evaluate(H, response) == Deformation::admissible);
    return response;
  }
} // namespace


TEST(Hyperelasticity, DerivativesAgainstDifferences)
{
  std::mt19937   generator(17);
  constexpr auto step      = 1e-5;
  unsigned int   n_samples = 0;
  for (const std::shared_ptr<const MaterialLaw> &which : laws)
    for (const PlaneState state : states)
      for (const bool has_initial_stress : {false, true})
      {
        const auto pointer =
          test_material(which, has_initial_stress).hyperelastic_law(state);
        const HyperelasticLaw &law = *pointer;
        for (unsigned int sample = 0; sample < 50; ++sample)
        {
          const Tensor<2, 2> H = random_gradient(generator);
          const auto         r = evaluate(law, H);
          // stress alone is the same
          HyperelasticLaw::Response alone;
          ASSERT_TRUE(law.evaluate_stress(H, alone) == Deformation::admissible);
          EXPECT_NEAR(alone.energy, r.energy, 1e-12 * 1000.);
          EXPECT_LT((alone.stress - r.stress).norm(), 1e-12 * 1000.);
          for (unsigned int b = 0; b < 4; ++b)
          {
            Tensor<2, 2> G;
            G[b / 2][b % 2]  = 1.;
            const auto plus  = evaluate(law, H + step * G);
            const auto minus = evaluate(law, H - step * G);
            // truncation 1e-10 times third derivatives, rounding 1e-11
            EXPECT_NEAR(r.stress[b / 2][b % 2],
                        (plus.energy - minus.energy) / (2. * step),
                        1e-5);
            double derivative[4][4];
            ASSERT_TRUE(law.tangent_derivative(H, G, derivative) ==
                        Deformation::admissible);
            for (unsigned int a = 0; a < 4; ++a)
            {
              EXPECT_NEAR(r.tangent[a][b],
                          (plus.stress - minus.stress)[a / 2][a % 2] /
                            (2. * step),
                          2e-5);
              EXPECT_NEAR(r.tangent[a][b], r.tangent[b][a], 1e-9);
              for (unsigned int c = 0; c < 4; ++c)
                EXPECT_NEAR(derivative[a][c],
                            (plus.tangent[a][c] - minus.tangent[a][c]) /
                              (2. * step),
                            // of a central difference with step 1e-4
                            1e-2);
              ++n_samples;
            }
          }
        }
      }
  EXPECT_EQ(n_samples, 2u * 2u * 2u * 50u * 16u);
}


TEST(Hyperelasticity, SmallStrainLimitIsPlaneElasticity)
{
  for (const std::shared_ptr<const MaterialLaw> &which : laws)
    for (const PlaneState state : states)
    {
      const Material         m       = test_material(which, true);
      const auto             pointer = m.hyperelastic_law(state);
      const HyperelasticLaw &law     = *pointer;
      const auto             r       = evaluate(law, Tensor<2, 2>());
      EXPECT_LT((r.stress - Tensor<2, 2>(m.initial_stress)).norm(), 1e-10);
      // A : H = C : eps(H) + H S_0
      Tensor<2, 2> H;
      H[0][0] = 0.3;
      H[0][1] = 0.7;
      H[1][0] = -0.2;
      H[1][1] = 0.5;
      const Tensor<2, 2> expected =
        Tensor<2, 2>(m.plane_elasticity(state).stress(H)) +
        H * Tensor<2, 2>(m.initial_stress);
      for (unsigned int a = 0; a < 4; ++a)
      {
        double sum = 0.;
        for (unsigned int b = 0; b < 4; ++b)
          sum += r.tangent[a][b] * H[b / 2][b % 2];
        EXPECT_NEAR(sum, expected[a / 2][a % 2], 1e-9);
      }
    }
}


TEST(Hyperelasticity, RotationTurnsStressAndKeepsEnergy)
{
  std::mt19937 generator(18);
  for (const std::shared_ptr<const MaterialLaw> &which : laws)
    for (const PlaneState state : states)
    {
      const auto pointer = test_material(which, true).hyperelastic_law(state);
      const HyperelasticLaw &law = *pointer;
      for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const Tensor<2, 2> H        = random_gradient(generator);
        const Tensor<2, 2> R        = rotation(0.37 * sample);
        const Tensor<2, 2> I        = dealii::unit_symmetric_tensor<2>();
        const Tensor<2, 2> turned_H = R * deformation_gradient(H) - I;
        const auto r = evaluate(law, H), turned = evaluate(law, turned_H);
        EXPECT_NEAR(r.energy, turned.energy, 1e-11 * 1000.);
        EXPECT_LT((turned.stress - R * r.stress).norm(), 1e-11 * 1000.);
      }
    }
}


TEST(Hyperelasticity, PlaneStressHasNoStressOutOfPlane)
{
  // the same material in plane strain with that stretch put in by hand: the
  // out-of-plane derivative of the neo-Hookean energy vanishes
  std::mt19937           generator(19);
  const Material         m = test_material(material_law("neo-Hookean"), false);
  const auto             pointer = m.hyperelastic_law(PlaneState::plane_stress);
  const HyperelasticLaw &law     = *pointer;
  const double           mu = m.youngs_modulus / (2. * (1. + m.poissons_ratio));
  const double K = m.youngs_modulus / (3. * (1. - 2. * m.poissons_ratio));
  for (unsigned int sample = 0; sample < 50; ++sample)
  {
    const Tensor<2, 2> H = random_gradient(generator);
    const Tensor<2, 2> F = deformation_gradient(H);
    double             s;
    ASSERT_TRUE(law.out_of_plane_stretch(H, s) == Deformation::admissible);
    const auto energy = [&](const double stretch) {
      const double J = stretch * dealii::determinant(F);
      return 0.5 * mu *
               (std::pow(J, -2. / 3.) * (F.norm_square() + stretch * stretch) -
                3.) +
             0.5 * K * (J - 1.) * (J - 1.);
    };
    EXPECT_NEAR(evaluate(law, H).energy, energy(s), 1e-11 * 1000.);
    EXPECT_NEAR((energy(s + 1e-5) - energy(s - 1e-5)) / 2e-5, 0., 1e-5);
  }
}


TEST(Hyperelasticity, UniaxialCauchyStress)
{
  // St. Venant-Kirchhoff, plane stress: S_11 = E E_11, E_22 = E_33 = -nu E_11
  const auto pointer =
    test_material(material_law("St. Venant-Kirchhoff"), false)
      .hyperelastic_law(PlaneState::plane_stress);
  const HyperelasticLaw &law = *pointer;
  const double           E11 = 0.2, l1 = std::sqrt(1. + 2. * E11),
               l2 = std::sqrt(1. - 2. * 0.3 * E11);
  Tensor<2, 2> H;
  H[0][0] = l1 - 1.;
  H[1][1] = l2 - 1.;
  SymmetricTensor<2, 2> sigma;
  ASSERT_TRUE(law.cauchy_stress(H, sigma) == Deformation::admissible);
  EXPECT_NEAR(sigma[0][0], l1 * 1000. * E11 / (l2 * l2), 1e-9);
  EXPECT_NEAR(sigma[1][1], 0., 1e-9);
}


TEST(Hyperelasticity, InvertedIsReported)
{
  Tensor<2, 2> H;
  H[1][1] = -1.1;
  HyperelasticLaw::Response response;
  double                    derivative[4][4], s;
  SymmetricTensor<2, 2>     sigma;
  for (const PlaneState state : states)
  {
    const auto pointer =
      test_material(material_law("neo-Hookean"), false).hyperelastic_law(state);
    const HyperelasticLaw &law = *pointer;
    EXPECT_TRUE(law.evaluate(H, response) == Deformation::inverted);
    EXPECT_TRUE(law.evaluate_stress(H, response) == Deformation::inverted);
    EXPECT_TRUE(law.tangent_derivative(H, H, derivative) ==
                Deformation::inverted);
    EXPECT_TRUE(law.cauchy_stress(H, sigma) == Deformation::inverted);
  }
  const auto pointer = test_material(material_law("neo-Hookean"), false)
                         .hyperelastic_law(PlaneState::plane_stress);
  const HyperelasticLaw &law = *pointer;
  EXPECT_TRUE(law.out_of_plane_stretch(H, s) == Deformation::inverted);
}


// Hooke's stress, to the strain itself, down to the smallest strains: no digits are lost to F = I + H.
TEST(Hyperelasticity, SmallStrainsKeepTheirDigits)
{
  std::mt19937 generator(20);
  for (const std::shared_ptr<const MaterialLaw> &which : laws)
    for (const PlaneState state : states)
      for (const double size : {1e-6, 1e-9, 1e-13, 1e-40})
      {
        SCOPED_TRACE(size);
        const Material     m     = test_material(which, false);
        const auto         law   = m.hyperelastic_law(state);
        const Tensor<2, 2> H     = size * random_gradient(generator);
        const auto         r     = evaluate(*law, H);
        const Tensor<2, 2> hooke = m.plane_elasticity(state).stress(H);
        // E - sym(H) and further terms are of the order H^2, and rounding is 1e-16.
        EXPECT_LT((r.stress - hooke).norm() / hooke.norm(), 10. * size + 1e-14);
        // W loses the digits of H once, in its terms of first order.
        if (size > 1e-9)
        {
          EXPECT_NEAR(r.energy / (0.5 * dealii::scalar_product(hooke, H)),
                      1.,
                      10. * size + 1e-15 / size);
        }
      }
}
