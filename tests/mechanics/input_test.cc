// Parameters: materials, checks of the problem, weight functions.

#include <nmm/covers/weight_functions.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

TEST(WeightFunctions, AreThoseOfTheFiniteElement)
{
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> random(-0.5, 1.5);
  for (const unsigned int degree : {1, 2})
  {
    const dealii::FE_SimplexP<2> fe(degree);
    ASSERT_EQ(fe.n_dofs_per_cell(), WeightFunctions::n_per_cell(degree));
    for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const Point<2> xi(random(generator), random(generator));
      double         w[WeightFunctions::max_per_cell];
      double         g[WeightFunctions::max_per_cell][2];
      WeightFunctions::values(degree, xi, w);
      WeightFunctions::gradients(degree, xi, g);
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        EXPECT_NEAR(w[i], fe.shape_value(i, xi), 1e-13);
        for (unsigned int d = 0; d < 2; ++d)
          EXPECT_NEAR(g[i][d], fe.shape_grad(i, xi)[d], 1e-13);
      }
    }
  }
}


TEST(Material, ElasticityTensor)
{
  const Material m = material("m", 200., 0.3);
  // uniaxial stress in plane stress: sigma_xx = E eps_xx for eps_yy = -nu eps_xx
  SymmetricTensor<2, 2> strain;
  strain[0][0] = 0.01;
  strain[1][1] = -0.003;
  auto stress  = m.elasticity_tensor(PlaneState::plane_stress) * strain;
  EXPECT_NEAR(stress[0][0], 2., 1e-13);
  EXPECT_NEAR(stress[1][1], 0., 1e-13);
  EXPECT_EQ(m.out_of_plane_stress(strain, PlaneState::plane_stress), 0.);

  // plane strain: sigma_zz = nu (sigma_xx + sigma_yy), eps_zz = 0
  strain[0][1]     = 0.005;
  stress           = m.elasticity_tensor(PlaneState::plane_strain) * strain;
  const double szz = m.out_of_plane_stress(strain, PlaneState::plane_strain);
  EXPECT_NEAR(szz, 0.3 * (stress[0][0] + stress[1][1]), 1e-13);
  EXPECT_NEAR((stress[0][0] - 0.3 * (stress[1][1] + szz)) / 200., 0.01, 1e-15);
  EXPECT_NEAR(stress[0][1], 200. / 2.6 * 0.01, 1e-13);

  // the bound that penalties rest on
  const PlaneElasticity e = m.plane_elasticity(PlaneState::plane_strain);
  EXPECT_NEAR(e.stress(dealii::unit_symmetric_tensor<2>())[0][0],
              e.largest_eigenvalue(),
              1e-12);
}


namespace
{
  template <typename Change>
  std::string
  complaint(const Change &change)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    geometry.add_polyline({{0.2, 0.5}, {0.8, 0.5}}, "crack", CurveRole::joint);
    const PhysicalMesh mesh(std::move(geometry));
    ElasticityProblem  problem;
    problem.materials           = {material("granite")};
    problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom")};
    change(problem);
    try
    {
      problem.check(mesh);
    }
    catch (const InputError &error)
    {
      return error.message();
    }
    return "";
  }


  testing::AssertionResult
  mentions(const std::string &text, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      if (text.find(part) == std::string::npos)
        return testing::AssertionFailure()
               << '"' << part << "\" is not in \"" << text << '"';
    return testing::AssertionSuccess();
  }
} // namespace


TEST(Problem, BadInputIsNamed)
{
  EXPECT_EQ(complaint([](ElasticityProblem &) {}), "");
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials[0].youngs_modulus = -3.;
                       }),
                       {"Young", "-3 Pa", "granite"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials[0].poissons_ratio = 0.5;
                       }),
                       {"Poisson", "0.5", "granite"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials[0].density = -1.;
                       }),
                       {"Density", "-1", "granite"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials[0] = Material();
                       }),
                       {"nan"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials.push_back(material("granite"));
                       }),
                       {"same name", "granite"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.materials.push_back(material("marble"));
                       }),
                       {"has no material", "granite", "marble"}));
  EXPECT_TRUE(
    mentions(complaint([](ElasticityProblem &p) { p.materials.clear(); }),
             {"no material"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.boundary_conditions[0].curve = "botom";
                       }),
                       {"botom", "bottom", "left"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.boundary_conditions[0].curve = "crack";
                       }),
                       {"crack", "no boundary"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.boundary_conditions[0].value = constant(1.);
                       }),
                       {"1 component", "give 2"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         p.boundary_conditions[0].components[0] = false;
                         p.boundary_conditions[0].components[1] = false;
                       }),
                       {"No component"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         PointForce force;
                         force.point = {3., 0.5};
                         p.point_forces.push_back(force);
                       }),
                       {"point force", "(3, 0.5)"}));
  EXPECT_TRUE(mentions(complaint([](ElasticityProblem &p) {
                         FixedPoint fixed;
                         fixed.point     = {0.5, 0.5};
                         fixed.stiffness = -1.;
                         p.fixed_points.push_back(fixed);
                       }),
                       {"fixed point", "-1"}));
}


// Inside the bounding box but in a hole.
TEST(Problem, PointInAHoleIsNamed)
{
  Geometry geometry;
  add_box(geometry, {0., 0.}, {1., 1.});
  geometry.add_circle({0.5, 0.5}, 0.3, "hole", CurveRole::hole);
  Model model(std::move(geometry), mesh_parameters(0.2), 2);
  model.problem.materials = {material()};
  PointForce force;
  force.point                = {0.5, 0.55};
  model.problem.point_forces = {force};
  EXPECT_THROW(StaticElasticity(model.covers,
                                *model.quadrature,
                                model.constraints,
                                model.problem),
               InputError);
  // a corner belongs to the solid
  model.problem.point_forces[0].point = {1., 1.};
  EXPECT_NO_THROW(StaticElasticity(
    model.covers, *model.quadrature, model.constraints, model.problem));
}
