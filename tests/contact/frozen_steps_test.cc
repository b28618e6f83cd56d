// Contact in steps that keep the geometry of their beginning.

#include <contact/two_and_one.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Steps without conserving forces, in which contact keeps the geometry of their beginning.
  class FrozenStep : public TwoAndOne
  {
  protected:
    static constexpr double stiffness = 1e8, depth = 0.2 * gap;

    /// Let the block above press on the one below from the start of a step on, with the @p cohesion
    /// of their faces.
    void
    press(const double cohesion)
    {
      auto parameters              = contact_parameters(stiffness, reach);
      coulomb(parameters).cohesion = cohesion;
      bodies->start(parameters);
      Contact &contact = *bodies->contact;
      begin_step();
      contact.assemble(moved({0., -gap - depth}, 0.), false);
      contact.accept();
      contact.freeze_geometry(true);
      contact.detect(moved({0., -gap - depth}, 0.));
      ContactTimeStep(contact).begin(moved({0., -gap - depth}, 0.), h);
      contact.set_time(2. * h);
    }

    /// The block above is moved, and the one below turned about the middle of its upper face, both
    /// as if rotations were small.
    Vector
    moved(const Point<2> &way, const double turn)
    {
      return bodies->interpolate(
        [&](const Point<2> &X, const unsigned int block) {
          return block == above ? way : turn * Point<2>(1. - X[1], X[0] - 1.5);
        });
    }

    /// Contact forces [N/m] at a displacement.
    Vector
    forces(const Vector &u)
    {
      bodies->contact->assemble(u, false);
      return bodies->contact->residual();
    }
  };


  // Forces are linear as long as points stay closed, until the geometry is released.
  TEST_F(FrozenStep, ForcesAreLinear)
  {
    press(/* cohesion = */ 0.);
    Contact       &contact = *bodies->contact;
    const Point<2> way(0.01, -gap - depth);
    const auto     curvature = [&]() {
      constexpr double turn  = 1e-3;
      Vector           r     = forces(moved(way, 0.));
      const double     scale = r.l2_norm();
      r.sadd(-2., 1., forces(moved(way, turn)));
      r.add(1., forces(moved(way, -turn)));
      return r.l2_norm() / scale;
    };
    // Forces are differences of positions of 2 m, a thousand times the depth.
    EXPECT_LE(curvature(), 1e-11);
    contact.freeze_geometry(false);
    // The normal turns by 1e-3, the gap of a point changes by the square of that times 0.5 m, and
    // forces follow from a depth of 2e-3 m.
    EXPECT_GE(curvature(), 1e-5);
  }


  // Cohesion is that of the beginning, whether a point opens in the step or not.
  TEST_F(FrozenStep, CohesionOfTheBeginning)
  {
    constexpr double cohesion = 1e4, slide = 0.01, length = 1.;
    press(cohesion);
    Contact   &contact = *bodies->contact;
    const auto force   = [&](const double depth_now) {
      (void)forces(moved({slide, -gap - depth_now}, 0.));
      return contact.report().force;
    };
    const double pressure = stiffness * depth;
    EXPECT_NEAR(std::abs(force(depth)[0]), cohesion * length, 1e-9 * cohesion);
    EXPECT_NEAR(std::abs(force(depth)[1]), pressure * length, 1e-9 * pressure);
    EXPECT_NEAR(std::abs(force(-depth)[0]), cohesion * length, 1e-9 * cohesion);
    EXPECT_EQ(force(-depth)[1], 0.);
    contact.freeze_geometry(false);
    EXPECT_EQ(force(-depth).norm(), 0.);
    contact.accept();
    // An open point has no cohesion in the next step, even if it closes.
    contact.freeze_geometry(true);
    contact.detect(moved({slide, -gap + depth}, 0.));
    ContactTimeStep(contact).begin(moved({slide, -gap + depth}, 0.), 2. * h);
    (void)forces(moved({2. * slide, -gap - depth}, 0.));
    EXPECT_EQ(contact.report().force[0], 0.);
    EXPECT_NEAR(std::abs(contact.report().force[1]),
                pressure * length,
                1e-9 * pressure);
  }


  // What cohesion bears at the end of a step it bears at the beginning of the next one: blocks that
  // hang on cohesion do not creep in a relaxation.
  TEST_F(FrozenStep, CohesionBearsShearFromStepToStep)
  {
    constexpr double cohesion = 1e4, length = 1.;
    // half of what the cohesion can bear
    constexpr double slide = 0.5 * cohesion / stiffness;
    press(cohesion);
    Contact     &contact = *bodies->contact;
    const Vector end     = moved({slide, -gap - depth}, 0.);
    (void)forces(end);
    for (const double time : {2. * h, 3. * h})
    {
      contact.freeze_geometry(false);
      (void)forces(end);
      contact.accept();
      contact.freeze_geometry(true);
      contact.detect(end);
      ContactTimeStep(contact).begin(end, time);
      EXPECT_NEAR(std::abs(contact.report().force[0]),
                  0.5 * cohesion * length,
                  1e-9 * cohesion);
      (void)forces(end);
      EXPECT_NEAR(std::abs(contact.report().force[0]),
                  0.5 * cohesion * length,
                  1e-9 * cohesion);
    }
  }
} // namespace
