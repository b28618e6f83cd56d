// Detection against brute force.

#include <nmm/contact/assembly/time_step.h>

#include <contact/contact_model.h>
#include <contact/detection/narrow_phase.h>
#include <contact/random_polygons.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using internal::ContactProjection;
  using internal::ContactSearch;
  using internal::NarrowPhase;
  using Place = ContactSurface::Place;


  /// Corners of a straight-sided block in its current position, in order.
  std::vector<Point<2>>
  current_outline(const ContactSurface &surface, const unsigned int body)
  {
    std::vector<Point<2>> outline;
    const auto           &edges = surface.edges();
    unsigned int          first = 0;
    while (edges[first].body != body)
      ++first;
    unsigned int e = first;
    do
    {
      outline.push_back(surface.place(e, 0.).x);
      e = edges[e].next;
    } while (e != first);
    return outline;
  }


  bool
  is_inside(const std::vector<Point<2>> &outline, const Point<2> &x)
  {
    bool result = false;
    for (unsigned int i = 0; i < outline.size(); ++i)
    {
      const Point<2> &a = outline[i], &b = outline[(i + 1) % outline.size()];
      if ((a[1] > x[1]) != (b[1] > x[1]) &&
          x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
        result = !result;
    }
    return result;
  }


  /// What brute force says of one edge: straight, and found by its two ends alone.
  struct Reference
  {
    unsigned int edge   = invalid_index;
    double       gap    = 0.;
    double       facing = 0.;
  };


  /// All edges of other bodies that face a point within the reach, at places
  /// inside of them; @p is_doubtful where rounding decides.
  std::vector<Reference>
  brute_force(const ContactSurface                     &surface,
              const std::vector<std::vector<Point<2>>> &outlines,
              const unsigned int                        slave,
              const Place                              &place,
              const double                              reach,
              const ContactSearch                      &search,
              bool                                     &is_doubtful)
  {
    constexpr double       rounding = 1e-7;
    std::vector<Reference> result;
    is_doubtful = false;
    for (unsigned int m = 0; m < surface.edges().size(); ++m)
    {
      if (surface.edges()[m].body == surface.edges()[slave].body ||
          !search.comes_first(slave, m))
        continue;
      const Point<2>     a = surface.place(m, 0.).x, b = surface.place(m, 1.).x;
      const Tensor<1, 2> d      = b - a;
      const double       length = d.norm();
      const Tensor<1, 2> normal({d[1] / length, -d[0] / length});
      const double       t       = ((place.x - a) * d) / (length * length);
      const double       gap     = (place.x - a) * normal;
      const double       facing  = -(normal * place.normal());
      const bool         is_near = t > -0.5 - rounding && t < 1.5 + rounding &&
                           std::abs(gap) < reach + rounding;
      if (is_near &&
          (std::abs(t) < rounding || std::abs(t - 1.) < rounding ||
           std::abs(std::abs(gap) - reach) < rounding ||
           std::abs(gap) < rounding || std::abs(facing - 0.01) < rounding ||
           std::abs(facing + 0.5) < rounding))
        is_doubtful = true;
      if (t < 0. || t > 1. || std::abs(gap) > reach || facing <= 0.01)
        continue;
      // behind a face, but not in its body
      if (gap < 0. && !is_inside(outlines[surface.edges()[m].body], place.x))
        continue;
      result.push_back({m, gap, facing});
    }
    return result;
  }


  /// Compares a search with brute force, and counts.
  struct Comparison
  {
    const ContactSurface              &surface;
    const ContactSearch               &search;
    double                             reach;
    std::vector<std::vector<Point<2>>> outlines;
    std::vector<unsigned int>          slave_to_position;
    unsigned int n_found = 0, n_none = 0, n_entrance = 0, n_corners = 0;

    Comparison(const ContactSurface &surface,
               const ContactSearch  &search,
               const double          reach)
      : surface(surface)
      , search(search)
      , reach(reach)
    {
    }

    /// After the bodies have moved.
    void
    update()
    {
      outlines.clear();
      for (unsigned int b = 0; b < surface.n_bodies(); ++b)
        outlines.push_back(current_outline(surface, b));
      slave_to_position.assign(surface.edges().size(), invalid_index);
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        if (search.corner(i) == 2)
          slave_to_position[search.slaves()[i]] = i;
    }

    /// Edges of other bodies among the masters at a position.
    std::vector<unsigned int>
    masters_of(const unsigned int edge, const unsigned int position) const
    {
      std::vector<unsigned int> result;
      if (position != invalid_index)
        for (const unsigned int m : search.masters(position))
          if (surface.edges()[m].body != surface.edges()[edge].body)
            result.push_back(m);
      return result;
    }

    /// Among all edges of other bodies.
    std::vector<unsigned int>
    all_masters_of(const unsigned int edge, const bool is_corner) const
    {
      std::vector<unsigned int> result;
      for (unsigned int m = 0; m < surface.edges().size(); ++m)
        if (surface.edges()[m].body != surface.edges()[edge].body &&
            (is_corner || search.comes_first(edge, m)))
          result.push_back(m);
      return result;
    }

    void
    compare_corner(const unsigned int position)
    {
      const unsigned int edge   = search.slaves()[position];
      const unsigned int corner = search.corner(position);
      const Place        place  = surface.place(edge, corner);
      const auto         near   = masters_of(edge, position),
                 all            = all_masters_of(edge, true);
      const auto        &slave  = surface.edges()[edge];
      const unsigned int other  = corner == 0 ? slave.previous : slave.next;
      const Tensor<1, 2> other_normal =
        other == invalid_index ? Tensor<1, 2>()
                               : surface.place(other, 1. - corner).normal();
      const ContactProjection found =
        NarrowPhase(surface, search)
          .project_corner(place,
                          other_normal,
                          {near.data(), near.size()},
                          invalid_index);
      const ContactProjection among_all =
        NarrowPhase(surface, search)
          .project_corner(place,
                          other_normal,
                          {all.data(), all.size()},
                          invalid_index);
      EXPECT_EQ(found.master, among_all.master);
      EXPECT_EQ(found.gap, among_all.gap);
      n_corners += found.master != invalid_index;
      // in a body it is in the one that the face belongs to
      if (found.master != invalid_index && std::abs(found.gap) > 1e-7)
      {
        EXPECT_EQ(found.gap < 0., is_inside_of(found.master, place.x));
      }
    }

    void
    compare_point(const unsigned int edge, const double s)
    {
      const Place place = surface.place(edge, s);
      bool        is_doubtful;
      const auto  reference =
        brute_force(surface, outlines, edge, place, reach, search, is_doubtful);
      if (is_doubtful)
        return;
      // the broad phase leaves nothing out
      const auto near = masters_of(edge, slave_to_position[edge]),
                 all  = all_masters_of(edge, false);
      const ContactProjection found =
        NarrowPhase(surface, search).project(place, {near.data(), near.size()});
      const ContactProjection among_all =
        NarrowPhase(surface, search).project(place, {all.data(), all.size()});
      EXPECT_EQ(found.master, among_all.master);
      EXPECT_EQ(found.gap, among_all.gap);
      if (!reference.empty())
      {
        compare_face(found, reference, place);
        return;
      }
      // beyond the end of an edge at smooth and concave corners only
      ++n_none;
      if (found.master != invalid_index)
      {
        EXPECT_TRUE(found.t < 0. || found.t > 1. ||
                    !is_inside_of(found.master, place.x))
          << found.gap << ' ' << found.t;
      }
    }

  private:
    bool
    is_inside_of(const unsigned int edge, const Point<2> &x) const
    {
      return is_inside(outlines[surface.edges()[edge].body], x);
    }

    void
    compare_face(const ContactProjection      &found,
                 const std::vector<Reference> &reference,
                 const Place                  &place)
    {
      const auto nearest =
        *std::min_element(reference.begin(),
                          reference.end(),
                          [](const Reference &a, const Reference &b) {
                            return std::abs(a.gap) < std::abs(b.gap);
                          });
      ASSERT_NE(found.master, invalid_index);
      ++n_found;
      if (found.master == nearest.edge)
      {
        // bodies are straight-sided: what is left is rounding
        EXPECT_NEAR(found.gap, nearest.gap, 1e-12);
        return;
      }
      // of two faces that meet in a corner the one that faces it more
      ++n_entrance;
      EXPECT_EQ(surface.edges()[found.master].body,
                surface.edges()[nearest.edge].body);
      EXPECT_GT(-(found.normal * place.normal()), nearest.facing);
    }
  };


  TEST(ContactDetection, RandomPolygonsAgainstBruteForce)
  {
    constexpr double   reach    = 0.2;
    constexpr unsigned n_models = 6, n_motions = 10;
    unsigned int       n_found = 0, n_none = 0, n_entrance = 0, n_corners = 0;
    for (unsigned int seed = 0; seed < n_models; ++seed)
    {
      std::mt19937  generator(seed);
      Bodies        bodies = random_bodies(generator, seed);
      ContactSearch search(bodies.surface, {});
      Comparison    comparison(bodies.surface, search, reach);
      for (unsigned int k = 0; k < n_motions; ++k)
      {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", motion " +
                     std::to_string(k));
        const std::vector<Tensor<1, 2>> nodal =
          move(bodies, random_motions(bodies, generator));
        bodies.surface.set_displacements(&nodal);
        search.update(
          std::vector<double>(bodies.surface.n_bodies(), 0.5 * reach));
        comparison.update();
        for (unsigned int i = 0; i < search.slaves().size(); ++i)
          if (search.corner(i) != 2)
            comparison.compare_corner(i);
        for (unsigned int e = 0; e < bodies.surface.edges().size(); ++e)
          for (const double s : {0.031, 0.28, 0.5, 0.77, 0.969})
            comparison.compare_point(e, s);
      }
      n_found += comparison.n_found;
      n_none += comparison.n_none;
      n_entrance += comparison.n_entrance;
      n_corners += comparison.n_corners;
    }
    std::cout << n_found << " points have a face, " << n_entrance
              << " of them not the nearest, " << n_none << " have none; "
              << n_corners << " corners have a face" << std::endl;
    EXPECT_GT(n_corners, 500U);
    EXPECT_GT(n_found, 2000U);
    EXPECT_GT(n_none, 2000U);
    EXPECT_LT(n_entrance, n_found / 20);
  }


  /// Plates thinner than the reach, on each other: the face next to it is found, not
  /// the far side, and a plate does not touch itself.
  TEST(ContactDetection, ThinPlates)
  {
    constexpr double thickness = 0.02, reach = 0.1;
    for (const double opening : {0.005, 0., -0.004})
    {
      SCOPED_TRACE(opening);
      Geometry geometry;
      add_named_box(geometry, "lower ", {0., 0.}, {1., thickness});
      add_named_box(geometry,
                    "upper ",
                    {0., thickness + 0.01},
                    {1., 2. * thickness + 0.01});
      Bodies::Options options;
      options.cell_size = 0.17;
      Bodies             bodies(std::move(geometry), options);
      const unsigned int upper = bodies.mesh.block(
        bodies.mesh.find_element({0.5, 1.5 * thickness + 0.01}));
      std::vector<Motion> motions(2);
      motions[upper].shift = Tensor<1, 2>({0., opening - 0.01});
      const std::vector<Tensor<1, 2>> nodal = move(bodies, motions);
      bodies.surface.set_displacements(&nodal);
      for (const bool upper_is_slave : {false, true})
      {
        std::vector<unsigned int> ranks(2, 0);
        ranks[upper]     = upper_is_slave ? 0 : 1;
        ranks[1 - upper] = upper_is_slave ? 1 : 0;
        ContactSearch search(bodies.surface, ranks);
        search.update(
          std::vector<double>(bodies.surface.n_bodies(), 0.5 * reach));
        unsigned int n = 0, n_none = 0;
        const auto  &edges = bodies.surface.edges();
        for (unsigned int i = 0; i < search.slaves().size(); ++i)
        {
          const unsigned int slave = search.slaves()[i];
          for (const unsigned int m : search.masters(i))
            EXPECT_NE(edges[m].body, edges[slave].body);
          if (search.corner(i) != 2)
            continue;
          const std::string name = bodies.surface.name(slave);
          for (const double s : {0.1, 0.5, 0.9})
          {
            const ContactProjection found =
              NarrowPhase(bodies.surface, search)
                .project(bodies.surface.place(slave, s), search.masters(i));
            if (name == "lower top" || name == "upper bottom")
            {
              ASSERT_NE(found.master, invalid_index);
              EXPECT_EQ(bodies.surface.name(found.master),
                        name == "lower top" ? "upper bottom" : "lower top");
              EXPECT_NEAR(found.gap, opening, 1e-12);
              ++n;
            }
            else if (name == "lower bottom" || name == "upper top")
            {
              EXPECT_EQ(found.master, invalid_index)
                << name << " sees " << bodies.surface.name(found.master)
                << " at " << found.gap;
              ++n_none;
            }
          }
        }
        EXPECT_GE(n, 12U);
        EXPECT_GE(n_none, 12U);
      }
    }
  }


  /// The obtuse corner of a block lies on the right face of a wedge, as that of a kinked crack does
  /// after the crack has met a joint. The face consists of edges of 5 cm, and of a shorter one at the
  /// wedge's corner; the block's corner is 25 cm from there: in front of the face, hence not 25 cm
  /// inside of the wedge behind the lower face, which the upper edge of the corner faces at 81
  /// degrees. The other way round the wedge is as far.
  TEST(ContactDetection, CornerOnTheFaceRoundACorner)
  {
    for (const double gap : {1e-6, 1e-3, -1e-6})
      for (const double shortest : {0.04, 0.01, 1e-6})
      {
        SCOPED_TRACE(std::to_string(gap) + ", " + std::to_string(shortest));
        Geometry geometry;
        geometry.add_polygon(
          {{gap, 0.25}, {0.1, -0.5}, {1., -0.5}, {1., 1.}, {0.2, 1.}}, "block");
        Bodies::Options options;
        options.cell_size           = 10.;
        options.mesh_of_every_block = true;
        std::vector<Point<2>> wedge = {{-2., 0.2}, {0., 0.}, {0., shortest}};
        for (const double y : {0.05, 0.1, 0.15, 0.2, 1.})
          wedge.emplace_back(0., y);
        wedge.insert(wedge.end(),
                     {{-1., 1.}, {-2., 1.}, {-2., 0.6}, {-2., 0.2}});
        options.obstacles = {obstacle("wedge", wedge)};
        Bodies                    bodies(std::move(geometry), options);
        std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
        bodies.surface.set_displacements(&nodal);
        ContactSearch search(bodies.surface, {});
        search.update(std::vector<double>(bodies.surface.n_bodies(), 0.15));
        const auto  &edges = bodies.surface.edges();
        unsigned int n     = 0;
        for (unsigned int i = 0; i < search.slaves().size(); ++i)
        {
          const unsigned int slave = search.slaves()[i], end = search.corner(i);
          if (end == 2 || bodies.surface.is_rigid(slave))
            continue;
          const Place place = bodies.surface.place(slave, end);
          if (Point<2>(place.x).distance(Point<2>(gap, 0.25)) > 1e-12)
            continue;
          const unsigned int other =
            end == 0 ? edges[slave].previous : edges[slave].next;
          const ContactProjection found =
            NarrowPhase(bodies.surface, search)
              .project_corner(place,
                              bodies.surface.place(other, 1. - end).normal(),
                              search.masters(i),
                              invalid_index,
                              internal::AdmittedContact());
          ASSERT_NE(found.master, invalid_index);
          EXPECT_NEAR(found.gap, gap, 1e-12);
          ++n;
        }
        // one for each of the edges that end there
        EXPECT_EQ(n, 2U);
      }
  }


  /// Both faces of a crack meet at its tips, and touch each other up to there.
  // Forces must not jump when a block turns: the share of the contact along faces falls from all to
  // none between the angles that the documentation names, and its slope is at most 1.5 times that
  // of a straight line.
  TEST(ContactDetection, AlongUpTo18DegreesAtCornersFrom37)
  {
    const auto along = [](const double degrees) {
      return NarrowPhase::along_face(
        std::cos(degrees * dealii::numbers::PI / 180.));
    };
    EXPECT_EQ(along(0.), 1.);
    EXPECT_EQ(along(18.), 1.);
    EXPECT_EQ(along(37.), 0.);
    EXPECT_EQ(along(90.), 0.);
    EXPECT_LT(along(18.5), 1.);
    EXPECT_GT(along(36.5), 0.);
    constexpr double step = 0.1;
    for (double angle = 18.; angle < 37.; angle += step)
    {
      const double facing_step =
        std::cos(angle * dealii::numbers::PI / 180.) -
        std::cos((angle + step) * dealii::numbers::PI / 180.);
      EXPECT_LE(along(angle + step), along(angle));
      EXPECT_LE(along(angle) - along(angle + step),
                1.5 * facing_step / 0.15 * (1. + 1e-9));
    }
  }


  TEST(ContactDetection, CrackTips)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    geometry.add_polyline({{0.5, 0.3}, {0.9, 0.5}, {1.4, 0.6}},
                          "crack",
                          CurveRole::joint,
                          JointState::open);
    geometry.add_polyline({{-0.1, 0.52}, {0.31, 0.47}},
                          "notch",
                          CurveRole::joint,
                          JointState::open);
    for (const unsigned int degree : {1U, 2U})
      for (const double rotation : {0., 8., 23.})
      {
        SCOPED_TRACE(std::to_string(degree) + ", " + std::to_string(rotation));
        Bodies::Options options;
        options.degree    = degree;
        options.cell_size = 0.17;
        options.rotation  = rotation;
        Bodies                    bodies(Geometry(geometry), options);
        std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
        bodies.surface.set_displacements(&nodal);
        ContactSearch search(bodies.surface, {});
        search.update(std::vector<double>(bodies.surface.n_bodies(), 0.025));
        const auto  &edges  = bodies.surface.edges();
        double       length = 0.;
        unsigned int n_tips = 0;
        for (unsigned int i = 0; i < search.slaves().size(); ++i)
        {
          const unsigned int slave = search.slaves()[i];
          const std::string  name  = bodies.surface.name(slave);
          if (search.corner(i) != 2 || (name != "crack" && name != "notch"))
            continue;
          bool is_whole = true;
          for (const double s : {0.001, 0.1, 0.5, 0.9, 0.999})
          {
            const Place             place = bodies.surface.place(slave, s);
            const ContactProjection found =
              NarrowPhase(bodies.surface, search)
                .project(place, search.masters(i));
            is_whole = is_whole && found.master != invalid_index;
            if (found.master == invalid_index)
              continue;
            // the other face, there where it is
            EXPECT_EQ(bodies.surface.name(found.master), name);
            EXPECT_NEAR(found.normal * place.normal(), -1., 1e-12);
            EXPECT_LE(found.place.x.distance(place.x), 1e-12);
          }
          if (is_whole)
            length += edges[slave].length;
          const unsigned int next = edges[slave].next;
          if (next != invalid_index && edges[next].start == edges[slave].end &&
              edges[next].end == edges[slave].start)
          {
            ++n_tips;
            EXPECT_TRUE(is_whole);
          }
        }
        // one of both faces carries the points, all along; edges at tips whose
        // lower number is the following face's first one count there
        const double expected = std::hypot(0.4, 0.2) + std::hypot(0.5, 0.1) +
                                0.31 / 0.41 * std::hypot(0.41, 0.05);
        EXPECT_NEAR(length, expected, 1e-9);
        EXPECT_GE(n_tips, 1U);
      }
  }


  /// A corner that comes down on a face that its own edge nearly lies on: 10 degrees. As
  /// long as it is above, the face's points next to it have their feet beyond
  /// the edge's end; the corner is a point of contact all the same, and is
  /// found whether it is still above or in already.
  TEST(ContactDetection, CornerOfANearlyParallelEdge)
  {
    for (const double gap : {0.02, 0.005, 1e-4, -1e-4, -0.005})
    {
      SCOPED_TRACE("gap " + std::to_string(gap));
      const double       angle = 10. * dealii::numbers::PI / 180.;
      const Tensor<1, 2> along({std::cos(angle), std::sin(angle)});
      const Tensor<1, 2> across({-along[1], along[0]});
      const Point<2>     corner(1.3, 1.1);
      Geometry           geometry;
      geometry.add_polygon({{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}}, "below");
      geometry.add_polygon({corner,
                            corner + 1.2 * along,
                            corner + 1.2 * along + across,
                            corner + across},
                           "above");
      Bodies::Options options;
      options.cell_size           = 10.;
      options.mesh_of_every_block = true;
      Bodies bodies(std::move(geometry), options);
      bodies.start(contact_parameters(1e8, 0.05));
      const unsigned int above =
        bodies.mesh.block(bodies.mesh.find_element(corner + 0.5 * across));
      const Vector u =
        bodies.interpolate([&](const Point<2> &, const unsigned int block) {
          return block == above ? Point<2>(0., gap - 0.1) : Point<2>();
        });
      bodies.contact->detect(u);
      ContactTimeStep(*bodies.contact).begin(u, 0.);
      double nearest = 1.;
      for (const ContactPoint &point : bodies.contact->points())
        if (point.master != invalid_index && point.weight > 0. &&
            point.x.distance(Point<2>(1.3, 1. + gap)) < 1e-9)
          nearest = std::min(nearest, point.gap);
      EXPECT_NEAR(nearest, gap, 1e-9);
    }
  }


  /// The same with a third block, whose corner comes past the first one's on
  /// the same face: between both corners there are two masters, and each corner
  /// bears as if it were alone, before and after they have passed each other.
  TEST(ContactDetection, CornersThatPassEachOtherOnAFace)
  {
    constexpr double stiffness = 1e8, reach = 0.05, side = 1.2;
    const double     angle = 7. * dealii::numbers::PI / 180.;
    const double     x = side * std::cos(angle), y = side * std::sin(angle);
    const Point<2>   corner(1.5, 1.1), other(1.3, 1.1);
    Geometry         geometry;
    geometry.add_polygon({{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}}, "below");
    geometry.add_polygon({corner,
                          corner + Point<2>(x, y),
                          corner + Point<2>(0.5 * x, y + 1.)},
                         "right");
    geometry.add_polygon({other,
                          other + Point<2>(-0.5 * x, y + 1.),
                          other + Point<2>(-x, y)},
                         "left");
    Bodies::Options options;
    options.cell_size           = 10.;
    options.mesh_of_every_block = true;
    Bodies             bodies(std::move(geometry), options);
    const unsigned int below =
      bodies.mesh.block(bodies.mesh.find_element({1.5, 0.5}));
    const unsigned int right = bodies.mesh.block(
      bodies.mesh.find_element(corner + Point<2>(0.5 * x, y + 0.1)));
    const unsigned int left = bodies.mesh.block(
      bodies.mesh.find_element(other + Point<2>(-0.5 * x, y + 0.1)));
    for (const double overlap : {-0.05, -0.003, -1e-4, 1e-4, 0.003, 0.01})
      for (const auto &[gap, other_gap] : {std::make_pair(-0.0025, 0.001),
                                           std::make_pair(-0.0025, -1e-4),
                                           std::make_pair(0.001, -0.0025),
                                           std::make_pair(-2e-4, -3e-4)})
      {
        SCOPED_TRACE("overlap " + std::to_string(overlap) + ", gaps " +
                     std::to_string(gap) + ", " + std::to_string(other_gap));
        bodies.start(contact_parameters(stiffness, reach));
        Tensor<1, 2> shift({0., gap - 0.1});
        Tensor<1, 2> other_shift({0.2 + overlap, other_gap - 0.1});
        const Vector u =
          bodies.interpolate([&](const Point<2> &, const unsigned int block) {
            return block == right  ? shift
                   : block == left ? other_shift
                                   : Tensor<1, 2>();
          });
        bodies.contact->detect(u);
        ContactTimeStep(*bodies.contact).begin(u, 0.);
        double gap_at_right = 1., gap_at_left = 1.;
        for (const ContactPoint &point : bodies.contact->points())
          if (point.master != invalid_index && point.weight > 0. &&
              bodies.surface.edges()[point.master].body == below)
          {
            if (point.x.distance(corner + shift) < 1e-9)
              gap_at_right = std::min(gap_at_right, point.gap);
            if (point.x.distance(other + other_shift) < 1e-9)
              gap_at_left = std::min(gap_at_left, point.gap);
          }
        EXPECT_NEAR(gap_at_right, gap, 1e-9);
        EXPECT_NEAR(gap_at_left, other_gap, 1e-9);
      }
  }


  /// One block is pressed into a face from above, and beside it another one is
  /// above the same face, but further away than faces are looked for: the piece
  /// of the face that looks at that one bears nothing, not even where it ends, at the
  /// first one's corner. Pressure is that of the penetration on the length in common.
  TEST(ContactDetection, PieceThatEndsBesideAnotherFace)
  {
    constexpr double stiffness = 1e8, reach = 0.05, length = 1.2, depth = 0.002;
    for (const double height : {0.5 * reach, 1.3 * reach, 1.9 * reach})
      for (const bool is_right : {false, true})
      {
        SCOPED_TRACE("height " + std::to_string(height) + ", on the right " +
                     std::to_string(is_right));
        const double begin = is_right ? 0.4 : 1.4,
                     other =
                       is_right ? begin + length + 1e-4 : begin - length - 1e-4;
        Geometry geometry;
        add_named_box(geometry, "below ", {0., 0.}, {3., 1.});
        add_named_box(geometry,
                      "pressed ",
                      {begin, 1.1},
                      {begin + length, 1.8});
        add_named_box(geometry,
                      "beside ",
                      {other, 1. + height},
                      {other + length, 1.9});
        Bodies::Options options;
        options.cell_size           = 10.;
        options.mesh_of_every_block = true;
        Bodies bodies(std::move(geometry), options);
        bodies.start(contact_parameters(stiffness, reach));
        const unsigned int pressed =
          bodies.mesh.block(bodies.mesh.find_element({begin + 0.5, 1.5}));
        const Vector u =
          bodies.interpolate([&](const Point<2> &, const unsigned int block) {
            return block == pressed ? Point<2>(0., -0.1 - depth) : Point<2>();
          });
        bodies.contact->detect(u);
        bodies.contact->assemble(u, false);
        EXPECT_NEAR(bodies.contact->report().force.norm(),
                    stiffness * depth * length,
                    1e-9 * stiffness * depth * length);
      }
  }


  /// Disks: normals are those of circles, distances those of circles.
  TEST(ContactDetection, ArcsHaveTrueNormals)
  {
    const unsigned int                     seed = 3;
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(-1., 1.);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double   r[2] = {0.5, 0.3};
    const Point<2> c[2] = {{0., 0.}, {0.85, 0.}};
    Geometry       geometry;
    for (unsigned int b = 0; b < 2; ++b)
      geometry.add(single_piece_curve("disk" + std::to_string(b),
                                      CurvePiece::circle(c[b], r[b])));
    Bodies::Options options;
    options.cell_size = 0.13;
    Bodies       bodies(std::move(geometry), options);
    unsigned int n = 0;
    for (unsigned int k = 0; k < 20; ++k)
    {
      std::vector<Motion> motions(2);
      Point<2>            centers[2];
      for (unsigned int i = 0; i < 2; ++i)
      {
        const unsigned int b =
          bodies.mesh.block(bodies.mesh.find_element(c[i]));
        motions[b].center = c[i];
        motions[b].angle  = 2. * random(generator);
        motions[b].shift =
          0.02 * Tensor<1, 2>({random(generator), random(generator)});
        centers[i] = c[i] + motions[b].shift;
      }
      const std::vector<Tensor<1, 2>> nodal = move(bodies, motions);
      bodies.surface.set_displacements(&nodal);
      ContactSearch search(bodies.surface, {});
      search.update(std::vector<double>(bodies.surface.n_bodies(), 0.05));
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        if (search.corner(i) == 2)
          for (const double s : {0., 0.37, 0.9})
          {
            const Place place = bodies.surface.place(search.slaves()[i], s);
            const ContactProjection found =
              NarrowPhase(bodies.surface, search)
                .project(place, search.masters(i));
            if (found.master == invalid_index)
              continue;
            const unsigned int m =
              bodies.surface.name(found.master) == "disk0" ? 0 : 1;
            const Tensor<1, 2> d = place.x - centers[m];
            EXPECT_NEAR(found.gap, d.norm() - r[m], 1e-12);
            EXPECT_LE((found.normal - d / d.norm()).norm(), 1e-11);
            ++n;
          }
    }
    EXPECT_GT(n, 100U);
  }
} // namespace
