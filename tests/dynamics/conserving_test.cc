// The energy-momentum conserving scheme on free bodies.

#include <nmm/materials/material.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  Body
  free_square(const std::shared_ptr<const MaterialLaw> &law,
              const PlaneState                          state,
              const double                              youngs_modulus,
              const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    Material rock = material("rock", youngs_modulus, 0.3, 1.);
    rock.law      = law;
    Body body     = box({-0.5, -0.5}, {0.5, 0.5}, 0.4, rock, communicator);
    body.model->problem.plane_state = state;
    body.make_finite();
    return body;
  }


  /// Drifts over a run, relative to the start.
  struct Drift
  {
    double energy = 0., angular_momentum = 0., area = 0., linear_momentum = 0.;
  };


  Drift
  run(const Body &body, TimeIntegrator &integrator, const double h, const int n)
  {
    const Account start = integrator.account();
    const double  area  = body.area(integrator.state().u);
    Drift         drift;
    for (int i = 0; i < n; ++i)
    {
      step(integrator, h);
      const Account &now = integrator.account();
      drift.energy =
        std::max(drift.energy,
                 std::abs(now.balance) / (start.kinetic + start.strain));
      drift.angular_momentum =
        std::max(drift.angular_momentum,
                 std::abs(now.angular_momentum / start.angular_momentum - 1.));
      drift.linear_momentum =
        std::max(drift.linear_momentum,
                 (now.linear_momentum - start.linear_momentum).norm());
      if (i % 12 == 0)
        drift.area =
          std::max(drift.area,
                   std::abs(body.area(integrator.state().u) / area - 1.));
    }
    return drift;
  }


  TEST(Conserving, StiffSquareTurnsTenTimes)
  {
    // the centrifugal strain, rho omega^2 / (12 E), is below what is asked for
    // of the area
    Body body =
      free_square(material_law("linear"), PlaneState::plane_strain, 1e10);
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    RigidVelocity  spin;
    spin.angular_velocity = 1.;
    integrator.initialize(body.zero(), body.velocity(spin));
    // 36 steps a revolution: the scheme turns by 2 atan(omega h / 2) in a step
    const double h =
      2. * std::tan(dealii::numbers::PI / 36.) / spin.angular_velocity;
    const Drift drift = run(body, integrator, h, 360);
    std::cout << "energy " << drift.energy << ", angular momentum "
              << drift.angular_momentum << ", area " << drift.area << '\n';
    EXPECT_LT(drift.area, 1e-10);
    EXPECT_LT(drift.energy, 1e-8);
    // rounding of 360 steps
    EXPECT_LT(drift.angular_momentum, 1e-12);
    EXPECT_LT(drift.linear_momentum, 1e-12);

    // it is back where it was: ten revolutions, within the stretch
    Vector u = integrator.state().u;
    EXPECT_LT(u.linfty_norm(), 1e-6);
  }


  TEST(Conserving, SoftBodiesKeepEnergyAndMomenta)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
      for (const PlaneState state :
           {PlaneState::plane_strain, PlaneState::plane_stress})
      {
        Body           body = free_square(law, state, 20.);
        TimeIntegrator integrator(*body.mechanics,
                                  TimeScheme::energy_momentum());
        integrator.initialize(body.zero(), body.velocity([](const Point<2> &x) {
          Tensor<1, 2> v;
          v[0] = 0.3 - x[1] + 0.6 * x[0];
          v[1] = 0.1 + x[0] + 0.5 * x[0] * x[1];
          return v;
        }));
        const Drift drift = run(body, integrator, 0.1, 60);
        std::cout << "energy " << drift.energy << ", angular momentum "
                  << drift.angular_momentum << ", linear "
                  << drift.linear_momentum << ", area " << drift.area
                  << ", strain energy " << integrator.account().strain << '\n';
        // the tolerance of Newton's method, 1e-9 of forces, times the
        // quadratic last step; momenta do not depend on it
        EXPECT_LT(drift.energy, 1e-9);
        EXPECT_LT(drift.angular_momentum, 1e-13);
        EXPECT_LT(drift.linear_momentum, 1e-13);
        // this is no small motion
        EXPECT_GT(drift.area, 0.01);
      }
  }


  TEST(Conserving, TangentIsTheDerivativeByTheMean)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
      for (const PlaneState state :
           {PlaneState::plane_strain, PlaneState::plane_stress})
      {
        Body         body = free_square(law, state, 20.);
        const double h    = 0.1;
        body.solid->damp({0., 0.05}, /* is_conserving = */ true);
        std::mt19937                           generator(7);
        std::uniform_real_distribution<double> random(-0.15, 0.15);
        const auto                             field = [&] {
          Tensor<2, 2> G;
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              G[i][j] = random(generator);
          return body.velocity(
            [=](const Point<2> &x) { return G * x + 0.2 * x.norm() * x; });
        };
        const Vector begin = field(), end = field(), direction = field();
        const auto   relevant = [&](const Vector &v) {
          Vector result(body.mechanics->layout().locally_owned,
                        body.mechanics->layout().locally_relevant,
                        body.mechanics->layout().communicator);
          result = v;
          return result;
        };
        const auto residual = [&](const double share, const bool with_tangent) {
          Vector at(end);
          at.add(share, direction);
          const Vector from = relevant(begin), to = relevant(at);
          Trial        trial =
            Trial::step(from, to, 0., h, /* is_conserving = */ true);
          trial.tangent = with_tangent ? Tangent::consistent : Tangent::none;
          EXPECT_EQ(body.mechanics->assemble(trial), Deformation::admissible);
          return Vector(*body.mechanics->forces().residual);
        };
        const double step = 1e-5;
        Vector       difference(residual(step, false));
        difference -= residual(-step, false);
        difference *= 1. / step; // twice the derivative by the end
        residual(0., true);
        Vector product(begin);
        Vector free(direction);
        body.model->constraints.set_zero(free);
        body.mechanics->forces().tangent->vmult(product, free);
        body.model->constraints.set_zero(product);
        const double norm = product.l2_norm();
        product -= difference;
        // truncation and rounding of the difference
        EXPECT_LT(product.l2_norm(), 1e-8 * norm);
      }
  }


  // A turn is not damped, wherever the body is in it: what is left of the damping is
  // of the strain that comes with the spin, rho omega^2 / (12 E) = 1e-11.
  TEST(Conserving, DampingDoesNotStopTurning)
  {
    Body body =
      free_square(material_law("linear"), PlaneState::plane_strain, 1e10);
    body.solid->damp({/* mass = */ 0., /* stiffness = */ 1e-2},
                     /* is_conserving = */ true);
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    RigidVelocity  spin;
    spin.angular_velocity = 1.;
    integrator.initialize(body.zero(), body.velocity(spin));
    const double kinetic = integrator.account().kinetic;
    const Drift  drift   = run(body, integrator, 0.15, 60);
    // what Newton's method leaves, 1e-9 of the forces
    EXPECT_LT(drift.angular_momentum, 1e-9);
    EXPECT_LT(drift.energy, 1e-8);
    EXPECT_NEAR(integrator.account().kinetic, kinetic, 1e-8 * kinetic);
  }


  // Energy goes, and the account says where it went; the momenta stay. In the end the
  // body turns as a rigid one.
  TEST(Conserving, DampedSoftBodiesKeepMomenta)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
    {
      Body body = free_square(law, PlaneState::plane_strain, 20.);
      body.solid->damp({/* mass = */ 0., /* stiffness = */ 0.05},
                       /* is_conserving = */ true);
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      integrator.initialize(body.zero(), body.velocity([](const Point<2> &x) {
        Tensor<1, 2> v;
        v[0] = 0.3 - x[1] + 0.6 * x[0];
        v[1] = 0.1 + x[0] + 0.5 * x[0] * x[1];
        return v;
      }));
      const double kinetic = integrator.account().kinetic;
      double       last    = 0.;
      Drift        drift;
      for (unsigned int i = 0; i < 4; ++i)
      {
        drift = run(body, integrator, 0.1, 25);
        EXPECT_GT(integrator.account().dissipated, last);
        last = integrator.account().dissipated;
        EXPECT_LT(drift.energy, 1e-9);
        EXPECT_LT(drift.angular_momentum, 1e-13);
        EXPECT_LT(drift.linear_momentum, 1e-13);
      }
      EXPECT_GT(last, 0.01 * kinetic);
      // beside that of its translation, of 1 kg/m
      const auto turning = [&] {
        const Account &now = integrator.account();
        return now.kinetic - 0.5 * now.linear_momentum.norm_square();
      };
      const double before = turning();
      run(body, integrator, 0.1, 10);
      // what still vibrates has decayed by exp(-beta omega^2 t / 2) with the lowest
      // omega^2, about 40: by e^-10
      EXPECT_NEAR(turning(), before, 1e-4 * before);
    }
  }


  // Small vibrations: the same as Rayleigh's matrix, to the amplitude, 1e-6.
  TEST(Conserving, DampingOfSmallVibrationsIsRayleighs)
  {
    const auto at_end = [](const bool is_finite) {
      Body body =
        free_square(material_law("linear"), PlaneState::plane_strain, 20.);
      if (!is_finite)
        body.make_small();
      body.solid->damp({/* mass = */ 0., /* stiffness = */ 0.02},
                       /* is_conserving = */ true);
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      integrator.initialize(body.zero(), body.velocity([](const Point<2> &x) {
        return 1e-6 * Tensor<1, 2>({x[0] + x[1] * x[1], -0.3 * x[0]});
      }));
      for (unsigned int i = 0; i < 20; ++i)
        step(integrator, 0.05);
      EXPECT_GT(integrator.account().dissipated,
                0.1 * integrator.account().kinetic);
      return std::make_pair(integrator.state().u,
                            integrator.account().dissipated);
    };
    const auto [u, lost]       = at_end(true);
    const auto [other, energy] = at_end(false);
    Vector difference(u);
    difference -= other;
    EXPECT_LT(difference.l2_norm(), 1e-5 * u.l2_norm());
    EXPECT_NEAR(lost, energy, 1e-5 * energy);
  }


  TEST(ConstantAcceleration, TurningBodiesLoseEnergy)
  {
    Body body =
      free_square(material_law("linear"), PlaneState::plane_strain, 1e10);
    TimeIntegrator integrator(*body.mechanics,
                              TimeScheme::constant_acceleration());
    RigidVelocity  spin;
    spin.angular_velocity = 1.;
    integrator.initialize(body.zero(), body.velocity(spin));
    const double kinetic = integrator.account().kinetic;
    for (unsigned int i = 0; i < 36; ++i)
      step(integrator, 2. * dealii::numbers::PI / 36.);
    std::cout << "kinetic energy left after 36 steps: "
              << integrator.account().kinetic / kinetic << '\n';
    EXPECT_LT(integrator.account().kinetic, 0.9 * kinetic);
  }
} // namespace
