#include <nmm/analysis/equilibrium.h>
#include <nmm/base/exceptions.h>

#include <algorithm>
#include <analysis/mechanism.h>
#include <analysis/staged_loads.h>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace
  {
    std::string
    describe(const double load_factor)
    {
      std::ostringstream text;
      text << "load factor " << load_factor;
      return text.str();
    }
  } // namespace


  NewtonParameters
  newton_at_rest(const NewtonParameters &given, const bool is_rough)
  {
    if (!is_rough)
      return given;
    const NewtonParameters defaults = NewtonParameters();
    NewtonParameters       newton = ContactStatics::default_newton_parameters();
    newton.residual_tolerance     = given.residual_tolerance;
    if (given.energy_tolerance != defaults.energy_tolerance)
      newton.energy_tolerance = given.energy_tolerance;
    if (given.max_iterations != defaults.max_iterations)
      newton.max_iterations = given.max_iterations;
    newton.after_iteration = given.after_iteration;
    return newton;
  }


  struct Equilibrium::Data
  {
    Data(const Solid                 &solid,
         const ElasticityProblem     &problem,
         const EquilibriumParameters &parameters,
         ContactModel                *contact)
      : solid(solid)
      , problem(problem)
      , contact(contact)
      // Blocks without supports are allowed if there is contact, which may hold them.
      , elasticity(solid.covers(),
                   solid.quadrature(),
                   solid.constraints(),
                   problem,
                   /* may_float = */ contact != nullptr)
      , loads(std::make_shared<internal::StagedLoads>(problem, parameters.full))
    {
      loading.amplitudes = [loads = loads](const double load_factor) {
        return loads->at(load_factor);
      };
      term    = make_solid(elasticity, parameters.kinematics, loading);
      further = std::make_unique<FurtherTerms>(parameters.further_terms,
                                               solid,
                                               term->layout());
      newton  = newton_at_rest(parameters.newton,
                              contact != nullptr ||
                                term->inelastic_terms() != nullptr ||
                                !parameters.further_terms.empty());
      make_equations();
    }

    void
    make_equations()
    {
      if (contact != nullptr)
        touching = std::make_unique<ContactStatics>(*term,
                                                    contact->contact(),
                                                    newton,
                                                    further->pointers());
      else
        alone = std::make_unique<NonlinearStatics>(*term,
                                                   newton,
                                                   further->pointers());
    }

    const Solid                           &solid;
    const ElasticityProblem               &problem;
    ContactModel                          *contact;
    FiniteElasticity                       elasticity;
    std::shared_ptr<internal::StagedLoads> loads;
    Loading                                loading;
    std::unique_ptr<SolidTerm>             term;
    std::unique_ptr<FurtherTerms>          further;
    NewtonParameters                       newton;
    /// @{
    /// One of both is null.
    std::unique_ptr<NonlinearStatics> alone;
    std::unique_ptr<ContactStatics>   touching;
    /// @}
    double       reached = 0., friction_work = 0., material_work = 0.;
    unsigned int n_steps = 0;

    const LoadStep &
    last_attempt() const
    {
      return touching ? touching->last_attempt() : alone->last_attempt();
    }

    /// Takes account of a step with contact. @throws NumericalFailure for a deep penetration.
    void
    take(const ContactStep &step)
    {
      const std::string fault =
        contact->find_deep_penetration(step.contact.largest_penetration);
      AssertThrow(fault.empty(),
                  NumericalFailure("There is " + fault,
                                   describe(step.load_factor),
                                   "choose a higher 'Contact/Normal "
                                   "stiffness', or loads that the solid can "
                                   "bear"));
      friction_work += step.dissipated;
      contact->take_state(friction_work);
    }

    /// Completes the message of @p error by the block that is not held, if there is one.
    [[noreturn]] void
    explain(const NumericalFailure &error);

    /// Checks that supports which are not released in @p loads hold all blocks, if nothing else can.
    /// @throws NumericalFailure that names a block.
    void
    check_that_supports_hold(const LoadAmplitudes &loads) const;

    /// Checks that no block is without contact if only contact holds blocks. @throws
    /// NumericalFailure with @p reason and the block.
    void
    check_that_all_touch(const std::string &reason);
  };


  void
  Equilibrium::Data::explain(const NumericalFailure &error)
  {
    const internal::Mechanism mechanism = internal::find_mechanism(
      *touching, *term, contact->contact(), reached, solid.quadrature());
    const std::string reason =
      error.description() + ". " + mechanism.description;
    if (n_steps == 0)
      check_that_all_touch(reason);
    throw NumericalFailure(
      reason,
      error.place(),
      mechanism.does_anything_move
        ? "friction or cohesion are too low, or the block tips over or lifts "
          "off; hold it by displacement conditions, or let blocks move with "
          "'Model/Analysis = relaxation' or 'dynamic'"
        : "set a lower 'Contact/Shear stiffness' or a smaller 'Load "
          "steps/Smallest step', or let blocks move with "
          "'Model/Analysis = relaxation'");
  }


  void
  Equilibrium::Data::check_that_supports_hold(const LoadAmplitudes &loads) const
  {
    if (contact != nullptr || !further->pointers().empty())
      return;
    const auto keep = [](auto &list, const std::vector<bool> &released) {
      const auto all = std::exchange(list, {});
      for (std::size_t i = 0; i < all.size(); ++i)
        if (released.empty() || !released[i])
          list.push_back(all[i]);
    };
    ElasticityProblem left = problem;
    keep(left.boundary_conditions, loads.released_conditions);
    keep(left.fixed_points, loads.released_fixed_points);
    const FiniteElasticity check(solid.covers(),
                                 solid.quadrature(),
                                 solid.constraints(),
                                 left);
  }


  void
  Equilibrium::Data::check_that_all_touch(const std::string &reason)
  {
    std::string floating;
    try
    {
      const FiniteElasticity without_contact(solid.covers(),
                                             solid.quadrature(),
                                             solid.constraints(),
                                             problem);
    }
    catch (const NumericalFailure &error)
    {
      floating = error.message();
    }
    if (floating.empty())
      return;
    const Vector start = elasticity.initial_solution();
    Contact     &law   = contact->contact();
    law.set_time(0.);
    law.detect(start);
    law.assemble(start, false);
    AssertThrow(
      contact->all_are_touched(problem),
      NumericalFailure(reason +
                         ". Contact alone has to hold the solid, "
                         "and not all blocks touch what holds them: " +
                         floating,
                       "the first load step",
                       "let faces touch at the start, or "
                       "set 'Model/Analysis = relaxation'"));
  }


  Equilibrium::Equilibrium(const Solid                 &solid,
                           const ElasticityProblem     &problem,
                           const EquilibriumParameters &parameters,
                           ContactModel                *contact)
    : data(std::make_unique<Data>(solid, problem, parameters, contact))
  {
  }


  Equilibrium::~Equilibrium() = default;


  void
  Equilibrium::run(
    const LoadSteps                                                &steps,
    const std::function<void(const ContactStep &, const Vector &)> &after_step)
  {
    const auto finish = [&](const ContactStep &step, const Vector &u) {
      data->material_work += step.dissipated_by_material;
      data->reached = step.load_factor;
      ++data->n_steps;
      if (after_step)
        after_step(step, u);
    };
    if (data->alone)
    {
      data->alone->run(steps, [&](const LoadStep &step, const Vector &u) {
        ContactStep whole;
        static_cast<LoadStep &>(whole) = step;
        whole.dissipated_by_material   = data->alone->dissipated();
        finish(whole, u);
      });
      return;
    }
    LoadSteps with_contact = steps;
    // Small displacements are linear in the load as long as no contact state changes.
    if (data->term->kinematics() == Kinematics::small)
      with_contact.extrapolation_degree = 1;
    try
    {
      data->touching->run(with_contact,
                          [&](const ContactStep &step, const Vector &u) {
                            data->take(step);
                            finish(step, u);
                            data->contact->remember_states();
                          });
    }
    catch (const NumericalFailure &error)
    {
      // A solution that was found and not accepted, such as one behind a wall, has no mechanism.
      if (data->last_attempt().newton.converged)
        throw;
      data->explain(error);
    }
  }


  void
  Equilibrium::begin_stage(const StageChange &change)
  {
    if (change.loads)
      data->check_that_supports_hold(*change.loads);
    const double end = data->reached + 1.;
    data->loads->begin_stage(data->reached, end, change.loads);
    if (data->alone)
      data->alone->begin_stage(change, end);
    else
      data->touching->begin_stage(change, end);
  }


  void
  Equilibrium::run_stages(
    LoadSteps                                                       steps,
    const std::vector<StageChange>                                 &stages,
    const std::function<void(const ContactStep &, const Vector &)> &after_step,
    const std::function<void(unsigned int)>                        &begin)
  {
    run(steps, after_step);
    for (unsigned int i = 0; i < stages.size(); ++i)
    {
      if (begin)
        begin(i);
      begin_stage(stages[i]);
      for (double &load_factor : steps.load_factors)
        load_factor += 1.;
      run(steps, after_step);
    }
  }


  void
  Equilibrium::begin_anew()
  {
    data->alone.reset();
    data->touching.reset();
    if (data->contact != nullptr)
      data->contact->begin_anew();
    if (InelasticTerms *const inelastic = data->term->inelastic_terms())
      inelastic->forget_states();
    data->further->forget();
    data->loads->begin_anew();
    data->reached = data->friction_work = data->material_work = 0.;
    data->n_steps                                             = 0;
    data->make_equations();
  }


  void
  Equilibrium::continue_from(const double          load_factor,
                             const Vector         &u,
                             const ContactHistory &history,
                             const double          friction_work)
  {
    if (data->alone)
      data->alone->continue_from(load_factor, u);
    else
      data->touching->continue_from(load_factor, u, history);
    data->reached       = load_factor;
    data->friction_work = friction_work;
    ++data->n_steps;
  }


  const Equilibrium::Vector &
  Equilibrium::solution() const
  {
    return data->alone ? data->alone->solution() : data->touching->solution();
  }


  double
  Equilibrium::load_factor() const
  {
    return data->reached;
  }


  ElasticityProblem
  Equilibrium::problem_now() const
  {
    return problem_at(data->problem, data->loading.amplitudes(data->reached));
  }


  Equilibrium::Vector
  Equilibrium::initial_forces()
  {
    return data->touching
             ? data->touching->initial_forces()
             : StaticSystem(*data->term)
                 .initial_forces(data->elasticity.initial_solution(), 1.);
  }


  const LoadStep &
  Equilibrium::last_attempt() const
  {
    return data->last_attempt();
  }


  double
  Equilibrium::friction_work() const
  {
    return data->friction_work;
  }


  double
  Equilibrium::material_work() const
  {
    return data->material_work;
  }


  SolidTerm &
  Equilibrium::solid_term() const
  {
    return *data->term;
  }


  FurtherTerms &
  Equilibrium::further_terms() const
  {
    return *data->further;
  }
} // namespace NMM
