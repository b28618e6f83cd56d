#include <nmm/base/exceptions.h>
#include <nmm/mechanics/incremental_statics.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// Part of the bound that the next step aims at.
    constexpr double aim = 0.9;
  } // namespace


  void
  IncrementalSteps::check() const
  {
    AssertThrow(!load_factors.empty(),
                InputError("There is no load factor",
                           "the load steps",
                           "give at least one"));
    double last = 0.;
    for (const double factor : load_factors)
    {
      AssertThrow(std::isfinite(factor) && factor > last,
                  InputError("The load factor " + std::to_string(factor) +
                               " follows " + std::to_string(last),
                             "the load steps",
                             "give factors that ascend from above 0"));
      last = factor;
    }
    AssertThrow(max_displacement > 0.,
                InputError("The largest displacement is " +
                             std::to_string(max_displacement) + " m",
                           "the load steps",
                           "give a number above 0"));
    AssertThrow(min_step > 0. && min_step <= 1.,
                InputError("The smallest step is " + std::to_string(min_step),
                           "the load steps",
                           "give a number above 0 and at most 1"));
  }


  IncrementalStatics::IncrementalStatics(IncrementalElasticity &elasticity)
    : elasticity(&elasticity)
  {
  }


  double
  IncrementalStatics::load_factor() const
  {
    return reached;
  }


  IncrementalStep
  IncrementalStatics::take_step(const IncrementalSteps &steps,
                                const double            wanted,
                                double                 &size)
  {
    const double    least = steps.min_step * steps.load_factors.back();
    IncrementalStep step;
    for (;; ++step.n_cuts)
    {
      // equal parts, rather than a small one at the end
      const double n_parts =
        std::ceil((wanted - reached) / size * (1. - 1e-12));
      step.is_asked = n_parts <= 1.;
      step.load_factor =
        step.is_asked ? wanted : reached + (wanted - reached) / n_parts;
      const IncrementalElasticity::StepResult result =
        elasticity->try_step(step.load_factor, steps.max_displacement);
      step.largest_displacement = result.largest_displacement;
      const double taken        = step.load_factor - reached;
      const double ratio =
        result.largest_displacement > 0.
          ? aim * steps.max_displacement / result.largest_displacement
          : 2.;
      if (result.is_taken)
      {
        size    = std::max(least, taken * std::min(2., ratio));
        reached = step.load_factor;
        return step;
      }
      size = taken * std::max(0.1, ratio);
      if (size < least)
      {
        std::ostringstream what;
        what << "A step of " << taken << " in the load factor moves a cover by "
             << result.largest_displacement << " m, more than "
             << steps.max_displacement << " m, and a smaller step than "
             << least << " is not allowed";
        throw NumericalFailure(what.str(),
                               "load factor " + std::to_string(reached),
                               "allow larger displacements or smaller steps");
      }
    }
  }


  std::vector<IncrementalStep>
  IncrementalStatics::run(const IncrementalSteps                    &steps,
                          const std::function<void(const IncrementalStep &,
                                                   const Vector &)> &after_step)
  {
    steps.check();
    AssertThrow(steps.load_factors.front() > reached,
                InputError("The load factor " +
                             std::to_string(steps.load_factors.front()) +
                             " is not above " + std::to_string(reached) +
                             ", which is reached already",
                           "the load steps",
                           "go on with larger load factors"));
    std::vector<IncrementalStep> taken;
    // nothing bounds the first one but what is asked for
    double size = steps.load_factors.front() - reached;
    for (const double wanted : steps.load_factors)
    {
      if (!std::isfinite(steps.max_displacement))
        size = wanted - reached;
      while (reached < wanted)
      {
        taken.push_back(take_step(steps, wanted, size));
        if (after_step)
          after_step(taken.back(), elasticity->solution());
      }
    }
    return taken;
  }
} // namespace NMM
