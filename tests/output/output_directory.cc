#include <nmm/base/program.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/output_directory.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>

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


  TEST(OutputDirectory, FileSystemsThatRefuseAndNamesThatAreTooLong)
  {
    const fs::path path = fresh("refused");
    for (const fs::path &folder : {fs::path("/proc/nmm"),
                                   path / std::string(300, 'a'),
                                   path / std::string(300, 'a') / "deeper"})
      EXPECT_THROW(OutputDirectory(folder).check(), InputError) << folder;
    EXPECT_FALSE(fs::exists(path));
  }


  TEST(OutputDirectory, FolderWithTheNameOfAResultIsAnInputError)
  {
    for (const char *name : {"fields.vtu", "picture-0001.png", ".a.csv.part"})
    {
      const fs::path path = fresh("folder-in-the-way");
      fs::create_directories(path / name);
      if (name[0] == '.')
        EXPECT_NO_THROW(OutputDirectory(path).check());
      else
        EXPECT_THROW(OutputDirectory(path).check(), InputError);
      EXPECT_TRUE(fs::exists(path / name));
      EXPECT_EQ(n_files(path), 1u);
    }
  }


  // What a limit of the size of files forbids is like a full disk.
  TEST(OutputDirectory, FullDiskLeavesTheOldFile)
  {
    const OutputDirectory directory(fresh("full"));
    directory.create();
    directory.write_text("a.csv", [](std::ostream &out) { out << "whole"; });
    CsvSeries table((directory.path() / "table.csv").string(), {"value"}, -1);
    rlimit    limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t unlimited = limit.rlim_cur;
    const auto   action    = std::signal(SIGXFSZ, SIG_IGN);
    limit.rlim_cur         = 100;
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_THROW(directory.write_text("a.csv",
                                      [](std::ostream &out) {
                                        out << std::string(100000, 'a');
                                      }),
                 OutputFailure);
    EXPECT_THROW(for (unsigned int step = 0; step < 100; ++step)
                   table.append(0.1 * step, step, {1.}),
                 OutputFailure);
    limit.rlim_cur = unlimited;
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, action);
    std::string content;
    std::ifstream(directory.path() / "a.csv") >> content;
    EXPECT_EQ(content, "whole");
    EXPECT_EQ(n_files(directory.path()), 2u);
  }


  TEST(CsvSeries, RowPerStepAndContinuation)
  {
    const fs::path folder = fresh("series");
    fs::create_directories(folder);
    const std::string              file    = (folder / "history.csv").string();
    const std::vector<std::string> columns = {"a", "b"};
    const auto                     content = [&]() {
      std::ifstream in(file);
      return std::string(std::istreambuf_iterator<char>(in), {});
    };
    std::string expected = "time,step,a,b\n";
    {
      CsvSeries series(file, columns, -1);
      for (unsigned int step = 0; step < 5; ++step)
      {
        series.append(0.5 * step, step, {0.1, -2.});
        // complete after each row: a kill here would lose nothing
        const std::string all = content();
        EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 2 + step);
        if (step == 2)
          expected = all;
      }
    }
    EXPECT_EQ(expected.substr(expected.size() - 11), "1,2,0.1,-2\n");
    // the row that a kill has cut is of a step to be kept
    std::ofstream(file, std::ios::app) << "0.25,1,0.";
    {
      const CsvSeries series(file, columns, 2);
    }
    EXPECT_EQ(content(), expected);
    EXPECT_THROW(CsvSeries(file, {"a", "c"}, 2), InputError);
    EXPECT_EQ(content(), expected);
    EXPECT_EQ(n_files(folder), 1u);
    EXPECT_THROW(CsvSeries("no/such/folder/history.csv", columns, -1),
                 OutputFailure);
  }


  // Files of the user's own stay, whatever their names.
  TEST(OutputDirectory, CreateRemovesOnlyWhatAnEarlierRunHasListed)
  {
    const fs::path path = fresh("earlier");
    {
      const OutputDirectory earlier(path);
      earlier.create();
      for (const char *name : {"summary.csv", "fields-0003.vtu", "notes.csv"})
        earlier.write_text(name, [](std::ostream &out) { out << "old"; });
      std::ofstream(earlier.file("history.csv")) << "old";
      // what a run leaves that was killed
      std::ofstream(path / ".fields-0003.vtu.part") << "old";
    }
    const std::vector<std::string> own = {"fields-my.vtu",
                                          "picture-holiday.png",
                                          "picture.png",
                                          "notes.txt",
                                          ".contacts.csv.part"};
    for (const std::string &name : own)
      std::ofstream(path / name) << "mine";
    OutputDirectory(path).create();
    for (const std::string &name : own)
      EXPECT_TRUE(fs::exists(path / name)) << name;
    EXPECT_TRUE(fs::exists(path / "notes.csv"));
    EXPECT_EQ(n_files(path), own.size() + 1);
  }


  TEST(OutputDirectory, ResumeKeepsHistoriesAndTheList)
  {
    const fs::path path = fresh("resumed");
    {
      const OutputDirectory earlier(path);
      earlier.create();
      for (const char *name : {"summary.csv", "fields-0003.vtu"})
        earlier.write_text(name, [](std::ostream &out) { out << "old"; });
    }
    OutputDirectory(path).resume();
    EXPECT_FALSE(fs::exists(path / "summary.csv"));
    EXPECT_TRUE(fs::exists(path / "fields-0003.vtu"));
    OutputDirectory(path).create();
    EXPECT_EQ(n_files(path), 0u);
  }


  TEST(OutputDirectory, TemporaryFilesDoNotFollowLinks)
  {
    const fs::path path = fresh("links"), victim = path / "victim.txt";
    fs::create_directories(path);
    std::ofstream(victim) << "precious";
    for (const char *name :
         {".nmm-trial.part", ".summary.csv.part", "history.csv.part"})
      fs::create_symlink(victim, path / name);
    const OutputDirectory directory(path);
    directory.create();
    directory.write_text("summary.csv",
                         [](std::ostream &out) { out << "results"; });
    const CsvSeries history(directory.file("history.csv"), {"a"}, -1);
    std::string     content;
    std::ifstream(victim) >> content;
    EXPECT_EQ(content, "precious");
    EXPECT_FALSE(fs::is_symlink(path / "summary.csv"));
    EXPECT_FALSE(fs::is_symlink(path / "history.csv"));
  }


  // A spreadsheet must not compute what is a name.
  TEST(CsvCells, FormulasAreText)
  {
    EXPECT_EQ(quoted("floor"), "floor");
    EXPECT_EQ(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    EXPECT_EQ(quoted("=1+1"), "'=1+1");
    EXPECT_EQ(quoted("@SUM(A1,A2)"), "\"'@SUM(A1,A2)\"");
    EXPECT_EQ(quoted("+cmd|' /C calc'!A0"), "'+cmd|' /C calc'!A0");
    EXPECT_EQ(quoted("-x"), "'-x");
    EXPECT_EQ(quoted("-1.5e3"), "-1.5e3");
    EXPECT_EQ(quoted("+2"), "+2");
    EXPECT_EQ(quoted("-"), "-");
    EXPECT_EQ(quoted("two\nlines"), "\"two\nlines\"");
    Summary summary;
    summary.add("=A1_force_x", 1., "=B1");
    std::ostringstream text;
    summary.write(text);
    EXPECT_EQ(text.str(), "name,value,unit\n'=A1_force_x,1,'=B1\n");
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
