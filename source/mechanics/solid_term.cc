#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/mechanics/solid_term.h>

#include <algorithm>
#include <cmath>
#include <mechanics/load_amplitudes.h>
#include <mechanics/solid_hash.h>

namespace NMM
{
  using internal::amplitude;
  using internal::is_load;


  namespace
  {
    /// @throws InputError for a release of a load or of what does not exist.
    void
    check_releases(const Loading &loading, const ElasticityProblem &problem)
    {
      for (const Release &release : loading.releases)
      {
        const bool is_condition =
          release.kind == Release::Kind::boundary_condition;
        const std::size_t n = is_condition ? problem.boundary_conditions.size()
                                           : problem.fixed_points.size();
        AssertThrow(
          release.index < n,
          InputError(std::string("There is no ") +
                       (is_condition ? "boundary condition " : "fixed point ") +
                       std::to_string(release.index),
                     "a release at " + std::to_string(release.time) + " s",
                     "give an index below " + std::to_string(n)));
        AssertThrow(
          !is_condition || !is_load(problem.boundary_conditions[release.index]),
          InputError("A load cannot be released",
                     "the boundary condition '" +
                       problem.boundary_conditions[release.index].name + "'",
                     "let its amplitude become 0"));
      }
    }
  } // namespace


  SolidTerm::SolidTerm(FiniteElasticity             &elasticity,
                       Loading                       loading_in,
                       std::shared_ptr<const Matrix> mass)
    : elastic(&elasticity)
    , loading(std::move(loading_in))
    , unknowns(elasticity, std::move(mass))
  {
    const ElasticityProblem &problem = elasticity.elasticity_problem();
    check_releases(loading, problem);
    AssertThrow(layout().mass != nullptr || !loading.base_acceleration,
                InputError("The base of a solid without masses moves",
                           "the base acceleration",
                           "give the mass matrix"));

    zero = elasticity.initial_solution();
    last_loads.reinit(layout().locally_owned, layout().communicator);
    set_mass_of_translation();
    for (const Release &release : loading.releases)
      event_times.push_back(release.time);
    elasticity.set_amplitudes(current);
    set_amplitudes(amplitudes_at(0.));
  }


  void
  SolidTerm::finish_construction()
  {
    if (elastic->is_inelastic())
      inelastic = std::make_unique<InelasticTerms>(*elastic, kinematics());
    internal::Hash hash_of_solid =
      internal::hash_of_solid(elastic->cover_system(),
                              elastic->elasticity_problem());
    hash_of_solid.add(properties().is_linear);
    hash = hash_of_solid.value();
  }


  void
  SolidTerm::set_mass_of_translation()
  {
    if (!loading.base_acceleration)
      return;
    for (unsigned int c = 0; c < 2; ++c)
    {
      Vector translation(layout().locally_owned, layout().communicator);
      for (const auto k : elastic->cover_system().locally_owned_covers())
        if (!layout().constraints->is_constrained(unknown_of(k, c)) &&
            !layout().absent_unknowns.is_element(unknown_of(k, c)))
          translation(unknown_of(k, c)) = 1.;
      translation.compress(dealii::VectorOperation::insert);
      mass_of_translation[c].reinit(translation);
      layout().mass->vmult(mass_of_translation[c], translation);
    }
  }


  void
  SolidTerm::set_presence(const Presence &present)
  {
    last_loads_at.reset();
    n_passed = 0;
    for (const Release &release : loading.releases)
      if (release.time <= present.events_passed)
        ++n_passed;
    const bool is_departure = present.absent_blocks != presence.absent_blocks;
    presence                = present;
    if (!is_departure)
      return;
    elastic->set_absent_blocks(presence.absent_blocks);
    unknowns.set_absent_blocks(presence.absent_blocks);
    ++n_changes;
    set_mass_of_translation();
    // What is absent does not hold its neighbours back by the ties that they had.
    if (damping_matrix)
      make_damping_matrix();
  }


  LoadAmplitudes
  SolidTerm::amplitudes_at(const double t, const bool with_loads) const
  {
    LoadAmplitudes amplitudes;
    if (loading.amplitudes)
      amplitudes = loading.amplitudes(t);
    const ElasticityProblem &problem = elastic->elasticity_problem();
    for (const Release &release : loading.releases)
      if (release.time <= presence.events_passed)
      {
        const bool is_condition =
          release.kind == Release::Kind::boundary_condition;
        std::vector<bool> &released = is_condition
                                        ? amplitudes.released_conditions
                                        : amplitudes.released_fixed_points;
        released.resize(is_condition ? problem.boundary_conditions.size()
                                     : problem.fixed_points.size(),
                        false);
        released[release.index] = true;
      }
    return with_loads ? amplitudes
                      : internal::without_loads(problem, amplitudes);
  }


  LoadAmplitudes
  SolidTerm::amplitudes_between(const double t_0, const double t_1) const
  {
    LoadAmplitudes middle = amplitudes_at(0.5 * (t_0 + t_1));
    if (!loads_change())
      return middle;
    const LoadAmplitudes first = amplitudes_at(t_0), last = amplitudes_at(t_1);
    const ElasticityProblem &problem = elastic->elasticity_problem();
    const auto set_mean = [&](std::vector<double> LoadAmplitudes::*list,
                              const std::size_t                    n,
                              const auto &is_prescribed) {
      if ((middle.*list).empty())
        (middle.*list).assign(n, 1.);
      for (unsigned int i = 0; i < n; ++i)
        if (is_prescribed(i))
          (middle.*list)[i] =
            0.5 * (amplitude(first.*list, i) + amplitude(last.*list, i));
    };
    set_mean(&LoadAmplitudes::boundary_conditions,
             problem.boundary_conditions.size(),
             [&](const unsigned int c) {
               return !is_load(problem.boundary_conditions[c]);
             });
    set_mean(&LoadAmplitudes::fixed_points,
             problem.fixed_points.size(),
             [](const unsigned int) { return true; });
    return middle;
  }


  /// The energy of conditions is quadratic in the prescribed displacements. So its central
  /// difference is exactly the derivative times their change.
  double
  SolidTerm::work_of_supports(const Vector &u,
                              const double  t,
                              const double  t_0,
                              const double  t_1)
  {
    if (!loads_change())
      return 0.;
    const LoadAmplitudes begin = amplitudes_at(t_0), end = amplitudes_at(t_1);
    LoadAmplitudes       plus = amplitudes_at(t), minus = plus;
    double               largest = 0., work = 0.;
    if (inelastic)
    {
      (void)inelastic->assemble(u, /* with_tangent = */ false);
      work = work_on_inelastic(inelastic->totals(), t_0, t_1);
    }
    const auto spread = [&](const std::vector<double> &from,
                            const std::vector<double> &to,
                            std::vector<double>       &up,
                            std::vector<double>       &down) {
      for (unsigned int i = 0;
           i < std::min({from.size(), to.size(), up.size()});
           ++i)
      {
        const double change = to[i] - from[i];
        largest             = std::max(largest, std::abs(change));
        up[i] += 0.5 * change;
        down[i] -= 0.5 * change;
      }
    };
    spread(begin.boundary_conditions,
           end.boundary_conditions,
           plus.boundary_conditions,
           minus.boundary_conditions);
    spread(begin.fixed_points,
           end.fixed_points,
           plus.fixed_points,
           minus.fixed_points);
    return largest > 0. ? work + energy_of_conditions(u, plus) -
                            energy_of_conditions(u, minus)
                        : work;
  }


  double
  SolidTerm::work_on_inelastic(const InelasticTerms::Totals &totals,
                               const double                  t_0,
                               const double                  t_1) const
  {
    const LoadAmplitudes begin = amplitudes_at(t_0), end = amplitudes_at(t_1);
    double               work = 0.;
    for (unsigned int c = 0; c < totals.support_work.size(); ++c)
      work += totals.support_work[c] *
              (internal::amplitude(end.boundary_conditions, c) -
               internal::amplitude(begin.boundary_conditions, c));
    return work;
  }


  void
  SolidTerm::damp(const RayleighDamping &damping, bool)
  {
    AssertThrow(damping.mass >= 0. && damping.stiffness >= 0.,
                InputError("A coefficient of Rayleigh damping is negative",
                           "",
                           "choose both at least 0"));
    AssertThrow(damping.mass == 0. || layout().mass != nullptr,
                InputError("A solid without masses is damped by them",
                           "",
                           "give the mass matrix"));
    damping_by_matrix = damping;
    make_damping_matrix();
  }


  void
  SolidTerm::make_damping_matrix()
  {
    const RayleighDamping &damping = damping_by_matrix;
    damping_matrix.reset();
    if (damping.mass == 0. && damping.stiffness == 0.)
      return;
    damping_matrix   = std::make_unique<Matrix>();
    const auto begin = [this](const double factor, const Matrix &matrix) {
      damping_matrix->reinit(matrix);
      damping_matrix->copy_from(matrix);
      *damping_matrix *= factor;
    };
    if (damping.stiffness == 0.)
    {
      begin(damping.mass, *layout().mass);
      return;
    }
    ++n_changes;
    const ElasticityProblem &problem = elastic->elasticity_problem();
    LoadAmplitudes           free    = amplitudes_at(0.);
    free.released_conditions.assign(problem.boundary_conditions.size(), true);
    free.released_fixed_points.assign(problem.fixed_points.size(), true);
    set_amplitudes(free);
    elastic->assemble_at_rest(0.);
    begin(damping.stiffness, elastic->tangent());
    if (damping.mass > 0.)
      damping_matrix->add(damping.mass, *layout().mass);
  }


  void
  SolidTerm::begin_step(const StepBegin &step)
  {
    if (!inelastic || step.is_at_rest)
      return;
    // the result is admissible, because an accepted state always has a stress
    (void)inelastic->assemble(step.u, /* with_tangent = */ false);
    forces_at_begin = inelastic->residual();
    totals_at_begin = inelastic->totals();
    begin_of_step   = step.u;
    time_at_begin   = step.time;
  }


  StepWork
  SolidTerm::commit(const Trial &step)
  {
    StepWork work;
    if (step.begin != nullptr)
    {
      work = work_of(step);
      if (inelastic)
        work.dissipated += accept_inelastic(step);
    }
    else if (inelastic)
    {
      inelastic->accept(*step.end);
      work.dissipated = inelastic->totals().dissipated;
    }
    return work;
  }


  double
  SolidTerm::accept_inelastic(const Trial &step)
  {
    const double t = step.end_time;
    Vector       force(forces_at_begin);
    double       work = 0.;
    if (is_between(step))
    {
      (void)inelastic->assemble(*step.end,
                                /* with_tangent = */ false,
                                step.begin);
      force = inelastic->residual();
      work  = work_on_inelastic(inelastic->totals(), time_at_begin, t);
      inelastic->accept(*step.end);
    }
    else
    {
      inelastic->accept(*step.end);
      force.sadd(0.5, 0.5, inelastic->residual());
      work = 0.5 * (work_on_inelastic(totals_at_begin, time_at_begin, t) +
                    work_on_inelastic(inelastic->totals(), time_at_begin, t));
    }
    Vector motion(*step.end), owned_motion(force);
    motion -= begin_of_step;
    owned_motion = motion;
    return force * owned_motion + work -
           (inelastic->totals().energy - totals_at_begin.energy);
  }


  void
  SolidTerm::forget()
  {
    if (inelastic)
      inelastic->forget_states();
  }


  void
  SolidTerm::save(ByteWriter &archive) const
  {
    if (!inelastic)
      return;
    std::vector<char> state = inelastic->internal_state();
    archive.transfer(state.data(), state.size());
  }


  void
  SolidTerm::restore(ByteReader &archive)
  {
    if (!inelastic)
      return;
    std::vector<char> state(archive.n_left());
    archive.transfer(state.data(), state.size());
    inelastic->restore_internal_state(state);
  }


  StepWork
  SolidTerm::work_of(const Trial &step)
  {
    const double t_0 = step.begin_time, t_1 = step.end_time;
    StepWork     work;
    Vector       begin(layout().locally_owned, layout().communicator);
    Vector       change(begin), loads(begin);
    begin  = *step.begin;
    change = *step.end;
    change -= begin;
    if (damping_matrix)
    {
      damping_matrix->vmult(loads, change);
      layout().constraints->set_zero(loads);
      work.dissipated = loads * change / (t_1 - t_0);
    }
    if (step.is_conserving)
    {
      Vector middle(zero);
      begin.add(0.5, change);
      middle = begin;
      external_forces(middle, 0.5 * (t_0 + t_1), loads);
      work.loads    = loads * change;
      work.supports = work_of_supports_between(step, middle);
      return work;
    }
    if (!last_loads_at || *last_loads_at != t_0)
      external_forces(*step.begin, t_0, last_loads);
    external_forces(*step.end, t_1, loads);
    last_loads += loads;
    work.loads = 0.5 * (last_loads * change);
    last_loads.swap(loads);
    last_loads_at = t_1;
    work.supports = 0.5 * (work_of_supports(*step.begin, t_0, t_0, t_1) +
                           work_of_supports(*step.end, t_1, t_0, t_1));
    return work;
  }


  SolidTerm::Vector
  SolidTerm::residual_at(const Vector &u, const double t)
  {
    AssembledForces sum;
    Trial           trial = Trial::at(u, t);
    trial.with_energies   = false;
    (void)assemble(trial, sum);
    return *sum.residual;
  }


  double
  SolidTerm::strain_energy_at(const Vector &u, const double t)
  {
    AssembledForces sum;
    (void)assemble(Trial::at(u, t), sum);
    return sum.strain_energy;
  }


  std::unique_ptr<SolidTerm>
  make_solid(FiniteElasticity                        &elasticity,
             const Kinematics                         kinematics,
             Loading                                  loading,
             std::shared_ptr<const SolidTerm::Matrix> mass)
  {
    if (kinematics == Kinematics::finite)
      return std::make_unique<FiniteSolid>(elasticity,
                                           std::move(loading),
                                           std::move(mass));
    return std::make_unique<SmallSolid>(elasticity,
                                        std::move(loading),
                                        std::move(mass));
  }


  std::unique_ptr<SolidTerm>
  make_solid_at_rest(FiniteElasticity     &elasticity,
                     const Kinematics      kinematics,
                     const LoadAmplitudes &full)
  {
    return make_solid(elasticity,
                      kinematics,
                      proportional_loading(elasticity.elasticity_problem(),
                                           full));
  }


  bool
  SolidTerm::set_amplitudes(const LoadAmplitudes &amplitudes)
  {
    if (internal::equal(amplitudes, current))
      return false;
    n_changes += internal::releases_more(current, amplitudes) ||
                 internal::releases_more(amplitudes, current);
    elastic->set_amplitudes(amplitudes);
    current = amplitudes;
    return true;
  }


  bool
  SolidTerm::loses_supports_at(const double t) const
  {
    return internal::releases_more(current, amplitudes_at(t));
  }


  bool
  SolidTerm::loads_change() const
  {
    return static_cast<bool>(loading.amplitudes);
  }


  void
  SolidTerm::add_base_force(const double t,
                            const double scale,
                            Vector      &forces) const
  {
    if (!loading.base_acceleration)
      return;
    const dealii::Tensor<1, 2> a = loading.base_acceleration(t);
    for (unsigned int c = 0; c < 2; ++c)
      if (a[c] != 0.)
        forces.add(scale * a[c], mass_of_translation[c]);
  }


  SolidTerm::Vector
  interpolate_velocity(
    const CoverSystem                                             &covers,
    const dealii::AffineConstraints<double>                       &constraints,
    const std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &,
                                             unsigned int block)> &velocity)
  {
    const ManifoldMesh     &mesh  = covers.manifold_mesh();
    const dealii::IndexSet &owned = covers.locally_owned_covers();
    SolidTerm::Vector       result(covers.locally_owned_dofs(2),
                             covers.communicator());
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      for (const unsigned int k : covers.covers(e))
        if (owned.is_element(k))
        {
          const dealii::Tensor<1, 2> v =
            velocity(covers.node(k), mesh.block(e));
          for (unsigned int c = 0; c < 2; ++c)
            result(unknown_of(k, c)) = v[c];
        }
    result.compress(dealii::VectorOperation::insert);
    constraints.distribute(result);
    return result;
  }


  dealii::Tensor<1, 2>
  RigidVelocity::operator()(const dealii::Point<2> &x) const
  {
    dealii::Tensor<1, 2> v = translation;
    v[0] -= angular_velocity * (x[1] - center[1]);
    v[1] += angular_velocity * (x[0] - center[0]);
    return v;
  }
} // namespace NMM
