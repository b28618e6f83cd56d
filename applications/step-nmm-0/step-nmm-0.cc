// step-nmm-0: a plate with a hole, with the weak form in sight.
//
// Who knows deal.II's step-8 finds the same program here: linear elasticity, assembled by
// hand. Two things differ: the triangles know nothing of the hole, so that the loop runs over
// what the curves of the plate leave of them, with ElementValues for FEValues; and no node lies
// on a side, so that displacements are prescribed in the weak form.

// @sect3{Include files}

#include <nmm/covers/aggregation.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output.h>
#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>

#include <deal.II/base/convergence_table.h>
#include <deal.II/fe/fe_system.h>
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
  add_volume_terms(const NMM::ElementValues &values,
                   FullMatrix<double>       &element_matrix)
  {
    const FEValuesExtractors::Vector displacement(0);
    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int i : values.dof_indices())
        for (const unsigned int j : values.dof_indices())
          element_matrix(i, j) +=
            stress_of(values[displacement].symmetric_gradient(i, q)) *
            values[displacement].symmetric_gradient(j, q) * values.JxW(q);
  }


  // What an edge of an element on a side with the outward normals $n$ contributes. On the left the
  // displacement $g$ is given. As no node lies there, it is imposed by Nitsche's symmetric method,
  // @f[ \int \beta\,u\cdot v - (\sigma(u)n)\cdot v - u\cdot(\sigma(v)n)
  //     = \int (\beta v - \sigma(v)n)\cdot g, @f]
  // where $\beta$ is some times the stiffness over the size of a triangle. On other sides the
  // traction is given.
  void
  add_side_terms(const NMM::EdgeValues &values,
                 const double           cell_diameter,
                 const bool             is_left,
                 FullMatrix<double>    &element_matrix,
                 Vector<double>        &element_rhs)
  {
    const FEValuesExtractors::Vector displacement(0);
    const auto traction_of = [&](const unsigned int i, const unsigned int q) {
      return stress_of(values[displacement].symmetric_gradient(i, q)) *
             values.normal(q);
    };
    const double beta = 20. * (lambda + 2. * mu) / cell_diameter;

    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int i : values.dof_indices())
      {
        const Point<2>    &x = values.quadrature_point(q);
        const Tensor<1, 2> v = values[displacement].value(i, q);
        if (!is_left)
        {
          element_rhs(i) +=
            exact_stress(x) * values.normal(q) * v * values.JxW(q);
          continue;
        }
        for (const unsigned int j : values.dof_indices())
        {
          const Tensor<1, 2> u = values[displacement].value(j, q);
          element_matrix(i, j) +=
            (beta * u * v - traction_of(j, q) * v - u * traction_of(i, q)) *
            values.JxW(q);
        }
        element_rhs(i) += (beta * v - traction_of(i, q)) *
                          exact_displacement(x) * values.JxW(q);
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
    const unsigned int n_unknowns = 2 * covers.n_covers();
    SparsityPattern    pattern;
    pattern.copy_from(NMM::make_sparsity_pattern(covers, 2, constraints));
    SparseMatrix<double> matrix(pattern);
    Vector<double>       right_hand_side(n_unknowns), solution(n_unknowns);

    // The loop over the elements. ElementValues stands for FEValues, and has the words of it.
    FullMatrix<double> element_matrix(fe.n_dofs_per_cell());
    Vector<double>     element_rhs(fe.n_dofs_per_cell());
    NMM::ElementValues values(covers,
                              quadrature,
                              fe,
                              update_gradients | update_JxW_values);
    for (unsigned int element = 0; element < elements.n_elements(); ++element)
    {
      values.reinit(element);
      element_matrix = 0.;
      add_volume_terms(values, element_matrix);
      constraints.distribute_local_to_global(element_matrix,
                                             values.get_dof_indices(),
                                             matrix);
    }

    // Sides of the plate are edges of elements that lie on a curve of that name; the hole is free
    // of traction, and adds nothing.
    NMM::EdgeValues side_values(covers,
                                /* degree = */ 6,
                                fe,
                                update_values | update_gradients |
                                  update_quadrature_points | update_JxW_values |
                                  update_normal_vectors);
    for (const std::string name : {"left", "other"})
      for (const NMM::EdgePiece &piece : NMM::boundary_pieces(covers, name))
      {
        side_values.reinit(piece);
        element_matrix = 0.;
        element_rhs    = 0.;
        add_side_terms(side_values,
                       triangles.cell_diameter(elements.cell(piece.element)),
                       name == "left",
                       element_matrix,
                       element_rhs);
        constraints.distribute_local_to_global(element_matrix,
                                               element_rhs,
                                               side_values.get_dof_indices(),
                                               matrix,
                                               right_hand_side);
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
    std::vector<Tensor<1, 2>> displacements(covers.n_covers());
    for (unsigned int cover = 0; cover < covers.n_covers(); ++cover)
      displacements[cover] =
        Tensor<1, 2>({solution[NMM::unknown_of(cover, 0)],
                      solution[NMM::unknown_of(cover, 1)]});
    const NMM::DisplacementField field(covers,
                                       problem,
                                       std::move(displacements));

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
