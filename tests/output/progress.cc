#include <nmm/output/picture.h>
#include <nmm/output/progress.h>

#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

using namespace NMM;

namespace
{
  TEST(Progress, LinesAreCutToTheirWidth)
  {
    EXPECT_EQ(cut_to_width("1234567890", 10), "1234567890");
    EXPECT_EQ(cut_to_width("12345678901", 10), "123456 ...");
    EXPECT_EQ(cut_to_width("12345", 3), "123");
  }


  // No line of a terminal, here of 80 characters, is cut within a word.
  TEST(Progress, MessagesAreWrappedOnATerminal)
  {
    if (isatty(STDOUT_FILENO) != 0)
      GTEST_SKIP() << "this terminal may have another width";
    const std::string text =
      "  contact: 12 faces of 3 blocks; stiffness 1e12 Pa/m, friction 35 "
      "degrees, cohesion 2e4 Pa, reach 0.02 m, points 3 a face";
    std::ostringstream plain, terminal;
    Progress(plain, false, MPI_COMM_SELF).message(text);
    EXPECT_EQ(plain.str(), text + "\n");
    Progress(terminal, true, MPI_COMM_SELF).message(text);
    EXPECT_EQ(
      terminal.str(),
      "\r\033[K  contact: 12 faces of 3 blocks; stiffness 1e12 Pa/m, "
      "friction 35 degrees,\n    cohesion 2e4 Pa, reach 0.02 m, points 3 "
      "a face\n");
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
