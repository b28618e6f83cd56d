#include <deal.II/base/mpi.h>

#include <cmath>
#include <mechanics/finite_elasticity_data.h>
#include <mechanics/nodal_values.h>

// Energies and forces of the theory of small displacements.
namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

  namespace
  {
    /// First Piola-Kirchhoff stress to the first order in the displacement gradient @p H,
    /// P_0 + A H [Pa].
    Tensor<2, 2>
    linear_stress(const HyperelasticLaw::Response &at_rest,
                  const Tensor<2, 2>              &H)
    {
      Tensor<2, 2> P = at_rest.stress;
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int b = 0; b < 4; ++b)
          P[a / 2][a % 2] += at_rest.tangent[a][b] * H[b / 2][b % 2];
      return P;
    }
  } // namespace


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


  double
  FiniteElasticity::Data::add_linearized_volume(
    const unsigned int               element,
    const HyperelasticLaw::Response &at_rest,
    LocalSystem                     &local) const
  {
    const ElementTables::View table = tables(element);
    LocalDisplacement         u;
    u.gather(covers->covers(element), nodal);
    double energy = 0.;
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const double(*g)[2]  = table.gradients + q * n_per_cell;
      const double       w = table.weights[q];
      const Tensor<2, 2> H = displacement_gradient(n_per_cell, u.values, g);
      const Tensor<2, 2> P = linear_stress(at_rest, H);
      energy += 0.5 * w * dealii::scalar_product(at_rest.stress + P, H);
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[2 * i + c] += w * (P[c][0] * g[i][0] + P[c][1] * g[i][1]);
    }
    return energy;
  }


  double
  FiniteElasticity::Data::add_linearized_weak_points(
    const EdgeTables::Site                       &site,
    const std::vector<HyperelasticLaw::Response> &at_rest,
    LocalSystem                                  &local) const
  {
    LocalDisplacement u;
    gather(site, nodal, u);
    double energy = 0.;
    for (unsigned int q = site.first_point; q < site.last_point; ++q)
    {
      const WeakPoint &point  = edges->weak_points[q];
      const bool       is_tie = point.condition == invalid_index;
      if (!is_tie && !amplitudes.released_conditions.empty() &&
          amplitudes.released_conditions[point.condition])
        continue;
      Tensor<1, 2> jump, traction;
      for (unsigned int k = 0; k < point.n_sides * n_per_cell; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          jump[c] += point.jump[k] * u.values[k][c];
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const WeakPoint::Side &side = point.sides[s];
        traction +=
          side.share *
          (linear_stress(at_rest[side.region],
                         displacement_gradient(n_per_cell,
                                               u.values + s * n_per_cell,
                                               side.gradients)) *
           point.normal);
      }
      Tensor<1, 2> d = point.projection * jump;
      if (!is_tie)
        d -= (amplitudes.boundary_conditions.empty()
                ? 1.
                : amplitudes.boundary_conditions[point.condition]) *
             point.prescribed;
      const double penalty = penalty_growth[q] * point.penalty;
      energy += point.weight * (0.5 * penalty * d.norm_square() - traction * d);
      const Tensor<1, 2> force =
        point.weight * (penalty * d - point.projection * traction);
      for (unsigned int k = 0; k < point.n_sides * n_per_cell; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[2 * k + c] += point.jump[k] * force[c];
    }
    return energy;
  }


  double
  FiniteElasticity::Data::add_linearized_conditions(double &square) const
  {
    const std::vector<HyperelasticLaw::Response> at_rest = laws_at_rest();
    const auto [first, last] = covers->locally_owned_elements();
    double      energy       = 0.;
    LocalSystem local;
    const auto  add = [&](const unsigned int n, const auto &energy_of) {
      local.reset(n);
      energy += energy_of();
      for (unsigned int i = 0; i < 2 * n; ++i)
        square += local.rhs[i] * local.rhs[i];
    };
    for (const EdgeTables::Site &site : edges->conditions)
      if (!is_absent(site.element))
        add(n_per_cell,
            [&]() { return add_linearized_weak_points(site, at_rest, local); });
    for (const EdgeTables::Site &tie : edges->ties)
      if (!is_absent(tie.element) && !is_absent(tie.neighbor))
        add(2 * n_per_cell,
            [&]() { return add_linearized_weak_points(tie, at_rest, local); });
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
        return add_fixed_point(*covers,
                               e,
                               problem->fixed_points[f],
                               points.stiffness(f),
                               amplitudes.fixed_points.empty()
                                 ? 1.
                                 : amplitudes.fixed_points[f],
                               u,
                               /* with_tangent = */ false,
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
      local.reset(d.n_per_cell);
      sums[0] +=
        d.add_linearized_volume(e,
                                at_rest[d.covers->manifold_mesh().region(e)],
                                local);
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
