#include <deal.II/base/numbers.h>

#include "run_in_process.h"
#include "table.h"
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

// The paths of equilibrium along which cracks grow: load, displacement and released energy.
namespace
{
  /// history.csv of a scene whose crack grows.
  std::map<std::string, std::vector<double>>
  run_growth(std::vector<std::string> arguments)
  {
    const std::string folder = NMM_TEST_OUTPUT_DIR "/equilibrium";
    arguments.insert(arguments.begin(), {"--output", folder});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::map<std::string, std::vector<double>> numbers;
    for (const auto &[name, cells] : read_columns(folder + "/history.csv"))
      for (const std::string &cell : cells)
        numbers[name].push_back(std::stod(cell));
    return numbers;
  }


  /// Energy under unit loads, U / lambda^2: loads do the work lambda u / 2.
  std::vector<double>
  unit_energies(const std::map<std::string, std::vector<double>> &history)
  {
    std::vector<double> energies;
    for (unsigned int i = 0; i < history.at("load_factor").size(); ++i)
      energies.push_back(history.at("strain_energy")[i] /
                         std::pow(history.at("load_factor")[i], 2));
    return energies;
  }


  /// The energy release rate under constant loads is the derivative of the energy under unit
  /// loads. Over each two increments it is compared with Simpson's rule for
  /// G = K_c^2 / (E lambda^2).
  void
  check_energy(const std::map<std::string, std::vector<double>> &history,
               const double                                      increment,
               const double                                      toughness,
               const double                                      modulus)
  {
    const std::vector<double> energies = unit_energies(history),
                              &loads   = history.at("load_factor");
    const auto rate                    = [&](const unsigned int i) {
      return std::pow(toughness / loads[i], 2) / modulus;
    };
    for (unsigned int i = 0; i + 2 < energies.size(); i += 2)
    {
      const double released =
        increment / 3. * (rate(i) + 4. * rate(i + 1) + rate(i + 2));
      // Of the longest edge crack, 1.7e-4 is found, most of it the error of Simpson's rule.
      EXPECT_NEAR(energies[i + 2] - energies[i], released, 1e-3 * released)
        << i;
    }
  }


  TEST(CracksInEquilibrium, EdgeCrackSnapsBack)
  {
    const double increment = 1. / 30.;
    const auto   history   = run_growth(
      {"--set",
           "Geometry/Text=boundary name=bottom material=plate LINESTRING (0 -2, 1 "
               "-2); boundary name=right LINESTRING (1 -2, 1 2); boundary name=top "
               "LINESTRING (1 2, 0 2); boundary name=left LINESTRING (0 2, 0 -2); "
               "joint "
               "name=crack state=open LINESTRING (0 0, 0.2 0)",
           "--set",
           "Fracture/Increments=14",
           "--set",
           "Fracture/Increment=" + std::to_string(increment),
           "--set",
           "Materials/plate/Toughness=2",
           NMM_SOURCE_DIR "/applications/nmm/scenes/cracked-plate.prm"});
    const std::vector<double> &loads = history.at("load_factor");
    ASSERT_EQ(loads.size(), 15u);
    // Factors F = K / (pi a)^(1/2) under a stress of 1 Pa, by converged boundary least squares.
    const struct
    {
      unsigned int step;
      double       a, factor, tolerance;
    } lengths[] = {{0, 0.2, 1.3673, 5e-4},
                   {3, 0.3, 1.6599, 5e-4},
                   {9, 0.5, 2.8246, 5e-4},
                   {14, 2. / 3., 5.3836, 5e-4}};
    for (const auto &length : lengths)
    {
      const double exact =
        2. / (length.factor * std::sqrt(dealii::numbers::PI * length.a));
      EXPECT_NEAR(loads[length.step], exact, length.tolerance * exact);
    }
    check_energy(history, increment, 2., 1000.);
    // The displacement of the load, 2 U / lambda. At first it goes back while the load falls; the
    // longest crack opens further.
    const std::vector<double> energies = unit_energies(history);
    for (unsigned int i = 0; i < 6; ++i)
    {
      EXPECT_LT(loads[i + 1], loads[i]);
      EXPECT_LT(loads[i + 1] * energies[i + 1], loads[i] * energies[i]);
    }
  }


  TEST(CracksInEquilibrium, DoubleCantileverOpensAlongItsCurve)
  {
    const auto history =
      run_growth({NMM_SOURCE_DIR "/tests/scenes/double-cantilever/scene.prm"});
    const std::vector<double> &loads = history.at("load_factor");
    ASSERT_EQ(loads.size(), 7u);
    check_energy(history, 0.25, 10., 1000.);
    // For a / h > 2, K = 2 sqrt(3) P (a + 0.6728 h) / h^(3/2) and, by integration, the opening is
    // 8 P (a + 0.6728 h)^3 / (E h^3) (W. Fichter, Int. J. Fract. 22 (1983), 133-143). The number
    // has four digits, so that K is known to 1e-5. The probe is in the middle of the arm's end,
    // over which the force is distributed: the opening there is some 1e-4 off.
    const double h = 0.5;
    for (unsigned int i = 0; i < loads.size(); ++i)
    {
      const double length = 2.5 + 0.25 * i + 0.6728 * h;
      const double exact =
        10. * std::pow(h, 1.5) / (2. * std::sqrt(3.) * length);
      EXPECT_NEAR(loads[i], exact, 5e-5 * exact);
      const double opening = 8. * loads[i] * std::pow(length / h, 3) / 1000.;
      EXPECT_NEAR(2. * history.at("upper arm_y")[i], opening, 1e-3 * opening);
    }
  }


  // Displacements are 1e-9 of the crack, so that the theory of large ones has the same path. The load that
  // the secant method finds is exact, since the drive is proportional to it.
  TEST(CracksInEquilibrium, GrowAlikeInFiniteKinematics)
  {
    const std::vector<std::string> arguments = {
      "--set",
      "Fracture/Increments=3",
      "--set",
      "Fracture/Increment=0.05",
      "--set",
      "Fracture/Tips=graded",
      "--set",
      "Materials/plate/Toughness=1",
      "--set",
      "Materials/plate/Young's modulus=1e9"};
    const auto run = [&](const std::string &kinematics) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(),
                 {"--set",
                  "Model/Kinematics=" + kinematics,
                  NMM_SOURCE_DIR "/tests/scenes/inclined-crack/scene.prm"});
      const auto                history  = run_growth(all);
      std::vector<double>       result   = history.at("load_factor");
      const std::vector<double> energies = unit_energies(history);
      result.insert(result.end(), energies.begin(), energies.end());
      for (const auto &[name, cells] :
           read_columns(NMM_TEST_OUTPUT_DIR "/equilibrium/tips.csv"))
        if (name == "x" || name == "y")
          for (const std::string &cell : cells)
            result.push_back(std::stod(cell));
      return result;
    };
    const std::vector<double> small = run("small"), finite = run("finite");
    ASSERT_EQ(small.size(), finite.size());
    ASSERT_EQ(small.size(), 12u);
    for (unsigned int i = 0; i < small.size(); ++i)
      EXPECT_NEAR(finite[i], small[i], 1e-6 * std::abs(small[i])) << i;
  }
} // namespace
