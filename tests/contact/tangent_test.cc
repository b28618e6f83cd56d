// Forces and tangent of contact: derivatives against differences, and that the
// two bodies' forces are in balance.

#include <nmm/contact/assembly/time_step.h>
#include <nmm/contact/law/barton_bandis_law.h>
#include <nmm/contact/law/slip_weakening_law.h>

#include <contact/contact_model.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Two rings' quarters of which the inner one presses on the outer one: curved
  /// faces on both sides, with a gap of 0.02.
  std::unique_ptr<Bodies>
  nested_arcs(const unsigned int degree)
  {
    const double s = std::sqrt(0.5);
    Geometry     geometry;
    const auto   add_ring =
      [&](const std::string &name, const double a, const double b) {
        geometry.add(single_piece_curve(name + "bottom",
                                        CurvePiece::segment({a, 0}, {b, 0})));
        geometry.add(
          single_piece_curve(name + "outer",
                             CurvePiece::arc({b, 0}, {b * s, b * s}, {0, b})));
        geometry.add(single_piece_curve(name + "left",
                                        CurvePiece::segment({0, b}, {0, a})));
        geometry.add(
          single_piece_curve(name + "inner",
                             CurvePiece::arc({0, a}, {a * s, a * s}, {a, 0})));
      };
    add_ring("inside ", 0.5, 1.);
    add_ring("outside ", 1.02, 1.5);
    Bodies::Options options;
    options.degree    = degree;
    options.cell_size = 0.3;
    options.rotation  = 11.;
    return std::make_unique<Bodies>(std::move(geometry), options);
  }


  unsigned int
  inner_block(const Bodies &bodies)
  {
    return bodies.mesh.block(bodies.mesh.find_element({0.6, 0.2}));
  }


  TEST(ContactTangent, AgainstDifferences)
  {
    struct Case
    {
      unsigned int degree;
      double       friction;
      bool         is_augmented;
      /// Tangential motion [m]: little sticks, much slips.
      double slide;
      /// Tangent of the dilation angle, and slip after which it ends [m].
      double dilation = 0., dilation_limit = 0.;
      /// Instead of Coulomb's.
      std::shared_ptr<const ContactLaw> law = nullptr;
    };

    SlipWeakeningLaw weakening;
    weakening.normal_stiffness  = 1e4;
    weakening.shear_stiffness   = 3e3;
    weakening.friction          = 0.3;
    weakening.cohesion          = 10.;
    weakening.residual_friction = 0.1;
    weakening.weakening_length  = 0.05;
    BartonBandisLaw rough;
    rough.normal_stiffness           = 1e4;
    rough.shear_stiffness            = 3e3;
    rough.joint_roughness            = 8.;
    rough.joint_compressive_strength = 1e4;
    rough.residual_angle             = 10.;
    rough.largest_closure            = 0.05;
    const unsigned int seed          = 20261121;
    std::mt19937       generator(seed);
    unsigned int       n_samples = 0, n_stick = 0, n_slip = 0, n_open = 0;
    std::normal_distribution<double> random;
    for (const Case &c : {Case{1, 0., false, 0.},
                          Case{2, 0., false, 0.},
                          Case{2, 0., true, 0.},
                          Case{1, 0.3, false, 0.001},
                          Case{1, 0.3, false, 0.03},
                          Case{2, 0.3, false, 0.001},
                          Case{2, 0.3, true, 0.001},
                          Case{2, 0.3, false, 0.03},
                          Case{1, 0.3, false, 0.03, 0.2},
                          Case{2, 0.3, false, 0.003, 0.3},
                          Case{2, 0.3, true, 0.003, 0.2},
                          Case{2, 0.3, false, 0.03, 0.1, 0.005},
                          Case{2,
                               0.3,
                               false,
                               0.03,
                               0.,
                               0.,
                               std::make_shared<SlipWeakeningLaw>(weakening)},
                          Case{2,
                               0.3,
                               false,
                               0.03,
                               0.,
                               0.,
                               std::make_shared<BartonBandisLaw>(rough)}})
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", degree " +
                   std::to_string(c.degree) + ", friction " +
                   std::to_string(c.friction) + ", slide " +
                   std::to_string(c.slide) + ", dilation " +
                   std::to_string(c.dilation));
      auto              bodies            = nested_arcs(c.degree);
      ContactParameters parameters        = contact_parameters(1e4, 0.1);
      coulomb(parameters).shear_stiffness = 3e3;
      coulomb(parameters).friction        = c.friction;
      coulomb(parameters).dilation        = c.dilation;
      coulomb(parameters).dilation_limit  = c.dilation_limit;
      if (c.law != nullptr)
        parameters.law = c.law;
      if (c.is_augmented)
        parameters.penetration_tolerance = 1e-9;
      bodies->start(parameters);
      Contact           &contact = *bodies->contact;
      const unsigned int inner   = inner_block(*bodies);

      // the inner body moves outwards by more than the gap, not uniformly
      const auto motion = [&](const double outwards, const double turn) {
        return bodies->interpolate(
          [=](const Point<2> &X, const unsigned int block) {
            const double       sign = block == inner ? 1. : 0.;
            const Tensor<1, 2> e    = X / X.norm();
            Tensor<1, 2> u = sign * outwards * (1. + 0.2 * X[0] * X[1]) * e;
            u += sign * turn * Point<2>(-e[1], e[0]);
            u += 0.002 * Point<2>(X[1] * X[1], -X[0] * X[1]);
            return u;
          });
      };
      Vector u = motion(0.025, 0.);
      contact.detect(u);
      contact.assemble(u, false);
      if (c.is_augmented)
        contact.augment();
      contact.accept();
      u = motion(0.026, c.slide);
      contact.assemble(u, true);
      n_stick += contact.report().n_stick;
      n_slip += c.friction > 0. ? contact.report().n_slip : 0;
      for (const ContactPoint &point : contact.points())
        n_open += point.opening > 0.;
      ASSERT_GT(contact.report().n_stick + contact.report().n_slip, 50U);

      Vector base(contact.residual()), owned(base), d(base), product(base),
        difference(base);
      for (unsigned int sample = 0; sample < 5; ++sample)
      {
        owned = u;
        for (const auto i : d.locally_owned_elements())
          d(i) = random(generator);
        d.compress(dealii::VectorOperation::insert);
        bodies->constraints.distribute(d);
        contact.assemble(u, true);
        contact.tangent().vmult(product, d);
        bodies->constraints.set_zero(product);
        // central differences; the largest error of points that change state in
        // between is that of one point, so the step is small
        const double h = 1e-8;
        owned.add(h, d);
        contact.assemble(bodies->relevant(owned), false);
        difference = contact.residual();
        owned.add(-2. * h, d);
        contact.assemble(bodies->relevant(owned), false);
        difference -= contact.residual();
        difference *= 0.5 / h;
        difference -= product;
        EXPECT_LE(difference.l2_norm(), 2e-6 * product.l2_norm());
        ++n_samples;

        if (c.friction == 0.)
        {
          Vector e(d), other(d);
          for (const auto i : e.locally_owned_elements())
            e(i) = random(generator);
          e.compress(dealii::VectorOperation::insert);
          bodies->constraints.set_zero(e);
          bodies->constraints.set_zero(d);
          contact.assemble(u, true);
          contact.tangent().vmult(product, d);
          contact.tangent().vmult(other, e);
          EXPECT_NEAR(e * product,
                      d * other,
                      1e-12 * e.l2_norm() * product.l2_norm());
        }
      }
    }
    EXPECT_EQ(n_samples, 70U);
    EXPECT_GT(n_stick, 100U);
    EXPECT_GT(n_slip, 100U);
    EXPECT_GT(n_open, 20U);
    std::cout << n_samples << " samples, points that stick " << n_stick
              << ", slip " << n_slip << ", opened by slip " << n_open
              << std::endl;
  }


  constexpr double distance = 0.01;


  /// Two blocks of one triangle each at a distance above a third one: a face on a face,
  /// and a corner on a face.
  std::unique_ptr<Bodies>
  three_blocks()
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {4., 0.}, {4., 1.}, {0., 1.}},
                         "below",
                         CurveRole::boundary,
                         "rock");
    const double y = 1. + distance;
    geometry.add_polygon({{0.3, y}, {1.5, y}, {1.5, 2.}, {0.3, 2.}},
                         "flat",
                         CurveRole::boundary,
                         "rock");
    geometry.add_polygon(
      {{2.8, y}, {3.5, y + 0.6}, {2.9, y + 1.3}, {2.2, y + 0.7}},
      "tilted",
      CurveRole::boundary,
      "rock");
    Bodies::Options options;
    options.cell_size           = 10.;
    options.mesh_of_every_block = true;
    return std::make_unique<Bodies>(std::move(geometry), options);
  }


  struct StepCase
  {
    /// At the begin [m]; negative: it touches.
    double gap;
    double friction;
    /// Dashpots [Pa s/m].
    double damping;
  };


  /// In a step blocks turn by up to 0.05: a tangent with normals of the middle instead
  /// of those of the end errs by 0.02 and more. Differences of the shear of
  /// points that come into contact are good to 2e-4, all others to 1e-8.
  TEST(ContactTangent, OfStepsThatConserveEnergyAgainstDifferences)
  {
    const unsigned int               seed = 20261122;
    std::mt19937                     generator(seed);
    std::normal_distribution<double> random;
    unsigned int                     n_stick = 0, n_slip = 0;
    for (const StepCase &c : {StepCase{-0.001, 0., 0.},
                              StepCase{-0.001, 0., 1e5},
                              StepCase{0.002, 0., 0.},
                              StepCase{-0.001, 0.5, 0.},
                              StepCase{0.002, 0.5, 1e5},
                              StepCase{-0.001, 50., 1e5},
                              StepCase{0.002, 50., 0.},
                              StepCase{0.002, 50., 1e5}})
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", gap " +
                   std::to_string(c.gap) + ", friction " +
                   std::to_string(c.friction) + ", damping " +
                   std::to_string(c.damping));
      auto              bodies            = three_blocks();
      ContactParameters parameters        = contact_parameters(1e8, 0.1);
      coulomb(parameters).shear_stiffness = 3e7;
      coulomb(parameters).friction        = c.friction;
      coulomb(parameters).normal_damping  = coulomb(parameters).shear_damping =
        c.damping;
      bodies->start(parameters);
      Contact   &contact  = *bodies->contact;
      const auto block_at = [&](const Point<2> &x) {
        return bodies->mesh.block(bodies->mesh.find_element(x));
      };
      const unsigned int below = block_at({2., 0.5}),
                         flat  = block_at({0.9, 1.5});
      const auto motion        = [&](const double share) {
        return bodies->interpolate(
          [&, share](const Point<2> &X, const unsigned int block) {
            const bool is_below = block == below, is_flat = block == flat;
            const Tensor<1, 2> r = X - (is_below  ? Point<2>(2., 0.5)
                                               : is_flat ? Point<2>(0.9, 1.5)
                                                         : Point<2>(2.9, 1.5));
            Tensor<1, 2>       u = share *
                             (is_below  ? -0.01
                                     : is_flat ? 0.03
                                               : -0.04) *
                             Point<2>(-r[1], r[0]);
            if (!is_below)
              u += Point<2>(0.02 * share, c.gap - distance - 0.006 * share);
            return u + 1e-4 * share * Point<2>(X[1] * X[1], -X[0] * X[1]);
          });
      };
      const double h     = 0.01;
      const Vector begin = motion(0.), u = motion(1.);
      contact.detect(begin);
      ContactTimeStep(contact).begin(begin, 0.);
      contact.set_time(h);
      ContactTimeStep(contact).assemble(u, h, true);
      ContactTimeStep(contact).assemble(u, h, true);
      n_stick += contact.report().n_stick;
      n_slip += c.friction > 0. ? contact.report().n_slip : 0;
      ASSERT_GE(contact.report().n_stick + contact.report().n_slip, 3U);

      Vector owned(contact.residual()), d(owned), product(owned),
        difference(owned);
      for (unsigned int sample = 0; sample < 4; ++sample)
      {
        for (const auto i : d.locally_owned_elements())
          d(i) = random(generator);
        d.compress(dealii::VectorOperation::insert);
        bodies->constraints.distribute(d);
        ContactTimeStep(contact).assemble(u, h, true);
        contact.tangent().vmult(product, d);
        bodies->constraints.set_zero(product);
        const double step = 1e-8;
        owned             = u;
        owned.add(step, d);
        ContactTimeStep(contact).assemble(bodies->relevant(owned), h, false);
        difference = contact.residual();
        owned.add(-2. * step, d);
        ContactTimeStep(contact).assemble(bodies->relevant(owned), h, false);
        difference -= contact.residual();
        // the tangent is that by displacements in the middle of the step
        difference *= 2. * 0.5 / step;
        difference -= product;
        const double tolerance = c.gap > 0. && c.friction > 0. ? 5e-4 : 1e-6;
        EXPECT_LE(difference.l2_norm(), tolerance * product.l2_norm());
      }
    }
    EXPECT_GT(n_stick, 5U);
    EXPECT_GT(n_slip, 4U);
  }


  /// Work of the forces in a motion of all bodies.
  double
  work(Bodies                                              &bodies,
       const std::function<Tensor<1, 2>(const Point<2> &)> &motion)
  {
    const Vector v = bodies.interpolate(
      [&](const Point<2> &X, unsigned int) { return motion(X); });
    Vector owned(bodies.contact->residual());
    owned = v;
    return owned * bodies.contact->residual();
  }


  /// Two deformable bodies: no net force; no net moment without friction, with
  /// friction that of the shear times the gap, which is in the springs.
  TEST(ContactTangent, ForcesAreInBalance)
  {
    for (const double friction : {0., 0.3})
    {
      auto              bodies     = nested_arcs(2);
      ContactParameters parameters = contact_parameters(1e4, 0.1);
      coulomb(parameters).friction = friction;
      bodies->start(parameters);
      Contact           &contact = *bodies->contact;
      const unsigned int inner   = inner_block(*bodies);
      const auto motion = [&](const double outwards, const double turn) {
        return bodies->interpolate(
          [=](const Point<2> &X, const unsigned int block) {
            const Tensor<1, 2> e = X / X.norm();
            Tensor<1, 2>       u;
            if (block == inner)
              u = outwards * (1. + 0.2 * X[0] * X[1]) * e +
                  turn * Point<2>(-e[1], e[0]);
            return u;
          });
      };
      Vector u = motion(0.025, 0.);
      contact.detect(u);
      contact.assemble(u, false);
      contact.accept();
      u = motion(0.025, 0.01);
      contact.assemble(u, false);
      double moment_of_shear = 0., sum = 0.;
      for (const ContactPoint &point : contact.points())
      {
        moment_of_shear += point.weight * point.shear * point.gap;
        sum += point.weight * point.pressure;
      }
      EXPECT_GT(sum, 50.);
      for (unsigned int c = 0; c < 2; ++c)
        EXPECT_NEAR(work(*bodies,
                         [c](const Point<2> &) {
                           return c == 0 ? Point<2>(1., 0.) : Point<2>(0., 1.);
                         }),
                    0.,
                    1e-12 * sum);
      // turning about the origin in the current configuration
      const DisplacementField field(bodies->covers, bodies->problem, u);
      Vector                  owned(contact.residual());
      for (const auto k : bodies->covers.locally_owned_covers())
      {
        const Point<2> x = bodies->covers.node(k) + field.nodal_value(k);
        owned(2 * k)     = -x[1];
        owned(2 * k + 1) = x[0];
      }
      owned.compress(dealii::VectorOperation::insert);
      bodies->constraints.distribute(owned);
      // arcs are no polynomials: x is known to the covers at degree 2 all the
      // same, because X is linear
      EXPECT_NEAR(std::abs(owned * contact.residual()),
                  std::abs(moment_of_shear),
                  1e-10 * sum);
      std::cout << "moment " << owned * contact.residual() << " of shear "
                << moment_of_shear << ", force " << sum << std::endl;
    }
  }
} // namespace
