#include <nmm/quadrature/element_quadrature.h>

#include <mechanics/ghost_terms.h>

namespace NMM
{
  namespace internal
  {
    GhostTerms::GhostTerms(const CoverSystem       &covers,
                           const ElasticityProblem &problem)
      : covers(&covers)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
      , rule(make_triangle_rule(2 * degree))
    {
      for (const unsigned int m :
           problem.region_to_material(covers.manifold_mesh().physical_mesh()))
      {
        region_to_elasticity.push_back(
          problem.materials[m].plane_elasticity(problem.plane_state));
        region_to_density.push_back(problem.materials[m].density);
      }
    }


    template <typename Action>
    void
    GhostTerms::for_each_point(
      const std::pair<unsigned int, unsigned int> &pair,
      const Action                                &action) const
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      cells[2]          = {mesh.cell(pair.first),
                                                   mesh.cell(pair.second)};
      for (unsigned int where = 0; where < 2; ++where)
      {
        const double area = mathematical_mesh.cell_area(cells[where]);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const dealii::Point<2> x =
            mathematical_mesh.reference_to_real(cells[where], rule.point(q));
          action(cells,
                 where == 0 ? rule.point(q)
                            : mathematical_mesh.real_to_reference(cells[0], x),
                 where == 1 ? rule.point(q)
                            : mathematical_mesh.real_to_reference(cells[1], x),
                 2. * area * rule.weight(q));
        }
      }
    }


    void
    GhostTerms::add_stiffness(const std::pair<unsigned int, unsigned int> &pair,
                              LocalSystem &system) const
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const PlaneElasticity  &elasticity =
        region_to_elasticity[mesh.region(pair.first)];
      for_each_point(
        pair,
        [&](const unsigned int     *cells,
            const dealii::Point<2> &xi_0,
            const dealii::Point<2> &xi_1,
            const double            weight) {
          double reference[2][WeightFunctions::max_per_cell][2];
          WeightFunctions::gradients(degree, xi_0, reference[0]);
          WeightFunctions::gradients(degree, xi_1, reference[1]);
          double g[LocalSystem::max_covers][2];
          for (unsigned int side = 0; side < 2; ++side)
          {
            const dealii::Tensor<2, 2> T = dealii::transpose(
              dealii::invert(mathematical_mesh.jacobian(cells[side])));
            const double sign = side == 0 ? 1. : -1.;
            for (unsigned int i = 0; i < n_per_cell; ++i)
              for (unsigned int k = 0; k < 2; ++k)
                g[side * n_per_cell + i][k] =
                  sign * (T[k][0] * reference[side][i][0] +
                          T[k][1] * reference[side][i][1]);
          }
          const double lambda = stiffness_factor * weight * elasticity.lambda,
                       mu     = stiffness_factor * weight * elasticity.mu;
          for (unsigned int i = 0; i < system.n_covers; ++i)
            for (unsigned int j = 0; j < system.n_covers; ++j)
            {
              const double trace = g[i][0] * g[j][0] + g[i][1] * g[j][1];
              for (unsigned int k = 0; k < 2; ++k)
                for (unsigned int l = 0; l < 2; ++l)
                  system.row(i, k)[unknown_of(j, l)] +=
                    lambda * g[i][k] * g[j][l] + mu * g[i][l] * g[j][k] +
                    (k == l ? mu * trace : 0.);
            }
        });
    }


    void
    GhostTerms::add_mass(const std::pair<unsigned int, unsigned int> &pair,
                         LocalSystem &system) const
    {
      const double density =
        region_to_density[covers->manifold_mesh().region(pair.first)];
      for_each_point(pair,
                     [&](const unsigned int *,
                         const dealii::Point<2> &xi_0,
                         const dealii::Point<2> &xi_1,
                         const double            weight) {
                       double w[LocalSystem::max_covers];
                       WeightFunctions::values(degree, xi_0, w);
                       WeightFunctions::values(degree, xi_1, w + n_per_cell);
                       for (unsigned int i = 0; i < n_per_cell; ++i)
                         w[n_per_cell + i] *= -1.;
                       const double m = mass_factor * weight * density;
                       for (unsigned int i = 0; i < system.n_covers; ++i)
                         for (unsigned int j = 0; j < system.n_covers; ++j)
                           for (unsigned int k = 0; k < 2; ++k)
                             system.row(i, k)[unknown_of(j, k)] +=
                               m * w[i] * w[j];
                     });
    }
  } // namespace internal
} // namespace NMM
