// Contact points that are clear of everything do not touch at the end of the step, and leaving them
// out changes no bit of the result.

#include <cmath>
#include <contact/contact_search.h>
#include <contact/random_polygons.h>
#include <contact/step_clearances.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using internal::ContactProjection;
  using internal::ContactSearch;
  using internal::StepClearances;
  using Place = ContactSurface::Place;

  /// Some way from one state to another one, of which most touches nothing else: blocks
  /// are moved, turned and sheared, and all are bent.
  std::vector<double>
  move_on(const Bodies              &bodies,
          const std::vector<double> &begin,
          const double               way,
          const double               bend,
          std::mt19937              &generator)
  {
    std::uniform_real_distribution<double> random(-1., 1.);
    const unsigned int        n_blocks = bodies.physical_mesh.n_blocks();
    std::vector<Tensor<1, 2>> shift(n_blocks);
    std::vector<Tensor<2, 2>> gradient(n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (unsigned int i = 0; i < 2; ++i)
      {
        shift[b][i] = way * random(generator);
        for (unsigned int j = 0; j < 2; ++j)
          gradient[b][i][j] = 8. * way * random(generator);
      }
    std::vector<double> end = begin;
    for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
      for (const unsigned int cover : bodies.covers.covers(e))
      {
        const unsigned int b = bodies.mesh.block(e);
        const Point<2>     X = bodies.covers.node(cover);
        const Tensor<1, 2> u = shift[b] +
                               gradient[b] * (X - Point<2>(0.8, 0.8)) +
                               Point<2>(bend * X[0] * X[1], bend * X[0] * X[0]);
        for (unsigned int c = 0; c < 2; ++c)
          end[2 * cover + c] = begin[2 * cover + c] + u[c];
      }
    return end;
  }


  /// Points of edges and corners, as Contact asks for them.
  struct Query
  {
    unsigned int position, edge;
    double       s, slack;
    unsigned int home;
    double       clearance;
  };


  TEST(StepClearances, ClearPointsDoNotTouch)
  {
    constexpr double reach   = 0.2;
    unsigned int     n_clear = 0, n_near = 0, n_new = 0;
    for (unsigned int seed = 0; seed < 100; ++seed)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937 generator(seed);
      Bodies       bodies =
        random_bodies(generator, seed, seed % 4 == 0 ? 0.25 : 1.5);
      auto                     &surface = bodies.surface;
      ContactSearch             search(surface, {});
      const std::vector<double> begin =
        move_on(bodies,
                move(bodies, random_motions(bodies, generator)),
                0.,
                seed % 4 < 2 ? 0.3 : 0.,
                generator);
      surface.set_displacements(&begin);
      search.update(reach);
      std::vector<Query> queries;
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
      {
        const unsigned int edge      = search.slaves()[i];
        const bool         is_corner = search.corner(i) != 2;
        for (const double s : {0., 0.1, 0.5, 0.9, 1.})
          for (const unsigned int home : search.masters(i))
          {
            Query q{i, edge, s, 0.1, home, 0.};
            if (is_corner)
              q = {i,
                   edge,
                   double(search.corner(i)),
                   internal::CornerRules::beyond_rounding,
                   ContactSearch::any_edge,
                   0.};
            q.clearance = search.clearance(surface.place(edge, q.s).x,
                                           search.masters(i),
                                           q.slack,
                                           q.home);
            queries.push_back(q);
          }
      }
      const auto touches = [&](const Query &q) {
        const Place             place = surface.place(q.edge, q.s);
        const ContactProjection found =
          search.corner(q.position) == 2
            ? search.project(place, search.masters(q.position), q.slack, q.home)
            : search.project_corner(place,
                                    Tensor<1, 2>(),
                                    search.masters(q.position),
                                    invalid_index);
        return found.master != invalid_index && found.gap < 0.;
      };
      std::vector<bool>         touched;
      std::vector<double>       clearances;
      std::vector<unsigned int> point_to_body;
      for (const Query &q : queries)
      {
        touched.push_back(touches(q));
        EXPECT_TRUE(!touched.back() || q.clearance == 0.);
        clearances.push_back(q.clearance);
        point_to_body.push_back(surface.edges()[q.edge].body);
      }
      StepClearances step;
      step.begin(surface, search, clearances, point_to_body, reach);

      for (const double way : {0.001, 0.01, 0.03})
      {
        std::vector<double> end = move_on(bodies, begin, way, way, generator);
        std::vector<double> middle(end);
        for (unsigned int i = 0; i < middle.size(); ++i)
          middle[i] = 0.5 * (begin[i] + end[i]);
        surface.set_displacements(&end);
        step.note_motion();
        std::vector<bool> is_clear;
        for (unsigned int i = 0; i < queries.size(); ++i)
        {
          is_clear.push_back(step.is_clear(i));
          n_clear += is_clear.back();
          n_near += !is_clear.back();
        }
        for (const auto *state : {&end, &middle})
        {
          surface.set_displacements(state);
          for (unsigned int i = 0; i < queries.size(); ++i)
          {
            const bool now = touches(queries[i]);
            EXPECT_FALSE(now && is_clear[i])
              << "edge " << queries[i].edge << " at " << queries[i].s;
            n_new += now && !touched[i];
          }
        }
      }
    }
    std::cout << n_clear << " points are clear, " << n_near
              << " are not, of which " << n_new << " come to touch"
              << std::endl;
    EXPECT_GT(n_clear, n_near / 10);
    EXPECT_GT(n_new, 100U);
  }


  /// Of a step, at several ends of which each moves some blocks on.
  struct Sequence
  {
    std::vector<double>              begin;
    std::vector<std::vector<double>> ends;
    std::vector<std::vector<bool>>   active;
    std::vector<bool>                with_tangent;
  };


  Sequence
  random_sequence(Bodies &bodies, std::mt19937 &generator)
  {
    constexpr double way      = 0.02;
    const unsigned   n_blocks = bodies.physical_mesh.n_blocks();
    Sequence         result;
    result.begin            = move_on(bodies,
                           move(bodies, random_motions(bodies, generator)),
                           0.,
                           0.,
                           generator);
    std::vector<double> end = result.begin;
    for (unsigned int k = 0; k < 20; ++k)
    {
      const auto moved = move_on(bodies, result.begin, way, 0., generator);
      // nothing moves before a tangent, mostly, as in Newton's method
      result.with_tangent.push_back(k % 2 == 1);
      std::vector<bool> moves(n_blocks), is_active(n_blocks);
      for (unsigned int b = 0; b < n_blocks; ++b)
      {
        moves[b]     = generator() % (k % 2 == 1 ? 12 : 2) == 0;
        is_active[b] = moves[b] || generator() % 3 > 0;
      }
      for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
        if (moves[bodies.mesh.block(e)])
          for (const unsigned int cover : bodies.covers.covers(e))
            for (unsigned int c = 0; c < 2; ++c)
              end[2 * cover + c] = moved[2 * cover + c];
      result.ends.push_back(end);
      result.active.push_back(k < 2 ? std::vector<bool>() : is_active);
    }
    return result;
  }


  /// Forces, and what the tangent makes of a vector, at each of the ends. If @p is_expected,
  /// the end of the first tangent is announced beforehand.
  std::vector<Vector>
  forces(Bodies         &bodies,
         const Sequence &sequence,
         const bool      skip_clear_points,
         const bool      is_expected)
  {
    constexpr double  h          = 0.01;
    ContactParameters parameters = contact_parameters(1e8, 0.2);
    coulomb(parameters).friction = 0.3;
    parameters.skip_clear_points = skip_clear_points;
    bodies.start(parameters);
    Contact   &contact = *bodies.contact;
    const auto state   = [&](const std::vector<double> &nodal) {
      Vector owned(contact.residual());
      for (unsigned int i = 0; i < nodal.size(); ++i)
        owned.begin()[i] = nodal[i];
      return bodies.relevant(owned);
    };
    const Vector begin = state(sequence.begin);
    contact.detect(begin, 0.2);
    contact.begin_step(begin, 0.);
    contact.set_time(h);
    if (is_expected)
      contact.expect(state(sequence.ends[1]));
    std::vector<Vector> result;
    for (unsigned int k = 0; k < sequence.ends.size(); ++k)
    {
      contact.set_active_bodies(sequence.active[k], {});
      contact.assemble_between(state(sequence.ends[k]),
                               h,
                               sequence.with_tangent[k]);
      // rows of bodies that are not active are undefined
      const auto keep_active = [&](Vector &v) {
        for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
          if (!sequence.active[k].empty() &&
              !sequence.active[k][bodies.mesh.block(e)])
            for (const unsigned int cover : bodies.covers.covers(e))
              v.begin()[2 * cover] = v.begin()[2 * cover + 1] = 0.;
      };
      Vector residual(contact.residual());
      keep_active(residual);
      result.push_back(residual);
      if (sequence.with_tangent[k])
      {
        Vector product(residual);
        contact.tangent().vmult(product, residual);
        keep_active(product);
        result.push_back(product);
      }
    }
    return result;
  }


  // Only some blocks move from one assembly to the next. Forces and tangents are the same, bit by
  // bit, whether points that are clear are skipped or not.
  TEST(StepClearances, SkippingClearPointsChangesNothing)
  {
    unsigned int n_that_press = 0;
    for (unsigned int seed = 0; seed < 40; ++seed)
    {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937   generator(seed);
      std::mt19937   same(generator);
      const double   cell_size = seed % 4 == 0 ? 0.25 : 1.5;
      Bodies         bodies    = random_bodies(generator, seed, cell_size);
      Bodies         others    = random_bodies(same, seed, cell_size);
      const Sequence sequence  = random_sequence(bodies, generator);
      const auto     with      = forces(bodies, sequence, true, seed % 2 == 0);
      const auto     without   = forces(others, sequence, false, false);
      ASSERT_EQ(with.size(), without.size());
      for (unsigned int i = 0; i < with.size(); ++i)
      {
        Vector difference(with[i]);
        difference -= without[i];
        EXPECT_EQ(difference.l2_norm(), 0.) << i;
        n_that_press += with[i].l2_norm() > 0.;
      }
    }
    EXPECT_GT(n_that_press, 500U);
  }


  /// A column whose top turns about its middle, and the lower left corner of another
  /// block, which comes to be behind the top by that.
  void
  check_turn(const double    width,
             const Point<2> &corner,
             const double    angle,
             const double    reach,
             const double    expected_clearance)
  {
    Geometry geometry;
    add_named_box(geometry, "column ", {0., 0.}, {width, 1.});
    add_named_box(geometry, "other ", corner, corner + Point<2>(0.9, 0.9));
    Bodies::Options options;
    options.cell_size           = 5.;
    options.mesh_of_every_block = true;
    Bodies             bodies(std::move(geometry), options);
    auto              &surface = bodies.surface;
    const unsigned int column =
      bodies.mesh.block(bodies.mesh.find_element({0.5 * width, 0.5}));
    unsigned int top = invalid_index, bottom = invalid_index;
    for (unsigned int e = 0; e < surface.edges().size(); ++e)
      if (surface.name(e) == "column top")
        top = e;
      else if (surface.name(e) == "other bottom")
        bottom = e;
    const auto  &edge = surface.edges()[bottom];
    const double s    = edge.start[0] < edge.end[0] ? 0. : 1.;
    const dealii::ArrayView<const unsigned int> masters(&top, 1);
    const std::vector<double> nodal(2 * bodies.covers.n_covers(), 0.);
    surface.set_displacements(&nodal);
    ContactSearch search(surface, {});
    search.update(reach);
    const double clearance =
      search.clearance(surface.place(bottom, s).x, masters, 0., invalid_index);
    EXPECT_NEAR(clearance, expected_clearance, 1e-9);
    StepClearances step;
    step.begin(
      surface, search, {clearance}, {surface.edges()[bottom].body}, reach);
    EXPECT_TRUE(step.is_clear(0));

    std::vector<Motion> motions(2);
    motions[column].center = Point<2>(0.5 * width, 1.);
    motions[column].angle  = angle;
    const auto end         = move(bodies, motions);
    surface.set_displacements(&end);
    step.note_motion();
    const ContactProjection found =
      search.project(surface.place(bottom, s), masters, 0., invalid_index);
    ASSERT_EQ(found.master, top);
    EXPECT_LT(found.gap, 0.);
    EXPECT_FALSE(step.is_clear(0));
  }


  /// Above the end of a long face, which is lifted.
  TEST(StepClearances, LongFaceThatTurns)
  {
    constexpr double gap = 0.01;
    check_turn(2., Point<2>(1.9, 1. + gap), 2. * gap, 0.1, gap);
  }


  /// Beside a narrow column and far below its top: what turns by little moves there by
  /// more than anything on the face itself.
  TEST(StepClearances, ShortFaceThatTurns)
  {
    constexpr double depth = 0.4, beside = 0.02;
    check_turn(0.1,
               Point<2>(0.1 + beside, 1. - depth),
               1.5 * beside / depth,
               0.5,
               beside);
  }
} // namespace
