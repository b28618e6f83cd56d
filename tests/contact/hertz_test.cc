// The pressure under a cylinder, point by point, against Hertz: what step-nmm-3
// shows on finer meshes.

#include <contact/contact_model.h>
#include <random>
#include <support/n_samples.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  constexpr double radius = 1., rubber_modulus = 1e6, poisson = 0.25;


  /// A line contact of the half-width b, see K. L. Johnson, Contact Mechanics,
  /// section 4.2 and eq. (5.57) for the approach of two plates.
  struct Hertz
  {
    double half_width;

    double
    peak() const
    {
      return 0.5 * modulus() * half_width / radius;
    }

    double
    force() const
    {
      return 0.5 * dealii::numbers::PI * half_width * peak();
    }

    double
    approach() const
    {
      return 2. * force() / (dealii::numbers::PI * modulus()) *
             (2. * std::log(4. * radius / half_width) - 1.);
    }

    double
    pressure(const double x) const
    {
      const double part = x / half_width;
      return part < 1. ? peak() * std::sqrt(1. - part * part) : 0.;
    }

    static double
    modulus()
    {
      return rubber_modulus / (1. - poisson * poisson);
    }
  };


  struct Errors
  {
    double       force = 0., peak = 0., half_width = 0., l2 = 0., ripple = 0.;
    unsigned int n_points = 0;
  };


  /// Points of the contact against the formulas.
  Errors
  compare(const Hertz &hertz, const Bodies &bodies, const double force)
  {
    Errors errors;
    double square = 0., norm = 0., peak = 0., sums[5] = {};
    for (const ContactPoint &point : bodies.contact->points())
      if (point.master != invalid_index)
      {
        ++errors.n_points;
        const double x =
          std::abs(bodies.surface.reference_place(point.edge, point.s).x[0]);
        const double exact = hertz.pressure(x);
        square += point.weight * std::pow(point.pressure - exact, 2);
        norm += point.weight * exact * exact;
        peak            = std::max(peak, point.pressure);
        const double at = x / hertz.half_width;
        // next to the edge of the contact any error is large beside p
        if (at < 0.9)
          errors.ripple =
            std::max(errors.ripple, std::abs(point.pressure / exact - 1.));
        // p^2 is linear in x^2
        if (at > 0.6 && at < 0.95)
        {
          const double X = x * x, Y = point.pressure * point.pressure;
          const double terms[5] = {1., X, X * X, Y, X * Y};
          for (unsigned int i = 0; i < 5; ++i)
            sums[i] += point.weight * terms[i];
        }
      }
    const double zero = (sums[3] * sums[2] - sums[4] * sums[1]) /
                        (sums[1] * sums[3] - sums[0] * sums[4]);
    errors.half_width = std::sqrt(zero) / hertz.half_width - 1.;
    errors.l2         = std::sqrt(square / norm);
    errors.peak       = peak / hertz.peak() - 1.;
    errors.force      = force / (0.5 * hertz.force()) - 1.;
    return errors;
  }


  /// The lower right quarter of the cylinder, on a rigid plate.
  Errors
  press(const Hertz        &hertz,
        const double        edge_over_width,
        const bool          is_augmented,
        const Tensor<1, 2> &offset,
        const double        rotation)
  {
    const double s    = std::sqrt(0.5) * radius;
    const double size = edge_over_width * hertz.half_width;
    Geometry     geometry;
    geometry.add(single_piece_curve(
      "arc", CurvePiece::arc({0., -radius}, {s, -s}, {radius, 0.})));
    geometry.add(
      single_piece_curve("middle",
                         CurvePiece::segment({radius, 0.}, {0., 0.})));
    geometry.add(
      single_piece_curve("axis", CurvePiece::segment({0., 0.}, {0., -radius})));
    GradedMeshParameters mesh;
    mesh.cell_size = 0.2;
    mesh.offset    = offset;
    mesh.rotation  = rotation;
    LocalSize    box;
    const double wide = 1.1 * hertz.half_width;
    box.kind          = LocalSize::Kind::box;
    box.lower         = Point<2>(-wide, -radius - 0.2 * wide);
    box.upper         = Point<2>(wide, -radius + 0.2 * wide);
    box.size          = size;
    box.growth        = 0.2;
    mesh.local_sizes  = {box};
    Bodies::Options options;
    options.graded_mesh = mesh;
    options.obstacles   = {obstacle("plate", {{2., -radius}, {-2., -radius}})};
    Bodies bodies(std::move(geometry), options);
    bodies.problem.materials = {material("rubber", rubber_modulus, poisson)};
    bodies.problem.boundary_conditions = {
      condition(Type::normal_displacement, "axis"),
      condition(Type::normal_displacement,
                "middle",
                constant(-0.5 * hertz.approach()))};
    ContactParameters parameters =
      contact_parameters((is_augmented ? 10. : 30.) * rubber_modulus / size);
    if (is_augmented)
      parameters.penetration_tolerance = 1e-4 * hertz.approach();
    bodies.start(parameters);
    const auto steps = bodies.statics->run(LoadSteps::equal(1));

    const Errors errors = compare(hertz, bodies, steps.back().contact.force[1]);
    std::cout << (is_augmented ? "augmented" : "penalty") << ", edge / b "
              << edge_over_width << ", " << 2 * bodies.covers.n_covers()
              << " unknowns, " << errors.n_points << " points: force "
              << errors.force << ", peak " << errors.peak << ", half-width "
              << errors.half_width << ", L2 " << errors.l2 << ", ripple "
              << errors.ripple << std::endl;
    return errors;
  }


  // A finite disk differs from Hertz's half-plane by 0.1 to 0.2 % at this width.
  // Bars are those of step-nmm-3, the L2 error half of what is asked there.
  void
  expect_curve(const Errors &errors)
  {
    EXPECT_GT(errors.n_points, 40U);
    EXPECT_LE(std::abs(errors.force), 5e-3);
    EXPECT_LE(std::abs(errors.peak), 5e-3);
    EXPECT_LE(std::abs(errors.half_width), 0.01);
    EXPECT_LE(errors.l2, 0.02);
    EXPECT_LE(errors.ripple, 0.03);
  }


  TEST(ContactHertz, PressureHasNoRipple)
  {
    const Tensor<1, 2> offset({0.0123, 0.0321});
    for (const bool is_augmented : {false, true})
      expect_curve(press({0.1}, 0.1, is_augmented, offset, 6.));
  }


  // Two or three edges over the half-width: the rim of the contact lies within an edge, where faces
  // open and close from update to update of the multipliers. Springs that were made stiffer there
  // gave a ripple of 1 and a half-width that is wrong by 0.6. The bars are at most half of the errors
  // of the penalty method on the second mesh: 0.11, 0.089 and 0.35.
  TEST(ContactHertz, MultipliersAreSmoothOnCoarseMeshes)
  {
    for (const double edge_over_width : {0.4, 0.3})
    {
      const Errors errors =
        press({0.1}, edge_over_width, true, Tensor<1, 2>({0.0123, 0.0321}), 6.);
      EXPECT_LE(std::abs(errors.half_width), 0.04);
      EXPECT_LE(errors.l2, 0.04);
      EXPECT_LE(errors.ripple, 0.17);
    }
  }


  // Wherever the mesh lies: cut elements may have little of the contact.
  TEST(ContactHertz, NorAnywhereElse)
  {
    const unsigned int seed = 1;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(0., 1.);
    for (unsigned int k = 0; k < n_samples(6); ++k)
    {
      const double x = 0.2 * random(generator), y = 0.2 * random(generator);
      expect_curve(
        press({0.1}, 0.1, true, Tensor<1, 2>({x, y}), 60. * random(generator)));
    }
  }
} // namespace
