#include <nmm/base/exceptions.h>
#include <nmm/io/parameter_tree.h>
#include <nmm/io/scene.h>

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;

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
