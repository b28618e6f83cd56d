#include <nmm/base/exceptions.h>
#include <nmm/dynamics/incremental_dynamics.h>
#include <nmm/mechanics/mass_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <linear_algebra/direct_solver.h>

namespace NMM
{
  struct IncrementalDynamics::Data
  {
    IncrementalElasticity                   *elasticity;
    const CoverSystem                       *covers;
    const dealii::AffineConstraints<double> *constraints;
    dealii::TrilinosWrappers::SparseMatrix   mass;
    dealii::TrilinosWrappers::SparseMatrix   matrix;
    internal::DirectSolver                   solver;
    Vector                                   velocity, momentum, rhs;
    double time = 0., next_step = 0., initial_energy = 0.;

    void
    set_velocity(const Vector &v)
    {
      velocity = v;
      constraints->distribute(velocity);
      mass.vmult(momentum, velocity);
      constraints->set_zero(momentum);
    }

    /// Kinetic energy + strain energy - work of loads [J/m].
    double
    energy() const
    {
      return 0.5 * (momentum * velocity) + elasticity->strain_energy() -
             elasticity->work_of_loads();
    }
  };


  IncrementalDynamics::IncrementalDynamics(
    IncrementalElasticity                   &elasticity,
    const CoverSystem                       &covers,
    const QuadratureCollection              &mass_quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem)
    : data(std::make_unique<Data>())
  {
    for (const Material &material : problem.materials)
      AssertThrow(material.density > 0.,
                  InputError("The density is " +
                               std::to_string(material.density),
                             "material '" + material.name + "'",
                             "dynamics needs a density above 0"));
    data->elasticity  = &elasticity;
    data->covers      = &covers;
    data->constraints = &constraints;
    assemble_mass_matrix(covers,
                         mass_quadrature,
                         constraints,
                         problem,
                         /* ghost_penalty = */ nullptr,
                         data->mass);
    for (Vector *vector : {&data->velocity, &data->momentum, &data->rhs})
      vector->reinit(covers.locally_owned_dofs(2), covers.communicator());
  }


  IncrementalDynamics::~IncrementalDynamics() = default;


  void
  IncrementalDynamics::set_velocity(const Vector &velocity)
  {
    data->set_velocity(velocity);
    data->initial_energy = data->energy();
  }


  double
  IncrementalDynamics::step(const double h, const double load_factor)
  {
    return try_step(h, load_factor, std::numeric_limits<double>::infinity())
      .largest_displacement;
  }


  IncrementalElasticity::StepResult
  IncrementalDynamics::try_step(const double h,
                                const double load_factor,
                                const double max_displacement)
  {
    Data &d = *data;
    AssertThrow(h > 0.,
                InputError("The time step is " + std::to_string(h) + " s",
                           "step-by-step dynamics",
                           "choose it above 0"));
    Vector     next(d.velocity);
    const auto solve = [&](const IncrementalElasticity::Matrix &stiffness,
                           const Vector                        &residual,
                           Vector                              &correction) {
      d.matrix.copy_from(stiffness);
      d.matrix.add(2. / (h * h), d.mass);
      d.solver.factorize(d.matrix);
      d.rhs = residual;
      d.rhs.add(-2. / h, d.momentum);
      d.solver.solve(d.rhs, correction);
      // the new velocity is 2 du / h - v, with du = -correction
      next.sadd(-1., -2. / h, correction);
    };
    const IncrementalElasticity::StepResult result =
      d.elasticity->try_step(load_factor, max_displacement, solve);
    if (result.is_taken)
    {
      d.set_velocity(next);
      d.time += h;
    }
    return result;
  }


  IncrementalDynamics::Advance
  IncrementalDynamics::advance(const double                         end,
                               const Control                       &control,
                               const std::function<double(double)> &load_factor)
  {
    Data &d = *data;
    AssertThrow(control.min_step > 0. && control.min_step <= control.max_step &&
                  control.max_displacement > 0.,
                InputError("Steps from " + std::to_string(control.min_step) +
                             " s to " + std::to_string(control.max_step) +
                             " s, displacements up to " +
                             std::to_string(control.max_displacement) + " m",
                           "step-by-step dynamics",
                           "give 0 < smallest step <= largest step and a "
                           "displacement above 0"));
    AssertThrow(end > d.time,
                InputError("The time " + std::to_string(end) +
                             " s is reached already",
                           "step-by-step dynamics",
                           "choose a later end"));
    // fraction of the bound at which the next step aims
    constexpr double aim = 0.9;

    Advance      advance;
    StepSequence sequence({"time", "s", control.min_step, control.max_step},
                          d.time,
                          d.next_step > 0.
                            ? std::min(d.next_step, control.max_step)
                            : control.max_step);
    const auto   attempt = [&](const StepTrial &trial) {
      const IncrementalElasticity::StepResult result =
        try_step(trial.length,
                 load_factor ? load_factor(trial.end) : 1.,
                 control.max_displacement);
      advance.step                 = trial.length;
      advance.largest_displacement = result.largest_displacement;
      double ratio                 = 2.;
      if (std::isfinite(control.max_displacement) &&
          result.largest_displacement > 0.)
        ratio = std::min(ratio,
                         aim * control.max_displacement /
                           result.largest_displacement);
      if (result.is_taken)
        return StepVerdict::accepted(ratio);
      return StepVerdict::rejected(
        {"displacements of " + std::to_string(result.largest_displacement) +
           " m in a step",
         "allow larger displacements or smaller steps",
         std::max(0.1, ratio)},
        1);
    };
    sequence.advance(end, attempt, advance);
    d.time      = sequence.position();
    d.next_step = sequence.length();
    return advance;
  }


  double
  IncrementalDynamics::time() const
  {
    return data->time;
  }


  IncrementalDynamics::Account
  IncrementalDynamics::account() const
  {
    Account account;
    account.kinetic = kinetic_energy();
    account.strain  = data->elasticity->strain_energy();
    account.work    = data->elasticity->work_of_loads();
    account.balance =
      account.kinetic + account.strain - account.work - data->initial_energy;
    return account;
  }


  IncrementalDynamics::State
  IncrementalDynamics::state() const
  {
    return {data->elasticity->state(),
            data->velocity,
            data->time,
            data->next_step,
            data->initial_energy};
  }


  void
  IncrementalDynamics::restore(const State &state)
  {
    data->elasticity->restore(state.elasticity);
    data->set_velocity(state.velocity);
    data->time           = state.time;
    data->next_step      = state.next_step;
    data->initial_energy = state.initial_energy;
  }


  const IncrementalDynamics::Vector &
  IncrementalDynamics::velocity() const
  {
    return data->velocity;
  }


  double
  IncrementalDynamics::kinetic_energy() const
  {
    return 0.5 * (data->momentum * data->velocity);
  }


  double
  IncrementalDynamics::angular_momentum() const
  {
    const Vector &u   = data->elasticity->solution();
    double        sum = 0.;
    for (const auto k : data->covers->locally_owned_covers())
    {
      const dealii::Point<2> &x = data->covers->node(k);
      sum += (x[0] + u(2 * k)) * data->momentum(2 * k + 1) -
             (x[1] + u(2 * k + 1)) * data->momentum(2 * k);
    }
    return dealii::Utilities::MPI::sum(sum, data->covers->communicator());
  }
} // namespace NMM
