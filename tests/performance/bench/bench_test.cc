// nmm-bench in its smallest form: the table it promises, on one rank and two, and the
// report.

#include "row.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <scenes/run_driver.h>
#include <set>
#include <sstream>

using namespace NMM::Bench;

namespace
{
  class Bench : public ::testing::Test
  {
  protected:
    static void
    SetUpTestSuite()
    {
      folder = fresh_output_dir("bench");
      std::filesystem::create_directories(folder);
      table  = folder + "/performance.csv";
      result = run_driver({"measure", "smallest", table});
    }

    static std::string  folder, table;
    static DriverResult result;
  };

  std::string  Bench::folder, Bench::table;
  DriverResult Bench::result;


  TEST_F(Bench, TableHasTheColumnsPromised)
  {
    ASSERT_EQ(result.exit_code, 0) << result.output;
    std::ifstream in(table);
    std::string   line;
    ASSERT_TRUE(std::getline(in, line));
    std::set<std::string> columns;
    std::istringstream    cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      columns.insert(cell);
    for (const char *name : {"case",
                             "method",
                             "degree",
                             "kinematics",
                             "solver",
                             "contact_enforcement",
                             "stabilization",
                             "ranks",
                             "elements",
                             "unknowns",
                             "nonzeros",
                             "iterations",
                             "factor_entries",
                             "cutting_s",
                             "covers_s",
                             "quadrature_s",
                             "assembly_s",
                             "analysis_s",
                             "factorization_s",
                             "solution_s",
                             "contact_search_s",
                             "contact_terms_s",
                             "output_s",
                             "total_s",
                             "error",
                             "peak_memory_MB",
                             "date",
                             "cpu",
                             "versions"})
      EXPECT_EQ(columns.count(name), 1U) << name;
  }


  TEST_F(Bench, RowsOfAllCasesSayWhatTheyMeasured)
  {
    ASSERT_EQ(result.exit_code, 0) << result.output;
    std::set<std::string> names;
    for (const Row &row : read_table(table))
    {
      SCOPED_TRACE(row.name + ", " + row.method + ", " + row.solver);
      names.insert(row.name);
      EXPECT_GT(row.total, 0.);
      EXPECT_GT(row.peak_memory, 0.);
      EXPECT_EQ(row.ranks, 1.);
      EXPECT_FALSE(row.cpu.empty());
      EXPECT_FALSE(row.date.empty());
      if (row.name != "ring")
        continue;
      // stages are parts of the total, each rounded to eight digits
      double sum = 0.;
      for (const double stage : {row.geometry,
                                 row.mesh,
                                 row.cutting,
                                 row.covers,
                                 row.quadrature,
                                 row.sparsity,
                                 row.assembly,
                                 row.analysis,
                                 row.factorization,
                                 row.solution})
        sum += std::isnan(stage) ? 0. : stage;
      EXPECT_LE(sum, row.total * (1. + 1e-6));
      EXPECT_GT(row.nonzeros, row.unknowns);
      // the coarsest first-order mesh has 8e-4
      EXPECT_LT(row.error, row.degree == 1. ? 1e-3 : 5e-5);
      EXPECT_GT(row.error, 0.);
      if (row.solver == "MUMPS")
      {
        EXPECT_GT(row.factor_entries, row.unknowns);
      }
      if (row.solver == "CG + ML")
      {
        EXPECT_GT(row.iterations, 1.);
      }
    }
    for (const char *name : {"ring",
                             "cantilever dead",
                             "cantilever follower",
                             "Hertz disk",
                             "cracked plate",
                             "incline",
                             "output",
                             "threads",
                             "weak form",
                             "assembly",
                             "ring that grows",
                             "strong scaling",
                             "weak scaling"})
      EXPECT_EQ(names.count(name), 1U) << name;
  }


  TEST_F(Bench, TwoRanksAddTheirRowsAndTheReportShowsThem)
  {
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const std::size_t  n_before = read_table(table).size();
    const DriverResult two =
      run_driver({"measure", "smallest", table}, /* n_ranks = */ 2);
    ASSERT_EQ(two.exit_code, 0) << two.output;
    const std::vector<Row> rows = read_table(table);
    EXPECT_GT(rows.size(), n_before);
    EXPECT_EQ(rows.back().ranks, 2.);
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const Row &row) {
      return row.name == "strong scaling" && row.ranks == 2.;
    }));

    const DriverResult report = run_driver({"report", table, folder});
    ASSERT_EQ(report.exit_code, 0) << report.output;
    std::ifstream      in(folder + "/performance.md");
    std::ostringstream text;
    text << in.rdbuf();
    for (const char *heading : {"## Requirements",
                                "### Thick ring",
                                "## Where the time goes",
                                "## Ranks",
                                "two ranks, times as fast"})
      EXPECT_NE(text.str().find(heading), std::string::npos) << heading;
    for (const char *image : {"ring", "hertz", "stages", "ranks"})
      EXPECT_GT(std::filesystem::file_size(folder + "/images/performance-" +
                                           image + ".png"),
                10000U);
  }


  /// What runs in every iteration allocates nothing, cutting of blocks' own meshes little; and what
  /// callgrind leaves is read.
  TEST_F(Bench, CountsSayThatIterationsDoNotAllocate)
  {
    const std::string dumps = folder + "/dumps", file = folder + "/counts.csv";
    std::filesystem::create_directories(dumps);
    std::ofstream(dumps + "/callgrind.1")
      << "desc: Trigger: Client Request: stiffness|element|200\n"
         "events: Ir\ntotals: 5000\n";
    const DriverResult counts = run_driver({"counts", file, dumps});
    ASSERT_EQ(counts.exit_code, 0) << counts.output;
    std::ifstream            in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    unsigned int n_loops = 0, n_cuts = 0;
    for (const std::string &line : lines)
    {
      if (line.find("blocks' own meshes, 3 across") != std::string::npos)
      {
        ++n_cuts;
        // 8 if each cell is divided by itself, 280 by an arrangement for each block
        EXPECT_LT(std::stod(line.substr(line.rfind(';') + 1)), 20.) << line;
      }
      for (const char *loop : {"residual of an iteration",
                               "tangent of an iteration",
                               "values in elements",
                               "values on joints",
                               "contact terms with tangent"})
        if (line.find(loop) != std::string::npos)
        {
          ++n_loops;
          // a few for the whole call, none for an element or a point
          EXPECT_LT(std::stod(line.substr(line.rfind(';') + 1)), 0.01) << line;
        }
    }
    EXPECT_EQ(n_loops, 5U);
    EXPECT_EQ(n_cuts, 1U);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines.back(), "instructions;stiffness;element;200;25");
  }


  TEST_F(Bench, ArgumentsThatMeanNothingAreRefused)
  {
    EXPECT_EQ(run_driver({"measure", "enormous", table}).exit_code, 2);
    EXPECT_EQ(run_driver({"report", folder + "/none.csv", folder}).exit_code,
              2);
  }
} // namespace
