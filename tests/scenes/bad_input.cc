#include "rejected_input.h"

using namespace rejected_input;

namespace
{
  TEST(BadInput, TheBaseSceneIsGood)
  {
    // Otherwise everything below would pass for the wrong reason.
    const DriverResult result = run_in_process({"--check", base_scene});
    EXPECT_EQ(result.exit_code, 0) << result.output;
  }


  TEST(BadInput, CommandLine)
  {
    expect_rejected({}, {"scene"});
    expect_rejected({base_scene, base_scene}, {"2 scene files"});
    expect_rejected({"--sett", "a/b=c", base_scene}, {"--sett", "--help"});
    expect_rejected({"--print-parameters=yaml"}, {"yaml", "markdown"});
    expect_rejected({"no-such-file.prm"}, {"no-such-file.prm"});
    expect_rejected({NMM_SOURCE_DIR}, {NMM_SOURCE_DIR});
  }


  TEST(BadInput, OutputFolderThatCannotBeMade)
  {
    const DriverResult result =
      run_in_process({"--output", base_scene + "/results", base_scene});
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find("is not a folder"), std::string::npos)
      << result.output;
  }


  TEST(BadInput, Overrides)
  {
    expect_rejected_override("Solver/Type", {"Solver/Type", "'='"});
    expect_rejected_override("Type=direct", {"Section/Key"});
    expect_rejected_override("Solvr/Type=direct", {"Solvr", "'Solver'"});
    expect_rejected_override("Solver/Tipe=direct", {"Tipe", "'Type'"});
    expect_rejected_override("Solver/Type=fast",
                             {"fast", "Solver/Type", "iterative"});
    expect_rejected_override("Materials/rok/Density=1",
                             {"the section 'rok' is not listed",
                              "add 'rok' to 'Materials/Names'",
                              "'rock'"});
    for (const char *section : {"Joint sets",
                                "Regions",
                                "Covers",
                                "Boundary conditions",
                                "Point forces",
                                "Contact",
                                "Obstacles",
                                "Initial velocities",
                                "Probes"})
      expect_rejected_override(std::string(section) + "/left out/Kind=0",
                               {"the section 'left out' is not listed",
                                std::string("add 'left out' to '") + section +
                                  "/Names'"});
    expect_rejected_override("Materials/rock/Density=-1", {"-1", "Density"});
    expect_rejected_override("Materials/Names=rock, rock", {"rock", "twice"});
    expect_rejected_override("Materials/Names=a/b", {"a/b", "slash"});
  }


  TEST(BadInput, SceneFile)
  {
    expect_rejected({write_scene("section.prm",
                                 "subsection Geometri\n  set File = x\nend\n")},
                    {"section.prm:1", "Geometri", "'Geometry'"});
    expect_rejected({write_scene("key.prm",
                                 "subsection Geometry\n  set Fill = x\nend\n")},
                    {"key.prm:2", "'Fill'", "'File'", "'Geometry'"});
    expect_rejected({write_scene("value.prm",
                                 "# a comment\nsubsection Model\n"
                                 "  set Thickness = thick\nend\n")},
                    {"value.prm:3", "'thick'", "Model/Thickness"});
    expect_rejected({write_scene("nested.prm",
                                 "subsection Materials\n  set Names = rock\n"
                                 "  subsection rok\n  end\nend\n")},
                    {"nested.prm:3", "'rok'", "'Materials/Names'", "'rock'"});
    expect_rejected({write_scene("unlisted.prm",
                                 "subsection Materials\n"
                                 "  subsection rock\n  end\nend\n")},
                    {"unlisted.prm:2", "add 'rock' to 'Materials/Names'"});
    expect_rejected({write_scene("syntax.prm",
                                 "subsection Model\n  Thickness = 1\nend\n")},
                    {"syntax.prm:2"});
    expect_rejected({write_scene("open.prm", "subsection Model\n")},
                    {"open.prm", "'Model' is never closed"});
    expect_rejected({write_scene("empty.prm", "")}, {"empty.prm"});
    expect_rejected({write_scene("syntax.json", "{\"Model\": \n}")},
                    {"syntax.json:2"});
    expect_rejected({write_scene("key.json", "{\"Geometry\": {\"Fill\": 1}}")},
                    {"key.json", "'Fill'", "'File'"});
  }


  TEST(BadInput, Parameters)
  {
    expect_rejected_override("Geometry/Text=", {"no geometry", "'File'"});
    expect_rejected_override("Geometry/File=x.wkt", {"two geometries"});
    expect_rejected_override("Mathematical mesh/Cell size=0", {"Cell size"});
    expect_rejected_override("Mathematical mesh/Cell size=-1", {"Cell size"});
    expect_rejected_override("Mathematical mesh/Cell size=nan", {"Cell size"});
    expect_rejected_override("Mathematical mesh/Cell size=1e-9", {"cell"});
    expect_rejected_override("Mathematical mesh/Offset=3e28, 0",
                             {"Offset", "a million cells"});
    // about 2,500 blocks of 2e6 cells
    expect_rejected_with({"Joint sets/Names=flat, steep",
                          "Joint sets/flat/Spacing=0.02",
                          "Joint sets/steep/Dip=90",
                          "Joint sets/steep/Spacing=0.02",
                          "Covers/Own meshes=every region"},
                         "Covers/Elements across=1000",
                         {"own meshes", "memory", "across"});
    expect_rejected_override("Mathematical mesh/Degree=3", {"Degree"});
    expect_rejected_override("Mathematical mesh/Type=gmsh", {"Gmsh file"});
    expect_rejected_override("Materials/rock/Young's modulus=0", {"rock", "0"});
    expect_rejected_override("Materials/rock/Poisson's ratio=0.5", {"rock"});
    expect_rejected_override("Materials/rock/Poisson's ratio=0.6",
                             {"0.6", "Poisson"});
    expect_rejected_override("Model/Thickness=0", {"Thickness"});
    expect_rejected_override("Model/Gravity=1", {"Gravity"});
    expect_rejected_override("Model/Body force=x", {"Body force", "two"});
    expect_rejected_override("Model/Body force=x; y +", {"Body force", "y +"});
    expect_rejected_override("Model/Body force=x; z", {"Body force", "z"});
    expect_rejected_override("Boundary conditions/held/Boundary=base",
                             {"held", "base"});
    expect_rejected_override("Boundary conditions/held/Boundary=",
                             {"held", "Boundary"});
    expect_rejected_override("Boundary conditions/held/Value=0",
                             {"held", "semicolon"});
    expect_rejected_override("Probes/inside/Point=2, 2",
                             {"inside", "(2, 2)", "outside"});
    expect_rejected_override("Fixed points/corner/Point=2, 2", {"(2, 2)"});
    expect_rejected_override("Output/Picture range=2, 1", {"Picture range"});
    expect_rejected_override("Output/Picture quantity=velocity",
                             {"velocity", "Picture quantity", "dynamic"});
    expect_rejected_override(
      "Output/Animation quantities=displacement, velocity",
      {"velocity", "Animation quantities", "dynamic"});
    expect_rejected_override("Output/Animation quantities=colour",
                             {"colour", "Animation quantities"});
    expect_rejected_override("Exact solution/Type=thick ring", {"boundar"});
  }


  TEST(BadInput, SmallKinematicsHasNoLoadSteps)
  {
    expect_rejected_override("Model/Kinematics=large", {"large", "finite"});
    expect_rejected_override("Materials/rock/Law=rubber",
                             {"rubber", "neo-Hookean"});
    expect_rejected_override("Materials/rock/Law=neo-Hookean",
                             {"Materials/rock/Law", "small"});
    expect_rejected_override("Load steps/Number of steps=20",
                             {"Load steps/Number of steps", "20", "small"});
    expect_rejected_override("Load steps/Smallest step=0.25",
                             {"Load steps/Smallest step",
                              "0.25",
                              "without contact",
                              "Contact/Enforcement = penalty"});
    expect_rejected_override("Load steps/Load factors=0.5, 1",
                             {"Load steps/Load factors",
                              "0.5",
                              "small",
                              "without contact",
                              "Contact/Enforcement = penalty",
                              "Mohr-Coulomb"});
    expect_rejected_override("Newton/Residual tolerance=1e-6",
                             {"Newton/Residual tolerance", "1e-06", "small"});
    expect_rejected_override("Newton/Energy tolerance=1e-6",
                             {"Newton/Energy tolerance", "1e-06", "small"});
    expect_rejected_override("Newton/Maximum iterations=30",
                             {"Newton/Maximum iterations", "30", "small"});
    expect_rejected_override("Output/Fields every=2",
                             {"Output/Fields every", "2", "small"});
  }


  TEST(BadInput, MaterialsThatYield)
  {
    const std::string scene =
      NMM_SOURCE_DIR "/applications/nmm/scenes/yielding-tunnel.prm";
    const auto expect_rejected_rock =
      [&](const std::string &override, const std::vector<std::string> &words) {
        SCOPED_TRACE(override);
        expect_rejected({"--set", override, scene}, words);
      };
    expect_rejected({"--set",
                     "Model/Plane state=plane stress",
                     "--set",
                     "Materials/rock/Cohesion=0",
                     scene},
                    {"cohesion", "rock", "plane stress"});
    expect_rejected_rock("Materials/rock/Cohesion=-1",
                         {"Materials/rock/Cohesion", "-1"});
    expect_rejected_rock("Materials/rock/Friction angle=90",
                         {"Materials/rock/Friction angle", "90 degrees"});
    expect_rejected_rock("Materials/rock/Dilation angle=31",
                         {"dilation angle", "rock", "friction angle"});
    expect_rejected_rock("Materials/rock/Law=linear",
                         {"Materials/rock/Friction angle",
                          "linear",
                          "Mohr-Coulomb"});
    expect_rejected_rock("Materials/rock/Initial stress=1, 2",
                         {"Initial stress"});
    expect_rejected_rock("Solver/Type=iterative", {"Solver/Type", "yield"});
    expect_rejected_override("Output/Picture quantity=plastic strain",
                             {"Picture quantity", "yields", "Mohr-Coulomb"});
  }


  TEST(BadInput, InitialStressThatVaries)
  {
    const std::string key = "Materials/rock/Initial stress";
    expect_rejected_override(key + "=x; y", {key, "2 component(s)", "3 or 4"});
    expect_rejected_override(key + "=1, 2, x", {key, "'x'", "semicolons"});
    expect_rejected_override(key + "=x; y; t", {key, "no valid expression"});
    expect_rejected_override(key + "=rand(); y; 0", {key, "rand()"});
    expect_rejected_override(key + "=1/(x-x); y; 0",
                             {"the initial stress", "1/(x-x)", "inf"});
    expect_rejected_override(key + "=x; y; 0; 1", {"rock", "plane strain"});
  }


  TEST(BadInput, InSituStress)
  {
    const std::string section = "In-situ stress/";
    expect_rejected_override(section + "K0=0.5", {section + "K0", "Type = K0"});
    expect_rejected_override(section + "Type=K0",
                             {"Model/Gravity", "downwards"});
    const auto expect = [&](const std::string              &override,
                            const std::vector<std::string> &words) {
      SCOPED_TRACE(override);
      expect_rejected({"--set",
                       section + "Type=K0",
                       "--set",
                       "Model/Gravity=0, -9.81",
                       "--set",
                       "Materials/rock/Density=2000",
                       "--set",
                       override,
                       base_scene},
                      words);
    };
    expect(section + "K0=half", {section + "K0", "'half'", "number"});
    expect(section + "K0=-1", {"K0 is -1", "not negative"});
    expect(section + "K0 out of plane=1", {"plane stress", "plane strain"});
    expect(section + "Unit weight above=1", {"ground line"});
    expect(section + "Ground line=1 2 3", {section + "Ground line", "1 2 3"});
    expect(section + "Ground line=0 1, 0 2", {"ground line", "ascending x"});
    expect("Model/Gravity=1, -9.81", {"Model/Gravity", "downwards"});
    expect("Materials/rock/Initial stress=1, 0, 0",
           {"Materials/rock/Initial stress", "in-situ stress"});
  }


  // The paper's scheme is a matter of a tutorial program.
  TEST(BadInput, IncrementalKinematics)
  {
    const std::vector<std::string> words = {"incremental",
                                            "Model/Kinematics",
                                            "step-nmm-2",
                                            "small or finite"};
    expect_rejected_override("Model/Kinematics=incremental", words);
    expect_rejected_with(dynamic, "Model/Kinematics=incremental", words);
    expect_rejected_with(touching, "Model/Kinematics=incremental", words);
  }


  TEST(BadInput, FiniteKinematics)
  {
    const auto expect_rejected_with =
      [](const std::string &override, const std::vector<std::string> &words) {
        SCOPED_TRACE(override);
        expect_rejected(
          {"--set", "Model/Kinematics=finite", "--set", override, base_scene},
          words);
      };
    expect_rejected_with("Covers/Stabilization=ghost penalty",
                         {"ghost penalty", "finite", "aggregation"});
    expect_rejected_with("Solver/Type=iterative", {"Solver/Type", "iterative"});
    expect_rejected_with("Solver/Condition number=true",
                         {"Solver/Condition number", "finite"});
    expect_rejected_with("Load steps/Number of steps=0",
                         {"Load steps/Number of steps", "0"});
    expect_rejected_with("Load steps/Load factors=1, 1",
                         {"Load steps/Load factors", "1 follows 1"});
    expect_rejected_with("Load steps/Load factors=0, 1",
                         {"Load steps/Load factors", "0 follows 0"});
    expect_rejected_with("Fixed points/corner/Point=2, 2", {"(2, 2)"});
    expect_rejected_with("Load steps/Smallest step=0",
                         {"Load steps/Smallest step", "0"});
    expect_rejected_with("Newton/Residual tolerance=0",
                         {"Newton/Residual tolerance", "0"});
    expect_rejected_with("Newton/Energy tolerance=0",
                         {"Newton/Energy tolerance", "0"});
    expect_rejected({"--set",
                     "Model/Kinematics=finite",
                     "--set",
                     "Load steps/Number of steps=5",
                     "--set",
                     "Load steps/Load factors=1",
                     base_scene},
                    {"Load steps/Number of steps", "5"});
  }


  /// The base scene with these settings and @p override.
  TEST(BadInput, TheDynamicSceneIsGood)
  {
    std::vector<std::string> arguments = {"--check", base_scene};
    for (const std::string &setting : dynamic)
      arguments.insert(arguments.end(), {"--set", setting});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
  }


  TEST(BadInput, StaticAnalysisHasNoTime)
  {
    expect_rejected_override("Model/Analysis=quasistatic",
                             {"quasistatic", "relaxation"});
    for (const char *entry : {"Time/End time=1",
                              "Time/Initial step=0.1",
                              "Time/Smallest step=0.1",
                              "Time/Largest step=0.1",
                              "Time/Largest displacement=0.1",
                              "Time/Largest error=0.1",
                              "Time/Scheme=newmark",
                              "Time/Newmark beta=0.3",
                              "Time/Newmark gamma=0.6",
                              "Time/Spectral radius=0.1",
                              "Time/Mass damping=0.1",
                              "Time/Stiffness damping=0.1",
                              "Relaxation/Step=1",
                              "Relaxation/Step growth=2",
                              "Relaxation/Tolerance=1e-3",
                              "Relaxation/Maximum steps=3",
                              "Initial velocities/Names=start",
                              "Boundary conditions/held/Amplitude=t",
                              "Boundary conditions/held/Release time=1",
                              "Fixed points/corner/Amplitude=t",
                              "Fixed points/corner/Release time=1",
                              "Model/Gravity amplitude=t",
                              "Model/Body force amplitude=t",
                              "Model/Base acceleration=t; 0",
                              "Output/Checkpoint every=2"})
    {
      const std::string text = entry;
      expect_rejected_override(text,
                               {text.substr(0, text.find('=')),
                                "Model/Analysis"});
    }
  }


  TEST(BadInput, Dynamics)
  {
    using Words       = std::vector<std::string>;
    const auto reject = [](const std::string &override, const Words &words) {
      expect_rejected_with(dynamic, override, words);
    };
    reject("Materials/rock/Density=0", {"Materials/rock/Density", "above 0"});
    reject("Time/End time=0", {"Time/End time", "above 0"});
    reject("Time/Initial step=0", {"Time/Initial step", "above 0"});
    reject("Time/Initial step=2", {"Time/Initial step", "'End time'"});
    reject("Time/Smallest step=0.2", {"Time/Smallest step", "0.2"});
    reject("Time/Largest step=0.05", {"Time/Largest step", "0.05"});
    reject("Time/Newmark beta=0", {"Time/Newmark beta", "(0, 1]"});
    reject("Time/Newmark gamma=0.4", {"Time/Newmark gamma", "0.4"});
    reject("Time/Spectral radius=0.5", {"Time/Spectral radius", "newmark"});
    reject("Time/Scheme=leapfrog", {"leapfrog", "generalized alpha"});
    reject("Relaxation/Step=1", {"Relaxation/Step", "relaxation"});
    reject("Load steps/Number of steps=5", {"Load steps/Number", "static"});
    reject("Load steps/Load factors=0.5", {"Load steps/Load f", "static"});
    reject("Load steps/Smallest step=0.5", {"Load steps/Small", "static"});
    reject("Covers/Stabilization=ghost penalty", {"ghost penalty", "dynamic"});
    reject("Solver/Type=iterative", {"Solver/Type", "dynamic"});
    reject("Solver/Condition number=true", {"Solver/Condition", "dynamic"});
    reject("Boundary conditions/held/Amplitude=t +",
           {"Boundary conditions/held/Amplitude", "t +", "use t"});
    reject("Boundary conditions/held/Amplitude=x", {"held/Amplitude", "'x'"});
    reject("Boundary conditions/held/Amplitude=1/t", {"not finite", "t = 0"});
    reject("Boundary conditions/held/Amplitude=1/(1-t)", {"t = 1 s"});
    reject("Fixed points/corner/Amplitude=file: no-such.txt", {"no-such.txt"});
    reject("Fixed points/corner/Amplitude=file:", {"corner/Amplitude", "name"});
    reject("Model/Gravity amplitude=sin(", {"Model/Gravity amplitude"});
    reject("Model/Base acceleration=t", {"Model/Base acceleration", "1 comp"});
    reject("Model/Base acceleration=t; ", {"Model/Base acceleration"});
    reject("Boundary conditions/held/Type=normal displacement",
           {"held/Value", "2 expression(s)"});
    expect_rejected_with(dynamic +
                           Words{"Boundary conditions/held/Type=traction"},
                         "Boundary conditions/held/Release time=0.5",
                         {"held/Release time", "Amplitude"});
    expect_rejected_with(dynamic + Words{"Model/Kinematics=finite"},
                         "Newton/Energy tolerance=1e-6",
                         {"Newton/Energy tolerance", "dynamic"});
  }


  TEST(BadInput, Relaxation)
  {
    const std::vector<std::string> relaxation = {"Model/Analysis=relaxation",
                                                 "Materials/rock/Density=1",
                                                 "Relaxation/Step=1"};
    expect_rejected_with(relaxation, "Relaxation/Step=0", {"Relaxation/Step"});
    expect_rejected_with(relaxation,
                         "Relaxation/Tolerance=-1",
                         {"Relaxation/Tolerance"});
    expect_rejected_with(relaxation, "Time/End time=1", {"Time/End time"});
    expect_rejected_with(relaxation,
                         "Boundary conditions/held/Amplitude=t",
                         {"held/Amplitude", "relaxation"});
    expect_rejected_with(relaxation,
                         "Output/Checkpoint every=3",
                         {"Output/Checkpoint every", "relaxation"});
    expect_rejected_with(relaxation,
                         "Materials/rock/Density=0",
                         {"Density", "relaxation"});
  }


  TEST(BadInput, InitialVelocitiesMPI)
  {
    const auto settings =
      dynamic + std::vector<std::string>{"Initial velocities/Names=start"};
    for (const auto &[override, word] :
         {std::make_pair("Block=2, 2", "(2, 2) lies in no block"),
          std::make_pair("Block=here", "'here' is no point"),
          std::make_pair("Block=1, 2, 3", "'1, 2, 3' is no point"),
          std::make_pair("Center=middle", "'middle' is no point")})
    {
      const std::string text = override;
      expect_rejected_with(
        settings,
        "Initial velocities/start/" + text,
        {"Initial velocities/start/" + text.substr(0, text.find('=')), word});
    }
  }


  TEST(BadInput, TimeHistories)
  {
    const auto expect = [](const std::string &text, const std::string &word) {
      const std::string name = NMM_TEST_OUTPUT_DIR "/motion.txt";
      std::ofstream(name) << text;
      expect_rejected_with(dynamic,
                           // Files are relative to the scene.
                           "Model/Base acceleration=file: " +
                             std::filesystem::relative(
                               name,
                               std::filesystem::path(base_scene).parent_path())
                               .string() +
                             "; 0",
                           {"motion.txt", word});
    };
    expect("0 1\n1 2\n1 3\n", "1");
    expect("0 1\n0.5\n", "2");
    expect("0 zero\n", "1");
    expect("", "motion.txt");
  }


  TEST(BadInput, RestartMPI)
  {
    expect_rejected({"--restart", "no-such.nmm", base_scene},
                    {"--restart", "neither a dynamic analysis"});
    std::vector<std::string> arguments = {"--restart", "no-such.nmm"};
    for (const std::string &setting : dynamic)
      arguments.insert(arguments.end(), {"--set", setting});
    arguments.push_back(base_scene);
    expect_rejected(arguments, {"no-such.nmm", "missing"});
    expect_rejected({"--restart", "", base_scene}, {"--restart", "name"});
  }


  TEST(BadInput, Geometry)
  {
    // Open and self-intersecting boundaries.
    expect_rejected_geometry(
      "boundary name=square material=rock LINESTRING (0 0, 1 0, 1 1, 0 1)",
      {"square", "0", "1"});
    expect_rejected_geometry(
      "boundary name=square material=rock POLYGON ((0 0, 1 1, 1 0, 0 1))",
      {"square", "0.5"});
    // A joint wholly outside, a hole outside its domain.
    expect_rejected_geometry(square + "; joint name=far LINESTRING (2 2, 3 3)",
                             {"far", "2"});
    expect_rejected_geometry(square + "; hole name=well CIRCLE (3 3, 0.1)",
                             {"well", "3"});
    // Pieces of no length, a circle of no size, numbers that are none.
    expect_rejected_geometry(square +
                               "; joint name=dot LINESTRING (0.5 0.5, 0.5 0.5)",
                             {"dot", "0.5"});
    expect_rejected_geometry(square + "; hole name=well CIRCLE (0.5 0.5, 0)",
                             {"well", "0"});
    expect_rejected_geometry(square +
                               "; joint name=odd LINESTRING (0.5 nan, 0.5 0.7)",
                             {"nan"});
    expect_rejected_geometry(
      square + "; joint name=odd LINESTRING (0.5 0.1, 0.5 1e999)", {"1e999"});
    // Materials the scene does not describe.
    expect_rejected_geometry(
      "boundary name=square material=roc POLYGON ((0 0, 1 0, 1 1, 0 1))",
      {"roc"});
    // Records that cannot be read.
    expect_rejected_geometry(square + "; fault LINESTRING (0 0, 1 1)",
                             {"fault"});
    expect_rejected_geometry(square + "; joint LINESTRING (0 0, 1 1",
                             {"parenthesis"});
    expect_rejected_geometry("joint name=alone LINESTRING (0 0, 1 1)",
                             {"boundary"});
    expect_rejected({"--set",
                     "Geometry/Text=",
                     "--set",
                     "Geometry/File=no-such.wkt",
                     base_scene},
                    {"no-such.wkt"});
  }


  TEST(BadInput, TheSceneWithContactIsGood)
  {
    std::vector<std::string> arguments = {"--check", base_scene};
    for (const std::string &setting : touching)
      arguments.insert(arguments.end(), {"--set", setting});
    const DriverResult result = run_in_process(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find("1 obstacle(s)"), std::string::npos)
      << result.output;
  }


  TEST(BadInput, WithoutContactNothingOfItIsUsed)
  {
    for (const char *entry : {"Normal stiffness=1",
                              "Shear stiffness=1",
                              "Normal damping=1",
                              "Shear damping=1",
                              "Friction angle=10",
                              "Cohesion=1",
                              "Bonded=true",
                              "Tensile strength=1",
                              "Penetration tolerance=1e-6",
                              "Reach=0.1",
                              "Number of points=3",
                              "Dilation angle=5",
                              "Dilation limit=0.1",
                              "Integration=points",
                              "Open joints=crack",
                              "Tied joints=crack"})
    {
      const std::string text = std::string("Contact/") + entry;
      expect_rejected_override(text,
                               {text.substr(0, text.find('=')),
                                "Contact/Enforcement"});
    }
    expect_rejected({"--set",
                     "Contact/Names=glue",
                     "--set",
                     "Contact/glue/Between=any, any",
                     base_scene},
                    {"glue", "Contact/Names"});
    expect_rejected(
      {"--set", "Obstacles/Names=floor", "--set", touching[2], base_scene},
      {"obstacles", "Obstacles/Names", "Contact/Enforcement"});
  }


  TEST(BadInput, ContactParameters)
  {
    const auto rejects = [](const std::string              &override,
                            const std::vector<std::string> &words) {
      expect_rejected_with(touching, override, words);
    };
    rejects("Contact/Enforcement=springs", {"springs", "penalty"});
    for (const char *angle : {"90", "-1", "120"})
      rejects(std::string("Contact/Friction angle=") + angle,
              {"Contact/Friction angle", angle, "90 degrees"});
    rejects("Contact/Normal stiffness=-1", {"Normal stiffness", "-1"});
    rejects("Contact/Reach=2500", {"Contact/Reach", "2500 m", "ten times"});
    rejects("Contact/Shear stiffness=-2", {"Shear stiffness", "-2"});
    rejects("Contact/Cohesion=-3", {"Contact/Cohesion", "-3"});
    rejects("Contact/Tensile strength=5",
            {"Contact/Tensile strength", "5 Pa", "Bonded = true"});
    rejects("Contact/Dilation angle=5",
            {"Contact/Dilation angle", "5 degrees", "friction angle"});
    rejects("Contact/Dilation angle=-1", {"Contact/Dilation angle", "-1"});
    rejects("Contact/Dilation limit=0.1",
            {"Contact/Dilation limit", "0.1 m", "Dilation angle"});
    rejects("Contact/Integration=area", {"area", "points"});
    expect_rejected_with(
      touching + std::vector<std::string>{"Contact/Integration=points"},
      "Contact/Number of points=6",
      {"Contact/Number of points", "length"});
    expect_rejected_with(
      touching + std::vector<std::string>{"Contact/Integration=points"},
      "Contact/Enforcement=augmented Lagrangian",
      {"augmented Lagrangian", "Contact/Enforcement", "length"});
    rejects("Contact/Reach=-1", {"Contact/Reach", "-1"});
    rejects("Contact/Number of points=1", {"Number of points"});
    rejects("Contact/Penetration tolerance=1e-6",
            {"Penetration tolerance", "augmented Lagrangian"});
    rejects("Contact/Normal damping=1",
            {"Contact/Normal damping", "energy momentum"});
    rejects("Contact/Open joints=seam", {"'seam'", "Contact/Open joints"});
    rejects("Covers/Stabilization=ghost penalty",
            {"ghost penalty", "contact", "aggregation"});
    rejects("Solver/Type=iterative", {"iterative", "contact", "direct"});
    expect_rejected_with(touching + dynamic,
                         "Contact/Enforcement=augmented Lagrangian",
                         {"augmented Lagrangian", "dynamic", "penalty"});
    expect_rejected_with(touching + dynamic +
                           std::vector<std::string>{"Time/Scheme=newmark"},
                         "Contact/Normal damping=1",
                         {"Contact/Normal damping", "energy momentum"});
  }


  TEST(BadInput, ContactLaws)
  {
    const auto rejects = [](const std::string              &between,
                            const std::string              &override,
                            const std::vector<std::string> &words) {
      expect_rejected_with(
        touching + std::vector<std::string>{"Contact/Names=glue",
                                            "Contact/glue/Between=" + between},
        override,
        words);
    };
    const std::string good = "Model/Thickness=1";
    rejects("square", good, {"'square'", "1 name(s)", "Contact/glue/Between"});
    rejects("a, b, c", good, {"3 name(s)", "Contact/glue/Between"});
    rejects("square, flor",
            good,
            {"'flor'", "Contact/glue/Between", "'floor'", "any"});
    rejects("square, any",
            "Contact/glue/Friction angle=90",
            {"Contact/glue/Friction angle", "90"});
    rejects("square, any",
            "Contact/glue/Tensile strength=1",
            {"Contact/glue/Tensile strength", "Bonded"});
    rejects("square, any",
            "Contact/glue/Normal stiffness=-1",
            {"Contact/glue/Normal stiffness", "-1"});
  }


  TEST(BadInput, Obstacles)
  {
    const auto rejects = [](const std::string              &override,
                            const std::vector<std::string> &words) {
      expect_rejected_with(touching, override, words);
    };
    const std::string shape = "Obstacles/floor/Shape=";
    rejects(shape, {"'floor'", "no shape", "Obstacles/floor"});
    rejects("Obstacles/floor/File=floor.wkt",
            {"'floor'", "more than one shape", "'File'"});
    rejects(shape + "LINESTRING (2 0)",
            {"too few points (1)", "Obstacles/floor/Shape", "at least 2"});
    rejects(shape + "LINESTRING (2 0, 2 0)", {"Obstacles/floor/Shape"});
    rejects(shape + "MULTILINESTRING ((2 0, 1 0), (1 0, 0 0))",
            {"2 curves", "Obstacles/floor/Shape"});
    rejects(shape + "BLOB (2 0)", {"BLOB", "LINESTRING"});
    rejects("Obstacles/floor/Displacement=t",
            {"Obstacles/floor/Displacement", "instead of 2"});
    rejects("Obstacles/floor/Displacement=0; x",
            {"Obstacles/floor/Displacement", "'x'"});
    rejects("Obstacles/floor/Displacement=0; 1 / t",
            {"Obstacles/floor/Displacement", "not finite"});
    rejects("Obstacles/floor/Displacement=0; file: no-such.txt",
            {"no-such.txt"});
    expect_rejected_with({touching[0],
                          "Obstacles/Names=square",
                          "Obstacles/square/Shape=LINESTRING (2 0, -1 0)"},
                         "Model/Thickness=1",
                         {"'square'", "Obstacles/Names", "another name"});
    expect_rejected_with(touching +
                           std::vector<std::string>{"Model/Analysis=relaxation",
                                                    "Materials/rock/Density=1",
                                                    "Relaxation/Step=1"},
                         "Obstacles/floor/Displacement=0; t",
                         {"Obstacles/floor/Displacement", "relaxation"});
  }


  // Latin-1 in a value, not in a comment.
  TEST(BadInput, Encoding)
  {
    const std::string file =
      write_scene("latin.prm", "# B\xf6schung\nset Title = B\xf6schung\n");
    expect_rejected({file}, {"latin.prm:2", "UTF-8"});
    expect_rejected_override("Output/Title=B\xf6schung", {"UTF-8"});
  }


  // How much and where.
  TEST(BadInput, OverlapsMPI)
  {
    const std::string shape = "Obstacles/floor/Shape=";
    expect_rejected_with(
      touching,
      shape + "LINESTRING (2 0.25, -1 0.25)",
      {"Block 0", "'floor'", "overlap by 0.25 m", "(", "0)"});
    expect_rejected_with(touching,
                         shape + "POLYGON ((-1 -1, 0.1 -1, 0.1 2, -1 2))",
                         {"'floor'", "overlap by 0.1 m"});
    expect_rejected_with(touching,
                         shape + "CIRCLE (0.5 0.5, 0.125)",
                         {"'floor'", "overlap by 0.375 m"});
    expect_rejected_with(touching,
                         "Geometry/Text=" + square +
                           "; boundary name=other material=rock "
                           "POLYGON ((0.9 0, 2 0, 2 1, 0.9 1))",
                         {"square", "other", "overlap"});
  }


  TEST(BadInput, SceneMPI)
  {
    expect_rejected_override("Solver/Tipe=direct", {"Tipe"});
    expect_rejected_override("Probes/inside/Point=2, 2", {"outside"});
  }
} // namespace
