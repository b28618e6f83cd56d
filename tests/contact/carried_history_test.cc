// The history of contact after a solid has been cut anew.

#include <nmm/contact/assembly/time_step.h>
#include <nmm/contact/state/carried_history.h>

#include <contact/contact_model.h>
#include <support/contact_bars/moving_bodies.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double normal_spring = 1e5, shear_spring = 5e4, face_friction = 0.5;
  /// Penetration of faces that slide [m]; less than the shortest edges, which have no contact
  /// where they are much shorter than deep.
  constexpr double depth = 5e-4;


  ContactParameters
  rough_parameters(const bool is_reversed = false)
  {
    ContactParameters parameters = contact_parameters(normal_spring, 0.1);
    coulomb(parameters).shear_stiffness = shear_spring;
    coulomb(parameters).friction        = face_friction;
    if (is_reversed)
      parameters.slave_priority = {2, 1, 0};
    return parameters;
  }


  /// A motion through several displacements, each of which is accepted.
  using GivenField =
    std::function<Tensor<1, 2>(const Point<2> &, bool is_upper)>;
  using AcceptedMotion = std::vector<GivenField>;


  /// A contact of bodies whose displacements are given.
  class GivenMotion
  {
  public:
    /// @p upper_is_slave: that block carries all points; otherwise @p parameters decide.
    GivenMotion(Geometry                 geometry,
                const Bodies::Options   &options,
                const ContactParameters &parameters,
                const bool               upper_is_slave = false)
      : bodies(std::move(geometry), options)
      , contact(bodies.surface,
                bodies.constraints,
                upper_is_slave ? with_upper_first(parameters) : parameters)
    {
    }

    unsigned int
    upper() const
    {
      return bodies.mesh.block(bodies.mesh.find_element(in_upper));
    }

    ContactParameters
    with_upper_first(ContactParameters parameters) const
    {
      parameters.slave_priority.assign(bodies.physical_mesh.n_blocks(), 1);
      parameters.slave_priority[upper()] = 0;
      return parameters;
    }

    Vector
    displacements(const GivenField &field)
    {
      return bodies.interpolate(
        [&](const Point<2> &X, const unsigned int block) {
          return field(X, block == upper());
        });
    }

    void
    assemble(const GivenField &field)
    {
      const Vector u = displacements(field);
      contact.detect(u);
      contact.assemble(u, false);
    }

    void
    follow(const AcceptedMotion &motion)
    {
      for (const GivenField &field : motion)
      {
        assemble(field);
        contact.accept();
      }
    }

    /// Closed points of faces other than those of a new crack, which touch without pressure.
    std::vector<ContactPoint>
    closed_points() const
    {
      std::vector<ContactPoint> result;
      for (const ContactPoint &point : contact.points())
        if (point.weight > 0. && point.state != ContactState::open &&
            bodies.surface.name(point.edge) != "crack")
          result.push_back(point);
      return result;
    }

    /// A point of the block that moves in another way than the others.
    Point<2> in_upper = {0.5, 0.8};
    Bodies   bodies;
    Contact  contact;
  };


  /// A box on a longer one; their common side is at y = 0.5.
  Geometry
  box_on_box()
  {
    Geometry geometry;
    add_named_box(geometry, "lower ", {0., 0.}, {2., 0.5});
    add_named_box(geometry, "upper ", {0.4, 0.5}, {1.4, 1.});
    return geometry;
  }


  /// The upper box is pressed on the lower one, slides, and is unloaded, so that it sticks at half of
  /// its strength. The strain is the same in both. Anchors are then about 0.3 away from the points
  /// in the reference configuration.
  AcceptedMotion
  slide_and_stick()
  {
    const auto to = [](const double way) {
      return [=](const Point<2> &X, const bool is_upper) {
        Tensor<1, 2> u({0.01 * X[0] + 0.02 * X[1], -0.01 * X[1]});
        if (is_upper)
          u += Tensor<1, 2>({way, -depth});
        return u;
      };
    };
    AcceptedMotion result;
    for (unsigned int i = 0; i <= 6; ++i)
      result.push_back(to(0.05 * i));
    result.push_back(
      to(0.3 - 1.5 * face_friction * normal_spring / shear_spring * depth));
    return result;
  }


  Bodies::Options
  options_of(const unsigned int degree, const double cell_size)
  {
    Bodies::Options options;
    options.degree              = degree;
    options.cell_size           = cell_size;
    options.rotation            = 13.;
    options.mesh_of_every_block = true;
    return options;
  }


  /// The shear of all points, which must be that of the first one.
  double
  uniform_shear(const GivenMotion &motion)
  {
    const auto points = motion.closed_points();
    EXPECT_GT(points.size(), 20U);
    for (const ContactPoint &point : points)
    {
      EXPECT_NEAR(point.shear,
                  points.front().shear,
                  1e-10 * std::abs(points.front().shear))
        << point.x;
      EXPECT_EQ(point.state, ContactState::stick);
    }
    return points.empty() ? 0. : points.front().shear;
  }


  /// Shear that is uniform before is the same after the cut, also in the motion that follows.
  void
  expect_same_shear(const AcceptedMotion &motion,
                    GivenMotion          &before,
                    GivenMotion          &after,
                    const double          expected)
  {
    before.follow(motion);
    const double shear = uniform_shear(before);
    EXPECT_NEAR(std::abs(shear), expected, 1e-6 * expected);
    after.contact.restore_history(
      carry_history(before.contact.history(),
                    before.bodies.surface,
                    after.bodies.surface,
                    after.contact.parameters().slave_priority));
    for (unsigned int i = 0; i < 2; ++i)
    {
      after.follow({motion.back()});
      EXPECT_NEAR(uniform_shear(after), shear, 1e-10 * std::abs(shear));
    }
  }


  // Places along edges are divided on both sides, and the slave may become the master.
  TEST(CarriedHistory, UniformShearOnARefinedMesh)
  {
    for (const unsigned int degree : {1U, 2U})
      for (const bool was_reversed : {false, true})
        for (const bool is_reversed : {false, true})
          for (const double size : {0.11, 0.2, 0.22, 0.37})
          {
            SCOPED_TRACE(size);
            SCOPED_TRACE(was_reversed);
            SCOPED_TRACE(is_reversed);
            GivenMotion before(box_on_box(),
                               options_of(degree, 0.22),
                               rough_parameters(was_reversed));
            GivenMotion after(box_on_box(),
                              options_of(degree, size),
                              rough_parameters(is_reversed));
            expect_same_shear(slide_and_stick(),
                              before,
                              after,
                              0.5 * face_friction * normal_spring * depth);
          }
  }


  // A joint through the lower box divides a block, and new corners are contact points.
  TEST(CarriedHistory, UniformShearAboveANewCrack)
  {
    for (const unsigned int degree : {1U, 2U})
      for (const bool is_reversed : {false, true})
      {
        const ContactParameters parameters = rough_parameters(is_reversed);
        GivenMotion before(box_on_box(), options_of(degree, 0.22), parameters);
        Geometry    geometry = box_on_box();
        geometry.add_polyline({{1.03, 0.}, {1.13, 0.5}},
                              "crack",
                              CurveRole::joint,
                              JointState::open);
        GivenMotion after(std::move(geometry),
                          options_of(degree, 0.22),
                          parameters);
        ASSERT_EQ(after.bodies.physical_mesh.n_blocks(), 3U);
        expect_same_shear(slide_and_stick(),
                          before,
                          after,
                          0.5 * face_friction * normal_spring * depth);
      }
  }


  // A disk in a hole that it fills, turned and swollen.
  TEST(CarriedHistory, UniformShearAlongArcs)
  {
    constexpr double swelling = 1e-3, turn = 2e-4, radius = 0.5;
    const Point<2>   center(1., 1.);
    const auto       make = [&](const double size) {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {2., 2.});
      geometry.add_circle(center, radius, "disk", CurveRole::joint);
      auto result = std::make_unique<GivenMotion>(std::move(geometry),
                                                  options_of(2, size),
                                                  rough_parameters());
      result->in_upper = center;
      return result;
    };
    const auto to = [=](const double angle) {
      return [=](const Point<2> &X, const bool is_disk) {
        const Tensor<1, 2> d = X - center;
        return is_disk ? swelling * d + angle * Tensor<1, 2>({-d[1], d[0]})
                       : Tensor<1, 2>();
      };
    };
    for (const double size : {0.15, 0.3, 0.4})
    {
      const auto before = make(0.3), after = make(size);
      expect_same_shear({to(0.), to(turn)},
                        *before,
                        *after,
                        shear_spring * turn * radius);
    }
  }


  // A crack elsewhere: the joint keeps its history to the last bit, and the new faces have none.
  TEST(CarriedHistory, CrackElsewhere)
  {
    GivenMotion before(box_on_box(), options_of(2, 0.22), rough_parameters());
    before.follow(slide_and_stick());
    Geometry geometry = box_on_box();
    geometry.add_polyline({{0.9, 1.}, {0.95, 0.7}},
                          "crack",
                          CurveRole::joint,
                          JointState::open);
    GivenMotion           after(std::move(geometry),
                      options_of(2, 0.22),
                      rough_parameters());
    const ContactSurface &from = before.bodies.surface,
                         &to   = after.bodies.surface;
    ASSERT_GT(to.edges().size(), from.edges().size());
    const ContactHistory old     = before.contact.history();
    const ContactHistory carried = carry_history(old, from, to);
    ASSERT_GT(old.sticks.size(), 20U);
    ASSERT_EQ(carried.sticks.size(), old.sticks.size());
    const auto place = [](const ContactSurface &surface,
                          const unsigned int    edge,
                          const double          t) {
      return dealii::Point<2>(surface.reference_place(edge, t).x);
    };
    for (unsigned int i = 0; i < old.sticks.size(); ++i)
    {
      const auto &a = old.sticks[i], &b = carried.sticks[i];
      const auto  edge = b.place % to.edges().size();
      EXPECT_NE(to.name(edge), "crack");
      EXPECT_NE(to.name(b.edge), "crack");
      EXPECT_EQ(place(from, a.place % from.edges().size(), a.s),
                place(to, edge, b.s));
      EXPECT_EQ(place(from, a.edge, a.t), place(to, b.edge, b.t));
    }
    for (const auto &[edge, other] : carried.touching)
    {
      EXPECT_NE(to.name(edge), "crack");
      EXPECT_NE(to.name(other), "crack");
    }
    EXPECT_EQ(carried.touching.size(), old.touching.size());
    EXPECT_TRUE(carried.former_bodies.empty());
    after.contact.restore_history(carried);
    after.assemble(slide_and_stick().back());
    const double shear = before.closed_points().front().shear;
    EXPECT_NEAR(uniform_shear(after), shear, 1e-10 * std::abs(shear));
  }


  // A block is divided below a box that presses more on one side. In a step in which nothing moves,
  // all pressures are those before the cut, and no energy is lost.
  TEST(CarriedHistory, EnergiesOfADividedBlock)
  {
    constexpr double way    = 5e-5;
    const GivenField tilted = [](const Point<2> &X, const bool is_upper) {
      return is_upper ? Tensor<1, 2>({way, -1e-3 * (X[0] - 0.3)})
                      : Tensor<1, 2>();
    };
    const GivenField straight = [&](const Point<2> &X, const bool is_upper) {
      return is_upper ? Tensor<1, 2>({0., tilted(X, true)[1]}) : Tensor<1, 2>();
    };
    GivenMotion before(box_on_box(),
                       options_of(2, 0.22),
                       rough_parameters(),
                       true);
    before.follow({straight, tilted});
    const double energy   = before.contact.report().energy;
    Geometry     geometry = box_on_box();
    geometry.add_polyline({{0.7, 0.}, {0.7, 0.5}},
                          "crack",
                          CurveRole::joint,
                          JointState::open);
    GivenMotion after(std::move(geometry),
                      options_of(2, 0.22),
                      rough_parameters(),
                      true);
    for (const bool is_known : {true, false})
    {
      ContactHistory history =
        carry_history(before.contact.history(),
                      before.bodies.surface,
                      after.bodies.surface,
                      after.contact.parameters().slave_priority);
      EXPECT_EQ(history.pair_energies.size(), 2U);
      ASSERT_EQ(history.former_bodies.size(), 3U);
      if (!is_known)
      {
        history.former_bodies.clear();
        history.pair_energies.clear();
      }
      after.contact.restore_history(history);
      const Vector u = after.displacements(tilted);
      after.contact.detect(u);
      ContactTimeStep(after.contact).begin(u, 0.);
      ContactTimeStep(after.contact).assemble(u, 1e-3, false);
      double largest = 0., error = 0., shear_error = 0.;
      for (const ContactPoint &point : after.closed_points())
      {
        const double pressure = -normal_spring * point.gap;
        largest               = std::max(largest, point.pressure);
        error = std::max(error, std::abs(point.pressure - pressure));
        shear_error =
          std::max(shear_error,
                   std::abs(std::abs(point.shear) - shear_spring * way));
      }
      after.contact.assemble(u, false);
      const double lost = after.contact.accept();
      if (is_known)
      {
        EXPECT_GT(after.closed_points().size(), 20U);
        EXPECT_GT(largest, 100.);
        EXPECT_LE(error, 1e-6 * largest);
        // The new corner measures its way along the tilted face, by 1e-3 of its depth more.
        EXPECT_LE(shear_error, 1e-2 * shear_spring * way);
        EXPECT_NEAR(lost, 0., 1e-3 * energy);
      }
      else
        // Without energies there is no force left: that is what former_bodies is for.
        EXPECT_EQ(largest, 0.);
    }
  }


  /// A box that slides on another one, which lies on an obstacle.
  std::unique_ptr<ContactBars::MovingBodies>
  moving_boxes()
  {
    Bodies::Options options = options_of(2, 0.22);
    options.obstacles       = {obstacle("floor", {{4., 0.}, {-2., 0.}})};
    auto result =
      std::make_unique<ContactBars::MovingBodies>(box_on_box(), options);
    result->problem.materials = {material("rock", 1e5, 0.2, 1000.)};
    result->problem.gravity   = Tensor<1, 2>({0., -10.});
    result->start(rough_parameters(), Kinematics::small);
    return result;
  }


  // The same surface gets the same history, and the motion goes on in the same way.
  TEST(CarriedHistory, SameSurfaceMPI)
  {
    constexpr double h      = 1e-3;
    const auto       scheme = TimeScheme::energy_momentum();
    auto             bodies = moving_boxes();
    bodies->integrate(scheme,
                      bodies->zero(),
                      bodies->values([](const Point<2> &X, unsigned int) {
                        return Tensor<1, 2>({X[1] > 0.5 ? 0.4 : 0., 0.});
                      }));
    EXPECT_EQ(bodies->run(h, 20. * h).failure, "");
    EXPECT_GT(bodies->contact->report().n_stick, 0U);
    EXPECT_GT(bodies->contact->report().n_slip, 0U);

    const auto           again = moving_boxes();
    const ContactHistory old   = bodies->contact->history();
    const ContactHistory carried =
      carry_history(old, bodies->surface, again->surface);
    ASSERT_GT(old.sticks.size(), 40U);
    ASSERT_EQ(carried.sticks.size(), old.sticks.size());
    for (unsigned int i = 0; i < old.sticks.size(); ++i)
    {
      const auto &a = old.sticks[i], &b = carried.sticks[i];
      EXPECT_EQ(a.place, b.place);
      EXPECT_EQ(a.s, b.s);
      EXPECT_EQ(a.edge, b.edge);
      EXPECT_EQ(a.t, b.t);
      EXPECT_EQ(a.is_bonded, b.is_bonded);
      EXPECT_EQ(a.slip, b.slip);
    }
    EXPECT_EQ(carried.has_accepted_state, old.has_accepted_state);
    EXPECT_EQ(carried.is_conserving, old.is_conserving);
    EXPECT_EQ(carried.entrances, old.entrances);
    EXPECT_EQ(carried.touching, old.touching);
    EXPECT_FALSE(old.touching.empty());
    ASSERT_EQ(carried.pair_energies.size(), old.pair_energies.size());
    for (unsigned int i = 0; i < old.pair_energies.size(); ++i)
    {
      EXPECT_EQ(carried.pair_energies[i].first, old.pair_energies[i].first);
      EXPECT_EQ(carried.pair_energies[i].second, old.pair_energies[i].second);
      EXPECT_EQ(carried.pair_energies[i].energies,
                old.pair_energies[i].energies);
    }
    EXPECT_TRUE(carried.former_bodies.empty());
    EXPECT_TRUE(carried.multipliers.empty());
    EXPECT_TRUE(carried.searched_displacements.empty());

    Vector results[2];
    for (const bool is_carried : {false, true})
    {
      const auto next = moving_boxes();
      next->contact->restore_history(is_carried ? carried : old);
      next->integrate(scheme,
                      bodies->integrator->state().u,
                      bodies->integrator->state().v);
      EXPECT_EQ(next->run(h, 3. * h).failure, "");
      results[is_carried] = next->integrator->state().u;
    }
    double moved = 0.;
    for (const auto i : results[0].locally_owned_elements())
    {
      EXPECT_EQ(results[0](i), results[1](i));
      moved =
        std::max(moved,
                 std::abs(results[0](i) - bodies->integrator->state().u(i)));
    }
    EXPECT_GT(moved, 0.);
  }


  TEST(CarriedHistory, OtherObstaclesAreRefused)
  {
    Bodies::Options options = options_of(1, 0.4);
    Bodies          without(box_on_box(), options);
    options.obstacles = {obstacle("floor", {{4., 0.}, {-2., 0.}})};
    Bodies with(box_on_box(), options);
    EXPECT_THROW(carry_history(ContactHistory(), without.surface, with.surface),
                 InputError);
  }
} // namespace
