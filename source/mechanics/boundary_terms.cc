#include <cmath>
#include <mechanics/boundary_terms.h>

namespace NMM
{
  namespace internal
  {
    EdgeTerms::EdgeTerms(const CoverSystem       &covers,
                         const ElasticityProblem &problem,
                         TraceConstants          &trace_constants)
      : covers(&covers)
      , maker(covers, problem, trace_constants)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
      , regions(linear_regions(covers, problem))
    {
    }


    bool
    EdgeTerms::compute_disk_edge(const unsigned int element,
                                 const ElementEdge &edge,
                                 const DiskCover   &disk,
                                 DiskEdge          &result) const
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
        regions[mesh.region(element)].elasticity;

      const unsigned int n = disk.n_functions();
      result.couplings.assign(n, dealii::Vector<double>(4 * n_per_cell));
      result.works          = result.couplings;
      result.unit_tractions = {{dealii::Vector<double>(4 * n_per_cell),
                                dealii::Vector<double>(4 * n_per_cell)}};
      result.matrix.reinit(n, n);
      result.work_matrix.reinit(n, n);

      // The functions are no polynomials.
      const unsigned int     further_degree = 4;
      const EdgeRule         rule           = make_edge_rule(edge,
                                           cell_frame(mesh, element),
                                           2 * degree + further_degree);
      std::vector<WeakPoint> points;
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
      const double w_1 = point.sides[inside].share, w_2 = 1. - w_1;
      double       traction[LocalSystem::max_covers][2][2];
      NitscheTerms terms(point, n_per_cell, point.penalty);
      set_linear_fluxes(regions, LocalDisplacement(), terms);
      terms.traction_derivatives(traction);
      // jump and flux are those of the element minus its neighbour, and with its normal
      const double sign = inside == 0 ? 1. : -1.;
      const auto   mean = [&](const unsigned int k) {
        const double jump = sign * point.jump[k];
        return k / n_per_cell == inside ? w_2 * jump : -w_1 * jump;
      };
      for (unsigned int k = 0; k < 2 * n_per_cell; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          result.unit_tractions[c](unknown_of(k, c)) += point.weight * mean(k);
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
            const double flux =
              sign * (traction[k][0][c] * F[0] + traction[k][1][c] * F[1]);
            result.couplings[j](unknown_of(k, c)) +=
              point.weight *
              (mean(k) * t[c] - flux + point.penalty * jump * F[c]);
            if (is_inner)
              result.works[j](unknown_of(k, c)) += point.weight * jump * t[c];
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
