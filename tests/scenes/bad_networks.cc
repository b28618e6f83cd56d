#include "rejected_input.h"
#include <sys/stat.h>

using namespace rejected_input;

// Joint sets, traces, regions and what is released.
namespace
{
  TEST(BadInput, JointSets)
  {
    const auto rejects = [](const std::string              &entry,
                            const std::vector<std::string> &words) {
      expect_rejected_with({"Joint sets/Names=beds",
                            "Joint sets/beds/Spacing=0.25"},
                           "Joint sets/beds/" + entry,
                           words);
    };
    rejects("Spacing=0", {"'beds'", "spacing", "0 m", "positive"});
    rejects("Spacing=-1", {"'beds'", "spacing", "-1 m"});
    rejects("Spacing=1e-9", {"'beds'", "memory", "spacings", "larger"});
    rejects("Spacing scatter=1", {"'beds'", "spacing", "below 1"});
    rejects("Persistence=0", {"'beds'", "persistence", "above 0"});
    rejects("Persistence=1.2", {"'beds'", "persistence", "1.2"});
    rejects("Persistence=0.5", {"'beds'", "trace length", "0 m"});
    rejects("Trace length=1", {"'beds'", "trace length", "persistence"});
    rejects("Dip scatter=100", {"'beds'", "dip", "100", "90"});
    // a loop over line numbers that rounding does not let grow had no end
    rejects("Offset=1e30", {"'beds'", "lines", "rounding", "offset"});
    rejects("Within=bench", {"'beds'", "'bench'", "region"});
    rejects("State=ajar", {"ajar", "Joint sets/beds/State", "closed"});
    expect_rejected_override("Joint sets/Names=square",
                             {"'square'", "spacing"});
    expect_rejected_with({"Joint sets/Names=square"},
                         "Joint sets/square/Spacing=0.25",
                         {"'square'", "joint", "rename"});
  }


  TEST(BadInput, JointSetsThatCrossTooOften)
  {
    // 1e5 lines each; 30 kB a crossing
    expect_rejected_with({"Joint sets/Names=flat, steep",
                          "Joint sets/flat/Spacing=1e-5",
                          "Joint sets/steep/Dip=90"},
                         "Joint sets/steep/Spacing=1e-5",
                         {"1e+10 crossings", "memory", "'flat'", "'steep'"});
    // 1e5 lines through 1e6 cells each
    expect_rejected_with({"Joint sets/Names=flat",
                          "Mathematical mesh/Cell size=1e-6"},
                         "Joint sets/flat/Spacing=1e-5",
                         {"1e+11 cells", "memory", "'flat'", "larger cells"});
  }


  TEST(BadInput, SmallBlocks)
  {
    expect_rejected_override("Geometry/Small blocks=merge",
                             {"none is small", "Small block area"});
    expect_rejected_override("Geometry/Small blocks=remove",
                             {"remove", "Geometry/Small blocks", "merge"});
    expect_rejected_with({"Geometry/Small blocks=merge",
                          "Geometry/Small block area=0.01",
                          "Fracture/Intensity factors=true",
                          "Fracture/Increment=0.1",
                          "Materials/rock/Toughness=1"},
                         "Fracture/Increments=1",
                         {"small blocks", "cracks that grow", "report"});
  }


  TEST(BadInput, Traces)
  {
    expect_rejected_override("Traces/Names=survey", {"'survey'", "File"});
    const auto rejects = [](const std::string              &file,
                            const std::vector<std::string> &words,
                            const std::string &other = "Model/Thickness=1") {
      expect_rejected_with({"Traces/Names=survey",
                            "Traces/survey/File=" +
                              std::filesystem::relative(
                                file,
                                std::filesystem::path(base_scene).parent_path())
                                .string()},
                           other,
                           words);
    };
    rejects(NMM_TEST_OUTPUT_DIR "/no-such.dxf", {"no-such.dxf", "exist"});
    rejects(write_scene("text.dxf", "no drawing\nat all\n"),
            {"text.dxf", "DXF"});
    rejects(write_scene("boundary.wkt", square),
            {"'survey'", "boundary", "'square'", "boundary.wkt:1"});
    rejects(write_scene("joints.wkt", "joint LINESTRING (0 0, 1 1)"),
            {"joints.wkt", "Traces/survey/Layers", ".dxf"},
            "Traces/survey/Layers=J1");
    rejects(NMM_SOURCE_DIR "/tests/scenes/network-drawing/joints.dxf",
            {"joints.dxf", "'J9'", "layer"},
            "Traces/survey/Layers=J9");
    rejects(NMM_SOURCE_DIR "/tests/scenes/network-drawing/joints.dxf",
            {"joints.dxf", "SPLINE", "'sketch'"});
  }


  TEST(BadInput, Water)
  {
    expect_rejected_override("Water/Table=0 1, 0 2",
                             {"vertical", "Water/Table"});
    expect_rejected_override("Water/Table=0 1 2, 3 4",
                             {"0 1 2", "Water/Table"});
    expect_rejected_override("Water/Table=1 +* x", {"Water/Table"});
    expect_rejected_override("Water/Joint pressure=given",
                             {"Water/Given joint pressure", "expression"});
    expect_rejected_override("Water/Pores=true", {"Water/Pores", "Table"});
    expect_rejected_override("Water/Joint pressure=network",
                             {"Water/Joint pressure", "Table"});
    expect_rejected_override("Materials/rock/Wet density=2000",
                             {"rock/Wet density", "Water/Table"});
    const std::vector<std::string> wet = {"Water/Table=0.5"};
    expect_rejected_with(wet, "Water/Faces=lid", {"'lid'", "boundaries"});
    expect_rejected_with(wet,
                         "Water/Aperture=1e-3",
                         {"Water/Aperture", "network"});
    expect_rejected_with({"Water/Table=0.5", "Water/Joint pressure=network"},
                         "Water/Aperture=1e-3",
                         {"residual aperture"});
    expect_rejected_with({"Regions/Names=pit",
                          "Regions/pit/Use=staged",
                          "Stages/Names=one",
                          "Regions/pit/Shape=POLYGON ((0.2 0.1, 0.4 0.1, 0.4 "
                          "0.3, 0.2 0.3))",
                          "Stages/one/Remove regions=pit"},
                         "Stages/one/Water table=1",
                         {"Stages/one/Water table", "Water/Table"});
  }


  // A pipe would wait, and a device never ends.
  TEST(BadInput, FilesThatAreNoOrdinaryOnes)
  {
    const std::string pipe = NMM_TEST_OUTPUT_DIR "/pipe";
    if (is_first_rank())
    {
      std::filesystem::remove(pipe);
      ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    }
    for (const std::string &file :
         {std::string("/dev/zero"), pipe, std::string("/")})
    {
      const std::vector<std::string> words = {"no ordinary file", file};
      expect_rejected({file}, words);
      expect_rejected_with({"Traces/Names=t"}, "Traces/t/File=" + file, words);
      expect_rejected_with({"Mathematical mesh/Type=gmsh"},
                           "Mathematical mesh/Gmsh file=" + file,
                           words);
      expect_rejected_with(dynamic,
                           "Boundary conditions/held/Amplitude=file:" + file,
                           words);
    }
    expect_rejected({"--confined",
                     "--set",
                     "Traces/Names=t",
                     "--set",
                     "Traces/t/File=/etc/passwd",
                     base_scene},
                    {"outside of its folder", "--confined"});
  }


  TEST(BadInput, ExpressionsSayOneSentence)
  {
    const std::string value = "Boundary conditions/held/Value=";
    expect_rejected_override(value + "1e-3 * rand(); 0",
                             {"rand()", "held/Value"});
    expect_rejected_override(value + "0; rand_seed(1)",
                             {"rand()", "held/Value"});
    expect_rejected_override(value + "foo(x); 0", {"'foo(x); 0'", "\"foo\""});
    const DriverResult result =
      run_in_process({"--check", "--set", value + "foo(x); 0", base_scene});
    for (const std::string word : {"muParser", "Errc", "Formula", "deal.II"})
      EXPECT_EQ(result.output.find(word), std::string::npos) << result.output;
  }


  TEST(BadInput, Stages)
  {
    using Arguments      = std::vector<std::string>;
    const Arguments pit  = {"Regions/Names=pit",
                            "Regions/pit/Shape=CIRCLE (0.5 0.5, 0.2)"};
    const Arguments used = pit + Arguments{"Regions/pit/Use=staged"};
    const Arguments two  = used + Arguments{"Stages/Names=one, two",
                                           "Stages/one/Remove regions=pit"};
    expect_rejected_with(pit,
                         "Regions/pit/Use=staged",
                         {"'pit'", "Regions/pit/Use", "Stages"});
    expect_rejected_with(two,
                         "Stages/two/Remove regions=pit",
                         {"'pit'", "second time", "'one'", "Stages/two"});
    expect_rejected_with(two,
                         "Stages/two/Remove regions=hole",
                         {"'hole'", "Stages/two", "Use = staged"});
    expect_rejected_with(two + Arguments{"Stages/one/Relaxation=0.5"},
                         "Stages/two/Relaxation=0.2",
                         {"0.2", "0.5", "not held again"});
    expect_rejected_with(used + Arguments{"Stages/Names=one"},
                         "Stages/one/Relaxation=0.5",
                         {"Stages/one/Relaxation", "nothing has been removed"});
    expect_rejected_with(two,
                         "Load steps/Load factors=1, 0.5",
                         {"Load factors", "ascend to 1"});
    const Arguments moves = two + Arguments{"Model/Analysis=dynamic",
                                            "Time/End time=1",
                                            "Time/Initial step=0.1",
                                            "Materials/rock/Density=1"};
    expect_rejected_with(moves + Arguments{"Relaxation/Step=0.1"},
                         "Time/Start=relaxation",
                         {"Time/Start", "equilibrium", "stages"});
    expect_rejected_with(moves + Arguments{"Stages/one/Relaxation=0.5"},
                         "Stages/two/Relaxation=0.5",
                         {"Stages/two/Relaxation", "held", "dynamic"});
  }


  TEST(BadInput, ConditionsInStages)
  {
    const std::vector<std::string> two = {"Stages/Names=one, two"};
    expect_rejected_with(two,
                         "Stages/one/Add conditions=wind",
                         {"'wind'", "Stages/one/Add", "Point forces"});
    expect_rejected_with(two,
                         "Stages/one/Add conditions=held",
                         {"'held'", "support", "bolt"});
    expect_rejected_with(
      two + std::vector<std::string>{"Stages/one/Remove conditions=corner"},
      "Stages/two/Remove conditions=corner",
      {"'corner'", "acts no longer", "Stages/two"});
    expect_rejected_with(two,
                         "Stages/one/Relaxation=0.5",
                         {"nothing has been removed", "Stages/one"});
  }


  TEST(BadInput, Bolts)
  {
    using Arguments       = std::vector<std::string>;
    const Arguments steel = {"Bolts/Names=anchor",
                             "Bolts/anchor/Young's modulus=2e11",
                             "Bolts/anchor/Area=1e-4",
                             "Bolts/anchor/Bond stiffness=1e7"};
    const Arguments bolt  = steel + Arguments{
                                     "Bolts/anchor/Path=LINESTRING ("
                                      "0.1 0.1, 0.1 0.4)"};
    expect_rejected_with(
      steel, "Bolts/anchor/Path=", {"'anchor'", "no path", "LINESTRING"});
    expect_rejected_with(steel,
                         "Bolts/anchor/Path=LINESTRING (0.1 0.1, 0.1 -7)",
                         {"'anchor'", "ends outside the rock", "-7"});
    expect_rejected_with(steel,
                         "Bolts/anchor/Path=LINESTRING (0.1 -7, 0.1 0.1)",
                         {"'anchor'", "begins outside the rock"});
    expect_rejected_with(steel,
                         "Bolts/anchor/Path=LINESTRING (0.1 0, 0.4 0)",
                         {"'anchor'", "runs along", "side is not certain"});
    expect_rejected_with(bolt,
                         "Bolts/anchor/Area=0",
                         {"'anchor'", "area", "above 0"});
    expect_rejected_with(bolt,
                         "Bolts/anchor/Pretension=1e3",
                         {"'anchor'", "Faceplate", "press"});
    expect_rejected_with(bolt,
                         "Bolts/anchor/Type=end-anchored",
                         {"'anchor'", "no effect", "grouted"});
    expect_rejected_with(bolt + Arguments{"Stages/Names=one"},
                         "Stages/one/Install=nail",
                         {"'nail'", "Stages/one/Install", "Bolts"});
  }


  TEST(BadInput, Regions)
  {
    const auto rejects = [](const std::string              &entry,
                            const std::vector<std::string> &words) {
      expect_rejected_with({"Regions/Names=pit",
                            "Regions/pit/Shape=CIRCLE (0.5 1, 0.25)"},
                           "Regions/pit/" + entry,
                           words);
    };
    rejects("Shape=", {"'pit'", "no shape", "Regions/pit"});
    rejects("File=pit.wkt", {"'pit'", "more than one shape"});
    rejects("Shape=LINESTRING (0 0, 1 1)", {"'pit'", "not closed", "POLYGON"});
    rejects("Material=soil", {"'pit'", "'soil'", "middle"});
    rejects("Use=restraint", {"Regions/pit/Use", "contact"});
    rejects("Release time=1", {"Release time", "restraint"});
    expect_rejected_with({"Regions/Names=pit",
                          "Regions/pit/Shape=CIRCLE (0.5 1, 0.25)",
                          "Regions/pit/Material=rock"},
                         "Regions/pit/Use=excavation",
                         {"'rock'", "Regions/pit/Material", "taken out"});
    rejects("Use=limit", {"Regions/pit/Use", "static analysis"});
    const std::vector<std::string> limit = {"Regions/Names=edge",
                                            "Regions/edge/Use=limit"};
    expect_rejected_with(dynamic + limit,
                         "Regions/edge/Shape=CIRCLE (5 0.5, 1)",
                         {"Regions/edge/Shape", "outside", "(0, 0)"});
    expect_rejected_with(dynamic + limit +
                           std::vector<std::string>{
                             "Regions/edge/Shape=CIRCLE (0.5 0.5, 1)"},
                         "Regions/edge/Material=rock",
                         {"Regions/edge/Material", "limit"});
    expect_rejected_with({"Regions/Names=square"},
                         "Regions/square/Shape=CIRCLE (0.5 1, 0.25)",
                         {"'square'", "Regions/Names", "another name"});
    expect_rejected_with(touching +
                           std::vector<std::string>{"Regions/Names=pit",
                                                    "Regions/pit/Use=restraint",
                                                    "Regions/pit/Release "
                                                    "time=1"},
                         "Regions/pit/Shape=CIRCLE (0.5 2, 0.25)",
                         {"Release time", "static analysis"});
    expect_rejected_with(touching,
                         "Obstacles/floor/Release time=0",
                         {"Obstacles/floor", "Release time", "dynamic"});
  }


  TEST(BadInput, ChoicesOfMathematicalMeshes)
  {
    expect_rejected_override("Mathematical mesh/Cell size=0", {"Cell size"});
    expect_rejected_override("Covers/Own meshes=automatic",
                             {"Covers/Elements across", "at least 1"});
    expect_rejected_override("Covers/Elements across=2",
                             {"2 elements", "Covers/Elements across"});
    const std::vector<std::string> named = {"Covers/Names=key"};
    expect_rejected_with(named,
                         "Covers/key/Own mesh=always",
                         {"'key'", "Covers/key/Block"});
    expect_rejected_with(named,
                         "Covers/key/Block=here",
                         {"'here'", "Covers/key/Block", "two numbers"});
    expect_rejected_with(named,
                         "Covers/key/Block=0.5, 0.5",
                         {"Covers/key/Elements across", "at least 1"});
    const std::vector<std::string> here = {"Covers/key/Block=0.5, 0.5"};
    expect_rejected_with(
      named + here + std::vector<std::string>{"Covers/key/Own mesh=never"},
      "Covers/key/Elements across=3",
      {"3 elements", "Covers/key/Elements across"});
    expect_rejected_with(
      named + std::vector<std::string>{"Covers/key/Elements across=3"},
      "Covers/key/Block=1.5, 0.5",
      {"(1.5, 0.5)", "no block", "Covers/key/Block"});
    // a block on the common mesh needs its size
    expect_rejected_with(named + here +
                           std::vector<std::string>{"Covers/key/Own mesh=never",
                                                    "Covers/Own "
                                                    "meshes=automatic",
                                                    "Covers/Elements across=2"},
                         "Mathematical mesh/Cell size=0",
                         {"Cell size"});
  }


  TEST(BadInput, StartsFromEquilibrium)
  {
    expect_rejected_override("Time/Start=equilibrium",
                             {"Time/Start", "dynamic"});
    expect_rejected_with(dynamic,
                         "Time/Start=rest",
                         {"rest", "Time/Start", "equilibrium"});
    expect_rejected_with(dynamic,
                         "Time/Start=relaxation",
                         {"Relaxation/Step", "period"});
  }
} // namespace
