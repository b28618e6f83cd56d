// Choice of the step, failure below the least one, relaxation to rest.

#include <nmm/base/program.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <dynamics/dynamic_model.h>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  /// A cantilever in large deflection under its weight.
  Body
  cantilever(const double gravity = 4.)
  {
    Material rock = material("rock", 1e4, 0.2, 1.);
    rock.law      = material_law("St. Venant-Kirchhoff");
    Body body     = box({0., 0.}, {2., 0.2}, 0.2, rock);
    body.model->problem.boundary_conditions = {
      condition(Type::displacement, "left")};
    body.model->problem.gravity[1] = -gravity;
    return body;
  }


  StepControlParameters
  steps(const double initial)
  {
    StepControlParameters parameters;
    parameters.initial_step = initial;
    return parameters;
  }


  TEST(StepControl, EqualStepsAreFactorizedOnceAndEndInTime)
  {
    Body body = cantilever();
    body.make_small();
    TimeIntegrator      integrator(*body.mechanics, TimeScheme::newmark());
    std::vector<double> sizes;
    StepControl(steps(0.01)).run(integrator, 0.3, [&](const StepRecord &r) {
      sizes.push_back(r.report.step);
      return true;
    });
    ASSERT_EQ(sizes.size(), 30u);
    for (const double size : sizes)
      EXPECT_EQ(size, 0.01);
    EXPECT_NEAR(integrator.state().time, 0.3, 1e-12);
  }


  TEST(StepControl, BoundedDisplacementPerStep)
  {
    Body body = cantilever();
    body.make_finite();
    TimeIntegrator        integrator(*body.mechanics, TimeScheme::newmark());
    StepControlParameters parameters = steps(0.05);
    parameters.max_displacement      = 0.01;
    unsigned int n = 0, n_cuts = 0;
    StepControl(parameters).run(integrator, 0.3, [&](const StepRecord &r) {
      EXPECT_LE(r.report.max_displacement, 0.01);
      n_cuts += r.n_cuts;
      ++n;
      return true;
    });
    EXPECT_GT(n_cuts, 0u);
    EXPECT_GT(n, 8u);
    EXPECT_NEAR(integrator.state().time, 0.3, 1e-9);
  }


  TEST(StepControl, ErrorGovernsTheStep)
  {
    // one oscillation: local errors near the bound, steps of the size that
    // |u'''| h^3 / 12 gives
    Oscillators           model(1., 1.);
    TimeIntegrator        integrator(model, TimeScheme::newmark());
    Vector                u(model.layout().locally_owned, MPI_COMM_SELF), v(u);
    StepControlParameters parameters = steps(0.01);
    u(0)                             = 1.;
    parameters.max_step              = 10.;
    parameters.max_error             = 1e-6;
    integrator.initialize(u, v);
    unsigned int n   = 0;
    double       sum = 0.;
    StepControl(parameters).run(integrator, 6.28, [&](const StepRecord &r) {
      EXPECT_LE(r.report.error, parameters.max_error);
      sum += r.report.error;
      ++n;
      return true;
    });
    EXPECT_GT(sum / n, 0.3 * parameters.max_error);
    // h = (12e-6 / |sin|)^(1/3) ~ 0.025
    EXPECT_GT(n, 150u);
    EXPECT_LT(n, 400u);
    // sum of the local errors, grown at most linearly
    EXPECT_NEAR(integrator.state().u(0), 1., 5e-4);
  }


  TEST(StepControl, FailsBelowTheLeastStepAndKeepsTheState)
  {
    Body body = cantilever();
    body.make_finite();
    TimeIntegrator        integrator(*body.mechanics, TimeScheme::newmark());
    StepControlParameters parameters = steps(0.02);
    StepControl(parameters).run(integrator, 0.1);
    const double       time = integrator.state().time;
    const Vector       u    = integrator.state().u;
    const unsigned int step = integrator.state().step;

    parameters.max_displacement = 1e-7;
    parameters.min_step         = 0.01;
    try
    {
      StepControl(parameters).run(integrator, 0.2);
      FAIL() << "steps are below the least one";
    }
    catch (const NumericalFailure &failure)
    {
      EXPECT_NE(failure.message().find("displacements of"), std::string::npos)
        << failure.message();
    }
    EXPECT_EQ(integrator.state().time, time);
    EXPECT_EQ(integrator.state().step, step);
    Vector difference(integrator.state().u);
    difference -= u;
    EXPECT_EQ(difference.l2_norm(), 0.);
  }


  TEST(StepControl, CutsStepsThatDoNotConverge)
  {
    Body body = cantilever();
    body.make_finite();
    NewtonParameters newton = TimeIntegrator::default_newton_parameters();
    newton.max_iterations   = 3;
    TimeIntegrator integrator(*body.mechanics, TimeScheme::newmark(), newton);
    unsigned int   n_cuts = 0, n_lost = 0;
    StepControl(steps(0.2)).run(integrator, 0.4, [&](const StepRecord &r) {
      n_cuts += r.n_cuts;
      n_lost += r.n_lost_iterations;
      return true;
    });
    EXPECT_GT(n_cuts, 0u);
    EXPECT_GE(n_lost, 3 * n_cuts);
    EXPECT_NEAR(integrator.state().time, 0.4, 1e-9);
  }


  TEST(StepControl, RefusesBadParameters)
  {
    EXPECT_THROW(StepControl{StepControlParameters{}}, InputError);
    StepControlParameters parameters = steps(0.1);
    parameters.min_step              = 0.2;
    EXPECT_THROW(StepControl{parameters}, InputError);
  }


  /// A cantilever that bends far, about to be relaxed.
  struct RelaxingCantilever
  {
    RelaxingCantilever()
      : body(cantilever(8.))
    {
      body.make_finite();
      integrator =
        std::make_unique<TimeIntegrator>(*body.mechanics,
                                         TimeScheme::constant_acceleration());
      parameters.step = 0.2;
    }

    Body                            body;
    std::unique_ptr<TimeIntegrator> integrator;
    RelaxationParameters            parameters;
  };


  TEST(Relaxation, FindsTheStaticAnswer)
  {
    RelaxingCantilever     relaxing;
    const Body            &body       = relaxing.body;
    TimeIntegrator        &integrator = *relaxing.integrator;
    const RelaxationReport rest       = relax(integrator, relaxing.parameters);
    std::cout << rest.n_steps << " steps, " << rest.n_iterations
              << " iterations\n";

    FiniteElasticity statics(body.model->covers,
                             *body.model->quadrature,
                             body.model->constraints,
                             body.model->problem);
    NonlinearStatics solver(statics);
    solver.run(LoadSteps());
    Vector difference(integrator.state().u);
    Vector reference(difference);
    reference = solver.solution();
    difference -= reference;
    EXPECT_GT(reference.linfty_norm(), 0.1);
    // the imbalance allowed, times the beam's compliance over the material's
    EXPECT_LT(difference.linfty_norm(), 1e-5 * reference.linfty_norm());
    EXPECT_EQ(integrator.account().kinetic, 0.);
    EXPECT_GT(integrator.account().dissipated, 0.);
  }


  TEST(Relaxation, StepsGrowWhileIterationsAreFew)
  {
    unsigned int n_grown = 0, n_kept = 0, n_shrunk = 0;
    for (const unsigned int few : {3U, 2U})
    {
      RelaxingCantilever relaxing;
      TimeIntegrator    &integrator      = *relaxing.integrator;
      relaxing.parameters.few_iterations = few;
      // the time goes on by a step
      double       time = 0., previous = 0.;
      unsigned int n_previous = 0;
      relax(integrator, relaxing.parameters, [&](const StepRecord &record) {
        const double step = integrator.state().time - time;
        if (previous > 0. && record.n_cuts == 0)
        {
          ++(n_previous <= few       ? n_grown
             : n_previous <= 2 * few ? n_kept
                                     : n_shrunk);
          const double expected = n_previous <= few ? relaxing.parameters.growth
                                  : n_previous <= 2 * few ? 1.
                                                          : 0.7;
          // times are sums
          EXPECT_NEAR(step / previous, expected, 1e-9);
        }
        time       = integrator.state().time;
        previous   = step;
        n_previous = record.report.n_full_iterations;
      });
    }
    std::cout << n_grown << " steps grew, " << n_kept << " stayed, " << n_shrunk
              << " shrank\n";
    EXPECT_GT(n_grown, 0u);
    EXPECT_GT(n_kept, 0u);
    EXPECT_GT(n_shrunk, 0u);
  }

} // namespace
