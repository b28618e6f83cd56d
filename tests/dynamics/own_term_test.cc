// A force term of a program's own that remembers something: a bolt that yields. It is written with
// what nmm/mechanics/force_term.h says.

#include <nmm/base/archive.h>
#include <nmm/dynamics/checkpoint.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A bar between two material points, with the stiffness k and a yield force in tension and
  /// compression.
  class Bolt : public ForceTerm
  {
  public:
    Bolt(const MaterialVector &d, const double k, const double yield_force)
      : d(d)
      , k(k)
      , yield_force(yield_force)
      , length(d.constant.norm())
    {
      hash = 1;
    }

    std::vector<Unknowns>
    couplings() const override
    {
      return {d.unknowns};
    }

    ForceProperties
    properties() const override
    {
      return {/* is_linear = */ false,
              true,
              /* is_symmetric_between = */ false};
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override
    {
      const Tensor<1, 2> d_1 = evaluate({d}, *trial.end)[0];
      const Tensor<1, 2> d_0 =
        trial.is_conserving ? evaluate({d}, *trial.begin)[0] : d_1;
      const double       l_0 = d_0.norm(), l_1 = d_1.norm();
      const Pull         begin = pull(l_0), end = pull(l_1);
      const Tensor<1, 2> mean = 0.5 * (d_0 + d_1);
      // The mean force works on the change of the length.
      const double f = (begin.force + end.force) / (l_0 + l_1);
      sum.sink->add(
        d,
        f * mean,
        f * dealii::unit_symmetric_tensor<2>() +
          outer_product(mean, 2. / (l_0 + l_1) * (end.slope - f) * d_1 / l_1));
      sum.energy_of_conditions += 0.5 * end.force * end.force / k;
      return Deformation::admissible;
    }

    StepWork
    commit(const Trial &step) override
    {
      const Pull end   = pull(evaluate({d}, *step.end)[0].norm());
      double     force = end.force;
      if (step.is_conserving)
        force =
          0.5 * (force + pull(evaluate({d}, *step.begin)[0].norm()).force);
      StepWork work;
      work.dissipated = force * (end.plastic - plastic);
      plastic         = end.plastic;
      return work;
    }

    void
    forget() override
    {
      plastic = 0.;
    }

    void
    save(ByteWriter &archive) const override
    {
      archive &plastic;
    }

    void
    restore(ByteReader &archive) override
    {
      archive &plastic;
    }

    struct Pull
    {
      double force, slope, plastic;
    };

    /// Force, its derivative by the length, and plastic extension if the bolt has this length.
    Pull
    pull(const double now) const
    {
      const double trial = k * (now - length - plastic);
      if (std::abs(trial) <= yield_force)
        return {trial, k, plastic};
      const double force = std::copysign(yield_force, trial);
      return {force, 0., plastic + (trial - force) / k};
    }

    MaterialVector d;
    double         k, yield_force, length;
    double         plastic = 0.;
  };


  constexpr double k = 100., yield_force = 5.;

  /// Two blocks, [0, 1]^2 and the same 2 m to the right.
  Body
  two_blocks(const double youngs_modulus)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "first");
    geometry.add_polygon({{2., 0.}, {3., 0.}, {3., 1.}, {2., 1.}}, "second");
    Body body;
    body.model                    = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.4, {}, 9.),
                                         2);
    body.model->problem.materials = {material("rock", youngs_modulus, 0.2, 1.)};
    return body;
  }


  /// The bolt's points are at (0.7, 0.5) and (2.5, 0.5).
  MaterialVector
  between(const Body &body)
  {
    const auto at = [&](const double x) {
      return material_point(body.model->covers,
                            body.model->constraints,
                            {x, 0.5},
                            "The bolt");
    };
    return at(2.5) - at(0.7);
  }


  // The first block is held. The second one is drawn by T along x, and held by a spring K.
  TEST(OwnTerm, YieldsAndUnloadsAtRestMPI)
  {
    constexpr double K = 50., T = 12.;
    // The blocks give way by T / E.
    constexpr double youngs_modulus = 1e9,
                     tolerance      = 100. * T / youngs_modulus;

    Body  body                  = two_blocks(youngs_modulus);
    auto &problem               = body.model->problem;
    problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "first")};
    PointForce force;
    force.point          = {2.5, 0.5};
    force.force[0]       = T;
    problem.point_forces = {force};
    FixedPoint spring;
    spring.point         = {2.5, 0.5};
    spring.stiffness     = K;
    spring.components[1] = false;
    FixedPoint rail;
    rail.components[0]            = false;
    rail.stiffness                = 1e4;
    problem.fixed_points          = {spring, rail, rail};
    problem.fixed_points[1].point = {2.1, 0.5};
    problem.fixed_points[2].point = {2.9, 0.5};
    FiniteElasticity elasticity(body.model->covers,
                                *body.model->quadrature,
                                body.model->constraints,
                                problem);
    const auto       solid = make_solid_at_rest(elasticity, Kinematics::finite);
    Bolt             bolt(between(body), k, yield_force);
    NonlinearStatics statics(*solid, {}, {&bolt});
    // It begins anew if the load factor is not above the last one.
    for (unsigned int run = 0; run < 2; ++run)
    {
      LoadSteps steps;
      steps.load_factors = {0.5, 0.8, 1., 1e-9};
      std::vector<double> u, plastic, dissipated;
      statics.run(steps, [&](const LoadStep &, const Vector &solution) {
        u.push_back(evaluate({bolt.d}, solution)[0].norm() - 1.8);
        plastic.push_back(bolt.plastic);
        dissipated.push_back(statics.dissipated());
      });
      ASSERT_EQ(u.size(), 4U);
      EXPECT_NEAR(u[0], 0.5 * T / (k + K), tolerance);
      EXPECT_NEAR(u[1], (0.8 * T - yield_force) / K, tolerance);
      EXPECT_NEAR(u[2], (T - yield_force) / K, tolerance);
      EXPECT_EQ(plastic[0], 0.);
      EXPECT_NEAR(plastic[2], u[2] - yield_force / k, 1e-12);
      EXPECT_NEAR(u[3], k * plastic[2] / (k + K), tolerance);
      EXPECT_EQ(plastic[3], plastic[2]);
      EXPECT_NEAR(dissipated[1], yield_force * plastic[1], 1e-12);
      statics.run(LoadSteps::equal(1, 0.6));
    }
  }


  Vector
  apart(const Body &body)
  {
    return body.velocity([](const Point<2> &x) {
      return x[0] > 1.5 ? Tensor<1, 2>({4., 1.}) : Tensor<1, 2>();
    });
  }


  // The account closes, and a run that continues from a checkpoint takes the same steps.
  TEST(OwnTerm, YieldsInMotionAndContinues)
  {
    const std::string   file = "own_term_checkpoint.nmm";
    std::vector<double> plastic;
    for (const bool is_continued : {false, true})
    {
      Body body = two_blocks(1e4);
      body.make_finite();
      Bolt            bolt(between(body), k, yield_force);
      MechanicalModel model(body.solid->layout(), {body.solid.get(), &bolt});
      TimeIntegrator  integrator(model, TimeScheme::energy_momentum());
      if (is_continued)
        Checkpoint::read(file, integrator);
      else
        integrator.initialize(body.zero(), apart(body));
      const double initial = 8.5;
      for (unsigned int i = is_continued ? 30 : 0; i < 60; ++i)
      {
        if (i == 30 && !is_continued)
          Checkpoint::write(integrator, file);
        step(integrator, 0.01);
        EXPECT_NEAR(integrator.account().balance, 0., 1e-8 * initial);
        EXPECT_NEAR(integrator.account().linear_momentum[0], 4., 1e-7);
      }
      plastic.push_back(bolt.plastic);
    }
    EXPECT_GT(plastic[0], 0.1);
    EXPECT_EQ(plastic[0], plastic[1]);
  }


  // A body with two equal bolts is not one without.
  TEST(OwnTerm, EqualTermsCount)
  {
    Body body = two_blocks(1e4);
    body.make_finite();
    Bolt            first(between(body), k, yield_force), second(first);
    MechanicalModel both(body.solid->layout(),
                         {body.solid.get(), &first, &second});
    MechanicalModel none(body.solid->layout(), {body.solid.get()});
    EXPECT_NE(both.fingerprint(), none.fingerprint());
  }
} // namespace
