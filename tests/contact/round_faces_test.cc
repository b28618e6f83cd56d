// Contact points of round faces, and penetrations between them.

#include <contact/contact_model.h>
#include <contact/random_polygons.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double disk_radius = 0.5;


  /// A disk that touches the origin from above.
  Bodies
  disk_on(const std::vector<RigidObstacle> &obstacles)
  {
    Geometry geometry;
    geometry.add(
      single_piece_curve("disk",
                         CurvePiece::circle({0., disk_radius}, disk_radius)));
    Bodies::Options options;
    options.obstacles = obstacles;
    return Bodies(std::move(geometry), options);
  }


  RigidObstacle
  floor_below()
  {
    return obstacle("floor", {{2., 0.}, {-2., 0.}});
  }


  /// Largest distance of neighbouring points along edges, within 0.15 m of the origin: further up the
  /// disk is out of reach of what it lies on [m].
  double
  largest_distance(const Bodies &bodies)
  {
    const std::vector<ContactPoint> &points = bodies.contact->points();
    double                           result = 0.;
    for (unsigned int q = 0; q + 1 < points.size(); ++q)
    {
      const Point<2> x =
        bodies.surface.reference_place(points[q].edge, points[q].s).x;
      if (points[q].edge == points[q + 1].edge && x.norm() < 0.15)
        result = std::max(result,
                          (points[q + 1].s - points[q].s) *
                            bodies.surface.edges()[points[q].edge].length);
    }
    return result;
  }


  /// The largest distance is 0.01 relative radii of curvature, and as there is a whole number of
  /// parts, not less than the half of it.
  TEST(RoundFaces, PointsByRelativeCurvature)
  {
    RigidObstacle bowl;
    bowl.name   = "bowl";
    bowl.pieces = {CurvePiece::arc({0.6, 0.2}, {0., 0.}, {-0.6, 0.2})};
    // The circle through these points.
    const double  bowl_radius = (0.6 * 0.6 + 0.2 * 0.2) / (2. * 0.2);
    RigidObstacle hill;
    hill.name   = "hill";
    hill.pieces = {CurvePiece::arc({0.6, -0.2}, {0., 0.}, {-0.6, -0.2})};
    for (const auto &[face, curvature] :
         {std::make_pair(floor_below(), 1. / disk_radius),
          std::make_pair(bowl, 1. / disk_radius - 1. / bowl_radius),
          std::make_pair(hill, 1. / disk_radius + 1. / bowl_radius)})
    {
      SCOPED_TRACE(face.name);
      Bodies bodies = disk_on({face});
      bodies.start(contact_parameters(1e9));
      bodies.contact->detect(bodies.interpolate(
        [](const Point<2> &, unsigned int) { return Tensor<1, 2>(); }));
      const double distance = largest_distance(bodies);
      EXPECT_LE(distance, 0.01 / curvature * (1. + 1e-9));
      EXPECT_GE(distance, 0.005 / curvature);
    }
  }


  /// Both faces of a circular joint lie on each other, and so do straight faces: there are four
  /// points between places where edges of one side end.
  TEST(RoundFaces, FacesThatLieOnEachOtherHaveTheirPoints)
  {
    Geometry geometry;
    add_named_box(geometry, "", {-1., -1.}, {1., 1.});
    Curve joint =
      single_piece_curve("joint", CurvePiece::circle({0., 0.}, disk_radius));
    joint.role  = CurveRole::joint;
    joint.state = JointState::open;
    geometry.add(joint);
    Bodies::Options options;
    Bodies          bodies(std::move(geometry), options);
    bodies.start(contact_parameters(1e9));
    bodies.contact->detect(bodies.interpolate(
      [](const Point<2> &, unsigned int) { return Tensor<1, 2>(); }));
    unsigned int n_slaves = 0;
    for (const auto &edge : bodies.surface.edges())
      n_slaves += edge.radius > 0.;
    ASSERT_GT(n_slaves, 0U);
    EXPECT_EQ(bodies.contact->points().size(), 4 * n_slaves);
  }


  /// A disk that is turned anyhow and pressed into a floor: the penetration is that of the disk,
  /// even if it is so small that no point is behind the floor. The parabola of the gap between
  /// points is off by the fourth power of an angle of 0.01.
  TEST(RoundFaces, PenetrationIsThatOfTheFaces)
  {
    for (const double depth : {1e-6, 1e-5, 1e-3})
      for (const unsigned int n_points : {2U, 4U})
        for (unsigned int k = 0; k < 8; ++k)
        {
          SCOPED_TRACE(k);
          Bodies            bodies     = disk_on({floor_below()});
          ContactParameters parameters = contact_parameters(1e9);
          parameters.n_points          = n_points;
          bodies.start(parameters);
          Motion motion;
          motion.center  = {0., disk_radius};
          motion.angle   = 0.37 * k;
          motion.shift   = Tensor<1, 2>({0., -depth});
          const Vector u = bodies.interpolate(
            [&](const Point<2> &X, unsigned int) { return motion(X); });
          bodies.contact->detect(u);
          bodies.contact->assemble(u, false);
          EXPECT_NEAR(bodies.contact->report().largest_penetration,
                      depth,
                      1e-8 * disk_radius);
        }
  }
} // namespace
