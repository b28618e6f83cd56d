#include <nmm/base/exceptions.h>

#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;

TEST(UserError, MessageNamesWhatWhereAndRemedy)
{
  const InputError error("the joint has no length",
                         "joint 'J1', (1, 2)",
                         "give it two different ends");
  EXPECT_EQ(error.message(),
            "the joint has no length, at joint 'J1', (1, 2): give it two "
            "different ends");

  std::ostringstream out;
  error.print_info(out);
  EXPECT_EQ(out.str(), error.message() + "\n");
}


TEST(UserError, EmptyPartsLeaveNoPunctuation)
{
  EXPECT_EQ(InputError("no boundary", "", "").message(), "no boundary");
  EXPECT_EQ(InputError("no boundary", "", "add one").message(),
            "no boundary: add one");
  EXPECT_EQ(InputError("no boundary", "scene 'a'", "").message(),
            "no boundary, at scene 'a'");
}


TEST(UserError, AssertThrowKeepsTheType)
{
  const auto fail = [](const bool input) {
    if (input)
      AssertThrow(false, InputError("a", "b", "c"));
    AssertThrow(false, NumericalFailure("a", "b", "c"));
  };
  EXPECT_THROW(fail(true), InputError);
  EXPECT_THROW(fail(false), NumericalFailure);

  // For developers what() adds where it was thrown.
  try
  {
    fail(true);
    FAIL() << "nothing was thrown";
  }
  catch (const UserError &error)
  {
    EXPECT_EQ(error.message(), "a, at b: c");
    EXPECT_NE(std::string(error.what()).find("a, at b: c"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("exceptions.cc"),
              std::string::npos);
  }
}


TEST(UserError, PointsKeepEnoughDigits)
{
  EXPECT_EQ(to_string(dealii::Point<2>(0.1, -2.)), "(0.1, -2)");
  EXPECT_EQ(to_string(dealii::Point<2>(1.00000000001, 0.)),
            "(1.00000000001, 0)");
}
