#include "cases.h"
#include "result_files.h"
#include "run_in_process.h"
#include "table.h"
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

// Checkpoints that someone has changed so that their check sums fit. Whatever is in them, the
// program must say what is wrong, and neither crash nor print an internal error.
namespace
{
  /// Bytes before the contents: a word, a version and the length of the contents.
  constexpr std::size_t head_size = 24;


  std::uint64_t
  fnv(const std::string &bytes)
  {
    std::uint64_t sum = 14695981039346656037ull;
    for (const char byte : bytes)
      sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
    return sum;
  }


  template <typename Value>
  void
  overwrite(std::string &bytes, const std::size_t at, const Value value)
  {
    std::memcpy(&bytes[at], &value, std::min(sizeof(value), bytes.size() - at));
  }


  /// The same file with other contents, in a few places.
  std::string
  forged(std::string bytes, std::mt19937 &generator)
  {
    const auto pick = [&](const std::size_t n) {
      return std::uniform_int_distribution<std::size_t>(0, n - 1)(generator);
    };
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    const std::size_t n_changes = 1 + pick(3);
    for (std::size_t i = 0; i < n_changes; ++i)
    {
      const std::size_t at = head_size + pick(bytes.size() - head_size);
      const std::vector<std::uint32_t> counts = {
        0, 1, 2, 1000, 0x7fffffff, 0xffffffff, std::uint32_t(generator())};
      const std::vector<double> numbers = {0.,
                                           -1.,
                                           1e300,
                                           -1e30,
                                           1e-300,
                                           1e6,
                                           std::nan(""),
                                           std::numeric_limits<double>::max(),
                                           HUGE_VAL};
      switch (pick(6))
      {
        case 0:
          bytes[at] ^= static_cast<char>(1 << pick(8));
          break;
        case 1:
          bytes[at] = static_cast<char>(pick(256));
          break;
        case 2:
          overwrite(bytes, at, counts[pick(counts.size())]);
          break;
        case 3:
          overwrite(bytes, at, std::uint64_t(1) << pick(64));
          break;
        case 4:
          overwrite(bytes, at, numbers[pick(numbers.size())]);
          break;
        default:
          // Bytes are missing, or there are some more.
          if (pick(2) == 0)
            bytes.erase(at, 1 + pick(16));
          else
            bytes.insert(at, 1 + pick(16), '\1');
      }
    }
    overwrite(bytes,
              head_size - sizeof(std::uint64_t),
              std::uint64_t(bytes.size() - head_size + sizeof(std::uint64_t)));
    const std::uint64_t sum = fnv(bytes);
    bytes.append(reinterpret_cast<const char *>(&sum), sizeof(sum));
    return bytes;
  }


  /// Continues @p n forgeries of the checkpoint of a run with the arguments @p first and @p scene,
  /// with the arguments @p further.
  void
  check_forgeries(const std::string &scene,
                  const Arguments   &first,
                  const Arguments   &further,
                  const unsigned int n)
  {
    const unsigned int seed = std::random_device()();
    SCOPED_TRACE(scene + ", seed " + std::to_string(seed));
    std::cout << scene << ": seed " << seed << std::endl;
    std::mt19937      generator(seed);
    const std::string folder = fresh_output_dir("to-be-forged");
    const auto        made   = run_in_process(
      Arguments{
        "-o", folder, "-s", "Output/Checkpoint every=5", cases_dir + scene} +
      first);
    ASSERT_EQ(made.exit_code, 0) << made.output;
    const std::string good      = read_text(folder + "/checkpoint.nmm");
    const std::string file      = folder + "/forged.nmm";
    unsigned int      n_refused = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      std::ofstream(file, std::ios::binary) << forged(good, generator);
      const auto result = run_in_process(
        Arguments{"-o", folder + "-forged", "-r", file, cases_dir + scene} +
        further);
      n_refused += result.exit_code == 2;
      // Numbers that are possible are believed; no other state follows from some of them.
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2 ||
                  result.exit_code == 3)
        << "forgery " << i << ": " << result.exit_code << '\n'
        << result.output;
      EXPECT_EQ(result.output.find("memory ran out"), std::string::npos);
      if (testing::Test::HasFailure())
        break;
    }
    // About half of all forgeries are refused. Of 50, a quarter or less would be by a chance of 1e-4;
    // of five, one or none is in a sixth of all runs.
    constexpr unsigned int enough = 50;
    if (n >= enough)
    {
      EXPECT_GT(n_refused, n / 4);
    }
  }


#ifndef DEBUG
  constexpr unsigned int n_forgeries = 100;
#else
  constexpr unsigned int n_forgeries = 10;
#endif


  TEST(ForgedCheckpoints, OfContactAreRefused)
  {
    check_forgeries("contact-incline/scene.prm",
                    {"-s", "Time/End time=0.05"},
                    {"-s", "Time/End time=0.07"},
                    n_forgeries);
  }


  TEST(ForgedCheckpoints, OfMaterialsThatYieldAreRefused)
  {
    const Arguments yielding{"-s",
                             "Materials/rock/Law=Mohr-Coulomb",
                             "-s",
                             "Materials/rock/Cohesion=1e4",
                             "-s",
                             "Model/Plane state=plane strain",
                             "-s",
                             "Model/Kinematics=small"};
    check_forgeries("contact-incline/scene.prm",
                    yielding + Arguments{"-s", "Time/End time=0.05"},
                    yielding + Arguments{"-s", "Time/End time=0.07"},
                    n_forgeries / 2);
  }


  TEST(ForgedCheckpoints, OfBlocksThatLeaveAndSleepAreRefused)
  {
    check_forgeries("leaving-blocks/scene.prm",
                    {"-s", "Time/Sleep speed=0.05", "-s", "Time/End time=0.9"},
                    {"-s", "Time/Sleep speed=0.05", "-s", "Time/End time=0.92"},
                    n_forgeries / 2);
  }


  TEST(ForgedCheckpoints, OfCracksThatGrowAreRefused)
  {
    check_forgeries("bar-breaks/scene.prm",
                    {"-s", "Time/End time=0.05"},
                    {"-s", "Time/End time=0.0505"},
                    n_forgeries / 5);
  }


  // A state and a list that is too long: what follows the head is not read.
  TEST(ForgedCheckpoints, OfAnotherVersionAreRefused)
  {
    const std::string folder = fresh_output_dir("of-another-version");
    std::filesystem::create_directories(folder);
    for (const char version : {12, 13})
    {
      std::string bytes = "NMMSTATE";
      bytes.append(std::string(1, version) + std::string(7, '\0'));
      bytes.append(std::string(1, 8) + std::string(7, '\0'));
      const std::uint64_t sum = fnv(bytes);
      bytes.append(reinterpret_cast<const char *>(&sum), sizeof(sum));
      std::ofstream(folder + "/old.nmm", std::ios::binary) << bytes;
      const auto result =
        run_in_process({"-o",
                        folder,
                        "-r",
                        folder + "/old.nmm",
                        cases_dir + "contact-incline/scene.prm"});
      EXPECT_EQ(result.exit_code, 2) << result.output;
      EXPECT_NE(result.output.find("version " + std::to_string(int(version))),
                std::string::npos)
        << result.output;
    }
  }
} // namespace
