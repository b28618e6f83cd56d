#include <nmm/base/exceptions.h>
#include <nmm/mechanics/static_solid.h>

#include <cmath>
#include <limits>

namespace NMM
{
  StaticSolid::StaticSolid(FiniteElasticity &elasticity,
                           const bool        is_linearized)
    : elastic(&elasticity)
    , linearized(is_linearized)
    , unknowns(elasticity)
    , load_at(std::numeric_limits<double>::quiet_NaN())
  {
    const CoverSystem &covers = elasticity.cover_system();
    for (Vector *vector : {&owned, &load, &sum})
      vector->reinit(covers.locally_owned_dofs(2), covers.communicator());
    if (!elasticity.is_inelastic())
      return;
    AssertThrow(is_linearized,
                InputError("a material is inelastic, which is possible with "
                           "small displacements only",
                           "the static equations of large displacements",
                           "choose another law, or small kinematics"));
    inelastic = std::make_unique<InelasticTerms>(elasticity);
  }


  StaticSolid::~StaticSolid() = default;


  StepWork
  StaticSolid::commit(const Trial &step)
  {
    StepWork work;
    if (!inelastic)
      return work;
    inelastic->accept(*step.end);
    work.dissipated = inelastic->totals().dissipated;
    return work;
  }


  StaticSolid::Vector
  StaticSolid::residual_at(const Vector &u, const double load_factor)
  {
    AssembledForces forces;
    (void)assemble(Trial::at(u, load_factor), forces);
    return *forces.residual;
  }


  void
  StaticSolid::forget_states()
  {
    if (inelastic)
      inelastic->forget_states();
  }


  void
  StaticSolid::adapt_penalties(const Vector &u)
  {
    if (!linearized)
      elastic->adapt_penalties(u);
  }


  double
  StaticSolid::largest_jump() const
  {
    return linearized ? 0. : elastic->largest_jump();
  }


  InelasticTerms *
  StaticSolid::inelastic_terms() const
  {
    return inelastic.get();
  }


  FiniteElasticity &
  StaticSolid::elasticity() const
  {
    return *elastic;
  }


  bool
  StaticSolid::is_linearized() const
  {
    return linearized;
  }


  ForceProperties
  StaticSolid::properties() const
  {
    ForceProperties properties;
    properties.is_linear = linearized && inelastic == nullptr;
    properties.is_symmetric =
      !linearized ? elastic->tangent_is_symmetric()
                  : inelastic == nullptr || inelastic->totals().n_yielding == 0;
    properties.is_symmetric_between = properties.is_symmetric;
    return properties;
  }


  Deformation
  StaticSolid::assemble(const Trial &trial, AssembledForces &forces)
  {
    Assert(trial.begin == nullptr, dealii::ExcMessage("A solid at rest."));
    if (linearized)
      return assemble_linearized(trial, forces);
    const Deformation state = elastic->assemble(*trial.end,
                                                trial.end_time,
                                                trial.tangent,
                                                trial.increment);
    if (state != Deformation::admissible)
      return state;
    sum                         = elastic->residual();
    forces.residual             = &sum;
    forces.scale                = elastic->force_scale();
    energy                      = elastic->energies().strain;
    forces.strain_energy        = energy;
    forces.energy_of_conditions = elastic->energies().conditions;
    if (trial.tangent != Tangent::none)
      forces.tangent = &elastic->tangent();
    return state;
  }


  void
  StaticSolid::linearize(const double load_factor)
  {
    if (has_stiffness && load_at == load_factor)
      return;
    Vector zero(elastic->initial_solution());
    zero = 0.;
    // without loads, because small displacements have no tangent of follower pressure
    if (!has_stiffness)
      (void)elastic->assemble(zero, 0., Tangent::consistent);
    (void)elastic->assemble(zero, load_factor, Tangent::none);
    load          = elastic->residual();
    scale         = elastic->force_scale();
    has_stiffness = true;
    load_at       = load_factor;
  }


  Deformation
  StaticSolid::assemble_linearized(const Trial &trial, AssembledForces &forces)
  {
    linearize(trial.end_time);
    owned = *trial.end;
    elastic->tangent().vmult(sum, owned);
    // the diagonal entries of constrained unknowns are arbitrary
    elastic->affine_constraints().set_zero(sum);
    energy = 0.5 * (owned * sum);
    sum += load;
    const bool with_tangent = trial.tangent != Tangent::none;
    forces.residual         = &sum;
    forces.scale            = scale;
    if (with_tangent)
      forces.tangent = &elastic->tangent();
    if (inelastic)
    {
      if (inelastic->assemble(*trial.end, with_tangent) !=
          Deformation::admissible)
        return Deformation::inverted;
      sum += inelastic->residual();
      energy += inelastic->totals().energy;
      // forces due to initial stress balance each other as loads do
      forces.scale = std::hypot(scale, inelastic->totals().force_scale);
      if (with_tangent)
        forces.tangent = &inelastic->add_to(elastic->tangent());
    }
    forces.strain_energy = energy;
    return Deformation::admissible;
  }


  double
  StaticSolid::strain_energy() const
  {
    return energy;
  }
} // namespace NMM
