// Laws of which only the energy is written: against the same law written by hand, and against
// Rivlin's solution.

#include <nmm/materials/energy_law.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// The energy of NeoHookeLaw.
  struct RubberLaw : EnergyLaw<RubberLaw>
  {
    template <class Number>
    Number
    energy(const GreenStrain<Number> &E, const IsotropicModuli &moduli) const
    {
      const Number v = E.volume(), c = pow(1. + v, -2. / 3.);
      return 0.5 * moduli.shear * (c * (3. + E.first_invariant()) - 3.) +
             0.5 * moduli.bulk * v * v;
    }
  };


  /// Mooney-Rivlin, with the part `share` of the shear modulus in the second invariant.
  struct MooneyRivlinLaw : EnergyLaw<MooneyRivlinLaw>
  {
    double share = 0.3;

    template <class Number>
    Number
    energy(const GreenStrain<Number> &E, const IsotropicModuli &moduli) const
    {
      const Number v = E.volume(), c = pow(1. + v, -2. / 3.);
      return 0.5 * moduli.shear *
               ((1. - share) * (c * (3. + E.first_invariant()) - 3.) +
                share * (c * c * (3. + E.second_invariant()) - 3.)) +
             0.5 * moduli.bulk * v * v;
    }
  };


  /// Twice as stiff as its material.
  struct WrongLaw : EnergyLaw<WrongLaw>
  {
    template <class Number>
    Number
    energy(const GreenStrain<Number> &E, const IsotropicModuli &moduli) const
    {
      return 2. * RubberLaw().energy(E, moduli);
    }
  };


  Material
  made_of(const std::shared_ptr<const MaterialLaw> &law)
  {
    Material m             = material("m", 1000., 0.3);
    m.law                  = law;
    m.initial_stress[0][0] = 30.;
    m.initial_stress[0][1] = -20.;
    return m;
  }


  template <typename Generator>
  Tensor<2, 2>
  random_gradient(Generator &generator, const double size)
  {
    std::uniform_real_distribution<double> random(-size, size);
    Tensor<2, 2>                           H;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        H[i][j] = random(generator);
    return H;
  }


  TEST(DualNumber, DerivativesOfAllFunctions)
  {
    // f = exp(x y) / sqrt(x) - log(y) + pow(x, 1.5) + log1p(x / y) at (2, 0.7)
    using Number = DualNumber<2, true>;
    const auto f = [](const auto &x, const auto &y) {
      using std::exp, std::sqrt, std::log, std::pow, std::log1p;
      return 2. - (exp(x * y) / sqrt(x) - log(y) + pow(x, 1.5) * 3.) -
             log1p(x / y) + (1. - y) + (y - 2.) + -x;
    };
    const Number W  = f(Number::variable(2., 0), Number::variable(0.7, 1));
    const double h  = 1e-4;
    const auto   at = [&](const double i, const double j) {
      return f(2. + i * h, 0.7 + j * h);
    };
    EXPECT_NEAR(W.value, at(0, 0), 1e-14);
    // central differences: h^2 and rounding / h^2
    EXPECT_NEAR(W.first[0], (at(1, 0) - at(-1, 0)) / (2. * h), 1e-7);
    EXPECT_NEAR(W.first[1], (at(0, 1) - at(0, -1)) / (2. * h), 1e-7);
    EXPECT_NEAR(W.second_derivative(0, 0),
                (at(1, 0) - 2. * at(0, 0) + at(-1, 0)) / (h * h),
                1e-6);
    EXPECT_NEAR(W.second_derivative(1, 1),
                (at(0, 1) - 2. * at(0, 0) + at(0, -1)) / (h * h),
                1e-6);
    EXPECT_NEAR(W.second_derivative(0, 1),
                (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4. * h * h),
                1e-6);
    EXPECT_EQ(W.second_derivative(0, 1), W.second_derivative(1, 0));
  }


  TEST(EnergyLaw, IsTheLawWrittenByHand)
  {
    std::mt19937 generator(21);
    for (const PlaneState state :
         {PlaneState::plane_strain, PlaneState::plane_stress})
    {
      const auto by_hand =
                   made_of(material_law("neo-Hookean")).hyperelastic_law(state),
                 derived = made_of(std::make_shared<RubberLaw>())
                             .hyperelastic_law(state);
      for (unsigned int sample = 0; sample < 200; ++sample)
      {
        const Tensor<2, 2> H =
          random_gradient(generator, sample == 0 ? 0. : 0.35);
        HyperelasticLaw::Response a, b, alone;
        ASSERT_TRUE(by_hand->evaluate(H, a) == Deformation::admissible);
        ASSERT_TRUE(derived->evaluate(H, b) == Deformation::admissible);
        ASSERT_TRUE(derived->evaluate_stress(H, alone) ==
                    Deformation::admissible);
        // rounding of moduli of 1000
        EXPECT_NEAR(a.energy, b.energy, 1e-11);
        EXPECT_NEAR(a.energy, alone.energy, 1e-11);
        EXPECT_LT((a.stress - b.stress).norm(), 1e-10);
        EXPECT_LT((a.stress - alone.stress).norm(), 1e-10);
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j)
            EXPECT_NEAR(a.tangent[i][j], b.tangent[i][j], 1e-9);
        EXPECT_NEAR(by_hand->plane_strain_stress(H),
                    derived->plane_strain_stress(H),
                    1e-10);
        double s, t;
        ASSERT_TRUE(by_hand->plane_stress_stretch(H, s) ==
                    Deformation::admissible);
        ASSERT_TRUE(derived->plane_stress_stretch(H, t) ==
                    Deformation::admissible);
        EXPECT_NEAR(s, t, 1e-12);
      }
      // det F = -0.1
      Tensor<2, 2> inverted;
      inverted[1][1] = -1.1;
      HyperelasticLaw::Response r;
      EXPECT_TRUE(derived->evaluate(inverted, r) == Deformation::inverted);
      EXPECT_TRUE(derived->evaluate_stress(inverted, r) ==
                  Deformation::inverted);
    }
  }


  // Rivlin's uniaxial tension of a solid that is nearly incompressible:
  // sigma = 2 (l^2 - 1/l) (c_1 + c_2 / l) with c_1 = mu (1 - share) / 2 and c_2 = mu share / 2.
  TEST(EnergyLaw, MooneyRivlinInTension)
  {
    MooneyRivlinLaw law;
    law.share         = 0.4;
    Material rubber   = material("rubber", 3., 0.5 - 1e-8);
    rubber.law        = law.clone();
    const auto   made = rubber.hyperelastic_law(PlaneState::plane_stress);
    const double l    = 1.8;
    Tensor<2, 2> H;
    H[0][0] = l - 1.;
    H[1][1] = 1. / std::sqrt(l) - 1.;
    SymmetricTensor<2, 2> sigma;
    ASSERT_TRUE(made->cauchy_stress(H, sigma) == Deformation::admissible);
    const double exact = (l * l - 1. / l) * (0.6 + 0.4 / l);
    // of mu = 1; the change of volume is mu / K = 4e-8
    EXPECT_NEAR(sigma[0][0], exact, 1e-6);
    EXPECT_NEAR(sigma[1][1], 0., 1e-6);
  }


  TEST(EnergyLaw, MustHaveTheModuliOfItsMaterial)
  {
    EXPECT_THROW(made_of(std::make_shared<WrongLaw>())
                   .hyperelastic_law(PlaneState::plane_strain),
                 InputError);
  }
} // namespace
