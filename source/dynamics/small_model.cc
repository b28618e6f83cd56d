#include <nmm/dynamics/elastic_models.h>

namespace NMM
{
  SmallModel::SmallModel(FiniteElasticity           &elasticity,
                         const QuadratureCollection &mass_quadrature,
                         Loading                     loading,
                         const GhostPenalty         *ghost_penalty)
    : ElasticModel(elasticity,
                   mass_quadrature,
                   std::move(loading),
                   ghost_penalty)
  {
    for (Vector *vector : {&owned, &forces, &load})
      vector->reinit(locally_owned(), communicator());
  }


  void
  SmallModel::update(const double t)
  {
    const bool is_changed = set_amplitudes(amplitudes_at(t));
    if (!has_stiffness || stiffness_at != version())
    {
      // without loads: the tangent of follower pressure is none of `small`'s
      (void)elasticity->assemble(zero, 0., Tangent::consistent);
      stiffness_at  = version();
      has_stiffness = true;
      has_load      = false;
    }
    if (!has_load || is_changed)
    {
      (void)elasticity->assemble(zero, 1., Tangent::none);
      load = elasticity->residual();
      load *= -1.;
      has_load = true;
    }
  }


  const SmallModel::Matrix &
  SmallModel::stiffness_at_rest()
  {
    update(0.);
    return elasticity->tangent();
  }


  ForceProperties
  SmallModel::force_properties() const
  {
    return {/* is_linear = */ true,
            /* is_symmetric = */ true,
            /* is_symmetric_between = */ true};
  }


  Deformation
  SmallModel::assemble(const Vector &u,
                       const double  t,
                       const Tangent,
                       const Vector *)
  {
    owned = u;
    return assemble_owned(t);
  }


  Deformation
  SmallModel::assemble_owned(const double t)
  {
    update(t);
    elasticity->tangent().vmult(forces, owned);
    // unknowns that are constrained or absent have a diagonal entry of their own
    constraints().set_zero(forces);
    for (const auto i : absent)
      forces(i) = 0.;
    forces.compress(dealii::VectorOperation::insert);
    strain_energy = 0.5 * (owned * forces);
    forces -= load;
    add_base_force(t, 1., forces);
    return Deformation::admissible;
  }


  Deformation
  SmallModel::assemble_between(const Vector &begin,
                               const Vector &end,
                               const double  t_0,
                               const double  t_1,
                               const Tangent)
  {
    owned  = begin;
    forces = end;
    owned.sadd(0.5, 0.5, forces);
    return assemble_owned(0.5 * (t_0 + t_1));
  }


  const SmallModel::Vector &
  SmallModel::residual() const
  {
    return forces;
  }


  SmallModel::Energies
  SmallModel::energies() const
  {
    return {strain_energy, 0.};
  }


  void
  SmallModel::external_forces(const Vector &, const double t, Vector &result)
  {
    update(t);
    result = load;
    add_base_force(t, -1., result);
  }


  double
  SmallModel::work_of_supports(const Vector &,
                               const double,
                               const double,
                               const double)
  {
    return 0.;
  }
} // namespace NMM
