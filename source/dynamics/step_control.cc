#include <nmm/base/exceptions.h>
#include <nmm/dynamics/step_control.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    /// Times that differ by less than this fraction of a step count as equal.
    constexpr double time_tolerance = 1e-9;


    /// Factor by which the length of steps may change after a step with @p n_iterations. It is
    /// below 1 after many iterations, because shorter steps cost less then.
    double
    growth_after(const unsigned int n_iterations,
                 const unsigned int few_iterations,
                 const double       largest)
    {
      if (n_iterations > 2 * few_iterations)
        return 0.7;
      return n_iterations > few_iterations ? 1. : largest;
    }

    /// Length of the next trial, divided by that of a step in which a body passed through another
    /// one.
    double
    retry_share(const StepReport &report, const unsigned int n_cuts)
    {
      // number of cuts up to which the model's own proposal is followed; then steps are halved
      constexpr unsigned int n_followed = 5;
      return std::min(report.retry, n_cuts < n_followed ? 0.9 : 0.5);
    }
  } // namespace


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
    for (const double event :
         model_interface<SupportModel>(integrator.model()).events())
      if (event > integrator.state().events_passed)
        return std::min(event, end);
    return end;
  }


  bool
  StepControl::advance(TimeIntegrator &integrator,
                       const double    end,
                       StepRecord     &record) const
  {
    // fraction of a bound at which the next step aims
    constexpr double safety = 0.9;

    const DynamicState &state = integrator.state();
    record                    = StepRecord();
    double step =
      state.next_step > 0. ? state.next_step : parameters.initial_step;
    if (state.time >= end - time_tolerance * step)
      return false;
    double target = next_target(integrator, end);
    while (target < end && state.time >= target - time_tolerance * step)
    {
      integrator.pass_events(target);
      target = next_target(integrator, end);
    }

    const auto bound_factor = [&](const StepReport &report) {
      double factor = std::numeric_limits<double>::max();
      if (parameters.max_displacement > 0. && report.max_displacement > 0.)
        factor = parameters.max_displacement / report.max_displacement;
      // the local error is proportional to the third power of the step
      if (parameters.max_error > 0. && report.error > 0.)
        factor =
          std::min(factor, std::cbrt(parameters.max_error / report.error));
      return factor;
    };

    while (true)
    {
      const double remaining = target - state.time;
      double       h         = step;
      if (remaining < (1. + time_tolerance) * step)
        h =
          std::abs(remaining - step) < time_tolerance * step ? step : remaining;
      else if (remaining < 1.5 * step)
        h = 0.5 * remaining;
      StepReport &report  = record.report;
      report              = integrator.try_step(h);
      const double factor = report.converged ? bound_factor(report) : 0.5;
      if (report.converged && factor >= 1.)
      {
        integrator.accept();
        double growth = std::min(growth_after(report.n_full_iterations,
                                              parameters.few_iterations,
                                              1.5),
                                 safety * factor);
        // small changes do not justify a new factorization
        if (growth >= 1. && growth < 1.2)
          growth = 1.;
        const double next =
          std::clamp(growth * h, parameters.min_step, parameters.max_step);
        // a step that was short only to meet the target does not limit the next one
        integrator.set_next_step(h < step && growth >= 1. ? step : next);
        return true;
      }

      ++record.n_cuts;
      record.n_lost_iterations += report.n_iterations;
      const std::string reason =
        !report.converged
          ? report.reason
          : (parameters.max_displacement > 0. &&
                 report.max_displacement > parameters.max_displacement
               ? "displacements of " + std::to_string(report.max_displacement) +
                   " m in a step"
               : "an error of " + std::to_string(report.error) +
                   " m in a step");
      step = h * (!report.converged && report.retry > 0.
                    ? retry_share(report, record.n_cuts)
                    : std::clamp(safety * factor, 0.1, 0.7));
      AssertThrow(
        step >= parameters.min_step,
        NumericalFailure(
          "The time step would be " + std::to_string(step) +
            " s, less than the least one, because of " + reason,
          "time " + std::to_string(state.time) + " s, step " +
            std::to_string(state.step + 1),
          !report.remedy.empty()
            ? report.remedy
            : "allow smaller steps, larger displacements or errors, "
              "or look at the last state that converged for what gives "
              "way"));
    }
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


  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step)
  {
    RelaxationReport             report;
    StepRecord                   record;
    double                       h        = parameters.step;
    const double                 least    = 1e-6 * h;
    const bool                   is_bound = parameters.max_displacement > 0.;
    const TimeIntegrator::Vector begin    = integrator.state().u;
    TimeIntegrator::Vector       motion(begin);
    const double furthest = parameters.max_step_displacement > 0.
                              ? parameters.max_step_displacement
                              : 0.01 * parameters.max_displacement;
    double       previous = integrator.account().kinetic;
    report.imbalance      = integrator.account().imbalance;
    while (report.n_steps < parameters.max_steps)
    {
      const StepReport step = integrator.try_step(h);
      report.n_iterations += step.n_iterations;
      const bool is_far = furthest > 0. && step.max_displacement > furthest;
      if (!step.converged || is_far)
      {
        ++record.n_cuts;
        record.n_lost_iterations += step.n_iterations;
        h *= !step.converged && step.retry > 0.
               ? retry_share(step, record.n_cuts)
               : 0.5;
        AssertThrow(
          h >= least,
          NumericalFailure(
            "Relaxation gave up: " +
              (is_far ? "displacements of " +
                          std::to_string(step.max_displacement) + " m in a step"
                      : step.reason),
            "step " + std::to_string(report.n_steps),
            step.remedy.empty() ? "choose a smaller step" : step.remedy));
        continue;
      }
      integrator.accept();
      ++report.n_steps;
      record.report = step;
      if (after_step)
        after_step(record);
      record = StepRecord();
      if (is_bound)
      {
        motion = integrator.state().u;
        motion -= begin;
        if (motion.linfty_norm() > parameters.max_displacement)
        {
          report.moves_away = true;
          report.imbalance  = integrator.account().imbalance;
          return report;
        }
      }
      const double growth = growth_after(step.n_full_iterations,
                                         parameters.few_iterations,
                                         parameters.growth);
      const bool   is_near =
        furthest > 0. && step.max_displacement >= 0.5 * furthest;
      h *= is_near ? std::min(growth, 1.) : growth;
      const double kinetic = integrator.account().kinetic;
      if (kinetic <= previous)
      {
        integrator.stop_motion();
        ++report.n_stops;
        report.imbalance = integrator.account().imbalance;
        if (report.imbalance <= parameters.tolerance)
          return report;
      }
      previous = integrator.account().kinetic;
    }
    AssertThrow(
      false,
      NumericalFailure("No rest after " + std::to_string(report.n_steps) +
                         " steps of relaxation: the imbalance is " +
                         std::to_string(report.imbalance) + " of the forces",
                       "",
                       "allow more steps, or look for parts that "
                       "nothing holds"));
    return report;
  }
} // namespace NMM
