// Contact laws on their own: potentials, strengths and their derivatives, published formulas.

#include <nmm/base/exceptions.h>
#include <nmm/contact/law/barton_bandis_law.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/contact/law/slip_weakening_law.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace NMM;

namespace
{
  BartonBandisLaw
  barton_bandis()
  {
    BartonBandisLaw law;
    law.normal_stiffness           = 2e10;
    law.joint_roughness            = 8.;
    law.joint_compressive_strength = 50e6;
    law.residual_angle             = 28.;
    law.sample_length              = 0.1;
    law.joint_length               = 1.;
    law.largest_closure            = 2e-4;
    return law;
  }


  SlipWeakeningLaw
  slip_weakening()
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = 1e9;
    law.friction          = 0.8;
    law.cohesion          = 2e5;
    law.residual_friction = 0.5;
    law.residual_cohesion = 3e4;
    law.weakening_length  = 4e-3;
    return law;
  }


  CoulombLaw
  coulomb_law()
  {
    CoulombLaw law;
    law.normal_stiffness = 1e9;
    law.friction         = 0.6;
    law.cohesion         = 1e5;
    return law;
  }


  /// The derivatives of a law against differences, whose error is some 1e-16 / 1e-6 by
  /// rounding and 1e-12 by curvature, and the mean pressure against the potential.
  void
  check_derivatives(const ContactLaw          &law,
                    const std::vector<double> &penetrations,
                    const std::vector<double> &pressures,
                    const std::vector<double> &slips)
  {
    constexpr double step = 1e-6;
    for (const double d : penetrations)
    {
      SCOPED_TRACE("penetration " + std::to_string(d));
      const double h = step * std::abs(d);
      const auto   p = law.pressure(d);
      EXPECT_NEAR((law.energy(d + h) - law.energy(d - h)) / (2. * h),
                  p.value,
                  1e-8 * std::abs(p.value));
      EXPECT_NEAR((law.pressure(d + h).value - law.pressure(d - h).value) /
                    (2. * h),
                  p.derivative,
                  1e-8 * p.derivative);
      EXPECT_NEAR(law.penetration(p.value), d, 1e-13 * std::abs(d));
      for (const double other : penetrations)
        for (const double d_1 : {other, d * (1. + 1e-4)})
        {
          const auto   mean = law.mean_pressure(d, d_1);
          const double work = law.energy(d_1) - law.energy(d);
          EXPECT_NEAR(mean.value * (d_1 - d),
                      work,
                      1e-12 * (law.energy(d_1) + law.energy(d)));
          const double k = step * std::max(std::abs(d), std::abs(d_1));
          EXPECT_NEAR((law.mean_pressure(d, d_1 + k).value -
                       law.mean_pressure(d, d_1 - k).value) /
                        (2. * k),
                      mean.derivative,
                      1e-6 * mean.derivative);
        }
    }
    for (const double p : pressures)
      for (const double slip : slips)
      {
        SCOPED_TRACE("pressure " + std::to_string(p));
        const auto   s = law.strength(p, slip);
        const double h = step * p, k = step * slip;
        EXPECT_NEAR((law.strength(p + h, slip).value -
                     law.strength(p - h, slip).value) /
                      (2. * h),
                    s.by_pressure,
                    1e-8 * s.value / p);
        EXPECT_NEAR((law.strength(p, slip + k).value -
                     law.strength(p, slip - k).value) /
                      (2. * k),
                    s.by_slip,
                    1e-8 * s.value / slip);
      }
  }


  TEST(ContactLaws, DerivativesAndPotentials)
  {
    // cohesions of 1e5 and 2e5, residual 3e4 Pa, grow up to 100, 200 and 30 Pa
    const std::vector<double> pressures = {10., 50., 1e4, 1e5, 1e6, 2e7};
    const std::vector<double> slips     = {1e-3, 3e-3, 1e-2};
    check_derivatives(coulomb_law(), {1e-5, 1e-3}, pressures, slips);
    check_derivatives(slip_weakening(), {1e-5, 1e-3}, pressures, slips);
    // up to the tangent beyond 0.99 of the largest closure, and bonded
    check_derivatives(barton_bandis(),
                      {1e-9, 1e-7, 1e-5, 1e-4, 1.9e-4, 2.5e-4},
                      pressures,
                      slips);
  }


  // Faces that close get no shear strength at once; see CoulombLaw. Fails for S = p tan(phi) + c.
  TEST(ContactLaws, CohesionGrowsWithPressure)
  {
    const SlipWeakeningLaw weakening = slip_weakening();
    for (const double slip : {0., 1.})
      EXPECT_EQ(weakening.strength(0., slip).value, 0.);
    EXPECT_EQ(coulomb_law().strength(0., 0.).value, 0.);
    EXPECT_NEAR(coulomb_law().strength(1e4, 0.).value,
                1e4 * coulomb_law().friction + coulomb_law().cohesion,
                1e-9);
  }


  // Barton & Choubey 1977 and Bandis et al. 1983, written out, within rounding.
  TEST(ContactLaws, BartonBandisFormulas)
  {
    const BartonBandisLaw law    = barton_bandis();
    const double          jrc    = 8. * std::pow(10., -0.02 * 8.);
    const double          jcs    = 50e6 * std::pow(10., -0.03 * 8.);
    constexpr double      degree = 0.017453292519943295;
    for (const double p : {1e5, 1e6, 5e6})
      EXPECT_NEAR(law.strength(p, 0.).value,
                  p * std::tan((28. + jrc * std::log10(jcs / p)) * degree),
                  1e-9 * p);
    // above JCS the residual angle, at low pressures 70 degrees at most
    EXPECT_NEAR(law.strength(1e8, 0.).value,
                1e8 * std::tan(28. * degree),
                1e-1);
    EXPECT_NEAR(law.strength(1e-3, 0.).value,
                1e-3 * std::tan(70. * degree),
                1e-12);
    EXPECT_EQ(law.strength(0., 0.).value, 0.);
    for (const double p : {1e5, 1e6, 2e7})
    {
      // p = k d / (1 - d / d_m)
      const double d = law.penetration(p);
      EXPECT_NEAR(2e10 * d / (1. - d / 2e-4), p, 1e-9 * p);
    }
  }


  TEST(ContactLaws, SlipWeakeningEndsAtTheResidualStrength)
  {
    const SlipWeakeningLaw law = slip_weakening();
    EXPECT_NEAR(law.strength(1e6, 0.).value, 0.8e6 + 2e5, 1e-6);
    EXPECT_NEAR(law.strength(1e6, 2e-3).value, 0.65e6 + 1.15e5, 1e-6);
    EXPECT_NEAR(law.strength(1e6, 4e-3).value, 0.5e6 + 3e4, 1e-6);
    EXPECT_NEAR(law.strength(1e6, 1.).value, 0.5e6 + 3e4, 1e-6);
  }


  // What ContactLaw asks of every law that scenes can choose: one potential on both sides of
  // d = 0, with a pressure by which points open at d < 0; bonds with anchors; and the search for
  // the factor of safety divides the whole strength.
  TEST(ContactLaws, AllDoAsTheirBaseClassSays)
  {
    for (const NamedContactLaw &named : contact_laws())
    {
      SCOPED_TRACE(named.name);
      std::unique_ptr<ContactLaw> law = named.law->clone();
      for (const ContactLaw::Parameter &parameter : law->parameters())
        if (parameter.key != "Dilation angle" &&
            parameter.key != "Dilation limit")
          *parameter.value = 0.5;
      law->is_bond = true;
      EXPECT_TRUE(law->transmits_shear());
      law->is_bond = false;
      EXPECT_EQ(law->energy(0.), 0.);
      EXPECT_EQ(law->pressure(0.).value, 0.);
      EXPECT_EQ(law->pressure(0.).derivative, law->normal_stiffness);
      EXPECT_LT(law->pressure(-0.1).value, 0.);
      EXPECT_NEAR(law->mean_pressure(0.1, 0.1).value,
                  law->pressure(0.1).value,
                  1e-15);
      check_derivatives(*law, {-0.3, -0.1, 0.1, 0.4}, {0.1}, {0.2});
      const auto reduced = law->clone();
      reduced->reduce_strength(1.6);
      const double before = law->strength(0.1, 0.2).value;
      EXPECT_GT(before, 0.);
      EXPECT_NEAR(reduced->strength(0.1, 0.2).value, before / 1.6, 1e-14);
    }
  }


  TEST(ContactLaws, WrongValuesAreNamed)
  {
    const auto rejects = [](ContactLaw        &law,
                            double            &value,
                            const double       wrong,
                            const std::string &name) {
      const double right = value;
      value              = wrong;
      try
      {
        law.check("the law");
        ADD_FAILURE() << name;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(error.message().find(name), std::string::npos)
          << error.message();
      }
      value = right;
      EXPECT_NO_THROW(law.check("the law"));
    };
    SlipWeakeningLaw weakening = slip_weakening();
    rejects(weakening, weakening.residual_friction, 0.9, "residual friction");
    rejects(weakening, weakening.residual_cohesion, 3e5, "residual cohesion");
    rejects(weakening, weakening.weakening_length, 0., "slip");
    rejects(weakening, weakening.dilation, 0.1, "dilation");
    BartonBandisLaw rough = barton_bandis();
    rejects(rough, rough.joint_roughness, 21., "roughness");
    rejects(rough, rough.joint_compressive_strength, 0., "compressive");
    rejects(rough, rough.residual_angle, 70., "residual");
    rejects(rough, rough.joint_length, 0., "length");
    rejects(rough, rough.largest_closure, -1., "closure");
  }
} // namespace
