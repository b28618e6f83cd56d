#include <nmm/base/exceptions.h>
#include <nmm/mechanics/incremental_statics.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NMM
{
  void
  IncrementalSteps::check() const
  {
    LoadSteps::check();
    AssertThrow(max_displacement > 0.,
                InputError("The largest displacement is " +
                             std::to_string(max_displacement) + " m",
                           "the load steps",
                           "give a number above 0"));
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


  std::vector<IncrementalStep>
  IncrementalStatics::run(const IncrementalSteps                    &steps,
                          const std::function<void(const IncrementalStep &,
                                                   const Vector &)> &after_step)
  {
    // fraction of the bound at which the next step aims
    constexpr double aim = 0.9;

    steps.check();
    std::vector<IncrementalStep> taken;
    LoadStep                     last;
    const auto                   attempt = [&](LoadStep &step) {
      const IncrementalElasticity::StepResult result =
        elasticity->try_step(step.load_factor, steps.max_displacement);
      step.n_iterations = 1;
      const bool   is_bounded = std::isfinite(steps.max_displacement);
      const double ratio =
        is_bounded && result.largest_displacement > 0.
                            ? aim * steps.max_displacement / result.largest_displacement
                            : 2.;
      if (!result.is_taken)
      {
        std::ostringstream reason;
        reason << "a step of " << step.load_factor - reached
               << " in the load factor moves a cover by "
               << result.largest_displacement << " m, more than "
               << steps.max_displacement << " m";
        return StepVerdict::rejected(
          {reason.str(),
           "allow larger displacements or smaller steps",
           std::max(0.1, ratio)});
      }
      reached = step.load_factor;
      taken.emplace_back();
      static_cast<LoadStep &>(taken.back()) = step;
      taken.back().largest_displacement = result.largest_displacement;
      if (after_step)
        after_step(taken.back(), elasticity->solution());
      return StepVerdict::accepted(std::min(2., ratio));
    };
    take_load_steps(steps, reached, attempt, last);
    return taken;
  }
} // namespace NMM
