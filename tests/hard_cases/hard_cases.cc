// The hard cases at reduced size, with the bounds that doc/hard-cases.md is
// about. "Uncut" is the same problem on a mesh that fits.

#include <gtest/gtest.h>
#include <support/hard_cases/hard_cases.h>
#include <support/n_samples.h>

using namespace NMM;
using namespace NMM::HardCases;

namespace
{
  constexpr auto aggregation = Stabilization::aggregation;
  constexpr auto ghost       = Stabilization::ghost_penalty;
  constexpr auto none        = Stabilization::none;

  // Bounds for both stabilizations.
  constexpr double most_condition = 5., most_condition_spread = 3.,
                   most_error = 1.5;

  // Rounding of a direct solve: epsilon times condition numbers up to 1e5.
  constexpr double patch_tolerance = 1e-10;

  Measure
  errors_only()
  {
    Measure measure;
    measure.condition = false;
    return measure;
  }


  void
  expect_like_uncut(const Result &result, const Result &uncut)
  {
    SCOPED_TRACE(result.variant + ", " + to_string(result.stabilization));
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.stiffness_condition, 0.);
    EXPECT_LE(result.stiffness_condition,
              most_condition * uncut.stiffness_condition);
    EXPECT_LE(result.displacement_error, most_error * uncut.displacement_error);
    EXPECT_LE(result.energy_error, most_error * uncut.energy_error);
  }


  // The sweep of one side; the exponents of epsilon include both ends.
  void
  sweep(const Side side, const Stabilization stabilization)
  {
    Measure what;
    what.cg_iterations       = true;
    constexpr unsigned int n = 8;
    const Result uncut       = sliver(0., 0., side, aggregation, n, 0, what);
    double       smallest = 1e300, largest = 0.;
    const auto   check = [&](const double epsilon, const double angle) {
      const Result result =
        sliver(epsilon, angle, side, stabilization, n, 0, what);
      expect_like_uncut(result, uncut);
      smallest = std::min(smallest, result.stiffness_condition);
      largest  = std::max(largest, result.stiffness_condition);
      // small systems need few iterations anyway; the count must not explode
      EXPECT_LE(result.cg_iterations, 3 * uncut.cg_iterations + 5);
      for (unsigned int degree = 1; degree <= 2; ++degree)
      {
        const Result patch =
          sliver(epsilon, angle, side, stabilization, n, degree, errors_only());
        EXPECT_LT(patch.displacement_error, patch_tolerance);
        // a derivative costs 1/h
        EXPECT_LT(patch.energy_error, 100. * patch_tolerance);
      }
    };
    for (const double epsilon : {1e-1, 1e-2, 1e-4, 1e-8, 1e-14})
      check(epsilon, 0.);
    for (const double angle : {1., 0.01, 1e-6})
      check(0., angle);
    EXPECT_LE(largest, most_condition_spread * smallest);
  }
} // namespace


TEST(HardCases, SliverAggregation)
{
  for (const Side side : {Side::free, Side::loaded, Side::fixed})
    sweep(side, aggregation);
}


TEST(HardCases, SliverGhostPenalty)
{
  for (const Side side : {Side::free, Side::loaded, Side::fixed})
    sweep(side, ghost);
}


// What the comparison is worth: without stabilization the condition number
// grows with the inverse square of epsilon at least.
TEST(HardCases, SliverWithoutStabilizationIsIllConditioned)
{
  const Measure what;
  const Result  coarse = sliver(1e-2, 0., Side::free, none, 8, 0, what),
               fine    = sliver(1e-4, 0., Side::free, none, 8, 0, what);
  EXPECT_GT(fine.stiffness_condition, 1e3 * coarse.stiffness_condition);
  EXPECT_GT(fine.mass_condition, 1e3 * coarse.mass_condition);
}


TEST(HardCases, DiskAnywhere)
{
  constexpr unsigned int n_disks = n_samples(25);
  const Result           uncut   = fitted_hexagon(0.2, Measure());
  for (const Stabilization stabilization : {aggregation, ghost})
  {
    double smallest = 1e300, largest = 0.;
    for (unsigned int seed = 1; seed <= n_disks; ++seed)
    {
      const Result result = moved_disk(seed, 0.2, stabilization, 0, Measure());
      expect_like_uncut(result, uncut);
      smallest = std::min(smallest, result.stiffness_condition);
      largest  = std::max(largest, result.stiffness_condition);
      // bounded whatever the cut, though not by that of an uncut mesh: squares
      // of quadratics see less of a cut cell than strains do
      EXPECT_LE(result.mass_condition, 1000.);
      EXPECT_LT(moved_disk(seed, 0.2, stabilization, 2, errors_only())
                  .displacement_error,
                patch_tolerance);
    }
    EXPECT_LE(largest, most_condition_spread * smallest);
  }
}


// A layer t thick is stiffer across than along by h/t, which no basis of
// nodal values scales away: digits are lost in proportion.
TEST(HardCases, ThinLayer)
{
  for (const Stabilization stabilization : {aggregation, ghost})
    for (const double thickness : {1e-1, 1e-3, 1e-6, 1e-9})
      for (const double contrast : {1e-6, 1e-3, 1.})
      {
        const Result result =
          thin_layer(thickness, contrast, stabilization, Measure());
        SCOPED_TRACE(result.variant);
        EXPECT_EQ(result.failure, "");
        const double tolerance = 1e-15 * result.stiffness_condition + 1e-9;
        EXPECT_LT(result.displacement_error, tolerance);
        EXPECT_LT(result.energy_error, 10. * tolerance);
        EXPECT_LE(result.stiffness_condition,
                  3e4 *
                    std::max({1., contrast / thickness, thickness / contrast}));
      }
}


// Full order across a bonded interface, whatever the contrast: 3 and 2 but for
// what two coarse meshes leave open.
TEST(HardCases, BondedInclusion)
{
  for (const Stabilization stabilization : {aggregation, ghost})
    for (const double contrast : {1e-6, 1e-3, 1e3, 1e6})
    {
      const Result coarse =
                     bonded_inclusion(contrast, 0.2, stabilization, Measure()),
                   fine =
                     bonded_inclusion(contrast, 0.1, stabilization, Measure());
      SCOPED_TRACE(fine.variant);
      EXPECT_EQ(fine.failure, "");
      EXPECT_GT(coarse.displacement_error / fine.displacement_error,
                std::pow(2., 2.7));
      EXPECT_GT(coarse.energy_error / fine.energy_error, std::pow(2., 1.7));
    }
}


TEST(HardCases, SharpWedges)
{
  for (const Stabilization stabilization : {aggregation, ghost})
    for (const double h : {0.2, 0.1})
    {
      const Result result = sharp_wedges(h, stabilization, Measure());
      SCOPED_TRACE(result.variant);
      EXPECT_LT(result.displacement_error, patch_tolerance);
      EXPECT_LT(result.stiffness_condition, 1e6);
    }
}


// A joint that moves by some ulp changes the result by rounding, although other
// elements and covers come into being.
TEST(HardCases, JointsOnTheMesh)
{
  for (const Track track :
       {Track::along_mesh_lines, Track::along_diagonals, Track::through_nodes})
    for (const JointState state : {JointState::closed, JointState::open})
    {
      SCOPED_TRACE(to_string(track));
      const Coincidence exact = joint_on_mesh(track, state, 0, aggregation);
      for (const unsigned int n_ulp : {1u, 10u, 1000u})
      {
        const Coincidence moved =
          joint_on_mesh(track, state, n_ulp, aggregation);
        EXPECT_GT(moved.n_elements, exact.n_elements);
        // rounding of the solution, and 1000 ulp of a length of 1
        EXPECT_LT(difference(exact, moved), 1e-11);
      }
      // The ghost penalty adds energy of the size of the discretization error
      // where slivers appear, but nothing that depends on their size.
      const Coincidence one      = joint_on_mesh(track, state, 1, ghost),
                        thousand = joint_on_mesh(track, state, 1000, ghost);
      EXPECT_LT(difference(one, thousand), 1e-11);
      EXPECT_LT(difference(joint_on_mesh(track, state, 0, ghost), one), 1e-2);
    }
}


TEST(HardCases, SmallBlocks)
{
  for (const Stabilization stabilization : {aggregation, ghost})
    for (const Shape shape : {Shape::square, Shape::triangle, Shape::disk})
      for (const double size : {1e-1, 1e-3, 1e-6})
        for (const bool in_frame : {false, true})
          for (const bool rigid : {false, true})
          {
            const Result result = small_block(
              shape, size, in_frame, rigid, stabilization, Measure());
            SCOPED_TRACE(result.variant);
            EXPECT_EQ(result.failure, "");
            EXPECT_LT(result.stiffness_condition, 2000.);
            // coordinates near 0.5 have an absolute error of 1e-16, and the
            // block a size of size / 4
            const double tolerance = in_frame ? 1e-12 : 1e-13 + 5e-14 / size;
            EXPECT_LT(result.displacement_error, tolerance);
            EXPECT_LT(result.energy_error, tolerance);
          }
}


// Towards nu = 0.5 the displacement converges late, but it converges, at the
// second order at least from one mesh to the next.
TEST(HardCases, NearlyIncompressible)
{
  for (const double nu : {0.3, 0.499, 0.49999})
  {
    SCOPED_TRACE("nu " + std::to_string(nu));
    const Result coarse =
                   nearly_incompressible(nu, 0.2, aggregation, Measure()),
                 fine = nearly_incompressible(nu, 0.1, aggregation, Measure());
    EXPECT_GT(coarse.displacement_error / fine.displacement_error, 4.);
    EXPECT_GT(coarse.energy_error / fine.energy_error, 3.);
    // lambda / mu = 2 nu / (1 - 2 nu) scales the condition number
    EXPECT_LT(fine.stiffness_condition, 2e4 * (1. + 2. * nu / (1. - 2. * nu)));
  }
}


// The order holds on slender bodies, too: 3 in L2, 2 in energy; the condition
// number grows, as it must, and stays far from 1e16.
TEST(HardCases, Slender)
{
  const Result coarse = slender_beam(100., 1., aggregation, Measure()),
               fine   = slender_beam(100., 0.5, aggregation, Measure());
  EXPECT_GT(coarse.displacement_error / fine.displacement_error, 6.);
  EXPECT_GT(coarse.energy_error / fine.energy_error, 3.);
  EXPECT_LT(fine.displacement_error, 2e-6);
  EXPECT_LT(fine.stiffness_condition, 1e11);
}


TEST(HardCases, RandomNetworks)
{
  for (unsigned int seed = 1; seed <= n_samples(60); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Network network = random_network(seed, 60, aggregation);
    EXPECT_EQ(network.solved.failure, "");
    EXPECT_LT(network.area_error, 1e-14);
    // condition numbers up to 1e8 where regions taper off to nothing
    EXPECT_LT(network.solved.displacement_error, 1e-9);
  }
}


// Counts, not seconds: as many iterations as on a mesh that fits.
TEST(HardCases, IterationsOnTheRing)
{
  const Cost cost = cost_on_ring(0.06);
  EXPECT_LE(cost.cg_iterations, 2 * cost.fitted_cg_iterations);
  EXPECT_LE(cost.ghost_cg_iterations, 2 * cost.fitted_cg_iterations);
}
