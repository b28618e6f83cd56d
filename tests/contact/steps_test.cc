// Contact in steps: what is coupled, and that forces do not jump.

#include <contact/two_and_one.h>
#include <set>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  // How far a block may move in a step is a matter of its own reach, not of that of the fastest one.
  TEST_F(TwoAndOne, EachBlockHasAReach)
  {
    Contact   &contact = *bodies->contact;
    const auto faults  = [&](const std::vector<double> &reaches,
                            const double               lift) {
      contact.detect(sunk_by(0.), reaches);
      return contact.find_fault(sunk_by(-lift)).reason;
    };
    const double        h = 1.5 * reach;
    std::vector<double> fast(bodies->surface.n_bodies(), 0.), other(fast);
    fast[above]            = h;
    other[(above + 1) % 3] = h;
    EXPECT_EQ(faults({}, 0.5 * reach), "");
    EXPECT_NE(faults({}, h).find("moved further"), std::string::npos);
    EXPECT_EQ(faults(fast, h), "");
    EXPECT_NE(faults(other, h).find("moved further"), std::string::npos);
    const auto motions = contact.motions(sunk_by(0.), sunk_by(-h));
    EXPECT_EQ(motions[(above + 1) % 3], 0.);
    EXPECT_GE(motions[above], h);
  }


  // Blocks that cannot touch in the step are not coupled; those that do nevertheless are
  // from then on, with the tangent of the forces; the next step begins anew.
  TEST_F(TwoAndOne, PatternFollowsWhatTouches)
  {
    Contact &contact = *bodies->contact;
    contact.detect(sunk_by(0.));
    contact.assemble(sunk_by(0.), true);
    const auto n_all = contact.tangent().n_nonzero_elements();

    begin_step();
    ContactTimeStep(contact).assemble(sunk_by(1e-4), h, true);
    const unsigned int first  = contact.pattern_version();
    const auto         n_none = contact.tangent().n_nonzero_elements();
    EXPECT_EQ(n_touching(), 0U);
    // three blocks of twelve unknowns, each with itself
    EXPECT_EQ(n_none, 3U * 12U * 12U);
    ContactTimeStep(contact).assemble(sunk_by(2e-4), h, true);
    EXPECT_EQ(contact.pattern_version(), first);

    // without a tangent nothing is coupled
    const Vector deep = sunk_by(1.2 * gap);
    ContactTimeStep(contact).assemble(deep, h, false);
    EXPECT_GT(n_touching(), 0U);
    EXPECT_EQ(contact.pattern_version(), first);
    ContactTimeStep(contact).assemble(deep, h, true);
    EXPECT_EQ(contact.pattern_version(), first + 1);
    const auto n_two = contact.tangent().n_nonzero_elements();
    EXPECT_EQ(n_two, n_none + 2U * 12U * 12U);
    EXPECT_GT(n_all, n_two);

    // the tangent is that by displacements in the middle of the step
    const Vector d =
      bodies->interpolate([&](const Point<2> &X, const unsigned int block) {
        return block == above ? Point<2>(X[1], 1. + X[0])
                              : Point<2>(0.3, -X[0]);
      });
    Vector owned(contact.residual()), direction(owned), product(owned);
    constexpr double step = 1e-8;
    direction             = d;
    contact.tangent().vmult(product, direction);
    owned = deep;
    owned.add(step, direction);
    ContactTimeStep(contact).assemble(bodies->relevant(owned), h, false);
    Vector difference(contact.residual());
    owned.add(-2. * step, direction);
    ContactTimeStep(contact).assemble(bodies->relevant(owned), h, false);
    difference -= contact.residual();
    difference *= 2. * 0.5 / step;
    difference -= product;
    // rounding of differences of 1e-8 m
    EXPECT_LE(difference.l2_norm(), 1e-6 * product.l2_norm());

    begin_step();
    ContactTimeStep(contact).assemble(sunk_by(1e-4), h, true);
    EXPECT_EQ(contact.tangent().n_nonzero_elements(), n_none);
  }


  // With friction, and with slip that opens faces: what sticks and what slides, against
  // differences.
  TEST(ContactSteps, TangentWithFrictionAgainstDifferences)
  {
    constexpr double gap = 0.01, reach = 0.1, h = 0.01, depth = 1.2 * gap;
    for (const double dilation : {0., 0.2})
      for (const double slide : {1e-4, 0.03})
      {
        SCOPED_TRACE("dilation " + std::to_string(dilation) + ", slide " +
                     std::to_string(slide));
        Geometry geometry;
        geometry.add_polygon({{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}}, "below");
        geometry.add_polygon(
          {{1., 1. + gap}, {2., 1. + gap}, {2., 2.}, {1., 2.}}, "above");
        Bodies bodies(std::move(geometry), one_triangle_each());
        auto   parameters                   = contact_parameters(1e8, reach);
        coulomb(parameters).shear_stiffness = 3e7;
        coulomb(parameters).friction        = 0.3;
        coulomb(parameters).dilation        = dilation;
        coulomb(parameters).normal_damping = coulomb(parameters).shear_damping =
          1e4;
        bodies.start(parameters);
        const unsigned int above =
          bodies.mesh.block(bodies.mesh.find_element({1.5, 1.5}));
        const auto moved_by = [&](const double down, const double along) {
          return bodies.interpolate(
            [&](const Point<2> &X, const unsigned int block) {
              return block == above ? Point<2>(along, -down * (1. + 0.1 * X[0]))
                                    : Point<2>();
            });
        };
        Contact   &contact = *bodies.contact;
        const auto begin   = [&](const Vector &u) {
          contact.detect(u);
          ContactTimeStep(contact).begin(u, 0.);
          contact.set_time(h);
        };
        // in contact from the first step's end on
        begin(moved_by(0., 0.));
        ContactTimeStep(contact).assemble(moved_by(depth, 0.), h, false);
        contact.assemble(moved_by(depth, 0.), false);
        contact.accept();
        begin(moved_by(depth, 0.));
        const Vector end = moved_by(1.05 * depth, slide);
        ContactTimeStep(contact).assemble(end, h, false);
        ContactTimeStep(contact).assemble(end, h, true);
        ASSERT_GT(contact.report().n_stick + contact.report().n_slip, 2U);
        EXPECT_EQ(contact.report().n_stick > 0, slide < 0.01);

        Vector owned(contact.residual()), direction(owned), product(owned);
        direction =
          bodies.interpolate([&](const Point<2> &X, const unsigned int b) {
            return b == above ? Point<2>(1. - X[1], 1. + X[0])
                              : Point<2>(0.3 * X[1] * X[0], -X[0]);
          });
        contact.tangent().vmult(product, direction);
        constexpr double step = 1e-8;
        owned                 = end;
        owned.add(step, direction);
        ContactTimeStep(contact).assemble(bodies.relevant(owned), h, false);
        Vector difference(contact.residual());
        owned.add(-2. * step, direction);
        ContactTimeStep(contact).assemble(bodies.relevant(owned), h, false);
        difference -= contact.residual();
        // by displacements in the middle of the step
        difference *= 1. / step;
        difference -= product;
        // rounding of differences of 1e-8 m; the slip that opens faces is along these
        // at the end, its derivative along those in the middle, which are turned by
        // half of 0.05 * 0.1 * depth, 3e-5, against that
        EXPECT_LE(difference.l2_norm(),
                  (dilation > 0. ? 3e-5 : 1e-6) * product.l2_norm());
      }
  }


  // Where a solution starts from the begin of the step, what may touch in it is coupled
  // nevertheless if the motion is known beforehand.
  TEST_F(TwoAndOne, PatternHasWhatIsExpected)
  {
    Contact     &contact = *bodies->contact;
    const Vector deep    = sunk_by(1.2 * gap);
    for (const bool is_expected : {false, true})
    {
      begin_step();
      if (is_expected)
        ContactTimeStep(contact).expect(deep);
      ContactTimeStep(contact).assemble(sunk_by(0.), h, true);
      EXPECT_EQ(n_touching(), 0U);
      const unsigned int first = contact.pattern_version();
      // three blocks of twelve unknowns each with itself, and two with each other
      EXPECT_EQ(contact.tangent().n_nonzero_elements(),
                (is_expected ? 5U : 3U) * 12U * 12U);
      ContactTimeStep(contact).assemble(deep, h, true);
      EXPECT_GT(n_touching(), 0U);
      EXPECT_EQ(contact.pattern_version(), is_expected ? first : first + 1);
    }
  }


  // What is added is there until the next assembly, in whatever is assembled.
  TEST_F(TwoAndOne, TangentWithAnotherMatrix)
  {
    Contact &contact = *bodies->contact;
    begin_step();
    const Vector deep = sunk_by(1.2 * gap);
    ContactTimeStep(contact).assemble(deep, h, true);
    const Vector d = bodies->interpolate(
      [&](const Point<2> &X, const unsigned int) { return X * X[0]; });
    Vector direction(contact.residual()), of_contact(direction),
      of_elasticity(direction), of_both(direction);
    direction = d;
    contact.tangent().vmult(of_contact, direction);
    EXPECT_GT(of_contact.l2_norm(), 0.);
    ASSERT_EQ(bodies->elasticity->assemble(sunk_by(0.),
                                           1.,
                                           Tangent::consistent),
              Deformation::admissible);
    bodies->elasticity->tangent().vmult(of_elasticity, direction);
    EXPECT_GT(of_elasticity.l2_norm(), 1e-10 * of_contact.l2_norm());
    contact.add_to_tangent(bodies->elasticity->tangent());
    contact.tangent().vmult(of_both, direction);
    of_both -= of_contact;
    of_both -= of_elasticity;
    // rounding of the larger one
    EXPECT_LE(of_both.l2_norm(), 1e-13 * of_contact.l2_norm());
    ContactTimeStep(contact).assemble(deep, h, true);
    contact.tangent().vmult(of_both, direction);
    of_both -= of_contact;
    EXPECT_EQ(of_both.l2_norm(), 0.);
  }


  // Where one body alone is assembled again, rows of the other one stay, with what was added to them.
  TEST_F(TwoAndOne, RowsThatAreNotChosenStay)
  {
    Contact     &contact = *bodies->contact;
    const Vector deep    = sunk_by(1.2 * gap);
    begin_step();
    ContactTimeStep(contact).assemble(deep, h, true);
    Contact::Matrix all, half;
    all.reinit(contact.tangent());
    all.copy_from(contact.tangent());

    contact.tangent() *= 0.5;
    half.reinit(contact.tangent());
    half.copy_from(contact.tangent());
    std::vector<bool> chosen(3, false);
    chosen[above] = true;
    ContactTimeStep(contact).restrict_to(chosen);
    ContactTimeStep(contact).assemble(deep, h, true);
    ContactTimeStep(contact).restrict_to({});
    std::set<unsigned int> of_above;
    for (unsigned int e = 0; e < bodies->mesh.n_elements(); ++e)
      if (bodies->mesh.block(e) == above)
        for (const unsigned int k : bodies->covers.covers(e))
          of_above.insert({2 * k, 2 * k + 1});
    unsigned int n_of_both[2] = {0, 0};
    for (const auto &entry : contact.tangent())
    {
      const bool is_of_above = of_above.count(entry.row()) > 0;
      EXPECT_EQ(entry.value(),
                (is_of_above ? all : half).el(entry.row(), entry.column()));
      n_of_both[is_of_above] += entry.value() != 0.;
    }
    EXPECT_GT(n_of_both[0], 0U);
    EXPECT_GT(n_of_both[1], 0U);
  }


  // The same tangent as a matrix of blocks: only those are there that touch, and where
  // unknowns are prescribed nothing is.
  TEST_F(TwoAndOne, TangentByBlocks)
  {
    std::vector<unsigned int> unknown_to_block(2 * bodies->covers.n_covers());
    for (unsigned int e = 0; e < bodies->mesh.n_elements(); ++e)
      for (const unsigned int k : bodies->covers.covers(e))
        unknown_to_block[2 * k] = unknown_to_block[2 * k + 1] =
          bodies->mesh.block(e);
    ASSERT_TRUE(BodyMatrix::is_suitable(unknown_to_block));
    const unsigned int below =
      bodies->mesh.block(bodies->mesh.find_element({1.5, 0.5}));
    ContactParameters parameters = contact_parameters(1e8, reach);
    coulomb(parameters).friction = 0.3;
    for (const bool is_held : {false, true})
    {
      dealii::AffineConstraints<double> held;
      for (unsigned int i = 0; is_held && i < unknown_to_block.size(); i += 5)
        if (unknown_to_block[i] == below)
          held.add_line(i);
      held.close();
      Contact      contact(bodies->surface, held, parameters);
      BodyMatrix   blocks(unknown_to_block);
      const Vector deep = sunk_by(1.2 * gap);
      const auto   step = [&](BodyMatrix *body_matrix) {
        contact.detect(sunk_by(0.));
        ContactTimeStep(contact).begin(sunk_by(0.), 0.);
        contact.set_time(h);
        ContactTimeStep(contact).assemble(deep, h, true, body_matrix);
      };
      step(nullptr);
      Contact::Matrix sparse;
      sparse.reinit(contact.tangent());
      sparse.copy_from(contact.tangent());
      const Vector       forces  = contact.residual();
      const unsigned int version = contact.pattern_version();

      blocks.begin_rows({});
      step(&blocks);
      EXPECT_EQ(contact.pattern_version(), version);
      Vector difference(forces);
      difference -= contact.residual();
      EXPECT_EQ(difference.l2_norm(), 0.);
      const Contact::Matrix found = blocks.sparse();
      unsigned int          n     = 0;
      for (const auto &entry : found)
      {
        EXPECT_EQ(entry.value(), sparse.el(entry.row(), entry.column()));
        n += entry.value() != 0.;
      }
      // nothing is missing
      EXPECT_DOUBLE_EQ(found.frobenius_norm(), sparse.frobenius_norm());
      EXPECT_GT(n, 100U);
      for (unsigned int b = 0; b < 3; ++b)
      {
        unsigned int n_columns = 0;
        blocks.for_each_in_row(b, [&](unsigned int, const double *) {
          ++n_columns;
        });
        EXPECT_EQ(n_columns, b == above || b == below ? 2U : 1U);
      }
    }
  }


  // A corner comes into a face just beside the end of that one: it is in front of the
  // face at the begin of a step and behind it at the end, and what it does in the middle,
  // where the other face of the corner is as near, does not matter.
  TEST(ContactSteps, CornerBesideACorner)
  {
    constexpr double reach = 0.1, h = 0.01, gap = 1e-4, stiffness = 1e8;
    const Point<2>   corner(1. + gap, 0.98);
    for (const double direction : {45., 60., 80.})
    {
      const double       turn = dealii::numbers::PI * direction / 180.;
      const Tensor<1, 2> e({std::cos(turn), std::sin(turn)}),
        f({-std::sin(turn), std::cos(turn)});
      Geometry geometry;
      geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "left");
      geometry.add_polygon({corner,
                            corner - f * 0.5,
                            corner + e * 0.5 - f * 0.5,
                            corner + e * 0.5},
                           "right");
      Bodies bodies(std::move(geometry), one_triangle_each());
      bodies.start(contact_parameters(stiffness, reach));
      const unsigned int right =
        bodies.mesh.block(bodies.mesh.find_element(corner + 0.25 * (e - f)));
      const auto moved_by = [&](const double way) {
        return bodies.interpolate(
          [&](const Point<2> &, const unsigned int block) {
            return block == right ? Point<2>(-way, 0.) : Point<2>();
          });
      };
      const Vector begin = moved_by(0.);
      bodies.contact->detect(begin);
      ContactTimeStep(*bodies.contact).begin(begin, 0.);
      bodies.contact->set_time(h);
      double last = 0., largest_jump = 0., largest = 0.;
      for (double way = gap; way < 3. * gap; way += 0.01 * gap)
      {
        ContactTimeStep(*bodies.contact).assemble(moved_by(way), h, false);
        const double force = bodies.contact->report().force.norm();
        largest_jump       = std::max(largest_jump, std::abs(force - last));
        largest            = std::max(largest, force);
        last               = force;
      }
      EXPECT_GT(largest, 0.) << direction;
      // a hundredth of the gap each: force and slope are those of one spring
      EXPECT_LE(largest_jump, 0.02 * largest) << direction;
    }
  }


#ifdef DEBUG
  // What Contact asserts of the order of calls: no assembly before faces have been looked for, also
  // again after a history has been restored, and nothing accepted in the middle of a step.
  TEST(ContactSteps, OrderOfCallsIsAsserted)
  {
    Geometry geometry;
    geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}, "block");
    Bodies::Options options = one_triangle_each();
    options.obstacles       = {obstacle("floor", {{9., 0.}, {-9., 0.}})};
    Bodies bodies(std::move(geometry), options);
    bodies.start(contact_parameters(1e8, 0.1));
    Contact        &contact = *bodies.contact;
    ContactTimeStep step(contact);
    const Vector    u = bodies.interpolate(
      [](const Point<2> &, unsigned int) { return Point<2>(0., -1e-3); });

    using Wrong = dealii::ExceptionBase;
    EXPECT_THROW(contact.assemble(u, false), Wrong);
    contact.detect(u);
    EXPECT_THROW(contact.accept(), Wrong);
    EXPECT_THROW(step.assemble(u, 0.1, false), Wrong);
    step.begin(u, 0.);
    step.assemble(u, 0.1, false);
    EXPECT_THROW(contact.accept(), Wrong);
    contact.assemble(u, false);
    EXPECT_NO_THROW(contact.accept());
    EXPECT_THROW(step.begin(u, 0.1), Wrong);
    contact.restore_history(contact.history());
    EXPECT_THROW(contact.assemble(u, false), Wrong);
    contact.detect(u);
    EXPECT_NO_THROW(contact.assemble(u, false));
  }
#endif


  // The corner of a block that lies along a slope, turned by ten degrees, passes the foot
  // of it: along the slope the corner has no share, on the ground its face is too steep to
  // lie along that, and so all of the corner's spring is for the ground.
  TEST(ContactSteps, CornerPassesAFoot)
  {
    constexpr double reach = 0.1, h = 0.01, stiffness = 1e8;
    constexpr double slope = dealii::numbers::PI / 6., pi = dealii::numbers::PI;
    for (const double turn : {8., 10., 15.})
    {
      const double       angle = slope + pi * turn / 180.;
      const Tensor<1, 2> e({std::cos(angle), std::sin(angle)}),
        f({-std::sin(angle), std::cos(angle)});
      // in the slope as far as its spring gives way
      const Point<2> corner(2e-4, 2e-4 * std::tan(slope) - 1e-5);
      Geometry       geometry;
      geometry.add_polygon({corner, corner + e, corner + e + f, corner + f},
                           "block");
      Bodies::Options options = one_triangle_each();
      options.obstacles       = {
              obstacle("slope", {{4., 4. * std::tan(slope)}, {0., 0.}, {-4., 0.}})};
      Bodies bodies(std::move(geometry), options);
      bodies.start(contact_parameters(stiffness, reach));
      const auto moved_by = [&](const double way) {
        return bodies.interpolate([&](const Point<2> &, unsigned int) {
          return Point<2>(-way, -way * std::tan(slope));
        });
      };
      // beyond the foot from one step to the next, and further
      for (const double way : {0., 1e-3, 3e-3, 6e-3})
      {
        const Vector begin = moved_by(way), end = moved_by(way + 1e-3);
        bodies.contact->detect(begin);
        ContactTimeStep(*bodies.contact).begin(begin, 0.);
        bodies.contact->set_time(h);
        ContactTimeStep(*bodies.contact).assemble(end, h, false);
        const double height = corner[1] - way * std::tan(slope);
        if (height >= 0.)
          continue;
        double up = 0.;
        for (const ContactPoint &point : bodies.contact->points())
          if (point.normal[1] > 0.99)
            up += point.weight * point.pressure;
        EXPECT_GT(up, 0.) << turn << ' ' << way;
        bodies.contact->assemble(end, false);
        bodies.contact->accept();
      }
    }
  }


  // A block stands on a face with a corner, and another one that leans over the face by
  // five degrees comes down with its corner just there: what the first one looks at
  // the face with is too steep to bear anything, and must not stand before the second.
  TEST(ContactSteps, CornerLandsBesideAnother)
  {
    constexpr double reach = 0.3, h = 0.01, stiffness = 1e8, depth = 0.03;
    constexpr double lift = 2., degree = dealii::numbers::PI / 180.;
    const auto       along = [&](const double angle) {
      return Tensor<1, 2>({std::cos(angle * degree), std::sin(angle * degree)});
    };
    for (const unsigned int rank_below : {0U, 3U})
      for (const double beside : {-2e-3, -1e-4, 1e-4, 2e-3})
      {
        const Point<2> standing(0., lift), leaning(-lift + beside, lift);
        Geometry       geometry;
        geometry.add_polygon({{-1.2, -1.}, {1., -1.}, {1., 0.}, {-1.2, 0.}},
                             "below");
        geometry.add_polygon({standing,
                              standing + along(20.),
                              standing + along(20.) + along(110.),
                              standing + along(110.)},
                             "standing");
        geometry.add_polygon({leaning,
                              leaning + 0.4 * along(110.),
                              leaning + along(175.) + 0.4 * along(110.),
                              leaning + 2.3 * along(175.)},
                             "leaning");
        Bodies     bodies(std::move(geometry), one_triangle_each());
        const auto block_at = [&](const Point<2> &x) {
          return bodies.mesh.block(bodies.mesh.find_element(x));
        };
        const unsigned int is_below    = block_at({-0.5, -0.5}),
                           is_standing = block_at(standing + 0.5 * along(65.)),
                           is_leaning  = block_at(leaning + 0.2 * along(140.));
        ContactParameters parameters   = contact_parameters(stiffness, reach);
        parameters.slave_priority.assign(3, 1);
        parameters.slave_priority[is_below] = rank_below;
        bodies.start(parameters);
        const auto sunk_by = [&](const double way, const bool is_there) {
          return bodies.interpolate(
            [&](const Point<2> &, const unsigned int block) -> Tensor<1, 2> {
              if (block == is_standing)
                return Point<2>(0., is_there ? -lift - 3e-3 : 0.);
              return block == is_leaning ? Point<2>(lift, -lift - way)
                                         : Point<2>();
            });
        };
        const auto &edges           = bodies.surface.edges();
        const auto  is_between_them = [&](const ContactPoint &point) {
          const std::set<unsigned int> pair = {edges[point.edge].body,
                                               edges[point.master].body};
          return pair == std::set<unsigned int>({is_below, is_leaning});
        };
        // with and without the one that stands
        double force[2];
        for (const bool is_there : {false, true})
        {
          const Vector begin = sunk_by(1e-3, is_there),
                       end   = sunk_by(depth, is_there);
          bodies.contact->detect(begin);
          ContactTimeStep(*bodies.contact).begin(begin, 0.);
          bodies.contact->set_time(h);
          ContactTimeStep(*bodies.contact).assemble(end, h, false);
          force[is_there] = 0.;
          for (const ContactPoint &point : bodies.contact->points())
            if (point.pressure > 0. && is_between_them(point))
              force[is_there] += point.weight * point.pressure;
        }
        EXPECT_GT(force[0], 0.);
        // the piece of the face may begin 2 mm beside the corner that lands, where that one
        // is 1.1 % less deep; point and weight of the rest change by less
        EXPECT_NEAR(force[1], force[0], 0.03 * force[0])
          << rank_below << ' ' << beside;
      }
  }


  // The tip of a wedge has slid along the top of a block to its end and goes down beside the
  // block: it is in front of the side, and the block's corner is in front of the wedge's far
  // side, and yet the wedge cuts the corner off. The corner is pushed out by the side of the wedge
  // that lies over it.
  TEST(ContactSteps, WedgeBesideACorner)
  {
    constexpr double reach = 0.1, h = 0.01, stiffness = 1e8, lift = 1.;
    constexpr double degree = dealii::numbers::PI / 180.;
    const auto       along  = [&](const double angle) {
      return Tensor<1, 2>({std::cos(angle * degree), std::sin(angle * degree)});
    };
    const Point<2> tip(0., lift);
    Geometry       geometry;
    geometry.add_polygon({{0., -1.}, {1., -1.}, {1., 0.}, {0., 0.}}, "block");
    geometry.add_polygon({tip, tip + along(40.), tip + along(70.)}, "wedge");
    Bodies bodies(std::move(geometry), one_triangle_each());
    bodies.start(contact_parameters(stiffness, reach));
    const unsigned int wedge =
      bodies.mesh.block(bodies.mesh.find_element(tip + 0.5 * along(55.)));
    const auto tip_at = [&](const Point<2> &x) {
      return bodies.interpolate(
        [&](const Point<2> &, const unsigned int block) -> Tensor<1, 2> {
          return block == wedge ? x - tip : Tensor<1, 2>();
        });
    };
    const Point<2>     before(-8e-4, 1.5e-3), after(-5e-4, -5.6e-3);
    const Tensor<1, 2> normal(
      {std::sin(40. * degree), -std::cos(40. * degree)});
    const Vector begin = tip_at(before), end = tip_at(after);
    bodies.contact->detect(begin);
    ContactTimeStep(*bodies.contact).begin(begin, 0.);
    bodies.contact->set_time(h);
    ContactTimeStep(*bodies.contact).assemble(end, h, false);
    // of a spring that is met on the way: the energy at the end over the way
    const double gap_before = -(before * normal), gap_after = -(after * normal);
    ASSERT_GT(gap_before, 0.);
    ASSERT_LT(gap_after, 0.);
    const double pressure =
      0.5 * stiffness * gap_after * gap_after / (gap_before - gap_after);
    unsigned int n = 0;
    for (const ContactPoint &point : bodies.contact->points())
      if (point.weight > 0. && point.pressure > 0.)
      {
        ++n;
        // the corner of the block at both of its edges
        EXPECT_NEAR((point.normal - normal).norm(), 0., 1e-6);
        EXPECT_NEAR(point.pressure, pressure, 1e-6 * pressure);
      }
    EXPECT_EQ(n, 2U);
  }

  // A keel that stuck to a block with its right side comes, in one step, from where the block is beyond
  // its end, and its edge, which is in the block then, is nearer to the left side: what is found there by
  // the step's end brings no energy with it, and neither does it where the state is accepted,
  // which takes the same side.
  TEST(ContactSteps, FoundOnTheOtherSideOfAKeel)
  {
    constexpr double reach = 6., h = 0.01, stiffness = 1e8, lift = 1.,
                     slope = 0.466;
    Geometry geometry;
    // the larger one's are the points along faces
    geometry.add_polygon({{-2., -2.}, {2., -2.}, {2., 0.}, {-2., 0.}},
                         "ground");
    geometry.add_polygon({{0., lift},
                          {0.75, lift + 0.75 * slope},
                          {0.75, lift + 1.},
                          {-0.5, lift + 1.},
                          {-0.5, lift + 0.25 * slope}},
                         "keel");
    Bodies bodies(std::move(geometry), one_triangle_each());
    auto   parameters            = contact_parameters(stiffness, reach);
    coulomb(parameters).friction = 0.5;
    bodies.start(parameters);
    const unsigned int keel =
      bodies.mesh.block(bodies.mesh.find_element({0., lift + 0.5}));
    const auto edge_at = [&](const double x, const double y) {
      return bodies.interpolate(
        [&](const Point<2> &, const unsigned int b) -> Tensor<1, 2> {
          return b == keel ? Point<2>(x, y - lift) : Point<2>();
        });
    };
    Contact   &contact = *bodies.contact;
    const auto step    = [&](const Vector &begin, const Vector &end) {
      contact.detect(begin);
      ContactTimeStep(contact).begin(begin, 0.);
      contact.set_time(h);
      ContactTimeStep(contact).assemble(end, h, false);
      contact.assemble(end, false);
    };
    step(edge_at(0.6, 0.), edge_at(0.6, -0.2));
    EXPECT_GT(contact.report().n_stick + contact.report().n_slip, 0U);
    contact.accept();

    step(edge_at(-4., 0.3), edge_at(0.95, -0.34));
    unsigned int n_behind = 0;
    for (const ContactPoint &point : contact.points())
      if (point.master != invalid_index && point.weight > 0.)
      {
        n_behind += point.gap < -0.1;
        EXPECT_LE(point.pressure, 1e-9 * stiffness) << point.x;
      }
    EXPECT_GT(n_behind, 0U);
  }
} // namespace
