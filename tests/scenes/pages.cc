#include "run_in_process.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
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


  // Tables hold values: no cell has more than 30 words. README fits on two screens.
  TEST(Pages, CellsAndReadmeAreShort)
  {
    unsigned int n_cells = 0;
    for (const fs::directory_entry &page :
         fs::recursive_directory_iterator(NMM_SOURCE_DIR "/doc"))
    {
      if (page.path().extension() != ".md")
        continue;
      std::ifstream in(page.path());
      for (std::string line; std::getline(in, line);)
      {
        if (line.empty() || line.front() != '|')
          continue;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, '|'); ++n_cells)
        {
          std::istringstream words(cell);
          const auto         n_words =
            std::distance(std::istream_iterator<std::string>(words), {});
          EXPECT_LE(n_words, 30) << page.path() << ": " << cell;
        }
      }
    }
    EXPECT_GT(n_cells, 1000u);

    std::ifstream readme(NMM_SOURCE_DIR "/README.md");
    unsigned int  n_lines = 0;
    for (std::string line; std::getline(readme, line);)
      ++n_lines;
    EXPECT_LE(n_lines, 120u);
  }
} // namespace
