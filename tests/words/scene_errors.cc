// tests/performance/scenes.csv and its table in doc/accuracy.md, as committed.

#include <algorithm>
#include <gtest/gtest.h>
#include <scenes/expected_values.h>
#include <scenes/table.h>

namespace
{
  TEST(SceneErrors, TableAndPageHaveEachSceneWithinWhatIsAllowed)
  {
    auto columns = read_columns(NMM_SOURCE_DIR "/tests/performance/scenes.csv");
    for (const char *name : {"scene",
                             "unknowns",
                             "elements",
                             "seconds",
                             "name",
                             "value",
                             "reference",
                             "error",
                             "allowed",
                             "source"})
      ASSERT_EQ(columns.count(name), 1U) << name;

    EXPECT_EQ(columns.at("scene"), fracture_case_names())
      << "./setup.sh bench scenes measures anew";

    const std::string page = read_text(NMM_SOURCE_DIR "/doc/accuracy.md");
    for (std::size_t i = 0; i < columns.at("scene").size(); ++i)
    {
      const std::string &name = columns.at("scene")[i];
      SCOPED_TRACE(name);
      const double error   = std::stod(columns.at("error")[i]);
      const double allowed = std::stod(columns.at("allowed")[i]);
      EXPECT_LE(error, allowed);
      EXPECT_GT(std::stod(columns.at("seconds")[i]), 0.);
      EXPECT_NE(page.find("| `" + name + "` | " + columns.at("unknowns")[i] +
                          " | "),
                std::string::npos);

      // the test allows that value no more by now
      const std::vector<ExpectedValue> rows = read_case(name).rows;
      const auto                       row =
        std::find_if(rows.begin(), rows.end(), [&](const ExpectedValue &r) {
          return r.name == columns.at("name")[i];
        });
      ASSERT_NE(row, rows.end());
      EXPECT_NEAR(allowed, row->tolerance() / row->scale(), 1e-5 * allowed);
    }
  }
} // namespace
