#include "rejected_input.h"

using namespace rejected_input;

// The search for the factor of safety.
namespace
{
  const std::vector<std::string> searched =
    touching +
    std::vector<std::string>{"Model/Analysis=safety factor",
                             "Materials/rock/Density=1",
                             "Contact/Friction angle=30",
                             "Relaxation/Step=0.1",
                             "Safety factor/Largest displacement=0.01"};


  TEST(BadInput, SafetyFactor)
  {
    const auto rejects = [](const std::string              &entry,
                            const std::vector<std::string> &words) {
      expect_rejected_with(searched, entry, words);
    };
    rejects("Safety factor/First=0", {"'First'", "Lowest", "Highest"});
    rejects("Safety factor/First=100", {"'First'", "100", "Highest"});
    rejects("Safety factor/Ratio=1", {"'Ratio'", "1", "above 1"});
    rejects("Safety factor/Lowest=0", {"'Lowest'", "positive"});
    rejects("Safety factor/Highest=0.01", {"'Highest'", "0.01", "Lowest"});
    rejects("Safety factor/Tolerance=0", {"'Tolerance'", "0", "0.01"});
    rejects("Safety factor/Largest displacement=0",
            {"Largest displacement", "0", "block"});
    rejects("Safety factor/Start=loose", {"loose", "settled"});
    rejects("Safety factor/Ratio=-2", {"Ratio", "-2"});
    rejects("Relaxation/Step=0", {"Relaxation/Step", "0 s"});
    rejects("Materials/rock/Density=0", {"density", "safety factor"});
    rejects("Contact/Friction angle=0", {"strength", "friction"});
    rejects("Obstacles/floor/Release time=1",
            {"floor", "Release time", "safety factor"});
    rejects("Obstacles/floor/Displacement=0; t",
            {"floor", "Displacement", "safety factor"});
    rejects("Output/Fields every=2", {"Fields every", "safety factor"});
    rejects("Time/End time=1", {"End time", "safety factor"});
  }


  TEST(BadInput, SafetyFactorOfOtherAnalyses)
  {
    for (const char *key : {"First", "Ratio", "Largest displacement"})
      expect_rejected_override(std::string("Safety factor/") + key + "=2",
                               {key, "static", "Model/Analysis"});
    expect_rejected_override("Safety factor/Start=settled",
                             {"Start", "static", "safety factor"});
    expect_rejected_with({"Model/Analysis=safety factor",
                          "Materials/rock/Density=1",
                          "Relaxation/Step=0.1"},
                         "Safety factor/Largest displacement=0.01",
                         {"without contact", "strength", "Enforcement"});
    expect_rejected_override("Model/Analysis=safety factor",
                             {"Relaxation/Step"});
  }
} // namespace
