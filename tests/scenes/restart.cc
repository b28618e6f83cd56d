#include "cases.h"
#include "result_files.h"
#include "run_in_process.h"
#include "table.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// Runs that are stopped or fail, and are continued from their checkpoint.
namespace
{
  namespace fs = std::filesystem;

  void
  run(const Arguments &arguments, const int exit_code = 0)
  {
    const DriverResult result = run_in_process(arguments);
    ASSERT_EQ(result.exit_code, exit_code) << result.output;
  }


  /// The rows of summary.csv: the text of the value of each name.
  std::map<std::string, std::string>
  read_summary(const std::string &folder)
  {
    const auto columns = read_columns(folder + "/summary.csv");
    std::map<std::string, std::string> rows;
    for (std::size_t i = 0; i < columns.at("name").size(); ++i)
      rows[columns.at("name")[i]] = columns.at("value")[i];
    return rows;
  }


  /// To the end in one go, and with a stop at @p half.
  void
  check_stop(const std::string &scene,
             const std::string &half,
             const Arguments   &more)
  {
    SCOPED_TRACE(scene);
    const Arguments settings =
      Arguments{"--set", "Output/Checkpoint every=7", cases_dir + scene} + more;
    const std::string straight = fresh_output_dir("straight");
    const std::string stopped  = fresh_output_dir("stopped");
    run(settings + Arguments{"-o", straight});
    run(settings + Arguments{"-o", stopped, "--set", "Time/End time=" + half});
    run(settings +
        Arguments{"-o", stopped, "--restart", stopped + "/checkpoint.nmm"});
    if (!is_first_rank())
      return;
    expect_same_histories(straight, stopped);
    EXPECT_TRUE(read_text(straight + "/checkpoint.nmm") ==
                read_text(stopped + "/checkpoint.nmm"));
    // These are maxima over all steps, not over those of the second part.
    const auto summary = read_summary(straight),
               of_both = read_summary(stopped);
    for (const char *row : {"energy_balance_relative", "largest_penetration"})
      if (summary.count(row) > 0)
      {
        EXPECT_EQ(of_both.at(row), summary.at(row)) << row;
      }
    EXPECT_TRUE(fs::exists(stopped + "/fields.vtu") ||
                fs::exists(stopped + "/fields.pvtu"));
  }


  TEST(Restart, StoppedRunsGoOnWithTheSameBitsMPI)
  {
    if (n_ranks() > 1)
    {
      check_stop("released-bar/scene.prm",
                 "0.35",
                 {"--set", "Time/End time=0.6"});
      check_stop("contact-incline/scene.prm",
                 "0.05",
                 {"--set", "Time/End time=0.1"});
      return;
    }
    // The release is in the second part.
    check_stop("released-bar/scene.prm", "0.4", {"--set", "Time/End time=0.7"});
    check_stop("spinning-block/scene.prm",
               "0.5",
               {"--set", "Time/End time=0.8"});
    // It slides and hops.
    check_stop("contact-incline/scene.prm",
               "0.1",
               {"--set", "Time/End time=0.2"});
    // The first block leaves in the first part, the second one in the second.
    check_stop("leaving-blocks/scene.prm", "0.9", {});
  }


  // A relaxation with which a motion starts is saved, too: it may take longer than the motion.
  TEST(Restart, StartsByRelaxationGoOnWithTheSameBits)
  {
    const Arguments   settings{"--set",
                             "Output/Checkpoint every=3",
                             "--set",
                             "Time/Start=relaxation",
                             "--set",
                             "Relaxation/Step=0.01",
                             "--set",
                             "Contact/Friction angle=35",
                             "--set",
                             "Time/End time=0.05",
                             cases_dir + "contact-incline/scene.prm"};
    const std::string straight = fresh_output_dir("straight-start");
    const std::string stopped  = fresh_output_dir("stopped-start");
    run(settings + Arguments{"-o", straight});
    // It does not come to rest in so few steps.
    run(settings +
          Arguments{"-o", stopped, "--set", "Relaxation/Maximum steps=7"},
        3);
    run(settings +
        Arguments{"-o", stopped, "--restart", stopped + "/checkpoint.nmm"});
    expect_same_histories(straight, stopped);
    EXPECT_TRUE(read_text(straight + "/checkpoint.nmm") ==
                read_text(stopped + "/checkpoint.nmm"));
    EXPECT_GT(std::stoi(read_summary(straight).at("start_steps")), 7);
    // Once it has started, the motion goes on from its own checkpoint.
    const std::string further = fresh_output_dir("further-start");
    run(settings + Arguments{"-o", further, "--set", "Time/End time=0.02"});
    run(settings +
        Arguments{"-o", further, "--restart", further + "/checkpoint.nmm"});
    expect_same_histories(straight, further);
  }


  // Blocks slide on each other and fall; all that contact remembers has to be in the
  // checkpoint. At the end of these 3 s the blocks are as fast as they ever get; Debug is
  // twenty times slower and sees the begin.
  TEST(Restart, SlopeGoesOnInItsSlide)
  {
#ifndef DEBUG
    const std::string end = "3";
#else
    const std::string end = "0.2";
#endif
    const Arguments   settings{"--set",
                             "Contact/Friction angle=20",
                             "--set",
                             "Output/Checkpoint every=1000",
                             "--set",
                             "Output/Fields every=0",
                             NMM_SOURCE_DIR
                             "/applications/nmm/scenes/slope.prm"};
    const std::string straight = fresh_output_dir("straight-slope");
    const std::string stopped  = fresh_output_dir("stopped-slope");
    run(settings + Arguments{"-o", straight, "--set", "Time/End time=" + end});
    const std::string history = read_text(straight + "/history.csv");
    const auto n_lines = std::count(history.begin(), history.end(), '\n');
    // at the end of a step of that run, whose length contact has chosen, after half of
    // them
    std::istringstream lines(history);
    std::string        line;
    for (unsigned int i = 0; i < n_lines / 2; ++i)
      std::getline(lines, line);
    const std::string half = line.substr(0, line.find(','));
    run(settings + Arguments{"-o", stopped, "--set", "Time/End time=" + half});
    run(settings + Arguments{"-o",
                             stopped,
                             "--set",
                             "Time/End time=" + end,
                             "--restart",
                             stopped + "/checkpoint.nmm"});
    EXPECT_GT(n_lines, 20);
    EXPECT_TRUE(history == read_text(stopped + "/history.csv"));
  }


  /// The contents of a file without the date of VTK files.
  std::string
  without_date(const std::string &text)
  {
    const std::size_t begin = text.find("<VTKFile");
    return begin == std::string::npos ? text : text.substr(begin);
  }


  /// All files but the summary, which has wall times, and the list of results are the same.
  void
  expect_same_files(const std::string &a, const std::string &b)
  {
    auto files = contents(a), others = contents(b);
    for (auto *all : {&files, &others})
    {
      EXPECT_EQ(all->erase("summary.csv"), 1u);
    }
    EXPECT_EQ(files.size(), others.size());
    for (const auto &[name, text] : files)
      EXPECT_TRUE(without_date(text) == without_date(others[name]))
        << a << '/' << name << " and that of " << b << " differ";
  }


  /// Stops where cracks grow for the second time, before and after the cut, and two steps
  /// later, while the closing forces fade.
  void
  check_stops_in_growth(const std::string &scene, const Arguments &more)
  {
    SCOPED_TRACE(scene);
    const Arguments settings =
      Arguments{"--set",
                "Output/Checkpoint every=7",
                "--set",
                "Output/Fields every=20",
                NMM_SOURCE_DIR "/tests/scenes/" + scene + "/scene.prm"} +
      more;
    const std::string straight = fresh_output_dir("straight-growth");
    run(settings + Arguments{"-o", straight});
    const auto times = read_columns(straight + "/history.csv")["time"];
    const auto steps = read_columns(straight + "/growth.csv")["step"];
    // Several cracks may grow in the same step.
    const auto n_of_first = static_cast<unsigned int>(
      std::count(steps.begin(), steps.end(), steps.at(0)));
    ASSERT_GT(steps.size(), n_of_first);
    const unsigned int second = std::stoi(steps[n_of_first]);
    const auto         n_of_both =
      n_of_first + static_cast<unsigned int>(
                     std::count(steps.begin(), steps.end(), steps[n_of_first]));
    ASSERT_GT(steps.size(), n_of_both);
    struct Stop
    {
      unsigned int step, n_increments;
      Arguments    arguments;
    };
    for (const Stop &stop :
         {Stop{second,
               n_of_first,
               {"--set", "Fracture/Increments=" + std::to_string(n_of_first)}},
          Stop{second, n_of_both, {}},
          Stop{second + 2, n_of_both, {}}})
    {
      SCOPED_TRACE("stop at " + times.at(stop.step) + " s after " +
                   std::to_string(stop.n_increments) + " increment(s)");
      const std::string stopped = fresh_output_dir("stopped-growth");
      run(
        settings + stop.arguments +
        Arguments{"-o", stopped, "--set", "Time/End time=" + times[stop.step]});
      EXPECT_EQ(read_columns(stopped + "/growth.csv")["step"].size(),
                stop.n_increments);
      run(settings +
          Arguments{"-o", stopped, "--restart", stopped + "/checkpoint.nmm"});
      expect_same_files(straight, stopped);
    }
  }


  TEST(Restart, CracksGoOnInTheirGrowth)
  {
    // With contact, and a block that comes free; 50 s in Debug.
#ifndef DEBUG
    check_stops_in_growth(
      "bar-breaks",
      {"--set", "Time/End time=0.06", "--set", "Model/Kinematics=finite"});
#endif
    // New cracks that start.
    check_stops_in_growth("bar-with-hole-breaks",
                          {"--set", "Time/End time=0.055"});
  }


  /// Stops after @p n_first increments of cracks in equilibrium and goes on to @p n.
  void
  check_stop_in_equilibrium(const std::string &scene,
                            const unsigned int n_first,
                            const unsigned int n,
                            const Arguments   &more)
  {
    SCOPED_TRACE(scene);
    const auto settings = [&](const std::string &folder,
                              const unsigned int n_increments) {
      return Arguments{"-o",
                       folder,
                       "--set",
                       "Output/Checkpoint every=2",
                       "--set",
                       "Output/Fields every=1",
                       "--set",
                       "Fracture/Increments=" + std::to_string(n_increments),
                       NMM_SOURCE_DIR + ("/" + scene)} +
             more;
    };
    const std::string straight = fresh_output_dir("straight-path");
    const std::string stopped  = fresh_output_dir("stopped-path");
    run(settings(straight, n));
    EXPECT_EQ(read_columns(straight + "/history.csv")["step"].size(), n + 1);
    run(settings(stopped, n_first));
    run(settings(stopped, n) +
        Arguments{"--restart", stopped + "/checkpoint.nmm"});
    expect_same_files(straight, stopped);
  }


  TEST(Restart, CracksGoOnInEquilibrium)
  {
    // With covers of tips, and increments that are turned.
    check_stop_in_equilibrium("applications/nmm/scenes/three-hole-beam.prm",
                              2,
                              4,
                              {"--set", "Fracture/Criterion=local symmetry"});
#ifndef DEBUG // together they take half a minute there
    // With contact: wings of a closed flaw.
    check_stop_in_equilibrium("tests/scenes/closed-crack/scene.prm",
                              1,
                              2,
                              {"--set", "Fracture/Increment=0.1"});
    // A crack that starts.
    check_stop_in_equilibrium("tests/scenes/hole-cracks/scene.prm", 1, 3, {});
#endif
  }


  TEST(Restart, GoesOnInAnotherFolder)
  {
    const std::string first  = fresh_output_dir("first");
    const std::string second = fresh_output_dir("second");
    const Arguments   settings{"--set",
                             "Output/Checkpoint every=10",
                             cases_dir + "free-fall/scene.prm"};
    run(settings + Arguments{"-o", first, "--set", "Time/End time=0.25"});
    const auto before = contents(first);
    run(settings +
        Arguments{"-o", second, "--restart", first + "/checkpoint.nmm"});
    EXPECT_TRUE(before == contents(first));
    const std::string history = read_text(second + "/history.csv");
    // A line of names, the state it starts from, 25 steps.
    EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 27);
    EXPECT_NE(history.find(",25,0,0,0,"), std::string::npos) << history;
  }


  void
  expect_refused(const std::string              &checkpoint,
                 const std::string              &scene,
                 const Arguments                &more,
                 const std::vector<std::string> &words)
  {
    SCOPED_TRACE(scene + ": " + words.front());
    const std::string folder = fs::path(checkpoint).parent_path().string();
    const auto        before = contents(folder);
    const auto        result =
      run_in_process(Arguments{"-o", folder, "--restart", checkpoint} + more +
                     Arguments{cases_dir + scene});
    EXPECT_EQ(result.exit_code, 2) << result.output;
    if (!is_first_rank())
      return;
    for (const std::string &word : words)
      EXPECT_NE(result.output.find(word), std::string::npos)
        << "'" << word << "' is missing in: " << result.output;
    EXPECT_TRUE(before == contents(folder));
  }


  TEST(Restart, RefusesWhatDoesNotFitMPI)
  {
    const std::string folder     = fresh_output_dir("refused");
    const std::string checkpoint = folder + "/checkpoint.nmm";
    const std::string scene      = "free-fall/scene.prm";
    run({"-o",
         folder,
         "--set",
         "Output/Checkpoint every=10",
         "--set",
         "Time/End time=0.2",
         cases_dir + scene});

    expect_refused(folder + "/none.nmm", scene, {}, {"none.nmm", "missing"});
    expect_refused(checkpoint,
                   scene,
                   {"--set", "Mathematical mesh/Cell size=0.4"},
                   {"another mesh", "checkpoint.nmm"});
    if (n_ranks() > 1)
      return;
    expect_refused(checkpoint,
                   scene,
                   {"--set", "Materials/rock/Density=900"},
                   {"material"});
    expect_refused(checkpoint,
                   scene,
                   {"--set", "Time/Scheme=newmark"},
                   {"scheme"});
    expect_refused(checkpoint,
                   scene,
                   {"--set",
                    "Model/Kinematics=small",
                    "--set",
                    "Time/Scheme=energy momentum"},
                   {"kinematics"});
    expect_refused(checkpoint,
                   scene,
                   {"--set", "Time/End time=0.1"},
                   {"Time/End time", "0.1"});
    expect_refused(checkpoint,
                   "base.prm",
                   {},
                   {"--restart", "neither a dynamic"});
    expect_refused(checkpoint,
                   "double-cantilever/scene.prm",
                   {},
                   {"of a motion", "the growth of cracks in equilibrium"});
    // Other probes: other columns.
    expect_refused(checkpoint,
                   scene,
                   {"--set",
                    "Probes/corner/Type=line",
                    "--set",
                    "Probes/Names=corner, more",
                    "--set",
                    "Probes/more/Point=0.5, 0.5",
                    "--set",
                    "Probes/corner/To=1, 1"},
                   {"probes-history.csv", "columns"});

    const std::string whole   = read_text(checkpoint);
    std::string       damaged = whole;
    damaged[damaged.size() / 2] ^= 4;
    std::ofstream(folder + "/damaged.nmm", std::ios::binary) << damaged;
    expect_refused(folder + "/damaged.nmm", scene, {}, {"damaged"});
    std::ofstream(folder + "/cut.nmm", std::ios::binary)
      << whole.substr(0, whole.size() - 8);
    expect_refused(folder + "/cut.nmm", scene, {}, {"bytes instead of"});
    std::ofstream(folder + "/text.nmm") << "something else altogether, of "
                                           "some length";
    expect_refused(folder + "/text.nmm", scene, {}, {"no checkpoint"});
  }


  TEST(Restart, RefusesGrowthThatDoesNotFit)
  {
    const std::string folder     = fresh_output_dir("refused-growth");
    const std::string checkpoint = folder + "/checkpoint.nmm";
    const std::string scene      = "bar-breaks/scene.prm";
    run({"-o",
         folder,
         "--set",
         "Output/Checkpoint every=10",
         "--set",
         "Time/End time=0.054",
         cases_dir + scene});
    ASSERT_TRUE(fs::exists(folder + "/growth.csv"));
    expect_refused(checkpoint,
                   scene,
                   {"--set", "Mathematical mesh/Cell size=0.2"},
                   {"another mesh"});
    expect_refused(checkpoint,
                   scene,
                   {"--set",
                    "Geometry/Text=boundary name=sides material=rock "
                    "LINESTRING (0 3, 0 0); boundary name=bottom LINESTRING "
                    "(0 0, 0.5 0); boundary name=sides LINESTRING (0.5 0, "
                    "0.5 3); boundary name=top LINESTRING (0.5 3, 0 3); "
                    "joint name=crack LINESTRING (-0.1 1.5, 0.4 1.5)"},
                   {"ends elsewhere", "the scene it was written with"});
    {
      const std::string path       = fresh_output_dir("refused-path");
      const std::string cantilever = "double-cantilever/scene.prm";
      run({"-o",
           path,
           "--set",
           "Output/Checkpoint every=1",
           "--set",
           "Fracture/Increments=1",
           cases_dir + cantilever});
      expect_refused(path + "/checkpoint.nmm",
                     cantilever,
                     {"--set", "Materials/strip/Toughness=11"},
                     {"mesh, geometry or material"});
      expect_refused(path + "/checkpoint.nmm",
                     cantilever,
                     {"--set", "Boundary conditions/open up/Value=0; 3"},
                     {"load factor of the checkpoint"});
      expect_refused(path + "/checkpoint.nmm",
                     cantilever,
                     {"--set",
                      "Probes/Names=upper arm, more",
                      "--set",
                      "Probes/more/Point=9, 0"},
                     {"other probes"});
    }
    // What has grown is at the beginning of the file.
    std::string damaged = read_text(checkpoint);
    damaged[100] ^= 1;
    std::ofstream(folder + "/damaged.nmm", std::ios::binary) << damaged;
    expect_refused(folder + "/damaged.nmm", scene, {}, {"damaged"});
  }


  TEST(Restart, FailedRunsGoOnFromTheLastGoodState)
  {
    const std::string output = fresh_output_dir("failed");
    const Arguments   settings{"-o",
                             output,
                             "--set",
                             "Time/Largest displacement=0.0208",
                             "--set",
                             "Initial velocities/throw/Translation=0, 0",
                             "--set",
                             "Output/Picture=true",
                             cases_dir + "free-fall/scene.prm"};
    run(settings + Arguments{"--set", "Time/Smallest step=0.01"}, 3);
    for (const char *name : {"summary.csv",
                             "history.csv",
                             "probes-history.csv",
                             "probes.csv",
                             "fields.vtu",
                             "picture.png",
                             "checkpoint.nmm"})
      EXPECT_TRUE(fs::exists(output + "/" + name)) << name;
    run(settings + Arguments{"--restart", output + "/checkpoint.nmm"});
    // A parabola, however steps are cut.
    const std::string  history = read_text(output + "/probes-history.csv");
    std::istringstream row(
      history.substr(history.rfind('\n', history.size() - 2) + 1));
    double time = 0., x = 0., y = 0.;
    int    step = 0;
    char   comma;
    row >> time >> comma >> step >> comma >> x >> comma >> y;
    EXPECT_NEAR(time, 0.5, 1e-12);
    EXPECT_NEAR(y, -1.25, 1e-8);
    EXPECT_GT(step, 50);
  }


  TEST(Restart, StaticSeriesIsThereWhenTheNextStepFails)
  {
    const std::string output = fresh_output_dir("static-series");
    Arguments         arguments{"-o",
                        output,
                        "--set",
                        "Output/Fields every=1",
                        "--set",
                        "Load steps/Load factors=0.1, 0.2, 1000",
                        "--set",
                        "Load steps/Smallest step=0.9",
                        "--set",
                        "Mathematical mesh/Cell size=0.5",
                        NMM_SOURCE_DIR
                        "/applications/nmm/scenes/cantilever.prm"};
    for (const char *side : {"top", "bottom"})
      for (const std::string value :
           {"Type=follower pressure",
            side[0] == 't' ? "Value=50" : "Value=-50"})
        arguments =
          arguments + Arguments{"--set",
                                "Boundary conditions/" + std::string(side) +
                                  " load/" + value};
    run(arguments, 3);
    check_series(output);
    for (const char *name :
         {"fields-0002.vtu", "picture-0002.png", "history.csv"})
      EXPECT_TRUE(fs::exists(output + "/" + name)) << name;
  }
} // namespace
