#include <nmm/output/picture.h>
#include <nmm/output/progress.h>

#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;

namespace
{
  TEST(Progress, LinesAreCutToTheirWidth)
  {
    EXPECT_EQ(cut_to_width("1234567890", 10), "1234567890");
    EXPECT_EQ(cut_to_width("12345678901", 10), "123456 ...");
    EXPECT_EQ(cut_to_width("12345", 3), "123");
  }


  TEST(Progress, NoticesThatDifferInNumbersAreOne)
  {
    const std::vector<std::string> notices = {"joint 'J1' ends at (0.5, 1e-3)",
                                              "a hole",
                                              "joint 'J2' ends at (-1, 2)",
                                              "joint 'J31' ends at (0, 0)"};
    const auto                     merged  = merge_alike(notices);
    ASSERT_EQ(merged.size(), 2u);
    EXPECT_EQ(merged[0],
              notices[0] + " (and 2 more that differ in numbers only)");
    EXPECT_EQ(merged[1], "a hole");
  }


  TEST(Progress, AStageWithinAnotherIsPartOfIt)
  {
    std::ostringstream out;
    Progress           progress(out, false, MPI_COMM_SELF);
    {
      const Progress::Stage whole(progress, "whole");
      {
        const Progress::Stage part(progress, "part");
      }
    }
    {
      const Progress::Stage next(progress, "next");
    }
    ASSERT_EQ(progress.times().size(), 2u);
    EXPECT_EQ(progress.times()[0].first, "whole");
    EXPECT_EQ(progress.times()[1].first, "next");
    EXPECT_EQ(out.str().find("part"), std::string::npos);
  }


  TEST(DeformationScale, DoesNotCloseHoles)
  {
    EXPECT_EQ(choose_deformation_scale(1e-3, 100.), 5000.);
    // 0.1 m a side at most, of 1 m
    EXPECT_EQ(choose_deformation_scale(1e-3, 100., 1.), 100.);
  }
} // namespace
