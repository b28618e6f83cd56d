#include "expected_values.h"
#include "run_in_process.h"
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iomanip>
#include <map>
#include <regex>
#include <sstream>

// Nothing that is computed depends on where the origin of the coordinates lies, on a quarter turn of the solid with its
// mathematical mesh, or on the units of length and stress.

namespace
{
  /// Coordinates, lengths and stresses of a scene in another frame and in other units.
  struct Frame
  {
    std::string name;
    /// Position of the old origin, in the old unit of length.
    double dx = 0., dy = 0.;
    /// Whether x becomes y and y becomes -x.
    bool is_turned = false;
    /// Numbers are multiplied by this if they are lengths, or stresses. Time, angles and the thickness stay.
    double length = 1., stress = 1.;

    /// Factor of a quantity that is a product of powers of length and stress.
    double
    factor(const std::array<int, 2> &powers) const
    {
      return std::pow(length, powers[0]) * std::pow(stress, powers[1]);
    }
  };


  std::string
  exact(const double x)
  {
    std::ostringstream out;
    out << std::setprecision(17) << x;
    return out.str();
  }


  std::array<double, 2>
  vector(const Frame &frame, const double x, const double y)
  {
    return frame.is_turned ? std::array<double, 2>{{-y, x}}
                           : std::array<double, 2>{{x, y}};
  }


  std::array<double, 2>
  point(const Frame &frame, const double x, const double y)
  {
    const auto v = vector(frame, x, y);
    return {
      {frame.length * (v[0] + frame.dx), frame.length * (v[1] + frame.dy)}};
  }


  /// A list in well-known text: pairs "x y" are points, a single number is a radius.
  std::string
  mapped_list(const std::string &list, const Frame &frame)
  {
    std::string result;
    for (const std::string &item : split(list, ','))
    {
      std::istringstream in(item);
      double             x, y;
      std::string        mapped = item;
      if (in >> x)
      {
        mapped = exact(frame.length * x);
        if (in >> y)
        {
          const auto p = point(frame, x, y);
          mapped       = exact(p[0]) + ' ' + exact(p[1]);
        }
      }
      result += (result.empty() ? "" : ", ") + mapped;
    }
    return result;
  }


  /// Powers of length and stress of parameters that are numbers or vectors, and of results.
  const std::map<std::string, std::array<int, 2>> dimensions = {
    {"Cell size", {{1, 0}}},
    {"Size", {{1, 0}}},
    {"Increment", {{1, 0}}},
    {"Largest displacement", {{1, 0}}},
    {"Young's modulus", {{0, 1}}},
    {"Density", {{-2, 1}}},
    {"Gravity", {{1, 0}}},
    {"Force", {{1, 1}}},
    {"Value", {{0, 1}}},
    {"max_displacement", {{1, 0}}},
    {"friction_work", {{2, 1}}},
    {"strain_energy", {{2, 1}}},
    {"floor_force_x", {{1, 1}}},
    {"safety_factor", {{0, 0}}}};


  /// The value of a parameter in the frame.
  std::string
  mapped_value(const std::string &key,
               const std::string &value,
               const Frame       &frame)
  {
    if (key == "Components" && frame.is_turned)
      return value == "x" ? "y" : "x";
    if (key == "Rotation" && frame.is_turned)
      return exact(std::stod(value) + 90.);
    const bool is_point  = key == "Point" || key == "From" || key == "To";
    const auto dimension = dimensions.find(key);
    if (!is_point && dimension == dimensions.end())
      return value;
    const char separator = value.find(';') != std::string::npos ? ';' : ',';
    const auto items     = split(value, separator);
    if (items.size() == 1)
      return exact(frame.factor(dimension->second) * std::stod(value));
    const double x = std::stod(items[0]), y = std::stod(items[1]);
    auto         v = is_point ? point(frame, x, y) : vector(frame, x, y);
    if (!is_point)
      for (double &component : v)
        component *= frame.factor(dimension->second);
    return exact(v[0]) + separator + ' ' + exact(v[1]);
  }


  /// The scene in another frame. The mathematical mesh is turned with the solid.
  std::string
  mapped_scene(const std::string &text, const Frame &frame)
  {
    const bool has_rotation = text.find("set Rotation") != std::string::npos;
    const std::regex list(R"(\(([^()]*)\))"),
      assignment(R"( *set ([^=]*[^= ]) *= *(.*))");
    std::istringstream lines(
      std::regex_replace(text, std::regex(R"(\\\n)"), " "));
    std::string result;
    for (std::string line; std::getline(lines, line);)
    {
      std::smatch match;
      line = line.substr(0, line.find('#'));
      if (!std::regex_match(line, match, assignment))
        result += line;
      else if (match[1] == "Text" || match[1] == "Shape")
      {
        std::string rest = line;
        while (std::regex_search(rest, match, list))
        {
          result +=
            match.prefix().str() + '(' + mapped_list(match[1], frame) + ')';
          rest = match.suffix();
        }
        result += rest;
      }
      else
      {
        const std::string key = match[1];
        result += "set " + key + " = " + mapped_value(key, match[2], frame);
        if (key == "Cell size" && frame.is_turned && !has_rotation)
          result += "\nset Rotation = 90";
      }
      result += '\n';
    }
    return result;
  }


  struct MappedScene
  {
    std::string scene;
    /// Rows that are numbers of steps and must agree exactly, and rows that must agree to 1e-6.
    std::vector<std::string> counts, values;
    std::vector<std::string> settings = {};
    /// Whether the scene has no displacements as expressions, which are not mapped.
    bool is_mapped = true;
  };


  std::map<std::string, double>
  run_in_frame(const MappedScene &mapped, const Frame &frame)
  {
    const std::string folder = std::string(NMM_TEST_OUTPUT_DIR) + "/invariance";
    std::filesystem::create_directories(folder);
    const std::string scene = folder + "/mapped.prm";
    std::ofstream(scene) << mapped_scene(read_text(NMM_SOURCE_DIR "/" +
                                                   mapped.scene),
                                         frame);
    const std::string        output    = fresh_output_dir("invariance/output");
    std::vector<std::string> arguments = {"--set", "Output/Picture=false"};
    for (const std::string &setting : mapped.settings)
      arguments.insert(arguments.end(), {"--set", setting});
    arguments.insert(arguments.end(), {"--output", output, scene});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_results(output);
  }


  void
  compare(const MappedScene                   &mapped,
          const Frame                         &frame,
          const std::map<std::string, double> &here)
  {
    SCOPED_TRACE(mapped.scene + " " + frame.name);
    const auto there = run_in_frame(mapped, frame);
    for (const std::string &row : mapped.counts)
      EXPECT_EQ(here.at(row), there.at(row)) << row;
    for (const std::string &row : mapped.values)
    {
      const double value = there.at(row) / frame.factor(dimensions.at(row));
      // Displacements of steps agree to the tolerance of Newton's method, 1e-9, times the number of
      // steps. Coordinates of both faces are rounded.
      EXPECT_NEAR(here.at(row),
                  value,
                  1e-6 * std::abs(here.at(row)) +
                    8e-16 * std::hypot(frame.dx, frame.dy))
        << row;
    }
    // The last iteration of a step is decided by rounding if it reaches the floor of the residual.
    if (here.count("newton_iterations") > 0)
    {
      EXPECT_NEAR(here.at("newton_iterations"),
                  there.at("newton_iterations"),
                  2. + 0.05 * here.at("newton_iterations"));
    }
  }


  TEST(Invariance, FrameAndUnitsChangeNothing)
  {
    if (n_ranks() > 1)
      GTEST_SKIP() << "on one rank";
    const std::vector<MappedScene> all = {
      {"tests/scenes/contact-incline/scene.prm",
       {"time_steps"},
       {"max_displacement", "friction_work"}},
      {"tests/scenes/contact-stack/scene.prm",
       {"load_steps"},
       {"max_displacement"}},
      {"tests/scenes/contact-pushed-block/scene.prm",
       {"time_steps"},
       {"max_displacement"},
       {},
       false},
      {"tests/scenes/safety-factor-incline/scene.prm", {}, {"safety_factor"}},
      {"tests/scenes/contact-wedges/scene.prm",
       {"load_steps"},
       {"max_displacement", "strain_energy"}},
      {"tests/scenes/contact-two-laws/scene.prm",
       {"time_steps"},
       {"max_displacement", "friction_work"}},
      {"tests/scenes/inclined-crack/scene.prm",
       {},
       {"max_displacement", "strain_energy"}},
      {"tests/scenes/thin-layer/scene.prm",
       {},
       {"max_displacement", "strain_energy"}},
      {"tests/scenes/gravity-column/scene.prm",
       {},
       {"max_displacement", "strain_energy"}},
      {"applications/nmm/scenes/sliding-block.prm",
       {"time_steps"},
       {"max_displacement", "friction_work"},
       {"Output/Fields every=0"}}};
    // An elevation, and a place in a national grid, whose coordinates are rounded to 1e-9 m.
    const std::vector<Frame> frames = {
      {"at (0, 1e4)", 0., 1e4},
      {"at (5e5, 6.7e6)", 5e5, 6.7e6},
      {"turned", 0., 0., true},
      {"in large units of length", 0., 0., false, 1e-6, 1e6},
      {"in small units of length", 0., 0., false, 1e6, 1e-6}};
#ifdef DEBUG
    const std::size_t n_scenes = 4;
#else
    const std::size_t n_scenes = all.size();
#endif
    for (std::size_t i = 0; i < n_scenes; ++i)
    {
      const MappedScene &mapped = all[i];
      const auto         here   = run_in_frame(mapped, {});
      for (const Frame &frame : frames)
        // Only moved, if it has expressions
        if (mapped.is_mapped || frame.dy != 0.)
          compare(mapped, frame, here);
    }
  }
} // namespace
