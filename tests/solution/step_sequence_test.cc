#include <nmm/base/exceptions.h>
#include <nmm/solution/step_sequence.h>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

// The one loop that steps, without anything to solve.
namespace
{
  using namespace NMM;

  /// Ends of the accepted steps from 0 to @p target, with @p attempt for each step.
  std::vector<double>
  step_to(StepSequence                                        &sequence,
          const double                                         target,
          const std::function<StepVerdict(const StepTrial &)> &attempt)
  {
    std::vector<double> ends;
    LostSteps           lost;
    while (sequence.position() != target)
    {
      sequence.advance(target, attempt, lost);
      ends.push_back(sequence.position());
    }
    return ends;
  }


  TEST(StepSequence, StepsMeetTheirTargetWithoutASliver)
  {
    // steps of one length: 0.4, then the remaining 0.5 in two equal parts
    StepSequence sequence({"time", "s", 1e-3, 0.4}, 0., 0.4);
    const auto   accept = [](const StepTrial &) {
      return StepVerdict::accepted();
    };
    const std::vector<double> ends = step_to(sequence, 0.9, accept);
    ASSERT_EQ(ends.size(), 3u);
    EXPECT_EQ(ends[0], 0.4);
    EXPECT_NEAR(ends[1], 0.65, 1e-15);
    EXPECT_EQ(ends[2], 0.9);
    // what was shortened for the target does not limit the next step
    EXPECT_EQ(sequence.length(), 0.4);
    // backwards in the same way
    const std::vector<double> back = step_to(sequence, 0., accept);
    ASSERT_EQ(back.size(), 3u);
    EXPECT_NEAR(back[0], 0.5, 1e-15);
    EXPECT_NEAR(back[1], 0.25, 1e-15);
    EXPECT_EQ(back[2], 0.);
  }


  TEST(StepSequence, EqualStepsHaveTheSameBits)
  {
    // 0.1 is no binary number: the sum of ten differs from 1 by rounding
    StepSequence sequence({"time", "s", 1e-3, 0.1}, 0., 0.1);
    unsigned int n_reached = 0;
    const auto   ends      = step_to(sequence, 1., [&](const StepTrial &trial) {
      EXPECT_EQ(trial.length, 0.1);
      n_reached += trial.reaches_target;
      return StepVerdict::accepted();
    });
    EXPECT_EQ(ends.size(), 10u);
    EXPECT_EQ(n_reached, 1u);
  }


  TEST(StepSequence, ProposalsAreFollowedForFiveCuts)
  {
    StepSequence        sequence({"time", "s", 1e-9}, 0., 1.);
    std::vector<double> lengths;
    LostSteps           lost;
    sequence.advance(
      std::numeric_limits<double>::infinity(),
      [&](const StepTrial &trial) {
        lengths.push_back(trial.length);
        // the first proposal is below half the length, the others too close to it
        const double proposal = lengths.size() == 1 ? 0.25 : 0.99;
        return lengths.size() <= 7
                 ? StepVerdict::rejected({"something is hit", "", proposal}, 3)
                 : StepVerdict::accepted(1.5);
      },
      lost);
    ASSERT_EQ(lengths.size(), 8u);
    const std::vector<double> ratios = {0.25, 0.9, 0.9, 0.9, 0.9, 0.5, 0.5};
    for (unsigned int i = 0; i < ratios.size(); ++i)
      EXPECT_NEAR(lengths[i + 1] / lengths[i], ratios[i], 1e-15);
    EXPECT_EQ(lost.n_cuts, 7u);
    EXPECT_EQ(lost.n_lost_iterations, 21u);
    EXPECT_EQ(lost.last_fault.reason, "something is hit");
    EXPECT_EQ(sequence.position(), lengths.back());
    EXPECT_EQ(sequence.length(), 1.5 * lengths.back());

    // A step that is rejected without a proposal is halved, and the next one counts anew.
    unsigned int n = 0;
    sequence.advance(
      std::numeric_limits<double>::infinity(),
      [&](const StepTrial &) {
        return n++ == 0 ? StepVerdict::rejected({"no convergence"})
                        : StepVerdict::accepted(0.7);
      },
      lost);
    EXPECT_EQ(lost.n_cuts, 1u);
    EXPECT_EQ(lost.n_lost_iterations, 0u);
    EXPECT_NEAR(sequence.length(), 0.7 * 0.75 * lengths.back(), 1e-15);
  }


  TEST(StepSequence, BoundsHold)
  {
    StepSequence sequence({"load factor", "", 0.1, 0.5}, 2., 0.3);
    LostSteps    lost;
    const auto   accept = [](const double ratio) {
      return
        [ratio](const StepTrial &) { return StepVerdict::accepted(ratio); };
    };
    sequence.advance(10., accept(5.), lost);
    EXPECT_EQ(sequence.length(), 0.5);
    sequence.advance(10., accept(0.01), lost);
    EXPECT_EQ(sequence.length(), 0.1);
    sequence.advance(10., accept(4.), lost);
    EXPECT_EQ(sequence.length(), 0.4);
    const double position = sequence.position();
    try
    {
      sequence.advance(
        10.,
        [](const StepTrial &) {
          return StepVerdict::rejected({"it slides", "hold it"});
        },
        lost);
      FAIL() << "0.05 is below the smallest length";
    }
    catch (const NumericalFailure &failure)
    {
      // 0.4, 0.2 and 0.1 were tried
      EXPECT_EQ(lost.n_cuts, 3u);
      EXPECT_EQ(sequence.position(), position);
      const std::string message = failure.message();
      for (const std::string part : {"at least 0.1 ",
                                     "it slides",
                                     "load factor 3, after 2.9",
                                     "hold it"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
    }
  }
} // namespace
