#include <nmm/base/exceptions.h>
#include <nmm/dynamics/relaxation.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    /// Try a step of length @p h [s], in which no cover may move by more than @p furthest [m]
    /// (0: no bound), and accept it if it is good.
    StepVerdict
    try_to_relax(TimeIntegrator             &integrator,
                 const RelaxationParameters &parameters,
                 const double                h,
                 const double                furthest,
                 StepReport                 &report)
    {
      // What is left of the forces is out of balance when the next step begins, and is relaxed
      // with the rest. With 1e-3 the relaxation of slopes of some hundred blocks spends most of its
      // iterations on the last points that stick or slip, or cuts the step because of them; with
      // 0.2 forces may become larger in a step.
      constexpr double part = 0.03;

      report = integrator.try_step(h, part * integrator.account().imbalance);
      if (!report.converged)
        return StepVerdict::rejected(
          {report.reason, report.remedy, report.retry}, report.n_iterations);
      if (furthest > 0. && report.max_displacement > furthest)
        return StepVerdict::rejected({"displacements of " +
                                      std::to_string(report.max_displacement) +
                                      " m in a step"},
                                     report.n_iterations);
      integrator.accept();
      const double growth = StepControl::growth_after(report.n_full_iterations,
                                                      parameters.few_iterations,
                                                      parameters.growth);
      const bool   is_near =
        furthest > 0. && report.max_displacement >= 0.5 * furthest;
      return StepVerdict::accepted(is_near ? std::min(growth, 1.) : growth);
    }
  } // namespace


  ContactUpdate
  update_in_relaxation(const TimeScheme &scheme)
  {
    return scheme.is_conserving ? ContactUpdate::every_iteration
                                : ContactUpdate::every_step;
  }


  RelaxationReport
  relax(TimeIntegrator                                &integrator,
        const RelaxationParameters                    &parameters,
        const std::function<void(const StepRecord &)> &after_step,
        const std::function<void(double length)>      &before_step)
  {
    RelaxationReport             report;
    const TimeIntegrator::Vector begin = integrator.state().u;
    TimeIntegrator::Vector       motion(begin);
    const double           furthest = parameters.max_step_displacement > 0.
                                        ? parameters.max_step_displacement
                                        : 0.01 * parameters.max_displacement;
    TimeIntegrator::Vector velocity(integrator.state().v);
    double                 previous = integrator.account().kinetic;
    StepSequence           sequence({"time", "s", 1e-6 * parameters.step},
                          integrator.state().time,
                          parameters.continued_step > 0.
                                      ? parameters.continued_step
                                      : parameters.step);
    while (report.n_steps < parameters.max_steps)
    {
      if (before_step)
        before_step(sequence.length());
      StepRecord record;
      sequence.advance(
        std::numeric_limits<double>::infinity(),
        [&](const StepTrial &trial) {
          return try_to_relax(
            integrator, parameters, trial.length, furthest, record.report);
        },
        record);
      ++report.n_steps;
      report.n_iterations +=
        record.report.n_iterations + record.n_lost_iterations;
      if (after_step)
        after_step(record);
      if (parameters.max_displacement > 0.)
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
      const double kinetic = integrator.account().kinetic;
      // twice the kinetic energy is (v, M v)
      const bool turns_back =
        integrator.model().layout().mass->matrix_scalar_product(
          velocity, integrator.state().v) < -std::sqrt(kinetic * previous);
      if (kinetic <= previous || turns_back)
      {
        integrator.stop_motion();
        report.imbalance = integrator.account().imbalance;
        if (report.imbalance <= parameters.tolerance)
          return report;
      }
      previous = integrator.account().kinetic;
      velocity = integrator.state().v;
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
