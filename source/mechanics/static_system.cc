#include <nmm/base/exceptions.h>
#include <nmm/mechanics/static_system.h>

#include <algorithm>

namespace NMM
{
  namespace
  {
    std::vector<ForceTerm *>
    list_of(SolidTerm &solid, const std::vector<ForceTerm *> &others)
    {
      std::vector<ForceTerm *> terms = {&solid};
      terms.insert(terms.end(), others.begin(), others.end());
      return terms;
    }
  } // namespace


  StaticSystem::StaticSystem(SolidTerm                      &solid,
                             const std::vector<ForceTerm *> &others)
    : solid_term(&solid)
    , model(solid.layout(), list_of(solid, others))
  {
    if (solid.inelastic_terms() == nullptr)
      return;
    Vector zero(solid.elasticity().initial_solution());
    zero                      = 0.;
    InelasticTerms &inelastic = *solid.inelastic_terms();
    AssertThrow(inelastic.assemble(zero, /* with_tangent = */ false) ==
                  Deformation::admissible,
                NumericalFailure("The initial stress of a material that yields "
                                 "cannot be brought to its yield surface",
                                 "the undeformed state",
                                 "give an initial stress that is within the "
                                 "material's strength"));
    held_forces = inelastic.residual();
  }


  void
  StaticSystem::set_load_factor(const double load_factor)
  {
    factor = load_factor;
  }


  void
  StaticSystem::begin_step(const Vector &u,
                           const double  from,
                           const Vector &predicted,
                           const double  to)
  {
    set_load_factor(to);
    model.begin_step({u,
                      predicted,
                      from,
                      to - from,
                      /* imbalance = */ 0.,
                      /* is_at_rest = */ true});
  }


  Deformation
  StaticSystem::assemble(const Vector &u,
                         const Tangent tangent,
                         const Vector *increment,
                         const BlockSelection & /*blocks*/)
  {
    Trial trial             = Trial::at(u, factor, tangent, increment);
    trial.with_energies     = false;
    const Deformation state = model.assemble(trial);
    if (state != Deformation::admissible)
      return state;
    const AssembledForces &forces = model.forces();
    if (held_forces.size() > 0)
      forces.residual->add(-std::max(0., 1. - std::max(factor, largest_factor)),
                           held_forces);
    result.residual        = forces.residual;
    result.force_scale     = forces.scale;
    result.force_rounding  = forces.rounding;
    result.tangent         = forces.tangent;
    result.is_symmetric    = model.properties().is_symmetric;
    result.pattern_version = forces.pattern_version;
    return state;
  }


  void
  StaticSystem::hold_initial_forces(const Vector &u)
  {
    AssertThrow(model.assemble(Trial::at(u, 0.)) == Deformation::admissible,
                NumericalFailure("Forces cannot be computed",
                                 "the undeformed state",
                                 "check initial stresses and the positions of "
                                 "supports"));
    held_forces = *model.forces().residual;
  }


  StepWork
  StaticSystem::commit(const Vector &u)
  {
    largest_factor = std::max(largest_factor, factor);
    return model.commit(Trial::at(u, factor));
  }


  void
  StaticSystem::begin_anew()
  {
    largest_factor = 0.;
    model.forget();
  }
} // namespace NMM
