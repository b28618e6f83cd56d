// The laws: derivatives against differences, limits, frame indifference.

#include <nmm/materials/hyperelastic_law.h>
#include <nmm/materials/material_law.h>

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


  /// I plus entries up to 0.35.
  template <typename Generator>
  Tensor<2, 2>
  random_deformation(Generator &generator)
  {
    std::uniform_real_distribution<double> random(-0.35, 0.35);
    Tensor<2, 2> F = dealii::unit_symmetric_tensor<2>();
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        F[i][j] += random(generator);
    return F;
  }


  HyperelasticLaw::Response
  evaluate(const HyperelasticLaw &law, const Tensor<2, 2> &F)
  {
    HyperelasticLaw::Response response;
    EXPECT_TRUE(law.evaluate(F, response) == Deformation::admissible);
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
          const Tensor<2, 2> F = random_deformation(generator);
          const auto         r = evaluate(law, F);
          // stress alone is the same
          HyperelasticLaw::Response alone;
          ASSERT_TRUE(law.evaluate_stress(F, alone) == Deformation::admissible);
          EXPECT_NEAR(alone.energy, r.energy, 1e-12 * 1000.);
          EXPECT_LT((alone.stress - r.stress).norm(), 1e-12 * 1000.);
          for (unsigned int b = 0; b < 4; ++b)
          {
            Tensor<2, 2> G;
            G[b / 2][b % 2]  = 1.;
            const auto plus  = evaluate(law, F + step * G);
            const auto minus = evaluate(law, F - step * G);
            // truncation 1e-10 times third derivatives, rounding 1e-11
            EXPECT_NEAR(r.stress[b / 2][b % 2],
                        (plus.energy - minus.energy) / (2. * step),
                        1e-5);
            double derivative[4][4];
            ASSERT_TRUE(law.tangent_derivative(F, G, derivative) ==
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
  const Tensor<2, 2> identity = dealii::unit_symmetric_tensor<2>();
  for (const std::shared_ptr<const MaterialLaw> &which : laws)
    for (const PlaneState state : states)
    {
      const Material         m       = test_material(which, true);
      const auto             pointer = m.hyperelastic_law(state);
      const HyperelasticLaw &law     = *pointer;
      const auto             r       = evaluate(law, identity);
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
        const Tensor<2, 2> F = random_deformation(generator);
        const Tensor<2, 2> R = rotation(0.37 * sample);
        const auto         r = evaluate(law, F), turned = evaluate(law, R * F);
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
    const Tensor<2, 2> F = random_deformation(generator);
    double             s;
    ASSERT_TRUE(law.out_of_plane_stretch(F, s) == Deformation::admissible);
    const auto energy = [&](const double stretch) {
      const double J = stretch * dealii::determinant(F);
      return 0.5 * mu *
               (std::pow(J, -2. / 3.) * (F.norm_square() + stretch * stretch) -
                3.) +
             0.5 * K * (J - 1.) * (J - 1.);
    };
    EXPECT_NEAR(evaluate(law, F).energy, energy(s), 1e-11 * 1000.);
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
  Tensor<2, 2> F;
  F[0][0] = l1;
  F[1][1] = l2;
  SymmetricTensor<2, 2> sigma;
  ASSERT_TRUE(law.cauchy_stress(F, sigma) == Deformation::admissible);
  EXPECT_NEAR(sigma[0][0], l1 * 1000. * E11 / (l2 * l2), 1e-9);
  EXPECT_NEAR(sigma[1][1], 0., 1e-9);
}


TEST(Hyperelasticity, InvertedIsReported)
{
  Tensor<2, 2> F;
  F[0][0] = 1.;
  F[1][1] = -0.1;
  HyperelasticLaw::Response response;
  double                    derivative[4][4], s;
  SymmetricTensor<2, 2>     sigma;
  for (const PlaneState state : states)
  {
    const auto pointer =
      test_material(material_law("neo-Hookean"), false).hyperelastic_law(state);
    const HyperelasticLaw &law = *pointer;
    EXPECT_TRUE(law.evaluate(F, response) == Deformation::inverted);
    EXPECT_TRUE(law.evaluate_stress(F, response) == Deformation::inverted);
    EXPECT_TRUE(law.tangent_derivative(F, F, derivative) ==
                Deformation::inverted);
    EXPECT_TRUE(law.cauchy_stress(F, sigma) == Deformation::inverted);
  }
  const auto pointer = test_material(material_law("neo-Hookean"), false)
                         .hyperelastic_law(PlaneState::plane_stress);
  const HyperelasticLaw &law = *pointer;
  EXPECT_TRUE(law.out_of_plane_stretch(F, s) == Deformation::inverted);
}
