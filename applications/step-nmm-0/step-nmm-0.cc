// step-nmm-0: a plate with a hole, with the weak form in sight.
//
// Who knows deal.II's step-8 finds the same program here: linear elasticity, assembled by
// hand with FEValues. Two things differ: the triangles know nothing of the hole, so that the
// loop runs over what the curves of the plate leave of them; and no node lies on a side, so
// that displacements are prescribed in the weak form.

// @sect3{Include files}

#include <nmm/covers/aggregation.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/convergence_table.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include "tutorial/tutorial.h"
#include <cmath>
#include <iostream>

namespace StepNMM0
{
  using namespace dealii;

  // @sect3{The exact solution}

  // Kirsch's: an infinite plate in plane stress with a round hole of radius $a$, pulled in
  // direction $x$ by $\sigma_\infty = 1$. On the sides of our finite plate we prescribe what
  // it has there, so that the error is that of the method alone.
  constexpr double hole_radius = 0.5, youngs_modulus = 1000.,
                   poissons_ratio = 0.3;
  constexpr double mu     = youngs_modulus / (2. * (1. + poissons_ratio));
  constexpr double lambda = 2. * mu * poissons_ratio / (1. - poissons_ratio);

  Tensor<1, 2>
  exact_displacement(const Point<2> &x)
  {
    const double r = x.norm(), theta = std::atan2(x[1], x[0]),
                 q     = hole_radius / r;
    const double kappa = (3. - poissons_ratio) / (1. + poissons_ratio);
    return r / (8. * mu) *
           Tensor<1, 2>(
             {(kappa + 1.) * std::cos(theta) +
                2. * q * q *
                  ((1. + kappa) * std::cos(theta) + std::cos(3. * theta)) -
                2. * std::pow(q, 4) * std::cos(3. * theta),
              (kappa - 3.) * std::sin(theta) +
                2. * q * q *
                  ((1. - kappa) * std::sin(theta) + std::sin(3. * theta)) -
                2. * std::pow(q, 4) * std::sin(3. * theta)});
  }

  SymmetricTensor<2, 2>
  exact_stress(const Point<2> &x)
  {
    const double theta = std::atan2(x[1], x[0]);
    const double q2    = hole_radius * hole_radius / x.norm_square(),
                 q4    = 1.5 * q2 * q2;
    SymmetricTensor<2, 2> stress;
    stress[0][0] = 1. -
                   q2 * (1.5 * std::cos(2. * theta) + std::cos(4. * theta)) +
                   q4 * std::cos(4. * theta);
    stress[1][1] = -q2 * (0.5 * std::cos(2. * theta) - std::cos(4. * theta)) -
                   q4 * std::cos(4. * theta);
    stress[0][1] = -q2 * (0.5 * std::sin(2. * theta) + std::sin(4. * theta)) +
                   q4 * std::sin(4. * theta);
    return stress;
  }

  // Hooke's law. In plane stress $\lambda$ is $2\mu\nu/(1-\nu)$, see above.
  SymmetricTensor<2, 2>
  stress_of(const SymmetricTensor<2, 2> &strain)
  {
    return 2. * mu * strain +
           lambda * trace(strain) * unit_symmetric_tensor<2>();
  }


  // @sect3{The weak form}

  // What an element contributes, as in step-8.
  void
  add_volume_terms(const FEValues<2>  &fe_values,
                   FullMatrix<double> &cell_matrix)
  {
    const FEValuesExtractors::Vector displacement(0);
    for (const unsigned int q : fe_values.quadrature_point_indices())
      for (const unsigned int i : fe_values.dof_indices())
        for (const unsigned int j : fe_values.dof_indices())
          cell_matrix(i, j) +=
            stress_of(fe_values[displacement].symmetric_gradient(i, q)) *
            fe_values[displacement].symmetric_gradient(j, q) * fe_values.JxW(q);
  }


  // What a side with the outward normals $n$ contributes. On the left the displacement $g$ is given.
  // As no node lies there, it is imposed by Nitsche's symmetric method,
  // @f[ \int \beta\,u\cdot v - (\sigma(u)n)\cdot v - u\cdot(\sigma(v)n)
  //     = \int (\beta v - \sigma(v)n)\cdot g, @f]
  // where $\beta$ is some times the stiffness over the size of a triangle. On other sides the
  // traction is given.
  void
  add_side_terms(const FEValues<2>   &fe_values,
                 const NMM::EdgeRule &rule,
                 const bool           is_left,
                 FullMatrix<double>  &cell_matrix,
                 Vector<double>      &cell_rhs)
  {
    const FEValuesExtractors::Vector displacement(0);
    const auto traction_of = [&](const unsigned int i, const unsigned int q) {
      return stress_of(fe_values[displacement].symmetric_gradient(i, q)) *
             rule.normals[q];
    };
    const double beta =
      20. * (lambda + 2. * mu) / fe_values.get_cell()->diameter();

    for (const unsigned int q : fe_values.quadrature_point_indices())
      for (const unsigned int i : fe_values.dof_indices())
      {
        const Point<2>    &x = fe_values.quadrature_point(q);
        const Tensor<1, 2> v = fe_values[displacement].value(i, q);
        if (!is_left)
        {
          cell_rhs(i) +=
            exact_stress(x) * rule.normals[q] * v * rule.weights[q];
          continue;
        }
        for (const unsigned int j : fe_values.dof_indices())
        {
          const Tensor<1, 2> u = fe_values[displacement].value(j, q);
          cell_matrix(i, j) +=
            (beta * u * v - traction_of(j, q) * v - u * traction_of(i, q)) *
            rule.weights[q];
        }
        cell_rhs(i) += (beta * v - traction_of(i, q)) * exact_displacement(x) *
                       rule.weights[q];
      }
  }


  // @sect3{From curves to a picture}

  void
  run(const double       cell_size,
      const std::string &picture,
      ConvergenceTable  &table)
  {
    // The curves of the plate, 4 m wide; regular triangles that cover it and know nothing of
    // the hole; the manifold elements, which are the triangles cut by the curves; and the
    // physical covers, which carry the unknowns. Each of these objects refers to the one before it.
    const NMM::PhysicalMesh    plate(NMM::parse_geometry(R"(
      boundary name=left  material=steel LINESTRING (-2 2, -2 -2)
      boundary name=other LINESTRING (-2 -2, 2 -2, 2 2, -2 2)
      hole     name=bore  CIRCLE (0 0, 0.5))",
                                                      "the plate"));
    NMM::RegularMeshParameters mesh_parameters;
    mesh_parameters.cell_size = cell_size;
    const NMM::MathematicalMesh triangles =
      NMM::make_regular_mesh(plate, mesh_parameters, /* degree = */ 2);
    const NMM::ManifoldMesh elements(triangles, plate);
    NMM::CoverSystem        covers(elements, MPI_COMM_SELF);

    // A cover of which the cut leaves next to nothing is expressed through its neighbours: a
    // constraint like that of a hanging node.
    const NMM::Aggregation          aggregation = NMM::aggregate(covers);
    const AffineConstraints<double> constraints =
      NMM::make_constraints(covers, aggregation, 2);

    // The finite element is deal.II's: its shape functions are the weight functions of the
    // manifold method. A cut element has a quadrature rule of its own.
    const FESystem<2>               fe(triangles.fe(), 2);
    const NMM::QuadratureCollection quadrature(elements,
                                               4,
                                               4,
                                               covers.locally_owned_elements());

    // The unknowns of an element are those of its physical covers, and not of its cell:
    // a cell that a crack cuts in two elements has two sets of them.
    const unsigned int                   n_unknowns = 2 * covers.n_covers();
    std::vector<types::global_dof_index> dof_indices;
    DynamicSparsityPattern               dynamic_pattern(n_unknowns);
    for (unsigned int element = 0; element < elements.n_elements(); ++element)
    {
      covers.get_dof_indices(element, 2, dof_indices);
      constraints.add_entries_local_to_global(dof_indices, dynamic_pattern);
    }
    SparsityPattern pattern;
    pattern.copy_from(dynamic_pattern);
    SparseMatrix<double> matrix(pattern);
    Vector<double>       right_hand_side(n_unknowns), solution(n_unknowns);

    // The loop over the elements. FEValues is made anew for each, with its rule, and works on the
    // whole cell as ever. Sides of the plate are edges of an element that lie on a curve; the hole
    // is free of traction, and adds nothing.
    FullMatrix<double> cell_matrix(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
    Vector<double>     cell_rhs(fe.n_dofs_per_cell());
    for (unsigned int element = 0; element < elements.n_elements(); ++element)
    {
      cell_matrix     = 0.;
      cell_rhs        = 0.;
      const auto cell = triangles.cell_iterator(elements.cell(element));
      // an element whose area rounds to zero has no points
      const Quadrature<2> element_rule = quadrature.rule(element);
      if (element_rule.size() > 0)
      {
        FEValues<2> fe_values(triangles.mapping(),
                              fe,
                              element_rule,
                              update_gradients | update_JxW_values);
        fe_values.reinit(cell);
        add_volume_terms(fe_values, cell_matrix);
      }

      for (const NMM::ElementEdge &edge : elements.edges(element))
      {
        if (edge.curve_set == NMM::invalid_index)
          continue;
        const unsigned int piece = elements.curve_set(edge.curve_set)[0];
        const std::string &name =
          plate.curves()[plate.piece_to_curve()[piece]].name;
        if (name != "left" && name != "other")
          continue;
        const NMM::EdgeRule rule =
          NMM::make_edge_rule(edge,
                              NMM::cell_frame(elements, element),
                              /* degree = */ 6);
        if (rule.points.empty())
          continue;
        FEValues<2> side_values(triangles.mapping(),
                                fe,
                                Quadrature<2>(rule.points),
                                update_values | update_gradients |
                                  update_quadrature_points);
        side_values.reinit(cell);
        add_side_terms(
          side_values, rule, name == "left", cell_matrix, cell_rhs);
      }
      covers.get_dof_indices(element, 2, dof_indices);
      constraints.distribute_local_to_global(
        cell_matrix, cell_rhs, dof_indices, matrix, right_hand_side);
    }

    SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    solver.vmult(solution, right_hand_side);
    constraints.distribute(solution);

    // From here on the library's tools do the work: a field that can be evaluated in each element,
    // its errors, recovered stresses, a picture.
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_stress;
    problem.materials   = {{"steel", youngs_modulus, poissons_ratio}};
    std::vector<Tensor<1, 2>> values(covers.n_covers());
    for (unsigned int cover = 0; cover < covers.n_covers(); ++cover)
      values[cover] = Tensor<1, 2>({solution[NMM::unknown_of(cover, 0)],
                                    solution[NMM::unknown_of(cover, 1)]});
    const NMM::DisplacementField field(covers, problem, std::move(values));

    const NMM::ErrorNorms errors =
      NMM::compute_errors(field, exact_displacement, exact_stress);
    table.add_value("cell size", cell_size);
    table.add_value("elements", elements.n_elements());
    table.add_value("unknowns",
                    n_unknowns - 2 * aggregation.cover_to_root.size());
    table.add_value("error of u", errors.displacement);
    table.add_value("error of stress", errors.stress);
    if (!picture.empty())
    {
      const NMM::StressRecovery recovery(field, aggregation);
      const NMM::FieldEvaluator evaluator(field, recovery, problem);
      const NMM::FieldTriangles samples(covers, &evaluator);
      NMM::PictureParameters    parameters;
      parameters.quantity = NMM::Quantity::stress_xx;
      NMM::draw_picture(
        NMM::make_picture_data(covers, samples, &evaluator, parameters),
        parameters,
        "A plate with a hole, pulled in direction x",
        picture);
    }
  }
} // namespace StepNMM0


// @sect3{The main function}

// Four meshes, each with triangles of half the size.
int
main(int argc, char **argv)
{
  return Tutorial::run(
    argc, argv, [](const std::string &, const std::string &output_directory) {
      dealii::ConvergenceTable table;
      for (const double cell_size : {0.4, 0.2, 0.1, 0.05})
        StepNMM0::run(cell_size,
                      cell_size == 0.2 ? output_directory + "/step-nmm-0.png"
                                       : "",
                      table);

      for (const std::string column : {"error of u", "error of stress"})
      {
        table.set_scientific(column, true);
        table.evaluate_convergence_rates(
          column, dealii::ConvergenceTable::reduction_rate_log2);
      }
      table.write_text(std::cout);
    });
}
