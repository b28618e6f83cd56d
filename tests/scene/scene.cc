#include <nmm/base/exceptions.h>
#include <nmm/contact/chosen_parameters.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/scene/parameter_tree.h>
#include <nmm/scene/scene.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <support/coulomb.h>

using namespace NMM;
using NMM::Test::coulomb;

namespace
{
  const std::string base_scene = NMM_SOURCE_DIR "/tests/scenes/base.prm";

  using Words = std::vector<std::string>;


  TEST(ParameterTree, NearMatches)
  {
    const Words names = {"Solver", "Output", "Model", "Materials"};
    EXPECT_EQ(near_matches("solver", names), Words({"Solver"}));
    EXPECT_EQ(near_matches("Modle", names), Words({"Model"}));
    EXPECT_EQ(near_matches("Material", names), Words({"Materials"}));
    // Nothing is near: all there are.
    EXPECT_EQ(near_matches("xyz", names), names);
  }


  TEST(ParameterTree, Assignment)
  {
    const auto assignment = parse_assignment("A section/Key = x=1; y");
    EXPECT_EQ(assignment.path, Words({"A section", "Key"}));
    EXPECT_EQ(assignment.value, "x=1; y");
    EXPECT_EQ(parse_assignment("A/B/C=").path, Words({"A", "B", "C"}));
    for (const char *bad : {"A/B", "B=1", "/B=1", "A/=1", "=", ""})
      EXPECT_THROW(parse_assignment(bad), InputError) << bad;
  }


  TEST(Scene, StressesOfExpressionsAndOfWeight)
  {
    const Scene     scene(base_scene,
                      {"Materials/rock/Initial stress=x; if(y < 0, 1, 2); x*y",
                           "Model/Plane state=plane strain"});
    const auto      problem = scene.make_problem();
    const Material &rock    = problem.materials[0];
    EXPECT_EQ(rock.initial_stress.norm(), 0.);
    const dealii::SymmetricTensor<2, 2> stress =
      rock.initial_stress_at({3., -2.});
    EXPECT_EQ(stress[0][0], 3.);
    EXPECT_EQ(stress[1][1], 1.);
    EXPECT_EQ(stress[0][1], -6.);
    const Scene in_situ(base_scene,
                        {"In-situ stress/Type=K0",
                         "In-situ stress/K0=0.6",
                         "In-situ stress/Ground line=0 1, 2 3.5",
                         "In-situ stress/Unit weight above=20",
                         "Model/Gravity=0, -9.81",
                         "Materials/rock/Density=2"});
    const auto &parameters = in_situ.parameters().in_situ_stress;
    EXPECT_TRUE(parameters.is_present);
    EXPECT_EQ(parameters.K0.value(), 0.6);
    EXPECT_FALSE(parameters.K0_out_of_plane);
    ASSERT_EQ(parameters.ground_line.size(), 2u);
    EXPECT_EQ(parameters.ground_line[1], dealii::Point<2>(2., 3.5));
    EXPECT_EQ(parameters.unit_weight_above, 20.);
    const Scene level(base_scene,
                      {"In-situ stress/Type=K0",
                       "In-situ stress/Ground line=7",
                       "Model/Gravity=0, -9.81",
                       "Materials/rock/Density=2"});
    ASSERT_EQ(level.parameters().in_situ_stress.ground_line.size(), 1u);
    EXPECT_EQ(level.parameters().in_situ_stress.ground_line[0][1], 7.);
  }


  TEST(Scene, ValuesArriveWhereTheyBelong)
  {
    const Scene             scene(base_scene,
                      {"Materials/rock/Initial stress=1, 2, 3",
                                   "Materials/rock/Density=5",
                                   "Model/Plane state=plane strain",
                                   "Model/Gravity=0, -9.81",
                                   "Model/Body force=x + 1; y * pi",
                                   "Boundary conditions/held/Components=y",
                                   "Boundary conditions/held/Value=2 * x; y^2",
                                   "Fixed points/corner/Stiffness=7",
                                   "Covers/Stabilization=none",
                                   "Mathematical mesh/Offset=0.1, -0.2",
                                   "Solver/Type=iterative"});
    const ElasticityProblem problem = scene.make_problem();
    ASSERT_EQ(problem.materials.size(), 1u);
    EXPECT_EQ(problem.materials[0].name, "rock");
    EXPECT_EQ(problem.materials[0].youngs_modulus, 1.);
    EXPECT_EQ(problem.materials[0].density, 5.);
    EXPECT_EQ(problem.materials[0].initial_stress[1][1], 2.);
    EXPECT_EQ(problem.materials[0].initial_stress[0][1], 3.);
    EXPECT_EQ(problem.materials[0].varying_initial_stress, nullptr);
    EXPECT_EQ(problem.plane_state, PlaneState::plane_strain);
    EXPECT_EQ(problem.gravity[1], -9.81);
    ASSERT_TRUE(problem.body_force);
    const dealii::Point<2> x(0.5, 2.);
    EXPECT_DOUBLE_EQ(problem.body_force->value(x, 0), 1.5);
    EXPECT_DOUBLE_EQ(problem.body_force->value(x, 1), 2. * dealii::numbers::PI);
    ASSERT_EQ(problem.boundary_conditions.size(), 1u);
    const BoundaryCondition &condition = problem.boundary_conditions[0];
    EXPECT_EQ(condition.curve, "square");
    EXPECT_EQ(condition.type, BoundaryCondition::Type::displacement);
    EXPECT_FALSE(condition.components[0]);
    EXPECT_TRUE(condition.components[1]);
    EXPECT_DOUBLE_EQ(condition.value->value(x, 0), 1.);
    EXPECT_DOUBLE_EQ(condition.value->value(x, 1), 4.);
    ASSERT_EQ(problem.fixed_points.size(), 1u);
    EXPECT_EQ(problem.fixed_points[0].stiffness, 7.);
    EXPECT_EQ(scene.parameters().covers.stabilization, Stabilization::none);
    EXPECT_EQ(scene.parameters().mathematical_mesh.regular.offset[1], -0.2);
    EXPECT_EQ(scene.parameters().solver.type,
              LinearSolverParameters::Type::iterative);
    EXPECT_EQ(scene.title(), "base");
  }


  TEST(Scene, ConditionOnSeveralCurvesIsOneForEach)
  {
    const Scene scene(base_scene, {"Boundary conditions/held/Boundary=a, b"});
    const auto  conditions = scene.make_problem().boundary_conditions;
    ASSERT_EQ(conditions.size(), 2u);
    EXPECT_EQ(conditions[0].curve, "a");
    EXPECT_EQ(conditions[1].curve, "b");
  }


  /// That of the base scene with these settings.
  RigidObstacle
  obstacle(const Words &settings)
  {
    Words all = {"Contact/Enforcement=penalty", "Obstacles/Names=body"};
    all.insert(all.end(), settings.begin(), settings.end());
    const Scene        scene(base_scene, all);
    const PhysicalMesh mesh(scene.make_geometry());
    const auto         obstacles = scene.make_obstacles(mesh);
    EXPECT_EQ(obstacles.size(), 1u);
    EXPECT_EQ(obstacles[0].name, "body");
    return obstacles[0];
  }


  /// Twice the area on the left of straight pieces and chords.
  double
  twice_area(const RigidObstacle &body)
  {
    double area = 0.;
    for (const CurvePiece &piece : body.pieces)
    {
      const auto add = [&](const dealii::Point<2> &a,
                           const dealii::Point<2> &b) {
        area += a[0] * b[1] - a[1] * b[0];
      };
      if (piece.kind == CurvePiece::Kind::arc)
      {
        add(piece.start, piece.through);
        add(piece.through, piece.end);
      }
      else
        add(piece.start, piece.end);
    }
    return area;
  }


  // Lines as they are drawn; polygons and circles rigid inside, holes outside.
  TEST(Scene, ObstaclesAreOnTheLeft)
  {
    const std::string shape = "Obstacles/body/Shape=";
    const auto        line  = obstacle({shape + "linestring (3 0, 2 0, 1 1)"});
    ASSERT_EQ(line.pieces.size(), 2u);
    EXPECT_EQ(line.pieces[0].start[0], 3.);
    EXPECT_FALSE(line.displacement);
    for (const char *ring : {"(2 2, 3 2, 3 3, 2 3)", "(2 2, 2 3, 3 3, 3 2)"})
      EXPECT_EQ(twice_area(obstacle({shape + "POLYGON (" + ring + ")"})), 2.);
    // a closed line is what it is: a container
    EXPECT_EQ(twice_area(
                obstacle({shape + "LINESTRING (2 2, 2 3, 3 3, 3 2, 2 2)"})),
              -2.);
    const auto disk = obstacle({shape + "CIRCLE (5 5, 0.5)"});
    ASSERT_EQ(disk.pieces.size(), 2u);
    // of the square of the four points
    EXPECT_EQ(twice_area(disk), 1.);
    EXPECT_EQ(disk.pieces[1].end, disk.pieces[0].start);

    const std::string file_name = NMM_TEST_OUTPUT_DIR "/obstacle.wkt";
    std::ofstream(file_name) << "hole name=h CIRCLE (0 0, 4)\n";
    EXPECT_EQ(twice_area(obstacle({"Obstacles/body/File=" + file_name})), -64.);
  }


  TEST(Scene, ObstaclesMove)
  {
    const auto body = obstacle({"Obstacles/body/Shape=LINESTRING (3 0, 2 0)",
                                "Obstacles/body/Displacement=t^2; -3 * t"});
    ASSERT_TRUE(body.displacement);
    EXPECT_EQ(body.displacement(2.)[0], 4.);
    EXPECT_EQ(body.displacement(2.)[1], -6.);
  }


  TEST(Scene, JointsAreOpenedAndTied)
  {
    const Scene scene(base_scene,
                      {"Contact/Enforcement=penalty",
                       "Contact/Open joints=a",
                       "Contact/Tied joints=b",
                       "Geometry/Text=boundary name=square material=rock "
                       "POLYGON ((0 0, 1 0, 1 1, 0 1)); joint name=a "
                       "state=closed LINESTRING (0.2 0, 0.2 1); joint name=b "
                       "LINESTRING (0.4 0, 0.4 1); joint name=c state=closed "
                       "LINESTRING (0.6 0, 0.6 1)"});
    const auto  curves = scene.make_geometry().curves();
    ASSERT_EQ(curves.size(), 4u);
    EXPECT_EQ(curves[1].state, JointState::open);
    EXPECT_EQ(curves[2].state, JointState::closed);
    EXPECT_EQ(curves[3].state, JointState::closed);
  }


  // Cells of slivers are as thin as these, and would make contact as stiff.
  TEST(Scene, SliversHaveNoPartInContactStiffness)
  {
    const Scene        scene(base_scene,
                      {"Geometry/Text=boundary name=square material=rock "
                                     "POLYGON ((0 0, 1 0, 1 1, 0 1)); joint name=a "
                                     "LINESTRING (0 0.3, 1 0.3); joint name=b LINESTRING "
                                     "(0 0.30000000001, 1 0.30000000001)"});
    const PhysicalMesh mesh(scene.make_geometry());
    ASSERT_EQ(mesh.regions().size(), 3u);
    const OwnMeshes own = make_own_meshes(std::make_unique<MathematicalMesh>(
                                            scene.make_mathematical_mesh(mesh)),
                                          mesh);
    CoverSystem     covers(*own.manifold_mesh, MPI_COMM_SELF);
    const ContactSurface surface(covers);
    // blocks 0.3 and 0.7 high with cells of 0.5
    EXPECT_GT(contact_cell_size(surface), 0.1);
  }


  // Cells towards a tip are small, but at a small part of the faces: springs of other faces do not
  // follow them, those between the faces of the crack do. Cells grow with 0.6 r at the distance r of
  // the tip, so that cells below the half of a regular one lie within 0.4 regular ones of the tip,
  // less than a twentieth of the 4 m of the boundary and 2 * 0.5 m of the crack.
  TEST(Scene, CellsAtTipsHaveNoPartInContactStiffnessOfOtherFaces)
  {
    const Scene          scene(base_scene,
                      {"Geometry/Text=boundary name=square material=rock "
                                         "POLYGON ((0 0, 1 0, 1 1, 0 1)); joint name=crack "
                                         "LINESTRING (0.5 1, 0.5 0.5)",
                                "Mathematical mesh/Cell size=0.1",
                                "Contact/Enforcement=penalty",
                                "Contact/Friction angle=30",
                                "Fracture/Intensity factors=true",
                                "Fracture/Grading=0.6"});
    const PhysicalMesh   mesh(scene.make_geometry());
    const auto           cells = scene.make_mathematical_mesh(mesh);
    const ManifoldMesh   manifold_mesh(cells, mesh);
    CoverSystem          covers(manifold_mesh, MPI_COMM_SELF);
    const ContactSurface surface(covers);
    const double         size = contact_cell_size(surface);
    EXPECT_GE(size, (0.5 - 1e-9) * 0.1);
    EXPECT_LT(size, 1.5 * 0.1);
    const ContactParameters parameters =
      scene.make_contact_parameters(surface, scene.make_problem());
    // E = 1, static penalty
    EXPECT_NEAR(parameters.law->normal_stiffness, 30. / size, 1e-9 / size);
    ASSERT_EQ(parameters.pairs.size(), 1u);
    EXPECT_EQ(parameters.pairs[0].first, "crack");
    EXPECT_EQ(parameters.pairs[0].second, "crack");
    const double stiffness = parameters.pairs[0].law->normal_stiffness;
    EXPECT_GT(stiffness, 4. * parameters.law->normal_stiffness);
    // the free radius is 0.5
    EXPECT_LE(stiffness, 30. / (0.003 * 0.5) * (1. + 1e-9));
  }


  // What the scene leaves open is chosen for the softest block and the cells at
  // faces; laws have the section's stiffnesses, but not its strengths.
  TEST(Scene, ContactLawsAndWhatIsChosen)
  {
    const auto make = [](const Words &settings, double &size) {
      Words all = {"Contact/Enforcement=penalty",
                   "Contact/Friction angle=45",
                   "Contact/Cohesion=2",
                   "Contact/Names=one, two",
                   "Contact/one/Between=square, any",
                   "Contact/two/Between=any, any",
                   "Contact/two/Normal stiffness=0.25",
                   "Contact/two/Bonded=true",
                   "Contact/two/Tensile strength=3",
                   "Contact/two/Normal damping=0",
                   "Contact/Dilation angle=10",
                   "Contact/Dilation limit=0.5"};
      all.insert(all.end(), settings.begin(), settings.end());
      const Scene            scene(base_scene, all);
      const PhysicalMesh     mesh(scene.make_geometry());
      const MathematicalMesh cells = scene.make_mathematical_mesh(mesh);
      const ManifoldMesh     manifold_mesh(cells, mesh);
      CoverSystem            covers(manifold_mesh, MPI_COMM_SELF);
      const ContactSurface   surface(covers);
      size = contact_cell_size(surface);
      return scene.make_contact_parameters(surface, scene.make_problem());
    };
    double                  size       = 0.;
    const ContactParameters parameters = make({}, size);
    // equilateral cells; E = 1
    EXPECT_NEAR(size, 0.5, 1e-12);
    EXPECT_NEAR(coulomb(*parameters.law).normal_stiffness, 60., 1e-10);
    EXPECT_NEAR(coulomb(*parameters.law).shear_stiffness, 2., 1e-10);
    EXPECT_NEAR(coulomb(*parameters.law).friction, 1., 1e-15);
    EXPECT_EQ(coulomb(*parameters.law).cohesion, 2.);
    EXPECT_NEAR(coulomb(*parameters.law).dilation,
                std::tan(10. * dealii::numbers::PI / 180.),
                1e-15);
    EXPECT_EQ(coulomb(*parameters.law).dilation_limit, 0.5);
    EXPECT_EQ(coulomb(*parameters.pairs[1].law).dilation, 0.);
    EXPECT_EQ(parameters.integration, ContactIntegration::length);
    EXPECT_EQ(parameters.penetration_tolerance, 0.);
    ASSERT_EQ(parameters.pairs.size(), 2u);
    EXPECT_EQ(parameters.pairs[0].first, "square");
    EXPECT_EQ(parameters.pairs[0].second, "");
    EXPECT_EQ(coulomb(*parameters.pairs[0].law).friction, 0.);
    EXPECT_EQ(coulomb(*parameters.pairs[0].law).cohesion, 0.);
    EXPECT_NEAR(coulomb(*parameters.pairs[0].law).normal_stiffness, 60., 1e-10);
    // not stiffer in shear than against penetration
    EXPECT_EQ(coulomb(*parameters.pairs[1].law).shear_stiffness, 0.25);
    EXPECT_TRUE(coulomb(*parameters.pairs[1].law).is_bond);
    EXPECT_EQ(coulomb(*parameters.pairs[1].law).tensile_strength, 3.);

    // springs at vertices stand for a length of 1 m, so to say
    const ContactParameters points = make({"Contact/Integration=points"}, size);
    EXPECT_EQ(points.integration, ContactIntegration::points);
    EXPECT_NEAR(coulomb(*points.law).normal_stiffness, 30., 1e-10);
    EXPECT_NEAR(coulomb(*points.law).shear_stiffness, 1., 1e-10);

    const ContactParameters augmented =
      make({"Contact/Enforcement=augmented Lagrangian"}, size);
    EXPECT_NEAR(coulomb(*augmented.law).normal_stiffness, 20., 1e-10);
    EXPECT_NEAR(augmented.penetration_tolerance, 5e-6, 1e-15);

    const ContactParameters dynamic = make({"Model/Analysis=dynamic",
                                            "Materials/rock/Density=1",
                                            "Time/End time=1",
                                            "Time/Initial step=0.1",
                                            "Contact/one/Normal damping=4",
                                            "Contact/one/Shear damping=5"},
                                           size);
    EXPECT_NEAR(coulomb(*dynamic.law).shear_stiffness, 20., 1e-10);
    EXPECT_EQ(coulomb(*dynamic.pairs[0].law).normal_damping, 4.);
    EXPECT_EQ(coulomb(*dynamic.pairs[0].law).shear_damping, 5.);
    EXPECT_EQ(coulomb(*dynamic.law).normal_damping, 0.);
  }


  TEST(Scene, PrintedSceneIsTheSameScene)
  {
    const Scene scene(base_scene, {"Model/Thickness=0.125"});
    for (const auto format : {Scene::Format::prm, Scene::Format::json})
    {
      std::ostringstream first, second;
      scene.print(first, format);
      const std::string file_name =
        std::string(NMM_TEST_OUTPUT_DIR "/printed") +
        (format == Scene::Format::prm ? ".prm" : ".json");
      std::ofstream(file_name) << first.str();
      const Scene again(file_name);
      EXPECT_EQ(again.parameters().model.thickness, 0.125);
      again.print(second, format);
      EXPECT_EQ(first.str(), second.str());
    }
  }


  std::string
  message_of_scene(const std::string &name, const Words &overrides = {})
  {
    try
    {
      const Scene scene(name, overrides);
    }
    catch (const InputError &error)
    {
      return error.message();
    }
    return "";
  }


  TEST(Scene, NumbersThatCannotBeComputedWithAreRefused)
  {
    for (const std::string bad : {"1e-308", "1e-400", "1e-150", "1e150"})
      for (const std::string parameter :
           {"Model/Thickness", "Materials/rock/Young's modulus"})
      {
        const std::string message =
          message_of_scene(base_scene, {parameter + "=" + bad});
        EXPECT_NE(message.find(bad), std::string::npos) << message;
        EXPECT_NE(message.find(parameter), std::string::npos) << message;
      }
    EXPECT_NE(
      message_of_scene(base_scene, {"Model/Gravity=0, 1e99"}).find("1e99"),
      std::string::npos);
    EXPECT_EQ(message_of_scene(base_scene,
                               {"Model/Gravity=0e7, -1e30",
                                "Materials/rock/Density=1"}),
              "");
  }


  // ParameterHandler does not look at values with braces.
  TEST(Scene, BracesAreNoValue)
  {
    const std::string name = NMM_TEST_OUTPUT_DIR "/brace.prm";
    {
      std::ofstream file(name);
      file << std::ifstream(base_scene).rdbuf()
           << "\nsubsection Model\n  set Analysis = {\nend\n";
    }
    const std::string message = message_of_scene(name);
    EXPECT_NE(message.find("'{'"), std::string::npos) << message;
    EXPECT_NE(message.find("Model/Analysis"), std::string::npos) << message;
  }


  TEST(Scene, DeeplyNestedJsonIsRefused)
  {
    const std::string name = NMM_TEST_OUTPUT_DIR "/nested.json";
    for (const unsigned int n : {40, 20000, 100000})
      for (const std::string open : {"[", "{\"a\":"})
      {
        std::string text;
        for (unsigned int i = 0; i < n; ++i)
          text += open;
        std::ofstream(name) << text;
        EXPECT_NE(message_of_scene(name).find("nested more"),
                  std::string::npos);
      }
    std::ofstream(name) << "{\"a\": \"" << std::string(100, '{') << "\"}";
    EXPECT_EQ(message_of_scene(name).find("nested more"), std::string::npos);
  }


  // Scenes that a program writes: the records of a geometry, and components of expressions.
  TEST(Scene, JsonArraysAreRecords)
  {
    const std::string file_name = NMM_TEST_OUTPUT_DIR "/records.json";
    std::ofstream(file_name)
      << "\xEF\xBB\xBF{\"Geometry\": {\"Text\": ["
         "\"boundary name=disk CIRCLE (0 0, 1)\","
         " \"joint LINESTRING (-2 0, 2 0)\"]},"
         " \"Mathematical mesh\": {\"Cell size\": 0.5},"
         " \"Boundary conditions\": {\"Names\": [\"held\"],"
         "   \"held\": {\"Boundary\": [\"disk\"], \"Type\": \"displacement\","
         "              \"Value\": [0, \"1e-3 * x\"]}},"
         " \"Materials\": {\"Names\": [\"a\"], \"a\": {\"Young's modulus\": "
         "1}}}";
    const Scene scene(file_name);
    EXPECT_EQ(scene.make_geometry().curves().size(), 2u);
    EXPECT_EQ(scene.parameters().boundary_conditions[0].value, "0; 1e-3 * x");
  }


  TEST(Scene, OnlyStatementsOfAScene)
  {
    const auto message = [](const std::string &text) {
      const std::string name = NMM_TEST_OUTPUT_DIR "/statements.prm";
      std::ofstream(name) << text;
      return message_of_scene(name);
    };
    for (const std::string include : {"include /dev/zero",
                                      "  INCLUDE\tstatements.prm",
                                      "inc\\\nlude /etc/shadow"})
      EXPECT_NE(
        message("# a scene\n" + include + "\n").find("statements.prm:2: write"),
        std::string::npos)
        << message(include);
    EXPECT_NE(message("subsection Model\n  subsection X").find("X"),
              std::string::npos);
    for (const std::string text : {"subsection Model\n  set Thickness = 1\n",
                                   "subsection \\\n  Model\n",
                                   "subsection Model # end\n"})
    {
      EXPECT_NE(message(text).find("'Model' is never closed"),
                std::string::npos)
        << message(text);
      EXPECT_NE(message(text).find("statements.prm:1"), std::string::npos)
        << message(text);
    }
  }


  // What the command line makes useless is left out and reported.
  TEST(Scene, ValuesThatOverridesMakeUseless)
  {
    const std::string name = NMM_TEST_OUTPUT_DIR "/useless.prm";
    {
      std::ofstream file(name);
      file << std::ifstream(base_scene).rdbuf()
           << "\nsubsection Model\n  set Analysis = dynamic\nend\n"
              "subsection Time\n  set End time = 1\n"
              "  set Initial step = 0.1\nend\n"
              "subsection Materials\n  subsection rock\n"
              "    set Density = 1\n  end\nend\n"
              "subsection Initial velocities\n  set Names = push\n"
              "  subsection push\n    set Translation = 1, 0\n  end\nend\n";
    }
    EXPECT_EQ(message_of_scene(name), "");
    EXPECT_TRUE(Scene(name).notices().empty());
    const Scene scene(name, {"Model/Analysis=static"});
    EXPECT_TRUE(scene.parameters().initial_velocities.empty());
    ASSERT_EQ(scene.notices().size(), 1u);
    for (const std::string part :
         {"static analysis", "'Time/End time'", "'Initial velocities/Names'"})
      EXPECT_NE(scene.notices()[0].find(part), std::string::npos)
        << scene.notices()[0];
    EXPECT_NE(message_of_scene(name,
                               {"Model/Analysis=static", "Time/End time=2"})
                .find("'End time = 2' would not be used"),
              std::string::npos);
    // Without an override it is a mistake in the file.
    {
      std::ofstream file(name, std::ios::app);
      file << "subsection Model\n  set Analysis = static\nend\n";
    }
    EXPECT_NE(message_of_scene(name).find("would not be used"),
              std::string::npos);
  }


  TEST(Scene, ConfinedToItsFolder)
  {
    namespace fs          = std::filesystem;
    const fs::path folder = NMM_TEST_OUTPUT_DIR "/confined";
    fs::remove_all(folder);
    fs::create_directories(folder / "inside" / "below");
    const std::string records = "boundary name=b CIRCLE (0 0, 1)\n";
    for (const fs::path &file : {folder / "outside.wkt",
                                 folder / "inside" / "beside.wkt",
                                 folder / "inside" / "below" / "deep.wkt"})
      std::ofstream(file) << records;
    fs::create_symlink("../outside.wkt", folder / "inside" / "link.wkt");
    const std::string scene = folder / "inside" / "scene.prm";
    std::ofstream(scene)
      << "subsection Geometry\n  set File = beside.wkt\nend\n"
         "subsection Mathematical mesh\n  set Cell size = 1\nend\n"
         "subsection Materials\n  set Names = a\n  subsection a\n"
         "    set Young's modulus = 1\n  end\nend\n";
    const auto is_refused = [&](const std::string &file, const bool confined) {
      try
      {
        Scene(scene, {"Geometry/File=" + file}, confined).make_geometry();
        return false;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(error.message().find("--confined"), std::string::npos)
          << error.message();
        return true;
      }
    };
    for (const std::string inside : {"beside.wkt",
                                     "below/deep.wkt",
                                     "below/../beside.wkt",
                                     "./beside.wkt"})
      EXPECT_FALSE(is_refused(inside, true)) << inside;
    for (const std::string &outside : {std::string("../outside.wkt"),
                                       std::string("link.wkt"),
                                       std::string("below/../../outside.wkt"),
                                       (folder / "outside.wkt").string()})
    {
      EXPECT_TRUE(is_refused(outside, true)) << outside;
      EXPECT_FALSE(is_refused(outside, false)) << outside;
    }
  }


  TEST(Scene, JsonArraysAreLists)
  {
    const std::string file_name = NMM_TEST_OUTPUT_DIR "/arrays.json";
    std::ofstream(file_name)
      << "{\"Geometry\": {\"Text\": \"boundary CIRCLE (0 0, 1)\"},"
         " \"Mathematical mesh\": {\"Cell size\": 0.5, \"Offset\": [0.25, 1]},"
         " \"Output\": {},"
         " \"Materials\": {\"Names\": [\"a\", \"b\"],"
         "   \"a\": {\"Young's modulus\": 1}, \"b\": {\"Young's modulus\": "
         "2}}}";
    const Scene scene(file_name);
    EXPECT_EQ(scene.parameters().mathematical_mesh.regular.offset[0], 0.25);
    ASSERT_EQ(scene.parameters().materials.size(), 2u);
    EXPECT_EQ(scene.parameters().materials[1].youngs_modulus, 2.);
  }
} // namespace
