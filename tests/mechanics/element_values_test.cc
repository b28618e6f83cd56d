// A stiffness matrix that is assembled with ElementValues is the library's own.

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_values.h>

#include <deal.II/fe/fe_system.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  // The library integrates products of reference gradients and maps them with the Jacobian of the
  // cell; here mapped gradients are multiplied point by point. A cell is cut by arcs, by a crack
  // that ends, and by a joint. The difference is rounding: some 10 eps of the largest entry.
  TEST(ElementValues, TheStiffnessIsTheLibrarysOwn)
  {
    for (const unsigned int degree : {1U, 2U})
    {
      Geometry geometry;
      geometry.add_polygon(pentagon, "outline");
      geometry.add_circle(Point<2>(0.5, 0.6), 0.2, "bore", CurveRole::hole);
      geometry.add_polyline({Point<2>(-1., 0.2), Point<2>(2., 0.3)},
                            "joint",
                            CurveRole::joint);
      geometry.add_polyline({Point<2>(0.9, 0.5), Point<2>(1.1, 0.7)},
                            "crack",
                            CurveRole::joint);
      Model model(std::move(geometry),
                  mesh_parameters(0.13, Tensor<1, 2>(), 17.),
                  degree,
                  Stabilization::none);
      model.problem.plane_state = PlaneState::plane_strain;
      model.problem.materials   = {material("rock", 1000., 0.3)};
      FiniteElasticity elasticity(model.covers,
                                  *model.quadrature,
                                  model.constraints,
                                  model.problem,
                                  /* may_float = */ true);
      elasticity.assemble_at_rest(1.);
      const auto &matrix = elasticity.tangent();

      const dealii::FESystem<2> fe(model.mathematical_mesh.fe(), 2);
      const dealii::FEValuesExtractors::Vector displacement(0);
      const PlaneElasticity                    law =
        model.problem.materials[0].plane_elasticity(PlaneState::plane_strain);
      ElementValues              values(model.covers,
                           *model.quadrature,
                           fe,
                           dealii::update_gradients |
                             dealii::update_JxW_values);
      const unsigned int         n = 2 * model.covers.n_covers();
      dealii::FullMatrix<double> own(n, n);
      for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
      {
        values.reinit(e);
        const auto &dofs = values.get_dof_indices();
        for (const unsigned int q : values.quadrature_point_indices())
          for (const unsigned int i : values.dof_indices())
          {
            const SymmetricTensor<2, 2> strain =
              values[displacement].symmetric_gradient(i, q);
            const SymmetricTensor<2, 2> stress =
              2. * law.mu * strain +
              law.lambda * trace(strain) * dealii::unit_symmetric_tensor<2>();
            for (const unsigned int j : values.dof_indices())
              own(dofs[i], dofs[j]) +=
                stress * values[displacement].symmetric_gradient(j, q) *
                values.JxW(q);
          }
      }
      double largest = 0., difference = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          largest = std::max(largest, std::abs(own(i, j)));
          difference =
            std::max(difference, std::abs(own(i, j) - matrix.el(i, j)));
        }
      EXPECT_GT(largest, 1000.);
      EXPECT_LT(difference, 1e-13 * largest) << "degree " << degree;
    }
  }
} // namespace
