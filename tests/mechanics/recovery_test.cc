// Recovery on interpolated polynomials: exact for degree p on any cut and for
// degree p + 1 where elements are whole, and separate on both sides of a joint.

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Quadratic for degree 1, cubic for degree 2.
  Tensor<1, 2>
  next_polynomial(const Point<2> &x, const unsigned int degree)
  {
    Tensor<1, 2> u({1. + x[0] - 2. * x[1] + x[0] * x[1],
                    0.5 - x[1] + 3. * x[0] * x[0] - x[1] * x[1]});
    if (degree == 2)
      u += Tensor<1, 2>({x[0] * x[0] * x[0] - 2. * x[0] * x[1] * x[1],
                         x[1] * x[1] * x[1] + x[0] * x[0] * x[1]});
    return u;
  }


  Tensor<2, 2>
  next_gradient(const Point<2> &x, const unsigned int degree)
  {
    Tensor<2, 2> g;
    g[0][0] = 1. + x[1];
    g[0][1] = -2. + x[0];
    g[1][0] = 6. * x[0];
    g[1][1] = -1. - 2. * x[1];
    if (degree == 2)
    {
      g[0][0] += 3. * x[0] * x[0] - 2. * x[1] * x[1];
      g[0][1] += -4. * x[0] * x[1];
      g[1][0] += 2. * x[0] * x[1];
      g[1][1] += 3. * x[1] * x[1] + x[0] * x[0];
    }
    return g;
  }
} // namespace


TEST(Recovery, ReproducesTheNextDegreeOnWholeElements)
{
  for (const unsigned int degree : {1, 2})
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    RegularMeshParameters parameters = mesh_parameters(0.125);
    parameters.pattern               = MeshPattern::right_angled;
    Model model(std::move(geometry), parameters, degree);
    ASSERT_EQ(model.manifold_mesh.n_elements(), 128u);
    model.problem.materials = {material()};
    std::vector<Tensor<1, 2>> values;
    for (unsigned int k = 0; k < model.covers.n_covers(); ++k)
      values.push_back(next_polynomial(model.covers.node(k), degree));
    const DisplacementField field(model.covers, model.problem, values);
    const StressRecovery    recovery(field, model.aggregation);
    EXPECT_EQ(recovery.n_direct(), 0u);
    for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
    {
      const Point<2> xi(0.2, 0.3);
      const Point<2> x =
        model.mathematical_mesh.reference_to_real(model.manifold_mesh.cell(e),
                                                  xi);
      // normal equations: rounding times the square of the fit's condition
      EXPECT_LT((recovery.gradient(e, xi) - next_gradient(x, degree)).norm(),
                1e-9);
    }
  }
}


TEST(Recovery, ReproducesTheDegreeOnCutElements)
{
  Geometry geometry;
  geometry.add_circle({0.5, 0.5}, 0.6, "rim", CurveRole::boundary);
  geometry.add_circle({0.4, 0.5}, 0.15, "hole", CurveRole::hole);
  Model model(std::move(geometry), mesh_parameters(0.1, {}, 12.), 2);
  model.problem.materials = {material()};
  std::vector<Tensor<1, 2>> values;
  for (unsigned int k = 0; k < model.covers.n_covers(); ++k)
    values.push_back(next_polynomial(model.covers.node(k), 1));
  const DisplacementField field(model.covers, model.problem, values);
  const StressRecovery    recovery(field, model.aggregation);
  EXPECT_EQ(recovery.n_direct(), 0u);
  for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
  {
    const Point<2> xi(0.2, 0.3);
    const Point<2> x =
      model.mathematical_mesh.reference_to_real(model.manifold_mesh.cell(e),
                                                xi);
    EXPECT_LT((recovery.gradient(e, xi) - next_gradient(x, 1)).norm(), 1e-9);
  }
}


// Different polynomials above and below a through joint, and around a crack that
// ends inside: away from the tip each side is recovered by itself.
TEST(Recovery, NeverCrossesAJoint)
{
  for (const double end : {1.1, 0.62})
  {
    SCOPED_TRACE("joint ends at " + std::to_string(end));
    Geometry geometry;
    add_box(geometry, {0., 0.}, {1., 1.});
    geometry.add_polyline({{-0.1, 0.47}, {end, 0.53}},
                          "joint",
                          CurveRole::joint);
    Model model(std::move(geometry), mesh_parameters(0.07, {}, 12.), 2);
    model.problem.materials = {material()};

    // a cover is above if its elements are, by the region or a point inside
    const auto above = [end](const Point<2> &x) {
      return x[1] > 0.47 + 0.06 / (end + 0.1) * (x[0] + 0.1);
    };
    const double              left_of_tip = end > 1. ? 1.1 : end - 0.42;
    std::vector<Tensor<1, 2>> values(model.covers.n_covers());
    std::vector<bool>         is_above(model.manifold_mesh.n_elements());
    for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
    {
      if (model.quadrature->rule(e).size() == 0)
        continue;
      is_above[e] = above(model.mathematical_mesh.reference_to_real(
        model.manifold_mesh.cell(e), model.quadrature->rule(e).point(0)));
      for (const unsigned int k : model.covers.covers(e))
        values[k] =
          (is_above[e] ? 1. : -1.) * next_polynomial(model.covers.node(k), 1);
    }
    const DisplacementField field(model.covers, model.problem, values);
    const StressRecovery    recovery(field, model.aggregation);
    EXPECT_EQ(recovery.n_direct() > 0, end < 1.);
    unsigned int n_checked = 0;
    for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
      if (model.quadrature->rule(e).size() > 0)
      {
        const Point<2> xi = model.quadrature->rule(e).point(0);
        const Point<2> x =
          model.mathematical_mesh.reference_to_real(model.manifold_mesh.cell(e),
                                                    xi);
        if (x[0] > left_of_tip)
          continue;
        ++n_checked;
        EXPECT_LT((recovery.gradient(e, xi) -
                   (is_above[e] ? 1. : -1.) * next_gradient(x, 1))
                    .norm(),
                  1e-8)
          << to_string(x);
      }
    EXPECT_GT(n_checked, 50u);
  }
}
