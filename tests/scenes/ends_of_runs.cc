#include "rejected_input.h"
#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <iterator>
#include <regex>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

// How runs end that meet a limit: of memory, of numbers, of contact, of the disk.
using namespace rejected_input;

namespace
{
  namespace fs = std::filesystem;

  const std::string folder = NMM_TEST_OUTPUT_DIR "/ends";

  using Settings = std::vector<std::string>;


  DriverResult
  run_with(const Settings                 &settings,
           const std::vector<std::string> &more  = {},
           const std::string              &scene = base_scene)
  {
    std::vector<std::string> arguments = {"--output", folder};
    for (const std::string &setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.push_back(scene);
    return run_in_process(arguments);
  }


  std::string
  content(const std::string &name)
  {
    std::ifstream in(folder + "/" + name);
    return {std::istreambuf_iterator<char>(in), {}};
  }


  const Settings moving =
    dynamic + Settings{"Boundary conditions/held/Amplitude=sin(t)",
                       "Boundary conditions/held/Value=1; 0",
                       "Time/End time=0.25",
                       "Output/Fields every=2",
                       "Output/Checkpoint every=2"};


  TEST(EndsOfRuns, MoreMemoryThanThereIsIsRefused)
  {
    // 2.5e9 triangles of 4 kB
    expect_rejected_override("Mathematical mesh/Cell size=3e-5",
                             {"GB", "Cell size", "choose at least"});
    expect_rejected({"--set",
                     "Mathematical mesh/Type=graded",
                     "--set",
                     "Mathematical mesh/Cell size=3e-5",
                     base_scene},
                    {"GB", "Cell size"});
  }


  // Cracks that grow write fields and pictures as they go, each of the solid as it is cut then.
  TEST(EndsOfRuns, GrowingCracksAreShownStepByStep)
  {
    const DriverResult result =
      run_with({"Geometry/Text=" + square +
                  "; joint name=crack LINESTRING (0 0.5, 0.5 0.5)",
                "Fracture/Intensity factors=true",
                "Fracture/Grading=0.5",
                "Fracture/Increments=4",
                "Fracture/Increment=0.05",
                "Materials/rock/Toughness=1",
                "Boundary conditions/held/Value=0; y",
                "Output/Fields every=2"});
    if (!is_first_rank())
      return;
    EXPECT_EQ(result.exit_code, 0) << result.output;
    for (const char *name : {"fields-0001.vtu",
                             "fields-0002.vtu",
                             "picture-0001.png",
                             "picture-0002.png",
                             "animation.html",
                             "tips-0001.vtu",
                             "tips-0002.vtu",
                             "tips.vtu",
                             "tips.csv"})
      EXPECT_FALSE(content(name).empty()) << name;
    EXPECT_NE(content("fields.pvd").find("timestep=\"4\""), std::string::npos);
    EXPECT_NE(content("tips-0001.vtu").find("NumberOfPoints=\"1\""),
              std::string::npos);
    // ParaView shows fields and tips in step.
    EXPECT_EQ(std::regex_replace(content("tips.pvd"),
                                 std::regex("tips"),
                                 "fields"),
              content("fields.pvd"));
    const auto n_lines = [](const std::string &text) {
      return std::count(text.begin(), text.end(), '\n');
    };
    // a head, the state before and one after each increment
    EXPECT_EQ(n_lines(content("history.csv")), 6);
    EXPECT_EQ(n_lines(content("growth.csv")), 5);
  }


  // On the same mesh, intensity factors add tips to the picture and to files, and nothing else.
  TEST(EndsOfRuns, TipsAreShownIfTheirFactorsAreAskedFor)
  {
    std::string fields[2], picture[2];
    for (const bool with_factors : {false, true})
    {
      const DriverResult result =
        run_with({"Geometry/Text=" + square +
                    "; joint name=crack LINESTRING (0 0.5, 0.5 0.5)",
                  std::string("Fracture/Intensity factors=") +
                    (with_factors ? "true" : "false"),
                  "Fracture/Tips=as meshed",
                  "Boundary conditions/held/Value=0; y"});
      if (!is_first_rank())
        continue;
      EXPECT_EQ(result.exit_code, 0) << result.output;
      fields[with_factors]  = content("fields.vtu");
      picture[with_factors] = content("picture.png");
      for (const char *name : {"tips.csv", "tips.vtu", "tips.pvd"})
        EXPECT_EQ(fs::exists(folder + "/" + name), with_factors) << name;
    }
    EXPECT_TRUE(fields[0] == fields[1]);
    EXPECT_TRUE(!is_first_rank() || picture[0] != picture[1]);
  }


  TEST(EndsOfRuns, ExpressionsThatAreNotFiniteAreNamed)
  {
    expect_rejected_override("Model/Body force=0; log(x - 0.5)",
                             {"body force", "log(x - 0.5)", "nan at ("});
    expect_rejected_override("Boundary conditions/held/Value=1/(x - x); 0",
                             {"held", "1/(x - x)", "inf at ("});
    // a singularity between the points that are used is none of ours
    EXPECT_EQ(run_with({"Model/Body force=log(x); 0"}, {"--check"}).exit_code,
              0);
  }


  // Springs of 20 Pa/m under 20 Pa: the square would come to lie 1 m deep.
  TEST(EndsOfRuns, DeepPenetrationIsNoSolution)
  {
    const Settings soft = touching + dynamic +
                          Settings{"Boundary conditions/held/Components=x",
                                   "Fixed points/corner/Stiffness=1e-6",
                                   "Model/Gravity=0, -20",
                                   "Time/Initial step=0.02",
                                   "Output/Picture=false"};
    // a length that is given, and a cell where faces are looked for so deep
    for (const auto &[setting, limit] :
         {std::make_pair("Contact/Largest penetration=0.01", "of 0.01"),
          std::make_pair("Contact/Reach=2", "cell size at faces of 0.5")})
    {
      const DriverResult result = run_with(soft + Settings{setting});
      EXPECT_EQ(result.exit_code, 3) << result.output;
      for (const char *word : {"penetration", limit})
        EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
      EXPECT_NE(content("summary.csv").find("solved,0"), std::string::npos);
    }
    expect_rejected_override("Contact/Largest penetration=0.1",
                             {"Contact/Largest penetration",
                              "Contact/Enforcement"});
  }


  // Two steps of ten thousand radians turn elements inside out between quadrature
  // points, where stress has no value.
  TEST(EndsOfRuns, StressThatIsNotFiniteIsNoSolution)
  {
    const DriverResult result =
      run_with({"Initial velocities/spin/Angular velocity=1e6",
                "Time/End time=0.02",
                "Time/Initial step=0.01"},
               {},
               cases_dir + "spinning-block/scene.prm");
    EXPECT_EQ(result.exit_code, 3) << result.output;
    EXPECT_NE(result.output.find("not finite"), std::string::npos)
      << result.output;
    EXPECT_NE(content("summary.csv").find("solved,0"), std::string::npos);
  }


  // A kill between the last checkpoint and the last files loses nothing.
  TEST(EndsOfRuns, RestartAtTheEndWritesWhatIsMissing)
  {
    const DriverResult whole = run_with(moving);
    ASSERT_EQ(whole.exit_code, 0) << whole.output;
    const std::string fields = content("fields.vtu"),
                      probes = content("probes.csv"),
                      series = content("fields.pvd"),
                      page   = content("animation.html");
    EXPECT_EQ(series.find("<!--"), std::string::npos) << series;
    // the animation ends where the run does, after its last state of the series
    EXPECT_NE(page.find("t = 0.25"), std::string::npos);
    for (const char *name :
         {"fields.vtu", "probes.csv", "summary.csv", "animation.html"})
      fs::remove(folder + "/" + name);
    const DriverResult restarted =
      run_with(moving, {"--restart", folder + "/checkpoint.nmm"});
    EXPECT_EQ(restarted.exit_code, 0) << restarted.output;
    EXPECT_TRUE(fs::exists(folder + "/summary.csv"));
    EXPECT_TRUE(content("fields.vtu") == fields);
    EXPECT_EQ(content("probes.csv"), probes);
    EXPECT_EQ(content("fields.pvd"), series);
    EXPECT_TRUE(content("animation.html") == page);
  }


  // The disk is full after so many bytes of a file: of a table, a picture, fields, or the last of
  // these.
  TEST(EndsOfRuns, FilesThatDoNotFitAreNoInternalError)
  {
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t unlimited = limit.rlim_cur;
    const auto   action    = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t bytes : {300, 3000, 10000, 20000, 30000})
    {
      SCOPED_TRACE(bytes);
      limit.rlim_cur = bytes;
      setrlimit(RLIMIT_FSIZE, &limit);
      const DriverResult result = run_with(moving);
      limit.rlim_cur            = unlimited;
      setrlimit(RLIMIT_FSIZE, &limit);
      EXPECT_EQ(result.exit_code, 3) << result.output;
      if (is_first_rank())
      {
        EXPECT_NE(result.output.find("cannot be written (File too large)"),
                  std::string::npos)
          << result.output;
      }
      EXPECT_EQ(result.output.find("internal error"), std::string::npos)
        << result.output;
      if (is_first_rank())
        for (const auto &entry : fs::directory_iterator(folder))
        {
          EXPECT_NE(entry.path().extension(), ".part") << entry.path();
        }
    }
    std::signal(SIGXFSZ, action);
  }


  TEST(EndsOfRuns, ASecondRunInAFolderIsRefused)
  {
    EXPECT_EQ(run_with({}).exit_code, 0);
    const std::string before = content("summary.csv");
    const int         other  = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
    const DriverResult result = run_with({});
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find("another run writes its results to this "
                                 "folder, at --output "),
              std::string::npos)
      << result.output;
    EXPECT_EQ(content("summary.csv"), before);
    ::close(other);
    EXPECT_EQ(run_with({}).exit_code, 0);
  }


  TEST(EndsOfRuns, WhatIsPrintedWithoutASceneIsAScene)
  {
    for (const std::string format : {"prm", "json"})
    {
      const DriverResult printed =
        run_in_process({"--print-parameters=" + format});
      ASSERT_EQ(printed.exit_code, 0);
      const std::string name = write_scene("printed." + format, printed.output);
      const DriverResult result = run_with({"Output/Picture=false"}, {}, name);
      EXPECT_EQ(result.exit_code, 0) << result.output;
    }
  }
} // namespace
