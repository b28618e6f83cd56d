// Faces that ride up on each other as they slide.

#include <contact/contact_model.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  constexpr double friction = 0.6, dilation = 0.2, eps_n = 1e5, eps_t = 5e4;


  ContactParameters
  dilating(const double limit)
  {
    ContactParameters parameters        = contact_parameters(eps_n, 0.1);
    coulomb(parameters).shear_stiffness = eps_t;
    coulomb(parameters).friction        = friction;
    coulomb(parameters).dilation        = dilation;
    coulomb(parameters).dilation_limit  = limit;
    return parameters;
  }


  /// A block of 1 x 0.2 on a floor of several pieces that moves to the left and up
  /// as a function of the load factor.
  std::unique_ptr<Bodies>
  block_on_moving_floor(const std::function<Tensor<1, 2>(double)> &motion,
                        const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 0.2});
    Bodies::Options options;
    options.cell_size    = 0.15;
    options.rotation     = 13.;
    options.communicator = communicator;
    options.obstacles    = {
         obstacle("floor",
               {{2., 0.}, {1.05, 0.}, {0.93, 0.}, {0.13, 0.}, {-1., 0.}})};
    options.obstacles[0].displacement = motion;
    auto bodies = std::make_unique<Bodies>(std::move(geometry), options);
    // so much stiffer than the springs that the block is rigid to 1e-5
    bodies->problem.materials[0].youngs_modulus = 1e9;
    return bodies;
  }


  /// To and fro under a pressure of 100 times the load factor: the gap without
  /// pressure is the way of slip times tan psi, whichever way it slides.
  TEST(ContactDilation, RisesBySlipWhicheverWay)
  {
    for (const double limit : {0., 0.012})
    {
      SCOPED_TRACE(limit);
      constexpr double turn = 0.5, way = 0.02, load = 100.;
      auto             bodies = block_on_moving_floor([](const double t) {
        return Point<2>(-way / turn * (t < turn ? t : 2. * turn - t), 0.);
      });
      bodies->problem.boundary_conditions = {
        condition(Type::pressure, "top", constant(load))};
      // friction acts on the bottom: held there, the block does not tilt
      bodies->problem.fixed_points = {guide({0.5, 0.}, true)};
      bodies->start(dilating(limit));
      unsigned int n          = 0;
      double       dissipated = 0., rise = 0.;
      bodies->statics->run(
        LoadSteps::equal(20), [&](const ContactStep &step, const Vector &u) {
          dissipated += step.dissipated;
          const double t = step.load_factor;
          // elastic slip over both ways comes back at the turn
          const double elastic = friction * load * t / eps_t;
          const double at_turn = friction * load * turn / eps_t;
          double       slip    = way / turn * t - elastic;
          if (t > turn)
            slip -= 2. * at_turn;
          if (limit > 0.)
            slip = std::min(slip, limit);
          const DisplacementField field(bodies->covers, bodies->problem, u);
          double                  sum = 0.;
          for (const ContactPoint &point : bodies->contact->points())
            if (point.state != ContactState::open)
            {
              ++n;
              // gap = opening - p / eps_n; the block's deformation is of 1e-7 m
              EXPECT_NEAR(point.opening, dilation * slip, 1e-6);
              EXPECT_NEAR(point.gap + point.pressure / eps_n,
                          point.opening,
                          1e-12);
              EXPECT_NEAR(point.pressure, load * t, 0.02);
              sum += point.weight;
            }
          EXPECT_NEAR(sum, 1., 1e-5);
          rise = dilation * slip - load * t / eps_n;
          EXPECT_NEAR(field.displacement(
                        bodies->mesh.find_element({0.5, 0.1}),
                        bodies->mesh.mathematical_mesh().real_to_reference(
                          bodies->mesh.cell(
                            bodies->mesh.find_element({0.5, 0.1})),
                          {0.5, 0.1}))[1],
                      rise,
                      1e-6);
        });
      EXPECT_GT(n, 1000U);
      // friction takes q over the slip, which lifts the load by tan psi: the
      // integral of load t (mu - tan psi) over both ways, steps being those of
      // an implicit method
      EXPECT_GT(dissipated, 0.);
      if (limit == 0.)
      {
        const double rate = way / turn - friction * load / eps_t;
        const double late = turn + 2. * friction * load * turn / eps_t /
                                     (way / turn - friction * load / eps_t);
        const double exact = load * (friction - dilation) * rate * 0.5 *
                             (turn * turn + 1. - late * late);
        EXPECT_NEAR(dissipated, exact, 0.05 * exact);
      }
    }
  }


  /// With multipliers nothing penetrates: the gap is the opening.
  TEST(ContactDilation, WithMultipliers)
  {
    constexpr double way = 0.02, load = 100.;
    auto             bodies = block_on_moving_floor(
      [](const double t) { return Point<2>(-way * t, 0.); });
    bodies->problem.boundary_conditions = {
      condition(Type::pressure, "top", constant(load))};
    bodies->problem.fixed_points     = {guide({0.5, 0.}, true)};
    ContactParameters parameters     = dilating(0.);
    parameters.penetration_tolerance = 1e-8;
    bodies->start(parameters);
    unsigned int n = 0;
    bodies->statics->run(
      LoadSteps::equal(5), [&](const ContactStep &step, const Vector &) {
        const double t    = step.load_factor;
        const double slip = way * t - friction * load * t / eps_t;
        for (const ContactPoint &point : bodies->contact->points())
          if (point.state != ContactState::open)
          {
            ++n;
            // the shear differs from friction times load by what is left to the
            // springs; the tolerance is that of the mean over a stretch
            EXPECT_NEAR(point.opening, dilation * slip, 1e-6);
            EXPECT_NEAR(point.gap, point.opening, 1e-7);
          }
      });
    EXPECT_GT(n, 250U);
  }


  /// Held from above, strength grows with the slip: with the slope by which the
  /// springs are compressed, q = mu eps_n (w + tan psi (s - q / eps_t)).
  TEST(ContactDilation, StrengthGrowsWhereTheNormalMotionIsHeld)
  {
    constexpr double w = 1e-3, way = 0.03;
    for (const double limit : {0., 0.01})
    {
      SCOPED_TRACE(limit);
      auto bodies = block_on_moving_floor([](const double t) {
        return Point<2>(-way * std::max(0., t - 0.1) / 0.9,
                        w * std::min(1., t / 0.1));
      });
      bodies->problem.boundary_conditions = {
        condition(Type::displacement, "top")};
      bodies->start(dilating(limit));
      unsigned int n = 0;
      bodies->statics->run(
        LoadSteps::equal(10), [&](const ContactStep &step, const Vector &) {
          if (step.load_factor < 0.15)
            return;
          const double s = way * (step.load_factor - 0.1) / 0.9;
          double       q = friction * eps_n * (w + dilation * s) /
                     (1. + friction * eps_n * dilation / eps_t);
          if (limit > 0. && s - q / eps_t > limit)
            q = friction * eps_n * (w + dilation * limit);
          // the block gives way by its stiffness over that of the springs
          EXPECT_NEAR(std::abs(step.contact.force[0]), q, 1e-4 * q);
          EXPECT_NEAR(step.contact.force[1], q / friction, 1e-4 * q / friction);
          EXPECT_EQ(step.contact.n_stick, 0U);
          ++n;
        });
      EXPECT_GE(n, 8U);
    }
  }


  /// A fresh computation that takes over the history goes on in the same way; two
  /// ranks agree.
  TEST(ContactDilation, HistoryAndRanksMPI)
  {
    const auto make = [](const MPI_Comm communicator, const double begin) {
      auto bodies = block_on_moving_floor(
        [=](const double t) {
          return Point<2>(-0.02 * (begin + 0.5 * t), 1e-3);
        },
        communicator);
      bodies->problem.boundary_conditions = {
        condition(Type::displacement, "top")};
      bodies->start(dilating(0.));
      return bodies;
    };
    const auto assemble = [](Bodies &bodies, const double t) {
      const Vector u = bodies.interpolate(
        [](const Point<2> &, unsigned int) { return Point<2>(); });
      bodies.contact->set_time(t);
      bodies.contact->detect(u);
      bodies.contact->assemble(u, false);
    };
    double forces[3];
    for (const bool is_restarted : {false, true})
    {
      auto bodies = make(MPI_COMM_WORLD, 0.);
      for (const double t : {0., 0.5, 1.})
      {
        if (is_restarted && t == 1.)
        {
          auto fresh = make(MPI_COMM_WORLD, 0.);
          fresh->contact->restore_history(bodies->contact->history());
          bodies = std::move(fresh);
        }
        assemble(*bodies, t);
        bodies->contact->accept();
      }
      forces[is_restarted] = bodies->contact->report().force[1];
    }
    EXPECT_EQ(forces[0], forces[1]);
    auto alone = make(MPI_COMM_SELF, 0.);
    for (const double t : {0., 0.5, 1.})
    {
      assemble(*alone, t);
      alone->contact->accept();
    }
    forces[2] = alone->contact->report().force[1];
    EXPECT_NEAR(forces[0], forces[2], 1e-12 * forces[2]);
    // it has risen: more than the 1e-3 m that it was pressed down by at first
    EXPECT_GT(forces[0], 1.1 * eps_n * 1e-3);
  }
} // namespace
