#include <mechanics/finite_terms.h>
#include <mechanics/linear_terms.h>
#include <optional>

namespace NMM
{
  namespace internal
  {
    ReferenceIntegrals::ReferenceIntegrals(const dealii::Quadrature<2> &rule,
                                           const unsigned int           degree)
    {
      const unsigned int n_per_cell = WeightFunctions::n_per_cell(degree);
      double             g[n_max][2];
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double weight = rule.weight(q);
        WeightFunctions::gradients(degree, rule.point(q), g);
        for (unsigned int i = 0; i < n_per_cell; ++i)
        {
          const double g0 = weight * g[i][0], g1 = weight * g[i][1];
          for (unsigned int j = i; j < n_per_cell; ++j)
          {
            auto &product = gradient_products[i][j];
            product[0][0] += g0 * g[j][0];
            product[0][1] += g0 * g[j][1];
            product[1][0] += g1 * g[j][0];
            product[1][1] += g1 * g[j][1];
          }
          gradients[i][0] += g0;
          gradients[i][1] += g1;
        }
      }
    }


    void
    add_linear_stiffness(const ReferenceIntegrals   &integrals,
                         const dealii::Tensor<2, 2> &jacobian,
                         const PlaneElasticity      &elasticity,
                         LocalSystem                &system)
    {
      const unsigned int n_per_cell = system.n_covers;
      const double       det        = dealii::determinant(jacobian);
      // T[k][a]: the physical gradient is T times the reference gradient
      const dealii::Tensor<2, 2> T =
        dealii::transpose(dealii::invert(jacobian));
      const double t00 = T[0][0], t01 = T[0][1], t10 = T[1][0], t11 = T[1][1];

      const double lambda = elasticity.lambda * det;
      const double mu     = elasticity.mu * det;

      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int j = i; j < n_per_cell; ++j)
        {
          const auto  &s   = integrals.gradient_products[i][j];
          const double b00 = t00 * s[0][0] + t01 * s[1][0],
                       b01 = t00 * s[0][1] + t01 * s[1][1],
                       b10 = t10 * s[0][0] + t11 * s[1][0],
                       b11 = t10 * s[0][1] + t11 * s[1][1];
          const double a00 = b00 * t00 + b01 * t01, a01 = b00 * t10 + b01 * t11,
                       a10 = b10 * t00 + b11 * t01, a11 = b10 * t10 + b11 * t11;
          const double k00 = (lambda + 2. * mu) * a00 + mu * a11,
                       k01 = lambda * a01 + mu * a10,
                       k10 = lambda * a10 + mu * a01,
                       k11 = (lambda + 2. * mu) * a11 + mu * a00;
          double *row0     = system.row(i, 0) + unknown_of(j, 0);
          double *row1     = system.row(i, 1) + unknown_of(j, 0);
          row0[0] += k00;
          row0[1] += k01;
          row1[0] += k10;
          row1[1] += k11;
          if (i != j)
          {
            double *mirror0 = system.row(j, 0) + unknown_of(i, 0);
            double *mirror1 = system.row(j, 1) + unknown_of(i, 0);
            mirror0[0] += k00;
            mirror0[1] += k10;
            mirror1[0] += k01;
            mirror1[1] += k11;
          }
        }
    }


    std::vector<LinearRegion>
    linear_regions(const CoverSystem &covers, const ElasticityProblem &problem)
    {
      std::vector<LinearRegion> regions;
      for (const unsigned int m :
           problem.region_to_material(covers.manifold_mesh().physical_mesh()))
      {
        const Material &material = problem.materials[m];
        regions.emplace_back();
        regions.back().elasticity =
          material.plane_elasticity(problem.plane_state);
        if (material.inelastic_law(problem.plane_state) == nullptr)
          regions.back().initial_stress = material.initial_stress;
        hooke_moduli(regions.back().elasticity, regions.back().moduli);
      }
      return regions;
    }


    LinearTerms::LinearTerms(const CoverSystem          &covers,
                             const QuadratureCollection &quadrature,
                             const ElasticityProblem    &problem)
      : covers(&covers)
      , quadrature(&quadrature)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
      , has_whole_integrals(false)
      , regions(linear_regions(covers, problem))
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last && !has_whole_integrals; ++e)
        if (mesh.is_whole(e))
        {
          whole_integrals     = ReferenceIntegrals(quadrature.rule(e), degree);
          has_whole_integrals = true;
        }
    }


    void
    LinearTerms::add_at_rest(const unsigned int element,
                             LocalSystem       &system) const
    {
      const ManifoldMesh &mesh   = covers->manifold_mesh();
      const LinearRegion &region = regions[mesh.region(element)];

      const ReferenceIntegrals         *integrals = &whole_integrals;
      std::optional<ReferenceIntegrals> cut_integrals;
      if (!mesh.is_whole(element))
        integrals = &cut_integrals.emplace(quadrature->rule(element), degree);

      const dealii::Tensor<2, 2> jacobian =
        mesh.mathematical_mesh().jacobian(mesh.cell(element));
      const double det = dealii::determinant(jacobian);
      // T[k][a]: the physical gradient is T times the reference gradient
      const dealii::Tensor<2, 2> T =
        dealii::transpose(dealii::invert(jacobian));
      const double t00 = T[0][0], t01 = T[0][1], t10 = T[1][0], t11 = T[1][1];

      add_linear_stiffness(*integrals, jacobian, region.elasticity, system);

      const dealii::SymmetricTensor<2, 2> &stress = region.initial_stress;
      for (unsigned int i = 0; i < n_per_cell; ++i)
      {
        const double *g = integrals->gradients[i];
        const double g0 = t00 * g[0] + t01 * g[1], g1 = t10 * g[0] + t11 * g[1];
        for (unsigned int c = 0; c < 2; ++c)
          system.rhs[unknown_of(i, c)] +=
            det * (stress[c][0] * g0 + stress[c][1] * g1);
      }
    }


    void
    LinearTerms::add_forces(const unsigned int         element,
                            const ElementTables::View &table,
                            const LocalDisplacement   &u,
                            LocalSystem               &system) const
    {
      const LinearRegion &region =
        regions[covers->manifold_mesh().region(element)];
      for (unsigned int q = 0; q < table.n_points; ++q)
      {
        const double(*g)[2]               = table.gradients + q * n_per_cell;
        const double               weight = table.weights[q];
        const dealii::Tensor<2, 2> H =
          displacement_gradient(n_per_cell, u.values, g);
        const dealii::Tensor<2, 2> initial = region.initial_stress,
                                   stress =
                                     initial + multiply(region.moduli, H);
        system.energy +=
          0.5 * weight * dealii::scalar_product(initial + stress, H);
        add_stress(n_per_cell, g, weight * stress, system.rhs);
      }
    }


    void
    set_linear_fluxes(const std::vector<LinearRegion> &regions,
                      const LocalDisplacement         &u,
                      NitscheTerms                    &terms)
    {
      const WeakPoint &point = terms.point;
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const LinearRegion        &region  = regions[point.sides[s].region];
        const dealii::Tensor<2, 2> initial = region.initial_stress;
        terms.fluxes[s].set_elastic(initial + multiply(region.moduli,
                                                       terms.gradient(u, s)),
                                    region.moduli,
                                    point.normal,
                                    terms.d);
      }
    }
  } // namespace internal
} // namespace NMM
