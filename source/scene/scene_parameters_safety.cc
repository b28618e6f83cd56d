#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <cmath>
#include <scene/parsing.h>

// This file has the parameters of the search for the factor of safety.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<SafetyFactorSectionParameters::Start> trial_starts = {
      {"unstressed", SafetyFactorSectionParameters::Start::unstressed},
      {"settled", SafetyFactorSectionParameters::Start::settled}};
    const Words<ReducedStrength> what_is_reduced = {
      {"both", ReducedStrength::both},
      {"joints", ReducedStrength::joints},
      {"blocks", ReducedStrength::blocks}};
    const Words<FlowRule> flow_rules = {{"associated", FlowRule::associated},
                                        {"given", FlowRule::given}};
  } // namespace


  void
  SafetyFactorSectionParameters::list_entries(Entries &entries)
  {
    const auto number = [&](const char *key, double &value, const char *help) {
      entries.add(key, value, Patterns::Double(0), help);
    };
    number("First", search.first, "Factor that is tried first [-].");
    number("Ratio",
           search.ratio,
           "Factors differ by this until one is known that stands and one that "
           "moves, > 1 [-].");
    number("Lowest", search.lowest, "No factor below is tried, > 0 [-].");
    number("Highest", search.highest, "No factor above is tried [-].");
    number("Tolerance",
           search.tolerance,
           "Ratio of both ends of the bracket, less 1, > 0 [-].");
    number("Largest displacement",
           max_displacement,
           "What moves further than this in a trial does not stand [m]; must "
           "be set: more than blocks settle, less than they are wide.");
    entries.add(
      "Start",
      start,
      trial_starts,
      "What each trial starts from. unstressed: blocks without displacement "
      "are put under load with reduced strength; settled: they come to rest "
      "with full strength first, and then lose it.");
    entries.add("Reduce",
                reduced,
                what_is_reduced,
                "What loses strength: joints (all laws of contact), blocks "
                "(all materials that yield), or both.");
    entries.add("Flow rule",
                flow_rule,
                flow_rules,
                "The flow of materials that yield in the trials. associated: "
                "their dilation angle is their friction angle, which makes "
                "the factor that of limit analysis; given: their own.");
  }


  void
  SafetyFactorSectionParameters::check(const Analysis analysis) const
  {
    if (analysis != Analysis::safety_factor)
    {
      expect_defaults("Safety factor",
                      *this,
                      "a " + to_string(analysis) + " analysis",
                      "remove it, or set 'Model/Analysis = safety factor'");
      return;
    }
    const auto check = [](const bool         is_good,
                          const std::string &key,
                          const double       value,
                          const std::string &remedy) {
      AssertThrow(is_good && std::isfinite(value),
                  InputError("'" + key + "' is " + to_text(value),
                             "parameter 'Safety factor/" + key + "'",
                             remedy));
    };
    check(search.lowest > 0.,
          "Lowest",
          search.lowest,
          "give a positive factor");
    check(search.highest >= search.lowest,
          "Highest",
          search.highest,
          "choose it no less than 'Lowest'");
    check(search.first >= search.lowest && search.first <= search.highest,
          "First",
          search.first,
          "choose it between 'Lowest' and 'Highest'");
    check(search.ratio > 1.,
          "Ratio",
          search.ratio,
          "choose it above 1, such as 1.5");
    check(search.tolerance > 0.,
          "Tolerance",
          search.tolerance,
          "give a positive number, such as 0.01");
    check(max_displacement > 0.,
          "Largest displacement",
          max_displacement,
          "set the way that counts as motion, a hundredth of a block or so");
  }
} // namespace NMM
