#ifndef nmm_tests_scenes_rejected_input_h
#define nmm_tests_scenes_rejected_input_h

#include "arguments.h"
#include "cases.h"
#include "run_in_process.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// Everything a user can get wrong ends with exit code 2, a message that names what
// is wrong, where and what to do, and no output folder.
namespace rejected_input
{
  const std::string base_scene = cases_dir + "base.prm";

  const std::string square =
    "boundary name=square material=rock POLYGON ((0 0, 1 0, 1 1, 0 1))";


  /// On several ranks: all have that exit code, the first one has the message.
  inline void
  expect_rejected(std::vector<std::string>        arguments,
                  const std::vector<std::string> &words)
  {
    const std::string output = NMM_TEST_OUTPUT_DIR "/rejected";
    std::filesystem::remove_all(output);
    arguments.insert(arguments.begin(), {"--output", output});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    if (!is_first_rank())
    {
      EXPECT_EQ(result.output, "");
      return;
    }
    for (const std::string &word : words)
      EXPECT_NE(result.output.find(word), std::string::npos)
        << "'" << word << "' is missing in: " << result.output;
    EXPECT_FALSE(std::filesystem::exists(output)) << result.output;
  }


  inline void
  expect_rejected_override(const std::string              &override,
                           const std::vector<std::string> &words)
  {
    SCOPED_TRACE(override);
    expect_rejected({"--set", override, base_scene}, words);
  }


  inline void
  expect_rejected_geometry(const std::string              &records,
                           const std::vector<std::string> &words)
  {
    expect_rejected_override("Geometry/Text=" + records, words);
  }


  /// A scene file with the lines of the base scene and @p more.
  inline std::string
  write_scene(const std::string &name, const std::string &text)
  {
    const std::string file_name = NMM_TEST_OUTPUT_DIR "/" + name;
    std::ofstream(file_name) << text;
    return file_name;
  }


  const std::vector<std::string> dynamic = {"Model/Analysis=dynamic",
                                            "Materials/rock/Density=1",
                                            "Time/End time=1",
                                            "Time/Initial step=0.1"};

  const std::vector<std::string> touching = {
    "Contact/Enforcement=penalty",
    "Obstacles/Names=floor",
    "Obstacles/floor/Shape=LINESTRING (2 0, -1 0)"};


  inline void
  expect_rejected_with(std::vector<std::string>        settings,
                       const std::string              &override,
                       const std::vector<std::string> &words)
  {
    settings.push_back(override);
    std::vector<std::string> arguments;
    std::string              text;
    for (const std::string &setting : settings)
    {
      arguments.insert(arguments.end(), {"--set", setting});
      text += setting + " ";
    }
    SCOPED_TRACE(text);
    arguments.push_back(base_scene);
    expect_rejected(arguments, words);
  }
} // namespace rejected_input

#endif
