#include <nmm/base/exceptions.h>
#include <nmm/solution/load_stepping.h>

#include <algorithm>
#include <cmath>
#include <sstream>

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
    const double least   = steps.min_step * largest;
    double       length  = largest;
    double       reached = begin;
    unsigned int n_cuts = 0, n_lost_iterations = 0;
    for (auto wanted = first; wanted != steps.load_factors.end(); ++wanted)
      do
      {
        // negative where loads are taken away
        const double way = *wanted - reached;
        const double n_parts =
          std::max(1., std::ceil(std::abs(way) / length * (1. - 1e-9)));
        step             = LoadStep();
        step.is_asked    = n_parts <= 1.;
        step.load_factor = step.is_asked ? *wanted : reached + way / n_parts;
        step.n_cuts      = n_cuts;
        step.n_lost_iterations    = n_lost_iterations;
        const StepVerdict verdict = attempt(step);
        const double      taken   = std::abs(step.load_factor - reached);
        if (verdict.is_accepted)
        {
          length  = verdict.ratio > 0. ? std::max(least, verdict.ratio * taken)
                                       : std::max(length, 2. * taken);
          reached = step.load_factor;
          n_cuts = n_lost_iterations = 0;
          continue;
        }
        length      = taken * (verdict.ratio > 0. ? verdict.ratio : 0.5);
        step.n_cuts = ++n_cuts;
        step.n_lost_iterations = n_lost_iterations += step.n_iterations;
        if (length >= least)
          continue;
        std::ostringstream where;
        where << "load factor " << step.load_factor << ", after " << reached;
        AssertThrow(false,
                    NumericalFailure("No equilibrium: " + verdict.reason,
                                     where.str(),
                                     verdict.remedy));
      } while (reached != *wanted);
  }
} // namespace NMM
