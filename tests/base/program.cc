#include <nmm/base/program.h>

#include <cerrno>
#include <filesystem>
#include <gtest/gtest.h>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

using namespace NMM;

namespace
{
  ProgramEnd
  end_after(const std::function<void()> &action, const bool has_output)
  {
    try
    {
      action();
    }
    catch (...)
    {
      return explain_exception(has_output);
    }
    return {ExitCode::success, ""};
  }


  // Exit code 2 promises that nothing has been written.
  TEST(ExplainException, TellsInputFromFailuresAndFromMistakes)
  {
    struct Case
    {
      std::function<void()> action;
      ExitCode              before, after;
      std::string           word;
    };
    const ExitCode input          = ExitCode::input_error,
                   failure        = ExitCode::numerical_failure,
                   mistake        = ExitCode::internal_error;
    const std::vector<Case> cases = {
      {[]() { throw InputError("wrong", "here", "mend it"); },
       input,
       failure,
       "wrong, at here: mend it"},
      {[]() { throw NumericalFailure("no rest", "", ""); },
       failure,
       failure,
       "no rest"},
      {[]() { throw OutputFailure("full", "a.csv", "make room"); },
       failure,
       failure,
       "a.csv"},
      {[]() { throw std::bad_alloc(); }, input, failure, "memory"},
      {[]() {
         std::vector<double> vector;
         vector.reserve(vector.max_size() + 1);
       },
       input,
       failure,
       "memory"},
      {[]() { std::filesystem::create_directories("/proc/no-such/folder"); },
       input,
       failure,
       "/proc/no-such"},
      {[]() { throw std::runtime_error("a mistake"); },
       mistake,
       mistake,
       "internal error: a mistake"},
      {[]() { throw 1; }, mistake, mistake, "internal error"}};
    for (const Case &c : cases)
      for (const bool has_output : {false, true})
      {
        const ProgramEnd end = end_after(c.action, has_output);
        EXPECT_EQ(static_cast<int>(end.code),
                  static_cast<int>(has_output ? c.after : c.before))
          << end.message;
        EXPECT_NE(end.message.find(c.word), std::string::npos) << end.message;
      }
  }


  TEST(OutputFailure, GivesTheReasonOfTheSystem)
  {
    errno = ENOSPC;
    const OutputFailure error("a/b.csv");
    EXPECT_NE(error.message().find("No space left"), std::string::npos);
    EXPECT_NE(error.message().find("a/b.csv"), std::string::npos);
  }


  TEST(OnFirstRank, MPIAllRanksThrow)
  {
    EXPECT_THROW(on_first_rank(MPI_COMM_WORLD,
                               []() { throw InputError("wrong", "", ""); }),
                 InputError);
    EXPECT_THROW(on_first_rank(MPI_COMM_WORLD,
                               []() {
                                 throw NumericalFailure("no rest", "", "");
                               }),
                 NumericalFailure);
    EXPECT_NO_THROW(on_first_rank(MPI_COMM_WORLD, []() {}));
    EXPECT_TRUE(all_ranks_arrive(MPI_COMM_WORLD, 60.));
  }
} // namespace
