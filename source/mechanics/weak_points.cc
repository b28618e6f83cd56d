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
        // The value of an absorbing boundary is a wave, and not a displacement.
        const bool has_value =
          condition.value != nullptr && !condition.is_absorbing();
        if (condition.holds_normal())
        {
          projection[0][0] = n[0] * n[0];
          projection[0][1] = n[0] * n[1];
          projection[1][1] = n[1] * n[1];
          if (has_value)
            prescribed = condition.value->value(x) * n;
          return;
        }
        for (unsigned int c = 0; c < 2; ++c)
          if (condition.components[c])
          {
            projection[c][c] = 1.;
            if (has_value)
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
  } // namespace internal
} // namespace NMM
