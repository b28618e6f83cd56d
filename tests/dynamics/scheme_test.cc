// Time integration schemes: damping of what is not resolved, order in the step,
// frequencies and waves of bars and beams.

#include <deal.II/lac/trilinos_solver.h>

#include <array>
#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  const TimeScheme trapezoidal = TimeScheme::newmark();

  /// Growth per step of the oscillator with frequency * step = Omega: the largest
  /// eigenvalue of what a step does to (u, h v, h^2 a), by squaring.
  double
  spectral_radius(const TimeScheme &scheme, const double Omega)
  {
    using Matrix3  = std::array<std::array<double, 3>, 3>;
    const double h = 0.1;
    Oscillators  model(Omega * Omega / (h * h), 1.);
    Matrix3      A{};
    for (unsigned int j = 0; j < 3; ++j)
    {
      TimeIntegrator integrator(model, scheme);
      DynamicState   state = integrator.state();
      state.u = state.v = state.a = 0.;
      (j == 0   ? state.u
       : j == 1 ? state.v
                : state.a)(0)     = std::pow(h, -double(j));
      integrator.restore(state);
      step(integrator, h);
      A[0][j] = integrator.state().u(0);
      A[1][j] = integrator.state().v(0) * h;
      A[2][j] = integrator.state().a(0) * h * h;
    }
    double           log_norm = 0.;
    constexpr double n        = 30;
    for (unsigned int k = 0; k <= n; ++k)
    {
      double norm = 0.;
      for (const auto &row : A)
        for (const double a : row)
          norm = std::max(norm, std::abs(a));
      log_norm = 2. * log_norm + std::log(norm);
      Matrix3 square{};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int l = 0; l < 3; ++l)
            square[i][j] += A[i][l] * A[l][j] / (norm * norm);
      A = square;
    }
    return std::exp(log_norm / std::pow(2., n));
  }


  TEST(Schemes, GeneralizedAlphaHasTheChosenSpectralRadius)
  {
    for (const double rho : {0., 0.3, 0.5, 0.8, 1.})
    {
      // the eigenvalue is triple at infinite frequency: rounding enters
      // with its cube root
      EXPECT_NEAR(spectral_radius(TimeScheme::generalized_alpha(rho), 1e5),
                  rho,
                  1e-3)
        << rho;
      // what is resolved is kept: the damping is of third order in Omega
      EXPECT_NEAR(spectral_radius(TimeScheme::generalized_alpha(rho), 0.05),
                  1.,
                  1e-4);
    }
    EXPECT_NEAR(spectral_radius(trapezoidal, 1e3), 1., 1e-6);
    EXPECT_NEAR(spectral_radius(TimeScheme::energy_momentum(), 1e3), 1., 1e-6);
    // that of u = 2 (1 + Omega^2 / 2)^-1 ...: |lambda|^2 = 1 / (1 + Omega^2/2)
    EXPECT_NEAR(spectral_radius(TimeScheme::constant_acceleration(), 0.5),
                1. / std::sqrt(1. + 0.125),
                1e-6);
  }


  TEST(Schemes, RefuseCoefficientsThatGrow)
  {
    EXPECT_THROW(TimeScheme::newmark(0.25, 0.4).check(), InputError);
    EXPECT_THROW(TimeScheme::newmark(0., 0.5).check(), InputError);
    EXPECT_THROW(TimeScheme::generalized_alpha(1.2), InputError);
  }


  TEST(Schemes, RayleighDampingOfAnOscillator)
  {
    // xi = (alpha / omega + beta omega) / 2 = 0.05 + 0.02
    const double   omega = 2., alpha = 0.2, beta = 0.02;
    Oscillators    model(omega * omega, 1., 1., {alpha, beta});
    TimeIntegrator integrator(model, trapezoidal);
    Vector         u(model.layout().locally_owned, MPI_COMM_SELF), v(u);
    u(0) = 1.;
    integrator.initialize(u, v);
    const double h = 1e-3;
    while (integrator.state().time < 3. - 0.5 * h)
      step(integrator, h);
    const double xi = 0.07, t = integrator.state().time;
    const double omega_d = omega * std::sqrt(1. - xi * xi);
    const double exact =
      std::exp(-xi * omega * t) *
      (std::cos(omega_d * t) + xi * omega / omega_d * std::sin(omega_d * t));
    // order 2: (omega h)^2 / 12 * omega t
    EXPECT_NEAR(integrator.state().u(0), exact, 4e-6);
    // all of the energy is accounted for
    // (rounding of 3000 steps)
    EXPECT_NEAR(integrator.account().balance, 0., 1e-11);
    EXPECT_GT(integrator.account().dissipated, 0.5);
  }


  /// A bar along x on rollers at the left end, free at the right, nu = 0: motion
  /// along x is that of the one-dimensional bar.
  Body
  bar(const double length, const double height, const double cell_size)
  {
    Body body =
      box({0., 0.}, {length, height}, cell_size, material("rock", 4., 0., 1.));
    body.model->problem.boundary_conditions = {
      condition(Type::normal_displacement, "left")};
    return body;
  }


  /// Error at the tip after 5/8 of the first period, started in that mode,
  /// relative to the amplitude.
  double
  tip_error(const Body        &body,
            const TimeScheme  &scheme,
            const double       length,
            const unsigned int n_steps)
  {
    const double   omega     = 0.5 * dealii::numbers::PI * 2. / length;
    const double   end       = 0.625 * 2. * dealii::numbers::PI / omega;
    const double   amplitude = 1e-4;
    TimeIntegrator integrator(*body.mechanics, scheme);
    integrator.initialize(body.zero(), body.velocity([&](const Point<2> &x) {
      Tensor<1, 2> v;
      v[0] =
        amplitude * omega * std::sin(0.5 * dealii::numbers::PI * x[0] / length);
      return v;
    }));
    for (unsigned int i = 0; i < n_steps; ++i)
      step(integrator, end / n_steps);
    const auto [element, xi] = body.model->locate({0.999 * length, 0.2});
    const double exact       = amplitude *
                         std::sin(0.5 * dealii::numbers::PI * 0.999) *
                         std::sin(omega * end);
    return std::abs(
             body.field(integrator.state().u).displacement(element, xi)[0] -
             exact) /
           amplitude;
  }


  TEST(Bar, OrderInTheStep)
  {
    const double length = 2.;
    Body         body   = bar(length, 0.4, 0.25);
    body.make_small();
    const auto rate = [&](const TimeScheme &scheme) {
      // the mesh's error, 1e-6 (see the test of frequencies), is far below
      const double coarse = tip_error(body, scheme, length, 40);
      const double fine   = tip_error(body, scheme, length, 80);
      std::cout << scheme.name << ": " << coarse << " -> " << fine << '\n';
      return std::log2(coarse / fine);
    };
    EXPECT_NEAR(rate(trapezoidal), 2., 0.05);
    EXPECT_NEAR(rate(TimeScheme::generalized_alpha(0.6)), 2., 0.1);
    EXPECT_NEAR(rate(TimeScheme::energy_momentum()), 2., 0.05);
    EXPECT_NEAR(rate(TimeScheme::constant_acceleration()), 1., 0.1);
  }


  /// omega_1 by inverse iteration.
  double
  first_frequency(const Body &body)
  {
    (void)body.mechanics->assemble(
      Trial::at(body.zero(), 0., Tangent::consistent));
    const MechanicalModel::Matrix &K = *body.mechanics->forces().tangent;
    const MechanicalModel::Matrix &M = *body.mechanics->layout().mass;
    dealii::SolverControl          control;
    dealii::TrilinosWrappers::SolverDirect solver(control);
    solver.initialize(K);
    Vector x = body.velocity([](const Point<2> &p) {
      Tensor<1, 2> v;
      v[0] = v[1] = p[0];
      return v;
    });
    Vector y(x);
    double square = 0.;
    for (unsigned int i = 0; i < 30; ++i)
    {
      body.model->constraints.set_zero(x);
      M.vmult(y, x);
      body.model->constraints.set_zero(y);
      y /= std::sqrt(x * y);
      solver.solve(x, y);
      // Rayleigh's quotient, with K x = y
      const double strain = x * y;
      M.vmult(y, x);
      square = strain / (x * y);
    }
    return std::sqrt(square);
  }


  TEST(Bar, FirstFrequencyConvergesInTheMeshSize)
  {
    const double length = 2.;
    const double exact  = 0.5 * dealii::numbers::PI * 2. / length;
    double       errors[2];
    for (unsigned int i = 0; i < 2; ++i)
    {
      Body body = bar(length, 0.4, i == 0 ? 0.8 : 0.4);
      // held in y as well, which does not disturb motion along x
      body.model->problem.boundary_conditions.push_back(
        condition(Type::normal_displacement, "bottom"));
      body.make_small();
      errors[i] = std::abs(first_frequency(body) / exact - 1.);
    }
    std::cout << "axial frequency: " << errors[0] << " -> " << errors[1]
              << '\n';
    EXPECT_LT(errors[1], 5e-6);
    // order 2p = 4 of frequencies, on cut meshes of two sizes not sharply
    EXPECT_GT(std::log2(errors[0] / errors[1]), 3.3);
  }


  /// Frequency parameter b of a Timoshenko cantilever, nearest to 3.516: Huang, J. Appl.
  /// Mech. 28 (1961) 579, eq. (49).
  double
  timoshenko(const double r2, const double s2)
  {
    const auto f = [&](const double b) {
      const double root  = std::sqrt((r2 - s2) * (r2 - s2) + 4. / (b * b));
      const double alpha = std::sqrt(0.5 * (root - (r2 + s2)));
      const double beta  = std::sqrt(0.5 * (root + (r2 + s2)));
      return 2. +
             (b * b * (r2 - s2) * (r2 - s2) + 2.) * std::cosh(b * alpha) *
               std::cos(b * beta) -
             b * (r2 + s2) / std::sqrt(1. - b * b * r2 * s2) *
               std::sinh(b * alpha) * std::sin(b * beta);
    };
    double low = 2., high = 4.;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double middle                     = 0.5 * (low + high);
      (f(low) * f(middle) <= 0. ? high : low) = middle;
    }
    return low;
  }


  TEST(Cantilever, FirstFrequencyOfTimoshenko)
  {
    const double length = 5., height = 0.5;
    Body         body =
      box({0., 0.}, {length, height}, 0.25, material("rock", 1e4, 0., 1.));
    body.model->problem.boundary_conditions = {
      condition(Type::displacement, "left")};
    body.make_small();
    const double r2 = height * height / 12. / (length * length);
    // E / (kappa G) with kappa = 5/6 at nu = 0
    const double b = timoshenko(r2, r2 * 2. / (5. / 6.));
    const double exact =
      b * std::sqrt(1e4 * height * height / 12.) / (length * length);
    const double computed = first_frequency(body);
    std::cout << "b = " << b << ", bending frequency " << computed / exact - 1.
              << '\n';
    // the beam theory's own error, (height / length)^4, and the elasticity of
    // the clamped corners
    EXPECT_NEAR(computed / exact, 1., 5e-4);
  }


  /// Mean time and sum of the velocity's pulse at a point.
  struct Arrival
  {
    double sum = 0., moment = 0.;
  };


  // Until the pulse has been at the free end twice; in Debug once, as hundreds of steps of
  // the same kind pass no further assertions.
#ifdef DEBUG
  constexpr unsigned int n_arrivals = 1;
#else
  constexpr unsigned int n_arrivals = 2;
#endif

  /// A Gaussian pulse that runs from x = 3 to the free end at 10, back to the
  /// rollers at 0 and again to the free end. Returns arrivals and energy drift.
  std::pair<std::array<Arrival, 2>, double>
  run_pulse(const Body &body, const TimeScheme &scheme, const double strain)
  {
    const double   c = 2., start = 3., width = 0.6, h = 0.04;
    const double   root = std::sqrt(2.) * width;
    TimeIntegrator integrator(*body.mechanics, scheme);
    integrator.initialize(body.velocity([&](const Point<2> &x) {
      Tensor<1, 2> u;
      u[0] = -strain * width * std::sqrt(dealii::numbers::PI / 2.) *
             (std::erf((x[0] - start) / root) + std::erf(start / root));
      return u;
    }),
                          body.velocity([&](const Point<2> &x) {
                            Tensor<1, 2> v;
                            const double s = (x[0] - start) / width;
                            v[0] = c * strain * std::exp(-0.5 * s * s);
                            return v;
                          }));
    const auto [element, xi] = body.model->locate({9.999, 0.2});
    std::array<Arrival, 2> arrivals;
    double                 drift = 0.;
    for (unsigned int i = 0; i * h < (n_arrivals == 1 ? 5.5 : 15.5); ++i)
    {
      step(integrator, h);
      const Account &account = integrator.account();
      drift                  = std::max(drift,
                       std::abs(account.balance) /
                         (account.kinetic + account.strain));
      const double t         = integrator.state().time;
      const double v =
        body.field(integrator.state().v).displacement(element, xi)[0];
      Arrival &arrival = arrivals[t < 8.5 ? 0 : 1];
      arrival.sum += v * h;
      arrival.moment += v * h * t;
    }
    // twice the pulse at the free end, width sqrt(2 pi)
    for (unsigned int i = 0; i < n_arrivals; ++i)
    {
      Arrival &arrival = arrivals[i];
      arrival.moment /= arrival.sum;
      arrival.sum /= 2. * strain * width * std::sqrt(2. * dealii::numbers::PI);
    }
    return {arrivals, drift};
  }


  void
  check_pulse(const Body &body, const TimeScheme &scheme, const double strain)
  {
    const auto [arrivals, drift] = run_pulse(body, scheme, strain);
    std::cout << scheme.name << ": first arrival "
              << arrivals[0].moment / 3.5 - 1. << " off, energy drift " << drift
              << '\n';
    EXPECT_NEAR(arrivals[0].moment, 3.5, 0.005 * 3.5);
    // a free end keeps the sign of the velocity, a fixed one turns it
    EXPECT_NEAR(arrivals[0].sum, 1., 0.01);
    if (n_arrivals == 2)
    {
      EXPECT_NEAR(arrivals[1].moment, 13.5, 0.005 * 13.5);
      EXPECT_NEAR(arrivals[1].sum, -1., 0.01);
    }
    // rounding of some hundred steps
    EXPECT_LT(drift, 1e-10);
  }


  TEST(Bar, PulseIsReflectedWithoutLoss)
  {
    Body body = bar(10., 0.4, 0.3);
    body.make_small();
    check_pulse(body, trapezoidal, 1e-3);
    check_pulse(body, TimeScheme::energy_momentum(), 1e-3);
  }


  TEST(Bar, PulseIsReflectedWithoutLossInFiniteKinematics)
  {
    Body body = bar(10., 0.4, 0.3);
    body.make_finite();
    // St. Venant-Kirchhoff's waves are faster by 3/2 of the strain
    check_pulse(body, TimeScheme::energy_momentum(), 1e-4);
  }
} // namespace
