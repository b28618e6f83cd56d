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
      , trace_constants(&trace_constants)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      for (const unsigned int m :
           problem.region_to_material(covers.manifold_mesh().physical_mesh()))
      {
        region_to_elasticity.push_back(
          problem.materials[m].plane_elasticity(problem.plane_state));
        region_to_initial_stress.push_back(problem.materials[m].initial_stress);
      }
    }


    void
    EdgeTerms::append(const unsigned int          element,
                      const dealii::Point<2>     &xi,
                      const dealii::Tensor<1, 2> &normal,
                      const double                sign,
                      const double                share,
                      PointFunctionals           &functionals) const
    {
      const ManifoldMesh        &mesh = covers->manifold_mesh();
      const dealii::Tensor<2, 2> T    = dealii::transpose(
        dealii::invert(mesh.mathematical_mesh().jacobian(mesh.cell(element))));
      const PlaneElasticity &c = region_to_elasticity[mesh.region(element)];

      double w[WeightFunctions::max_per_cell];
      double g[WeightFunctions::max_per_cell][2];
      WeightFunctions::values(degree, xi, w);
      WeightFunctions::gradients(degree, xi, g);
      for (unsigned int i = 0; i < n_per_cell; ++i)
      {
        const unsigned int k    = functionals.n_covers++;
        const double       G[2] = {T[0][0] * g[i][0] + T[0][1] * g[i][1],
                                   T[1][0] * g[i][0] + T[1][1] * g[i][1]};
        const double       Gn   = G[0] * normal[0] + G[1] * normal[1];
        functionals.jump[k]     = sign * w[i];
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
            functionals.flux[k][a][b] =
              share * (c.lambda * normal[a] * G[b] + c.mu * G[a] * normal[b] +
                       (a == b ? c.mu * Gn : 0.));
      }
      functionals.initial_flux +=
        share * (region_to_initial_stress[mesh.region(element)] * normal);
    }


    void
    EdgeTerms::add_nitsche(const PointFunctionals              &functionals,
                           const dealii::SymmetricTensor<2, 2> &projection,
                           const double                         penalty,
                           const dealii::Tensor<1, 2>          &prescribed,
                           const double                         weight,
                           LocalSystem                         &system)
    {
      const unsigned int n = functionals.n_covers;
      AssertDimension(n, system.n_covers);
      const double P[2][2] = {{projection[0][0], projection[0][1]},
                              {projection[1][0], projection[1][1]}};

      double projected_flux[LocalSystem::max_covers][2][2];
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
            projected_flux[i][a][b] = P[a][0] * functionals.flux[i][0][b] +
                                      P[a][1] * functionals.flux[i][1][b];

      const dealii::Tensor<1, 2> g = projection * prescribed;
      const dealii::Tensor<1, 2> s = projection * functionals.initial_flux;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double jump = functionals.jump[i];
          double      *row  = system.row(i, c);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int d = 0; d < 2; ++d)
              row[2 * j + d] +=
                weight * (-jump * projected_flux[j][c][d] -
                          projected_flux[i][d][c] * functionals.jump[j] +
                          penalty * jump * functionals.jump[j] * P[c][d]);
          system.rhs[2 * i + c] +=
            weight * (-functionals.flux[i][0][c] * g[0] -
                      functionals.flux[i][1][c] * g[1] + penalty * jump * g[c] +
                      jump * s[c]);
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
          make_edge_rule(edge,
                         cell_frame(mesh.mathematical_mesh(), cell),
                         2 * degree);
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
              add_displacement(condition, element, rule, system);
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
    EdgeTerms::add_displacement(const BoundaryCondition &condition,
                                const unsigned int       element,
                                const EdgeRule          &rule,
                                LocalSystem             &system)
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      const double        bound =
        region_to_elasticity[mesh.region(element)].largest_eigenvalue() *
        (*trace_constants)(element);
      // an element without area has no energy; the conditions of its neighbours suffice
      if (!std::isfinite(bound))
        return;

      PointFunctionals functionals;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const dealii::Tensor<1, 2> &n = rule.normals[q];
        functionals.n_covers          = 0;
        functionals.initial_flux      = 0.;
        append(element, rule.points[q], n, 1., 1., functionals);

        const dealii::Point<2> x =
          mesh.mathematical_mesh().reference_to_real(mesh.cell(element),
                                                     rule.points[q]);
        dealii::SymmetricTensor<2, 2> projection;
        dealii::Tensor<1, 2>          prescribed;
        if (condition.type == BoundaryCondition::Type::normal_displacement)
        {
          projection[0][0] = n[0] * n[0];
          projection[0][1] = n[0] * n[1];
          projection[1][1] = n[1] * n[1];
          if (condition.value != nullptr)
            prescribed = condition.value->value(x) * n;
        }
        else
          for (unsigned int c = 0; c < 2; ++c)
            if (condition.components[c])
            {
              projection[c][c] = 1.;
              if (condition.value != nullptr)
                prescribed[c] = condition.value->value(x, c);
            }
        add_nitsche(functionals,
                    projection,
                    safety * bound,
                    prescribed,
                    rule.weights[q],
                    system);
      }
    }


    std::optional<EdgeTerms::TieWeights>
    EdgeTerms::tie_weights(const unsigned int element, const ElementEdge &edge)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      elements[2]       = {element, edge.neighbor};

      double bound[2];
      for (unsigned int side = 0; side < 2; ++side)
        bound[side] = region_to_elasticity[mesh.region(elements[side])]
                        .largest_eigenvalue() *
                      (*trace_constants)(elements[side]);
      if (!std::isfinite(bound[0]) && !std::isfinite(bound[1]))
        return {};
      // k_2 / (k_1 + k_2), written so that one k may be infinite
      TieWeights weights;
      for (unsigned int side = 0; side < 2; ++side)
        weights.share[side] = std::isfinite(bound[side])
                                ? 1. / (1. + bound[side] / bound[1 - side])
                                : 0.;
      // An element that is tied to a small block has a small bound, because the boundary of the
      // block is short compared with the element. The bound alone would tie the block too softly,
      // so that the penalty is at least the stiffness divided by the size of the smaller cell.
      const double softer = std::min(
        region_to_elasticity[mesh.region(elements[0])].largest_eigenvalue(),
        region_to_elasticity[mesh.region(elements[1])].largest_eigenvalue());
      const double size =
        std::min(mathematical_mesh.cell_diameter(mesh.cell(elements[0])),
                 mathematical_mesh.cell_diameter(mesh.cell(elements[1])));
      weights.penalty =
        std::max(safety / (1. / bound[0] + 1. / bound[1]), softer / size);
      return weights;
    }


    void
    EdgeTerms::set_pair(const unsigned int          element,
                        const ElementEdge          &edge,
                        const dealii::Point<2>     &x,
                        const dealii::Tensor<1, 2> &normal,
                        const TieWeights           &weights,
                        PointFunctionals           &functionals) const
    {
      const ManifoldMesh &mesh        = covers->manifold_mesh();
      const unsigned int  elements[2] = {element, edge.neighbor};
      functionals.n_covers            = 0;
      functionals.initial_flux        = 0.;
      for (unsigned int side = 0; side < 2; ++side)
        append(elements[side],
               mesh.mathematical_mesh().real_to_reference(
                 mesh.cell(elements[side]), x),
               normal,
               side == 0 ? 1. : -1.,
               weights.share[side],
               functionals);
    }


    void
    EdgeTerms::add_tie(const unsigned int element,
                       const ElementEdge &edge,
                       LocalSystem       &system)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();

      const std::optional<TieWeights> weights = tie_weights(element, edge);
      if (!weights)
        return;
      const EdgeRule rule =
        make_edge_rule(edge,
                       cell_frame(mathematical_mesh, mesh.cell(element)),
                       2 * degree);
      PointFunctionals functionals;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const dealii::Point<2> x =
          mathematical_mesh.reference_to_real(mesh.cell(element),
                                              rule.points[q]);
        set_pair(element, edge, x, rule.normals[q], *weights, functionals);
        add_nitsche(functionals,
                    dealii::unit_symmetric_tensor<2>(),
                    weights->penalty,
                    dealii::Tensor<1, 2>(),
                    rule.weights[q],
                    system);
      }
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
      const std::optional<TieWeights> weights = tie_weights(element, edge);
      if (!weights)
        return false;
      const unsigned int     inside  = is_inside(0) ? 0 : 1;
      const double           outward = inside == 0 ? 1. : -1.;
      const PlaneElasticity &elasticity =
        region_to_elasticity[mesh.region(element)];

      const unsigned int n = disk.n_functions();
      result.couplings.assign(n, dealii::Vector<double>(4 * n_per_cell));
      result.works = result.couplings;
      result.matrix.reinit(n, n);
      result.work_matrix.reinit(n, n);

      // The functions are no polynomials.
      const unsigned int further_degree = 4;
      const EdgeRule     rule =
        make_edge_rule(edge,
                       cell_frame(mathematical_mesh, mesh.cell(element)),
                       2 * degree + further_degree);
      PointFunctionals functionals;
      DiskPoint        point;
      point.displacements.resize(n);
      point.tractions.resize(n);
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const dealii::Point<2> x =
          mathematical_mesh.reference_to_real(mesh.cell(element),
                                              rule.points[q]);
        for (unsigned int j = 0; j < n; ++j)
        {
          const DiskCover::Value value =
            disk.evaluate(j, x, dealii::Tensor<1, 2>());
          point.displacements[j] = value.displacement;
          point.tractions[j] =
            outward * (elasticity.stress(dealii::symmetrize(value.gradient)) *
                       rule.normals[q]);
        }
        set_pair(element, edge, x, rule.normals[q], *weights, functionals);
        add_disk_point(
          functionals, point, inside, *weights, rule.weights[q], result);
      }
      return true;
    }


    void
    EdgeTerms::add_disk_point(const PointFunctionals &functionals,
                              const DiskPoint        &point,
                              const unsigned int      inside,
                              const TieWeights       &weights,
                              const double            weight,
                              DiskEdge               &result) const
    {
      const double w_1 = weights.share[inside], w_2 = 1. - w_1;
      // jump and flux are those of the element minus its neighbour, and with its normal
      const double sign = inside == 0 ? 1. : -1.;
      for (unsigned int j = 0; j < point.displacements.size(); ++j)
      {
        const dealii::Tensor<1, 2> &F = point.displacements[j],
                                   &t = point.tractions[j];
        for (unsigned int k = 0; k < functionals.n_covers; ++k)
        {
          const bool   is_inner = k / n_per_cell == inside;
          const double jump     = sign * functionals.jump[k];
          const double mean     = is_inner ? w_2 * jump : -w_1 * jump;
          for (unsigned int c = 0; c < 2; ++c)
          {
            const double flux = sign * (functionals.flux[k][0][c] * F[0] +
                                        functionals.flux[k][1][c] * F[1]);
            result.couplings[j](2 * k + c) +=
              weight * (mean * t[c] - flux + weights.penalty * jump * F[c]);
            if (is_inner)
              result.works[j](2 * k + c) += weight * jump * t[c];
          }
        }
        for (unsigned int k = 0; k < point.displacements.size(); ++k)
        {
          // both orders of j and k have the same integral on the whole circle
          const double work =
            0.5 * (t * point.displacements[k] + point.tractions[k] * F);
          result.work_matrix(j, k) += weight * work;
          result.matrix(j, k) +=
            weight * ((1. - 2. * w_1) * work +
                      weights.penalty * (F * point.displacements[k]));
        }
      }
    }
  } // namespace internal
} // namespace NMM
