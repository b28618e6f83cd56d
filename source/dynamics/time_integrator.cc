#include <nmm/base/exceptions.h>
#include <nmm/dynamics/time_integrator.h>

#include <algorithm>
#include <cmath>
#include <dynamics/step_equations.h>

namespace NMM
{
  using Vector = TimeIntegrator::Vector;

  bool
  ClosingForces::act_at(const double t) const
  {
    return forces.size() > 0 && t < end;
  }


  double
  ClosingForces::share(const double t) const
  {
    return act_at(t) ? std::min(1., (end - t) / (end - begin)) : 0.;
  }


  double
  ClosingForces::mean_share(const double t_0, const double t_1) const
  {
    if (!act_at(t_0) || t_1 <= t_0)
      return share(t_0);
    // The share is linear up to the end and zero afterwards.
    const double last = std::min(t_1, end);
    return 0.5 * (share(t_0) + share(last)) * (last - t_0) / (t_1 - t_0);
  }


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


  TimeIntegrator::TimeIntegrator(MechanicalModel        &model,
                                 const TimeScheme       &scheme,
                                 const RayleighDamping  &damping,
                                 const NewtonParameters &newton)
    : data(std::make_unique<Data>(model, scheme, damping, newton))
  {
    initialize();
  }


  TimeIntegrator::~TimeIntegrator() = default;


  void
  TimeIntegrator::initialize()
  {
    const Vector zero = data->owned_vector();
    initialize(zero, zero);
  }


  void
  TimeIntegrator::initialize(const Vector &u,
                             const Vector &v,
                             const double  time)
  {
    Data &d               = *data;
    d.state.time          = time;
    d.state.step          = 0;
    d.state.next_step     = 0.;
    d.state.events_passed = time;
    d.state.sums          = EnergySums();
    d.state.closing       = ClosingForces();
    d.state.rest.clear();
    if (d.sleeping)
      d.sleeping->set_rest({});
    d.has_candidate = false;
    d.state.u       = u;
    d.state.v       = v;
    d.model->constraints().distribute(d.state.u);
    d.model->constraints().distribute(d.state.v);
    if (!d.state.left_blocks.empty())
    {
      d.state.left_blocks.clear();
      d.set_absent_blocks();
    }
    d.supports->pass_events(time);
    d.u_begin = d.state.u;
    d.model->external_forces(d.u_begin, time, d.external);
    AssertThrow(d.model->assemble(d.u_begin, time, Tangent::none) ==
                  Deformation::admissible,
                NumericalFailure("An element is turned inside out",
                                 "the initial displacements",
                                 "correct them"));
    d.set_accelerations();
    d.take_account();
    d.state.sums.initial = d.account.kinetic + d.stored_energy();
    d.account.balance    = 0.;
  }


  void
  TimeIntegrator::restore(const DynamicState &state)
  {
    Data      &d          = *data;
    const bool is_another = d.state.left_blocks != state.left_blocks;
    d.state               = state;
    d.has_candidate       = false;
    if (d.sleeping)
      d.sleeping->set_rest(d.state.rest);
    if (is_another)
      d.set_absent_blocks();
    d.supports->pass_events(state.events_passed);
    d.u_begin = d.state.u;
    d.model->external_forces(d.u_begin, state.time, d.external);
    AssertThrow(d.model->assemble(d.u_begin, state.time, Tangent::none) ==
                  Deformation::admissible,
                NumericalFailure("An element is turned inside out",
                                 "the state to continue from",
                                 "take another checkpoint"));
    d.take_account();
  }


  void
  TimeIntegrator::balance_accelerations()
  {
    Data &d   = *data;
    d.u_begin = d.state.u;
    AssertThrow(d.model->assemble(d.u_begin, d.state.time, Tangent::none) ==
                  Deformation::admissible,
                dealii::ExcInternalError());
    d.set_accelerations();
  }


  void
  TimeIntegrator::continue_after_cut(const DynamicState &state,
                                     const double        energy,
                                     const double        duration)
  {
    Assert(duration > 0., dealii::ExcMessage("The closing forces must fade."));
    Data        &d   = *data;
    DynamicState cut = state;
    cut.closing      = ClosingForces();
    for (Vector *vector : {&cut.u, &cut.v, &cut.a})
      d.model->constraints().distribute(*vector);
    restore(cut);
    d.set_static_forces();
    d.add_product(1., d.model->mass(), cut.a, d.forces);
    d.model->constraints().set_zero(d.forces);
    if (d.sleeping)
      d.sleeping->set_zero(d.forces);
    d.state.closing = {d.forces, state.time, state.time + duration};
    d.state.sums.cuts += d.account.kinetic + d.stored_energy() - energy;
    d.take_account();
  }


  void
  TimeIntegrator::let_blocks_sleep(const SleepParameters &parameters)
  {
    Data &d = *data;
    d.sleeping =
      std::make_unique<internal::SleepingBlocks>(*d.model, parameters);
    d.sleeping->set_rest(d.state.rest);
  }


  unsigned int
  TimeIntegrator::n_asleep() const
  {
    const auto &rest = data->state.rest;
    return data->sleeping
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
    d.h             = step;
    d.has_candidate = false;
    d.predict();
    if (d.model->force_properties().is_linear && !d.sleeping)
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
      const StepFault fault = d.steps->find_fault(d.u_end);
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
    Data &d = *data;
    Assert(d.has_candidate,
           dealii::ExcMessage("There is no converged step to accept."));
    d.add_work();
    d.state.time += d.h;
    ++d.state.step;
    d.state.u.swap(d.u_1);
    d.state.v.swap(d.v_1);
    d.state.a.swap(d.a_1);
    d.has_candidate = false;
    d.state.sums.dissipated += d.steps->accept_step(d.u_end, d.state.time);
    AssertThrow(d.model->assemble(d.u_end, d.state.time, Tangent::none) ==
                  Deformation::admissible,
                NumericalFailure("An element is turned inside out",
                                 "time " + std::to_string(d.state.time) + " s",
                                 "take smaller steps"));
    d.take_account();
    if (d.sleeping)
      d.let_sleep();
  }


  void
  TimeIntegrator::pass_events(const double until)
  {
    Data        &d      = *data;
    const double before = d.stored_energy();
    d.supports->pass_events(until);
    d.state.events_passed = until;
    d.u_begin             = d.state.u;
    d.model->external_forces(d.u_begin, d.state.time, d.external);
    AssertThrow(d.model->assemble(d.u_begin, d.state.time, Tangent::none) ==
                  Deformation::admissible,
                dealii::ExcInternalError());
    const MechanicalModel::Energies energies = d.model->energies();
    d.state.sums.external_work +=
      energies.strain + energies.conditions - before;
    d.set_accelerations();
    d.take_account();
  }


  void
  TimeIntegrator::stop_motion()
  {
    Data &d = *data;
    d.state.sums.dissipated += d.account.kinetic;
    d.state.v = 0.;
    d.u_begin = d.state.u;
    AssertThrow(d.model->assemble(d.u_begin, d.state.time, Tangent::none) ==
                  Deformation::admissible,
                dealii::ExcInternalError());
    d.set_accelerations();
    d.take_account();
  }


  void
  TimeIntegrator::drop_blocks(const std::vector<unsigned int> &blocks)
  {
    Data &d = *data;
    for (const unsigned int block : blocks)
    {
      const bool is_new = block < d.blocks->n_blocks() &&
                          std::find(d.state.left_blocks.begin(),
                                    d.state.left_blocks.end(),
                                    block) == d.state.left_blocks.end();
      AssertThrow(is_new,
                  InputError("Block " + std::to_string(block) + " is not there",
                             "time " + std::to_string(d.state.time) + " s",
                             "drop only blocks that are"));
      d.state.left_blocks.push_back(block);
    }
    const double before = d.account.kinetic + d.stored_energy();
    d.set_absent_blocks();
    for (const auto i : d.blocks->absent_unknowns())
      d.state.v(i) = d.state.a(i) = 0.;
    d.state.v.compress(dealii::VectorOperation::insert);
    d.state.a.compress(dealii::VectorOperation::insert);
    d.has_candidate = false;
    d.u_begin       = d.state.u;
    d.model->external_forces(d.u_begin, d.state.time, d.external);
    AssertThrow(d.model->assemble(d.u_begin, d.state.time, Tangent::none) ==
                  Deformation::admissible,
                dealii::ExcInternalError());
    d.set_accelerations();
    d.take_account();
    const double lost = before - d.account.kinetic - d.stored_energy();
    d.state.sums.left += lost;
    d.account.left += lost;
    d.account.balance += lost;
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
    return data->account;
  }


  MechanicalModel &
  TimeIntegrator::model() const
  {
    return *data->model;
  }


  const TimeScheme &
  TimeIntegrator::scheme() const
  {
    return data->scheme;
  }
} // namespace NMM
