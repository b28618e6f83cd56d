#include "fitted_ring.h"

#include <nmm/mechanics/thick_ring.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <cmath>

namespace StepNMM1
{
  using namespace dealii;

  namespace
  {
    /// Boundary ids of the quarter ring.
    enum : types::boundary_id
    {
      inner     = 1,
      outer     = 2,
      on_x_axis = 3,
      on_y_axis = 4
    };


    void
    make_polar_mesh(Triangulation<2> &triangulation,
                    const Parameters &parameters,
                    const double      cell_size)
    {
      const double a = parameters.inner_radius, b = parameters.outer_radius;
      const auto   n_r = static_cast<unsigned int>(
        std::max(1., std::round((b - a) / cell_size)));
      const auto n_t = static_cast<unsigned int>(
        std::max(1., std::round(numbers::PI_2 * 0.5 * (a + b) / cell_size)));

      std::vector<Point<2>>    vertices;
      std::vector<CellData<2>> cells;
      for (unsigned int j = 0; j <= n_t; ++j)
        for (unsigned int i = 0; i <= n_r; ++i)
        {
          const double r = a + (b - a) * i / n_r, t = numbers::PI_2 * j / n_t;
          vertices.emplace_back(j == n_t ? 0. : r * std::cos(t),
                                j == 0 ? 0. : r * std::sin(t));
        }
      const auto add = [&](const unsigned int v0,
                           const unsigned int v1,
                           const unsigned int v2) {
        CellData<2> cell(3);
        cell.vertices    = {v0, v1, v2};
        cell.manifold_id = 0;
        cells.push_back(cell);
      };
      for (unsigned int j = 0; j < n_t; ++j)
        for (unsigned int i = 0; i < n_r; ++i)
        {
          const unsigned int v = j * (n_r + 1) + i, up = v + n_r + 1;
          // diagonals alternate, so that no direction is preferred
          if ((i + j) % 2 == 0)
          {
            add(v, v + 1, up + 1);
            add(v, up + 1, up);
          }
          else
          {
            add(v, v + 1, up);
            add(v + 1, up + 1, up);
          }
        }
      triangulation.create_triangulation(vertices, cells, SubCellData());
      triangulation.set_all_manifold_ids(0);
      triangulation.set_manifold(0, PolarManifold<2>(Point<2>()));

      const double tolerance = 1e-8;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            const Point<2> v0 = face->vertex(0), v1 = face->vertex(1);
            if (std::abs(v0[1]) + std::abs(v1[1]) < tolerance)
              face->set_boundary_id(on_x_axis);
            else if (std::abs(v0[0]) + std::abs(v1[0]) < tolerance)
              face->set_boundary_id(on_y_axis);
            else
              face->set_boundary_id(v0.norm() < 0.5 * (a + b) ? inner : outer);
          }
    }


    void
    assemble(const DoFHandler<2>             &dof_handler,
             const Mapping<2>                &mapping,
             const Parameters                &parameters,
             const AffineConstraints<double> &constraints,
             TrilinosWrappers::SparseMatrix  &matrix,
             TrilinosWrappers::MPI::Vector   &rhs)
    {
      const SymmetricTensor<4, 2> C =
        parameters.material.elasticity_tensor(NMM::PlaneState::plane_stress);
      const FiniteElement<2>              &fe = dof_handler.get_fe();
      const QGaussSimplex<2>               quadrature(3);
      const QGaussSimplex<1>               face_quadrature(3);
      FEValues<2>                          fe_values(mapping,
                            fe,
                            quadrature,
                            update_gradients | update_JxW_values);
      FEFaceValues<2>                      face_values(mapping,
                                  fe,
                                  face_quadrature,
                                  update_values | update_JxW_values |
                                    update_normal_vectors);
      const FEValuesExtractors::Vector     displacement(0);
      const unsigned int                   n = fe.n_dofs_per_cell();
      FullMatrix<double>                   local(n, n);
      dealii::Vector<double>               local_rhs(n);
      std::vector<types::global_dof_index> dofs(n);
      std::vector<SymmetricTensor<2, 2>>   strain(n);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        local     = 0.;
        local_rhs = 0.;
        fe_values.reinit(cell);
        for (const unsigned int q : fe_values.quadrature_point_indices())
        {
          for (unsigned int i = 0; i < n; ++i)
            strain[i] = fe_values[displacement].symmetric_gradient(i, q);
          for (unsigned int i = 0; i < n; ++i)
          {
            const SymmetricTensor<2, 2> stress =
              C * strain[i] * fe_values.JxW(q);
            for (unsigned int j = 0; j < n; ++j)
              local(i, j) += stress * strain[j];
          }
        }
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == inner)
          {
            face_values.reinit(cell, f);
            for (const unsigned int q : face_values.quadrature_point_indices())
              for (unsigned int i = 0; i < n; ++i)
                local_rhs(i) -= parameters.pressure *
                                (face_values.normal_vector(q) *
                                 face_values[displacement].value(i, q)) *
                                face_values.JxW(q);
          }
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(
          local, local_rhs, dofs, matrix, rhs);
      }
      matrix.compress(VectorOperation::add);
      rhs.compress(VectorOperation::add);
    }


    void
    measure_errors(const DoFHandler<2>          &dof_handler,
                   const Mapping<2>             &mapping,
                   const Parameters             &parameters,
                   const dealii::Vector<double> &solution,
                   Run                          &result)
    {
      const NMM::ThickRing        exact(parameters.inner_radius,
                                 parameters.outer_radius,
                                 parameters.pressure,
                                 parameters.material,
                                 NMM::PlaneState::plane_stress);
      const SymmetricTensor<4, 2> C =
        parameters.material.elasticity_tensor(NMM::PlaneState::plane_stress);
      const QWitherdenVincentSimplex<2>  quadrature(4);
      FEValues<2>                        fe_values(mapping,
                            dof_handler.get_fe(),
                            quadrature,
                            update_values | update_gradients |
                              update_JxW_values | update_quadrature_points);
      const FEValuesExtractors::Vector   displacement(0);
      std::vector<Tensor<1, 2>>          u(quadrature.size());
      std::vector<SymmetricTensor<2, 2>> strain(quadrature.size());
      double u_error = 0., u_norm = 0., s_error = 0., s_norm = 0.;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        fe_values.reinit(cell);
        fe_values[displacement].get_function_values(solution, u);
        fe_values[displacement].get_function_symmetric_gradients(solution,
                                                                 strain);
        for (const unsigned int q : fe_values.quadrature_point_indices())
        {
          const Point<2>             &x      = fe_values.quadrature_point(q);
          const double                JxW    = fe_values.JxW(q);
          const SymmetricTensor<2, 2> stress = C * strain[q];
          const SymmetricTensor<2, 2> exact_stress = exact.stress(x);
          u_error += (u[q] - exact.displacement(x)).norm_square() * JxW;
          u_norm += exact.displacement(x).norm_square() * JxW;
          s_error += (stress - exact_stress).norm() *
                     (stress - exact_stress).norm() * JxW;
          s_norm += exact_stress.norm() * exact_stress.norm() * JxW;
          const Tensor<1, 2> e    = Tensor<1, 2>({-x[1], x[0]}) / x.norm();
          const double       hoop = exact.hoop_stress(x.norm());
          result.error_hoop =
            std::max(result.error_hoop,
                     std::abs(e * (stress * e) - hoop) / hoop);
        }
      }
      result.error_u      = std::sqrt(u_error / u_norm);
      result.error_stress = std::sqrt(s_error / s_norm);
    }
  } // namespace


  Run
  run_fitted_elements(const Parameters &parameters, const double cell_size)
  {
    Run result;
    result.method               = "fitted";
    result.cell_size            = cell_size;
    Tutorial::StageClock &clock = result.clock;

    Triangulation<2> triangulation;
    make_polar_mesh(triangulation, parameters, cell_size);
    clock.lap("mesh");

    const MappingFE<2> mapping(FE_SimplexP<2>(2));
    const FESystem<2>  fe(FE_SimplexP<2>(2), 2);
    DoFHandler<2>      dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    AffineConstraints<double> constraints;
    for (const auto &[boundary, component] :
         {std::make_pair(on_x_axis, 1u), std::make_pair(on_y_axis, 0u)})
    {
      ComponentMask mask(2, false);
      mask.set(component, true);
      const IndexSet dofs =
        DoFTools::extract_boundary_dofs(dof_handler, mask, {boundary});
      for (const auto dof : dofs)
        constraints.add_line(dof);
    }
    constraints.close();
    clock.lap("dofs");

    DynamicSparsityPattern sparsity(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, sparsity, constraints, false);
    const IndexSet all = complete_index_set(dof_handler.n_dofs());
    TrilinosWrappers::SparseMatrix matrix;
    matrix.reinit(all, all, sparsity, MPI_COMM_SELF);
    TrilinosWrappers::MPI::Vector rhs(all, MPI_COMM_SELF),
      solution(all, MPI_COMM_SELF);
    clock.lap("sparsity");
    assemble(dof_handler, mapping, parameters, constraints, matrix, rhs);
    clock.lap("assembly");

    SolverControl                  control;
    TrilinosWrappers::SolverDirect solver(
      control,
      TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Mumps"));
    solver.solve(matrix, solution, rhs);
    constraints.distribute(solution);
    clock.lap("solution");

    result.n_elements = triangulation.n_active_cells();
    result.n_unknowns = dof_handler.n_dofs();
    result.n_nonzeros = matrix.n_nonzero_elements();
    measure_errors(dof_handler,
                   mapping,
                   parameters,
                   dealii::Vector<double>(solution),
                   result);
    return result;
  }
} // namespace StepNMM1
