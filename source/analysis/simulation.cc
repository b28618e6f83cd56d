#include <nmm/analysis/simulation.h>
#include <nmm/base/exceptions.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace NMM
{
  struct Simulation::Data
  {
    Data(Simulation &owner, const Solid &solid, SimulationParameters given)
      : owner(owner)
      , solid(solid)
      , given(std::move(given))
    {
      this->given.problem.check(solid.physical_mesh());
      if (this->given.contact)
        contact = std::make_unique<ContactModel>(solid,
                                                 this->given.problem,
                                                 *this->given.contact);
    }

    /// What the last analysis has left.
    enum class Phase
    {
      undeformed,
      at_rest,
      in_motion
    };

    Simulation                                          &owner;
    const Solid                                         &solid;
    SimulationParameters                                 given;
    std::unique_ptr<ContactModel>                        contact;
    std::vector<std::function<void(const Simulation &)>> observers;

    Phase phase = Phase::undeformed;
    /// @{
    /// The equations of the last analysis; one of both is null.
    std::unique_ptr<Equilibrium> rest;
    std::unique_ptr<Motion>      motion;
    /// @}
    /// @{
    /// The state between two analyses; vectors have owned unknowns.
    Vector            u, v;
    ContactHistory    history;
    std::vector<char> materials, of_terms;
    double            friction_work = 0., time = 0., load_factor = 0.;
    /// @}
    /// Blocks that are gone, and the load factor at which the present stage begins [-].
    std::vector<unsigned int> removed_blocks;
    double                    begin_of_stage = 0.;
    /// Whether a part of the forces on removed blocks is still held.
    bool holds_forces = false;
    /// The last StageChange::loads.
    std::optional<LoadAmplitudes> staged_loads;

    /// The loads in motion.
    Loading
    loading() const
    {
      return staged_loads ? loading_after_stage(given.loading, *staged_loads)
                          : given.loading;
    }

    void
    tell() const
    {
      for (const auto &observer : observers)
        observer(owner);
    }

    /// Stores the state and destroys the equations.
    void
    store();

    void
    begin_rest();

    /// @throws InputError if a part of the forces on removed blocks is held.
    void
    check_that_nothing_is_held() const;

    /// Begins a motion, or a relaxation with the loads of t = 0.
    void
    begin_motion(bool is_relaxation);

    /// The equations of a motion or relaxation from the present state.
    MotionParameters
    motion_parameters(bool is_relaxation) const;
  };


  void
  Simulation::Data::store()
  {
    if (!rest && !motion)
      return;
    InelasticTerms *terms = nullptr;
    u.reinit(solid.covers().locally_owned_dofs(2),
             solid.covers().communicator());
    v = u;
    if (rest)
    {
      u             = rest->solution();
      friction_work = rest->friction_work();
      load_factor   = rest->load_factor();
      terms         = rest->solid_term().inelastic_terms();
      of_terms      = rest->further_terms().save();
    }
    else
    {
      u        = motion->integrator().state().u;
      v        = motion->integrator().state().v;
      terms    = motion->solid_term().inelastic_terms();
      of_terms = motion->further_terms().save();
      if (contact)
        friction_work = motion->contact_account()->friction_work();
    }
    materials =
      terms != nullptr ? terms->internal_state() : std::vector<char>();
    if (contact)
      history = contact->contact().history();
    rest.reset();
    motion.reset();
  }


  void
  Simulation::Data::begin_rest()
  {
    if (rest)
      return;
    store();
    AssertThrow(phase == Phase::undeformed ||
                  (materials.empty() && removed_blocks.empty() &&
                   !staged_loads),
                InputError("materials that yield, or a solid whose blocks, "
                           "loads or supports a stage has changed, have moved",
                           "Simulation::equilibrate()",
                           "use Simulation::relax()"));
    if (contact)
      contact->hold_obstacles(false);
    EquilibriumParameters how;
    how.kinematics    = given.kinematics;
    how.newton        = given.newton;
    how.further_terms = given.further_terms;
    rest =
      std::make_unique<Equilibrium>(solid, given.problem, how, contact.get());
    if (phase == Phase::undeformed)
      return;
    rest->continue_from(1., u, history, friction_work);
    rest->further_terms().restore(of_terms);
    begin_of_stage = 0.;
  }


  MotionParameters
  Simulation::Data::motion_parameters(const bool is_relaxation) const
  {
    const bool is_rough =
      contact != nullptr ||
      std::any_of(given.problem.materials.begin(),
                  given.problem.materials.end(),
                  [this](const Material &material) {
                    return material.inelastic_law(given.problem.plane_state) !=
                           nullptr;
                  });
    MotionParameters how;
    how.kinematics    = given.kinematics;
    how.newton        = newton_in_motion(given.newton, is_rough);
    how.further_terms = given.further_terms;
    if (is_relaxation)
    {
      const Loading        now = loading();
      const LoadAmplitudes amplitudes =
        now.amplitudes ? now.amplitudes(0.) : LoadAmplitudes();
      how.loading.amplitudes = [amplitudes](double) { return amplitudes; };
      how.scheme             = TimeScheme::constant_acceleration();
      how.contact_update     = ContactUpdate::every_step;
      return how;
    }
    how.absorbs = true;
    how.loading = loading();
    how.damping = given.damping;
    how.scheme  = given.scheme ? *given.scheme
                  : contact != nullptr || given.kinematics == Kinematics::finite
                    ? TimeScheme::energy_momentum()
                    : TimeScheme::newmark();
    return how;
  }


  void
  Simulation::Data::check_that_nothing_is_held() const
  {
    AssertThrow(!holds_forces,
                InputError("a part of the forces on removed blocks is still "
                           "held, which a motion cannot do",
                           "Simulation::apply()",
                           "release all of them before, by a stage with "
                           "StageChange::released = 1 and equilibrate()"));
  }


  void
  Simulation::Data::begin_motion(const bool is_relaxation)
  {
    check_that_nothing_is_held();
    store();
    if (contact)
      contact->hold_obstacles(is_relaxation);
    motion = std::make_unique<Motion>(solid,
                                      given.problem,
                                      motion_parameters(is_relaxation),
                                      contact.get());
    if (phase == Phase::undeformed)
      return;
    if (contact)
      motion->contact_account()->continue_from(history, friction_work);
    if (InelasticTerms *const terms = motion->solid_term().inelastic_terms())
      terms->restore_internal_state(materials);
    motion->further_terms().restore(of_terms);
    motion->start(u,
                  is_relaxation ? motion->zero() : v,
                  is_relaxation ? 0. : time);
    if (!removed_blocks.empty())
      motion->integrator().drop_blocks(removed_blocks);
  }


  Simulation::Simulation(const Solid &solid, SimulationParameters parameters)
    : data(std::make_unique<Data>(*this, solid, std::move(parameters)))
  {
  }


  Simulation::~Simulation() = default;


  void
  Simulation::observe(std::function<void(const Simulation &)> observer)
  {
    data->observers.push_back(std::move(observer));
  }


  void
  Simulation::equilibrate(const LoadSteps &steps)
  {
    data->begin_rest();
    data->phase        = Data::Phase::at_rest;
    LoadSteps absolute = steps;
    for (double &factor : absolute.load_factors)
      factor += data->begin_of_stage;
    // the state of a motion is an equilibrium only after a step with all loads
    if (data->rest->load_factor() >= absolute.load_factors.front())
      absolute.leaves_out_reached = false;
    data->rest->run(absolute, [&](const ContactStep &step, const Vector &) {
      data->load_factor = step.load_factor;
      data->tell();
    });
  }


  RelaxationReport
  Simulation::relax(const RelaxationParameters &parameters)
  {
    data->begin_motion(/* is_relaxation = */ true);
    data->phase = Data::Phase::at_rest;
    const RelaxationReport report =
      NMM::relax(data->motion->integrator(),
                 parameters,
                 [&](const StepRecord &) { data->tell(); });
    AssertThrow(!report.moves_away,
                NumericalFailure("The solid does not come to rest: it has "
                                 "moved by more than the largest displacement",
                                 "Simulation::relax()",
                                 "hold it, or raise "
                                 "RelaxationParameters::max_displacement"));
    return report;
  }


  void
  Simulation::advance(const double duration, const StepControlParameters &steps)
  {
    if (!data->motion || data->phase != Data::Phase::in_motion)
      data->begin_motion(/* is_relaxation = */ false);
    data->phase      = Data::Phase::in_motion;
    const double end = data->time + duration;
    StepControl(steps).run(data->motion->integrator(),
                           end,
                           [&](const StepRecord &) {
                             data->time =
                               data->motion->integrator().state().time;
                             data->tell();
                             return true;
                           });
  }


  void
  Simulation::apply(const StageChange &change)
  {
    AssertThrow(data->rest != nullptr,
                InputError("a stage begins in a state that is no equilibrium",
                           "Simulation::apply()",
                           "call equilibrate() before"));
    data->rest->begin_stage(change);
    data->begin_of_stage = data->rest->load_factor();
    data->removed_blocks.insert(data->removed_blocks.end(),
                                change.removed_blocks.begin(),
                                change.removed_blocks.end());
    data->holds_forces = change.released < 1.;
    if (change.loads)
      data->staged_loads = change.loads;
  }


  SafetyFactor
  Simulation::find_safety_factor(const RelaxationParameters   &trial,
                                 const SafetyFactorParameters &search)
  {
    data->check_that_nothing_is_held();
    data->store();
    StrengthReductionParameters parameters;
    parameters.search = search;
    parameters.trial  = trial;
    parameters.motion = data->motion_parameters(/* is_relaxation = */ true);
    StrengthReduction reduction(data->solid,
                                data->given.problem,
                                parameters,
                                data->contact.get());
    if (data->phase != Data::Phase::undeformed)
      reduction.start_from({data->u,
                            data->history,
                            data->materials,
                            data->of_terms,
                            data->removed_blocks});
    const SafetyFactor result = reduction.find();
    if (data->contact)
      data->contact->begin_anew();
    return result;
  }


  const Solid &
  Simulation::solid() const
  {
    return data->solid;
  }


  const ElasticityProblem &
  Simulation::problem() const
  {
    return data->given.problem;
  }


  ContactModel *
  Simulation::contact() const
  {
    return data->contact.get();
  }


  double
  Simulation::load_factor() const
  {
    return data->load_factor;
  }


  double
  Simulation::time() const
  {
    return data->time;
  }


  Simulation::Vector
  Simulation::displacement() const
  {
    if (data->rest)
      return data->rest->solution();
    if (data->motion)
      return data->motion->displacement();
    Vector result(data->solid.covers().locally_owned_dofs(2),
                  data->solid.covers().locally_relevant_dofs(2),
                  data->solid.covers().communicator());
    if (data->phase != Data::Phase::undeformed)
      result = data->u;
    return result;
  }


  DisplacementField
  Simulation::field() const
  {
    return DisplacementField(data->solid.covers(),
                             data->given.problem,
                             displacement());
  }
} // namespace NMM
