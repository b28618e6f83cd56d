// Terms of one's own beside those of solid and contact.

#include <nmm/base/archive.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Pulls all of a body to the right with the force of an acceleration [m/s^2], and counts the
  /// steps in which it did.
  class Pull : public ForceTerm
  {
  public:
    Pull(const ModelLayout &layout, const double acceleration)
      : force(layout.locally_owned, layout.communicator)
    {
      Vector right(force);
      for (const auto i : layout.locally_owned)
        right(i) = i % 2 == 0 ? acceleration : 0.;
      right.compress(dealii::VectorOperation::insert);
      layout.constraints->distribute(right);
      layout.mass->vmult(force, right);
      layout.constraints->set_zero(force);
    }

    Deformation
    assemble(const Trial &, AssembledForces &sum) override
    {
      *sum.residual -= force;
      sum.scale = std::hypot(sum.scale, force.l2_norm());
      return Deformation::admissible;
    }

    ForceProperties
    properties() const override
    {
      return {};
    }

    StepFault
    find_fault(const Vector &end) override
    {
      StepFault fault;
      if (end.linfty_norm() > furthest)
        fault.reason = "more than " + std::to_string(furthest) + " m";
      return fault;
    }

    StepWork
    commit(const Trial &step) override
    {
      Vector change(force), begin(force);
      change = *step.end;
      begin  = *step.begin;
      change -= begin;
      ++n_steps;
      StepWork work;
      work.loads = force * change;
      return work;
    }

    void
    save(ByteWriter &archive) const override
    {
      archive &n_steps;
    }

    void
    restore(ByteReader &archive) override
    {
      archive &n_steps;
    }

    unsigned int n_steps  = 0;
    double       furthest = 1e3;

  private:
    Vector force;
  };


  /// A free square and two terms that pull it.
  struct PulledSquare
  {
    explicit PulledSquare(const bool is_finite)
      : body(box({0., 0.}, {1., 1.}, 0.7, material("rock", 1e4, 0.2, 2.)))
    {
      if (is_finite)
        body.make_finite();
      else
        body.make_small();
      const ModelLayout &layout = body.solid->layout();
      one                       = std::make_unique<Pull>(layout, 1.);
      two                       = std::make_unique<Pull>(layout, 2.);
      model                     = std::make_unique<MechanicalModel>(
        layout,
        std::vector<ForceTerm *>{body.solid.get(), one.get(), two.get()});
    }

    Body                             body;
    std::unique_ptr<Pull>            one, two;
    std::unique_ptr<MechanicalModel> model;
  };


  // A solid at rest needs no masses; one that moves does.
  TEST(Terms, OnlyMotionNeedsMasses)
  {
    Body body = box({0., 0.}, {1., 1.}, 0.7, material("rock", 1e4, 0.2));
    body.model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom")};
    FiniteElasticity elasticity(body.model->covers,
                                *body.model->quadrature,
                                body.model->constraints,
                                body.model->problem);
    EXPECT_THROW(make_mass_matrix(elasticity, *body.model->quadrature),
                 InputError);
    FiniteSolid     solid(elasticity);
    MechanicalModel model(solid.layout(), {&solid});
    EXPECT_EQ(model.assemble(Trial::at(elasticity.initial_solution(), 0.)),
              Deformation::admissible);
    EXPECT_THROW(TimeIntegrator(model, TimeScheme::newmark()), InputError);
    Loading shaken;
    shaken.base_acceleration = [](const double) { return Tensor<1, 2>(); };
    EXPECT_THROW(FiniteSolid(elasticity, shaken), InputError);
  }


  // 1 + 2 m/s^2 for 0.5 s: both terms act and work in linear and in Newton's steps, of both schemes,
  // and their account closes.
  TEST(Terms, AddUpMPI)
  {
    for (const bool is_finite : {false, true})
      for (const TimeScheme &scheme :
           {TimeScheme::newmark(), TimeScheme::energy_momentum()})
      {
        PulledSquare   square(is_finite);
        TimeIntegrator integrator(*square.model, scheme);
        for (unsigned int k = 0; k < 10; ++k)
          step(integrator, 0.05);
        // rounding of ten solutions, each of which starts from the last one
        constexpr double tolerance = 1e-9;
        const Account   &account   = integrator.account();
        EXPECT_NEAR(account.linear_momentum[0], 2. * 3. * 0.5, tolerance);
        EXPECT_NEAR(account.external_work, 0.5 * 2. * 1.5 * 1.5, tolerance);
        EXPECT_NEAR(account.balance, 0., tolerance);
        EXPECT_EQ(square.one->n_steps, 10u);
      }
  }


  TEST(Terms, AreSavedInTheirOrder)
  {
    PulledSquare   square(true), other(true);
    TimeIntegrator integrator(*square.model, TimeScheme::newmark());
    step(integrator, 0.05);
    square.two->n_steps = 7;
    other.model->restore_internal_state(square.model->internal_state());
    EXPECT_EQ(other.one->n_steps, 1u);
    EXPECT_EQ(other.two->n_steps, 7u);
    std::vector<char> longer = square.model->internal_state();
    longer.push_back(0);
    EXPECT_THROW(other.model->restore_internal_state(longer), InputError);
  }


  TEST(Terms, TheFirstFaultRejectsAStep)
  {
    PulledSquare   square(true);
    TimeIntegrator integrator(*square.model, TimeScheme::newmark());
    square.one->furthest    = 0.01;
    square.two->furthest    = 0.001;
    const StepReport report = integrator.try_step(0.5);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.reason, "more than 0.010000 m");
  }


  // The velocity of a translation falls by (1 - alpha h / 2) / (1 + alpha h / 2) in a step, and
  // damping by stiffness does not resist it.
  TEST(Terms, TheSolidIsDampedMPI)
  {
    constexpr double alpha = 2., h = 0.05, v = 3.;
    for (const bool is_finite : {false, true})
      for (const TimeScheme &scheme :
           {TimeScheme::newmark(), TimeScheme::energy_momentum()})
      {
        Body body =
          box({0., 0.}, {1., 1.}, 0.7, material("rock", 1e4, 0.2, 2.));
        if (is_finite)
          body.make_finite();
        else
          body.make_small();
        body.solid->damp({alpha, 0.1}, scheme.is_conserving);
        TimeIntegrator integrator(*body.mechanics, scheme);
        RigidVelocity  velocity;
        velocity.translation = Tensor<1, 2>({0.6 * v, -0.8 * v});
        integrator.initialize(body.zero(), body.velocity(velocity));
        for (unsigned int k = 0; k < 10; ++k)
          step(integrator, h);
        const double end =
          v * std::pow((1. - 0.5 * alpha * h) / (1. + 0.5 * alpha * h), 10);
        // rounding of ten solutions, each of which starts from the last one
        constexpr double tolerance = 1e-9;
        const Account   &account   = integrator.account();
        EXPECT_NEAR(account.linear_momentum.norm(), 2. * end, tolerance);
        EXPECT_NEAR(account.dissipated, v * v - end * end, tolerance);
        EXPECT_NEAR(account.balance, 0., tolerance);
      }
  }


  TEST(Terms, DampingSuitsTheScheme)
  {
    Body body = box({0., 0.}, {1., 1.}, 0.7, material("rock", 1e4, 0.2, 2.));
    body.make_finite();
    EXPECT_THROW(body.solid->damp({0., -0.1}, false), InputError);
    body.solid->damp({0., 0.1}, /* is_conserving = */ true);
    TimeIntegrator integrator(*body.mechanics, TimeScheme::newmark());
    EXPECT_THROW(step(integrator, 0.05), InputError);
  }


  /// Pushes a body on by M times its displacements at the beginning of a step, times @p factor
  /// [1/s^2].
  class Push : public ForceTerm
  {
  public:
    Push(const ModelLayout &layout, const double factor)
      : layout(&layout)
      , factor(factor)
      , begin(layout.locally_owned, layout.communicator)
      , force(begin)
    {
    }

    void
    begin_step(const StepBegin &step) override
    {
      begin = step.u;
      layout->mass->vmult(force, begin);
      layout->constraints->set_zero(force);
      force *= factor;
      steps.push_back({step.time, step.time + step.length});
      is_at_rest = step.is_at_rest;
    }

    Deformation
    assemble(const Trial &, AssembledForces &sum) override
    {
      *sum.residual -= force;
      sum.scale = std::hypot(sum.scale, force.l2_norm());
      return Deformation::admissible;
    }

    ForceProperties
    properties() const override
    {
      return {};
    }

    const ModelLayout                     *layout;
    double                                 factor;
    Vector                                 begin, force;
    std::vector<std::pair<double, double>> steps;
    bool                                   is_at_rest = false;
  };


  // What a term remembers from the beginning of a load step acts in that step.
  TEST(Terms, BeginLoadStepsMPI)
  {
    for (const bool is_finite : {false, true})
    {
      Body body = box({0., 0.}, {1., 1.}, 0.7, material("rock", 1e4, 0.2, 2.));
      body.model->problem.gravity             = Tensor<1, 2>({1., -2.});
      body.model->problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "bottom")};
      if (is_finite)
        body.make_finite(proportional_loading(body.model->problem));
      else
        body.make_small(proportional_loading(body.model->problem));
      // without what is pushed the displacements are about rho g / E
      Push             push(body.solid->layout(), 1e3);
      NonlinearStatics statics(*body.solid, {}, {&push});
      Vector           last(body.zero()), difference(last);
      unsigned int     n = 0;
      statics.run(
        LoadSteps::equal(3), [&](const LoadStep &step, const Vector &u) {
          ASSERT_EQ(push.steps.size(), ++n);
          EXPECT_TRUE(push.is_at_rest);
          EXPECT_NEAR(push.steps.back().first, (n - 1) / 3., 1e-15);
          EXPECT_NEAR(push.steps.back().second, step.load_factor, 1e-15);
          difference = push.begin;
          difference -= last;
          EXPECT_EQ(difference.l2_norm(), 0.);
          last = u;
          if (is_finite)
            return;
          // the tolerance of the solution
          const Vector rest = body.solid->residual_at(u, step.load_factor);
          difference        = rest;
          difference -= push.force;
          EXPECT_LT(difference.l2_norm(),
                    1e-8 * body.solid->layout().mass->l1_norm());
          EXPECT_TRUE(n == 1 || rest.l2_norm() > 1e-3) << rest.l2_norm();
        });
      EXPECT_EQ(n, 3U);
    }
  }
} // namespace
