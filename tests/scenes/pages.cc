#include "run_in_process.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <string>

// The scenes on README and on the pages of doc/guide run as they stand there.
namespace
{
  namespace fs = std::filesystem;

  /// Run all blocks of a page that are marked as scenes; how many there are.
  unsigned int
  run_scenes_of(const fs::path &page)
  {
    std::ifstream     in(page);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string fence  = "```prm\n";
    const std::string folder = NMM_TEST_OUTPUT_DIR "/pages";
    fs::create_directories(folder);
    unsigned int n_scenes = 0;
    for (std::size_t begin = text.find(fence); begin != std::string::npos;
         begin             = text.find(fence, begin))
    {
      begin += fence.size();
      const std::string scene = folder + "/scene.prm";
      if (is_first_rank())
        std::ofstream(scene)
          << text.substr(begin, text.find("```", begin) - begin);
      const DriverResult result =
        run_in_process({"--output", folder + "/output", scene});
      EXPECT_EQ(result.exit_code, 0)
        << page << ", scene " << n_scenes + 1 << '\n'
        << result.output;
      ++n_scenes;
    }
    return n_scenes;
  }


  TEST(Pages, TheSceneOfReadmeRuns)
  {
    EXPECT_EQ(run_scenes_of(NMM_SOURCE_DIR "/README.md"), 1u);
  }


  TEST(Pages, TheScenesOfTheGuideRun)
  {
    unsigned int n_pages = 0;
    for (const fs::directory_entry &page :
         fs::directory_iterator(NMM_SOURCE_DIR "/doc/guide"))
    {
      (void)run_scenes_of(page.path());
      ++n_pages;
    }
    EXPECT_GE(n_pages, 7u);
  }
} // namespace
