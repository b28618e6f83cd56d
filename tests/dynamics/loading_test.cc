// Loads in time: histories, releases, moving ground and supports.

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  TimeHistory
  history_of(const std::string &text)
  {
    std::istringstream in(text);
    return TimeHistory::read(in, "quake.txt");
  }


  TEST(TimeHistory, InterpolatesAndIsZeroOutside)
  {
    const TimeHistory history =
      history_of("# t [s], a [m/s^2]\n0 1\n\n 0.5, 2\n2,-1\n");
    EXPECT_EQ(history(-0.1), 0.);
    EXPECT_EQ(history(0.), 1.);
    EXPECT_NEAR(history(0.25), 1.5, 1e-15);
    EXPECT_NEAR(history(1.25), 0.5, 1e-15);
    EXPECT_EQ(history(2.), -1.);
    EXPECT_EQ(history(2.1), 0.);
  }


  TEST(TimeHistory, RefusesBadFiles)
  {
    const auto message = [](const std::string &text) {
      try
      {
        history_of(text);
      }
      catch (const InputError &error)
      {
        return error.message();
      }
      return std::string("accepted");
    };
    EXPECT_NE(message("0 1\n1 x\n").find("line 2"), std::string::npos);
    EXPECT_NE(message("0 1\n1 2 3\n").find("line 2"), std::string::npos);
    EXPECT_NE(message("0 1\n\n0 2\n").find("line 3"), std::string::npos);
    EXPECT_NE(message("# nothing\n").find("no points"), std::string::npos);
    EXPECT_THROW(TimeHistory::read("no/such/file"), InputError);
  }


  /// A stiff column on the ground y = 0.
  Body
  column()
  {
    Body body = box({0., 0.}, {0.5, 1.}, 0.3, material("rock", 1e3, 0.2, 2.));
    body.model->problem.boundary_conditions = {
      condition(Type::displacement, "bottom")};
    return body;
  }


  /// The ground moved by prescribed displacements, and as inertia forces in relative
  /// coordinates, are the same motion.
  TEST(BaseAcceleration, AgreesWithPrescribedMotion)
  {
    // u_g = A (1 - cos(w t)), starts with zero velocity
    const double A = 1e-3, w = 6.;
    Body         relative = column(), absolute = column();
    Loading      shaken;
    shaken.base_acceleration = [=](const double t) {
      Tensor<1, 2> a;
      a[0] = A * w * w * std::cos(w * t);
      return a;
    };
    Loading moved;
    absolute.model->problem.boundary_conditions[0].value =
      vector_function([](const Point<2> &) {
        Tensor<1, 2> u;
        u[0] = 1.;
        return u;
      });
    moved.amplitudes = [=](const double t) {
      LoadAmplitudes amplitudes;
      amplitudes.boundary_conditions = {A * (1. - std::cos(w * t))};
      return amplitudes;
    };
    for (const bool is_small : {true, false})
    {
      if (is_small)
      {
        relative.make_small(shaken);
        absolute.make_small(moved);
      }
      else
      {
        relative.make_finite(shaken);
        absolute.make_finite(moved);
      }
      TimeIntegrator in_relative(*relative.mechanics,
                                 TimeScheme::energy_momentum());
      TimeIntegrator in_absolute(*absolute.mechanics,
                                 TimeScheme::energy_momentum());
      const double   h = 0.005;
      for (unsigned int i = 0; i < 160; ++i)
      {
        step(in_relative, h);
        step(in_absolute, h);
      }
      const auto [element, xi] = relative.model->locate({0.25, 0.99});
      const double u_relative =
        relative.field(in_relative.state().u).displacement(element, xi)[0];
      const double u_absolute =
        absolute.field(in_absolute.state().u).displacement(element, xi)[0];
      const double u_ground = A * (1. - std::cos(w * in_absolute.state().time));
      std::cout << "relative " << u_relative << ", absolute " << u_absolute
                << ", ground " << u_ground << '\n';
      // jumps at the start and the weak condition, of the mesh's order
      EXPECT_NEAR(u_relative + u_ground, u_absolute, 2e-3 * A);
      EXPECT_GT(std::abs(u_relative), 0.02 * A);
      // the energy account knows both kinds of work; that of supports is exact
      // for energies that are quadratic in u and linear motion
      for (const TimeIntegrator *i : {&in_relative, &in_absolute})
        EXPECT_LT(std::abs(i->account().balance),
                  1e-3 * std::abs(i->account().external_work))
          << i->account().balance << ' ' << i->account().external_work;
    }
  }


  TEST(Release, BodyFallsFreelyFromThenOn)
  {
    for (const bool is_small : {true, false})
    {
      Body body                      = column();
      body.model->problem.gravity[1] = -10.;
      Loading loading;
      loading.releases = {{Release::Kind::boundary_condition, 0, 0.1005}};
      if (is_small)
        body.make_small(loading);
      else
        body.make_finite(loading);
      // the jump excites what no step resolves: Newmark's scheme, stable for
      // linear problems only, would blow it up in the other one
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      StepControlParameters parameters;
      parameters.initial_step = 0.005;
      bool met_the_event      = false;
      StepControl(parameters).run(integrator, 0.5, [&](const StepRecord &) {
        met_the_event =
          met_the_event || std::abs(integrator.state().time - 0.1005) < 1e-12;
        return true;
      });
      EXPECT_TRUE(met_the_event);
      // M g t for the centre of mass from the release on, plus what it had
      const double   mass    = 2. * 0.5;
      const Account &account = integrator.account();
      // before, the momentum of the vibration under suddenly applied weight
      const double fall = -10. * mass * (0.5 - 0.1005);
      EXPECT_NEAR(account.linear_momentum[1], fall, 0.1 * std::abs(fall));
      EXPECT_NEAR(integrator.state().time, 0.5, 1e-9);
      EXPECT_LT(std::abs(account.balance), 1e-3 * account.kinetic);
    }
  }


  TEST(Release, RefusesLoadsAndUnknownConditions)
  {
    Body body = column();
    body.model->problem.boundary_conditions.push_back(
      condition(Type::pressure, "top", constant(1.)));
    Loading loading;
    loading.releases = {{Release::Kind::boundary_condition, 1, 0.1}};
    EXPECT_THROW(body.make_small(loading), InputError);
    loading.releases = {{Release::Kind::fixed_point, 0, 0.1}};
    EXPECT_THROW(body.make_small(loading), InputError);
  }


  TEST(Mass, MaterialWithoutDensityIsRefused)
  {
    Body body                                = column();
    body.model->problem.materials[0].density = 0.;
    EXPECT_THROW(body.make_small(), InputError);
  }
} // namespace
