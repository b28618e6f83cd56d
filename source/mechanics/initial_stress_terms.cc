#include <nmm/materials/material.h>

#include <mechanics/initial_stress_terms.h>

namespace NMM
{
  namespace internal
  {
    InitialStressTerms::InitialStressTerms(
      const CoverSystem          &covers,
      const QuadratureCollection &quadrature,
      const ElasticityProblem    &problem,
      const EdgeTables           &edges)
      : covers(&covers)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      if (!problem.has_varying_initial_stress())
        return;
      const ManifoldMesh             &mesh = covers.manifold_mesh();
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(mesh.physical_mesh());
      const auto stress_of = [&](const unsigned int region) {
        const Material &material =
          problem.materials[region_to_material[region]];
        return material.law->is_inelastic()
                 ? nullptr
                 : material.varying_initial_stress.get();
      };
      const auto [first, last] = covers.locally_owned_elements();
      first_element            = first;
      element_to_entry.assign(last - first, invalid_index);
      for (unsigned int e = first; e < last; ++e)
        if (const auto *stress = stress_of(mesh.region(e)))
        {
          element_to_entry[e - first] = entries.size();
          entries.push_back(integrate(e, quadrature.rule(e), *stress));
        }
      tractions.resize(edges.weak_points.size());
      for (unsigned int q = 0; q < tractions.size(); ++q)
      {
        const WeakPoint &point = edges.weak_points[q];
        for (unsigned int s = 0; s < point.n_sides; ++s)
          if (const auto *stress = stress_of(point.sides[s].region))
            tractions[q][s] =
              stress_at(*stress, edges.places[q]) * point.normal;
      }
    }


    InitialStressTerms::Integrals
    InitialStressTerms::integrate(const unsigned int           element,
                                  const dealii::Quadrature<2> &rule,
                                  const dealii::Function<2>   &stress) const
    {
      const MathematicalMesh &cells =
        covers->manifold_mesh().mathematical_mesh();
      const unsigned int         cell = covers->manifold_mesh().cell(element);
      const dealii::Tensor<2, 2> jacobian = cells.jacobian(cell);
      const dealii::Tensor<2, 2> T =
        dealii::transpose(dealii::invert(jacobian));
      const double         det    = dealii::determinant(jacobian);
      Integrals            result = {};
      double               reference[WeightFunctions::max_per_cell][2];
      dealii::Tensor<1, 2> g[WeightFunctions::max_per_cell];
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        WeightFunctions::gradients(degree, rule.point(q), reference);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          g[i] = T * dealii::Tensor<1, 2>({reference[i][0], reference[i][1]});
        const dealii::SymmetricTensor<2, 2> weighted =
          (det * rule.weight(q)) *
          stress_at(stress, cells.reference_to_real(cell, rule.point(q)));
        for (unsigned int i = 0; i < n_per_cell; ++i)
        {
          const dealii::Tensor<1, 2> force = weighted * g[i];
          for (unsigned int c = 0; c < 2; ++c)
            result.forces[i][c] += force[c];
          for (unsigned int j = 0; j < n_per_cell; ++j)
            result.moduli[i][j] += force * g[j];
        }
      }
      return result;
    }


    void
    InitialStressTerms::add_small(const unsigned int       element,
                                  const LocalDisplacement &u,
                                  LocalSystem             &local) const
    {
      const Integrals *integrals = of(element);
      if (integrals == nullptr)
        return;
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 2; ++c)
        {
          local.rhs[unknown_of(i, c)] += integrals->forces[i][c];
          local.energy += integrals->forces[i][c] * u.values[i][c];
        }
    }


    void
    InitialStressTerms::add_finite(const unsigned int       element,
                                   const LocalDisplacement &u,
                                   LocalSystem             &local) const
    {
      const Integrals *integrals = of(element);
      if (integrals == nullptr)
        return;
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double at_rest = integrals->forces[i][c];
          double       force   = at_rest;
          for (unsigned int j = 0; j < n_per_cell; ++j)
          {
            force += integrals->moduli[i][j] * u.values[j][c];
            if (local.with_matrix)
              local.row(i, c)[unknown_of(j, c)] += integrals->moduli[i][j];
          }
          local.rhs[unknown_of(i, c)] += force;
          local.energy += 0.5 * (at_rest + force) * u.values[i][c];
        }
    }


    void
    InitialStressTerms::add_small_fluxes(const unsigned int point,
                                         NitscheTerms      &terms) const
    {
      if (tractions.empty())
        return;
      for (unsigned int s = 0; s < terms.point.n_sides; ++s)
        terms.fluxes[s].traction += tractions[point][s];
    }


    void
    InitialStressTerms::add_finite_fluxes(const unsigned int       point,
                                          const LocalDisplacement &u,
                                          NitscheTerms            &terms) const
    {
      if (tractions.empty())
        return;
      for (unsigned int s = 0; s < terms.point.n_sides; ++s)
      {
        const dealii::Tensor<1, 2> &t    = tractions[point][s];
        WeakFlux                   &flux = terms.fluxes[s];
        flux.traction += t + terms.gradient(u, s) * t;
        flux.conjugate += dealii::outer_product(terms.d, t);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int J = 0; J < 2; ++J)
          {
            flux.traction_by_gradient[i][2 * i + J] += t[J];
            flux.conjugate_by_jump[2 * i + J][i] += t[J];
          }
      }
    }
  } // namespace internal
} // namespace NMM
