// A weak form of one's own, from curves to a picture: heat conduction with a joint that resists the
// flux, and cracks that no heat passes. The function conduct_heat() has at most 80 lines.

#include <nmm/covers/aggregation.h>
#include <nmm/output/picture.h>
#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
  using namespace dealii;

  /// Conductivity [W/K], resistance of the ring [K m/W], source [W/m^2] and radius of the ring [m].
  /// The heat capacity is 1 J/(m^2 K).
  constexpr double k = 2., R = 0.3, f = 4., a = 0.5;


  /// T = t g with k div grad g = -f. The flux t f r / 2 is radial, so that it does not meet the cracks;
  /// at the ring T drops by R times the flux.
  double
  exact(const Point<2> &x, const unsigned int block, const double t)
  {
    // block 0 is the one that begins farther left, outside of the ring
    return t * (-f * x.norm_square() / (4. * k) +
                (block == 1 ? R * f * a / 2. : 0.));
  }


  // The heat equation dT/dt - div(k grad T) = s by the implicit Euler method. On the outline T is
  // given by Nitsche's method. Returns the largest error at a quadrature point.
  double
  conduct_heat(const double cell_size, const std::string &picture)
  {
    const NMM::PhysicalMesh    plate(NMM::parse_geometry(R"(
      boundary name=outline LINESTRING (-1 -1, 1 -1, 1 1, -1 1, -1 -1)
      joint    name=ring    CIRCLE (0 0, 0.5)
      joint    name=crack   LINESTRING (0.6 0.3, 0.8 0.4)
      joint    name=crack   LINESTRING (-0.1 0.2, -0.2 0.4))",
                                                      "the plate"));
    NMM::RegularMeshParameters mesh;
    mesh.cell_size                    = cell_size;
    const auto              triangles = NMM::make_regular_mesh(plate, mesh, 2);
    const NMM::ManifoldMesh elements(triangles, plate);
    NMM::CoverSystem        covers(elements, MPI_COMM_SELF);
    const auto              aggregation = NMM::aggregate(covers);
    const auto constraints = NMM::make_constraints(covers, aggregation, 1);
    const unsigned int              n = elements.n_elements();
    const NMM::QuadratureCollection rules(elements, 4, 4, {0, n});

    const auto flags = update_values | update_gradients | update_JxW_values |
                       update_quadrature_points | update_normal_vectors;
    NMM::ElementValues values(covers, rules, triangles.fe(), flags);
    NMM::EdgeValues    edge(covers, 4, triangles.fe(), flags);
    NMM::JointValues   joint(covers, 4, triangles.fe(), flags);
    const auto         outline = NMM::boundary_pieces(covers, "outline");
    const auto         ring    = NMM::joint_pieces(covers, "ring");
    SparsityPattern    pattern;
    pattern.copy_from(NMM::make_sparsity_pattern(covers, 1, constraints, ring));
    Vector<double>      T(covers.n_covers());
    std::vector<double> before;
    FullMatrix<double>  A_e(6, 6);
    Vector<double>      b_e(6);
    const double        dt = 0.5, beta = 40. * k / cell_size;
    double              error = 0.;
    for (double t = dt; t < 1.6; t += dt)
    {
      SparseMatrix<double> A(pattern);
      Vector<double>       b(T.size());
      for (unsigned int e = 0; e < n; ++e)
      {
        values.reinit(e);
        values[FEValuesExtractors::Scalar(0)].get_function_values(T, before);
        A_e = 0.;
        b_e = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
        {
          const double dx = values.JxW(q);
          const double g =
            exact(values.quadrature_point(q), elements.block(e), 1.);
          error = std::max(error, std::abs(before[q] - (t - dt) * g));
          for (const unsigned int i : values.dof_indices())
          {
            const double v = values.shape_value(i, q) * dx;
            b_e(i) += (before[q] + dt * (g + t * f)) * v;
            for (const unsigned int j : values.dof_indices())
              A_e(i, j) +=
                values.shape_value(j, q) * v +
                dt * k * dx * values.shape_grad(j, q) * values.shape_grad(i, q);
          }
        }
        constraints.distribute_local_to_global(
          A_e, b_e, values.get_dof_indices(), A, b);
      }
      for (const auto &piece : outline)
      {
        edge.reinit(piece);
        A_e = 0.;
        b_e = 0.;
        for (const unsigned int q : edge.quadrature_point_indices())
          for (const unsigned int i : edge.dof_indices())
          {
            const auto   n_ds = dt * k * edge.JxW(q) * edge.normal(q);
            const double v = dt * beta * edge.JxW(q) * edge.shape_value(i, q);
            const double w = v - n_ds * edge.shape_grad(i, q);
            b_e(i) +=
              w *
              exact(edge.quadrature_point(q), elements.block(piece.element), t);
            for (const unsigned int j : edge.dof_indices())
              A_e(i, j) +=
                w * edge.shape_value(j, q) -
                edge.shape_value(i, q) * (n_ds * edge.shape_grad(j, q));
          }
        constraints.distribute_local_to_global(
          A_e, b_e, edge.get_dof_indices(), A, b);
      }
      for (const auto &piece : ring)
      {
        joint.reinit(piece);
        FullMatrix<double> A_j(joint.n_current_interface_dofs());
        for (const unsigned int q : joint.quadrature_point_indices())
          for (const unsigned int i : joint.dof_indices())
            for (const unsigned int j : joint.dof_indices())
              A_j(i, j) += dt / R * joint.jump_in_shape_values(i, q) *
                           joint.jump_in_shape_values(j, q) * joint.JxW(q);
        constraints.distribute_local_to_global(
          A_j, joint.get_interface_dof_indices(), A);
      }
      SparseDirectUMFPACK solver;
      solver.solve(A, b);
      T = b;
      constraints.distribute(T);
    }
    NMM::draw_scalar_picture(
      covers, T, "temperature [K]", "A ring that resists heat", picture);
    return error;
  }


  // The solution is in the space: on both sides of the ring it is a quadratic polynomial, and linear
  // in time. What remains is the rounding of a direct solution, with a condition number near 1e4, and
  // T is of size 1. Without the jumps the error would be that of the drop, 0.3.
  TEST(HeatEquation, ARingResistsAndCracksInsulate)
  {
    const std::string picture = NMM_TEST_OUTPUT_DIR "/heat.png";
    std::filesystem::remove(picture);
    EXPECT_LT(conduct_heat(0.17, picture), 1e-11);
    EXPECT_GT(std::filesystem::file_size(picture), 10000U);
  }
} // namespace
