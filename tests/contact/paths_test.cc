// Load steps that would pass through a wall: a bar of 1 x 1 m, held at its left end, and a thin wall to its
// right. The solution is uniform, so that the reference is exact.

#include <contact/contact_model.h>
#include <random>
#include <support/n_samples.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double young_of_bar = 1e6, stiffness_of_wall = 1e10;

  /// A bar, pulled by @p traction [Pa] against a wall at the distance @p gap [m], of the given
  /// thickness [m], which moves by @p advance towards the bar [m].
  struct Shot
  {
    double       traction = 0., gap = 0., thickness = 0., advance = 0.;
    unsigned int n_steps  = 1;
    bool         is_small = true;
    /// Result: steps that were given up.
    unsigned int n_cuts = 0;

    std::string
    describe() const
    {
      std::ostringstream text;
      text << "traction " << traction << ", gap " << gap << ", thickness "
           << thickness << ", advance " << advance << ", " << n_steps
           << " steps, " << (is_small ? "small" : "finite");
      return text.str();
    }
  };


  /// The displacement of the bar's right end at the full load [m].
  double
  end_of_bar(Shot &shot)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    const double    x = 1. + shot.gap;
    Bodies::Options options;
    options.cell_size                      = 0.7;
    options.obstacles                      = {obstacle("wall",
                                  {{x, -1.},
                                                        {x + shot.thickness, -1.},
                                                        {x + shot.thickness, 2.},
                                                        {x, 2.},
                                                        {x, -1.}})};
    options.obstacles.front().displacement = [&shot](const double factor) {
      return Tensor<1, 2>({-factor * shot.advance, 0.});
    };
    Bodies bodies(std::move(geometry), options);
    bodies.problem.materials           = {material("m", young_of_bar, 0.)};
    bodies.problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement,
                "left",
                vector_function(
                  [](const Point<2> &) { return Tensor<1, 2>(); })),
      condition(BoundaryCondition::Type::traction,
                "right",
                vector_function([&shot](const Point<2> &) {
                  return Tensor<1, 2>({shot.traction, 0.});
                }))};
    bodies.start(contact_parameters(stiffness_of_wall), shot.is_small);
    for (const ContactStep &step :
         bodies.statics->run(LoadSteps::equal(shot.n_steps)))
      shot.n_cuts += step.n_cuts;
    const DisplacementField field(bodies.covers,
                                  bodies.problem,
                                  bodies.statics->solution());
    const unsigned int      e = bodies.mesh.find_element({0.999, 0.5});
    return field.displacement(e,
                              bodies.mesh.mathematical_mesh().real_to_reference(
                                bodies.mesh.cell(e), {1., 0.5}))[0];
  }


  // Small displacements: where the wall is reached, t + k (g - u) = E u.
  TEST(Paths, NoLoadStepPassesThroughAWallMPI)
  {
    const unsigned int seed = 20261127;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                     generator(seed);
    std::uniform_real_distribution<> unit;
    unsigned int                     n_reached = 0;
    // A sample takes thirty times as long on two ranks, which wait for each other.
    const bool on_one_rank =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    const unsigned int n = n_samples(on_one_rank ? 60 : 6);
    for (unsigned int i = 0; i < n; ++i)
    {
      Shot shot;
      shot.gap       = std::pow(10., -2. + 2. * unit(generator));
      shot.thickness = std::pow(10., -3. + 3. * unit(generator));
      shot.advance   = (shot.gap + 0.7) * unit(generator);
      shot.traction =
        unit(generator) < 0.3 ? 0. : 3. * young_of_bar * unit(generator);
      shot.n_steps = 1 + static_cast<unsigned int>(3. * unit(generator));
      SCOPED_TRACE(shot.describe());
      const double free     = shot.traction / young_of_bar,
                   gap      = shot.gap - shot.advance;
      const bool is_reached = free > gap;
      n_reached += is_reached;
      const double expected = is_reached
                                ? (shot.traction + stiffness_of_wall * gap) /
                                    (young_of_bar + stiffness_of_wall)
                                : free;
      EXPECT_NEAR(end_of_bar(shot), expected, 1e-9);
    }
    EXPECT_GT(n_reached, n / 2);
  }


  // Large displacements: the bar's end goes to the wall and less than 1e-4 m into it, since stresses are below E and
  // the stiffness is 1e4 E per metre.
  TEST(Paths, NoLargeDisplacementPassesThroughAWall)
  {
    for (const double thickness : {0.001, 0.05, 1.})
      for (const double advance : {0., 0.5})
      {
        Shot shot;
        shot.is_small  = false;
        shot.gap       = 0.2;
        shot.thickness = thickness;
        shot.advance   = advance;
        shot.traction  = 0.5 * young_of_bar;
        SCOPED_TRACE(shot.describe());
        EXPECT_NEAR(end_of_bar(shot), shot.gap - advance, 1e-4);
        // Halving until a step of 0.5 m ends before the middle of the wall would take
        // log2(0.5 / 0.0005) = 10 cuts; steps are cut to where the wall is.
        if (advance == 0.)
        {
          EXPECT_LT(shot.n_cuts, 10u);
        }
      }
  }
} // namespace
