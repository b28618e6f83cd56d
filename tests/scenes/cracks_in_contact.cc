#include "run_in_process.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>

// Cracks whose faces touch.
namespace
{
  /// The rows of summary.csv of a closed flaw without friction, whose wings are @p length long.
  std::map<std::string, double>
  run_wings(const double length)
  {
    const std::string folder = NMM_TEST_OUTPUT_DIR "/wings";
    const double      c      = std::sqrt(0.5);
    // 70.53 degrees from the flaw
    const double angle = std::atan(1.) + std::acos(1. / 3.);
    const double x     = c + length * std::cos(angle),
                 y     = c + length * std::sin(angle);
    std::ostringstream geometry;
    geometry.precision(16);
    geometry << "Geometry/Text=boundary name=bottom material=rock LINESTRING "
                "(-4 -4, 4 -4); boundary name=right LINESTRING (4 -4, 4 4); "
                "boundary name=top LINESTRING (4 4, -4 4); boundary name=left "
                "LINESTRING (-4 4, -4 -4); joint name=flaw LINESTRING ("
             << -x << ' ' << -y << ", " << -c << ' ' << -c << ", " << c << ' '
             << c << ", " << x << ' ' << y << ")";
    const DriverResult result =
      run_in_process({"--output",
                      folder,
                      "--set",
                      geometry.str(),
                      "--set",
                      "Mathematical mesh/Cell size=0.8",
                      "--set",
                      "Fixed points/pin/Point=-3.6, 0",
                      "--set",
                      "Fixed points/slider/Point=3.6, 0",
                      "--set",
                      "Contact/Friction angle=0",
                      "--set",
                      "Newton/Maximum iterations=100",
                      NMM_SOURCE_DIR "/tests/scenes/closed-crack/scene.prm"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::map<std::string, double> values;
    std::ifstream                 in(folder + "/summary.csv");
    for (std::string line; std::getline(in, line);)
    {
      const std::size_t first = line.find(',');
      if (first != std::string::npos)
        values[line.substr(0, first)] = std::atof(line.c_str() + first + 1);
    }
    return values;
  }


  TEST(CracksInContact, WingsReleaseTheEnergyThatRecuttingFinds)
  {
    // Without friction the strain energy under constant loads grows by G per length of each
    // wing. The central difference is off by 1e-3; the meshes of the three lengths differ, by
    // which it scatters by 4e-3 (and by 1e-4 to 2e-3 with finer ones). Without the forces on the
    // flaw in the integrals it is off by a tenth.
    constexpr double step   = 0.02;
    const double     before = run_wings(0.5 - step).at("strain_energy");
    const double     after  = run_wings(0.5 + step).at("strain_energy");
    const auto       at     = run_wings(0.5);
    EXPECT_NEAR((after - before) / (4. * step) /
                  at.at("largest_energy_release_rate"),
                1.,
                6e-3);
  }
} // namespace
