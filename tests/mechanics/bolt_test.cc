// Rock bolts: bars with a bond that yields, against closed forms, and their tangent. Values are
// those of Farmer's bar (Rock Mech. 1975) with a bond that yields, and of beams on an elastic
// foundation.

#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/mechanics/bolt_term.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <mechanics/placed_bolt.h>
#include <numeric>
#include <random>

using namespace NMM;
using namespace NMM::Test;
using internal::BoltBar;
using internal::PlacedBolt;

namespace
{
  constexpr double modulus = 98.6e9, area = 181e-6, bond = 11.2e6,
                   strength = 175e3;
  const double EA = modulus * area, alpha = std::sqrt(bond / EA),
               slip_at_yield = strength / bond;


  Bolt
  grouted(const std::vector<Point<2>> &path)
  {
    Bolt bolt;
    bolt.name           = "bolt";
    bolt.path           = path;
    bolt.youngs_modulus = modulus;
    bolt.area           = area;
    bolt.bond_stiffness = bond;
    bolt.bond_strength  = strength;
    return bolt;
  }


  /// A bar of the length L in rigid rock, whose head is drawn out.
  struct PullOut
  {
    explicit PullOut(const double L)
      : bar({EA, bond, strength}, elements(L), true, false)
      , state(bar.initial_state(0.))
    {
    }

    static std::vector<BoltBar::Element>
    elements(const double L)
    {
      std::vector<BoltBar::Element> result;
      const unsigned int            n = std::max(4., std::ceil(5. * alpha * L));
      for (unsigned int e = 0; e < n; ++e)
        result.push_back({e * L / n, (e + 1) * L / n, true});
      return result;
    }

    BoltBar::Response
    draw(const double u) const
    {
      std::vector<double> r(bar.sites().size(), 0.);
      r[0] = -u;
      return bar.respond(state, r, std::vector<bool>(r.size(), false));
    }

    /// The force of a displacement, in one step from rest.
    double
    force(const double u) const
    {
      return bar.axial_at_ends(draw(u))[0];
    }

    BoltBar        bar;
    BoltBar::State state;
  };


  // Elastic stiffness, force at first yield, with half of the bond slipped, and the limit. The
  // table has the values of `reference/practice.md`, V1, which a finite-element bar of 4000
  // elements confirms to 1e-8.
  TEST(Bolts, PullOutFromRigidRock)
  {
    struct Row
    {
      double L, stiffness, first_yield, half_force, half_mm, limit, limit_mm;
    };
    for (const Row &row : {Row{0.5,
                               5.32441578e6,
                               83193.9966,
                               86936.8297,
                               16.53640371,
                               87500.,
                               16.85072367},
                           Row{1.,
                               9.32610330e6,
                               145720.3640,
                               170693.9966,
                               19.18153168,
                               175000.,
                               20.52789467}})
    {
      const PullOut test(row.L);
      // discretization, and the tie with 1e-6 of the compliance
      constexpr double tolerance = 1e-4;
      EXPECT_NEAR(test.force(1e-3) / (1e-3 * row.stiffness), 1., tolerance);
      EXPECT_NEAR(test.force(slip_at_yield) / row.first_yield, 1., tolerance);
      EXPECT_NEAR(test.force(1e-3 * row.half_mm) / row.half_force,
                  1.,
                  tolerance);
      EXPECT_NEAR(test.force(1e-3 * row.limit_mm) / row.limit, 1., tolerance);
      // a millionth of the stiffness is left
      EXPECT_NEAR(test.force(0.1) / row.limit, 1., 1e-5);
    }
  }


  // After a slip of the whole bond the bar unloads elastically, and the account of energies closes.
  TEST(Bolts, UnloadsAndDissipates)
  {
    PullOut                 test(1.);
    double                  energy = 0., work = 0., dissipated = 0., u_0 = 0.;
    const BoltBar::Response at_rest = test.draw(0.);
    BoltBar::Response       before  = at_rest;
    for (const double u : {0.01, 0.017, 0.03, 0.025, 0.015})
    {
      const BoltBar::Response now = test.draw(u);
      work += 0.5 * (before.forces[0] + now.forces[0]) * -(u - u_0);
      dissipated += test.bar.dissipated(test.state, &before, now);
      test.state = now.next;
      before     = now;
      u_0        = u;
      energy     = now.energy;
    }
    EXPECT_NEAR(work, energy + dissipated, 1e-9 * work);
    EXPECT_GT(dissipated, 0.2 * work);
    const double slope = (test.force(0.015) - test.force(0.014)) / 1e-3;
    EXPECT_NEAR(slope / 9.32610330e6, 1., 1e-4);
  }


  /// Two blocks, of which the second one is moved, and the bolt between them. All of their
  /// boundaries have prescribed displacements, so that they are rigid.
  struct TwoBlocks
  {
    TwoBlocks(const std::vector<Bolt> &bolts,
              const Tensor<1, 2>      &motion,
              const double             left       = 3.,
              const double             right      = 3.,
              const double             cell_size  = 0.7,
              const Kinematics         kinematics = Kinematics::small)
      : model(geometry(left, right), mesh_parameters(cell_size, {}, 13.), 2)
    {
      model.problem.materials           = {material("rock", 1e14, 0.2)};
      model.problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "first"),
        condition(BoundaryCondition::Type::displacement,
                  "second",
                  vector_function([=](const Point<2> &) { return motion; }))};
      elasticity = std::make_unique<FiniteElasticity>(model.covers,
                                                      *model.quadrature,
                                                      model.constraints,
                                                      model.problem);
      solid      = make_solid_at_rest(*elasticity, kinematics);
      term       = std::make_unique<BoltTerm>(model.covers,
                                        solid->layout(),
                                        bolts,
                                        kinematics);
      statics    = std::make_unique<NonlinearStatics>(
        *solid, NewtonParameters(), std::vector<ForceTerm *>{term.get()});
    }

    static Geometry
    geometry(const double left, const double right)
    {
      Geometry result;
      result.add_polygon({{-left, 0.}, {0., 0.}, {0., 1.}, {-left, 1.}},
                         "first");
      result.add_polygon({{0., 0.}, {right, 0.}, {right, 1.}, {0., 1.}},
                         "second");
      return result;
    }

    BoltReport
    run(const std::vector<double> &load_factors = {1.})
    {
      LoadSteps steps;
      steps.load_factors = load_factors;
      statics->run(steps);
      return term->reports(statics->solution())[0];
    }

    Model                             model;
    std::unique_ptr<FiniteElasticity> elasticity;
    std::unique_ptr<SolidTerm>        solid;
    std::unique_ptr<BoltTerm>         term;
    std::unique_ptr<NonlinearStatics> statics;
  };


  Tensor<1, 2>
  vector(const double x, const double y)
  {
    return Tensor<1, 2>({x, y});
  }


  // Discretization of the bar; the rock gives by k / E < 1e-6 of the motion.
  constexpr double rigid = 1e-4;


  // Finite embedments are springs in series.
  TEST(Bolts, OpeningJointMPI)
  {
    for (const auto &[left, right, expected] :
         {std::array<double, 3>{{0.5, 2., 3.77706231e6}},
          std::array<double, 3>{{1., 1., 4.66305165e6}}})
      for (const double cell_size : {0.7, 0.41})
      {
        constexpr double opening = 2e-3;
        TwoBlocks        test({grouted({{-left, 0.43}, {right, 0.43}})},
                       vector(opening, 0.),
                       3.,
                       3.,
                       cell_size);
        const BoltReport report = test.run();
        ASSERT_EQ(report.crossings.size(), 1u);
        EXPECT_NEAR(report.crossings[0].opening, opening, rigid * opening);
        EXPECT_NEAR(report.crossings[0].force / (expected * opening),
                    1.,
                    rigid);
        EXPECT_EQ(report.largest_force, report.crossings[0].force);
        EXPECT_EQ(report.slipped_length, 0.);
      }
  }


  // A long bolt on both sides, before and after the bond slips.
  TEST(Bolts, OpeningJointThatSlips)
  {
    TwoBlocks test(
      {grouted({{-9.8, 0.43}, {9.9, 0.43}})}, vector(0.1, 0.), 10., 10., 1.3);
    test.run({0.1});
    const auto force = [&](const double load_factor) {
      return test.run({load_factor}).crossings[0].force;
    };
    EXPECT_NEAR(test.run({0.2}).crossings[0].force / (7.06898012e6 * 0.02),
                1.,
                rigid);
    EXPECT_NEAR(force(0.3125) / 220905.6289, 1., rigid);
    // the end of the bond that slips lies within an element
    EXPECT_NEAR(force(0.4) / 275911.0421, 1., 3e-4);
    const BoltReport last = test.run({1.});
    EXPECT_NEAR(last.crossings[0].force / 513338.2931, 1., rigid);
    // over a = F / s - 1 / alpha on each side
    EXPECT_NEAR(last.slipped_length,
                2. * (513338.2931 / strength - 1. / alpha),
                0.1);
  }


  // Steel that yields at a joint, and an end-anchored bar that breaks.
  TEST(Bolts, SteelYieldsAndBreaks)
  {
    Bolt bolt           = grouted({{-2., 0.43}, {2., 0.43}});
    bolt.yield_force    = 1e5;
    bolt.rupture_strain = 0.1;
    TwoBlocks  test({bolt}, vector(0.1, 0.));
    BoltReport report = test.run({0.1, 0.25});
    EXPECT_NEAR(report.crossings[0].force, 1e5, 10.);
    EXPECT_GT(report.yielded_length, 0.);
    EXPECT_EQ(report.n_breaks, 0u);
    // ten diameters are 0.1518 m, so that it breaks at an opening of about 15 mm plus what the rest
    // gives
    report = test.run({0.5, 0.51});
    EXPECT_EQ(report.n_breaks, 1u);
    // the bond of the short element that is broken
    EXPECT_NEAR(report.crossings[0].force, 0., 1e-4 * 1e5);

    Bolt anchor           = bolt;
    anchor.type           = Bolt::Type::end_anchored;
    anchor.bond_stiffness = 0.;
    TwoBlocks anchored({anchor}, vector(0.5, 0.));
    report = anchored.run({0.01});
    EXPECT_NEAR(report.largest_force / (EA * 0.005 / 4.), 1., rigid);
    report = anchored.run({0.1, 0.7});
    EXPECT_NEAR(report.largest_force, 1e5, 10.);
    EXPECT_NEAR(report.yielded_length, 4., 1e-9);
    EXPECT_EQ(report.n_breaks, 0u);
    report = anchored.run({0.85, 0.86});
    EXPECT_EQ(report.n_breaks, 1u);
    EXPECT_NEAR(report.largest_force, 0., 1e-3);
  }


  // V = E I beta^3 d, and the largest moment, for both foundations.
  TEST(Bolts, Dowel)
  {
    for (const auto &[bedding, stiffness, moment] :
         {std::array<double, 3>{{1e9, 1.56456996e7, 3.156755e5}},
          std::array<double, 3>{{1e10, 8.79822347e7, 9.982536e5}}})
      for (const bool is_given : {false, true})
      {
        constexpr double slip = 1e-3, spacing = 2.;
        Bolt             bolt = grouted({{-2., 0.43}, {2., 0.43}});
        bolt.youngs_modulus   = 200e9;
        bolt.area             = 0.25 * dealii::numbers::PI * 0.025 * 0.025;
        bolt.spacing          = spacing;
        if (is_given)
          bolt.dowel_stiffness = stiffness;
        else
          bolt.bedding_stiffness = bedding;
        TwoBlocks        test({bolt}, vector(0., slip));
        const BoltReport report = test.run();
        EXPECT_NEAR(report.crossings[0].slip, slip, rigid * slip);
        EXPECT_NEAR(report.crossings[0].dowel_force / (stiffness * slip),
                    1.,
                    rigid);
        EXPECT_NEAR(report.crossings[0].moment / (moment * slip), 1., rigid);
        EXPECT_NEAR(report.crossings[0].force, 0., 1e-3 * stiffness * slip);
      }
  }


  // A pretension is there before anything moves, and what moves later is added. Along a free length
  // it is constant, along the bond it decays.
  TEST(Bolts, Pretension)
  {
    Bolt bolt           = grouted({{-2., 0.43}, {2., 0.43}});
    bolt.faceplate      = true;
    bolt.grouted_length = 2.;
    bolt.pretension     = 5e4;
    bolt.spacing        = 1.25;
    TwoBlocks  test({bolt}, vector(1e-3, 0.));
    BoltReport report = test.run({1e-9});
    EXPECT_NEAR(report.places.front().force, 5e4, 1e-3 * 5e4);
    EXPECT_NEAR(report.crossings[0].force, 5e4, 1e-3 * 5e4);
    EXPECT_NEAR(report.places.back().force, 0., 1.);
    report = test.run({1.});
    const double stiffness =
      1. / (2. / EA + 1. / (EA * alpha * std::tanh(2. * alpha)));
    EXPECT_NEAR(report.crossings[0].force, 5e4 + 1e-3 * stiffness, 10.);

    bolt.pretension = 1.1 * 2. * strength;
    EXPECT_THROW(TwoBlocks({bolt}, vector(0., 0.)), InputError);
    bolt.pretension = 1e4;
    bolt.faceplate  = false;
    EXPECT_THROW(TwoBlocks({bolt}, vector(0., 0.)), InputError);
  }


  // A bolt that is installed later has no force, and is drawn by what moves afterwards.
  TEST(Bolts, InstalledLater)
  {
    Bolt bolt         = grouted({{-1., 0.43}, {1., 0.43}});
    bolt.installed_at = 0.5;
    TwoBlocks  test({bolt}, vector(2e-3, 0.));
    BoltReport report = test.run({0.25, 0.5});
    EXPECT_FALSE(report.is_installed);
    EXPECT_EQ(report.largest_force, 0.);
    report = test.run({1.});
    EXPECT_TRUE(report.is_installed);
    EXPECT_NEAR(report.crossings[0].force / (4.66305165e6 * 1e-3), 1., rigid);
    // a run that begins anew has no bolt at first
    EXPECT_EQ(test.run({0.5}).largest_force, 0.);
  }


  TEST(Bolts, WrongInputIsRefused)
  {
    const Bolt good = grouted({{-1., 0.43}, {1., 0.43}});
    const auto make = [&](const Bolt &bolt) {
      TwoBlocks({bolt}, vector(0., 0.));
    };
    EXPECT_NO_THROW(make(good));
    for (const Point<2> &outside :
         {Point<2>(-4., 0.43), Point<2>(-1., 1.2), Point<2>(-1., -0.1)})
    {
      Bolt bolt    = good;
      bolt.path[0] = outside;
      EXPECT_THROW(make(bolt), InputError);
      std::swap(bolt.path[0], bolt.path[1]);
      EXPECT_THROW(make(bolt), InputError);
    }
    Bolt bolt = good;
    bolt.path.pop_back();
    EXPECT_THROW(make(bolt), InputError);
    bolt      = good;
    bolt.area = 0.;
    EXPECT_THROW(make(bolt), InputError);
    bolt                = good;
    bolt.bond_stiffness = 0.;
    EXPECT_THROW(make(bolt), InputError);
    bolt      = good;
    bolt.type = Bolt::Type::end_anchored;
    EXPECT_THROW(make(bolt), InputError);
  }


  // The state goes through an archive.
  TEST(Bolts, StateIsSaved)
  {
    const Bolt bolt = grouted({{-1., 0.43}, {1., 0.43}});
    TwoBlocks  test({bolt}, vector(0.06, 0.));
    test.run({1.});
    ByteWriter written;
    test.term->save(written);
    TwoBlocks  other({bolt}, vector(0.06, 0.));
    ByteReader reader(written.written);
    other.term->restore(reader);
    EXPECT_EQ(reader.n_left(), 0u);
    const BoltReport a = test.term->reports(test.statics->solution())[0],
                     b = other.term->reports(test.statics->solution())[0];
    EXPECT_GT(a.slipped_length, 0.);
    EXPECT_EQ(a.largest_force, b.largest_force);
    std::vector<char> shorter(written.written.begin(),
                              written.written.end() - 1);
    ByteReader        damaged(shorter);
    EXPECT_THROW(other.term->restore(damaged), InputError);
  }


  /// Three blocks with a bolt around a corner, at displacements that open and shear both joints.
  struct ThreeBlocks
  {
    explicit ThreeBlocks(const Kinematics kinematics)
      : model(geometry(), mesh_parameters(0.9, {}, 13.), 2)
      , generator(4)
    {
      model.problem.materials = {material("rock", 1e10, 0.2)};
      elasticity              = std::make_unique<FiniteElasticity>(model.covers,
                                                      *model.quadrature,
                                                      model.constraints,
                                                      model.problem,
                                                      /* may_float = */ true);
      solid                   = make_solid_at_rest(*elasticity, kinematics);
      Bolt bolt               = grouted({{0.3, 0.2}, {1.2, 0.6}, {2.9, 0.5}});
      bolt.bedding_stiffness  = 1e9;
      bolt.faceplate          = true;
      bolt.yield_force        = 6e5;
      bolt.pretension         = 1e4;
      placed                  = std::make_unique<PlacedBolt>(model.covers,
                                            solid->layout(),
                                            bolt,
                                            kinematics);
      placed->begin(placed->displacements(zero()));
    }

    static Geometry
    geometry()
    {
      Geometry result;
      for (const double x : {0., 1., 2.})
        result.add_polygon({{x, 0.}, {x + 1., 0.}, {x + 1., 1.}, {x, 1.}},
                           "block");
      return result;
    }

    ForceTerm::Vector
    zero() const
    {
      return ForceTerm::Vector(solid->layout().locally_owned,
                               solid->layout().communicator);
    }

    ForceTerm::Vector
    random(const double size)
    {
      std::uniform_real_distribution<double> number(-size, size);
      ForceTerm::Vector                      u = zero();
      for (const auto unknown : placed->unknowns())
        u(unknown) = number(generator);
      u.compress(dealii::VectorOperation::insert);
      return u;
    }

    Model                             model;
    std::mt19937                      generator;
    std::unique_ptr<FiniteElasticity> elasticity;
    std::unique_ptr<SolidTerm>        solid;
    std::unique_ptr<PlacedBolt>       placed;
  };


  // Forces are the derivative of the energy as long as nothing yields, and the tangent that of
  // forces, also where bond and steel yield, and for conserving forces.
  TEST(Bolts, TangentIsTheDerivative)
  {
    unsigned int n_samples = 0;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
      for (const double size : {1e-3, 3e-2})
        for (const bool is_conserving : {false, true})
        {
          ThreeBlocks             test(kinematics);
          const ForceTerm::Vector u = test.random(size);
          const auto  begin = test.placed->displacements(test.random(size));
          const auto *from  = is_conserving ? &begin : nullptr;
          const auto  at    = [&](const ForceTerm::Vector &end) {
            return test.placed->assemble(test.placed->displacements(end),
                                         from,
                                         true);
          };
          const PlacedBolt::Forces here = at(u);
          const double scale = here.tangent.linfty_norm(), h = 1e-6 * size;
          for (unsigned int i = 0; i < test.placed->unknowns().size(); ++i)
          {
            ForceTerm::Vector more(u), less(u);
            more(test.placed->unknowns()[i]) += h;
            less(test.placed->unknowns()[i]) -= h;
            more.compress(dealii::VectorOperation::add);
            less.compress(dealii::VectorOperation::add);
            const PlacedBolt::Forces a = at(more), b = at(less);
            const double             by_mean = is_conserving ? 2. : 1.;
            for (unsigned int k = 0; k < here.forces.size(); ++k)
              // rounding of forces over h, and the odd point that yields between both
              EXPECT_NEAR(by_mean * (a.forces[k] - b.forces[k]) / (2. * h),
                          here.tangent(k, i),
                          1e-5 * scale);
            if (!is_conserving && size < 1e-2)
            {
              EXPECT_NEAR((a.energy - b.energy) / (2. * h),
                          here.forces[i],
                          1e-6 * here.forces.linfty_norm());
            }
            ++n_samples;
          }
        }
    EXPECT_GT(n_samples, 400u);
  }


  // Turned and moved as a whole, a bolt exerts the forces of its pretension only, turned as well.
  TEST(Bolts, TurnsWithTheRock)
  {
    ThreeBlocks test(Kinematics::finite);
    const auto  move = [&](const double angle) {
      const double                c = std::cos(angle), s = std::sin(angle);
      const ForceTerm::Vector     zero = test.zero();
      PlacedBolt::Displacements   u    = test.placed->displacements(zero);
      const std::vector<Point<2>> x    = test.placed->places_of_stations();
      for (unsigned int i = 0; i < u.size(); ++i)
        u[i] = vector((c - 1.) * x[i][0] - s * x[i][1] + 3.,
                      s * x[i][0] + (c - 1.) * x[i][1] - 2.);
      return test.placed->assemble(u, nullptr, false);
    };
    const PlacedBolt::Forces a = move(0.), b = move(2.);
    EXPECT_NEAR(a.energy, b.energy, 1e-9 * a.energy);
    for (unsigned int k = 0; k < a.forces.size(); k += 2)
    {
      const double c = std::cos(2.), s = std::sin(2.),
                   scale = a.forces.linfty_norm();
      EXPECT_NEAR(b.forces[k],
                  c * a.forces[k] - s * a.forces[k + 1],
                  1e-8 * scale);
      EXPECT_NEAR(b.forces[k + 1],
                  s * a.forces[k] + c * a.forces[k + 1],
                  1e-8 * scale);
    }
  }
} // namespace
