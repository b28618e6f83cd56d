// Blocks on slopes with known limits, reduced from nmm-block-bars.

#include <gtest/gtest.h>
#include <support/block_bars/block_bars.h>
#include <support/contact_bars/expect_holds.h>

namespace NMM
{
  namespace BlockBars
  {
    // Textbooks round the limit of the chain of columns to 0.7855.
    TEST(BlockBars, LimitOfTheChainOfColumns)
    {
      const double limit = limit_friction_of_columns();
      EXPECT_NEAR(limit, 0.7851, 1e-4);
      // of all ways that differ in one column only two are possible at 0.98 of the limit: column 3
      // topples, or column 4 slides
      std::array<unsigned int, 16> modes;
      (void)toe_force(0.98 * limit, modes);
      EXPECT_TRUE(can_move(0.98 * limit, modes));
      unsigned int n_other = 0;
      for (unsigned int &mode : modes)
      {
        const unsigned int expected = mode;
        for (const unsigned int other : {0, 1, 2})
        {
          mode = other;
          n_other += other != expected && can_move(0.98 * limit, modes);
        }
        mode = expected;
      }
      EXPECT_EQ(n_other, 2U);
    }


    TEST(BlockBars, ColumnsTopple)
    {
#ifdef DEBUG
      GTEST_SKIP()
        << "only in Release: 55 s, and the map below runs the same code";
#endif
      Measurements measurements;
      Toppling     toppling;
      toppling.tolerance = 0.01;
      topple_columns(toppling, measurements);
      expect_holds(measurements);
    }


    TEST(BlockBars, MapOfABlockOnAnIncline)
    {
      Measurements measurements;
      InclineMap   map;
      map.n = 5;
      map_incline(map, measurements);
      expect_holds(measurements);
    }


    TEST(BlockBars, FactorsOfSafety)
    {
      Measurements measurements;
      slide_wedge(Slides(), measurements);
      slide_two_blocks(Slides(), measurements);
      expect_holds(measurements);
    }


    // Half of the motion; twice the step.
    TEST(BlockBars, ShakenBlock)
    {
      Measurements measurements;
      BaseMotion   motion;
      motion.step     = 0.004;
      motion.duration = 10.;
      shake_block(motion, measurements);
      expect_holds(measurements);
    }


    TEST(SafetyFactor, BracketsAndBisects)
    {
      for (const double limit : {0.3, 0.97, 1., 4.})
      {
        unsigned int n_trials = 0;
        const auto   factor   = find_safety_factor([&](const double tried) {
          ++n_trials;
          StrengthTrial trial;
          trial.factor  = tried;
          trial.outcome = tried <= limit ? StrengthTrial::Outcome::stands
                                             : StrengthTrial::Outcome::moves;
          return trial;
        });
        EXPECT_LE(factor.stands_at, limit);
        EXPECT_GT(factor.moves_at, limit);
        EXPECT_NEAR(factor.value(), limit, 0.01 * limit);
        EXPECT_EQ(factor.trials.size(), n_trials);
        // 1.5 wide after the bracket is found, halved six times
        EXPECT_LE(n_trials, 12u);
      }
    }


    TEST(SafetyFactor, OneOutcomeOnly)
    {
      for (const bool stands : {true, false})
      {
        SafetyFactorParameters parameters;
        const auto             factor = find_safety_factor(
          [&](const double) {
            StrengthTrial trial;
            trial.outcome = stands ? StrengthTrial::Outcome::stands
                                               : StrengthTrial::Outcome::moves;
            return trial;
          },
          parameters);
        EXPECT_EQ(factor.value(),
                  stands ? parameters.highest : parameters.lowest);
        EXPECT_EQ(factor.stands_at > 0., stands);
        EXPECT_EQ(std::isfinite(factor.moves_at), !stands);
      }
    }


    // A trial that fails is no trial that moves: it ends the search.
    TEST(SafetyFactor, FailureIsNoMotion)
    {
      for (const double failing : {1., 1.5, 2.25})
      {
        const auto factor = find_safety_factor([&](const double tried) {
          StrengthTrial trial;
          trial.factor  = tried;
          trial.outcome = tried == failing ? StrengthTrial::Outcome::fails
                                           : StrengthTrial::Outcome::stands;
          return trial;
        });
        EXPECT_TRUE(factor.has_failed());
        EXPECT_EQ(factor.trials.back().factor, failing);
        EXPECT_FALSE(std::isfinite(factor.moves_at));
        EXPECT_EQ(factor.stands_at, failing == 1. ? 0. : failing / 1.5);
        EXPECT_EQ(std::isnan(factor.value()), failing == 1.);
      }
    }


    TEST(SafetyFactor, BadInput)
    {
      EXPECT_THROW((void)reduce_strength(ContactParameters(), 0.), InputError);
      const auto expect_refused = [](auto change) {
        SafetyFactorParameters parameters;
        change(parameters);
        EXPECT_THROW(parameters.check(), InputError);
      };
      expect_refused([](auto &p) { p.ratio = 1.; });
      expect_refused([](auto &p) { p.tolerance = 0.; });
      expect_refused([](auto &p) { p.lowest = 0.; });
      expect_refused([](auto &p) { p.first = 100.; });
    }
  } // namespace BlockBars
} // namespace NMM
