#include <nmm/mechanics/solid_term.h>

#include <algorithm>
#include <cmath>
#include <mechanics/load_amplitudes.h>

namespace NMM
{
  SmallSolid::SmallSolid(FiniteElasticity             &elasticity,
                         Loading                       loading,
                         std::shared_ptr<const Matrix> mass)
    : SolidTerm(elasticity, std::move(loading), std::move(mass))
  {
    for (Vector *vector : {&owned,
                           &forces,
                           &initial.forces,
                           &with_loads.forces,
                           &with_supports.forces})
      vector->reinit(layout().locally_owned, layout().communicator);
    finish_construction();
  }


  SmallSolid::~SmallSolid() = default;


  void
  SmallSolid::update(Part &part, const LoadAmplitudes &amplitudes)
  {
    if (part.is_known && internal::equal(part.amplitudes, amplitudes))
      return;
    set_amplitudes(amplitudes);
    elastic->assemble_linearized(zero, 1.);
    part.forces = elastic->residual();
    part.forces *= -1.;
    part.scale      = elastic->force_scale();
    part.amplitudes = amplitudes;
    part.is_known   = true;
  }


  void
  SmallSolid::update(const LoadAmplitudes &amplitudes)
  {
    const ElasticityProblem &problem = elastic->elasticity_problem();
    const LoadAmplitudes     loads =
                           internal::without_prescribed(problem, amplitudes),
                         supports =
                           internal::without_loads(problem, amplitudes);
    set_amplitudes(amplitudes);
    if (!has_stiffness || stiffness_at != version())
    {
      elastic->assemble_at_rest(1.);
      stiffness_at     = version();
      has_stiffness    = true;
      initial.is_known = with_loads.is_known = with_supports.is_known = false;
      update(initial, internal::without_prescribed(problem, supports));
    }
    update(with_loads, loads);
    update(with_supports, supports);
    set_amplitudes(amplitudes);
  }


  ForceProperties
  SmallSolid::properties() const
  {
    const bool is_symmetric =
      inelastic == nullptr || inelastic->totals().n_yielding == 0;
    return {/* is_linear = */ inelastic == nullptr,
            is_symmetric,
            /* is_symmetric_between = */ is_symmetric};
  }


  Deformation
  SmallSolid::add_inelastic(const Vector    &u,
                            const double     share,
                            const bool       with_tangent,
                            AssembledForces &sum)
  {
    if (inelastic->assemble(u, with_tangent) != Deformation::admissible)
      return Deformation::inverted;
    forces.add(share, inelastic->residual());
    sum.scale = std::hypot(sum.scale, inelastic->totals().force_scale);
    sum.strain_energy += inelastic->totals().energy;
    if (with_tangent)
      sum.tangent = &inelastic->add_to(elastic->tangent());
    return Deformation::admissible;
  }


  Deformation
  SmallSolid::assemble(const Trial &trial, AssembledForces &sum)
  {
    const double t_0 = trial.begin_time, t_1 = trial.end_time;
    if (trial.is_conserving)
    {
      owned  = *trial.begin;
      forces = *trial.end;
      owned.sadd(0.5, 0.5, forces);
      assemble_owned(0.5 * (t_0 + t_1), amplitudes_between(t_0, t_1));
      if (inelastic)
        forces.add(0.5, forces_at_begin);
    }
    else
    {
      const LoadAmplitudes amplitudes = amplitudes_at(t_1);
      owned                           = *trial.end;
      assemble_owned(t_1, amplitudes);
      if (trial.with_energies && trial.blocks().empty())
        add_energies(*trial.end, amplitudes, sum);
    }
    sum.residual = &forces;
    sum.scale    = trial.with_energies || trial.is_conserving
                     ? std::hypot(with_loads.scale, elastic_scale)
                     : scale_at_rest();
    if (damping() != nullptr)
      sum.damping.push_back(damping());
    const bool with_tangent = trial.tangent != Tangent::none;
    if (with_tangent)
      sum.tangent = &elastic->tangent();
    if (!inelastic)
      return Deformation::admissible;
    // Conserving forces are the mean of those at both ends. Its derivative with respect to the mean
    // displacement is that of the force at the end with respect to the end.
    return add_inelastic(*trial.end,
                         trial.is_conserving ? 0.5 : 1.,
                         with_tangent,
                         sum);
  }


  /// The forces of initial stress are in both parts.
  double
  SmallSolid::scale_at_rest() const
  {
    const double a = with_loads.scale, b = with_supports.scale,
                 common = initial.scale;
    return std::sqrt(std::max(a * a, a * a + (b - common) * (b + common)));
  }


  /// The scale is that of internal forces and of supports; loads have a scale of their own.
  void
  SmallSolid::add_energies(const Vector         &u,
                           const LoadAmplitudes &amplitudes,
                           AssembledForces      &sum)
  {
    set_amplitudes(
      internal::without_loads(elastic->elasticity_problem(), amplitudes));
    elastic->assemble_linearized(u, 1.);
    set_amplitudes(amplitudes);
    sum.strain_energy        = elastic->energies().strain;
    sum.energy_of_conditions = elastic->energies().conditions;
    elastic_scale            = elastic->force_scale();
  }


  void
  SmallSolid::assemble_owned(const double t, const LoadAmplitudes &amplitudes)
  {
    update(amplitudes);
    elastic->tangent().vmult(forces, owned);
    // the diagonal entries of constrained and absent unknowns are arbitrary
    layout().constraints->set_zero(forces);
    for (const auto i : layout().absent_unknowns)
      forces(i) = 0.;
    forces.compress(dealii::VectorOperation::insert);
    // the forces of initial stress are in both parts
    forces -= with_loads.forces;
    forces -= with_supports.forces;
    forces += initial.forces;
    add_base_force(t, 1., forces);
  }


  void
  SmallSolid::external_forces(const Vector &, const double t, Vector &result)
  {
    update(amplitudes_at(t));
    result = with_loads.forces;
    result -= initial.forces;
    add_base_force(t, -1., result);
  }


  double
  SmallSolid::energy_of_conditions(const Vector         &u,
                                   const LoadAmplitudes &amplitudes)
  {
    set_amplitudes(amplitudes);
    elastic->assemble_linearized(u, 1.);
    return elastic->energies().conditions;
  }


  /// The energy is quadratic in the prescribed displacements, whose mean is that of the step.
  double
  SmallSolid::work_of_supports_between(const Trial &step, const Vector &mean)
  {
    if (!loads_change())
      return 0.;
    const double t_0 = step.begin_time, t_1 = step.end_time;
    double       work = energy_of_conditions(mean, amplitudes_at(t_1)) -
                  energy_of_conditions(mean, amplitudes_at(t_0));
    if (inelastic)
      for (const Vector *u : {step.begin, step.end})
      {
        (void)inelastic->assemble(*u, /* with_tangent = */ false);
        work += 0.5 * work_on_inelastic(inelastic->totals(), t_0, t_1);
      }
    return work;
  }
} // namespace NMM
