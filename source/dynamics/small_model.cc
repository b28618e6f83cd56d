#include <nmm/dynamics/elastic_models.h>

#include <cmath>

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
    if (elasticity.is_inelastic())
      inelastic = std::make_unique<InelasticTerms>(elasticity);
  }


  SmallModel::~SmallModel() = default;


  void
  SmallModel::update(const double t)
  {
    const bool is_changed = set_amplitudes(amplitudes_at(t));
    if (!has_stiffness || stiffness_at != version())
    {
      // without loads, because small displacements have no tangent of follower pressure
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
    const bool is_elastic = inelastic == nullptr;
    return {/* is_linear = */ is_elastic,
            /* is_symmetric = */ is_elastic,
            /* is_symmetric_between = */ is_elastic};
  }


  const SmallModel::Matrix &
  SmallModel::tangent() const
  {
    return current_tangent != nullptr ? *current_tangent
                                      : elasticity->tangent();
  }


  double
  SmallModel::force_scale() const
  {
    const double scale = ElasticModel::force_scale();
    return inelastic ? std::hypot(scale, inelastic->totals().force_scale)
                     : scale;
  }


  InelasticTerms *
  SmallModel::inelastic_terms() const
  {
    return inelastic.get();
  }


  void
  SmallModel::begin_step(const Vector &begin,
                         const Vector &,
                         const double,
                         const double)
  {
    if (!inelastic)
      return;
    // the result is admissible, because an accepted state always has a stress
    (void)inelastic->assemble(begin, /* with_tangent = */ false);
    forces_at_begin = inelastic->residual();
    energy_at_begin = inelastic->totals().energy;
    begin_of_step   = begin;
  }


  double
  SmallModel::accept_step(const Vector &end, const double)
  {
    // no step has begun if a state has just been set
    if (!inelastic || begin_of_step.size() == 0)
      return 0.;
    inelastic->accept(end);
    Vector motion(end), force(inelastic->residual());
    motion -= begin_of_step;
    force.sadd(0.5, 0.5, forces_at_begin);
    Vector owned_motion(force);
    owned_motion = motion;
    return force * owned_motion -
           (inelastic->totals().energy - energy_at_begin);
  }


  std::vector<char>
  SmallModel::internal_state() const
  {
    return inelastic ? inelastic->internal_state() : std::vector<char>();
  }


  void
  SmallModel::restore_internal_state(const std::vector<char> &state)
  {
    if (inelastic)
      inelastic->restore_internal_state(state);
  }


  Deformation
  SmallModel::add_inelastic(const Vector &u,
                            const double  share,
                            const bool    with_tangent)
  {
    if (inelastic->assemble(u, with_tangent) != Deformation::admissible)
      return Deformation::inverted;
    forces.add(share, inelastic->residual());
    strain_energy += inelastic->totals().energy;
    if (with_tangent)
      current_tangent = &inelastic->add_to(elasticity->tangent());
    return Deformation::admissible;
  }


  Deformation
  SmallModel::assemble(const Vector &u,
                       const double  t,
                       const Tangent tangent,
                       const Vector *)
  {
    owned = u;
    assemble_owned(t);
    return inelastic ? add_inelastic(u, 1., tangent != Tangent::none)
                     : Deformation::admissible;
  }


  void
  SmallModel::assemble_owned(const double t)
  {
    update(t);
    elasticity->tangent().vmult(forces, owned);
    // the diagonal entries of constrained and absent unknowns are arbitrary
    constraints().set_zero(forces);
    for (const auto i : absent)
      forces(i) = 0.;
    forces.compress(dealii::VectorOperation::insert);
    strain_energy = 0.5 * (owned * forces);
    forces -= load;
    add_base_force(t, 1., forces);
  }


  Deformation
  SmallModel::assemble_between(const Vector &begin,
                               const Vector &end,
                               const double  t_0,
                               const double  t_1,
                               const Tangent tangent)
  {
    owned  = begin;
    forces = end;
    owned.sadd(0.5, 0.5, forces);
    assemble_owned(0.5 * (t_0 + t_1));
    if (!inelastic)
      return Deformation::admissible;
    forces.add(0.5, forces_at_begin);
    // Mean of the forces at both ends. Its derivative with respect to the mean displacement is
    // that of the force at the end with respect to the end.
    return add_inelastic(end, 0.5, tangent != Tangent::none);
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
