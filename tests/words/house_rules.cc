// Rules of the house that a text of the sources shows.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <string>

namespace
{
  /// The index of a component of a cover, written out instead of unknown_of(), and the way back.
  const std::regex written_out(
    R"((^|[^\w.])2 ?\* ?(?!n\b|n_)[A-Za-z_][\w.]*(\[[^\]]*\])? ?\+ ?([a-z]|component)\b(?! ?[*(\[]))"
    R"(|\bunknowns?(\[[^\]]*\])? ?[/%] ?2\b)");


  TEST(HouseRules, OnlyOneFileSaysHowUnknownsAreNumbered)
  {
    for (const char *const text : {"rhs[2 * i + c] += 1.;",
                                   "u(2*cover + component)",
                                   "unknowns.push_back(2 * of[k] + d);",
                                   "const unsigned int k = unknown / 2;"})
      EXPECT_TRUE(std::regex_search(text, written_out)) << text;
    for (const char *const text : {"A[2 * i + J][2 * k + L]",
                                   "2 * degree + further_degree",
                                   "0.2 * size + c",
                                   "sums[2 * n + i]"})
      EXPECT_FALSE(std::regex_search(text, written_out)) << text;

    unsigned int n_files = 0;
    for (const std::string folder : {"include", "source", "applications"})
      for (const auto &entry : std::filesystem::recursive_directory_iterator(
             NMM_SOURCE_DIR "/" + folder))
      {
        const std::filesystem::path &file = entry.path();
        if ((file.extension() != ".cc" && file.extension() != ".h") ||
            file.filename() == "unknowns.h")
          continue;
        ++n_files;
        std::ifstream in(file);
        std::string   line;
        for (unsigned int n = 1; std::getline(in, line); ++n)
          EXPECT_FALSE(
            std::regex_search(line.substr(0, line.find("//")), written_out))
            << file.string() << ", line " << n << ": " << line
            << "\nUse unknown_of(), cover_of() and component_of() of "
               "nmm/covers/unknowns.h.";
      }
    // the folders are those of the library
    EXPECT_GT(n_files, 400U);
  }
} // namespace
