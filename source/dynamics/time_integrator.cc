#include <nmm/base/exceptions.h>
#include <nmm/dynamics/time_integrator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <dynamics/energy_account.h>
#include <dynamics/step_equations.h>
#include <linear_algebra/direct_solver.h>
#include <sstream>

namespace NMM
{
  using internal::DirectSolver;
  using Vector = TimeIntegrator::Vector;

  NewtonParameters
  TimeIntegrator::default_newton_parameters()
  {
    NewtonParameters parameters;
    // The initial guess is so close to the solution that the energy of the first correction
    // is no useful reference.
    parameters.energy_tolerance = 1.;
    // The force scale may be much larger than inertia forces, whose moments have to be accurate.
    parameters.n_refinements       = 1;
    parameters.n_robust_iterations = 1;
    // Finding which of many contact points stick takes many iterations, however short the step is.
    // The last of them concern few blocks and are cheap, while a step that is cut is lost.
    parameters.max_iterations = 40;
    return parameters;
  }


  /// The state, and what carries it from step to step.
  struct TimeIntegrator::Data
  {
    Data(MechanicalModel        &model,
         const TimeScheme       &scheme,
         const NewtonParameters &newton)
      : model(&model)
      , newton(newton)
      , equations(model, state, scheme)
      , account(model, state)
    {
      set_absent_blocks();
    }

    void
    set_absent_blocks();

    void
    assemble_state(const std::string &where, const std::string &remedy);

    void
    set_accelerations();

    /// Compute energies and momenta of the current state, whose forces were the last ones assembled.
    void
    take_account()
    {
      account.take(equations.static_forces());
    }

    /// Kinetic and stored energy of the state [J/m].
    double
    energy() const
    {
      return account.account().kinetic + account.stored();
    }

    void
    predict(double h);

    void
    solve_linear();

    void
    solve_nonlinear(StepReport &report, double residual_tolerance);

    void
    measure(StepReport &report) const;

    void
    let_sleep();

    /// ", with the largest force out of balance at (1, 2)", in the reference configuration; empty
    /// without positions. Collective.
    std::string
    place_of_largest_force() const;

    MechanicalModel        *model;
    DynamicState            state;
    NewtonSolver            newton;
    internal::StepEquations equations;
    internal::EnergyAccount account;

    std::unique_ptr<DirectSolver> mass_solver, linear_solver;
    /// Step and DynamicState::events_passed for which linear_solver was factorized [s].
    double factorized_step = 0., factorized_events = 0.;
    /// Inertia of blocks for predict(); null until it is needed.
    std::unique_ptr<internal::BlockInertia> inertia;

    double total_mass = 0.;
    /// Whether the step that was tried last has converged.
    bool has_candidate = false;
  };


  /// Tell the model which blocks are absent, and compute the mass of all others.
  void
  TimeIntegrator::Data::set_absent_blocks()
  {
    const ModelLayout &layout = model->layout();
    std::vector<bool>  is_absent;
    if (!state.left_blocks.empty())
    {
      is_absent.resize(layout.n_blocks, false);
      for (const unsigned int block : state.left_blocks)
        is_absent[block] = true;
    }
    model->set_absent_blocks(is_absent);
    linear_solver.reset();

    const dealii::IndexSet &absent = layout.absent_unknowns;
    Vector translation(layout.locally_owned, layout.communicator);
    for (const auto i : layout.locally_owned)
      if (component_of(i) == 0 && !layout.constraints->is_constrained(i) &&
          !(absent.size() > 0 && absent.is_element(i)))
        translation(i) = 1.;
    translation.compress(dealii::VectorOperation::insert);
    Vector product(translation);
    layout.mass->vmult(product, translation);
    total_mass = translation * product;
  }


  /// @throws NumericalFailure if the displacements of the state are not admissible.
  void
  TimeIntegrator::Data::assemble_state(const std::string &where,
                                       const std::string &remedy)
  {
    equations.u_begin = state.u;
    AssertThrow(model->assemble(Trial::at(equations.u_begin, state.time)) ==
                  Deformation::admissible,
                NumericalFailure("An element is turned inside out",
                                 where.empty()
                                   ? "time " + std::to_string(state.time) + " s"
                                   : where,
                                 remedy));
  }


  /// Solve M a = -C v - r for the accelerations of the current state.
  void
  TimeIntegrator::Data::set_accelerations()
  {
    if (mass_solver == nullptr)
    {
      mass_solver = std::make_unique<DirectSolver>();
      mass_solver->factorize(*model->layout().mass);
    }
    Vector &forces = equations.static_forces();
    forces *= -1.;
    if (equations.sleeping)
      equations.sleeping->set_zero(forces);
    mass_solver->solve(forces, state.a);
    model->layout().constraints->distribute(state.a);
  }


  /// Begin a step, and set the initial guess of Newton's method. If blocks are in contact, those with
  /// closed contact points start from their positions at the beginning of the step, all others are
  /// moved as rigid bodies, see BlockInertia::fly(). The velocities and accelerations of a stiff
  /// block are mostly vibrations, which the step does not resolve. So u + h v, or
  /// u + h v + h^2 a / 2, would deform the block and its contacts many times as much as the solution
  /// does: in the relaxation of a slope of 476 blocks, forces of 1e9 N at the first guess became
  /// 1e17 N in the iterations.
  void
  TimeIntegrator::Data::predict(const double h)
  {
    equations.begin_step(h, account.account().imbalance);
    std::vector<bool> is_flying = model->pressed_blocks();
    if (is_flying.empty())
      return;
    is_flying.flip();
    const ModelLayout &layout = model->layout();
    if (inertia == nullptr)
      inertia = std::make_unique<internal::BlockInertia>(layout);
    Vector momentum(state.v);
    layout.mass->vmult(momentum, state.v);
    layout.constraints->set_zero(momentum);
    Vector &u = equations.step.u;
    u         = state.u;
    inertia->fly(momentum, state.u, h, is_flying, u);
    layout.constraints->distribute(u);
    equations.u_end = u;
  }


  void
  TimeIntegrator::Data::solve_linear()
  {
    internal::SchemeStep &step          = equations.step;
    const bool            is_factorized = linear_solver != nullptr &&
                               factorized_step == step.length &&
                               factorized_events == state.events_passed;
    (void)equations.assemble(equations.u_end,
                             is_factorized ? Tangent::none
                                           : Tangent::consistent,
                             nullptr);
    if (!is_factorized)
    {
      if (linear_solver == nullptr)
        linear_solver = std::make_unique<DirectSolver>();
      linear_solver->factorize(equations.tangent());
      factorized_step   = step.length;
      factorized_events = state.events_passed;
    }
    Vector correction(step.u);
    linear_solver->solve(equations.residual(), correction);
    step.u -= correction;
    model->layout().constraints->distribute(step.u);
    step.set_rates(equations.matrix.rows);
    equations.u_end = step.u;
  }


  /// Solve the step by Newton's method, and repeat it whenever the result wakes a block.
  void
  TimeIntegrator::Data::solve_nonlinear(StepReport  &report,
                                        const double residual_tolerance)
  {
    const auto wakes = [this] {
      Vector rest(equations.residual());
      rest *= equations.step.stiffness_factor();
      return equations.sleeping->wake(rest, equations.step.u, state.rest);
    };
    do
    {
      if (report.converged)
        predict(report.step);
      const NewtonReport result = newton.solve(equations,
                                               *model->layout().constraints,
                                               equations.u_end,
                                               nullptr,
                                               residual_tolerance);
      report.converged          = result.converged;
      report.reason             = result.reason;
      report.n_iterations += result.iterations.size();
      for (const NewtonReport::Iteration &iteration : result.iterations)
        report.n_full_iterations += iteration.solved_share;
      report.factorization_time += result.factorization_time;
      report.substitution_time += result.substitution_time;
    } while (report.converged && equations.sleeping && wakes());
    if (!report.converged)
      report.reason += place_of_largest_force();
  }


  std::string
  TimeIntegrator::Data::place_of_largest_force() const
  {
    namespace Parallel        = dealii::Utilities::MPI;
    const ModelLayout &layout = model->layout();
    if (layout.reference_positions == nullptr)
      return "";
    const Vector        &forces  = equations.residual();
    double               largest = 0.;
    dealii::Tensor<1, 2> place;
    for (const auto i : layout.locally_owned)
      if (!layout.constraints->is_constrained(i) &&
          std::abs(forces(i)) > largest)
      {
        largest  = std::abs(forces(i));
        place[0] = (*layout.reference_positions)(i - component_of(i));
        place[1] = (*layout.reference_positions)(i - component_of(i) + 1);
      }
    const double of_all = Parallel::max(largest, layout.communicator);
    if (!(of_all > 0.) || !std::isfinite(of_all))
      return "";
    // the first rank that has it
    const unsigned int rank = Parallel::this_mpi_process(layout.communicator);
    const unsigned int first =
      Parallel::min(largest == of_all ? rank
                                      : dealii::numbers::invalid_unsigned_int,
                    layout.communicator);
    if (rank != first)
      place = 0.;
    place = Parallel::sum(place, layout.communicator);
    std::ostringstream text;
    text.precision(6);
    text << ", with the largest force out of balance at (" << place[0] << ", "
         << place[1] << ')';
    return text.str();
  }


  void
  TimeIntegrator::Data::measure(StepReport &report) const
  {
    const internal::SchemeStep &step = equations.step;
    Vector                      change(step.u);
    change -= state.u;
    double square = 0.;
    for (auto x = change.begin(); x != change.end(); x += 2)
      square = std::max(square, *x * *x + *(x + 1) * *(x + 1));
    report.max_displacement = std::sqrt(
      dealii::Utilities::MPI::max(square, model->layout().communicator));

    change = step.a;
    change -= state.a;
    report.error =
      step.error_factor() *
      std::sqrt(model->layout().mass->matrix_norm_square(change) / total_mass);
    if (!std::isfinite(report.error) || !std::isfinite(square))
    {
      report.converged = false;
      report.reason    = "displacements are not finite";
    }
  }


  /// Let blocks fall asleep after a step. Forces and account must be those of the current state.
  void
  TimeIntegrator::Data::let_sleep()
  {
    internal::SleepingBlocks &sleeping = *equations.sleeping;
    Vector                    momentum(state.v);
    model->layout().mass->vmult(momentum, state.v);
    model->layout().constraints->set_zero(momentum);
    const Vector &forces = equations.static_forces(/* with_damping = */ false);
    // check once more which blocks wake, with the forces of the accepted state
    const bool is_any_awake = sleeping.wake(forces, state.u, state.rest);
    if (!sleeping.let_sleep(equations.step.length,
                            momentum,
                            state.v,
                            forces,
                            state.u,
                            state.rest) &&
        !is_any_awake)
      return;
    const double before = account.account().kinetic;
    sleeping.set_zero(state.v);
    sleeping.set_zero(state.a);
    take_account();
    account.add(&EnergySums::dissipated, before - account.account().kinetic);
  }


  namespace
  {
    MechanicalModel &
    with_masses(MechanicalModel &model)
    {
      AssertThrow(model.layout().mass != nullptr,
                  InputError("A solid without masses cannot move",
                             "the motion",
                             "give the solid its mass matrix, see "
                             "make_mass_matrix()"));
      return model;
    }
  } // namespace


  TimeIntegrator::TimeIntegrator(MechanicalModel        &model,
                                 const TimeScheme       &scheme,
                                 const NewtonParameters &newton)
    : data(std::make_unique<Data>(with_masses(model), scheme, newton))
  {
    initialize();
  }


  TimeIntegrator::~TimeIntegrator() = default;


  void
  TimeIntegrator::initialize()
  {
    const Vector zero(data->model->layout().locally_owned,
                      data->model->layout().communicator);
    initialize(zero, zero);
  }


  void
  TimeIntegrator::initialize(const Vector &u,
                             const Vector &v,
                             const double  time)
  {
    Data              &d      = *data;
    const ModelLayout &layout = d.model->layout();
    DynamicState       start;
    start.time = start.events_passed = time;
    for (Vector *vector : {&start.u, &start.v, &start.a})
      vector->reinit(layout.locally_owned, layout.communicator);
    start.u = u;
    start.v = v;
    layout.constraints->distribute(start.u);
    layout.constraints->distribute(start.v);
    const bool is_another = !d.state.left_blocks.empty();
    d.state               = start;
    d.has_candidate       = false;
    if (d.equations.sleeping)
      d.equations.sleeping->set_rest({});
    if (is_another)
      d.set_absent_blocks();
    d.model->pass_events(time);
    d.assemble_state("the initial displacements", "correct them");
    d.set_accelerations();
    d.take_account();
    d.account.start();
  }


  void
  TimeIntegrator::restore(const DynamicState &state)
  {
    Data      &d          = *data;
    const bool is_another = d.state.left_blocks != state.left_blocks;
    d.state               = state;
    d.has_candidate       = false;
    if (d.equations.sleeping)
      d.equations.sleeping->set_rest(d.state.rest);
    if (is_another)
      d.set_absent_blocks();
    d.model->pass_events(state.events_passed);
    d.assemble_state("the state to continue from", "take another checkpoint");
    d.take_account();
  }


  void
  TimeIntegrator::balance_accelerations()
  {
    data->assemble_state("", "take smaller steps");
    data->set_accelerations();
  }


  void
  TimeIntegrator::continue_after_cut(const DynamicState &state,
                                     const double        energy,
                                     const double        duration)
  {
    Assert(duration > 0., dealii::ExcMessage("The closing forces must fade."));
    Data                                    &d = *data;
    const dealii::AffineConstraints<double> &constraints =
      *d.model->layout().constraints;
    DynamicState cut = state;
    cut.closing      = ClosingForces();
    for (Vector *vector : {&cut.u, &cut.v, &cut.a})
      constraints.distribute(*vector);
    restore(cut);
    Vector &forces = d.equations.static_forces();
    d.equations.matrix.add_product(*d.model->layout().mass, cut.a, forces);
    constraints.set_zero(forces);
    if (d.equations.sleeping)
      d.equations.sleeping->set_zero(forces);
    d.state.closing = {forces, state.time, state.time + duration};
    d.account.add(&EnergySums::cuts, d.energy() - energy);
    d.take_account();
  }


  void
  TimeIntegrator::let_blocks_sleep(const SleepParameters &parameters)
  {
    Data &d = *data;
    d.equations.sleeping =
      std::make_unique<internal::SleepingBlocks>(d.model->layout(), parameters);
    d.equations.sleeping->set_rest(d.state.rest);
  }


  unsigned int
  TimeIntegrator::n_asleep() const
  {
    const auto &rest = data->state.rest;
    return data->equations.sleeping
             ? std::count_if(rest.begin(),
                             rest.end(),
                             [](const auto &entry) {
                               return entry[0] ==
                                      internal::SleepingBlocks::asleep;
                             })
             : 0;
  }


  StepReport
  TimeIntegrator::try_step(const double step, const double residual_tolerance)
  {
    Data &d = *data;
    AssertThrow(step > 0. && std::isfinite(step),
                InputError("The time step is " + std::to_string(step) + " s",
                           "time " + std::to_string(d.state.time) + " s",
                           "choose it above 0"));
    StepReport report;
    report.step     = step;
    d.has_candidate = false;
    d.predict(step);
    if (d.model->properties().is_linear && !d.equations.sleeping)
    {
      d.solve_linear();
      report.n_iterations      = 1;
      report.n_full_iterations = 1.;
      report.converged         = true;
    }
    else
      d.solve_nonlinear(report, residual_tolerance);
    if (report.converged)
      d.measure(report);
    if (report.converged)
    {
      const StepFault fault = d.model->find_fault(d.equations.u_end);
      report.reason         = fault.reason;
      report.remedy         = fault.remedy;
      report.retry          = fault.retry;
      report.converged      = report.reason.empty();
    }
    d.has_candidate = report.converged;
    return report;
  }


  void
  TimeIntegrator::accept()
  {
    Data                 &d    = *data;
    internal::SchemeStep &step = d.equations.step;
    Assert(d.has_candidate,
           dealii::ExcMessage("There is no converged step to accept."));
    const StepWork work =
      d.model->commit(Trial::step(d.equations.u_begin,
                                  d.equations.u_end,
                                  d.state.time,
                                  step.end_time(),
                                  step.scheme.is_conserving));
    d.account.add_step(step, work);
    d.state.time = step.end_time();
    ++d.state.step;
    d.state.u.swap(step.u);
    d.state.v.swap(step.v);
    d.state.a.swap(step.a);
    d.has_candidate = false;
    d.assemble_state("", "take smaller steps");
    d.take_account();
    if (d.equations.sleeping)
      d.let_sleep();
  }


  void
  TimeIntegrator::pass_events(const double until)
  {
    Data        &d      = *data;
    const double before = d.account.stored();
    d.model->pass_events(until);
    d.state.events_passed = until;
    d.assemble_state("", "take smaller steps");
    const AssembledForces &forces = d.model->forces();
    d.account.add(&EnergySums::external_work,
                  forces.strain_energy + forces.energy_of_conditions - before);
    d.set_accelerations();
    d.take_account();
  }


  void
  TimeIntegrator::stop_motion()
  {
    Data &d = *data;
    d.account.add(&EnergySums::dissipated, d.account.account().kinetic);
    d.state.v = 0.;
    balance_accelerations();
    d.take_account();
  }


  void
  TimeIntegrator::drop_blocks(const std::vector<unsigned int> &blocks)
  {
    Data              &d      = *data;
    const ModelLayout &layout = d.model->layout();
    for (const unsigned int block : blocks)
    {
      const bool is_new = block < layout.n_blocks &&
                          std::find(d.state.left_blocks.begin(),
                                    d.state.left_blocks.end(),
                                    block) == d.state.left_blocks.end();
      AssertThrow(is_new,
                  InputError("Block " + std::to_string(block) + " is not there",
                             "time " + std::to_string(d.state.time) + " s",
                             "drop only blocks that are"));
      d.state.left_blocks.push_back(block);
    }
    const double before = d.energy();
    d.set_absent_blocks();
    for (const auto i : layout.absent_unknowns)
      d.state.v(i) = d.state.a(i) = 0.;
    d.state.v.compress(dealii::VectorOperation::insert);
    d.state.a.compress(dealii::VectorOperation::insert);
    d.has_candidate = false;
    balance_accelerations();
    d.take_account();
    d.account.add(&EnergySums::left, before - d.energy());
  }


  const DynamicState &
  TimeIntegrator::state() const
  {
    return data->state;
  }


  void
  TimeIntegrator::set_next_step(const double step)
  {
    data->state.next_step = step;
  }


  const Account &
  TimeIntegrator::account() const
  {
    return data->account.account();
  }


  MechanicalModel &
  TimeIntegrator::model() const
  {
    return *data->model;
  }


  const TimeScheme &
  TimeIntegrator::scheme() const
  {
    return data->equations.step.scheme;
  }
} // namespace NMM
