// Units of the library do not include each other in a circle. A unit is a header and the source of
// the same name; it depends on those whose headers its files include. Units of a circle cannot be
// understood, tested or moved one without the others.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace
{
  /// Units and those that they depend on. The name of a unit is that of its files without ending,
  /// from include/nmm or source on.
  using Units = std::map<std::string, std::set<std::string>>;


  Units
  units_of_library()
  {
    const std::regex include(
      R"re(^\s*#include\s*[<"](?:nmm/)?([^>"]+)\.h[>"].*)re");
    Units units;
    for (const std::string folder :
         {NMM_SOURCE_DIR "/include/nmm", NMM_SOURCE_DIR "/source"})
      for (const auto &entry :
           std::filesystem::recursive_directory_iterator(folder))
      {
        const std::filesystem::path &file = entry.path();
        if (file.extension() != ".cc" && file.extension() != ".h")
          continue;
        auto         &used = units[std::filesystem::relative(file, folder)
                             .replace_extension()
                             .string()];
        std::ifstream in(file);
        std::string   line;
        std::smatch   match;
        while (std::getline(in, line))
          if (std::regex_match(line, match, include))
            used.insert(match[1]);
      }
    return units;
  }


  /// The units that have to be taken away before nothing includes itself by way of others: all
  /// units on circles, and those between two of them.
  std::set<std::string>
  units_on_circles(const Units &units)
  {
    std::set<std::string> left;
    for (const auto &[unit, used] : units)
      left.insert(unit);
    const auto is_needed = [&](const std::string &unit) {
      const auto uses = [&](const std::string &one, const std::string &other) {
        return one != other && left.count(other) > 0 &&
               units.at(one).count(other) > 0;
      };
      bool uses_any = false, is_used = false;
      for (const std::string &other : left)
      {
        uses_any = uses_any || uses(unit, other);
        is_used  = is_used || uses(other, unit);
      }
      return uses_any && is_used;
    };
    for (bool goes_on = true; goes_on;)
    {
      goes_on = false;
      for (auto unit = left.begin(); unit != left.end();)
        if (is_needed(*unit))
          ++unit;
        else
        {
          unit    = left.erase(unit);
          goes_on = true;
        }
    }
    return left;
  }


  TEST(HouseRules, UnitsDoNotIncludeEachOtherInACircle)
  {
    const Units circle = {{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}, {"d", {}}};
    EXPECT_EQ(units_on_circles(circle), (std::set<std::string>{"b", "c"}));

    const Units units = units_of_library();
    EXPECT_GT(units.size(), 250U);
    for (const std::string &unit : units_on_circles(units))
      ADD_FAILURE() << unit << " and others include each other in a circle.";
  }
} // namespace
