#include "cases.h"
#include "expected_values.h"
#include "run_in_process.h"
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
  namespace fs = std::filesystem;

  /// A case on the number of ranks that it asks for.
  class SceneCase : public testing::TestWithParam<std::string>
  {
  };


  TEST_P(SceneCase, GivesTheExpectedValues)
  {
    const Case test_case = read_case(GetParam());
    ASSERT_FALSE(test_case.rows.empty() && test_case.says.empty());
    // This program is run on one rank and on two.
    ASSERT_LE(test_case.n_ranks, 2u);
    if (test_case.n_ranks != n_ranks())
      GTEST_SKIP() << "on " << test_case.n_ranks << " rank(s)";
#ifdef DEBUG
    if (test_case.is_long)
      GTEST_SKIP() << "only in Release";
#endif

    const std::string        output    = fresh_output_dir(GetParam());
    std::vector<std::string> arguments = test_case.arguments;
    arguments.insert(arguments.end(), {"--output", output, test_case.scene});
    const DriverResult result = run_in_process(arguments);
    ASSERT_EQ(result.exit_code, test_case.exit_code) << result.output;
    // Messages and files are those of the first rank.
    if (!is_first_rank())
      return;
    for (const std::string &text : test_case.says)
      EXPECT_NE(result.output.find(text), std::string::npos)
        << "not said: " << text << '\n'
        << result.output;

    if (test_case.rows.empty())
      return;
    const auto values = read_results(output);
    for (const ExpectedValue &row : test_case.rows)
    {
      const auto entry = values.find(row.name);
      ASSERT_TRUE(entry != values.end()) << "no value " << row.name;
      EXPECT_NEAR(entry->second, row.value, row.tolerance()) << row.name;
    }
  }


  INSTANTIATE_TEST_SUITE_P(MPI,
                           SceneCase,
                           testing::ValuesIn(case_names()),
                           [](const testing::TestParamInfo<std::string> &info) {
                             std::string name = info.param;
                             std::replace_if(
                               name.begin(),
                               name.end(),
                               [](const char c) {
                                 return std::isalnum(c) == 0;
                               },
                               '_');
                             return name;
                           });


  TEST(Scenes, EveryShippedSceneIsACase)
  {
    std::string all;
    for (const std::string &name : case_names())
      all += read_case(name).scene + "\n";
    const fs::path shipped =
      fs::path(NMM_SOURCE_DIR) / "applications" / "nmm" / "scenes";
    for (const auto &entry : fs::directory_iterator(shipped))
    {
      const std::string extension = entry.path().extension().string();
      if (extension == ".prm" || extension == ".json")
      {
        EXPECT_NE(all.find("/" + entry.path().filename().string()),
                  std::string::npos)
          << entry.path() << " has no expected.csv in tests/scenes";
      }
    }
  }
} // namespace
