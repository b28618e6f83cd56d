#include <nmm/base/exceptions.h>
#include <nmm/io/output_directory.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>

using namespace NMM;
namespace fs = std::filesystem;

namespace
{
  fs::path
  fresh(const std::string &name)
  {
    const fs::path path = fs::path(NMM_TEST_OUTPUT_DIR) / name;
    fs::remove_all(path);
    return path;
  }


  std::size_t
  n_files(const fs::path &path)
  {
    return std::distance(fs::directory_iterator(path),
                         fs::directory_iterator());
  }


  TEST(OutputDirectory, CheckCreatesNothing)
  {
    const fs::path path = fresh("check");
    OutputDirectory(path / "deeper").check();
    EXPECT_FALSE(fs::exists(path));
  }


  TEST(OutputDirectory, FileInTheWayIsAnInputError)
  {
    const fs::path path = fresh("in-the-way");
    std::ofstream(path) << "a file";
    EXPECT_THROW(OutputDirectory(path).check(), InputError);
    EXPECT_THROW(OutputDirectory(path / "deeper").check(), InputError);
  }


  TEST(OutputDirectory, CreateRemovesOnlyResults)
  {
    const fs::path path = fresh("earlier");
    fs::create_directories(path);
    for (const char *name :
         {"summary.csv", "fields.3.vtu", "picture.png", "notes.txt"})
      std::ofstream(path / name) << "old";
    OutputDirectory(path).create();
    EXPECT_TRUE(fs::exists(path / "notes.txt"));
    EXPECT_EQ(n_files(path), 1u);
  }


  TEST(OutputDirectory, FailureLeavesTheOldFileAndNothingElse)
  {
    const OutputDirectory directory(fresh("failure"));
    directory.create();
    directory.write_text("a.csv", [](std::ostream &out) { out << "whole"; });
    EXPECT_THROW(directory.write_text("a.csv",
                                      [](std::ostream &out) {
                                        out << "half";
                                        throw std::runtime_error("failure");
                                      }),
                 std::runtime_error);
    EXPECT_EQ(n_files(directory.path()), 1u);
    std::string content;
    std::ifstream(directory.path() / "a.csv") >> content;
    EXPECT_EQ(content, "whole");
  }


  TEST(Summary, WritesARowPerValue)
  {
    Summary summary;
    summary.add("cells", 1234567);
    summary.add("area", 0.1, "m^2");
    std::ostringstream text;
    summary.write(text);
    EXPECT_EQ(text.str(), "name,value,unit\ncells,1234567,-\narea,0.1,m^2\n");
    EXPECT_EQ(summary.value("area"), 0.1);
  }
} // namespace
