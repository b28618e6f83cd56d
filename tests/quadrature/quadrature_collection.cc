// The rules of a whole manifold mesh: they integrate over the solid, however
// the mesh is cut.

#include <nmm/covers/manifold_mesh.h>
#include <nmm/quadrature/element_quadrature.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace NMM;

namespace
{
  PhysicalMesh
  ring()
  {
    Geometry geometry;
    geometry.add_circle({0., 0.}, 2., "outer", CurveRole::boundary);
    geometry.add_circle({0., 0.}, 1., "inner", CurveRole::hole);
    geometry.add_polyline({{-3., 0.3}, {3., 0.5}}, "joint", CurveRole::joint);
    geometry.add_polyline({{0.1, 1.2}, {0.2, 1.7}}, "crack", CurveRole::joint);
    return PhysicalMesh(std::move(geometry));
  }


  // Every rule against the area that the element's boundary encloses, for meshes
  // at many places, among them ones whose lines lie within rounding of the cut
  // y = 0 and of the circles' ends.
  TEST(QuadratureCollection, EveryRuleHasItsElementsArea)
  {
    Geometry geometry;
    Curve    half;
    half.name   = "half ring";
    half.pieces = {CurvePiece::segment({1., 0.}, {2., 0.}),
                   CurvePiece::arc({2., 0.}, {0., 2.}, {-2., 0.}),
                   CurvePiece::segment({-2., 0.}, {-1., 0.}),
                   CurvePiece::arc({-1., 0.}, {0., 1.}, {1., 0.})};
    geometry.add(half);
    const PhysicalMesh physical_mesh(std::move(geometry));
    for (unsigned int k = 0; k < 40; ++k)
    {
      SCOPED_TRACE("mesh " + std::to_string(k));
      RegularMeshParameters parameters;
      parameters.cell_size = k % 2 == 0 ? 0.1 : 0.05 + 0.003 * k;
      parameters.rotation  = k % 4 == 0 ? 0. : 1.7 * k;
      parameters.pattern =
        k % 4 == 0 ? MeshPattern::right_angled : MeshPattern::equilateral;
      if (k > 0)
        parameters.offset = dealii::Tensor<1, 2>({1e-16 * k, 1e-17 * k});
      const MathematicalMesh cells =
        make_regular_mesh(physical_mesh, parameters, 2);
      const ManifoldMesh         mesh(cells, physical_mesh);
      const QuadratureCollection rules(mesh, 2, 4, {0, mesh.n_elements()});
      double                     sum               = 0.;
      unsigned int               n_within_rounding = 0;
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const double cell_area = cells.cell_area(mesh.cell(e));
        // corners of size 2 are known to 4e-16, edges are up to 0.17 long
        ASSERT_NEAR(rules.area_fraction(e) * cell_area, mesh.area(e), 1e-15);
        sum += mesh.area(e);
        n_within_rounding += rules.area_fraction(e) < 1e-12;
      }
      // only slivers a few ulp thick may miss their higher moments
      EXPECT_LE(rules.n_fallbacks(), n_within_rounding);
      EXPECT_NEAR(sum, 1.5 * dealii::numbers::PI, 1e-12);
    }
  }


  TEST(QuadratureCollection, IntegratesOverTheRing)
  {
    const PhysicalMesh physical_mesh = ring();
    for (const double rotation : {0., 17.})
    {
      SCOPED_TRACE("rotation " + std::to_string(rotation));
      RegularMeshParameters parameters;
      parameters.cell_size = 0.37;
      parameters.rotation  = rotation;
      const MathematicalMesh cells =
        make_regular_mesh(physical_mesh, parameters, 2);
      const ManifoldMesh         mesh(cells, physical_mesh);
      const QuadratureCollection rules(mesh, 4, 4, {0, mesh.n_elements()});
      EXPECT_EQ(rules.n_fallbacks(), 0u);

      double       area = 0., area_by_fraction = 0., moment = 0., quartic = 0.;
      unsigned int n_cut = 0;
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int           cell = mesh.cell(e);
        const dealii::Quadrature<2> &rule = rules.rule(e);
        EXPECT_LE(rule.size(), 15u);
        EXPECT_GE(rules.area_fraction(e), 0.);
        EXPECT_LE(rules.area_fraction(e), 1.);
        if (mesh.is_whole(e))
        {
          EXPECT_EQ(rules.area_fraction(e), 1.);
        }
        else
          ++n_cut;
        area_by_fraction += rules.area_fraction(e) * cells.cell_area(cell);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const auto   x = cells.reference_to_real(cell, rule.point(q));
          const double w = 2. * cells.cell_area(cell) * rule.weight(q);
          area += w;
          moment += w * x[0] * x[0];
          quartic += w * x.norm_square() * x.norm_square();
        }
      }
      EXPECT_GT(n_cut, 50u);
      // sums of thousands of terms that are exact to round-off
      EXPECT_NEAR(area / (3. * M_PI), 1., 1e-14);
      EXPECT_NEAR(area_by_fraction / (3. * M_PI), 1., 1e-14);
      EXPECT_NEAR(moment / (15. / 4. * M_PI), 1., 1e-14);
      EXPECT_NEAR(quartic / (63. / 3. * M_PI), 1., 1e-14);
    }
  }


  // The divergence theorem over every cut element: its edges carry the outward
  // normals that its rule expects.
  TEST(QuadratureCollection, EdgesCloseEveryElement)
  {
    const PhysicalMesh    physical_mesh = ring();
    RegularMeshParameters parameters;
    parameters.cell_size = 0.37;
    const MathematicalMesh cells =
      make_regular_mesh(physical_mesh, parameters, 2);
    const ManifoldMesh         mesh(cells, physical_mesh);
    const QuadratureCollection rules(mesh, 4, 4, {0, mesh.n_elements()});
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      if (!mesh.is_whole(e))
      {
        const unsigned int   cell  = mesh.cell(e);
        const CellFrame      frame = cell_frame(mesh, e);
        dealii::Tensor<1, 2> closed;
        double               twice_area = 0.;
        for (const ElementEdge &edge : mesh.edges(e))
        {
          const EdgeRule rule = make_edge_rule(edge, frame, 1);
          for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            closed += rule.weights[q] * rule.normals[q];
            twice_area += rule.weights[q] *
                          (rule.normals[q] * (frame.jacobian * rule.points[q]));
          }
        }
        // perimeters are below 2, round-off of the vertices 1e-16
        EXPECT_NEAR(closed.norm(), 0., 1e-14) << "element " << e;
        EXPECT_NEAR(0.5 * twice_area,
                    rules.area_fraction(e) * cells.cell_area(cell),
                    1e-15)
          << "element " << e;
      }
  }


  TEST(QuadratureCollection, MakesTheElementsOfARange)
  {
    const PhysicalMesh    physical_mesh = ring();
    RegularMeshParameters parameters;
    parameters.cell_size = 0.5;
    const MathematicalMesh cells =
      make_regular_mesh(physical_mesh, parameters, 2);
    const ManifoldMesh         mesh(cells, physical_mesh);
    const unsigned int         n = mesh.n_elements();
    const QuadratureCollection all(mesh, 2, 4, {0, n});
    const QuadratureCollection part(mesh, 2, 4, {n / 3, n / 2});
    for (unsigned int e = n / 3; e < n / 2; ++e)
    {
      EXPECT_EQ(part.rule(e).get_weights(), all.rule(e).get_weights());
      EXPECT_EQ(part.area_fraction(e), all.area_fraction(e));
      if (mesh.is_whole(e))
      {
        EXPECT_EQ(part.rule(e).size(), 3u);
      }
    }
    const QuadratureCollection none(mesh, 2, 4, {n, n});
    EXPECT_EQ(none.n_fallbacks(), 0u);
  }
} // namespace
