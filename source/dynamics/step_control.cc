#include <nmm/base/exceptions.h>
#include <nmm/dynamics/step_control.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  void
  StepControlParameters::check() const
  {
    const auto check =
      [](const bool is_good, const std::string &name, const double value) {
        AssertThrow(is_good,
                    InputError(name + " is " + std::to_string(value),
                               "the step control",
                               "choose steps above 0 and bounds at least 0"));
      };
    check(initial_step > 0. && std::isfinite(initial_step),
          "the initial step",
          initial_step);
    check(min_step >= 0. && min_step <= initial_step,
          "the least step",
          min_step);
    check(max_step == 0. || max_step >= initial_step,
          "the largest step",
          max_step);
    check(max_displacement >= 0., "the largest displacement", max_displacement);
    check(max_error >= 0., "the largest error", max_error);
  }


  StepControl::StepControl(const StepControlParameters &parameters_in)
    : parameters(parameters_in)
  {
    parameters.check();
    if (parameters.min_step == 0.)
      parameters.min_step = 1e-6 * parameters.initial_step;
    if (parameters.max_step == 0.)
      parameters.max_step = parameters.initial_step;
  }


  double
  StepControl::next_target(const TimeIntegrator &integrator,
                           const double          end) const
  {
    for (const double event : integrator.model().events())
      if (event > integrator.state().events_passed)
        return std::min(event, end);
    return end;
  }


  double
  StepControl::growth_after(const double       n_iterations,
                            const unsigned int few_iterations,
                            const double       largest)
  {
    if (n_iterations > 2 * few_iterations)
      return 0.7;
    return n_iterations > few_iterations ? 1. : largest;
  }


  StepVerdict
  StepControl::try_step(TimeIntegrator &integrator,
                        const double    h,
                        StepReport     &report) const
  {
    // fraction of a bound at which the next step aims
    constexpr double safety = 0.9;

    report = integrator.try_step(h);
    if (!report.converged)
      return StepVerdict::rejected({report.reason, report.remedy, report.retry},
                                   report.n_iterations);
    double      factor = std::numeric_limits<double>::max();
    std::string result;
    if (parameters.max_displacement > 0. && report.max_displacement > 0.)
    {
      factor = parameters.max_displacement / report.max_displacement;
      result =
        "displacements of " + std::to_string(report.max_displacement) + " m";
    }
    if (parameters.max_error > 0. && report.error > 0.)
    {
      // the local error is proportional to the third power of the step
      const double of_error = std::cbrt(parameters.max_error / report.error);
      if (of_error < factor)
        result = "an error of " + std::to_string(report.error) + " m";
      factor = std::min(factor, of_error);
    }
    if (factor < 1.)
      return StepVerdict::rejected(
        {result + " in a step",
         "allow larger displacements or errors, or smaller steps",
         std::clamp(safety * factor, 0.1, 0.7)},
        report.n_iterations);

    integrator.accept();
    const double growth = std::min(growth_after(report.n_full_iterations,
                                                parameters.few_iterations,
                                                1.5),
                                   safety * factor);
    // small changes do not justify a new factorization
    return StepVerdict::accepted(growth >= 1. && growth < 1.2 ? 1. : growth);
  }


  bool
  StepControl::advance(TimeIntegrator &integrator,
                       const double    end,
                       StepRecord     &record) const
  {
    // Times that differ by less than this fraction of a step count as equal.
    constexpr double time_tolerance = 1e-9;

    const DynamicState &state = integrator.state();
    record                    = StepRecord();
    const double step =
      state.next_step > 0. ? state.next_step : parameters.initial_step;
    if (state.time >= end - time_tolerance * step)
      return false;
    double target = next_target(integrator, end);
    while (target < end && state.time >= target - time_tolerance * step)
    {
      integrator.pass_events(target);
      target = next_target(integrator, end);
    }
    StepSequence sequence(
      {"time", "s", parameters.min_step, parameters.max_step},
      state.time,
      step);
    sequence.advance(
      target,
      [&](const StepTrial &trial) {
        return try_step(integrator, trial.length, record.report);
      },
      record);
    integrator.set_next_step(sequence.length());
    return true;
  }


  void
  StepControl::run(
    TimeIntegrator                                &integrator,
    const double                                   end,
    const std::function<bool(const StepRecord &)> &after_step) const
  {
    StepRecord record;
    while (advance(integrator, end, record))
      if (after_step && !after_step(record))
        return;
  }
} // namespace NMM
