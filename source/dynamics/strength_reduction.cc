#include <nmm/base/exceptions.h>
#include <nmm/dynamics/strength_reduction.h>
#include <nmm/materials/material.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace NMM
{
  namespace
  {
    std::shared_ptr<const ContactLaw>
    reduce(const ContactLaw &law, const double factor)
    {
      std::unique_ptr<ContactLaw> result = law.clone();
      result->reduce_strength(factor);
      return result;
    }


    /// Materials whose laws are changed by @p change.
    std::vector<Material>
    change_laws(const std::vector<Material>              &materials,
                const std::function<void(MaterialLaw &)> &change)
    {
      std::vector<Material> result = materials;
      for (Material &material : result)
      {
        std::unique_ptr<MaterialLaw> law = material.law->clone();
        change(*law);
        material.law = std::move(law);
      }
      return result;
    }


    void
    check_value(const bool         is_good,
                const std::string &name,
                const double       value,
                const std::string &remedy)
    {
      AssertThrow(is_good,
                  InputError(name + " is " + std::to_string(value),
                             "the search for the factor of safety",
                             remedy));
    }


    void
    check_factor(const double factor)
    {
      check_value(factor > 0. && std::isfinite(factor),
                  "the factor that strength is divided by",
                  factor,
                  "give a positive number");
    }
  } // namespace


  ContactParameters
  reduce_strength(const ContactParameters &parameters, const double factor)
  {
    check_factor(factor);
    ContactParameters result = parameters;
    result.law               = reduce(*result.law, factor);
    for (ContactPair &pair : result.pairs)
      pair.law = reduce(*pair.law, factor);
    return result;
  }


  std::vector<Material>
  reduce_strength(const std::vector<Material> &materials, const double factor)
  {
    check_factor(factor);
    return change_laws(materials, [factor](MaterialLaw &law) {
      law.reduce_strength(factor);
    });
  }


  std::vector<Material>
  associate_flow(const std::vector<Material> &materials)
  {
    return change_laws(materials,
                       [](MaterialLaw &law) { law.associate_flow(); });
  }


  StrengthTrial
  try_to_stand(TimeIntegrator                                &integrator,
               const RelaxationParameters                    &parameters,
               const double                                   factor,
               const std::function<void(const StepRecord &)> &after_step)
  {
    using Outcome = StrengthTrial::Outcome;
    StrengthTrial result;
    result.factor                       = factor;
    const TimeIntegrator::Vector begin  = integrator.state().u;
    const auto                   record = [&](const StepRecord &step) {
      ++result.n_steps;
      result.n_iterations += step.report.n_iterations + step.n_lost_iterations;
      if (after_step)
        after_step(step);
    };
    try
    {
      const RelaxationReport report = relax(integrator, parameters, record);
      result.outcome = report.moves_away ? Outcome::moves : Outcome::stands;
      if (report.moves_away)
        result.reason = "something moves by more than " +
                        std::to_string(parameters.max_displacement) + " m";
    }
    catch (const NumericalFailure &failure)
    {
      result.reason = failure.message();
      if (result.n_steps < parameters.max_steps)
        result.outcome = Outcome::fails;
    }
    result.imbalance = integrator.account().imbalance;
    TimeIntegrator::Vector motion(integrator.state().u);
    motion -= begin;
    result.displacement = motion.linfty_norm();
    return result;
  }


  void
  SafetyFactorParameters::check() const
  {
    check_value(lowest > 0.,
                "the lowest factor",
                lowest,
                "give a positive one");
    check_value(first >= lowest && first <= highest,
                "the first factor",
                first,
                "give one between the lowest and the highest one");
    check_value(ratio > 1.,
                "the ratio of factors",
                ratio,
                "give a number above 1, such as 1.5");
    check_value(tolerance > 0.,
                "the tolerance",
                tolerance,
                "give a positive one, such as 0.01");
  }


  double
  SafetyFactor::value() const
  {
    if (stands_at == 0.)
      return std::isfinite(moves_at) ? moves_at
                                     : std::numeric_limits<double>::quiet_NaN();
    return std::isfinite(moves_at) ? std::sqrt(stands_at * moves_at)
                                   : stands_at;
  }


  SafetyFactor
  find_safety_factor(
    const std::function<StrengthTrial(double factor)> &try_factor,
    const SafetyFactorParameters                      &parameters)
  {
    parameters.check();
    SafetyFactor result;
    double       factor = parameters.first;
    while (true)
    {
      const StrengthTrial trial = try_factor(factor);
      result.trials.push_back(trial);
      if (trial.fails())
        return result;
      (trial.stands() ? result.stands_at : result.moves_at) = factor;
      const bool is_bracketed =
        result.stands_at > 0. && std::isfinite(result.moves_at);
      if (is_bracketed)
      {
        if (result.moves_at <= (1. + parameters.tolerance) * result.stands_at)
          return result;
        factor = std::sqrt(result.stands_at * result.moves_at);
        continue;
      }
      const double next =
        std::min(parameters.highest,
                 std::max(parameters.lowest,
                          trial.stands() ? factor * parameters.ratio
                                         : factor / parameters.ratio));
      if (next == factor)
        return result;
      factor = next;
    }
  }
} // namespace NMM
