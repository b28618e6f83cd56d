#include <nmm/mechanics/solid_term.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace NMM
{
  FiniteSolid::FiniteSolid(FiniteElasticity             &elasticity,
                           Loading                       loading,
                           std::shared_ptr<const Matrix> mass)
    : SolidTerm(elasticity, std::move(loading), std::move(mass))
    , has_follower(!elasticity.tangent_is_symmetric())
  {
    finish_construction();
  }


  void
  FiniteSolid::damp(const RayleighDamping &damping, const bool is_conserving)
  {
    RayleighDamping by_matrix = damping;
    if (is_conserving)
      by_matrix.stiffness = 0.;
    SolidTerm::damp(by_matrix, is_conserving);
    damping_between = damping.stiffness - by_matrix.stiffness;
  }


  ForceProperties
  FiniteSolid::properties() const
  {
    return {/* is_linear = */ false,
            elastic->tangent_is_symmetric() && inelastic == nullptr,
            /* is_symmetric_between = */ false};
  }


  Deformation
  FiniteSolid::assemble_elasticity(const Trial &trial)
  {
    if (!trial.is_conserving)
    {
      set_amplitudes(amplitudes_at(trial.end_time));
      // the mixed integration point method is one for elastic materials
      return elastic->assemble(*trial.end,
                               1.,
                               trial.tangent,
                               inelastic ? nullptr : trial.increment);
    }
    const double         t_0 = trial.begin_time, t_1 = trial.end_time;
    const LoadAmplitudes first = amplitudes_at(t_0), last = amplitudes_at(t_1);
    set_amplitudes(amplitudes_at(0.5 * (t_0 + t_1)));
    const Deformation state =
      elastic->assemble_between(*trial.begin,
                                *trial.end,
                                trial.tangent,
                                &first,
                                &last,
                                damping_between > 0.
                                  ? damping_between / (t_1 - t_0)
                                  : 0.);
    dissipated_between = elastic->energies().dissipated;
    return state;
  }


  Deformation
  FiniteSolid::assemble(const Trial &trial, AssembledForces &forces)
  {
    elastic->restrict_to(trial.blocks());
    const Deformation state = assemble_elasticity(trial);
    elastic->restrict_to({});
    if (state != Deformation::admissible)
      return Deformation::inverted;
    sum = elastic->residual();
    add_base_force(trial.is_conserving
                     ? 0.5 * (trial.begin_time + trial.end_time)
                     : trial.end_time,
                   1.,
                   sum);
    forces.residual             = &sum;
    forces.scale                = elastic->force_scale();
    forces.strain_energy        = elastic->energies().strain;
    forces.energy_of_conditions = elastic->energies().conditions;
    if (damping() != nullptr)
      forces.damping.push_back(damping());
    const bool with_tangent = trial.tangent != Tangent::none;
    if (with_tangent)
      forces.tangent = &elastic->tangent();
    if (!inelastic)
      return Deformation::admissible;
    if (inelastic->assemble(*trial.end,
                            with_tangent,
                            is_between(trial) ? trial.begin : nullptr) !=
        Deformation::admissible)
      return Deformation::inverted;
    sum += inelastic->residual();
    forces.strain_energy += inelastic->totals().energy;
    if (with_tangent)
      forces.tangent = &inelastic->add_to(elastic->tangent());
    return Deformation::admissible;
  }


  StepFault
  FiniteSolid::find_fault(const Vector &)
  {
    StepFault fault;
    if (elastic->largest_jump() > FiniteElasticity::largest_good_jump)
    {
      fault.reason =
        "displacement conditions or ties that are missed by a "
        "good part of an element";
      fault.remedy =
        "let what is prescribed grow from where the solid is, in "
        "steps that it can follow";
    }
    return fault;
  }


  StepWork
  FiniteSolid::commit(const Trial &step)
  {
    AssertThrow(
      damping_between == 0. || step.begin == nullptr || step.is_conserving,
      InputError("The damping is that of conserving forces, and this step "
                 "has others",
                 "the damping by stiffness of a solid",
                 "call SolidTerm::damp() as the time scheme needs it"));
    StepWork work = SolidTerm::commit(step);
    work.dissipated += std::exchange(dissipated_between, 0.);
    return work;
  }


  void
  FiniteSolid::external_forces(const Vector &u, const double t, Vector &forces)
  {
    // dead loads do not depend on u and often not on t: then they are known already
    if (has_follower || !has_known || known_at != version() || loads_change())
    {
      // Loads that do not follow u are evaluated in the undeformed state, so that they are bitwise
      // the same in each call.
      const Vector &at = has_follower ? u : zero;
      known_forces.reinit(layout().locally_owned, layout().communicator);
      set_amplitudes(amplitudes_at(t, /* with_loads = */ false));
      if (elastic->assemble(at, 1., Tangent::none) == Deformation::admissible)
        known_forces = elastic->residual();
      set_amplitudes(amplitudes_at(t));
      if (elastic->assemble(at, 1., Tangent::none) == Deformation::admissible)
        known_forces -= elastic->residual();
      has_known = true;
      known_at  = version();
    }
    forces = known_forces;
    add_base_force(t, -1., forces);
  }


  double
  FiniteSolid::energy_of_conditions(const Vector         &u,
                                    const LoadAmplitudes &amplitudes)
  {
    set_amplitudes(amplitudes);
    return elastic->assemble(u, 1., Tangent::none) == Deformation::admissible
             ? elastic->energies().conditions
             : 0.;
  }


  double
  FiniteSolid::work_of_supports_between(const Trial &step, const Vector &)
  {
    if (!loads_change() || assemble_elasticity(step) != Deformation::admissible)
      return 0.;
    double work = elastic->energies().work_of_conditions;
    if (inelastic)
    {
      (void)inelastic->assemble(*step.end,
                                /* with_tangent = */ false,
                                step.begin);
      work +=
        work_on_inelastic(inelastic->totals(), step.begin_time, step.end_time);
    }
    return work;
  }
} // namespace NMM
