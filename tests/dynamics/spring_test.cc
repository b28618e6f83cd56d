// Springs between material points, and what a term that couples blocks may expect of others.

#include <nmm/dynamics/relaxation.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/spring_term.h>

#include <deal.II/lac/full_matrix.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{

  /// Blocks that lie apart, a square of each size with the lower left corner at (2 i, 0).
  Body
  squares(const std::vector<double> &sizes,
          const double               youngs_modulus,
          const MPI_Comm             communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    for (unsigned int i = 0; i < sizes.size(); ++i)
    {
      const double x = 2. * i, a = sizes[i];
      geometry.add_polygon({{x, 0.}, {x + a, 0.}, {x + a, a}, {x, a}},
                           "block " + std::to_string(i));
    }
    Body         body;
    Tensor<1, 2> offset;
    offset[0]                     = 0.217;
    offset[1]                     = 0.119;
    body.model                    = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.7, offset, 17.),
                                         2,
                                         Stabilization::aggregation,
                                         communicator);
    body.model->problem.materials = {material("rock", youngs_modulus, 0.2, 2.)};
    return body;
  }


  /// A body with springs.
  struct Sprung
  {
    Sprung(Body                       body_in,
           const Kinematics           kinematics,
           const std::vector<Spring> &list,
           Loading                    loading = {})
      : body(std::move(body_in))
    {
      if (kinematics == Kinematics::small)
        body.make_small(std::move(loading));
      else
        body.make_finite(std::move(loading));
      const ModelLayout &layout = body.solid->layout();
      springs = std::make_unique<SpringTerm>(body.model->covers,
                                             layout,
                                             list,
                                             kinematics);
      model   = std::make_unique<MechanicalModel>(
        layout, std::vector<ForceTerm *>{body.solid.get(), springs.get()});
    }

    /// Velocities v(block) of whole blocks.
    Vector
    velocities(const std::vector<Tensor<1, 2>> &of_blocks) const
    {
      return interpolate_velocity(body.model->covers,
                                  body.model->constraints,
                                  [&](const Point<2> &, const unsigned int b) {
                                    return of_blocks[b];
                                  });
    }

    Body                             body;
    std::unique_ptr<SpringTerm>      springs;
    std::unique_ptr<MechanicalModel> model;
  };


  Tensor<1, 2>
  vector(const double x, const double y)
  {
    return Tensor<1, 2>({x, y});
  }


  // Two squares of 2 kg/m and 4.5 kg/m on a spring between their centres, thrown apart. The trapezoidal
  // rule turns the phase by 2 atan(omega h / 2) in each step.
  TEST(Springs, TwoBlocksSwingMPI)
  {
    const double k = 3., m_1 = 2., m_2 = 4.5, h = 0.05, v = 1e-3;
    const double omega = std::sqrt(k * (1. / m_1 + 1. / m_2));
    Spring       spring;
    spring.start     = {0.5, 0.5};
    spring.end       = {2.75, 0.75};
    spring.stiffness = k;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
    {
      // along the spring, without momentum
      const Tensor<1, 2> e =
        (spring.end - spring.start) / (spring.end - spring.start).norm();
      Sprung         swing(squares({1., 1.5}, 1e7), kinematics, {spring});
      TimeIntegrator integrator(*swing.model, TimeScheme::newmark());
      integrator.initialize(swing.body.zero(),
                            swing.velocities({-v * m_2 / (m_1 + m_2) * e,
                                              v * m_1 / (m_1 + m_2) * e}));
      const double phase = 2. * std::atan(0.5 * omega * h);
      for (unsigned int n = 1; n <= 100; ++n)
      {
        step(integrator, h);
        const double elongation =
          swing.springs->forces(integrator.state().u)[0] / k;
        // the squares give way by about k / E = 3e-7 of the elongation, and in finite kinematics
        // the force is linear in the elongation as well
        ASSERT_NEAR(elongation, v / omega * std::sin(n * phase), 1e-5 * v)
          << "step " << n;
      }
      // the forces of the solid are rounded to about 1e-16 E u, and act for 5 s
      EXPECT_LT(integrator.account().linear_momentum.norm(), 1e-8 * m_1 * v);
    }
  }


  // A square hangs on another one, which is held. The force is the weight, whatever the elasticity.
  TEST(Springs, CarriesAWeight)
  {
    const double g = 9.81, m = 2.;
    Spring       spring;
    spring.start     = {0.5, 0.5};
    spring.end       = {2.5, 0.5};
    spring.stiffness = 40.;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
    {
      Body body                   = squares({1., 1.}, 1e5);
      body.model->problem.gravity = vector(g, 0.);
      for (const unsigned int c : {0, 1})
      {
        FixedPoint fixed;
        fixed.point = {0.2, c == 0 ? 0.2 : 0.8};
        body.model->problem.fixed_points.push_back(fixed);
      }
      Sprung               hanging(std::move(body), kinematics, {spring});
      TimeIntegrator       integrator(*hanging.model,
                                TimeScheme::constant_acceleration());
      RelaxationParameters parameters;
      parameters.step      = 1.;
      parameters.tolerance = 1e-10;
      (void)relax(integrator, parameters);
      const Vector &u     = integrator.state().u;
      const double  force = hanging.springs->forces(u)[0];
      // tolerance of the relaxation
      EXPECT_NEAR(force / (m * g), 1., 1e-8);
      const DisplacementField field = hanging.body.field(u);
      const auto              value = [&](const Point<2> &x) {
        const auto [element, xi] = hanging.body.model->locate(x);
        return field.displacement(element, xi)[0];
      };
      EXPECT_NEAR(value(spring.end) - value(spring.start),
                  force / spring.stiffness,
                  1e-12);
      // stored is half of force times elongation, beside the energy of the fixed points
      EXPECT_GT(integrator.account().conditions,
                0.5 * force * force / spring.stiffness);
      EXPECT_NEAR(integrator.account().conditions /
                    (0.5 * force * force / spring.stiffness),
                  1.,
                  1e-3);
    }
  }


  // A loaded square hangs on three bars on another one, which is held: the equations of equilibrium
  // determine their forces.
  TEST(Springs, HoldABlockAtRestMPI)
  {
    const double              m = 2.;
    const Tensor<1, 2>        g = vector(9.81, -4.);
    const Point<2>            center(2.5, 0.5);
    const std::vector<Spring> bars = {{{0.9, 0.9}, {2.1, 0.3}, 4e3, {}},
                                      {{0.9, 0.1}, {2.1, 0.7}, 4e3, {}},
                                      {{0.9, 0.5}, {2.9, 0.95}, 4e3, {}}};
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
    {
      Body body                               = squares({1., 1.}, 1e7);
      body.model->problem.gravity             = g;
      body.model->problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "block 0")};
      const bool is_small = kinematics == Kinematics::small;
      if (is_small)
        body.make_small();
      else
        body.make_finite();
      const auto solid = make_solid_at_rest(*body.elasticity, kinematics);
      SpringTerm springs(body.model->covers, solid->layout(), bars, kinematics);
      NonlinearStatics statics(*solid, {}, {&springs});
      statics.run(LoadSteps::equal(2));
      Vector u(body.zero());
      u                                = statics.solution();
      const std::vector<double> forces = springs.forces(u);
      const DisplacementField   field  = body.field(u);
      const auto                moved  = [&](const Point<2> &x) {
        Tensor<1, 2> d;
        const auto [element, xi] = body.model->locate(x);
        const auto [first, last] = body.model->covers.locally_owned_elements();
        if (!is_small && element >= first && element < last)
          d = field.displacement(element, xi);
        return x + dealii::Utilities::MPI::sum(d, MPI_COMM_WORLD);
      };
      Tensor<1, 2>   resultant = m * g;
      double         moment    = 0.;
      const Point<2> middle    = moved(center);
      for (unsigned int i = 0; i < bars.size(); ++i)
      {
        const Point<2> start = moved(bars[i].start), end = moved(bars[i].end);
        const Tensor<1, 2> force =
          forces[i] * (start - end) / (start - end).norm();
        resultant += force;
        moment += (end - middle)[0] * force[1] - (end - middle)[1] * force[0];
      }
      // small: that of the solution; finite: W / E, by which the mean position of the block is not
      // that of its centre
      const double tolerance = (is_small ? 1e-9 : 3e-6) * m * g.norm();
      EXPECT_LT(resultant.norm(), tolerance);
      EXPECT_LT(std::abs(moment), tolerance);
      EXPECT_GT(std::abs(forces[2]), 0.1 * m * g.norm());
    }
  }


  /// Two squares that turn about each other and swing at the same time.
  void
  swing_around(Sprung &pair, TimeIntegrator &integrator, const double v)
  {
    integrator.initialize(pair.body.zero(),
                          pair.velocities({vector(0.2, -v), vector(0.1, v)}));
  }


  // The spring is attached beside the centres, so that the squares turn about themselves as well.
  std::vector<Spring>
  eccentric_spring(const double k)
  {
    Spring spring;
    spring.start          = {0.8, 0.7};
    spring.end            = {2.1, 0.4};
    spring.stiffness      = k;
    spring.natural_length = 1.1;
    return {spring};
  }


  TEST(Springs, ConservesOverLargeRotationsMPI)
  {
    Sprung         pair(squares({1., 1.}, 1e3),
                Kinematics::finite,
                eccentric_spring(20.));
    TimeIntegrator integrator(*pair.model, TimeScheme::energy_momentum());
    swing_around(pair, integrator, 2.);
    const Account start    = integrator.account();
    const auto    phase_of = [&]() {
      const auto ends = evaluate({material_point(pair.body.model->covers,
                                                 pair.body.model->constraints,
                                                 {2.1, 0.4},
                                                 "end") -
                                  material_point(pair.body.model->covers,
                                                 pair.body.model->constraints,
                                                 {0.8, 0.7},
                                                 "start")},
                                 integrator.state().u);
      return std::atan2(ends[0][1], ends[0][0]);
    };
    double turned = 0., last = phase_of(), least = 1e10, largest = -1e10;
    for (unsigned int n = 0; n < 150; ++n)
    {
      step(integrator, 0.05);
      const Account &now = integrator.account();
      // rounding, and the tolerance of Newton's method: |r| <= 1e-9 of the force scale, then once
      // refined
      ASSERT_NEAR(now.balance / start.kinetic, 0., 1e-10) << "step " << n;
      ASSERT_NEAR((now.linear_momentum - start.linear_momentum).norm(),
                  0.,
                  1e-9);
      ASSERT_NEAR(now.angular_momentum / start.angular_momentum, 1., 1e-9);
      const double phase = phase_of();
      turned += std::remainder(phase - last, 2. * dealii::numbers::PI);
      last               = phase;
      const double force = pair.springs->forces(integrator.state().u)[0];
      least              = std::min(least, force);
      largest            = std::max(largest, force);
    }
    // what was asked of the spring: more than a turn, and forces of several newtons
    EXPECT_GT(std::abs(turned), 2. * dealii::numbers::PI);
    EXPECT_GT(largest - least, 5.);
  }


  // The whole tangent, in which that of the spring is as large as that of the solid.
  TEST(Springs, TangentIsTheDerivative)
  {
    std::mt19937 generator(7);
    unsigned int n_samples = 0;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
      for (const bool is_conserving : {false, true})
      {
        Sprung pair(squares({1., 1.}, 50.), kinematics, eccentric_spring(90.));
        const ModelLayout &layout = pair.model->layout();
        Vector             begin = random_displacement(layout, 0.02, generator),
               end               = random_displacement(layout, 0.02, generator),
               direction         = random_displacement(layout, 1., generator);
        const auto assemble      = [&](const Vector &u, const Tangent tangent) {
          Trial trial   = is_conserving ? Trial::step(begin, u, 0., 1., true)
                                             : Trial::at(u, 1.);
          trial.tangent = tangent;
          EXPECT_EQ(pair.model->assemble(trial), Deformation::admissible);
          return *pair.model->forces().residual;
        };
        // with respect to the mean, which moves by half as much as the end
        const double h = 1e-6;
        Vector       plus(end), minus(end);
        plus.add(h, direction);
        minus.add(-h, direction);
        Vector difference = assemble(plus, Tangent::none);
        difference -= assemble(minus, Tangent::none);
        difference *= (is_conserving ? 2. : 1.) / (2. * h);
        (void)assemble(end, Tangent::consistent);
        Vector product(difference);
        pair.model->forces().tangent->vmult(product, direction);
        layout.constraints->set_zero(product);
        layout.constraints->set_zero(difference);
        const double size = product.l2_norm();
        product -= difference;
        // rounding of a difference with h = 1e-6
        EXPECT_LT(product.l2_norm(), 1e-8 * size);
        EXPECT_GT(size, 10.);
        ++n_samples;
      }
    EXPECT_EQ(n_samples, 4u);
  }


  /// A spring of the natural length 0: the example of ForceTerm.
  class Band : public ForceTerm
  {
  public:
    Band(const MaterialVector &d, const double k)
      : d(d)
      , k(k)
    {
    }

    std::vector<Unknowns>
    couplings() const override
    {
      return {d.unknowns};
    }

    ForceProperties
    properties() const override
    {
      return {};
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override
    {
      const auto end = evaluate({d}, *trial.end)[0];
      const auto begin =
        trial.is_conserving ? evaluate({d}, *trial.begin)[0] : end;
      sum.sink->add(d,
                    0.5 * k * (begin + end),
                    k * dealii::unit_symmetric_tensor<2>());
      sum.energy_of_conditions += 0.5 * k * end * end;
      return Deformation::admissible;
    }

  private:
    MaterialVector d;
    double         k;
  };


  TEST(Springs, OfNoLengthAreBands)
  {
    const Point<2> a(0.8, 0.7), b(2.1, 0.4);
    Spring         spring;
    spring.start          = a;
    spring.end            = b;
    spring.stiffness      = 7.;
    spring.natural_length = 0.;
    std::mt19937 generator(3);
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
    {
      Sprung             pair(squares({1., 1.}, 50.), kinematics, {spring});
      const ModelLayout &layout = pair.model->layout();
      const auto         point  = [&](const Point<2> &x) {
        return material_point(pair.body.model->covers,
                              *layout.constraints,
                              x,
                              "x");
      };
      Band            band(point(b) - point(a), 7.);
      MechanicalModel banded(layout, {pair.body.solid.get(), &band});
      const Vector    u      = random_displacement(layout, 0.02, generator),
                   direction = random_displacement(layout, 1., generator);
      const Trial trial      = Trial::at(u, 0., Tangent::consistent);
      Vector      of_model[2], product[2];
      double      energy[2];
      for (const unsigned int i : {0, 1})
      {
        MechanicalModel &model = i == 0 ? *pair.model : banded;
        ASSERT_EQ(model.assemble(trial), Deformation::admissible);
        of_model[i] = *model.forces().residual;
        product[i].reinit(of_model[i]);
        model.forces().tangent->vmult(product[i], direction);
        energy[i] = model.forces().energy_of_conditions;
      }
      EXPECT_GT(energy[0], 5.);
      EXPECT_NEAR(energy[0], energy[1], 1e-13 * energy[0]);
      of_model[0] -= of_model[1];
      product[0] -= product[1];
      EXPECT_LT(of_model[0].l2_norm(), 1e-13 * of_model[1].l2_norm());
      EXPECT_LT(product[0].l2_norm(), 1e-13 * product[1].l2_norm());
    }
  }


  // Points of covers that are constrained move with the covers that those follow.
  TEST(Springs, MaterialPointsFollowTheFieldMPI)
  {
    const Body body = [] {
      Body made = squares({1., 1.}, 50.);
      made.make_finite();
      return made;
    }();
    const Model &model = *body.model;
    EXPECT_GT(dealii::Utilities::MPI::sum(model.constraints.n_constraints(),
                                          MPI_COMM_WORLD),
              0u);
    const auto exact = [](const Point<2> &x) {
      return vector(0.1 + 0.2 * x[0] * x[1], -0.3 * x[1] * x[1] + x[0]);
    };
    const Vector u = body.velocity(exact);
    for (const Point<2> &x : {Point<2>(0., 0.),
                              Point<2>(0.999, 0.001),
                              Point<2>(2.01, 0.99),
                              Point<2>(2.5, 0.5)})
    {
      const MaterialVector point =
        material_point(model.covers, model.constraints, x, "x");
      EXPECT_EQ(point.blocks.size(), 1u);
      // quadratic fields are represented exactly
      EXPECT_NEAR((evaluate({point}, u)[0] - (x + exact(x))).norm(), 0., 1e-13);
    }
  }


  // The same forces and the same motion on one rank.
  TEST(Springs, AreTheSameOnTwoRanksMPI)
  {
    for (const TimeScheme &scheme :
         {TimeScheme::energy_momentum(), TimeScheme::generalized_alpha(0.8)})
    {
      double force[2], energy[2];
      for (const unsigned int i : {0, 1})
      {
        Sprung         pair(squares({1., 1.},
                            1e3,
                            i == 0 ? MPI_COMM_WORLD : MPI_COMM_SELF),
                    Kinematics::finite,
                    eccentric_spring(20.));
        TimeIntegrator integrator(*pair.model, scheme);
        swing_around(pair, integrator, 2.);
        for (unsigned int n = 0; n < 10; ++n)
          step(integrator, 0.05);
        force[i]  = pair.springs->forces(integrator.state().u)[0];
        energy[i] = integrator.account().conditions;
      }
      // tolerance of Newton's method over ten steps
      EXPECT_NEAR(force[0], force[1], 1e-8 * std::abs(force[1]));
      EXPECT_NEAR(energy[0], energy[1], 1e-8 * energy[1]);
      EXPECT_GT(std::abs(force[1]), 1.);
    }
  }


  // What a scene does not ask for costs nothing.
  TEST(Springs, NoSpringsAddNothing)
  {
    Body body = squares({1., 1.}, 50.);
    body.make_finite();
    SpringTerm      none(body.model->covers, body.solid->layout(), {});
    MechanicalModel model(body.solid->layout(), {body.solid.get(), &none});
    const Vector    u = body.zero();
    ASSERT_EQ(model.assemble(Trial::at(u, 0., Tangent::consistent)),
              Deformation::admissible);
    EXPECT_EQ(model.forces().sink, nullptr);
    EXPECT_EQ(model.forces().tangent, &body.elasticity->tangent());
  }


  TEST(Springs, OfAbsentBlocksExertNoForces)
  {
    Sprung         pair(squares({1., 1.}, 1e3),
                Kinematics::finite,
                eccentric_spring(20.));
    TimeIntegrator integrator(*pair.model, TimeScheme::energy_momentum());
    step(integrator, 0.05);
    const double stored = integrator.account().conditions;
    EXPECT_GT(stored, 0.);
    integrator.drop_blocks({1});
    EXPECT_EQ(integrator.account().conditions, 0.);
    EXPECT_EQ(pair.springs->forces(integrator.state().u)[0], 0.);
    const Tensor<1, 2> momentum = integrator.account().linear_momentum;
    step(integrator, 0.05);
    // rounding
    EXPECT_NEAR((integrator.account().linear_momentum - momentum).norm(),
                0.,
                1e-12);
    EXPECT_NEAR(integrator.account().balance, 0., 1e-9 * stored);
  }


  TEST(Springs, RefusesWhatIsNoSpring)
  {
    Body body = squares({1., 1.}, 50.);
    body.make_finite();
    const auto make = [&](const Spring &spring) {
      SpringTerm(body.model->covers, body.solid->layout(), {spring});
    };
    Spring good;
    good.start     = {0.5, 0.5};
    good.end       = {2.5, 0.5};
    good.stiffness = 1.;
    EXPECT_NO_THROW(make(good));
    Spring outside = good;
    outside.end    = {1.5, 0.5};
    EXPECT_THROW(make(outside), InputError);
    Spring pushing    = good;
    pushing.stiffness = -1.;
    EXPECT_THROW(make(pushing), InputError);
    Spring without_direction         = good;
    without_direction.end            = good.start;
    without_direction.natural_length = 0.1;
    EXPECT_THROW(make(without_direction), InputError);
  }


  /// Three free squares, the first two of which a spring binds; the third one turns fast.
  Vector
  end_of_three(const bool solves_groups_separately, double &share)
  {
    Sprung           three(squares({1., 1., 1.}, 1e3),
                 Kinematics::finite,
                 eccentric_spring(20.));
    NewtonParameters newton = TimeIntegrator::default_newton_parameters();
    newton.solves_groups_separately = solves_groups_separately;
    TimeIntegrator integrator(*three.model,
                              TimeScheme::energy_momentum(),
                              newton);
    RigidVelocity  spin;
    spin.angular_velocity = 8.;
    spin.center           = {4.5, 0.5};
    integrator.initialize(
      three.body.zero(),
      interpolate_velocity(three.body.model->covers,
                           three.body.model->constraints,
                           [&](const Point<2> &x, const unsigned int block) {
                             return block == 2 ? spin(x) : vector(0.1, 0.);
                           }));
    share = 1.;
    for (unsigned int n = 0; n < 20; ++n)
    {
      const StepReport report = integrator.try_step(0.05);
      EXPECT_TRUE(report.converged) << report.reason;
      integrator.accept();
      share = std::min(share, report.n_full_iterations / report.n_iterations);
    }
    return integrator.state().u;
  }


  // Blocks bound by a spring are one group, and others are solved at their own pace.
  TEST(Springs, GroupsDoNotChangeTheResult)
  {
    double shares[2];
    Vector u[2] = {end_of_three(true, shares[0]),
                   end_of_three(false, shares[1])};
    EXPECT_LT(shares[0], 1.);
    EXPECT_EQ(shares[1], 1.);
    const double size = u[1].linfty_norm();
    u[0] -= u[1];
    // tolerance of Newton's method over twenty steps
    EXPECT_LT(u[0].linfty_norm(), 1e-8 * size);
  }


  // The first square is thrown, and the second one sleeps until the spring pulls by more than the
  // acceleration at which blocks wake.
  TEST(Springs, WakesWhoSleeps)
  {
    Spring spring;
    spring.start     = {0.5, 0.5};
    spring.end       = {2.5, 0.5};
    spring.stiffness = 4.;
    std::vector<double> ends;
    for (const bool may_sleep : {false, true})
    {
      Sprung         pair(squares({1., 1.}, 1e4), Kinematics::finite, {spring});
      TimeIntegrator integrator(*pair.model, TimeScheme::energy_momentum());
      integrator.initialize(
        pair.body.zero(), pair.velocities({vector(-0.5, 0.), vector(0., 0.)}));
      SleepParameters parameters;
      parameters.time         = 0.05;
      parameters.speed        = 0.002;
      parameters.acceleration = 0.02;
      if (may_sleep)
        integrator.let_blocks_sleep(parameters);
      unsigned int n_asleep = 0;
      for (unsigned int n = 0; n < 100; ++n)
      {
        step(integrator, 0.01);
        if (n == 5)
          n_asleep = integrator.n_asleep();
      }
      EXPECT_EQ(n_asleep, may_sleep ? 1u : 0u);
      EXPECT_EQ(integrator.n_asleep(), 0u);
      const auto ends_of =
        evaluate({material_point(pair.body.model->covers,
                                 pair.body.model->constraints,
                                 spring.end,
                                 "end")},
                 integrator.state().u);
      ends.push_back(ends_of[0][0] - spring.end[0]);
      // the energy of what sleep stopped is accounted for
      EXPECT_NEAR(integrator.account().balance, 0., 1e-9);
    }
    // pulled to the left, by about v t / 2 - v sin(omega t) / (2 omega), omega = 2 / s
    EXPECT_NEAR(ends[0], -0.25 + 0.125 * std::sin(2.), 1e-3);
    // sleep holds the second square for less than a tenth of a second
    EXPECT_NEAR(ends[1], ends[0], 0.01);
    EXPECT_NE(ends[1], ends[0]);
  }
} // namespace
