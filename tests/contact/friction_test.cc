// Statics with friction, wrong input, and that results do not depend on chance.

#include <nmm/contact/law/barton_bandis_law.h>
#include <nmm/contact/law/slip_weakening_law.h>

#include <contact/contact_model.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  /// A block of 1 x 0.5 on a rigid floor of several pieces, pressed by 1 and pushed
  /// by a uniform shear traction on its top that grows with the load factor.
  std::unique_ptr<Bodies>
  pushed_block(const double   shear,
               const double   friction,
               const double   cohesion,
               const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 0.5});
    Bodies::Options options;
    options.cell_size    = 0.2;
    options.rotation     = 13.;
    options.communicator = communicator;
    options.obstacles    = {
         obstacle("floor",
               {{2., 0.}, {0.93, 0.}, {0.41, 0.}, {0.13, 0.}, {-1., 0.}})};
    auto bodies = std::make_unique<Bodies>(std::move(geometry), options);
    bodies->problem.boundary_conditions = {condition(Type::pressure,
                                                     "top",
                                                     constant(1.)),
                                           condition(Type::traction, "bottom")};
    bodies->problem.boundary_conditions.back().value =
      vector_function([=](const Point<2> &) { return Point<2>(shear, 0.); });
    ContactParameters parameters        = contact_parameters(1e5, 0.1);
    coulomb(parameters).shear_stiffness = 5e4;
    coulomb(parameters).friction        = friction;
    coulomb(parameters).cohesion        = cohesion;
    bodies->start(parameters);
    return bodies;
  }


  TEST(ContactFriction, SticksBelowAndHoldsTheShear)
  {
    // the shear acts where friction does, so that its distribution is uniform:
    // slip over shear is 1 / eps_t everywhere
    auto       bodies = pushed_block(0.2, 0.5, 0.);
    const auto steps  = bodies->statics->run(LoadSteps::equal(3));
    EXPECT_EQ(steps.back().contact.n_slip, 0U);
    EXPECT_NEAR(steps.back().contact.force[0], -0.2, 1e-7);
    EXPECT_NEAR(steps.back().contact.force[1], 1., 1e-7);
    double                  slip = 0., largest = 0., weight = 0., shear = 0.;
    const DisplacementField field(bodies->covers,
                                  bodies->problem,
                                  bodies->statics->solution());
    for (const ContactPoint &point : bodies->contact->points())
      if (point.state == ContactState::stick)
      {
        largest = std::max(largest, std::abs(point.shear));
        weight += point.weight;
        shear += point.weight * point.shear;
        slip += point.weight *
                (point.x[0] -
                 bodies->surface.reference_place(point.edge, point.s).x[0]);
      }
    EXPECT_NEAR(std::abs(slip), std::abs(shear) / 5e4, 1e-4 * std::abs(slip));
    EXPECT_NEAR(weight, 1., 1e-4);
  }


  /// Direct shear: a block between its fixed top and a floor that rises and then moves to the
  /// left. Each point that slides bears the strength of its law after the way that it has slid,
  /// which is what the floor has moved, less what block and shear spring give way; the pressure
  /// is that of the closure. Newton's method leaves some 1e-9 of the forces.
  void
  check_direct_shear(const std::shared_ptr<const ContactLaw> &law,
                     const double                             rise)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 0.2});
    Bodies::Options options;
    options.cell_size = 0.1;
    options.obstacles = {obstacle("floor", {{3., 0.}, {-1., 0.}})};
    const auto moved  = [=](const double t) {
      return Point<2>(t < 0.2 ? 0. : -0.05 * (t - 0.2),
                      rise * std::min(1., t / 0.2));
    };
    options.obstacles[0].displacement = moved;
    Bodies bodies(std::move(geometry), options);
    bodies.problem.materials[0].poissons_ratio = 0.;
    bodies.problem.boundary_conditions = {condition(Type::displacement, "top")};
    ContactParameters parameters;
    parameters.law   = law;
    parameters.reach = 0.1;
    bodies.start(parameters);
    unsigned int n = 0;
    bodies.statics->run(
      LoadSteps::equal(10), [&](const ContactStep &step, const Vector &) {
        for (const ContactPoint &point : bodies.contact->points())
        {
          if (point.state == ContactState::open || point.weight == 0.)
            continue;
          EXPECT_NEAR(point.pressure,
                      law->pressure(-point.gap).value,
                      1e-8 * point.pressure);
          if (point.state != ContactState::slip)
            continue;
          const double way =
            point.x[0] -
            bodies.surface.reference_place(point.edge, point.s).x[0] -
            moved(step.load_factor)[0];
          const double slip = way - std::abs(point.shear) / law->shear_spring();
          const double strength = law->strength(point.pressure, slip).value;
          EXPECT_NEAR(std::abs(point.shear), strength, 1e-6 * strength);
          ++n;
        }
      });
    EXPECT_GT(n, 100U);
  }


  TEST(ContactFriction, DirectShearOfBartonAndBandis)
  {
    BartonBandisLaw law;
    law.normal_stiffness           = 100.;
    law.shear_stiffness            = 100.;
    law.joint_roughness            = 10.;
    law.joint_compressive_strength = 3.;
    law.residual_angle             = 25.;
    law.joint_length               = 0.5;
    law.largest_closure            = 2e-3;
    check_direct_shear(std::make_shared<BartonBandisLaw>(law), 2e-3);
  }


  TEST(ContactFriction, DirectShearThatWeakens)
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = 100.;
    law.shear_stiffness   = 100.;
    law.friction          = 0.7;
    law.cohesion          = 0.02;
    law.residual_friction = 0.4;
    law.weakening_length  = 0.02;
    check_direct_shear(std::make_shared<SlipWeakeningLaw>(law), 2e-3);
  }


  /// Pushed by displacements of the top: shear that is transmitted is mu N and c A.
  TEST(ContactFriction, SlidesAtTheLimit)
  {
    for (const double cohesion : {0., 0.05})
    {
      const double friction = 0.3;
      Geometry     geometry;
      add_box(geometry, {0., 0.}, {1., 0.2});
      Bodies::Options options;
      options.cell_size = 0.1;
      options.rotation  = 13.;
      options.obstacles = {
        obstacle("floor",
                 {{2., 0.}, {1.05, 0.}, {0.93, 0.}, {0.13, 0.}, {-1., 0.}})};
      // first down, then to the right, over joints of the floor
      options.obstacles[0].displacement = [](const double t) {
        return Point<2>(t < 0.2 ? 0. : -0.3 * (t - 0.2),
                        0.001 * std::min(1., t / 0.2));
      };
      Bodies bodies(std::move(geometry), options);
      bodies.problem.boundary_conditions = {
        condition(Type::displacement, "top")};
      ContactParameters parameters = contact_parameters(1e6, 0.1);
      coulomb(parameters).friction = friction;
      coulomb(parameters).cohesion = cohesion;
      bodies.start(parameters);
      unsigned int n = 0;
      bodies.statics->run(
        LoadSteps::equal(10), [&](const ContactStep &step, const Vector &) {
          if (step.load_factor < 0.35 || !step.is_asked)
            return;
          ++n;
          // every point slides; the area in contact is that of the bottom
          EXPECT_EQ(step.contact.n_stick, 0U);
          double area = 0.;
          for (const ContactPoint &point : bodies.contact->points())
            if (point.state == ContactState::slip)
              area += point.weight;
          EXPECT_NEAR(std::abs(step.contact.force[0]),
                      friction * step.contact.force[1] + cohesion * area,
                      1e-9 * step.contact.force[1]);
          EXPECT_GT(step.contact.force[1], 1.);
        });
      EXPECT_GE(n, 5U);
    }
  }


  TEST(ContactInput, BadValues)
  {
    const auto expect_error = [](const std::function<void()> &call,
                                 const std::string           &words) {
      try
      {
        call();
        ADD_FAILURE() << "no error about " << words;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(error.message().find(words), std::string::npos)
          << error.message();
      }
    };
    ContactParameters good = contact_parameters(1.);
    const auto with = [&](const std::function<void(ContactParameters &)> &f,
                          const std::string &words) {
      ContactParameters bad = good;
      f(bad);
      expect_error([&]() { bad.check(); }, words);
    };
    EXPECT_NO_THROW(good.check());
    with([](ContactParameters &p) { coulomb(p).normal_stiffness = -1.; },
         "normal spring");
    with([](ContactParameters &p) { p = ContactParameters(); }, "no law");
    with([](ContactParameters &p) { coulomb(p).shear_stiffness = -1.; },
         "shear spring");
    with([](ContactParameters &p) { coulomb(p).friction = -0.1; }, "friction");
    with([](ContactParameters &p) { coulomb(p).friction = std::nan(""); },
         "friction");
    with([](ContactParameters &p) { coulomb(p).cohesion = -0.1; }, "cohesion");
    with([](ContactParameters &p) { coulomb(p).dilation = 0.1; }, "dilation");
    with(
      [](ContactParameters &p) {
        coulomb(p).friction = 0.3;
        coulomb(p).dilation = -0.1;
      },
      "dilation");
    with([](ContactParameters &p) { coulomb(p).dilation_limit = 0.1; },
         "dilates");
    with([](ContactParameters &p) { p.reach = -0.1; }, "reach");
    with([](ContactParameters &p) { p.penetration_tolerance = -0.1; },
         "penetration");
    with([](ContactParameters &p) { p.n_points = 1; }, "points");

    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    PhysicalMesh     physical_mesh(geometry);
    MathematicalMesh mathematical_mesh =
      make_regular_mesh(physical_mesh, mesh_parameters(0.3), 2);
    ManifoldMesh mesh(mathematical_mesh, physical_mesh);
    CoverSystem  covers(mesh, MPI_COMM_WORLD);
    const auto   make = [&](const RigidObstacle &o) {
      return ContactSurface(covers, {o});
    };
    RigidObstacle broken = obstacle("wall", {{2., 0.}, {2., 1.}});
    broken.pieces.push_back(CurvePiece::segment({2., 1.1}, {2., 2.}));
    expect_error([&]() { make(broken); }, "wall");
    RigidObstacle circle;
    circle.name   = "roll";
    circle.pieces = {CurvePiece::circle({3., 3.}, 1.)};
    expect_error([&]() { make(circle); }, "roll");

    // overlap: how much, with what
    const auto overlap = [&](const RigidObstacle &o) {
      make(o).check_initial_overlap(1e-9);
    };
    EXPECT_NO_THROW(overlap(obstacle("floor", {{2., 0.}, {-1., 0.}})));
    EXPECT_NO_THROW(overlap(obstacle("shelf", {{2., 1.5}, {-1., 1.5}})));
    expect_error(
      [&]() {
        overlap(obstacle("floor", {{2., 0.02}, {-1., 0.02}}));
      },
      "overlap by 0.02 m");
    expect_error(
      [&]() {
        overlap(obstacle("floor", {{2., 0.4}, {-1., 0.4}}));
      },
      "'floor' overlap by 0.4 m");
    const std::vector<Point<2>> square = {
      {0.3, 0.3}, {0.5, 0.3}, {0.5, 0.5}, {0.3, 0.5}, {0.3, 0.3}};
    expect_error([&]() { overlap(obstacle("stone", square)); },
                 "'stone' overlap by");
    const std::vector<Point<2>> all = {
      {-1., -1.}, {2., -1.}, {2., 2.}, {-1., 2.}, {-1., -1.}};
    expect_error([&]() { overlap(obstacle("box", all)); }, "'box' overlap by");
    // a hole in the box's place: the body is on the other side
    const std::vector<Point<2>> around(all.rbegin(), all.rend());
    EXPECT_NO_THROW(overlap(obstacle("frame", around)));
  }


  TEST(ContactChance, RepeatedRunAndRanksMPI)
  {
    const auto run = [](const MPI_Comm communicator) {
      auto       bodies = pushed_block(0.2, 0.3, 0., communicator);
      const auto steps  = bodies->statics->run(LoadSteps::equal(2));
      Vector     owned(bodies->covers.locally_owned_dofs(2), communicator);
      owned = bodies->statics->solution();
      return std::make_pair(owned.l2_norm(), steps.back().contact);
    };
    const auto first = run(MPI_COMM_WORLD), again = run(MPI_COMM_WORLD);
    EXPECT_EQ(first.first, again.first);
    EXPECT_EQ(first.second.force[0], again.second.force[0]);
    const auto alone = run(MPI_COMM_SELF);
    EXPECT_NEAR(first.first, alone.first, 1e-9 * alone.first);
    EXPECT_EQ(first.second.n_stick, alone.second.n_stick);
    EXPECT_EQ(first.second.n_slip, alone.second.n_slip);
    EXPECT_EQ(first.second.n_points, alone.second.n_points);
    EXPECT_NEAR(first.second.force[1], alone.second.force[1], 1e-9);
  }
} // namespace
