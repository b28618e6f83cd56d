#include <algorithm>
#include <cmath>
#include <mechanics/weak_points.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Compute B and B g of a displacement condition at a point with the outward normal @p n.
      void
      evaluate_condition(const BoundaryCondition       &condition,
                         const dealii::Point<2>        &x,
                         const dealii::Tensor<1, 2>    &n,
                         dealii::SymmetricTensor<2, 2> &projection,
                         dealii::Tensor<1, 2>          &prescribed)
      {
        projection = 0.;
        prescribed = 0.;
        if (condition.type == BoundaryCondition::Type::normal_displacement)
        {
          projection[0][0] = n[0] * n[0];
          projection[0][1] = n[0] * n[1];
          projection[1][1] = n[1] * n[1];
          if (condition.value != nullptr)
            prescribed = condition.value->value(x) * n;
          return;
        }
        for (unsigned int c = 0; c < 2; ++c)
          if (condition.components[c])
          {
            projection[c][c] = 1.;
            if (condition.value != nullptr)
              prescribed[c] = condition.value->value(x, c);
          }
      }
    } // namespace


    WeakPointMaker::WeakPointMaker(const CoverSystem       &covers,
                                   const ElasticityProblem &problem,
                                   TraceConstants          &trace_constants)
      : covers(&covers)
      , problem(&problem)
      , trace_constants(&trace_constants)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      for (const unsigned int m :
           problem.region_to_material(covers.manifold_mesh().physical_mesh()))
        region_to_elasticity.push_back(
          problem.materials[m].plane_elasticity(problem.plane_state));
    }


    double
    WeakPointMaker::bound(const unsigned int element) const
    {
      return region_to_elasticity[covers->manifold_mesh().region(element)]
               .largest_eigenvalue() *
             (*trace_constants)(element);
    }


    void
    WeakPointMaker::set_side(WeakPoint              &point,
                             const unsigned int      side,
                             const unsigned int      element,
                             const dealii::Point<2> &xi,
                             const double            share) const
    {
      const ManifoldMesh        &mesh = covers->manifold_mesh();
      const dealii::Tensor<2, 2> T    = dealii::transpose(
        dealii::invert(mesh.mathematical_mesh().jacobian(mesh.cell(element))));
      double w[WeightFunctions::max_per_cell];
      double g[WeightFunctions::max_per_cell][2];
      WeightFunctions::values(degree, xi, w);
      WeightFunctions::gradients(degree, xi, g);
      WeakPoint::Side &s = point.sides[side];
      s.region           = mesh.region(element);
      s.share            = share;
      for (unsigned int i = 0; i < n_per_cell; ++i)
      {
        for (unsigned int d = 0; d < 2; ++d)
          s.gradients[i][d] = T[d][0] * g[i][0] + T[d][1] * g[i][1];
        point.jump[side * n_per_cell + i] = side == 0 ? w[i] : -w[i];
      }
    }


    void
    WeakPointMaker::append_condition(const unsigned int      condition,
                                     const unsigned int      element,
                                     const EdgeRule         &rule,
                                     std::vector<WeakPoint> &points) const
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      const double        k    = bound(element);
      if (!std::isfinite(k))
        return;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        WeakPoint point;
        point.condition      = condition;
        point.n_sides        = 1;
        point.weight         = rule.weights[q];
        point.penalty        = safety * k;
        point.trace_constant = (*trace_constants)(element);
        point.normal         = rule.normals[q];
        evaluate_condition(problem->boundary_conditions[condition],
                           mesh.mathematical_mesh().reference_to_real(
                             mesh.cell(element), rule.points[q]),
                           rule.normals[q],
                           point.projection,
                           point.prescribed);
        set_side(point, 0, element, rule.points[q], 1.);
        points.push_back(point);
      }
    }


    void
    WeakPointMaker::append_tie(const unsigned int      element,
                               const ElementEdge      &edge,
                               const EdgeRule         &rule,
                               std::vector<WeakPoint> &points) const
    {
      const ManifoldMesh     &mesh        = covers->manifold_mesh();
      const MathematicalMesh &cells       = mesh.mathematical_mesh();
      const unsigned int      elements[2] = {element, edge.neighbor};
      const double            k[2] = {bound(elements[0]), bound(elements[1])};
      if (!std::isfinite(k[0]) && !std::isfinite(k[1]))
        return;
      // k_2 / (k_1 + k_2), written so that one k may be infinite
      double share[2];
      for (unsigned int side = 0; side < 2; ++side)
        share[side] =
          std::isfinite(k[side]) ? 1. / (1. + k[side] / k[1 - side]) : 0.;
      // An element that is tied to a small block has a small bound, because the boundary of the
      // block is short compared with the element. The bound alone would tie the block too softly,
      // so that the penalty is at least the stiffness divided by the size of the smaller cell.
      const double softer = std::min(
        region_to_elasticity[mesh.region(elements[0])].largest_eigenvalue(),
        region_to_elasticity[mesh.region(elements[1])].largest_eigenvalue());
      const double size = std::min(cells.cell_diameter(mesh.cell(elements[0])),
                                   cells.cell_diameter(mesh.cell(elements[1])));
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        WeakPoint point;
        point.condition = invalid_index;
        point.n_sides   = 2;
        point.weight    = rule.weights[q];
        point.penalty =
          std::max(safety / (1. / k[0] + 1. / k[1]), softer / size);
        point.trace_constant = std::max((*trace_constants)(elements[0]),
                                        (*trace_constants)(elements[1]));
        point.normal         = rule.normals[q];
        point.projection     = dealii::unit_symmetric_tensor<2>();
        const dealii::Point<2> x =
          cells.reference_to_real(mesh.cell(element), rule.points[q]);
        for (unsigned int side = 0; side < 2; ++side)
          set_side(point,
                   side,
                   elements[side],
                   cells.real_to_reference(mesh.cell(elements[side]), x),
                   share[side]);
        points.push_back(point);
      }
    }


    WeakTraction::WeakTraction(const WeakPoint                    &point,
                               const unsigned int                  n_per_cell,
                               const std::vector<PlaneElasticity> &elasticities)
    {
      const dealii::Tensor<1, 2> &normal = point.normal;
      for (unsigned int k = 0; k < point.n_sides * n_per_cell; ++k)
      {
        const WeakPoint::Side &side  = point.sides[k / n_per_cell];
        const PlaneElasticity &e     = elasticities[side.region];
        const double          *g     = side.gradients[k % n_per_cell];
        const double           along = g[0] * normal[0] + g[1] * normal[1];
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int c = 0; c < 2; ++c)
            derivative[k][a][c] = side.share * (e.lambda * normal[a] * g[c] +
                                                e.mu * g[a] * normal[c] +
                                                (a == c ? e.mu * along : 0.));
      }
    }


    void
    add_nitsche(const WeakPoint            &point,
                const WeakTraction         &traction,
                const dealii::Tensor<1, 2> &difference,
                const dealii::Tensor<1, 2> &t,
                const double                weight,
                const double                sign,
                LocalSystem                &system)
    {
      const unsigned int n       = system.n_covers;
      const auto        &B       = point.projection;
      const double       P[2][2] = {{B[0][0], B[0][1]}, {B[1][0], B[1][1]}};
      const dealii::Tensor<1, 2> force = point.penalty * difference - B * t;

      double projected[LocalSystem::max_covers][2][2];
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const auto &flux = traction.derivative[k];
          system.rhs[2 * k + c] +=
            sign * weight *
            (point.jump[k] * force[c] - flux[0][c] * difference[0] -
             flux[1][c] * difference[1]);
          for (unsigned int a = 0; a < 2; ++a)
            projected[k][a][c] = P[a][0] * flux[0][c] + P[a][1] * flux[1][c];
        }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double jump = point.jump[k];
          double      *row  = system.row(k, c);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int d = 0; d < 2; ++d)
              row[2 * j + d] +=
                weight * (-jump * projected[j][c][d] -
                          projected[k][d][c] * point.jump[j] +
                          point.penalty * jump * point.jump[j] * P[c][d]);
        }
    }
  } // namespace internal
} // namespace NMM
