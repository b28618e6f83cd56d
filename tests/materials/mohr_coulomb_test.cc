// Mohr-Coulomb plasticity: return, tangent, paths with exact answers.

#include <nmm/base/exceptions.h>
#include <nmm/materials/inelastic_law.h>
#include <nmm/materials/mohr_coulomb_law.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double degrees = dealii::numbers::PI / 180.;

  MohrCoulombLaw
  law(const double phi, const double c, const double psi, const double sigma_t)
  {
    MohrCoulombLaw result;
    result.friction         = std::tan(phi * degrees);
    result.cohesion         = c;
    result.dilation         = std::tan(psi * degrees);
    result.tensile_strength = sigma_t;
    return result;
  }


  /// Laws of all kinds: frictional, purely cohesive, associated, with a cut-off.
  std::vector<MohrCoulombLaw>
  plastic_laws()
  {
    return {law(30., 1., 30., 1e20),
            law(30., 1., 0., 1e20),
            law(35., 0.5, 10., 0.1),
            law(0., 1., 0., 1e20),
            law(0., 1., 0., 0.5),
            law(20., 0., 5., 1e20)};
  }


  constexpr PlaneState plane_states[] = {PlaneState::plane_strain,
                                         PlaneState::plane_stress};


  Material
  rock(const MohrCoulombLaw &law)
  {
    Material m = material("rock", 1000., 0.25);
    m.law      = law.clone();
    return m;
  }


  /// Larger one of the two yield functions, in Pa.
  double
  largest_excess(const MohrCoulombLaw &law, const InelasticLaw::Response &r)
  {
    const double mean = 0.5 * dealii::trace(r.stress);
    const double radius =
      std::hypot(0.5 * (r.stress[0][0] - r.stress[1][1]), r.stress[0][1]);
    const double largest  = std::max(mean + radius, r.stress_zz);
    const double smallest = std::min(mean - radius, r.stress_zz);
    const double phi      = std::atan(law.friction);
    return std::max(0.5 * ((largest - smallest) +
                           (largest + smallest) * std::sin(phi)) -
                      law.cohesion * std::cos(phi),
                    largest - law.tensile_strength);
  }


  /// The response at @p strain coming from @p state.
  InelasticLaw::Response
  evaluate(const InelasticLaw          &law,
           const SymmetricTensor<2, 2> &strain,
           const MaterialState         &state = MaterialState())
  {
    InelasticLaw::Response response;
    EXPECT_TRUE(law.evaluate(strain, state, response) ==
                Deformation::admissible);
    return response;
  }


  SymmetricTensor<2, 2>
  random_strain(std::mt19937 &generator, const double size)
  {
    std::uniform_real_distribution<double> random(-size, size);
    SymmetricTensor<2, 2>                  strain;
    strain[0][0] = random(generator);
    strain[1][1] = random(generator);
    strain[0][1] = random(generator);
    return strain;
  }
} // namespace


/// Every stress is admissible, plastic flow dissipates, and strain is the sum of its parts.
TEST(MohrCoulomb, ReturnsToTheYieldSurface)
{
  std::mt19937 generator(5);
  unsigned int n_plastic = 0;
  for (unsigned int k = 0; k < 12; ++k)
  {
    const MohrCoulombLaw mohr_coulomb = plastic_laws()[k / 2];
    const PlaneState     plane_state  = plane_states[k % 2];
    const bool           is_thin      = plane_state == PlaneState::plane_stress;
    const Material       m            = rock(mohr_coulomb);
    const auto           inelastic    = m.inelastic_law(plane_state);
    for (unsigned int i = 0; i < 2000; ++i)
    {
      MaterialState          state;
      InelasticLaw::Response r;
      // a path of three steps
      for (unsigned int step = 0; step < 3; ++step)
      {
        const SymmetricTensor<2, 2> strain = random_strain(generator, 0.01);
        r = evaluate(*inelastic, strain, state);
        ASSERT_LE(largest_excess(mohr_coulomb, r), 1e-10) << i;
        n_plastic += !r.is_elastic;

        // sigma = C (epsilon - epsilon^p) in the plane and across it
        const PlaneElasticity C = m.plane_elasticity(PlaneState::plane_strain);
        const SymmetricTensor<2, 2> e = strain - r.state.plastic_strain;
        const double          e_zz    = r.strain_zz - r.state.plastic_strain_zz;
        const double          p       = C.lambda * (dealii::trace(e) + e_zz);
        SymmetricTensor<2, 2> hooke   = 2. * C.mu * e;
        hooke[0][0] += p;
        hooke[1][1] += p;
        EXPECT_LT((r.stress - hooke).norm(), 1e-11);
        EXPECT_NEAR(r.stress_zz, p + 2. * C.mu * e_zz, 1e-11);
        EXPECT_EQ(is_thin ? r.stress_zz : r.strain_zz, 0.);
        EXPECT_NEAR(r.energy, 0.5 * (r.stress * e + r.stress_zz * e_zz), 1e-13);

        const double dissipated =
          r.stress * (r.state.plastic_strain - state.plastic_strain) +
          r.stress_zz * (r.state.plastic_strain_zz - state.plastic_strain_zz);
        EXPECT_GE(dissipated, -1e-12);
        EXPECT_NEAR(r.dissipated, dissipated, 1e-12);
        EXPECT_GE(r.state.equivalent_plastic_strain,
                  state.equivalent_plastic_strain);
        state = r.state;
      }
    }
  }
  EXPECT_GT(n_plastic, 20000u);
}


/// An increment that is repeated from where it ended is elastic: the return is to the surface,
/// not beyond it.
TEST(MohrCoulomb, NothingFlowsTwice)
{
  std::mt19937 generator(6);
  for (unsigned int k = 0; k < 12; ++k)
  {
    const auto inelastic =
      rock(plastic_laws()[k / 2]).inelastic_law(plane_states[k % 2]);
    for (unsigned int i = 0; i < 200; ++i)
    {
      const SymmetricTensor<2, 2> strain = random_strain(generator, 0.01);
      InelasticLaw::Response      first, again;
      first = evaluate(*inelastic, strain, MaterialState());
      again = evaluate(*inelastic, strain, first.state);
      EXPECT_LT((first.stress - again.stress).norm(), 1e-10);
      EXPECT_NEAR(again.state.equivalent_plastic_strain,
                  first.state.equivalent_plastic_strain,
                  1e-12);
    }
  }
}


/// The tangent against central differences, where both ends are on the same side of edges. Those
/// that are not are counted.
TEST(MohrCoulomb, TangentAgainstDifferences)
{
  std::mt19937     generator(7);
  constexpr double step   = 1e-8;
  unsigned int     n_good = 0, n_kinks = 0;
  for (unsigned int k = 0; k < 12; ++k)
  {
    const auto inelastic =
      rock(plastic_laws()[k / 2]).inelastic_law(plane_states[k % 2]);
    for (unsigned int i = 0; i < 500; ++i)
    {
      const SymmetricTensor<2, 2> strain = random_strain(generator, 0.005);
      InelasticLaw::Response      r;
      r = evaluate(*inelastic, strain, MaterialState());
      if (r.is_elastic)
        continue;
      double error = 0.;
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int l = k; l < 2; ++l)
        {
          SymmetricTensor<2, 2> change;
          change[k][l] = step;
          InelasticLaw::Response plus, minus;
          plus  = evaluate(*inelastic, strain + change, MaterialState());
          minus = evaluate(*inelastic, strain - change, MaterialState());
          const auto difference = (plus.stress - minus.stress) / (2. * step);
          for (unsigned int a = 0; a < 2; ++a)
            for (unsigned int b = 0; b < 2; ++b)
            {
              const double tangent =
                r.tangent[2 * a + b][2 * k + l] +
                (k == l ? 0. : r.tangent[2 * a + b][2 * l + k]);
              error = std::max(error, std::abs(difference[a][b] - tangent));
            }
        }
      // rounding: 1e-16 * 10 Pa / 1e-8; truncation where directions turn: 1e-8^2 / 1e-3^2 * E
      if (error < 1e-3)
        ++n_good;
      else
        ++n_kinks;
    }
  }
  EXPECT_GT(n_good, 4000u);
  EXPECT_LE(n_kinks, 4u);
}


/// Triaxial compression: sigma_1 - sigma_3 grows as Hooke has it up to
/// sigma_3 = N sigma_1 - 2 c sqrt(N), and stays there; volume grows by sin(psi). Plane strain
/// with a lateral stress that is held: the lateral strain is searched for.
TEST(MohrCoulomb, BiaxialCompression)
{
  constexpr double phi = 30., psi = 10., c = 1., lateral = -2.;
  const Material   m         = rock(law(phi, c, psi, 1e20));
  const auto       inelastic = m.inelastic_law(PlaneState::plane_strain);
  const double     N =
    (1. + std::sin(phi * degrees)) / (1. - std::sin(phi * degrees));
  const PlaneElasticity C = m.plane_elasticity(PlaneState::plane_strain);
  MaterialState         state;
  double                lateral_strain = 0., last_axial = 0., last_lateral = 0.;
  SymmetricTensor<2, 2> strain;
  InelasticLaw::Response r;
  for (unsigned int step = 0; step <= 40; ++step)
  {
    const double axial = -0.001 * step;
    for (unsigned int i = 0; i < 50; ++i)
    {
      strain[0][0]          = lateral_strain;
      strain[1][1]          = axial;
      r                     = evaluate(*inelastic, strain, state);
      const double residual = r.stress[0][0] - lateral;
      if (std::abs(residual) < 1e-12)
        break;
      lateral_strain -=
        residual / (r.is_elastic ? C.lambda + 2. * C.mu : r.tangent[0][0]);
    }
    ASSERT_NEAR(r.stress[0][0], lateral, 1e-11) << step;
    state = r.state;
    if (step == 39)
    {
      last_axial   = axial;
      last_lateral = lateral_strain;
    }
  }
  EXPECT_NEAR(r.stress[1][1], N * lateral - 2. * c * std::sqrt(N), 1e-10);
  // at the end all strain is plastic: d(epsilon_lateral) = -M d(epsilon_axial)
  const double M =
    (1. + std::sin(psi * degrees)) / (1. - std::sin(psi * degrees));
  EXPECT_NEAR((lateral_strain - last_lateral) / (strain[1][1] - last_axial),
              -M,
              1e-9);
}


/// Where flow is associated, the stress is the one that dissipates most of all admissible ones,
/// (sigma - tau) : Delta epsilon^p >= 0: true at the foot of the projection of the trial stress
/// only, whichever plane, edge or apex that is.
TEST(MohrCoulomb, DissipationIsLargest)
{
  std::mt19937 generator(8);
  unsigned int n_plastic = 0;
  for (const MohrCoulombLaw &mohr_coulomb : {law(30., 1., 30., 1e20),
                                             law(30., 1., 30., 0.3),
                                             law(0., 1., 0., 1e20),
                                             law(0., 1., 0., 0.5)})
  {
    const auto inelastic =
      rock(mohr_coulomb).inelastic_law(PlaneState::plane_strain);
    std::vector<InelasticLaw::Response> all;
    for (unsigned int i = 0; i < 300; ++i)
      all.push_back(evaluate(*inelastic, random_strain(generator, 0.01)));
    for (const InelasticLaw::Response &r : all)
    {
      n_plastic += !r.is_elastic;
      for (const InelasticLaw::Response &other : all)
        ASSERT_GE((r.stress - other.stress) * r.state.plastic_strain +
                    (r.stress_zz - other.stress_zz) * r.state.plastic_strain_zz,
                  -1e-12);
    }
  }
  EXPECT_GT(n_plastic, 1000u);
}


/// Plane stress is the law of three dimensions, here that of plane strain with a shifted plastic
/// strain, at the strain across the plane at which sigma_zz = 0. Three steps of a path, so that
/// they begin in states with plastic strain.
TEST(MohrCoulomb, PlaneStressAgainstSearchForTheStrainAcross)
{
  std::mt19937 generator(9);
  unsigned int n_plastic[3] = {};
  for (const MohrCoulombLaw &mohr_coulomb : plastic_laws())
  {
    if (mohr_coulomb.cohesion == 0.)
      continue;
    const Material m     = rock(mohr_coulomb);
    const auto     thin  = m.inelastic_law(PlaneState::plane_stress);
    const auto     solid = m.inelastic_law(PlaneState::plane_strain);
    for (unsigned int i = 0; i < 300; ++i)
    {
      MaterialState state;
      for (unsigned int step = 0; step < 3; ++step)
      {
        const SymmetricTensor<2, 2> strain = random_strain(generator, 0.005);
        const auto                  found  = evaluate(*thin, strain, state);
        const auto                  at     = [&](const double strain_zz) {
          MaterialState shifted = state;
          shifted.plastic_strain_zz -= strain_zz;
          InelasticLaw::Response r = evaluate(*solid, strain, shifted);
          r.state.plastic_strain_zz += strain_zz;
          return r;
        };
        double low = -0.5, high = 0.5;
        while (high - low > 1e-16)
        {
          const double middle = 0.5 * (low + high);
          if (middle == low || middle == high)
            break;
          (at(middle).stress_zz < 0. ? low : high) = middle;
        }
        const auto expected = at(high);
        // the strain is known to 1e-16, the moduli are 1000 Pa
        ASSERT_LT((found.stress - expected.stress).norm(), 1e-11) << i;
        EXPECT_LT(
          (found.state.plastic_strain - expected.state.plastic_strain).norm(),
          1e-13);
        EXPECT_NEAR(found.state.plastic_strain_zz,
                    expected.state.plastic_strain_zz,
                    1e-13);
        EXPECT_NEAR(found.strain_zz, high, 1e-13);
        EXPECT_NEAR(found.energy, expected.energy, 1e-13);
        EXPECT_NEAR(found.dissipated, expected.dissipated, 1e-13);
        if (!found.is_elastic)
        {
          const double mean = 0.5 * dealii::trace(found.stress);
          const double radius =
            std::sqrt(mean * mean - dealii::determinant(found.stress));
          ++n_plastic[(mean + radius > 1e-9) + (mean - radius > 1e-9)];
        }
        state = found.state;
      }
    }
  }
  // sigma_zz was the largest, the middle and the smallest principal stress
  for (const unsigned int n : n_plastic)
    EXPECT_GT(n, 200u);
}


/// Along one axis, the other one free: the strengths k = 2 c sqrt(N) in compression and k / N, or
/// the cut-off, in tension. Both axes: k also where both press equally, and k / N where both pull.
TEST(MohrCoulomb, StrengthInPlaneStress)
{
  constexpr double phi = 30., c = 1.;
  const double     N =
    (1. + std::sin(phi * degrees)) / (1. - std::sin(phi * degrees));
  const double k = 2. * c * std::sqrt(N);
  for (const double sigma_t : {1e20, 0.3})
  {
    const Material m         = rock(law(phi, c, 10., sigma_t));
    const auto     inelastic = m.inelastic_law(PlaneState::plane_stress);
    const double   tensile   = std::min(k / N, sigma_t);
    for (const double axial : {-0.02, 0.02})
    {
      const double          strength = axial < 0. ? -k : tensile;
      SymmetricTensor<2, 2> strain;
      strain[1][1] = axial;
      // the stress across the axis decreases with the strain across, up to both strengths
      double low = -0.1, high = 0.1;
      while (high - low > 1e-15)
      {
        strain[0][0] = 0.5 * (low + high);
        (evaluate(*inelastic, strain).stress[0][0] < 0. ? low : high) =
          strain[0][0];
      }
      // a strain of 1e-15 times 1000 Pa
      EXPECT_NEAR(evaluate(*inelastic, strain).stress[1][1], strength, 1e-11);
      strain[0][0]    = axial;
      const auto both = evaluate(*inelastic, strain);
      EXPECT_NEAR(both.stress[0][0], strength, 1e-12);
      EXPECT_NEAR(both.stress[1][1], strength, 1e-12);
      // in biaxial compression sigma_zz is the largest stress, towards which volume is lost
      if (axial < 0.)
      {
        EXPECT_NEAR(both.state.plastic_strain_zz /
                      dealii::trace(both.state.plastic_strain),
                    -(1. + std::sin(10. * degrees)) /
                      (1. - std::sin(10. * degrees)),
                    1e-10);
      }
    }
    // one pulls, the other one presses: N sigma_1 - sigma_3 = k or the cut-off
    SymmetricTensor<2, 2> strain;
    strain[0][0]     = 0.01;
    strain[1][1]     = -0.01;
    const auto mixed = evaluate(*inelastic, strain).stress;
    EXPECT_NEAR(N * mixed[0][0] - mixed[1][1], k, 1e-12);
  }
}


TEST(MohrCoulomb, NoStressIsReported)
{
  SymmetricTensor<2, 2> strain;
  strain[0][1] = std::numeric_limits<double>::quiet_NaN();
  InelasticLaw::Response r;
  EXPECT_TRUE(rock(law(30., 1., 0., 1e20))
                .inelastic_law(PlaneState::plane_strain)
                ->evaluate(strain, MaterialState(), r) ==
              Deformation::inverted);
}


/// Tension: no stress above the cut-off, and none above the apex without one.
TEST(MohrCoulomb, TensionIsCutOff)
{
  SymmetricTensor<2, 2>  strain;
  InelasticLaw::Response r;
  strain[0][0] = strain[1][1] = 0.01;
  for (const double sigma_t : {0.3, 1e20})
  {
    const auto inelastic =
      rock(law(30., 1., 0., sigma_t)).inelastic_law(PlaneState::plane_strain);
    r                  = evaluate(*inelastic, strain, MaterialState());
    const double limit = std::min(sigma_t, 1. / std::tan(30. * degrees));
    EXPECT_NEAR(r.stress[0][0], limit, 1e-12);
    EXPECT_NEAR(r.stress[1][1], limit, 1e-12);
    EXPECT_NEAR(r.stress[0][1], 0., 1e-12);
    EXPECT_LE(r.stress_zz, limit + 1e-12);
  }
}


TEST(MohrCoulomb, InitialStress)
{
  Material m             = rock(law(30., 1., 0., 1e20));
  m.initial_stress[0][0] = m.initial_stress[1][1] = -4.;
  InelasticLaw::Response r;
  r = evaluate(*m.inelastic_law(PlaneState::plane_strain),
               SymmetricTensor<2, 2>());
  EXPECT_TRUE(r.is_elastic);
  EXPECT_EQ(r.stress[0][0], -4.);
  // nu (xx + yy) unless it is given
  EXPECT_EQ(r.stress_zz, -2.);
  m.given_initial_stress_zz = -4.;
  r = evaluate(*m.inelastic_law(PlaneState::plane_strain),
               SymmetricTensor<2, 2>());
  EXPECT_EQ(r.stress_zz, -4.);
}


TEST(MohrCoulomb, ParametersAreChecked)
{
  EXPECT_NO_THROW(
    law(30., 1., 30., 0.).check("here", PlaneState::plane_strain));
  EXPECT_NO_THROW(law(30., 1., 0., 0.).check("here", PlaneState::plane_stress));
  EXPECT_THROW(law(30., 0., 0., 0.).check("here", PlaneState::plane_stress),
               InputError);
  EXPECT_THROW(law(30., 1., 31., 0.).check("here", PlaneState::plane_strain),
               InputError);
  EXPECT_THROW(law(0., 0., 0., 0.).check("here", PlaneState::plane_strain),
               InputError);
  EXPECT_THROW(law(30., -1., 0., 0.).check("here", PlaneState::plane_strain),
               InputError);
}
