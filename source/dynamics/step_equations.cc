// The equations of a time step, their solution, and the account of energy.
#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <dynamics/step_equations.h>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/matrix_sum.h>
#include <utility>

namespace NMM
{
  using Vector = TimeIntegrator::Vector;
  using internal::add_rows;
  using internal::DirectSolver;


  TimeIntegrator::Data::Data(MechanicalModel        &model,
                             const TimeScheme       &scheme,
                             const RayleighDamping  &damping,
                             const NewtonParameters &newton_parameters)
    : model(&model)
    , supports(&model_interface<SupportModel>(model))
    , steps(&model_interface<SteppedModel>(model))
    , blocks(&model_interface<BlockModel>(model))
    , tangents(&model_interface<TangentModel>(model))
    , scheme(scheme)
    , damping(damping)
    , newton(newton_parameters)
  {
    scheme.check();
    AssertThrow(damping.mass >= 0. && damping.stiffness >= 0.,
                InputError("A coefficient of Rayleigh damping is negative",
                           "",
                           "choose both at least 0"));
    for (Vector *vector : {&u_1,
                           &v_1,
                           &a_1,
                           &forces,
                           &scratch,
                           &other_scratch,
                           &external,
                           &state.u,
                           &state.v,
                           &state.a})
      vector->reinit(model.locally_owned(), model.communicator());
    for (Vector *vector : {&u_begin, &u_end, &u_middle})
      vector->reinit(model.locally_owned(),
                     model.locally_relevant(),
                     model.communicator());

    set_absent_blocks();
    model_damps = scheme.is_conserving &&
                  tangents->set_stiffness_damping(damping.stiffness);
    if (damps_by_stiffness())
    {
      const auto &stiffness = model.stiffness_at_rest();
      stiffness_at_rest.reinit(stiffness);
      stiffness_at_rest.copy_from(stiffness);
    }
  }


  void
  TimeIntegrator::Data::set_absent_blocks()
  {
    std::vector<bool> is_absent;
    if (!state.left_blocks.empty())
    {
      is_absent.resize(blocks->n_blocks(), false);
      for (const unsigned int block : state.left_blocks)
        is_absent[block] = true;
    }
    blocks->set_absent_blocks(is_absent);
    linear_solver.reset();

    const dealii::IndexSet absent = blocks->absent_unknowns();
    scratch                       = 0.;
    for (const auto i : model->locally_owned())
      if (i % 2 == 0 && !model->constraints().is_constrained(i) &&
          !(absent.size() > 0 && absent.is_element(i)))
        scratch(i) = 1.;
    scratch.compress(dealii::VectorOperation::insert);
    model->mass().vmult(forces, scratch);
    total_mass = scratch * forces;
  }


  void
  TimeIntegrator::Data::set_rates()
  {
    const auto u_0 = std::as_const(state.u).begin(),
               v_0 = std::as_const(state.v).begin(),
               a_0 = std::as_const(state.a).begin(),
               u   = std::as_const(u_1).begin();
    const auto   v = v_1.begin(), a = a_1.begin();
    const double by_a_0   = h * h * (0.5 - scheme.beta),
                 by_u     = 1. / (scheme.beta * h * h),
                 v_by_a_0 = h * (1. - scheme.gamma), v_by_a = h * scheme.gamma;
    active_rows.for_each(u_1.locally_owned_size(), [&](const unsigned int i) {
      // subtract u_0 first to keep rounding small, because u_1 is close to u_0
      double x = u[i] - u_0[i] - h * v_0[i];
      if (by_a_0 != 0.)
        x -= by_a_0 * a_0[i];
      a[i]     = by_u * x;
      double y = v_0[i];
      if (v_by_a_0 != 0.)
        y += v_by_a_0 * a_0[i];
      v[i] = y + v_by_a * a[i];
    });
  }


  void
  TimeIntegrator::Data::add_product(
    const double                                  factor,
    const dealii::TrilinosWrappers::SparseMatrix &A,
    const Vector                                 &in,
    Vector                                       &out)
  {
    if (active_rows.all())
    {
      A.vmult(other_scratch, in);
      out.add(factor, other_scratch);
      return;
    }
    // rows are selected on one rank only
    const internal::MatrixRows entries(A);
    const int *columns = A.trilinos_matrix().ColMap().MyGlobalElements();
    const auto x       = in.begin();
    const auto y       = out.begin();
    for (const unsigned int row : active_rows.chosen())
    {
      double    sum   = 0.;
      const int begin = entries.begins[row], end = entries.begins[row + 1];
      const int first = begin < end ? columns[entries.columns[begin]] : 0;
      const int last  = begin < end ? columns[entries.columns[end - 1]] : 0;
      // the columns are consecutive, as in rows of a small block, and need not be read
      if (last - first == end - begin - 1)
        for (int i = begin; i < end; ++i)
          sum += entries.values[i] * x[first + i - begin];
      else
        for (int i = begin; i < end; ++i)
          sum += entries.values[i] * x[columns[entries.columns[i]]];
      y[row] += factor * sum;
    }
  }


  void
  TimeIntegrator::Data::add_damping(const double  factor,
                                    const Vector &in,
                                    Vector       &out)
  {
    if (damping.mass > 0.)
      add_product(factor * damping.mass, model->mass(), in, out);
    if (damps_by_stiffness())
      add_product(factor * damping.stiffness, stiffness_at_rest, in, out);
  }


  Deformation
  TimeIntegrator::Data::assemble_forces(const Vector &u,
                                        const Tangent tangent,
                                        const Vector *increment)
  {
    const double t = state.time + (1. - scheme.alpha_f) * h;
    if (scheme.is_conserving && tangent != Tangent::none)
      in_place = tangents->tangent_to_add_to(1. - scheme.alpha_f);
    if (scheme.is_conserving)
      return model->assemble_between(
        u_begin, u, state.time, state.time + h, tangent);
    if (scheme.alpha_f == 0.)
      return model->assemble(u, t, tangent, increment);
    scratch = u_1;
    scratch.sadd(1. - scheme.alpha_f, scheme.alpha_f, state.u);
    u_middle = scratch;
    return model->assemble(u_middle, t, tangent);
  }


  void
  TimeIntegrator::Data::make_matrix()
  {
    const double k = 1. - scheme.alpha_f;
    const double c = k * scheme.gamma / (scheme.beta * h);
    const double m = (1. - scheme.alpha_m) / (scheme.beta * h * h);
    body_matrix    = in_place != nullptr ? tangents->body_tangent() : nullptr;
    if (body_matrix != nullptr)
    {
      body_matrix->add(m + c * damping.mass, model->mass());
      if (damps_by_stiffness() && c != 0.)
        body_matrix->add(c * damping.stiffness, stiffness_at_rest);
      return;
    }
    if (in_place == nullptr && !active_rows.all() &&
        matrix_version == pattern_version())
      // other rows have been assembled before, and have their mass and damping
      internal::set_rows(k, model->tangent(), matrix, active_rows);
    else if (in_place == nullptr)
    {
      matrix.copy_from(model->tangent());
      matrix *= k;
      matrix_version = pattern_version();
    }
    auto &sum = in_place != nullptr ? *in_place : matrix;
    add_rows(m + c * damping.mass, model->mass(), sum, active_rows);
    if (damps_by_stiffness() && c != 0.)
      add_rows(c * damping.stiffness, stiffness_at_rest, sum, active_rows);
  }


  Deformation
  TimeIntegrator::Data::assemble(const Vector &u,
                                 const Tangent tangent,
                                 const Vector *increment)
  {
    const unsigned int n = u_1.locally_owned_size();
    if (active_rows.all())
      u_1 = u;
    else
      for (const unsigned int i : active_rows.chosen())
        u_1.begin()[i] = u.begin()[i];
    set_rates();
    if (assemble_forces(u, tangent, increment) != Deformation::admissible)
      return Deformation::inverted;
    if (tangent != Tangent::none)
      make_matrix();

    /// Set scratch to (1 - alpha) x + alpha x_0.
    const auto mix =
      [&](const Vector &x, const double alpha, const Vector &x_0) {
        const auto from = x.begin(), other = x_0.begin();
        const auto to = scratch.begin();
        active_rows.for_each(n, [&](const unsigned int i) {
          to[i] =
            alpha == 0. ? from[i] : (1. - alpha) * from[i] + alpha * other[i];
        });
      };
    const auto f = forces.begin();
    active_rows.for_each(n, [&](const unsigned int i) { f[i] = 0.; });
    mix(a_1, scheme.alpha_m, state.a);
    add_product(1., model->mass(), scratch, forces);
    const auto r      = model->residual().begin();
    double     square = 0.;
    active_rows.for_each(n, [&](const unsigned int i) {
      square += f[i] * f[i];
      f[i] += r[i];
    });
    square = dealii::Utilities::MPI::sum(square, model->communicator());
    scale  = std::hypot(model->force_scale(), std::sqrt(square));
    // Accelerations are differences of displacements divided by the square of the step. The force
    // scale contains their rounding, so that tolerances can be met however small the step is.
    constexpr double rounding = 1e-6;
    scale                     = std::hypot(scale,
                       rounding / (scheme.beta * h * h) * mass_of_displacement);
    mix(v_1, scheme.alpha_f, state.v);
    add_damping(1., scratch, forces);
    const double t = state.time + (1. - scheme.alpha_f) * h;
    subtract_closing(scheme.is_conserving
                       ? state.closing.mean_share(state.time, state.time + h)
                       : state.closing.share(t));
    if (model->constraints().n_constraints() > 0)
      model->constraints().set_zero(forces);
    return Deformation::admissible;
  }


  void
  TimeIntegrator::Data::subtract_closing(const double share)
  {
    if (share == 0.)
      return;
    const auto to   = forces.begin();
    const auto from = std::as_const(state.closing.forces).begin();
    active_rows.for_each(forces.locally_owned_size(),
                         [&](const unsigned int i) {
                           to[i] -= share * from[i];
                         });
  }


  void
  TimeIntegrator::Data::set_static_forces()
  {
    forces = model->residual();
    add_damping(1., state.v, forces);
    subtract_closing(state.closing.share(state.time));
  }


  void
  TimeIntegrator::Data::predict()
  {
    u_begin = state.u;
    model->mass().vmult(forces, state.u);
    mass_of_displacement = forces.l2_norm();
    u_1                  = state.u;
    // not used in the conserving scheme, whose accelerations alternate in sign after impacts
    if (scheme.is_conserving)
      u_1.add(h, state.v);
    else
      u_1.add(h, state.v, 0.5 * h * h, state.a);
    model->constraints().distribute(u_1);
    u_end = u_1;
    steps->begin_step(u_begin, u_end, state.time, h);
    predict_blocks();
  }


  void
  TimeIntegrator::Data::predict_blocks()
  {
    std::vector<bool> is_flying = steps->pressed_blocks();
    if (is_flying.empty())
      return;
    is_flying.flip();
    if (inertia == nullptr)
      inertia = std::make_unique<internal::BlockInertia>(*model);
    model->mass().vmult(forces, state.v);
    model->constraints().set_zero(forces);
    u_1 = state.u;
    inertia->fly(forces, state.u, h, is_flying, u_1);
    model->constraints().distribute(u_1);
    u_end = u_1;
  }


  void
  TimeIntegrator::Data::solve_linear()
  {
    const bool is_factorized = linear_solver != nullptr &&
                               factorized_step == h &&
                               factorized_events == state.events_passed;
    (void)assemble(u_end,
                   is_factorized ? Tangent::none : Tangent::consistent,
                   nullptr);
    if (!is_factorized)
    {
      if (linear_solver == nullptr)
        linear_solver = std::make_unique<DirectSolver>();
      linear_solver->factorize(matrix);
      factorized_step   = h;
      factorized_events = state.events_passed;
    }
    linear_solver->solve(forces, scratch);
    u_1 -= scratch;
    model->constraints().distribute(u_1);
    set_rates();
    u_end = u_1;
  }


  void
  TimeIntegrator::Data::measure(StepReport &report) const
  {
    Vector change(u_1);
    change -= state.u;
    double square = 0.;
    for (auto x = change.begin(); x != change.end(); x += 2)
      square = std::max(square, *x * *x + *(x + 1) * *(x + 1));
    report.max_displacement =
      std::sqrt(dealii::Utilities::MPI::max(square, model->communicator()));

    const double beta = scheme.is_conserving ? 0.25 : scheme.beta;
    change            = a_1;
    change -= state.a;
    report.error =
      std::abs(beta - 1. / 6.) * h * h *
      std::sqrt(model->mass().matrix_norm_square(change) / total_mass);
    if (!std::isfinite(report.error) || !std::isfinite(square))
    {
      report.converged = false;
      report.reason    = "displacements are not finite";
    }
  }


  void
  TimeIntegrator::Data::set_accelerations()
  {
    if (mass_solver == nullptr)
    {
      mass_solver = std::make_unique<DirectSolver>();
      mass_solver->factorize(model->mass());
    }
    set_static_forces();
    forces *= -1.;
    model->constraints().set_zero(forces);
    if (sleeping)
      sleeping->set_zero(forces);
    mass_solver->solve(forces, state.a);
    model->constraints().distribute(state.a);
  }


  void
  TimeIntegrator::Data::take_account()
  {
    const MechanicalModel::Energies energies = model->energies();
    account.strain                           = energies.strain;
    account.conditions                       = energies.conditions;

    set_static_forces();
    model->constraints().set_zero(forces);
    const double norm = forces.l2_norm();
    account.imbalance = norm > 0. ? norm / model->force_scale() : 0.;

    Vector &momentum = forces;
    model->mass().vmult(momentum, state.v);
    model->constraints().set_zero(momentum);
    account.kinetic = 0.5 * (momentum * state.v);
    double sums[3]  = {0., 0., 0.};
    auto   p        = momentum.begin();
    auto   u        = state.u.begin();
    auto   x        = model->reference_positions().begin();
    for (; p != momentum.end(); p += 2, u += 2, x += 2)
    {
      sums[0] += *p;
      sums[1] += *(p + 1);
      sums[2] += (*x + *u) * *(p + 1) - (*(x + 1) + *(u + 1)) * *p;
    }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 3),
                                model->communicator(),
                                dealii::ArrayView<double>(sums, 3));
    account.linear_momentum[0] = sums[0];
    account.linear_momentum[1] = sums[1];
    account.angular_momentum   = sums[2];

    state.kinetic         = account.kinetic;
    account.external_work = state.sums.external_work;
    account.dissipated    = state.sums.dissipated;
    account.left          = state.sums.left;
    account.fracture      = state.sums.fracture;
    account.cuts          = state.sums.cuts;
    account.balance = account.kinetic + stored_energy() + account.dissipated +
                      account.left + account.fracture - account.cuts -
                      account.external_work - state.sums.initial;
  }


  /// Add the work of loads, supports and damping in the step to the sums of the account.
  void
  TimeIntegrator::Data::add_work()
  {
    const double t_1 = state.time + h;
    Vector       change(u_1), mean(u_1), loads(external);
    change -= state.u;
    double &work = state.sums.external_work;
    if (scheme.is_conserving)
    {
      mean.sadd(0.5, 0.5, state.u);
      u_middle = mean;
      model->external_forces(u_middle, state.time + 0.5 * h, loads);
      work += loads * change;
      work += supports->work_of_supports_between(
        u_begin, u_end, u_middle, state.time, t_1);
      model->external_forces(u_end, t_1, external);
    }
    else
    {
      model->external_forces(u_end, t_1, external);
      loads.add(1., external);
      work += 0.5 * (loads * change);
      work +=
        0.5 *
        (supports->work_of_supports(u_begin, state.time, state.time, t_1) +
         supports->work_of_supports(u_end, t_1, state.time, t_1));
    }
    add_fracture_work(change);
    if (damping.mass > 0. || damps_by_stiffness())
    {
      loads = 0.;
      add_damping(1. / h, change, loads);
      model->constraints().set_zero(loads);
      state.sums.dissipated += loads * change;
    }
  }


  void
  TimeIntegrator::Data::add_fracture_work(const Vector &change)
  {
    const ClosingForces &closing = state.closing;
    const double         t_0 = state.time, t_1 = t_0 + h;
    const double         share = scheme.is_conserving
                                   ? closing.mean_share(t_0, t_1)
                                   : 0.5 * (closing.share(t_0) + closing.share(t_1));
    if (share > 0.)
      state.sums.fracture -= share * (closing.forces * change);
  }


  void
  TimeIntegrator::Data::solve_nonlinear(StepReport  &report,
                                        const double residual_tolerance)
  {
    do
    {
      if (report.converged)
        predict();
      const NewtonReport result = newton.solve(
        *this, model->constraints(), u_end, nullptr, residual_tolerance);
      report.converged = result.converged;
      report.reason    = result.reason;
      report.n_iterations += result.iterations.size();
      for (const NewtonReport::Iteration &iteration : result.iterations)
        report.n_full_iterations += iteration.active_share;
      report.factorization_time += result.factorization_time;
      report.substitution_time += result.substitution_time;
    } while (report.converged && sleeping &&
             sleeping->wake(forces, u_1, state.rest));
  }


  /// The forces of the model and the account must be those of the current state.
  void
  TimeIntegrator::Data::let_sleep()
  {
    model->mass().vmult(scratch, state.v);
    model->constraints().set_zero(scratch);
    forces = model->residual();
    subtract_closing(state.closing.share(state.time));
    // check once more which blocks wake, with the forces of the accepted state
    const bool is_any_awake = sleeping->wake(forces, state.u, state.rest);
    if (!sleeping->let_sleep(
          h, scratch, state.v, forces, state.u, state.rest) &&
        !is_any_awake)
      return;
    const double before = account.kinetic;
    sleeping->set_zero(state.v);
    sleeping->set_zero(state.a);
    take_account();
    state.sums.dissipated += before - account.kinetic;
    account.dissipated = state.sums.dissipated;
    account.balance += before - account.kinetic;
  }
} // namespace NMM
