#include <nmm/dynamics/elastic_models.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace NMM
{
  FiniteModel::FiniteModel(FiniteElasticity           &elasticity,
                           const QuadratureCollection &mass_quadrature,
                           Loading                     loading)
    : ElasticModel(elasticity, mass_quadrature, std::move(loading), nullptr)
    , has_follower(!elasticity.tangent_is_symmetric())
  {
  }


  bool
  FiniteModel::set_stiffness_damping(const double coefficient)
  {
    damping = coefficient;
    return true;
  }


  ForceProperties
  FiniteModel::force_properties() const
  {
    return {/* is_linear = */ false,
            elasticity->tangent_is_symmetric(),
            /* is_symmetric_between = */ false};
  }


  Deformation
  FiniteModel::assemble(const Vector &u,
                        const double  t,
                        const Tangent tangent,
                        const Vector *increment)
  {
    set_amplitudes(amplitudes_at(t));
    const Deformation state = elasticity->assemble(u, 1., tangent, increment);
    if (state == Deformation::admissible)
    {
      sum = elasticity->residual();
      add_base_force(t, 1., sum);
    }
    return state;
  }


  Deformation
  FiniteModel::assemble_between(const Vector &begin,
                                const Vector &end,
                                const double  t_0,
                                const double  t_1,
                                const Tangent tangent)
  {
    const double         t     = 0.5 * (t_0 + t_1);
    const LoadAmplitudes first = amplitudes_at(t_0), last = amplitudes_at(t_1);
    set_amplitudes(amplitudes_at(t));
    const Deformation state =
      elasticity->assemble_between(begin,
                                   end,
                                   tangent,
                                   &first,
                                   &last,
                                   damping > 0. ? damping / (t_1 - t_0) : 0.);
    dissipated_between = elasticity->energies().dissipated;
    if (state == Deformation::admissible)
    {
      sum = elasticity->residual();
      add_base_force(t, 1., sum);
    }
    return state;
  }


  const FiniteModel::Vector &
  FiniteModel::residual() const
  {
    return sum;
  }


  FiniteModel::Energies
  FiniteModel::energies() const
  {
    return {elasticity->energies().strain, elasticity->energies().conditions};
  }


  StepFault
  FiniteModel::find_fault(const Vector &)
  {
    StepFault fault;
    if (elasticity->largest_jump() > FiniteElasticity::largest_good_jump)
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


  /// Without assemble_between(), in schemes that do not conserve, the result is 0.
  double
  FiniteModel::accept_step(const Vector &, const double)
  {
    return std::exchange(dissipated_between, 0.);
  }


  void
  FiniteModel::external_forces(const Vector &u, const double t, Vector &forces)
  {
    // dead loads do not depend on u and often not on t: then they are known already
    if (has_follower || !has_known || known_at != version() || loads_change())
    {
      // Loads that do not follow u are evaluated in the undeformed state, so that they are bitwise
      // the same in each call.
      const Vector &at = has_follower ? u : zero;
      known_forces.reinit(locally_owned(), communicator());
      set_amplitudes(amplitudes_at(t, /* with_loads = */ false));
      if (elasticity->assemble(at, 1., Tangent::none) ==
          Deformation::admissible)
        known_forces = elasticity->residual();
      set_amplitudes(amplitudes_at(t));
      if (elasticity->assemble(at, 1., Tangent::none) ==
          Deformation::admissible)
        known_forces -= elasticity->residual();
      has_known = true;
      known_at  = version();
    }
    forces = known_forces;
    add_base_force(t, -1., forces);
  }


  double
  FiniteModel::energy_of_conditions(const Vector         &u,
                                    const LoadAmplitudes &amplitudes)
  {
    set_amplitudes(amplitudes);
    return elasticity->assemble(u, 1., Tangent::none) == Deformation::admissible
             ? elasticity->energies().conditions
             : 0.;
  }


  double
  FiniteModel::work_of_supports_between(const Vector &begin,
                                        const Vector &end,
                                        const Vector &,
                                        const double t_0,
                                        const double t_1)
  {
    return loads_change() &&
               assemble_between(begin, end, t_0, t_1, Tangent::none) ==
                 Deformation::admissible
             ? elasticity->energies().work_of_conditions
             : 0.;
  }
} // namespace NMM
