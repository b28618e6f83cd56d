#include "expected_values.h"
#include "run_in_process.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iomanip>
#include <regex>
#include <sstream>

// Nothing that is computed depends on where the origin of the coordinates lies.

namespace
{
  /// Coordinates "x y" of a list in well-known text, moved; an item that is no pair, such as a radius, stays.
  std::string
  moved_list(const std::string &list, const double dx, const double dy)
  {
    std::string result;
    for (const std::string &item : split(list, ','))
    {
      std::istringstream in(item);
      double             x, y;
      std::ostringstream out;
      out << std::setprecision(17);
      if (in >> x >> y)
        out << x + dx << ' ' << y + dy;
      else
        out << item;
      result += (result.empty() ? "" : ", ") + out.str();
    }
    return result;
  }


  /// The scene with all its shapes and points moved.
  std::string
  moved_scene(std::string text, const double dx, const double dy)
  {
    text = std::regex_replace(text, std::regex(R"(\\\n)"), " ");
    std::string      result;
    const std::regex innermost(
      R"(\(([^()]*)\)|(Point *= *)([^,\n]*),([^\n]*))");
    auto begin = std::sregex_iterator(text.begin(), text.end(), innermost);
    std::size_t last = 0;
    for (auto match = begin; match != std::sregex_iterator(); ++match)
    {
      result += text.substr(last, match->position() - last);
      last = match->position() + match->length();
      std::ostringstream out;
      out << std::setprecision(17);
      if ((*match)[2].matched)
        out << (*match)[2].str() << std::stod((*match)[3]) + dx << ", "
            << std::stod((*match)[4]) + dy;
      else
        out << '(' << moved_list((*match)[1], dx, dy) << ')';
      result += out.str();
    }
    return result + text.substr(last);
  }


  struct Moved
  {
    std::string              scene;
    std::vector<std::string> settings;
    /// Rows that are numbers of steps and must agree exactly, and rows that must agree to the tolerance.
    std::vector<std::string> counts, values;
    double                   tolerance = 1e-6;
  };


  std::map<std::string, double>
  run_moved(const Moved &moved, const double dx, const double dy)
  {
    const std::string folder = std::string(NMM_TEST_OUTPUT_DIR) + "/invariance";
    std::filesystem::create_directories(folder);
    const std::string scene = folder + "/moved.prm";
    std::ofstream(scene) << moved_scene(
      read_text(NMM_SOURCE_DIR "/" + moved.scene), dx, dy);
    const std::string        output = fresh_output_dir("invariance/output");
    std::vector<std::string> arguments;
    for (const std::string &setting : moved.settings)
      arguments.insert(arguments.end(), {"--set", setting});
    arguments.insert(arguments.end(), {"--output", output, scene});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_results(output);
  }


  TEST(Invariance, CoordinatesFarFromTheOriginChangeNothing)
  {
    if (n_ranks() > 1)
      GTEST_SKIP() << "on one rank";
    const std::vector<Moved> all = {
      {"tests/scenes/contact-incline/scene.prm",
       {},
       {"time_steps"},
       {"max_displacement", "friction_work"}},
      {"tests/scenes/contact-stack/scene.prm",
       {},
       {"load_steps"},
       {"max_displacement"}},
      {"tests/scenes/contact-pushed-block/scene.prm",
       {},
       {},
       {"max_displacement"}},
      {"tests/scenes/safety-factor-incline/scene.prm",
       {},
       {},
       {"safety_factor"}},
      // An inclined face: rounded coordinates, to 1e-9 m in the grid, are steps of 2e-5 of the
      // compression of its springs, over which the block first settles.
      {"applications/nmm/scenes/sliding-block.prm",
       {},
       {"time_steps"},
       {"max_displacement"},
       1e-4}};
    for (const Moved &moved : all)
    {
      const auto here = run_moved(moved, 0., 0.);
      // An elevation, and a place in a national grid, whose coordinates are rounded to 1e-9 m.
      for (const auto &[dx, dy] :
           {std::make_pair(0., 1e4), std::make_pair(5e5, 6.7e6)})
      {
        const auto there = run_moved(moved, dx, dy);
        for (const std::string &row : moved.counts)
          EXPECT_EQ(here.at(row), there.at(row)) << moved.scene << ": " << row;
        for (const std::string &row : moved.values)
          EXPECT_NEAR(here.at(row),
                      there.at(row),
                      moved.tolerance * std::abs(here.at(row)) +
                        // coordinates of both faces are rounded
                        8e-16 * std::hypot(dx, dy))
            << moved.scene << ": " << row << " at (" << dx << ", " << dy << ")";
        if (here.count("newton_iterations") > 0)
        {
          EXPECT_NEAR(here.at("newton_iterations"),
                      there.at("newton_iterations"),
                      2. + 0.05 * here.at("newton_iterations"))
            << moved.scene;
        }
      }
    }
  }
} // namespace
