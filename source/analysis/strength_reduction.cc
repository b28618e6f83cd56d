#include <nmm/analysis/strength_reduction.h>

#include <algorithm>
#include <utility>

namespace NMM
{
  StrengthReduction::StrengthReduction(const Solid                &solid,
                                       const ElasticityProblem    &problem,
                                       StrengthReductionParameters given,
                                       ContactModel               *contact)
    : problem(&problem)
    , parameters(std::move(given))
    , contact(contact)
    , equations(solid, problem, parameters.motion, contact)
  {
  }


  void
  StrengthReduction::start_from(Start state)
  {
    begin     = std::move(state);
    has_start = true;
  }


  ForceTerm::Vector
  StrengthReduction::start() const
  {
    return has_start ? begin.displacement : equations.zero();
  }


  void
  StrengthReduction::set_strength(const double factor)
  {
    InelasticTerms *const terms = equations.solid_term().inelastic_terms();
    if (terms == nullptr)
      return;
    std::vector<Material> materials = problem->materials;
    if (parameters.flow_rule == FlowRule::associated)
      materials = associate_flow(materials);
    if (parameters.reduced != ReducedStrength::joints)
      materials = reduce_strength(materials, factor);
    terms->set_materials(materials);
  }


  StrengthTrial
  StrengthReduction::try_factor(const double factor)
  {
    equations.release_contact();
    if (contact != nullptr)
      contact->begin_anew(
        parameters.reduced == ReducedStrength::blocks ? 1. : factor);
    equations.begin_anew();
    set_strength(factor);
    InelasticTerms *const terms      = equations.solid_term().inelastic_terms();
    TimeIntegrator       &integrator = equations.integrator();
    if (has_start)
    {
      if (contact != nullptr)
        equations.contact_account()->continue_from(begin.contact);
      if (terms != nullptr)
        terms->restore_internal_state(begin.materials);
      equations.further_terms().restore(begin.terms);
      integrator.initialize(begin.displacement, equations.zero());
      if (!begin.removed_blocks.empty())
        integrator.drop_blocks(begin.removed_blocks);
    }
    StrengthTrial trial = try_to_stand(integrator,
                                       parameters.trial,
                                       factor,
                                       [&](const StepRecord &step) {
                                         if (after_step)
                                           after_step(factor, step);
                                       });
    if (after_trial)
      after_trial(trial);
    if (tells_more(trial))
    {
      best.trial        = trial;
      best.displacement = integrator.state().u;
      if (contact != nullptr)
        best.contact = contact->last_state();
      if (terms != nullptr)
        best.materials = terms->internal_state();
    }
    trials.push_back(trial);
    return trial;
  }


  bool
  StrengthReduction::tells_more(const StrengthTrial &trial) const
  {
    if (trials.empty() || trial.fails())
      return true;
    if (trial.outcome != best.trial.outcome)
      return best.trial.stands();
    return trial.stands() ? trial.factor > best.trial.factor
                          : trial.factor < best.trial.factor;
  }


  SafetyFactor
  StrengthReduction::find()
  {
    return find_safety_factor(
      [this](const double factor) { return try_factor(factor); },
      parameters.search);
  }


  SafetyFactor
  StrengthReduction::so_far() const
  {
    SafetyFactor result;
    result.trials = trials;
    for (const StrengthTrial &trial : trials)
      if (trial.stands())
        result.stands_at = std::max(result.stands_at, trial.factor);
      else if (!trial.fails())
        result.moves_at = std::min(result.moves_at, trial.factor);
    return result;
  }


  void
  StrengthReduction::show()
  {
    if (contact != nullptr)
      contact->show_state(best.contact);
    if (InelasticTerms *const terms = equations.solid_term().inelastic_terms())
    {
      set_strength(best.trial.factor);
      terms->restore_internal_state(best.materials);
    }
  }
} // namespace NMM
