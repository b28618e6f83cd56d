#include <nmm/base/exceptions.h>
#include <nmm/solution/step_sequence.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// Lengths that differ by less than this fraction count as equal. Then the length is kept to
    /// the last bit, so that a factorization that depends on it may be kept as well.
    constexpr double length_tolerance = 1e-9;


    /// Length of the next trial divided by that of a rejected one, which is the @p n_cuts th.
    double
    share_after_cut(const double proposal, const unsigned int n_cuts)
    {
      // number of cuts up to which the proposal is followed; then steps are at least halved
      constexpr unsigned int n_followed = 5;
      if (proposal <= 0.)
        return 0.5;
      return std::min(proposal, n_cuts <= n_followed ? 0.9 : 0.5);
    }
  } // namespace


  StepVerdict
  StepVerdict::rejected(const StepFault &fault, const unsigned int n_iterations)
  {
    StepVerdict verdict;
    verdict.fault        = fault;
    verdict.n_iterations = n_iterations;
    return verdict;
  }


  StepVerdict
  StepVerdict::accepted(const double ratio)
  {
    StepVerdict verdict;
    verdict.ratio = ratio;
    return verdict;
  }


  StepSequence::StepSequence(const Range &range_in,
                             const double position,
                             const double length)
    : range(range_in)
    , reached(position)
    , next_length(length)
  {
    Assert(length > 0. && range.least <= range.largest,
           dealii::ExcMessage("Steps need a length."));
  }


  StepTrial
  StepSequence::next_trial(const double target) const
  {
    const double way = std::abs(target - reached);
    StepTrial    trial;
    trial.length         = next_length;
    trial.reaches_target = way < (1. + length_tolerance) * next_length;
    if (trial.reaches_target)
    {
      if (way < (1. - length_tolerance) * next_length)
        trial.length = way;
      trial.end = target;
      return trial;
    }
    if (way < 1.5 * next_length)
      trial.length = 0.5 * way;
    trial.end = reached + std::copysign(trial.length, target - reached);
    return trial;
  }


  void
  StepSequence::advance(
    const double                                         target,
    const std::function<StepVerdict(const StepTrial &)> &attempt,
    LostSteps                                           &lost)
  {
    lost = LostSteps();
    while (true)
    {
      const StepTrial   trial   = next_trial(target);
      const StepVerdict verdict = attempt(trial);
      if (verdict.is_accepted())
      {
        const bool   is_shortened = trial.length < next_length;
        const double length =
          std::clamp(verdict.ratio * trial.length, range.least, range.largest);
        reached     = trial.end;
        next_length = is_shortened && verdict.ratio >= 1.
                        ? std::max(next_length, length)
                        : length;
        return;
      }
      ++lost.n_cuts;
      lost.n_lost_iterations += verdict.n_iterations;
      lost.last_fault = verdict.fault;
      if (trial.length > (1. + length_tolerance) * range.least)
      {
        // the smallest length is tried before the steps are given up
        next_length =
          std::max(range.least,
                   trial.length *
                     share_after_cut(verdict.fault.retry, lost.n_cuts));
        continue;
      }
      const std::string  unit = range.unit.empty() ? "" : " " + range.unit;
      std::ostringstream what, where;
      what << "No step of at least " << range.least << unit
           << " succeeds: " << verdict.fault.reason;
      where << range.quantity << ' ' << trial.end << unit << ", after "
            << reached << unit;
      AssertThrow(false,
                  NumericalFailure(
                    what.str(),
                    where.str(),
                    !verdict.fault.remedy.empty()
                      ? verdict.fault.remedy
                      : "allow smaller steps, or look at the last state that "
                        "converged for what gives way"));
    }
  }
} // namespace NMM
