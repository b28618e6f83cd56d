#ifndef nmm_tests_scenes_result_files_h
#define nmm_tests_scenes_result_files_h

#include "arguments.h"
#include "expected_values.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <string>
#include <vector>

// The files of runs that are stopped and continued.

/// All files of a folder with what is in them.
inline std::map<std::string, std::string>
contents(const std::string &folder)
{
  std::map<std::string, std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    // the list of results grows with each attempt to write one
    if (entry.path().filename() != ".nmm-results")
      files[entry.path().filename().string()] =
        read_text(entry.path().string());
  return files;
}


inline void
expect_same_histories(const std::string &a, const std::string &b)
{
  for (const std::string name : {"/history.csv", "/probes-history.csv"})
  {
    const std::string text = read_text(a + name);
    EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 10);
    // Not EXPECT_EQ, which would print both.
    EXPECT_TRUE(text == read_text(b + name))
      << a + name << " and " << b + name << " differ";
  }
}


/// fields.pvd names only files that are there, and there are some.
inline void
check_series(const std::string &folder)
{
  const std::string pvd = read_text(folder + "/fields.pvd");
  EXPECT_NE(pvd.find("</VTKFile>"), std::string::npos) << pvd;
  const std::regex file("file=\"([^\"]*)\"");
  unsigned int     n = 0;
  for (std::sregex_iterator i(pvd.begin(), pvd.end(), file), end; i != end;
       ++i, ++n)
  {
    const std::string vtu = read_text(folder + "/" + (*i)[1].str());
    EXPECT_NE(vtu.find("</VTKFile>"), std::string::npos) << (*i)[1];
  }
  EXPECT_GT(n, 1u);
}

#endif
