// Values on manifold elements, on pieces of their boundaries and of joints.

#include <nmm/base/exceptions.h>
#include <nmm/covers/aggregation.h>
#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

using namespace NMM;

namespace
{
  using namespace dealii;
  using Scalar = FEValuesExtractors::Scalar;

  /// From a geometry to covers, on a mesh that is turned, so that nothing fits by accident.
  struct Model
  {
    Model(const std::string &geometry, const double cell_size)
      : solid(parse_geometry(geometry, "the test"))
      , triangles(make_regular_mesh(solid, mesh_of(cell_size), 2))
      , elements(triangles, solid)
      , covers(elements, MPI_COMM_SELF)
    {
    }

    static RegularMeshParameters
    mesh_of(const double cell_size)
    {
      RegularMeshParameters parameters;
      parameters.cell_size = cell_size;
      parameters.rotation  = 17.;
      return parameters;
    }

    PhysicalMesh     solid;
    MathematicalMesh triangles;
    ManifoldMesh     elements;
    CoverSystem      covers;
  };


  UpdateFlags
  all()
  {
    return UpdateFlags(update_values | update_gradients | update_JxW_values |
                       update_quadrature_points | update_normal_vectors);
  }


  // Integrals over a circle, a hole, with n towards its centre c = (0.1, 0.2): the length 2 pi r,
  // the closed curve's normals, and (x - c) n = -r. Gauss rules on arcs are exact to rounding.
  TEST(Values, CurvesHaveTheirLengthsAndNormals)
  {
    Model model(R"(boundary name=side LINESTRING (-1 -1, 1 -1, 1 1, -1 1, -1 -1)
                   hole name=bore CIRCLE (0.1 0.2, 0.3)
                   joint name=crack LINESTRING (-0.8 -0.7, 0.5 -0.6))",
                0.21);
    EdgeValues edge(model.covers, 4, model.triangles.fe(), all());
    const auto integrate = [&](const std::string &name) {
      double       length = 0., flux = 0.;
      Tensor<1, 2> normals;
      for (const EdgePiece &piece : boundary_pieces(model.covers, name))
      {
        edge.reinit(piece);
        for (const unsigned int q : edge.quadrature_point_indices())
        {
          const Tensor<1, 2> r = edge.quadrature_point(q) - Point<2>(0.1, 0.2);
          length += edge.JxW(q);
          normals += edge.JxW(q) * edge.normal(q);
          flux += edge.JxW(q) * (r * edge.normal(q));
        }
      }
      EXPECT_LT(normals.norm(), 1e-13) << name;
      return std::make_pair(length, flux);
    };
    const auto [circumference, flux] = integrate("bore");
    EXPECT_NEAR(circumference, 0.6 * numbers::PI, 1e-13);
    EXPECT_NEAR(flux, -0.18 * numbers::PI, 1e-13);
    // divergence theorem on the square
    const auto [outline, twice_the_area] = integrate("side");
    EXPECT_NEAR(outline, 8., 1e-12);
    EXPECT_NEAR(twice_the_area, 8., 1e-12);
    // both faces of the crack, whose fluxes cancel
    const auto [faces, nothing] = integrate("crack");
    EXPECT_NEAR(faces, 2. * std::hypot(1.3, 0.1), 1e-13);
    EXPECT_NEAR(nothing, 0., 1e-13);

    JointValues joint(model.covers, 4, model.triangles.fe(), all());
    // All but the last part of the crack, which has the same element on both sides.
    double length = 0., last = 0.;
    for (const EdgePiece &piece : joint_pieces(model.covers))
    {
      joint.reinit(piece);
      for (const unsigned int q : joint.quadrature_point_indices())
        length += joint.JxW(q);
    }
    for (const EdgePiece &piece : boundary_pieces(model.covers, "crack"))
      if (piece.edge.neighbor == piece.element)
        last += 0.5 * piece.edge.start.distance(piece.edge.end);
    EXPECT_NEAR(length + last, std::hypot(1.3, 0.1), 1e-13);
    EXPECT_GT(length, 0.8);
  }


  // The boundaries of two domains that share an edge: each has four sides and its own outward
  // normals.
  TEST(Values, BoundariesBelongToTheirDomains)
  {
    Model      model(R"(boundary name=a LINESTRING (0 0, 1 0, 1 1, 0 1, 0 0)
                   boundary name=b LINESTRING (1 0, 3 0, 3 1, 1 1, 1 0))",
                0.3);
    EdgeValues edge(model.covers, 2, model.triangles.fe(), all());
    for (const auto &[name, width] :
         {std::make_pair("a", 1.), std::make_pair("b", 2.)})
    {
      double length = 0., twice_the_area = 0.;
      for (const EdgePiece &piece : boundary_pieces(model.covers, name))
      {
        edge.reinit(piece);
        for (const unsigned int q : edge.quadrature_point_indices())
        {
          length += edge.JxW(q);
          twice_the_area +=
            edge.JxW(q) *
            (Tensor<1, 2>(edge.quadrature_point(q)) * edge.normal(q));
        }
      }
      EXPECT_NEAR(length, 2. * (1. + width), 1e-13) << name;
      EXPECT_NEAR(twice_the_area, 2. * width, 1e-13) << name;
    }
  }


  // A displacement and a pressure, each a polynomial on either side of a joint through
  // everything. The space contains them, so values, gradients, jumps and averages are exact to
  // rounding.
  TEST(Values, FieldsOfSeveralComponentsJump)
  {
    Model model(R"(boundary name=side LINESTRING (-1 -1, 1 -1, 1 1, -1 1, -1 -1)
                   joint name=fault LINESTRING (-2 -0.31, 2 0.45))",
                0.4);
    const FESystem<2> fe(model.triangles.fe(), 2, model.triangles.fe(), 1);
    const FEValuesExtractors::Vector displacement(0);
    const Scalar                     pressure(2);
    const auto value = [](const Point<2> &x, const bool above) {
      const double s = above ? 1. : -2.;
      return std::array<double, 3>{
        {s * x[0] * x[1], 1. + s * x[1], s + x[0] * x[0]}};
    };
    const auto is_above = [&](const unsigned int element) {
      const Point<2> x = model.elements.reference_point(element);
      return x[1] > -0.31 + 0.19 * (x[0] + 2.);
    };
    Vector<double> solution(3 * model.covers.n_covers());
    for (unsigned int e = 0; e < model.elements.n_elements(); ++e)
      for (const unsigned int k : model.covers.covers(e))
        for (unsigned int c = 0; c < 3; ++c)
          solution(3 * k + c) = value(model.covers.node(k), is_above(e))[c];

    constexpr double           tolerance = 1e-13;
    const QuadratureCollection rules(model.elements,
                                     2,
                                     4,
                                     {0, model.elements.n_elements()});
    ElementValues              values(model.covers, rules, fe, all());
    std::vector<double>        p;
    std::vector<Tensor<1, 2>>  u, grad_p;
    std::vector<Tensor<2, 2>>  grad_u;
    double                     area = 0.;
    for (unsigned int e = 0; e < model.elements.n_elements(); ++e)
    {
      values.reinit(e);
      EXPECT_EQ(values.dofs_per_element(), 18U);
      values[displacement].get_function_values(solution, u);
      values[displacement].get_function_gradients(solution, grad_u);
      values[pressure].get_function_values(solution, p);
      values[pressure].get_function_gradients(solution, grad_p);
      const double s = is_above(e) ? 1. : -2.;
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const Point<2> x     = values.quadrature_point(q);
        const auto     exact = value(x, is_above(e));
        EXPECT_NEAR(u[q][0], exact[0], tolerance);
        EXPECT_NEAR(u[q][1], exact[1], tolerance);
        EXPECT_NEAR(p[q], exact[2], tolerance);
        EXPECT_NEAR(grad_u[q][0][0], s * x[1], 1e-12);
        EXPECT_NEAR(grad_u[q][0][1], s * x[0], 1e-12);
        EXPECT_NEAR(grad_u[q][1][1], s, 1e-12);
        EXPECT_NEAR(grad_p[q][0], 2. * x[0], 1e-12);
        double divergence = 0.;
        for (const unsigned int i : values.dof_indices())
          divergence += solution(values.get_dof_indices()[i]) *
                        values[displacement].divergence(i, q);
        EXPECT_NEAR(divergence, trace(grad_u[q]), 1e-12);
        area += values.JxW(q);
      }
    }
    EXPECT_NEAR(area, 4., 1e-13);

    JointValues         joint(model.covers, 4, fe, all());
    unsigned int        n_points = 0;
    std::vector<double> jumps;
    for (const EdgePiece &piece : joint_pieces(model.covers, "fault"))
    {
      joint.reinit(piece);
      ASSERT_EQ(joint.n_current_interface_dofs(), 36U);
      const bool above = is_above(piece.element);
      joint[pressure].get_jump_in_function_values(solution, jumps);
      joint[displacement].get_jump_in_function_values(solution, u);
      for (const unsigned int q : joint.quadrature_point_indices())
      {
        ++n_points;
        const Point<2> x    = joint.quadrature_point(q);
        const auto     here = value(x, above), there = value(x, !above);
        // the normal points to the other side
        EXPECT_EQ(joint.normal(q)[1] > 0., !above);
        EXPECT_NEAR(jumps[q], here[2] - there[2], tolerance);
        EXPECT_NEAR(u[q][0], here[0] - there[0], tolerance);
        EXPECT_NEAR(u[q][1], here[1] - there[1], tolerance);
        double       average = 0., jump = 0.;
        Tensor<1, 2> gradient;
        for (const unsigned int i : joint.dof_indices())
        {
          const double z = solution(joint.get_interface_dof_indices()[i]);
          average += z * joint.average_of_shape_values(i, q, 2);
          jump += z * joint.jump_in_shape_values(i, q, 1);
          gradient += z * joint.average_of_shape_gradients(i, q, 1);
        }
        EXPECT_NEAR(average, 0.5 * (here[2] + there[2]), tolerance);
        EXPECT_NEAR(jump, here[1] - there[1], tolerance);
        EXPECT_NEAR(gradient[1], -0.5, 1e-12);
      }
    }
    EXPECT_GT(n_points, 10U);
  }


  // Near the tip of a crack both sides share covers. A continuous field has no jump there.
  TEST(Values, SharedCoversDoNotJump)
  {
    Model model(R"(boundary name=side LINESTRING (-1 -1, 1 -1, 1 1, -1 1, -1 -1)
                   joint name=crack LINESTRING (-2 0.1, 0.13 0.17))",
                0.3);
    JointValues         joint(model.covers, 4, model.triangles.fe(), all());
    Vector<double>      solution(model.covers.n_covers());
    std::vector<double> jumps;
    unsigned int        n_shared = 0;
    for (unsigned int k = 0; k < solution.size(); ++k)
      solution(k) = 1. + model.covers.node(k)[0] * model.covers.node(k)[1];
    for (const EdgePiece &piece : joint_pieces(model.covers))
    {
      joint.reinit(piece);
      n_shared += 12 - joint.n_current_interface_dofs();
      std::vector<types::global_dof_index> dofs =
        joint.get_interface_dof_indices();
      std::sort(dofs.begin(), dofs.end());
      EXPECT_EQ(std::unique(dofs.begin(), dofs.end()), dofs.end());
      joint[Scalar(0)].get_jump_in_function_values(solution, jumps);
      for (const double jump : jumps)
        EXPECT_NEAR(jump, 0., 1e-13);
    }
    EXPECT_GT(n_shared, 0U);
  }


  // Poisson's equation with a quadratic solution: given on the sides by Nitsche's method, its
  // flux on both faces of a crack, and a joint through everything that averages and jumps tie.
  // Rounding of a direct solution with a condition number near 1e5.
  TEST(Values, APatchWithACrackAndATiedJoint)
  {
    Model model(
      R"(boundary name=side LINESTRING (0 0, 1.1 0.1, 1.3 0.9, 0.4 1.2, -0.2 0.6, 0 0)
                   joint name=tied LINESTRING (-1 0.35, 2 0.42)
                   joint name=crack LINESTRING (0.3 0.6, 0.7 0.85))",
      0.17);
    const auto exact = [](const Point<2> &x) {
      return 1. - 2. * x[0] + x[1] + x[0] * x[0] + 3. * x[0] * x[1] -
             0.5 * x[1] * x[1];
    };
    const auto flux = [](const Point<2> &x) {
      return Tensor<1, 2>({-2. + 2. * x[0] + 3. * x[1], 1. + 3. * x[0] - x[1]});
    };
    const AffineConstraints<double> constraints =
      make_constraints(model.covers, aggregate(model.covers), 1);
    const unsigned int         n = model.elements.n_elements();
    const QuadratureCollection rules(model.elements, 4, 4, {0, n});
    const auto                &fe = model.triangles.fe();
    ElementValues              values(model.covers, rules, fe, all());
    EdgeValues                 edge(model.covers, 4, fe, all());
    JointValues                joint(model.covers, 4, fe, all());
    const auto                 tied = joint_pieces(model.covers, "tied");
    SparsityPattern            pattern;
    pattern.copy_from(
      make_sparsity_pattern(model.covers, 1, constraints, tied));
    SparseMatrix<double> A(pattern);
    Vector<double>       b(model.covers.n_covers());
    const double         beta = 40. / 0.17;

    for (unsigned int e = 0; e < n; ++e)
    {
      values.reinit(e);
      FullMatrix<double> local(6);
      Vector<double>     rhs(6);
      for (const unsigned int q : values.quadrature_point_indices())
        for (const unsigned int i : values.dof_indices())
        {
          // -laplace u
          rhs(i) -= values.shape_value(i, q) * values.JxW(q);
          for (const unsigned int j : values.dof_indices())
            local(i, j) +=
              values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
        }
      constraints.distribute_local_to_global(
        local, rhs, values.get_dof_indices(), A, b);
    }
    for (const EdgePiece &piece : boundary_pieces(model.covers, "crack"))
    {
      edge.reinit(piece);
      Vector<double> rhs(6);
      for (const unsigned int q : edge.quadrature_point_indices())
        for (const unsigned int i : edge.dof_indices())
          rhs(i) += flux(edge.quadrature_point(q)) * edge.normal(q) *
                    edge.shape_value(i, q) * edge.JxW(q);
      constraints.distribute_local_to_global(rhs, edge.get_dof_indices(), b);
    }
    for (const EdgePiece &piece : boundary_pieces(model.covers, "side"))
    {
      edge.reinit(piece);
      FullMatrix<double> local(6);
      Vector<double>     rhs(6);
      for (const unsigned int q : edge.quadrature_point_indices())
        for (const unsigned int i : edge.dof_indices())
        {
          const auto derivative = [&](const unsigned int k) {
            return edge.normal(q) * edge[Scalar(0)].gradient(k, q);
          };
          const double v = edge[Scalar(0)].value(i, q);
          const double w = (beta * v - derivative(i)) * edge.JxW(q);
          rhs(i) += w * exact(edge.quadrature_point(q));
          for (const unsigned int j : edge.dof_indices())
            local(i, j) +=
              w * edge.shape_value(j, q) - v * derivative(j) * edge.JxW(q);
        }
      constraints.distribute_local_to_global(
        local, rhs, edge.get_dof_indices(), A, b);
    }
    for (const EdgePiece &piece : tied)
    {
      joint.reinit(piece);
      FullMatrix<double> local(joint.n_current_interface_dofs());
      for (const unsigned int q : joint.quadrature_point_indices())
        for (const unsigned int i : joint.dof_indices())
          for (const unsigned int j : joint.dof_indices())
          {
            const double u = joint.jump_in_shape_values(j, q),
                         v = joint.jump_in_shape_values(i, q);
            local(i, j) +=
              (beta * u * v -
               joint.normal(q) * joint.average_of_shape_gradients(j, q) * v -
               joint.normal(q) * joint.average_of_shape_gradients(i, q) * u) *
              joint.JxW(q);
          }
      constraints.distribute_local_to_global(local,
                                             joint.get_interface_dof_indices(),
                                             A);
    }
    SparseDirectUMFPACK solver;
    solver.solve(A, b);
    constraints.distribute(b);

    std::vector<double> u;
    double              error = 0.;
    for (unsigned int e = 0; e < n; ++e)
    {
      values.reinit(e);
      values[Scalar(0)].get_function_values(b, u);
      for (const unsigned int q : values.quadrature_point_indices())
        error =
          std::max(error, std::abs(u[q] - exact(values.quadrature_point(q))));
    }
    EXPECT_LT(error, 1e-11);
  }


  TEST(Values, ArgumentsThatDoNotFitAreRefused)
  {
    Model model("boundary name=side LINESTRING (0 0, 1 0, 1 1, 0 0)", 0.5);
    const auto &fe = model.triangles.fe();
    EXPECT_THROW(boundary_pieces(model.covers, "edge"), InputError);
    EXPECT_THROW(joint_pieces(model.covers, "edge"), InputError);
    EXPECT_TRUE(joint_pieces(model.covers).empty());
    EXPECT_THROW(EdgeValues(model.covers, 2, FE_SimplexP<2>(1), update_values),
                 InputError);
    EXPECT_THROW(EdgeValues(model.covers,
                            2,
                            FESystem<2>(fe, 1, FE_SimplexP<2>(1), 1),
                            update_values),
                 InputError);
    EXPECT_THROW(EdgeValues(model.covers, 2, fe, update_hessians), InputError);
    // groups of groups are fine
    EXPECT_NO_THROW(EdgeValues(model.covers,
                               2,
                               FESystem<2>(FESystem<2>(fe, 2), 1, fe, 2),
                               update_values));
  }
} // namespace
