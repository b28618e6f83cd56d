#include "run_in_process.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// Excavation in stages, with contact.
namespace
{
  using Values = std::map<std::string, double>;


  /// The last row of history.csv of the tunnel in jointed rock, with these further arguments.
  Values
  last_state(const std::vector<std::string> &further)
  {
    const std::string        folder    = NMM_TEST_OUTPUT_DIR "/staged-tunnel";
    std::vector<std::string> arguments = {"--output", folder};
    arguments.insert(arguments.end(), further.begin(), further.end());
    arguments.push_back(NMM_SOURCE_DIR "/tests/scenes/staged-tunnel/scene.prm");
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::ifstream in(folder + "/history.csv");
    std::string   names, row;
    std::getline(in, names);
    for (std::string line; std::getline(in, line);)
      row = line;
    std::istringstream columns(names), cells(row);
    Values             values;
    for (std::string name, cell;
         std::getline(columns, name, ',') && std::getline(cells, cell, ',');)
      values[name] = std::atof(cell.c_str());
    return values;
  }


  /// The same with a stage that removes the tunnel, and one that releases the rest of its tractions.
  std::vector<std::string>
  two_stages(const std::string &share)
  {
    return {"--set",
            "Stages/Names=tunnel, rest",
            "--set",
            "Stages/tunnel/Remove regions=tunnel",
            "--set",
            "Stages/tunnel/Relaxation=" + share};
  }


  // A tunnel that is there from the beginning releases the stress on its wall with the load factor.
  // That is the same as an excavation of the stressed mass in one stage of as many steps: joints begin
  // with the stress, slide and open alike.
  TEST(Stages, ExcavationEqualsATunnelFromTheBeginning)
  {
    const Values from_the_beginning =
      last_state({"--set", "Regions/tunnel/Use=excavation"});
    const Values in_stages =
      last_state({"--set",
                  "Stages/Names=tunnel",
                  "--set",
                  "Stages/tunnel/Remove regions=tunnel"});
    EXPECT_EQ(in_stages.at("load_factor"), 2.);
    // Where joints meet the wall, contact points are others, since faces end there.
    for (const char *const name :
         {"side_x", "side_y", "corner_x", "corner_y", "max_displacement"})
      EXPECT_NEAR(in_stages.at(name),
                  from_the_beginning.at(name),
                  1e-4 * from_the_beginning.at("max_displacement"))
        << name;
    EXPECT_GT(in_stages.at("contact_slip"), 0.);
  }


  // Half of the tractions, and then all: steps of the same lengths take the same way.
  TEST(Stages, SharesTakeTheSameWayWithFriction)
  {
    std::vector<std::string> at_once = {"--set",
                                        "Stages/Names=tunnel",
                                        "--set",
                                        "Stages/tunnel/Remove regions=tunnel",
                                        "--set",
                                        "Load steps/Number of steps=4"};
    std::vector<std::string> halves  = two_stages("0.5");
    halves.push_back("--set");
    halves.push_back("Load steps/Number of steps=2");
    const Values one = last_state(at_once), two = last_state(halves);
    EXPECT_EQ(two.at("load_factor"), 3.);
    for (const char *const name : {"side_x", "corner_y", "max_displacement"})
      EXPECT_NEAR(two.at(name), one.at(name), 1e-6 * one.at("max_displacement"))
        << name;
  }


  // Fields of a motion have the cells that are left after the excavation.
  TEST(Stages, WhatIsRemovedIsNotShownInMotion)
  {
    const auto n_cells = [](const std::vector<std::string> &further) {
      std::vector<std::string> arguments = {"--set",
                                            "Stages/Names=tunnel",
                                            "--set",
                                            "Stages/tunnel/Remove "
                                            "regions=tunnel"};
      arguments.insert(arguments.end(), further.begin(), further.end());
      (void)last_state(arguments);
      std::ifstream     in(NMM_TEST_OUTPUT_DIR "/staged-tunnel/fields.vtu");
      const std::string text((std::istreambuf_iterator<char>(in)),
                             std::istreambuf_iterator<char>());
      const std::string key = "NumberOfCells=\"";
      const std::size_t at  = text.find(key);
      EXPECT_NE(at, std::string::npos);
      return std::atoi(text.c_str() + at + key.size());
    };
    const int at_rest = n_cells({});
    EXPECT_GT(at_rest, 0);
    EXPECT_EQ(n_cells({"--set",
                       "Model/Analysis=dynamic",
                       "--set",
                       "Materials/rock/Density=2500",
                       "--set",
                       "Time/End time=2e-4",
                       "--set",
                       "Time/Initial step=1e-4"}),
              at_rest);
  }
} // namespace
