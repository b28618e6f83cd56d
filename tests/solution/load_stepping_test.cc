#include <nmm/base/exceptions.h>
#include <nmm/solution/load_stepping.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

// The one loop over load steps, without a problem to solve.
namespace
{
  using namespace NMM;

  /// Load factors of the accepted steps, where no step may be longer than @p longest.
  std::vector<double>
  take(const std::vector<double> &load_factors,
       const double               begin,
       const double               longest,
       const bool                 leaves_out_reached = true)
  {
    LoadSteps steps;
    steps.load_factors       = load_factors;
    steps.leaves_out_reached = leaves_out_reached;
    std::vector<double> accepted;
    double              reached = begin;
    LoadStep            last;
    take_load_steps(
      steps,
      begin,
      [&](LoadStep &step) {
        if (std::abs(step.load_factor - reached) > longest * (1. + 1e-12))
          return StepVerdict::rejected({"the step is too long"});
        reached = step.load_factor;
        accepted.push_back(reached);
        return StepVerdict::accepted();
      },
      last);
    EXPECT_EQ(last.load_factor, load_factors.back());
    EXPECT_TRUE(last.is_asked);
    return accepted;
  }


  TEST(LoadStepping, LoadsAreTakenAwayAsTheyAreApplied)
  {
    EXPECT_EQ(take({0.5, 1., 0.25, 0., 1.}, 0., 10.),
              (std::vector<double>{0.5, 1., 0.25, 0., 1.}));
    // No step is longer than allowed, and those requested are among them.
    const std::vector<double> divided = take({1., 0.25}, 0., 0.3);
    double                    before  = 0.;
    unsigned int              n_down  = 0;
    for (const double factor : divided)
    {
      EXPECT_LE(std::abs(factor - before), 0.3 * (1. + 1e-12));
      n_down += factor < before;
      before = factor;
    }
    EXPECT_NE(std::find(divided.begin(), divided.end(), 1.), divided.end());
    // 0.75 in steps of at most 0.3
    EXPECT_GE(n_down, 3u);
  }


  TEST(LoadStepping, ContinuesAboveWhereItIs)
  {
    EXPECT_EQ(take({0.25, 0.5, 1.}, 0.5, 10.), std::vector<double>{1.});
    EXPECT_THROW(take({0.25, 0.5}, 0.5, 10.), InputError);
    EXPECT_THROW(take({0.5, 0.5}, 0., 10.), InputError);
    EXPECT_THROW(take({0., 0.5}, 0., 10.), InputError);
    EXPECT_THROW(take({0.5, -0.5}, 0., 10.), InputError);
    // All load factors, also the present one: a solid that was cut further has another equilibrium.
    EXPECT_EQ(take({0.5, 0.25}, 0.5, 10., false),
              (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(take({0.25, 0.5}, 0.5, 10., false),
              (std::vector<double>{0.25, 0.5}));
    // a step that is shorter than a ten-thousandth is given up
    EXPECT_THROW(take({1.}, 0., 1e-5), NumericalFailure);
  }
} // namespace
