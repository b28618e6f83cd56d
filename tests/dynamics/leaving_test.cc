// Blocks that leave the scene: who they are, what goes with them, what stays.
#include <nmm/contact/assembly/term.h>
#include <nmm/covers/aggregation.h>
#include <nmm/dynamics/checkpoint.h>
#include <nmm/dynamics/leaving_blocks.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace Test
  {
    namespace
    {
      constexpr double density = 2000., g = 10.;


      Curve
      rectangle(const Point<2> &lower, const Point<2> &upper)
      {
        Curve          curve;
        const Point<2> corners[4] = {lower,
                                     {upper[0], lower[1]},
                                     upper,
                                     {lower[0], upper[1]}};
        for (unsigned int i = 0; i < 4; ++i)
          curve.pieces.push_back(
            CurvePiece::segment(corners[i], corners[(i + 1) % 4]));
        return curve;
      }


      /// Two squares of 1 m, apart from each other by @p gap in the direction of
      /// x or y; block_at() tells them from each other.
      Body
      two_squares(const double gap, const bool is_stacked)
      {
        Geometry geometry;
        for (const double shift : {0., 1. + gap})
        {
          const double x = is_stacked ? 0. : shift, y = is_stacked ? shift : 0.;
          geometry.add_polygon(
            {{x, y}, {x + 1., y}, {x + 1., y + 1.}, {x, y + 1.}},
            shift == 0. ? "first" : "second");
        }
        Body body;
        body.model = std::make_unique<Model>(
          std::move(geometry),
          mesh_parameters(0.8, Tensor<1, 2>({0.1, 0.2}), 11.),
          2);
        body.model->problem.materials = {material("rock", 1e8, 0.2, density)};
        body.model->problem.gravity   = Tensor<1, 2>({0., -g});
        return body;
      }


      unsigned int
      block_at(const Body &body, const Point<2> &x)
      {
        return body.model->manifold_mesh.block(
          body.model->manifold_mesh.find_element(x));
      }


      /// Displacement at @p x, the same on all ranks.
      Tensor<1, 2>
      displacement(const Body &body, const Vector &u, const Point<2> &x)
      {
        const auto [element, xi] = body.model->locate(x);
        const auto [first, last] = body.model->covers.locally_owned_elements();
        const DisplacementField field = body.field(u);
        Tensor<1, 2>            value;
        if (element >= first && element < last)
          value = field.displacement(element, xi);
        return dealii::Utilities::MPI::sum(
          value, body.mechanics->layout().communicator);
      }


      unsigned int
      n_elements(const Body &body, const unsigned int block)
      {
        unsigned int n           = 0;
        const auto [first, last] = body.model->covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
          n += body.model->manifold_mesh.block(e) == block;
        return n;
      }


      /// The second square flies to the right at 4 m/s and leaves at x = 6.03, with
      /// its left side from 3, in the step that ends at 0.76 s. Both fall.
      void
      check_departure(const bool is_small)
      {
        constexpr double v = 4., h = 0.02, end = 1.;
        Body             body = two_squares(2., false);
        if (is_small)
          body.make_small();
        else
          body.make_finite();
        const unsigned int second = block_at(body, {3.5, 0.5});
        const unsigned int first  = 1 - second;
        TimeIntegrator     integrator(*body.mechanics,
                                  is_small ? TimeScheme::newmark()
                                               : TimeScheme::energy_momentum());
        integrator.initialize(
          body.zero(),
          interpolate_velocity(
            body.model->covers,
            body.model->constraints,
            [&](const Point<2> &, const unsigned int block) {
              return Tensor<1, 2>({block == second ? v : 0., 0.});
            }));
        const LeavingBlocks leaving(body.model->covers,
                                    {rectangle({-2., -20.}, {6.03, 20.})});
        double              when = 0.;
        while (integrator.state().time < end - 1e-9)
        {
          step(integrator, h);
          const auto gone = leaving.find(body.field(integrator.state().u),
                                         integrator.state().left_blocks);
          if (gone.empty())
            continue;
          ASSERT_EQ(gone.size(), 1u);
          ASSERT_EQ(gone[0].block, second);
          when = integrator.state().time;
          // rounding of steps summed up
          EXPECT_NEAR(gone[0].lower[0], 3. + v * when, 1e-9);
          EXPECT_NEAR(gone[0].upper[0], 4. + v * when, 1e-9);
          const Account before = integrator.account();
          integrator.drop_blocks({second});
          const Account &after = integrator.account();
          const double   mass  = density;
          // a rigid fall: to the tolerance of Newton's method, 1e-9 of forces
          const double kinetic = 0.5 * mass * (v * v + g * g * when * when);
          EXPECT_NEAR(after.left, kinetic, 1e-7 * kinetic);
          EXPECT_NEAR(before.kinetic - after.kinetic, kinetic, 1e-7 * kinetic);
          EXPECT_NEAR(after.linear_momentum[0], 0., 1e-7 * mass * v);
          EXPECT_NEAR(before.linear_momentum[0], mass * v, 1e-7 * mass * v);
        }
        EXPECT_NEAR(when, 0.76, 1e-9);
        EXPECT_THROW(integrator.drop_blocks({second}), InputError);
        EXPECT_THROW(integrator.drop_blocks({2}), InputError);

        // the one that left stays where it was dropped, the other falls on
        const Vector &u = integrator.state().u;
        EXPECT_NEAR(displacement(body, u, {3.5, 0.5})[0], v * when, 1e-9);
        EXPECT_NEAR(displacement(body, u, {3.5, 0.5})[1],
                    -0.5 * g * when * when,
                    1e-8);
        EXPECT_NEAR(displacement(body, u, {0.5, 0.5})[1],
                    -0.5 * g * end * end,
                    1e-8);
        const Account &account = integrator.account();
        EXPECT_NEAR(account.balance, 0., 1e-7 * account.kinetic);
        EXPECT_NEAR(account.kinetic,
                    0.5 * density * g * g * end * end,
                    1e-7 * account.kinetic);
        // nothing of it is worked on any more
        Vector relevant(body.mechanics->layout().locally_owned,
                        body.mechanics->layout().locally_relevant,
                        body.mechanics->layout().communicator);
        relevant = u;
        (void)body.elasticity->assemble(relevant, 1., Tangent::none);
        EXPECT_EQ(body.elasticity->n_assembled_elements(),
                  n_elements(body, first));
        for (const auto i : body.mechanics->layout().absent_unknowns)
          EXPECT_EQ(integrator.state().v(i), 0.);

        // a new start has them all again
        integrator.initialize();
        EXPECT_EQ(integrator.state().left_blocks.size(), 0u);
        EXPECT_EQ(body.mechanics->layout().absent_unknowns.n_elements(), 0u);
      }


      TEST(LeavingBlocks, TakeTheirEnergyAndMomentumSmallMPI)
      {
        check_departure(true);
      }


      TEST(LeavingBlocks, TakeTheirEnergyAndMomentumFiniteMPI)
      {
        check_departure(false);
      }


      struct Stack
      {
        Body                             body;
        std::unique_ptr<ContactSurface>  surface;
        std::unique_ptr<Contact>         contact;
        std::unique_ptr<ContactTerm>     touch;
        std::unique_ptr<MechanicalModel> model;
        std::unique_ptr<TimeIntegrator>  integrator;
      };


      /// Two squares on each other and on the floor.
      Stack
      stack()
      {
        Stack result;
        result.body = two_squares(0., true);
        RigidObstacle floor;
        floor.name   = "floor";
        floor.pieces = {CurvePiece::segment({10., 0.}, {-10., 0.})};
        result.surface =
          std::make_unique<ContactSurface>(result.body.model->covers,
                                           std::vector<RigidObstacle>{floor});
        ContactParameters parameters;
        coulomb(parameters).normal_stiffness = 1e9;
        coulomb(parameters).normal_damping   = 1e6;
        coulomb(parameters).friction         = 0.5;
        parameters.reach                     = 0.02;
        result.body.make_finite();
        result.contact =
          std::make_unique<Contact>(*result.surface,
                                    result.body.model->constraints,
                                    parameters);
        const ModelLayout &layout = result.body.solid->layout();
        result.touch = std::make_unique<ContactTerm>(layout, *result.contact);
        result.model = std::make_unique<MechanicalModel>(
          layout,
          std::vector<ForceTerm *>{result.body.solid.get(),
                                   result.touch.get()});
        result.integrator =
          std::make_unique<TimeIntegrator>(*result.model,
                                           TimeScheme::energy_momentum());
        return result;
      }


      void
      advance(TimeIntegrator &integrator, const unsigned int n_steps)
      {
        for (unsigned int k = 0; k < n_steps; ++k)
          step(integrator, 0.005);
      }


      /// The motion is stopped again and again.
      void
      come_to_rest(TimeIntegrator &integrator)
      {
        for (unsigned int k = 0; k < 60; ++k)
        {
          advance(integrator, 4);
          integrator.stop_motion();
        }
      }


      // What stood on a block that is gone falls through the place where it was, as
      // if nothing had been there; only then it touches the floor.
      TEST(LeavingBlocks, AreTouchedByNobodyMPI)
      {
        Stack           s          = stack();
        TimeIntegrator &integrator = *s.integrator;
        come_to_rest(integrator);
        const unsigned int below = block_at(s.body, {0.5, 0.5});
        const Point<2>     middle(0.5, 1.5);
        const double       springs = integrator.account().conditions;
        const double       stored  = integrator.account().strain + springs;
        const double       kinetic = integrator.account().kinetic;
        const double       at_rest =
          displacement(s.body, integrator.state().u, middle)[1];
        const double time = integrator.state().time;
        integrator.drop_blocks({below});
        // all springs hung on it; the other one keeps its strain
        EXPECT_GT(springs, 0.);
        EXPECT_GT(integrator.account().left, springs);
        EXPECT_LT(integrator.account().left, stored + kinetic);
        EXPECT_EQ(integrator.account().conditions, 0.);

        advance(integrator, 60);
        const double t = integrator.state().time - time;
        EXPECT_TRUE(s.contact->is_idle());
        // it swings as it is let go, by 1e-4 m
        EXPECT_NEAR(displacement(s.body, integrator.state().u, middle)[1],
                    at_rest - 0.5 * g * t * t,
                    3e-4);
        const double energy = integrator.account().kinetic;
        EXPECT_NEAR(integrator.account().balance, 0., 1e-6 * energy);

        // it reaches the floor, 1 m below, and is thrown back; its middle goes on
        // for v h (rho / E)^(1/2) / 2 = 1 cm when its face is stopped
        double lowest = 0.;
        for (unsigned int k = 0; k < 60; ++k)
        {
          advance(integrator, 1);
          lowest =
            std::min(lowest,
                     displacement(s.body, integrator.state().u, middle)[1]);
        }
        EXPECT_NEAR(lowest, -1.01, 0.01);
        EXPECT_GT(displacement(s.body, integrator.state().u, middle)[1],
                  lowest + 0.01);
        EXPECT_NEAR(integrator.account().balance, 0., 1e-6 * energy);
      }


      TEST(LeavingBlocks, CheckpointsKnowWhoHasLeftMPI)
      {
        const std::string file =
          NMM_TEST_OUTPUT_DIR "/leaving-" +
          std::to_string(
            dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
          ".state";
        Stack straight = stack();
        advance(*straight.integrator, 20);
        straight.integrator->drop_blocks({block_at(straight.body, {0.5, 0.5})});
        advance(*straight.integrator, 10);
        Checkpoint::write(*straight.integrator, file);
        // until after it has hit the floor
        advance(*straight.integrator, 100);

        Stack again = stack();
        Checkpoint::read(file, *again.integrator);
        EXPECT_EQ(again.integrator->state().left_blocks,
                  straight.integrator->state().left_blocks);
        EXPECT_FALSE(again.integrator->state().left_blocks.empty());
        advance(*again.integrator, 100);
        const DynamicState &a = straight.integrator->state(),
                           &b = again.integrator->state();
        for (const auto &[x, y] :
             {std::make_pair(&a.u, &b.u), {&a.v, &b.v}, {&a.a, &b.a}})
          EXPECT_TRUE(std::equal(x->begin(), x->end(), y->begin()));
        EXPECT_EQ(a.sums.left, b.sums.left);
        EXPECT_EQ(a.sums.dissipated, b.sums.dissipated);
      }


      TEST(LeavingBlocks, TiedOnesLeaveTogetherMPI)
      {
        Body body = two_squares(2., false);
        body.make_small();
        const unsigned int second = block_at(body, {3.5, 0.5});
        std::vector<std::pair<unsigned int, unsigned int>> ties;
        // one rank knows
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          ties.emplace_back(1, 0);
        const std::vector<Curve> limits = {rectangle({-1., -1.}, {5., 2.})};
        const LeavingBlocks      apart(body.model->covers, limits);
        const LeavingBlocks      tied(body.model->covers, limits, ties);
        const auto               moved = [&](const double a, const double b) {
          return body.field(interpolate_velocity(
            body.model->covers,
            body.model->constraints,
            [&](const Point<2> &, const unsigned int k) {
              return Tensor<1, 2>({0., k == second ? b : a});
            }));
        };
        EXPECT_TRUE(apart.find(moved(0., 0.)).empty());
        // still reaches in by 0.01
        EXPECT_TRUE(apart.find(moved(0., 1.99)).empty());
        ASSERT_EQ(apart.find(moved(0., 2.01)).size(), 1u);
        EXPECT_EQ(apart.find(moved(0., 2.01))[0].block, second);
        EXPECT_TRUE(apart.find(moved(0., 2.01), {second}).empty());
        EXPECT_TRUE(tied.find(moved(0., 2.01)).empty());
        EXPECT_EQ(tied.find(moved(-2.5, 2.01)).size(), 2u);
      }


      TEST(LeavingBlocks, LimitsMayBeCurvedAndSeveral)
      {
        Body body = two_squares(2., false);
        body.make_small();
        Curve circle;
        circle.pieces = {CurvePiece::circle({0., 0.}, 2.)};
        const LeavingBlocks leaving(body.model->covers,
                                    {circle,
                                     rectangle({10., 10.}, {11., 11.})});
        for (unsigned int k = 0; k < 100; ++k)
        {
          const double       angle = 0.02 * k * dealii::numbers::PI;
          const Tensor<1, 2> direction({std::cos(angle), std::sin(angle)});
          // sides of half a degree: 2e-5 within the circle
          EXPECT_TRUE(leaving.is_within(Point<2>(1.9999 * direction)));
          EXPECT_FALSE(leaving.is_within(Point<2>(2.0001 * direction)));
        }
        EXPECT_TRUE(leaving.is_within({10.5, 10.5}));
        EXPECT_FALSE(leaving.is_within({10.5, 9.5}));
      }
    } // namespace
  }   // namespace Test
} // namespace NMM
