#include "incremental_elasticity.h"

#include <nmm/base/exceptions.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>

#include <cmath>

namespace StepNMM2
{
  using namespace dealii;
  using Type = NMM::BoundaryCondition::Type;

  IncrementalElasticity::IncrementalElasticity(
    const NMM::CoverSystem          &covers,
    const NMM::QuadratureCollection &quadrature,
    const AffineConstraints<double> &constraints,
    const NMM::ElasticityProblem    &problem)
    : covers(&covers)
    , constraints(&constraints)
    , problem(&problem)
    , degree(covers.manifold_mesh().mathematical_mesh().degree())
    , n_per_cell(NMM::WeightFunctions::n_per_cell(degree))
    , elasticity(problem.materials[0].plane_elasticity(problem.plane_state))
    , element_to_points(covers.manifold_mesh().n_elements())
    , u(covers.n_covers())
    , rhs(2 * covers.n_covers())
    , solution(2 * covers.n_covers())
    , cell_matrix(2 * n_per_cell, 2 * n_per_cell)
    , cell_rhs(2 * n_per_cell)
  {
    const NMM::ManifoldMesh             &mesh  = covers.manifold_mesh();
    const NMM::PhysicalMesh             &solid = mesh.physical_mesh();
    std::vector<types::global_dof_index> dof_indices;
    DynamicSparsityPattern               dynamic_pattern(rhs.size());
    for (unsigned int element = 0; element < mesh.n_elements(); ++element)
    {
      const NMM::ElementRule rule = quadrature.rule(element);
      NMM::EdgeRule          inside{rule.get_points(), {}, rule.get_weights()};
      for (double &weight : inside.weights)
        weight *= 2. * mesh.mathematical_mesh().cell_area(mesh.cell(element));
      add_points(element, inside, nullptr);
      for (const NMM::ElementEdge &edge : mesh.edges(element))
      {
        if (edge.curve_set == NMM::invalid_index)
          continue;
        const unsigned int piece = mesh.curve_set(edge.curve_set)[0];
        const std::string &name =
          solid.curves()[solid.piece_to_curve()[piece]].name;
        for (const NMM::BoundaryCondition &condition :
             problem.boundary_conditions)
          if (condition.curve == name)
            add_points(element,
                       NMM::make_edge_rule(edge,
                                           NMM::cell_frame(mesh, element),
                                           2 * degree),
                       &condition);
      }
      covers.get_dof_indices(element, 2, dof_indices);
      constraints.add_entries_local_to_global(dof_indices, dynamic_pattern);
    }
    pattern.copy_from(dynamic_pattern);
    matrix.reinit(pattern);
  }


  void
  IncrementalElasticity::add_points(const unsigned int            element,
                                    const NMM::EdgeRule          &rule,
                                    const NMM::BoundaryCondition *condition)
  {
    const NMM::ManifoldMesh     &mesh  = covers->manifold_mesh();
    const NMM::MathematicalMesh &cells = mesh.mathematical_mesh();
    const unsigned int           cell  = mesh.cell(element);
    const Tensor<2, 2> to_real = transpose(invert(cells.jacobian(cell)));
    for (unsigned int q = 0; q < rule.points.size(); ++q)
    {
      QuadraturePoint point;
      point.weight    = rule.weights[q];
      point.stress    = problem->materials[0].initial_stress;
      point.condition = condition;
      double g[max_per_cell][2];
      NMM::WeightFunctions::gradients(degree, rule.points[q], g);
      for (unsigned int i = 0; i < n_per_cell; ++i)
        point.gradients[i] = to_real * Tensor<1, 2>({g[i][0], g[i][1]});
      if (condition != nullptr)
      {
        AssertThrow(condition->type == Type::traction ||
                      condition->type == Type::follower_pressure ||
                      (condition->type == Type::displacement &&
                       condition->components[0] && condition->components[1]),
                    NMM::InputError("increments do not know this condition",
                                    "the curve '" + condition->curve + "'",
                                    "use traction, follower pressure or "
                                    "displacement"));
        NMM::WeightFunctions::values(degree,
                                     rule.points[q],
                                     point.weight_functions.data());
        point.normal  = rule.normals[q];
        point.penalty = 20. * (elasticity.lambda + 2. * elasticity.mu) /
                        cells.cell_diameter(cell);
        if (condition->value != nullptr)
          for (unsigned int c = 0; c < condition->value->n_components; ++c)
            point.value[c] = condition->value->value(
              cells.reference_to_real(cell, rule.points[q]), c);
      }
      element_to_points[element].push_back(point);
    }
  }


  Tensor<2, 2>
  IncrementalElasticity::gradient(const unsigned int               element,
                                  const std::vector<Tensor<1, 2>> &values,
                                  const Gradients &gradients) const
  {
    Tensor<2, 2> result;
    for (unsigned int i = 0; i < n_per_cell; ++i)
      result += outer_product(values[covers->covers(element)[i]], gradients[i]);
    return result;
  }


  IncrementalElasticity::CurrentPoint
  IncrementalElasticity::locate(const unsigned int     element,
                                const QuadraturePoint &point) const
  {
    Tensor<2, 2> F = gradient(element, u, point.gradients);
    F[0][0] += 1.;
    F[1][1] += 1.;
    CurrentPoint current;
    current.growth = determinant(F);
    AssertThrow(current.growth > 0.,
                NMM::NumericalFailure("An element is turned inside out",
                                      "element " + std::to_string(element),
                                      "take smaller steps"));
    const Tensor<2, 2> to_current = transpose(invert(F));
    for (unsigned int i = 0; i < n_per_cell; ++i)
      current.gradients[i] = to_current * point.gradients[i];
    if (point.condition != nullptr)
      current.normal = current.growth * (to_current * point.normal);
    return current;
  }


  void
  IncrementalElasticity::add_terms(const unsigned int     element,
                                   const QuadraturePoint &point,
                                   const double           load_factor)
  {
    const CurrentPoint current = locate(element, point);
    if (point.condition != nullptr)
    {
      if (point.condition->type == Type::displacement)
        return add_nitsche(element, point, current, load_factor);
      // a traction is one per length of the reference configuration
      const Tensor<1, 2> traction = point.condition->type == Type::traction
                                      ? point.value
                                      : -point.value[0] * current.normal;
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          cell_rhs(NMM::unknown_of(i, c)) += load_factor * point.weight *
                                             point.weight_functions[i] *
                                             traction[c];
      return;
    }

    const Gradients &g      = current.gradients;
    const double     weight = point.weight * current.growth;
    for (unsigned int i = 0; i < n_per_cell; ++i)
    {
      const Tensor<1, 2> force = point.stress * g[i];
      for (unsigned int c = 0; c < 2; ++c)
        cell_rhs(NMM::unknown_of(i, c)) -= weight * force[c];
      for (unsigned int j = 0; j < n_per_cell; ++j)
      {
        const double shear = elasticity.mu * (g[i] * g[j]);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            cell_matrix(NMM::unknown_of(i, c), NMM::unknown_of(j, d)) +=
              weight *
              (elasticity.lambda * g[i][c] * g[j][d] +
               elasticity.mu * g[i][d] * g[j][c] + (c == d ? shear : 0.));
      }
    }
  }


  void
  IncrementalElasticity::add_nitsche(const unsigned int     element,
                                     const QuadraturePoint &point,
                                     const CurrentPoint    &current,
                                     const double           load_factor)
  {
    const double       length = current.normal.norm();
    const Tensor<1, 2> n      = current.normal / length;
    const double       weight = point.weight * length;
    const auto        &N      = point.weight_functions;

    // the traction of an increment of component d of cover j
    Tensor<1, 2> traction[max_per_cell][2];
    Tensor<1, 2> gap = -load_factor * point.value;
    for (unsigned int j = 0; j < n_per_cell; ++j)
    {
      gap += N[j] * u[covers->covers(element)[j]];
      for (unsigned int d = 0; d < 2; ++d)
      {
        Tensor<2, 2> h;
        h[d]           = current.gradients[j];
        traction[j][d] = elasticity.stress(h) * n;
      }
    }
    const Tensor<1, 2> force = point.penalty * gap - point.stress * n;
    for (unsigned int i = 0; i < n_per_cell; ++i)
      for (unsigned int c = 0; c < 2; ++c)
      {
        cell_rhs(NMM::unknown_of(i, c)) -=
          weight * (N[i] * force[c] - traction[i][c] * gap);
        for (unsigned int j = 0; j < n_per_cell; ++j)
          for (unsigned int d = 0; d < 2; ++d)
            cell_matrix(NMM::unknown_of(i, c), NMM::unknown_of(j, d)) +=
              weight * ((c == d ? point.penalty * N[i] * N[j] : 0.) -
                        N[i] * traction[j][d][c] - traction[i][c][d] * N[j]);
      }
  }


  void
  IncrementalElasticity::step(const double load_factor)
  {
    matrix = 0.;
    rhs    = 0.;
    std::vector<types::global_dof_index> dof_indices;
    for (unsigned int element = 0; element < element_to_points.size();
         ++element)
    {
      cell_matrix = 0.;
      cell_rhs    = 0.;
      for (const QuadraturePoint &point : element_to_points[element])
        add_terms(element, point, load_factor);
      covers->get_dof_indices(element, 2, dof_indices);
      constraints->distribute_local_to_global(
        cell_matrix, cell_rhs, dof_indices, matrix, rhs);
    }
    SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    solver.vmult(solution, rhs);
    constraints->distribute(solution);

    std::vector<Tensor<1, 2>> increment(u.size());
    for (unsigned int k = 0; k < u.size(); ++k)
      increment[k] = Tensor<1, 2>(
        {solution(NMM::unknown_of(k, 0)), solution(NMM::unknown_of(k, 1))});
    for (unsigned int element = 0; element < element_to_points.size();
         ++element)
      for (QuadraturePoint &point : element_to_points[element])
      {
        const Tensor<2, 2> h =
          gradient(element, increment, locate(element, point).gradients);
        const double angle =
          std::atan2(h[1][0] - h[0][1], 2. + h[0][0] + h[1][1]);
        const Tensor<2, 2> R({{std::cos(angle), -std::sin(angle)},
                              {std::sin(angle), std::cos(angle)}});
        point.stress = symmetrize(
          R * Tensor<2, 2>(point.stress + elasticity.stress(h)) * transpose(R));
      }
    for (unsigned int k = 0; k < u.size(); ++k)
      u[k] += increment[k];
  }


  const std::vector<Tensor<1, 2>> &
  IncrementalElasticity::displacements() const
  {
    return u;
  }


  std::vector<SymmetricTensor<2, 2>>
  IncrementalElasticity::stresses() const
  {
    std::vector<SymmetricTensor<2, 2>> result;
    for (const auto &points : element_to_points)
      for (const QuadraturePoint &point : points)
        if (point.condition == nullptr)
          result.push_back(point.stress);
    return result;
  }
} // namespace StepNMM2
