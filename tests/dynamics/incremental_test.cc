// The paper's step-by-step dynamics with bounded displacements.

#include <nmm/dynamics/incremental_dynamics.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A free unit square of density 1.
  struct Square
  {
    explicit Square(const double   youngs_modulus,
                    const double   gravity      = 0.,
                    const MPI_Comm communicator = MPI_COMM_WORLD)
      : body(box({-0.5, -0.5},
                 {0.5, 0.5},
                 0.4,
                 material("rock", youngs_modulus, 0.3, 1.),
                 communicator))
    {
      Model &model             = *body.model;
      model.problem.gravity[1] = -gravity;
      elasticity =
        std::make_unique<IncrementalElasticity>(model.covers,
                                                *model.quadrature,
                                                model.constraints,
                                                model.problem,
                                                /* may_float = */ true);
      dynamics = std::make_unique<IncrementalDynamics>(*elasticity,
                                                       model.covers,
                                                       *model.quadrature,
                                                       model.constraints,
                                                       model.problem);
    }

    void
    set_velocity(const std::function<Tensor<1, 2>(const Point<2> &)> &v)
    {
      dynamics->set_velocity(body.velocity(v));
    }

    Body                                   body;
    std::unique_ptr<IncrementalElasticity> elasticity;
    std::unique_ptr<IncrementalDynamics>   dynamics;
  };


  Tensor<1, 2>
  spin(const Point<2> &x)
  {
    Tensor<1, 2> v;
    v[0] = -x[1];
    v[1] = x[0];
    return v;
  }


  /// The same bits.
  void
  expect_same(const Vector &a, const Vector &b)
  {
    for (const auto k : b.locally_owned_elements())
      EXPECT_EQ(a(k), b(k));
  }


  TEST(IncrementalDynamics, FallsInBoundedSteps)
  {
    constexpr double g = 10., end = 0.7, bound = 0.05;
    Square           square(1e4, g);
    square.set_velocity([](const Point<2> &) { return Tensor<1, 2>(); });
    IncrementalDynamics         &dynamics = *square.dynamics;
    IncrementalDynamics::Control control;
    control.max_step         = 0.2;
    control.min_step         = 1e-4;
    control.max_displacement = bound;
    unsigned int n_steps = 0, n_cuts = 0;
    while (dynamics.time() < end)
    {
      const IncrementalDynamics::Advance step = dynamics.advance(end, control);
      EXPECT_LE(step.largest_displacement, bound);
      ++n_steps;
      n_cuts += step.n_cuts;
      // the scheme is exact for constant acceleration, and gravity does no
      // work on anything but the motion; rounding of a stiff solid
      const double t = dynamics.time();
      EXPECT_NEAR(
        square.elasticity->solution()(
          2 * *square.body.model->covers.locally_owned_covers().begin() + 1),
        -0.5 * g * t * t,
        1e-9);
      const IncrementalDynamics::Account account = dynamics.account();
      EXPECT_NEAR(account.kinetic, 0.5 * g * g * t * t, 1e-8);
      EXPECT_NEAR(account.work, account.kinetic, 1e-8);
      EXPECT_NEAR(account.balance, 0., 1e-8);
    }
    EXPECT_EQ(dynamics.time(), end);
    // 2.45 m in steps of 0.05 m or a little less
    std::cout << n_steps << " steps, " << n_cuts << " cuts\n";
    EXPECT_GE(n_steps, 49u);
    EXPECT_LE(n_steps, 65u);
    EXPECT_LE(n_cuts, 12u);
  }


  TEST(IncrementalDynamics, RefusedStepsChangeNothing)
  {
    Square square(1e3);
    square.set_velocity(spin);
    IncrementalDynamics &dynamics = *square.dynamics;
    dynamics.step(0.05);
    const IncrementalDynamics::State before  = dynamics.state();
    const auto                       refused = dynamics.try_step(0.2, 1., 0.1);
    EXPECT_FALSE(refused.is_taken);
    EXPECT_GT(refused.largest_displacement, 0.1);
    const IncrementalDynamics::State after = dynamics.state();
    expect_same(after.velocity, before.velocity);
    expect_same(after.elasticity.solution, before.elasticity.solution);
    EXPECT_EQ(after.elasticity.stress, before.elasticity.stress);
    EXPECT_EQ(after.time, before.time);

    IncrementalDynamics::Control control;
    control.max_step = control.min_step = 0.2;
    control.max_displacement            = 0.1;
    EXPECT_THROW(dynamics.advance(1., control), NumericalFailure);
    EXPECT_EQ(dynamics.time(), before.time);
    control.min_step = 0.3;
    EXPECT_THROW(dynamics.advance(1., control), InputError);
  }


  TEST(IncrementalDynamics, RestoredStatesGoOnWithTheSameBits)
  {
    IncrementalDynamics::Control control;
    control.max_step         = 0.1;
    control.min_step         = 1e-3;
    control.max_displacement = 0.03;
    const auto run           = [&](Square &square, const double end) {
      while (square.dynamics->time() < end)
        square.dynamics->advance(end, control);
    };
    Square first(100.), second(100.);
    first.set_velocity(spin);
    run(first, 0.5);
    const IncrementalDynamics::State middle = first.dynamics->state();
    run(first, 1.);
    second.dynamics->restore(middle);
    run(second, 1.);
    expect_same(second.dynamics->velocity(), first.dynamics->velocity());
    expect_same(second.elasticity->solution(), first.elasticity->solution());
    EXPECT_EQ(second.dynamics->account().balance,
              first.dynamics->account().balance);
    // the paper's scheme inflates a turning block, which the account shows
    EXPECT_GT(std::abs(first.dynamics->account().balance),
              1e-4 * first.dynamics->account().kinetic);

    Square                     other(100.);
    IncrementalDynamics::State foreign = middle;
    foreign.elasticity.stress.pop_back();
    EXPECT_THROW(other.dynamics->restore(foreign), InputError);
  }
} // namespace
