#include <deal.II/base/mpi.h>

#include <cmath>
#include <mechanics/finite_elasticity_data.h>
#include <mechanics/nodal_values.h>

// Energies and forces of the theory of small displacements.
namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

  std::vector<HyperelasticLaw::Response>
  FiniteElasticity::Data::laws_at_rest() const
  {
    std::vector<HyperelasticLaw::Response> responses(region_to_law.size());
    for (unsigned int region = 0; region < responses.size(); ++region)
    {
      const Deformation state =
        region_to_law[region]->evaluate(dealii::unit_symmetric_tensor<2>(),
                                        responses[region]);
      (void)state;
      Assert(state == Deformation::admissible, dealii::ExcInternalError());
    }
    return responses;
  }


  void
  FiniteElasticity::Data::add_linearized_volume(
    const unsigned int               element,
    const HyperelasticLaw::Response &at_rest,
    LocalSystem                     &local) const
  {
    const ElementTables::View table = tables(element);
    LocalDisplacement         u;
    u.gather(covers->covers(element), nodal);
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const double(*g)[2]  = table.gradients + q * n_per_cell;
      const double       w = table.weights[q];
      const Tensor<2, 2> H = displacement_gradient(n_per_cell, u.values, g);
      const Tensor<2, 2> P = at_rest.stress + multiply(at_rest.tangent, H);
      local.energy += 0.5 * w * dealii::scalar_product(at_rest.stress + P, H);
      add_stress(n_per_cell, g, w * P, local.rhs);
    }
  }


  void
  FiniteElasticity::Data::add_linearized_weak_points(
    const EdgeTables::Site                       &site,
    const std::vector<HyperelasticLaw::Response> &at_rest,
    LocalSystem                                  &local) const
  {
    LocalDisplacement u;
    gather(site, nodal, u);
    for_each_weak_point(site, [&](const unsigned int q) {
      const WeakPoint &point = edges->weak_points[q];
      NitscheTerms terms(point, n_per_cell, penalty_growth[q] * point.penalty);
      terms.d = terms.jump(u,
                           point.condition == invalid_index ||
                               amplitudes.boundary_conditions.empty()
                             ? 1.
                             : amplitudes.boundary_conditions[point.condition]);
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const HyperelasticLaw::Response &law = at_rest[point.sides[s].region];
        terms.fluxes[s].traction =
          (law.stress + multiply(law.tangent, terms.gradient(u, s))) *
          point.normal;
      }
      terms.add(local);
    });
  }


  double
  FiniteElasticity::Data::add_linearized_conditions(double &square) const
  {
    const std::vector<HyperelasticLaw::Response> at_rest = laws_at_rest();
    const auto [first, last] = covers->locally_owned_elements();
    double      energy       = 0.;
    LocalSystem local;
    const auto  add = [&](const unsigned int n, const auto &add_terms) {
      local.reset(n, /* needs_matrix = */ false);
      add_terms();
      energy += local.energy;
      for (unsigned int i = 0; i < 2 * n; ++i)
        square += local.rhs[i] * local.rhs[i];
    };
    for (const EdgeTables::Site &site : edges->conditions)
      if (!is_absent(site.element))
        add(n_per_cell,
            [&]() { add_linearized_weak_points(site, at_rest, local); });
    for (const EdgeTables::Site &tie : edges->ties)
      if (!is_absent(tie.element) && !is_absent(tie.neighbor))
        add(2 * n_per_cell,
            [&]() { add_linearized_weak_points(tie, at_rest, local); });
    for (unsigned int f = 0; f < problem->fixed_points.size(); ++f)
    {
      const unsigned int e = points.fixed_point_elements()[f];
      if (e < first || e >= last || is_absent(e) ||
          (!amplitudes.released_fixed_points.empty() &&
           amplitudes.released_fixed_points[f]))
        continue;
      LocalDisplacement u;
      u.gather(covers->covers(e), nodal);
      add(n_per_cell, [&]() {
        points.add_spring(f,
                          amplitudes.fixed_points.empty()
                            ? 1.
                            : amplitudes.fixed_points[f],
                          u,
                          local);
      });
    }
    return energy;
  }


  void
  FiniteElasticity::evaluate_linearized(const Vector &u)
  {
    Data &d = *data;
    if (!d.active_elements.all())
      return;
    read_nodal_values(*d.covers, u, d.nodal);
    const std::vector<HyperelasticLaw::Response> at_rest = d.laws_at_rest();
    const auto [first, last] = d.covers->locally_owned_elements();
    // energies of strain and conditions, and the sum of squares of forces
    double      sums[3] = {0., 0., 0.};
    LocalSystem local;
    for (unsigned int e = first; e < last; ++e)
    {
      if (d.is_absent(e))
        continue;
      local.reset(d.n_per_cell, /* needs_matrix = */ false);
      d.add_linearized_volume(e,
                              at_rest[d.covers->manifold_mesh().region(e)],
                              local);
      sums[0] += local.energy;
      for (unsigned int i = 0; i < 2 * d.n_per_cell; ++i)
        sums[2] += local.rhs[i] * local.rhs[i];
    }
    sums[1] = d.add_linearized_conditions(sums[2]);
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 3),
                                d.covers->communicator(),
                                dealii::ArrayView<double>(sums, 3));
    d.energies            = Energies();
    d.energies.strain     = sums[0];
    d.energies.conditions = sums[1];
    d.force_scale         = std::hypot(std::sqrt(sums[2]), d.least_force_scale);
  }


  double
  FiniteElasticity::linearized_condition_energy(const Vector &u)
  {
    read_nodal_values(*data->covers, u, data->nodal);
    double square = 0.;
    return dealii::Utilities::MPI::sum(data->add_linearized_conditions(square),
                                       data->covers->communicator());
  }
} // namespace NMM
