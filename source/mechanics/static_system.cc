#include <nmm/base/exceptions.h>
#include <nmm/mechanics/static_system.h>

#include <algorithm>
#include <string>

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
    initial.forces = inelastic.residual();
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
    const AssembledForces &forces  = model.forces();
    const double           reached = std::max(factor, largest_factor);
    if (initial.forces.size() > 0)
      forces.residual->add(-initial.share(reached), initial.forces);
    for (const Held &held : removed)
      forces.residual->add(-held.share(reached), held.forces);
    result.residual        = forces.residual;
    result.force_scale     = forces.scale;
    result.force_rounding  = forces.rounding;
    result.tangent         = forces.tangent;
    result.is_symmetric    = model.properties().is_symmetric;
    result.pattern_version = forces.pattern_version;
    return state;
  }


  double
  StaticSystem::Held::share(const double load_factor) const
  {
    const double s = std::clamp((load_factor - begin) / (end - begin), 0., 1.);
    return at_begin + s * (at_end - at_begin);
  }


  const StaticSystem::Vector &
  StaticSystem::assemble_residual(const Vector &u,
                                  const double  load_factor,
                                  const char   *where)
  {
    AssertThrow(model.assemble(Trial::at(u, load_factor)) ==
                  Deformation::admissible,
                NumericalFailure("Forces cannot be computed",
                                 where,
                                 "check initial stresses and the positions of "
                                 "supports"));
    return *model.forces().residual;
  }


  const StaticSystem::Vector &
  StaticSystem::initial_forces(const Vector &u, const double load_factor)
  {
    return assemble_residual(u, load_factor, "the undeformed state");
  }


  void
  StaticSystem::hold_initial_forces(const Vector &u)
  {
    initial.forces = initial_forces(u, 0.);
  }


  void
  StaticSystem::begin_stage(const StageChange &change,
                            const Vector      &u,
                            const double       begin,
                            const double       end)
  {
    const std::string where =
      "the stage that begins at load factor " + std::to_string(begin);
    const bool removes_anything =
      !change.removed_blocks.empty() || solid_term->loses_supports_at(begin);
    // the least share of what was removed earlier; what goes now begins with 0
    double before = removed.empty() || removes_anything ? 0. : 1.;
    for (const Held &held : removed)
      before = std::min(before, 1. - held.share(begin));
    AssertThrow(change.released >= before && change.released <= 1.,
                InputError("the share of tractions that is released is " +
                             std::to_string(change.released),
                           where,
                           "give a number from " + std::to_string(before) +
                             ", which are released already, to 1"));
    const unsigned int n_blocks = solid_term->layout().n_blocks;
    is_removed.resize(n_blocks, false);
    for (const unsigned int block : change.removed_blocks)
    {
      AssertThrow(block < n_blocks && !is_removed[block],
                  InputError("block " + std::to_string(block) +
                               (block < n_blocks ? " is gone already"
                                                 : " does not exist"),
                             where,
                             "remove blocks that are there"));
      is_removed[block] = true;
    }
    for (Held &held : removed)
      held = {held.forces,
              begin,
              end,
              held.share(begin),
              std::min(held.share(begin), 1. - change.released)};
    if (!removes_anything)
      return;
    // In equilibrium the residual is what removed blocks and supports have exerted on the rest. What
    // was held before is a part of that equilibrium.
    model.set_absent_blocks(is_removed);
    Held held{assemble_residual(u, begin, "the beginning of a stage"),
              begin,
              end,
              1.,
              1. - change.released};
    if (initial.forces.size() > 0)
      held.forces.add(-initial.share(std::max(begin, largest_factor)),
                      initial.forces);
    for (const Held &earlier : removed)
      held.forces.add(-earlier.share(begin), earlier.forces);
    removed.push_back(held);
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
    removed.clear();
    is_removed.clear();
    model.set_absent_blocks({});
    model.forget();
  }
} // namespace NMM
