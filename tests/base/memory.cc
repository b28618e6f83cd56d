#include <nmm/base/exceptions.h>
#include <nmm/base/memory.h>

#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/resource.h>

using namespace NMM;

namespace
{
  /// Address space in use [bytes].
  double
  used()
  {
    std::ifstream in("/proc/self/statm");
    double        pages = 0.;
    in >> pages;
    return pages * 4096.;
  }


  TEST(AvailableMemory, IsThatOfTheMachineOrALimit)
  {
    const AvailableMemory all = available_memory(1u);
    EXPECT_GT(all.bytes, 1e6);
    EXPECT_LT(all.bytes, 1e15);
    // Memory of the machine changes meanwhile, by less than a tenth.
    EXPECT_LT(available_memory(4u).bytes, 0.5 * all.bytes);

    rlimit limit;
    getrlimit(RLIMIT_AS, &limit);
    const rlim_t before = limit.rlim_cur;
    limit.rlim_cur      = static_cast<rlim_t>(used() + 1e8);
    setrlimit(RLIMIT_AS, &limit);
    const AvailableMemory little = available_memory(1u);
    limit.rlim_cur               = before;
    setrlimit(RLIMIT_AS, &limit);
    EXPECT_LE(little.bytes, 1.1e8);
    EXPECT_GE(little.bytes, 0.5e8);
    EXPECT_NE(little.bound.find("address space"), std::string::npos);
  }


  TEST(AvailableMemory, MessageSaysHowMuchAndWhatWouldFit)
  {
    const AvailableMemory available{2e9, "the machine"};
    const auto            remedy = [](const double excess) {
      return "divide by " + std::to_string(static_cast<int>(excess));
    };
    EXPECT_NO_THROW(require_memory(1e9, available, "a", "b", remedy));
    try
    {
      require_memory(6e9, available, "many cells", "the mesh", remedy);
      FAIL() << "nothing was thrown";
    }
    catch (const InputError &error)
    {
      EXPECT_EQ(error.message(),
                "about 6 GB of memory are needed for many cells, and 2 GB are "
                "left by the machine, at the mesh: divide by 3");
    }
  }
} // namespace
