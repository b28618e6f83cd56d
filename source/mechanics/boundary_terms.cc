#include <cmath>
#include <mechanics/boundary_terms.h>

namespace NMM
{
  namespace internal
  {
    EdgeTerms::EdgeTerms(const CoverSystem       &covers,
                         const ElasticityProblem &problem,
                         const CurveConditions   &conditions,
                         TraceConstants          &trace_constants)
      : covers(&covers)
      , problem(&problem)
      , conditions(&conditions)
      , maker(covers, problem, trace_constants)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      for (const unsigned int m :
           problem.region_to_material(covers.manifold_mesh().physical_mesh()))
        region_to_initial_stress.push_back(problem.materials[m].initial_stress);
    }


    void
    EdgeTerms::add_weak_points(LocalSystem &system) const
    {
      for (const WeakPoint &point : points)
      {
        dealii::Tensor<1, 2> initial;
        for (unsigned int s = 0; s < point.n_sides; ++s)
          initial +=
            point.sides[s].share *
            (region_to_initial_stress[point.sides[s].region] * point.normal);
        // the right-hand side is the negative residual of zero displacements
        add_nitsche(point,
                    WeakTraction(point, n_per_cell, maker.elasticities()),
                    -point.prescribed,
                    initial,
                    point.weight,
                    -1.,
                    system);
      }
    }


    void
    EdgeTerms::add_conditions(const unsigned int element, LocalSystem &system)
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      const unsigned int  cell = mesh.cell(element);
      for (const ElementEdge &edge : mesh.edges(element))
      {
        const std::vector<unsigned int> &on_edge =
          conditions->conditions(element, edge);
        if (on_edge.empty())
          continue;
        const EdgeRule rule =
          make_edge_rule(edge, cell_frame(mesh, element), 2 * degree);
        for (const unsigned int c : on_edge)
        {
          const BoundaryCondition &condition = problem->boundary_conditions[c];
          switch (condition.type)
          {
            case BoundaryCondition::Type::traction:
            case BoundaryCondition::Type::pressure:
            case BoundaryCondition::Type::follower_pressure:
              add_load(condition, cell, rule, system);
              break;
            case BoundaryCondition::Type::displacement:
            case BoundaryCondition::Type::normal_displacement:
              points.clear();
              maker.append_condition(c, element, rule, points);
              add_weak_points(system);
              break;
          }
        }
      }
    }


    void
    EdgeTerms::add_load(const BoundaryCondition &condition,
                        const unsigned int       cell,
                        const EdgeRule          &rule,
                        LocalSystem             &system) const
    {
      if (condition.value == nullptr)
        return;
      const MathematicalMesh &mesh =
        covers->manifold_mesh().mathematical_mesh();

      double w[WeightFunctions::max_per_cell];
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const dealii::Point<2> x = mesh.reference_to_real(cell, rule.points[q]);
        dealii::Tensor<1, 2>   t;
        if (condition.type != BoundaryCondition::Type::traction)
          t = -condition.value->value(x) * rule.normals[q];
        else
          for (unsigned int c = 0; c < 2; ++c)
            t[c] = condition.value->value(x, c);

        WeightFunctions::values(degree, rule.points[q], w);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            system.rhs[2 * i + c] += rule.weights[q] * w[i] * t[c];
      }
    }


    void
    EdgeTerms::add_tie(const unsigned int element,
                       const ElementEdge &edge,
                       LocalSystem       &system)
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      points.clear();
      maker.append_tie(element,
                       edge,
                       make_edge_rule(edge,
                                      cell_frame(mesh, element),
                                      2 * degree),
                       points);
      add_weak_points(system);
    }


    bool
    EdgeTerms::compute_disk_edge(const unsigned int element,
                                 const ElementEdge &edge,
                                 const DiskCover   &disk,
                                 DiskEdge          &result)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      elements[2]       = {element, edge.neighbor};
      const auto              is_inside         = [&](const unsigned int side) {
        return disk.contains(
          mesh.physical_mesh().regions()[mesh.region(elements[side])].inside);
      };
      if (is_inside(0) == is_inside(1))
        return false;
      const unsigned int     inside  = is_inside(0) ? 0 : 1;
      const double           outward = inside == 0 ? 1. : -1.;
      const PlaneElasticity &elasticity =
        maker.elasticities()[mesh.region(element)];

      const unsigned int n = disk.n_functions();
      result.couplings.assign(n, dealii::Vector<double>(4 * n_per_cell));
      result.works          = result.couplings;
      result.unit_tractions = {{dealii::Vector<double>(4 * n_per_cell),
                                dealii::Vector<double>(4 * n_per_cell)}};
      result.matrix.reinit(n, n);
      result.work_matrix.reinit(n, n);

      // The functions are no polynomials.
      const unsigned int further_degree = 4;
      const EdgeRule     rule           = make_edge_rule(edge,
                                           cell_frame(mesh, element),
                                           2 * degree + further_degree);
      points.clear();
      maker.append_tie(element, edge, rule, points);
      DiskPoint functions;
      functions.displacements.resize(n);
      functions.tractions.resize(n);
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        const dealii::Point<2> x =
          mathematical_mesh.reference_to_real(mesh.cell(element),
                                              rule.points[q]);
        for (unsigned int j = 0; j < n; ++j)
        {
          const DiskCover::Value value =
            disk.evaluate(j, x, dealii::Tensor<1, 2>());
          functions.displacements[j] = value.displacement;
          functions.tractions[j] =
            outward * (elasticity.stress(dealii::symmetrize(value.gradient)) *
                       rule.normals[q]);
        }
        add_disk_point(points[q], functions, inside, result);
      }
      return !points.empty();
    }


    void
    EdgeTerms::add_disk_point(const WeakPoint   &point,
                              const DiskPoint   &functions,
                              const unsigned int inside,
                              DiskEdge          &result) const
    {
      const double       w_1 = point.sides[inside].share, w_2 = 1. - w_1;
      const WeakTraction traction =
        WeakTraction(point, n_per_cell, maker.elasticities());
      // jump and flux are those of the element minus its neighbour, and with its normal
      const double sign = inside == 0 ? 1. : -1.;
      const auto   mean = [&](const unsigned int k) {
        const double jump = sign * point.jump[k];
        return k / n_per_cell == inside ? w_2 * jump : -w_1 * jump;
      };
      for (unsigned int k = 0; k < 2 * n_per_cell; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          result.unit_tractions[c](2 * k + c) += point.weight * mean(k);
      for (unsigned int j = 0; j < functions.displacements.size(); ++j)
      {
        const dealii::Tensor<1, 2> &F = functions.displacements[j],
                                   &t = functions.tractions[j];
        for (unsigned int k = 0; k < 2 * n_per_cell; ++k)
        {
          const bool   is_inner = k / n_per_cell == inside;
          const double jump     = sign * point.jump[k];
          for (unsigned int c = 0; c < 2; ++c)
          {
            const double flux = sign * (traction.derivative[k][0][c] * F[0] +
                                        traction.derivative[k][1][c] * F[1]);
            result.couplings[j](2 * k + c) +=
              point.weight *
              (mean(k) * t[c] - flux + point.penalty * jump * F[c]);
            if (is_inner)
              result.works[j](2 * k + c) += point.weight * jump * t[c];
          }
        }
        for (unsigned int k = 0; k < functions.displacements.size(); ++k)
        {
          // both orders of j and k have the same integral on the whole circle
          const double work =
            0.5 * (t * functions.displacements[k] + functions.tractions[k] * F);
          result.work_matrix(j, k) += point.weight * work;
          result.matrix(j, k) +=
            point.weight * ((1. - 2. * w_1) * work +
                            point.penalty * (F * functions.displacements[k]));
        }
      }
    }
  } // namespace internal
} // namespace NMM
