// Where the solution of a step starts.
#include <dynamics/block_inertia.h>
#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>
#include <support/coulomb.h>
#include <utility>

namespace NMM
{
  namespace Test
  {
    namespace
    {
      using namespace ContactBars;
      using Vector = MechanicalModel::Vector;

      /// Two quadrilaterals at a distance, and another one below that lies on the floor.
      std::unique_ptr<MovingBodies>
      three_blocks(const double      friction_angle,
                   const TimeScheme &scheme = TimeScheme::energy_momentum())
      {
        Geometry geometry;
        add_block(geometry, "0", {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}});
        add_block(geometry, "1", {{0., 1.}, {1., 1.}, {1., 2.}, {0., 2.}});
        add_block(geometry, "2", {{3., 2.}, {4.5, 2.2}, {4., 3.}, {3.1, 2.8}});
        MovingBodies::Options options;
        options.cell_size           = 4.;
        options.mesh_of_every_block = true;
        options.obstacles = {obstacle("floor", {{6., 0.}, {-3., 0.}})};
        auto bodies =
          std::make_unique<MovingBodies>(std::move(geometry), options);
        bodies->problem.materials = {
          material("rock", rock_modulus, 0.2, rock_density)};
        bodies->problem.gravity = Tensor<1, 2>({0., -standard_gravity});
        ContactParameters parameters =
          contact_parameters(10. * rock_modulus, 0.05);
        coulomb(parameters).friction = std::tan(degrees(friction_angle));
        bodies->start(parameters, Kinematics::finite);
        bodies->integrate(scheme, RayleighDamping());
        return bodies;
      }


      // The third block turns and moves as a rigid one does in a step of the conserving
      // scheme, from where it has been turned to already; the others stay.
      TEST(BlockInertia, FliesAsStiffBodiesDo)
      {
        constexpr double       h = 0.05, omega = 3., turned = 0.4;
        const Tensor<1, 2>     velocity({0.7, -0.2});
        auto                   bodies = three_blocks(30.);
        const ModelLayout     &layout = bodies->model->layout();
        const auto            &blocks = layout.blocks_of_unknowns;
        internal::BlockInertia inertia(layout);

        // area and centre of the third block by its corners
        const Point<2> x[4] = {{3., 2.}, {4.5, 2.2}, {4., 3.}, {3.1, 2.8}};
        double         area = 0.;
        Point<2>       center;
        for (unsigned int i = 0; i < 4; ++i)
        {
          const Point<2> &a = x[i], &b = x[(i + 1) % 4];
          const double    c = a[0] * b[1] - a[1] * b[0];
          area += 0.5 * c;
          center += c / 6. * (a + Tensor<1, 2>(b));
        }
        center /= area;
        EXPECT_NEAR(inertia.mass(2),
                    rock_density * area,
                    1e-9 * rock_density * area);

        Vector     u(layout.locally_owned, layout.communicator);
        Vector     v(u), p(u), moved(u), expected(u);
        const auto X       = layout.reference_positions->begin();
        const auto rotated = [](const Tensor<1, 2> &a, const double angle) {
          return Tensor<1, 2>(
            {std::cos(angle) * a[0] - std::sin(angle) * a[1],
             std::sin(angle) * a[0] + std::cos(angle) * a[1]});
        };
        const double angle = 2. * std::atan(0.5 * h * omega);
        for (unsigned int i = 0; i < blocks.size(); i += 2)
        {
          const Point<2>     place(X[i], X[i + 1]);
          const Tensor<1, 2> arm  = rotated(place - center, turned),
                             next = rotated(arm, angle);
          for (unsigned int c = 0; c < 2; ++c)
          {
            u(i + c) = arm[c] - (place - center)[c];
            v(i + c) = velocity[c] + omega * (c == 0 ? -arm[1] : arm[0]);
            expected(i + c) =
              blocks[i] == 2 ? h * velocity[c] + next[c] - (place - center)[c]
                             : 0.;
          }
        }
        for (Vector *vector : {&u, &v, &expected})
          vector->compress(dealii::VectorOperation::insert);
        layout.mass->vmult(p, v);
        inertia.fly(p, u, h, {false, false, true}, moved);
        moved -= expected;
        // rounding of places of some metres
        EXPECT_LE(moved.linfty_norm(), 1e-13);
      }


      // Two blocks that are let go on each other ring: vibrations that steps do not resolve must
      // not decide where they seem to touch.
      TEST(Prediction, VibrationsDoNotMoveContacts)
      {
        constexpr double       h       = 0.005;
        constexpr unsigned int n_steps = 100;
        // iterations of a step: 2.5, and 3.1 from u + h v; 1.1, and 2.1 from u + h v + h^2 a / 2
        const std::pair<TimeScheme, double> bars[] = {
          {TimeScheme::energy_momentum(), 2.8},
          {TimeScheme::constant_acceleration(), 1.5}};
        for (const auto &[scheme, most] : bars)
        {
          auto         bodies = three_blocks(30., scheme);
          unsigned int n      = 0;
          for (unsigned int i = 0; i < n_steps; ++i)
          {
            const StepReport report = bodies->integrator->try_step(h);
            ASSERT_TRUE(report.converged) << report.reason;
            n += report.n_iterations;
            bodies->integrator->accept();
          }
          std::cout << n << " iterations of " << n_steps << " steps"
                    << std::endl;
          EXPECT_LE(n, most * n_steps);
        }
      }
    } // namespace
  }   // namespace Test
} // namespace NMM
