#include <nmm/base/exceptions.h>
#include <nmm/solution/load_stepping.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  LoadSteps
  LoadSteps::equal(const unsigned int n, const double last)
  {
    LoadSteps steps;
    steps.load_factors.clear();
    for (unsigned int k = 1; k <= n; ++k)
      steps.load_factors.push_back(last * k / n);
    return steps;
  }


  double
  LoadSteps::largest() const
  {
    return *std::max_element(load_factors.begin(), load_factors.end());
  }


  bool
  LoadSteps::are_ascending() const
  {
    return std::is_sorted(load_factors.begin(), load_factors.end());
  }


  void
  LoadSteps::check() const
  {
    AssertThrow(!load_factors.empty(),
                InputError("There is no load factor",
                           "the load steps",
                           "give at least one"));
    double last = 0.;
    for (const double factor : load_factors)
    {
      AssertThrow(std::isfinite(factor) && factor >= 0. && factor != last,
                  InputError("The load factor " + std::to_string(factor) +
                               " follows " + std::to_string(last),
                             "the load steps",
                             "give factors that are not negative, each another "
                             "one than that before it, which is 0 at first"));
      last = factor;
    }
    AssertThrow(min_step > 0. && min_step <= 1.,
                InputError("The smallest step is " + std::to_string(min_step),
                           "the load steps",
                           "give a number above 0 and at most 1"));
  }


  void
  take_load_steps(const LoadSteps                              &steps,
                  const double                                  begin,
                  const std::function<StepVerdict(LoadStep &)> &attempt,
                  LoadStep                                     &step)
  {
    steps.check();
    const double largest = steps.largest();
    const auto   first =
      std::find_if(steps.load_factors.begin(),
                   steps.load_factors.end(),
                   [&](const double factor) {
                     return factor > begin || !steps.leaves_out_reached;
                   });
    AssertThrow(first != steps.load_factors.end(),
                InputError("The load factor " + std::to_string(largest) +
                             " is not above " + std::to_string(begin) +
                             ", which is reached already",
                           "the load steps",
                           "go on with larger load factors"));
    StepSequence sequence(
      {"load factor", "", steps.min_step * largest, largest}, begin, largest);
    for (auto wanted = first; wanted != steps.load_factors.end(); ++wanted)
      do
      {
        const auto try_step = [&](const StepTrial &trial) {
          const LostSteps lost           = step;
          step                           = LoadStep();
          static_cast<LostSteps &>(step) = lost;
          step.load_factor               = trial.end;
          step.is_asked                  = trial.reaches_target;
          StepVerdict verdict            = attempt(step);
          verdict.n_iterations           = step.n_iterations;
          return verdict;
        };
        sequence.advance(*wanted, try_step, step);
      } while (sequence.position() != *wanted);
  }
} // namespace NMM
