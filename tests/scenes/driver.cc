#include "arguments.h"
#include "cases.h"
#include "expected_values.h"
#include "run_driver.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  namespace fs = std::filesystem;

  TEST(Driver, FloatingBlockIsNamed)
  {
    const std::string  output = fresh_output_dir("floating");
    const DriverResult result =
      run_driver({"--output", output, cases_dir + "floating-block/scene.prm"});
    EXPECT_EQ(result.exit_code, 3) << result.output;
    for (const char *word : {"Block 1", "floats", "rock"})
      EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
    // What is known is there: which block is which.
    for (const char *name : {"summary.csv", "fields.vtu", "picture.png"})
      EXPECT_TRUE(fs::exists(fs::path(output) / name)) << name;
  }


  /// All files of one run on some threads but the summary, which holds times.
  std::map<std::string, std::string>
  files_on_threads(const std::string              &n_threads,
                   const std::string              &scene,
                   const std::vector<std::string> &names)
  {
    const std::string        output = fresh_output_dir("threads");
    std::vector<std::string> arguments{
      "--output", output, "--threads", n_threads, scene};
    // The first tenth of a second of a slide, after a relaxation; no other scene moves.
    if (scene.find("slope") != std::string::npos)
      arguments.insert(arguments.begin(), {"--set", "Time/End time=0.1"});
    const DriverResult result = run_driver(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::map<std::string, std::string> files;
    for (const std::string &name : names)
    {
      std::ifstream in(fs::path(output) / name);
      EXPECT_TRUE(in) << name;
      files[name] = {std::istreambuf_iterator<char>(in), {}};
      EXPECT_GT(files[name].size(), 1000U) << name;
    }
    return files;
  }


  /// Static, with finite kinematics, with contact at rest and in motion.
  TEST(Driver, FilesAreTheSameOnAnyNumberOfThreads)
  {
    const std::string scenes =
      std::string(NMM_SOURCE_DIR) + "/applications/nmm/scenes/";
    const std::vector<std::pair<std::string, std::vector<std::string>>> runs = {
      {scenes + "ring.prm", {"probes.csv", "fields.vtu"}},
      {scenes + "cantilever.prm", {"probes.csv", "fields.vtu"}},
      {cases_dir + "contact-hertz/scene.prm", {"contacts.csv", "fields.vtu"}},
      {scenes + "slope.prm", {"history.csv", "contacts.csv", "fields.vtu"}}};
    for (const auto &[scene, names] : runs)
    {
      const auto expected = files_on_threads("1", scene, names);
      for (const char *n_threads : {"2", "7"})
        for (const auto &[name, content] :
             files_on_threads(n_threads, scene, names))
          EXPECT_TRUE(content == expected.at(name))
            << scene << ", threads: " << n_threads << ", " << name;
    }
    EXPECT_EQ(run_driver({"--threads", "0", "scene.prm"}).exit_code, 2);
  }


  // The thin layer's condition number, some 1500, above a limit of 100 and below
  // one of 1e5: a warning with the place, or none. The layer's own mesh is
  // reported either way.
  TEST(Driver, ConditionNumberAboveTheLimitIsWarnedOf)
  {
    for (const bool above : {true, false})
    {
      const std::string  output = fresh_output_dir("condition");
      const DriverResult result =
        run_driver({"--output",
                    output,
                    "--set",
                    std::string("Solver/Condition number limit=") +
                      (above ? "100" : "1e5"),
                    cases_dir + "thin-layer/scene.prm"});
      ASSERT_EQ(result.exit_code, 0) << result.output;
      EXPECT_EQ(result.output.find("warning: the condition number") !=
                  std::string::npos,
                above)
        << result.output;
      EXPECT_EQ(result.output.find("weakest near (") != std::string::npos,
                above);
      EXPECT_NE(result.output.find("a mathematical mesh of the region's own"),
                std::string::npos)
        << result.output;
    }
  }


  /// A scene in the documentation, after the sentence that begins with @p words.
  std::string
  documented_scene(const std::string &words)
  {
    std::ifstream     file(NMM_SOURCE_DIR "/doc/scene-format.md");
    std::stringstream page;
    page << file.rdbuf();
    const std::string fence = "```\n";
    const auto        start = page.str().find(fence, page.str().find(words));
    EXPECT_NE(start, std::string::npos);
    const auto        end       = page.str().find("```", start + 3);
    const std::string file_name = NMM_TEST_OUTPUT_DIR "/documented.prm";
    std::ofstream(file_name) << page.str().substr(start + 4, end - start - 4);
    return file_name;
  }


  TEST(Driver, TheDocumentedFirstSceneRuns)
  {
    const std::string  file_name = documented_scene("A square plate of 1 m");
    const std::string  output    = fresh_output_dir("documented");
    const DriverResult result    = run_driver({"--output", output, file_name});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    // A square metre less the bore.
    EXPECT_NEAR(read_results(output).at("area"),
                1. - std::acos(-1.) * 0.04,
                1e-11);
  }


  TEST(Driver, TheDocumentedSceneWithContactRuns)
  {
    const std::string  file_name = documented_scene("This block slides down");
    const std::string  output    = fresh_output_dir("documented");
    const DriverResult result =
      run_driver({"--output", output, "--set", "Time/End time=0.2", file_name});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const auto values = read_results(output);
    // g (sin 30 - cos 30 tan 20) t on 2500 kg, down the floor: what the block hops
    // on its springs moves it by a tenth of that at so short a time
    const double speed = 9.81 * 0.184793 * 0.2;
    EXPECT_NEAR(values.at("momentum_x"),
                -2500. * speed * std::sqrt(0.75),
                0.1 * 2500. * speed);
    EXPECT_EQ(values.at("wall_force_x"), 0.);
    EXPECT_GT(values.at("friction_work"), 0.);
  }


  TEST(Driver, CheckWritesNothing)
  {
    const std::string  output = fresh_output_dir("check");
    const DriverResult result =
      run_driver({"--check",
                  "--output",
                  output,
                  NMM_SOURCE_DIR "/applications/nmm/scenes/ring.prm"});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find("manifold elements"), std::string::npos)
      << result.output;
    EXPECT_FALSE(fs::exists(output));
  }


  TEST(Driver, WritesTheFilesTheSceneAsksFor)
  {
    const std::string output = fresh_output_dir("files");
    const std::string scene =
      NMM_SOURCE_DIR "/applications/nmm/scenes/ring.prm";
    const auto exists = [&](const char *name) {
      return fs::exists(fs::path(output) / name);
    };
    DriverResult result = run_driver({"-o", output, scene});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (const char *name : {"summary.csv",
                             "probes.csv",
                             "fields.vtu",
                             "fields.pvd",
                             "picture.png"})
      EXPECT_TRUE(exists(name)) << name;

    // Results of an earlier run must not survive a run that does not make them.
    const Arguments fewer{"-o",
                          output,
                          "--set",
                          "Output/Fields=false",
                          "--set",
                          "Output/Picture=false",
                          "--set",
                          "Mathematical mesh/Cell size=0.5",
                          scene};
    result = run_driver(fewer + Arguments{"--set", "Probes/Names=inside"});
    // The sections of the probes no longer listed are now unknown.
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_TRUE(exists("picture.png"));
    result = run_driver(fewer);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_TRUE(exists("summary.csv"));
    for (const char *name : {"fields.vtu", "fields.pvd", "picture.png"})
      EXPECT_FALSE(exists(name)) << name;
    for (const auto &entry : fs::directory_iterator(output))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }


  TEST(Driver, WritesASeriesOfFields)
  {
    const std::string  output = fresh_output_dir("series");
    const DriverResult result =
      run_driver({"-o",
                  output,
                  "--set",
                  "Output/Fields every=1",
                  cases_dir + "finite-stretch/scene.prm"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (const char *name :
         {"history.csv", "fields-0001.vtu", "fields.vtu", "picture.png"})
      EXPECT_TRUE(fs::exists(fs::path(output) / name)) << name;
    EXPECT_TRUE(fs::exists(fs::path(output) / "picture-0001.png"));
    std::ifstream     file(fs::path(output) / "fields.pvd");
    std::stringstream pvd;
    pvd << file.rdbuf();
    for (const char *word :
         {"\"0.5\"", "fields-0001.vtu", "\"1\"", "fields-0002.vtu"})
      EXPECT_NE(pvd.str().find(word), std::string::npos) << pvd.str();
    for (const char *word : {"load factor 0.5", "iteration(s), 0 cut(s)"})
      EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
  }


  // Two bodies that slide with friction, in steps that are given: what the number of
  // ranks changes is Newton's tolerance of 1e-9 of all forces at the most, 2.5e-10 measured. So both
  // components of a force are compared with the larger one: the shear at the floor is a fifth of the
  // pressure. Left out are the balance, which is a difference of nearly equal numbers, the energy
  // of strain, which is small beside that of motion, and the iterations with the states that changed
  // in them: blocks are told apart, and begin where they are, on one rank only.
  TEST(Driver, MotionWithFrictionIsTheSameOnTwoRanks)
  {
    std::map<std::string, double> values[2];
    for (const unsigned int n_ranks : {1, 2})
    {
      const std::string  output = fresh_output_dir("ranks");
      const DriverResult result =
        run_driver({"-o",
                    output,
                    "--set",
                    "Time/End time=0.05",
                    cases_dir + "contact-two-laws/scene.prm"},
                   n_ranks);
      ASSERT_EQ(result.exit_code, 0) << result.output;
      for (const auto &[name, value] : read_results(output))
        if (name.rfind("history/", 0) == 0)
          values[n_ranks - 1][name] = value;
    }
    // the largest of each column is what its values are compared with
    const auto column_of = [](const std::string &name) {
      const std::string column = name.substr(name.rfind('/') + 1);
      const auto        force  = column.find("_force_");
      return force == std::string::npos ? column : column.substr(0, force + 6);
    };
    std::map<std::string, double> sizes;
    for (const auto &[name, value] : values[0])
    {
      double &size = sizes[column_of(name)];
      size         = std::max(size, std::abs(value));
    }
    ASSERT_EQ(values[0].count("history/10/time"), 1U);
    ASSERT_EQ(values[0].size(), values[1].size());
    EXPECT_GT(sizes.at("contact_slip"), 0.);
    for (const auto &[name, value] : values[0])
    {
      const std::string column = column_of(name);
      if (column == "balance" || column == "strain" ||
          column == "contact_changes" || column == "iterations")
        continue;
      EXPECT_NEAR(values[1].at(name), value, 1e-9 * sizes.at(column)) << name;
    }
  }


  // Contact points of each state as a table and for ParaView.
  TEST(Driver, WritesContactPoints)
  {
    const std::string  output = fresh_output_dir("contacts");
    const DriverResult result =
      run_driver({"-o",
                  output,
                  "--set",
                  "Output/Fields every=8",
                  "--set",
                  "Output/Picture=true",
                  cases_dir + "contact-bond/scene.prm"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (const char *name : {"contacts-0001.vtp",
                             "contacts-0002.vtp",
                             "contacts.vtp",
                             "contacts.pvd",
                             "picture-0001.png",
                             "animation.html"})
      EXPECT_TRUE(fs::exists(fs::path(output) / name)) << name;
    for (const char *word : {"28 stick", "28 bonded", "28 change(s)"})
      EXPECT_NE(result.output.find(word), std::string::npos) << result.output;

    std::ifstream file(fs::path(output) / "contacts.csv");
    std::string   line;
    std::getline(file, line);
    const auto                     columns = split(line, ',');
    std::map<double, unsigned int> n_bonded;
    std::map<double, double>       force;
    while (std::getline(file, line))
    {
      const auto fields = split(line, ',');
      ASSERT_EQ(fields.size(), columns.size());
      std::map<std::string, std::string> row;
      for (std::size_t i = 0; i < fields.size(); ++i)
        row[columns[i]] = fields[i];
      EXPECT_EQ(row["slave"], "seam");
      EXPECT_EQ(row["master"], "seam");
      EXPECT_EQ(row["state"] == "stick", row["bonded"] == "1");
      EXPECT_NEAR(std::stod(row["reference_x"]), 1., 1e-12);
      const double factor = std::stod(row["load_factor"]);
      n_bonded[factor] += row["bonded"] == "1";
      force[factor] += std::stod(row["weight"]) * std::stod(row["pressure"]);
    }
    // states 8 and 16 of 20, and the last one; the seam breaks in step 16
    ASSERT_EQ(n_bonded.size(), 3U);
    EXPECT_EQ(n_bonded.at(0.4), 28U);
    EXPECT_EQ(n_bonded.at(0.8), 0U);
    // 1.6 mm over 3 / E + 1 / 7.5e10, on 1 m; CSV has 12 digits
    EXPECT_NEAR(force.at(0.4), -1.6e-3 / (3e-9 + 1. / 7.5e10), 1e-3);
    EXPECT_EQ(force.at(1.), 0.);
  }


  // The page of a motion, with a choice of colours; velocities are in fields, too.
  TEST(Driver, AnimationOffersQuantities)
  {
    const std::string  output = fresh_output_dir("animation");
    const DriverResult result =
      run_driver({"-o",
                  output,
                  "--set",
                  "Time/End time=0.1",
                  "--set",
                  "Output/Fields=true",
                  "--set",
                  "Output/Picture=true",
                  "--set",
                  "Output/Fields every=5",
                  "--set",
                  "Output/Animation quantities=velocity, velocity, stress yy, "
                  "von Mises stress",
                  cases_dir + "contact-incline/scene.prm"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const auto read = [&](const char *name) {
      std::ifstream     file(fs::path(output) / name);
      std::stringstream text;
      text << file.rdbuf();
      return text.str();
    };
    // each once, the picture's own first
    const std::string page = read("animation.html");
    EXPECT_NE(page.find("<script>choices([\"von Mises stress\",\"velocity\","
                        "\"stress yy\"])</script>"),
              std::string::npos);
    unsigned int n_frames = 0;
    for (auto i = page.find("<script>frame("); i != std::string::npos;
         i      = page.find("<script>frame(", i + 1))
    {
      ++n_frames;
      const std::string frame = page.substr(i, page.find('\n', i) - i);
      // time, label and png, in the frame's own range, too, perhaps; four or seven
      // values in quotes
      const bool has_own = frame.find("],\"own\":[") != std::string::npos;
      EXPECT_EQ(std::count(frame.begin(), frame.end(), '['), has_own ? 2 : 1);
      EXPECT_EQ(std::count(frame.begin(), frame.end(), '"'), has_own ? 22 : 14);
    }
    EXPECT_GE(n_frames, 3u);
    EXPECT_NE(read("fields.vtu").find("Name=\"velocity\""), std::string::npos);
  }


  // Faces with a gap and nothing else that holds: the block is named.
  TEST(Driver, WhatContactDoesNotHoldIsNamed)
  {
    const std::string  output = fresh_output_dir("not-held");
    const DriverResult result =
      run_driver({"-o",
                  output,
                  "--set",
                  "Obstacles/floor/Shape=LINESTRING (100 -0.1, -100 -0.1)",
                  cases_dir + "contact-stack/scene.prm"});
    EXPECT_EQ(result.exit_code, 3) << result.output;
    for (const char *word : {"Contact alone", "floats", "relaxation"})
      EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
  }


  // A floor drawn the wrong way round.
  TEST(Driver, ObstaclesBehindTheSolidAreTold)
  {
    const std::string scene  = cases_dir + "contact-stack/scene.prm";
    const std::string notice = "lies on the left of the obstacle 'floor'";
    EXPECT_EQ(run_driver({"--check", scene}).output.find(notice),
              std::string::npos);
    EXPECT_NE(run_driver({"--check",
                          "--set",
                          "Obstacles/floor/Shape=LINESTRING (-100 0, 100 0)",
                          scene})
                .output.find(notice),
              std::string::npos);
  }


  TEST(Driver, SceneAsJsonGivesTheSameResult)
  {
    const std::string scene =
      NMM_SOURCE_DIR "/applications/nmm/scenes/quarter-ring.prm";
    const DriverResult json = run_driver({"--print-parameters=json", scene});
    ASSERT_EQ(json.exit_code, 0) << json.output;
    const std::string file_name = NMM_TEST_OUTPUT_DIR "/quarter-ring.json";
    std::ofstream(file_name) << json.output;

    const std::string              output = fresh_output_dir("json");
    const std::vector<std::string> coarse = {"-o",
                                             output,
                                             "--set",
                                             "Mathematical mesh/Cell size=0.3"};
    std::vector<double>            errors;
    for (const std::string &name : {scene, file_name})
    {
      std::vector<std::string> arguments = coarse;
      arguments.push_back(name);
      const DriverResult result = run_driver(arguments);
      ASSERT_EQ(result.exit_code, 0) << result.output;
      errors.push_back(read_results(output).at("error_displacement_l2"));
    }
    EXPECT_GT(errors[0], 0.);
    EXPECT_DOUBLE_EQ(errors[0], errors[1]);
  }


  TEST(Driver, PagesFromTheCodeAreUpToDate)
  {
    for (const auto &[option, page] :
         {std::make_pair("--print-parameters=markdown", "doc/parameters.md"),
          std::make_pair("--print-capabilities", "doc/capabilities.md")})
    {
      const DriverResult generated = run_driver({option});
      ASSERT_EQ(generated.exit_code, 0) << generated.output;
      std::ifstream     file(NMM_SOURCE_DIR + std::string("/") + page);
      std::stringstream committed;
      committed << file.rdbuf();
      EXPECT_TRUE(committed.str() == generated.output)
        << page << " does not match the code; regenerate it by\n"
        << "  build/release/bin/nmm " << option << " > " << page;
    }
  }
} // namespace
