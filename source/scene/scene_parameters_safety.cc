#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <cmath>
#include <scene/parsing.h>

// The search for the factor of safety.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const std::vector<
      std::pair<std::string, SafetyFactorSectionParameters::Start>>
      trial_starts = {
        {"unstressed", SafetyFactorSectionParameters::Start::unstressed},
        {"settled", SafetyFactorSectionParameters::Start::settled}};


    /// Entries that are numbers: key, place and help.
    struct Number
    {
      const char *key;
      double     &value;
      const char *help;
    };


    std::vector<Number>
    numbers(SafetyFactorSectionParameters &section)
    {
      SafetyFactorParameters &search = section.search;
      return {{"First", search.first, "Factor that is tried first [-]."},
              {"Ratio",
               search.ratio,
               "Factors differ by this until one is known that stands and one "
               "that moves, > 1 [-]."},
              {"Lowest", search.lowest, "No factor below is tried, > 0 [-]."},
              {"Highest", search.highest, "No factor above is tried [-]."},
              {"Tolerance",
               search.tolerance,
               "Ratio of both ends of the bracket, less 1, > 0 [-]."},
              {"Largest displacement",
               section.max_displacement,
               "What moves further than this in a trial does not stand [m]; "
               "must be set: more than blocks settle, less than they are "
               "wide."}};
    }
  } // namespace


  void
  SafetyFactorSectionParameters::declare(ParameterHandler &prm)
  {
    SafetyFactorSectionParameters defaults;
    for (const Number &number : numbers(defaults))
      prm.declare_entry(number.key,
                        to_text(number.value),
                        Patterns::Double(0.),
                        number.help);
    prm.declare_entry("Start",
                      "unstressed",
                      selection(trial_starts),
                      "What each trial starts from. unstressed: blocks without "
                      "displacement are put under load with reduced strength; "
                      "settled: they come to rest with full strength first, "
                      "and then lose it.");
  }


  void
  SafetyFactorSectionParameters::parse(ParameterHandler &prm)
  {
    for (const Number &number : numbers(*this))
      number.value = prm.get_double(number.key);
    start = get_selection(prm, "Start", trial_starts);
  }


  void
  SafetyFactorSectionParameters::check(const Analysis analysis) const
  {
    SafetyFactorSectionParameters given = *this, defaults;
    if (analysis != Analysis::safety_factor)
    {
      const std::string by = "a " + to_string(analysis) + " analysis";
      const std::string remedy =
        "remove it, or set 'Model/Analysis = safety factor'";
      const std::vector<Number> values = numbers(given),
                                others = numbers(defaults);
      for (unsigned int i = 0; i < values.size(); ++i)
        expect_default("Safety factor",
                       values[i].key,
                       values[i].value,
                       others[i].value,
                       by,
                       remedy);
      AssertThrow(start == Start::unstressed,
                  InputError("a start would not be used by " + by,
                             "parameter 'Safety factor/Start'",
                             remedy));
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
