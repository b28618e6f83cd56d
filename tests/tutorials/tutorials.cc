#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <scenes/run_driver.h>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  /// The rows of numbers that a program prints; a rate that there is not, "-", is 0.
  std::vector<std::vector<double>>
  rows_of_numbers(const std::string &output)
  {
    std::vector<std::vector<double>> rows;
    std::istringstream               lines(output);
    for (std::string line; std::getline(lines, line);)
    {
      std::vector<double> row;
      std::istringstream  words(line);
      for (std::string word; words >> word;)
      {
        std::istringstream number(word);
        double             value = 0.;
        if (word != "-" && !(number >> value))
          break;
        row.push_back(value);
      }
      if (!row.empty())
        rows.push_back(row);
    }
    return rows;
  }


  // Columns: cell size, elements, unknowns, error of u and its rate, of stress and its rate. Second
  // order means that displacements converge with order 3 and stresses with order 2. Over the three
  // halvings they do so within 0.25: the first mesh has two triangles along the radius of the hole.
  // With a sign of Nitsche's terms wrong, or the pressure of the sides left out, the errors are of
  // the size of the solution.
  TEST(Tutorials, ThePlateOfStep0ConvergesWithSecondOrder)
  {
    const std::string  folder = fresh_output_dir("step-nmm-0");
    const DriverResult result = run_driver({"", folder});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const std::vector<std::vector<double>> rows =
      rows_of_numbers(result.output);
    ASSERT_EQ(rows.size(), 4u) << result.output;
    for (const std::vector<double> &row : rows)
      ASSERT_EQ(row.size(), 7u) << result.output;
    EXPECT_GT(rows[0][3] / rows[3][3], std::pow(2., 3. * 2.75));
    EXPECT_GT(rows[0][5] / rows[3][5], std::pow(2., 3. * 1.5));
    EXPECT_LT(rows[3][3], 2e-5);
    EXPECT_LT(rows[3][5], 3e-3);
    EXPECT_TRUE(std::filesystem::exists(folder + "/step-nmm-0.png"));
  }
} // namespace
