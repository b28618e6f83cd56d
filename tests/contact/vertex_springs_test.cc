// Springs at vertices, as the paper has them.

#include <contact/contact_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  constexpr double rock_modulus = 1e9, stiffness = 1e5;


  ContactParameters
  springs()
  {
    ContactParameters parameters = contact_parameters(stiffness, 0.05);
    parameters.integration       = ContactIntegration::points;
    return parameters;
  }


  RigidObstacle
  level_floor()
  {
    return obstacle("floor",
                    {{3., 0.}, {0.53, 0.}, {0.37, 0.}, {-0.31, 0.}, {-3., 0.}});
  }


  struct Sum
  {
    double       weight = 0., force = 0.;
    unsigned int n = 0;
  };


  Sum
  sum_of_springs(const Bodies &bodies)
  {
    Sum sum;
    for (const ContactPoint &point : bodies.contact->points())
      if (point.state != ContactState::open)
      {
        sum.weight += point.weight;
        sum.force += point.weight * point.pressure;
        ++sum.n;
      }
    return sum;
  }


  /// A block of 1 x 1 on two corners sinks by weight / (2 k), whatever the mesh.
  TEST(VertexSprings, BlockOnTwoCorners)
  {
    for (const unsigned int degree : {1U, 2U})
      for (const double cell_size : {0.7, 0.23})
        for (const double rotation : {0., 17.})
        {
          SCOPED_TRACE(std::to_string(degree) + ", " +
                       std::to_string(cell_size) + ", " +
                       std::to_string(rotation));
          Geometry geometry;
          add_box(geometry, {0., 0.}, {1., 1.});
          Bodies::Options options;
          options.degree    = degree;
          options.cell_size = cell_size;
          options.rotation  = rotation;
          options.obstacles = {level_floor()};
          Bodies bodies(std::move(geometry), options);
          bodies.problem.materials = {material("rock", rock_modulus, 0.2, 10.)};
          bodies.problem.gravity   = Point<2>(0., -10.);
          bodies.problem.fixed_points = {guide({0.5, 0.5}, true)};
          bodies.start(springs());
          const auto   steps = bodies.statics->run(LoadSteps::equal(1));
          const double sinks = 100. / (2. * stiffness);
          // corners come nearer to each other by 100 N over 1e9 Pa, nothing else
          // disturbs symmetry but the guide's spring and the mesh
          EXPECT_NEAR(steps.back().contact.largest_penetration,
                      sinks,
                      1e-4 * sinks);
          const Sum sum = sum_of_springs(bodies);
          EXPECT_EQ(sum.n, 2U);
          EXPECT_NEAR(sum.weight, 2., 1e-6);
          EXPECT_NEAR(sum.force, 100., 1e-6);
        }
  }


  /// A square that stands on a vertex: both of its edges meet there, and there is
  /// one spring all the same, level or tilted.
  TEST(VertexSprings, OneSpringAtAVertex)
  {
    for (const double tilt : {0., 0.3, 0.7})
      for (const double cell_size : {0.7, 0.19})
      {
        SCOPED_TRACE(std::to_string(tilt) + ", " + std::to_string(cell_size));
        constexpr double      down    = 0.01;
        std::vector<Point<2>> corners = {{0., 0.}};
        for (unsigned int i = 0; i < 3; ++i)
        {
          const double angle = dealii::numbers::PI / 4. * (1. + i) - 0.5 * tilt;
          const double length = i == 1 ? std::sqrt(2.) : 1.;
          corners.push_back(
            Point<2>(length * std::cos(angle), length * std::sin(angle)));
        }
        Geometry geometry;
        geometry.add_polygon(corners, "square");
        Bodies::Options options;
        options.cell_size                 = cell_size;
        options.obstacles                 = {level_floor()};
        options.obstacles[0].displacement = [](const double t) {
          return Point<2>(0., down * t);
        };
        Bodies bodies(std::move(geometry), options);
        bodies.problem.materials    = {material("rock", rock_modulus, 0.2)};
        bodies.problem.fixed_points = {guide(corners[1], true, true),
                                       guide(corners[2], true, true),
                                       guide(corners[3], true, true)};
        bodies.start(springs());
        const auto steps = bodies.statics->run(LoadSteps::equal(1));
        // the square gives way under its corner by a few times k / E, the more
        // the finer the mesh: a point load
        const double force = steps.back().contact.force[1];
        EXPECT_NEAR(force, stiffness * down, 2e-3 * stiffness * down);
        const Sum sum = sum_of_springs(bodies);
        EXPECT_NEAR(sum.weight, 1., 1e-4);
        EXPECT_NEAR(force,
                    stiffness * steps.back().contact.largest_penetration,
                    1e-4 * force);
      }
  }


  /// On an arc the vertices are the ends of edges, as those of a polygon: faces that
  /// are pressed together bear by their springs.
  TEST(VertexSprings, EndsOfEdgesOnAnArc)
  {
    Geometry geometry;
    geometry.add(
      single_piece_curve("disk", CurvePiece::circle({0., 0.5}, 0.5)));
    Bodies::Options options;
    options.cell_size                 = 0.05;
    options.obstacles                 = {level_floor()};
    options.obstacles[0].displacement = [](const double t) {
      return Point<2>(0., 0.01 * t);
    };
    Bodies bodies(std::move(geometry), options);
    bodies.problem.materials    = {material("rock", rock_modulus, 0.2)};
    bodies.problem.fixed_points = {guide({0., 0.5}, true, true),
                                   guide({0., 0.7}, true)};
    bodies.start(springs());
    bodies.statics->run(LoadSteps::equal(1));
    const Sum sum = sum_of_springs(bodies);
    // cells of 0.05 cut a chord of 0.2 into some pieces; each vertex is half a
    // spring of each edge that ends there
    EXPECT_GE(sum.n, 8U);
    EXPECT_NEAR(sum.weight, std::round(sum.weight), 1e-3);
    EXPECT_NEAR(sum.weight, 0.5 * sum.n, 1e-3);
  }


  TEST(VertexSprings, NoMultipliers)
  {
    ContactParameters parameters     = springs();
    parameters.penetration_tolerance = 1e-6;
    EXPECT_THROW(parameters.check(), InputError);
  }
} // namespace
