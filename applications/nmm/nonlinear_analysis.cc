#include "nonlinear_analysis.h"

#include <nmm/base/exceptions.h>
#include <nmm/io/vtu.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

using namespace NMM;
using dealii::Point;
using dealii::Tensor;
using Stage        = Progress::Stage;
namespace Parallel = dealii::Utilities::MPI;

void
NonlinearAnalysis::make_system()
{
  region_to_material = problem.region_to_material(*physical_mesh);
  try
  {
    if (scene.parameters().model.kinematics == Kinematics::finite)
      finite = std::make_unique<FiniteElasticity>(*covers,
                                                  *quadrature,
                                                  constraints,
                                                  problem);
    else
      incremental = std::make_unique<IncrementalElasticity>(*covers,
                                                            *quadrature,
                                                            constraints,
                                                            problem);
  }
  catch (const NumericalFailure &)
  {
    failure = std::current_exception();
  }

  const auto [first, last] = covers->locally_owned_elements();
  for (unsigned int element = first; element < last; ++element)
    for (const QuadraticTriangle &triangle :
         triangulate(*manifold_mesh, element))
      for (const Point<2> &x : triangle)
        output_points.emplace_back(element,
                                   mathematical_mesh->real_to_reference(
                                     manifold_mesh->cell(element), x));
}


void
NonlinearAnalysis::solve()
{
  if (failure)
    std::rethrow_exception(failure);
  const auto finish = [&]() {
    if (last_state)
    {
      Stage stage(progress, "stress recovery");
      show(*last_state);
    }
  };
  try
  {
    Stage stage(progress, "load steps");
    if (finite)
      run_finite();
    else
      run_incremental();
  }
  catch (const NumericalFailure &)
  {
    finish();
    verify();
    throw;
  }
  finish();
  is_solved = true;
}


void
NonlinearAnalysis::run_finite()
{
  const SceneParameters &parameters = scene.parameters();
  NonlinearStatics       statics(*finite, parameters.newton.newton);
  statics.run(parameters.load_steps.load_steps(),
              [&](const LoadStep &step, const Vector &solution) {
                HistoryRow row;
                row.load_factor       = step.load_factor;
                row.n_iterations      = step.newton.iterations.size();
                row.n_cuts            = step.n_cuts;
                row.n_lost_iterations = step.n_lost_iterations;
                row.relative_residual = step.newton.relative_residual;
                row.strain_energy =
                  problem.thickness * finite->energies().strain;
                add_step(row, solution);
              });
}


void
NonlinearAnalysis::run_incremental()
{
  for (const double factor :
       scene.parameters().load_steps.load_steps().load_factors)
  {
    incremental->step(factor);
    HistoryRow row;
    row.load_factor       = factor;
    row.n_iterations      = 1;
    row.relative_residual = std::numeric_limits<double>::quiet_NaN();
    add_step(row, incremental->solution());
  }
}


void
NonlinearAnalysis::add_step(HistoryRow row, const Vector &solution)
{
  field = std::make_unique<DisplacementField>(*covers, problem, solution);
  if (incremental)
    row.strain_energy = incremental_strain_energy();
  double largest = 0.;
  for (const auto &[element, xi] : output_points)
    largest = std::max(largest, field->displacement(element, xi).norm());
  row.max_displacement = Parallel::max(largest, communicator);

  const auto [first, last] = covers->locally_owned_elements();
  for (const ProbePoints::Entry &entry : probes->entries())
    if (!scene.parameters().probes[entry.probe].is_line)
    {
      Tensor<1, 2> u;
      if (entry.element >= first && entry.element < last)
        u = field->displacement(entry.element,
                                mathematical_mesh->real_to_reference(
                                  manifold_mesh->cell(entry.element), entry.x));
      row.probe_displacements.push_back(Parallel::sum(u, communicator));
    }
  history.push_back(row);

  std::ostringstream line;
  line << "    load factor " << std::left << std::setw(10) << row.load_factor
       << std::right << std::setw(3) << row.n_iterations << " iteration(s)";
  if (finite)
    line << ", " << row.n_cuts << " cut(s), residual " << std::scientific
         << std::setprecision(1) << row.relative_residual;
  progress.message(line.str());

  last_state = std::make_unique<State>(
    State{row.load_factor,
          solution,
          incremental ? incremental->stresses() : std::vector<Stress>()});
  const unsigned int every = scene.parameters().output.fields_every;
  if (every > 0 && history.size() % every == 0)
    series.push_back(*last_state);
}


void
NonlinearAnalysis::show(const State &state)
{
  evaluator.reset();
  recovery.reset();
  field = std::make_unique<DisplacementField>(*covers, problem, state.solution);
  recovery = std::make_unique<StressRecovery>(*field, aggregation);
  if (incremental)
    fit_stresses(state);
  evaluator = std::make_unique<FieldEvaluator>(
    *field,
    *recovery,
    problem,
    [this](const unsigned int  element,
           const Point<2>     &xi,
           const Tensor<2, 2> &gradient) {
      return finite ? finite_stress(element, gradient)
                    : incremental_stress(element, xi);
    });
}


void
NonlinearAnalysis::fit_stresses(const State &state)
{
  linear_stresses.clear();
  const auto [first, last] = covers->locally_owned_elements();
  auto stress              = state.stresses.begin();
  for (unsigned int element = first; element < last; ++element)
  {
    const dealii::Quadrature<2> &rule = quadrature->rule(element);
    double                       sum  = 0.;
    LinearStress                 fit;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      sum += rule.weight(q);
      fit.mean += rule.weight(q) * stress[q];
      fit.center += rule.weight(q) * Tensor<1, 2>(rule.point(q));
    }
    fit.mean /= sum;
    fit.center /= sum;

    Tensor<2, 2> moments;
    Stress       first_moments[2];
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const Tensor<1, 2> d = rule.point(q) - fit.center;
      moments += rule.weight(q) * dealii::outer_product(d, d);
      for (unsigned int c = 0; c < 2; ++c)
        first_moments[c] += rule.weight(q) * d[c] * stress[q];
    }
    // Points on a line, or one alone, do not tell how stress varies.
    const double trace = moments[0][0] + moments[1][1];
    if (dealii::determinant(moments) > 1e-8 * trace * trace)
    {
      const Tensor<2, 2> inverse = dealii::invert(moments);
      for (unsigned int c = 0; c < 2; ++c)
        fit.slope[c] =
          inverse[c][0] * first_moments[0] + inverse[c][1] * first_moments[1];
    }
    linear_stresses.push_back(fit);
    stress += rule.size();
  }
  Assert(stress == state.stresses.end(), dealii::ExcInternalError());
}


namespace
{
  /// Cauchy stress across the plane in plane strain [Pa].
  double
  out_of_plane_cauchy_stress(const Material &material, const Tensor<2, 2> &F)
  {
    const double J       = dealii::determinant(F);
    const double squares = dealii::scalar_product(F, F);
    const double nu      = material.poissons_ratio;
    const auto   moduli  = material.plane_elasticity(PlaneState::plane_strain);
    if (material.law != MaterialLaw::neo_hookean)
      return moduli.lambda * 0.5 * (squares - 2.) / J;
    const double bulk_modulus = material.youngs_modulus / (3. * (1. - 2. * nu));
    return (moduli.mu * std::pow(J, -2. / 3.) * (1. - (squares + 1.) / 3.)) /
             J +
           bulk_modulus * (J - 1.);
  }
} // namespace


FieldSample::Stress
NonlinearAnalysis::finite_stress(const unsigned int  element,
                                 const Tensor<2, 2> &gradient) const
{
  Tensor<2, 2> F = gradient;
  F[0][0] += 1.;
  F[1][1] += 1.;
  const unsigned int  region = manifold_mesh->region(element);
  FieldSample::Stress stress;
  if (finite->law(region).cauchy_stress(F, stress.in_plane) !=
      Deformation::admissible)
  {
    // Where the solution is turned inside out there is no stress.
    const double nan      = std::numeric_limits<double>::quiet_NaN();
    stress.in_plane[0][0] = stress.in_plane[1][1] = stress.in_plane[0][1] =
      stress.zz                                   = nan;
    return stress;
  }
  if (problem.plane_state == PlaneState::plane_strain)
    stress.zz =
      out_of_plane_cauchy_stress(problem.materials[region_to_material[region]],
                                 F);
  return stress;
}


FieldSample::Stress
NonlinearAnalysis::incremental_stress(const unsigned int element,
                                      const Point<2>    &xi) const
{
  const LinearStress &fit =
    linear_stresses[element - covers->locally_owned_elements().first];
  FieldSample::Stress stress;
  stress.in_plane = fit.mean + (xi[0] - fit.center[0]) * fit.slope[0] +
                    (xi[1] - fit.center[1]) * fit.slope[1];
  if (problem.plane_state == PlaneState::plane_strain)
  {
    // sigma_zz = nu (sigma_xx + sigma_yy) of what strain has caused.
    const Material &material =
      problem.materials[region_to_material[manifold_mesh->region(element)]];
    stress.zz =
      material.poissons_ratio *
      (dealii::trace(stress.in_plane) - dealii::trace(material.initial_stress));
  }
  return stress;
}


double
NonlinearAnalysis::incremental_strain_energy() const
{
  const auto [first, last] = covers->locally_owned_elements();
  auto   stress            = incremental->stresses().begin();
  double energy            = 0.;
  for (unsigned int element = first; element < last; ++element)
  {
    const dealii::Quadrature<2> &rule = quadrature->rule(element);
    const double                 determinant =
      2. * mathematical_mesh->cell_area(manifold_mesh->cell(element));
    const PlaneElasticity moduli =
      problem.materials[region_to_material[manifold_mesh->region(element)]]
        .plane_elasticity(problem.plane_state);
    for (unsigned int q = 0; q < rule.size(); ++q, ++stress)
    {
      Tensor<2, 2> F = field->gradient(element, rule.point(q));
      F[0][0] += 1.;
      F[1][1] += 1.;
      const double trace = dealii::trace(*stress);
      const double density =
        (*stress * *stress -
         moduli.lambda / (2. * (moduli.lambda + moduli.mu)) * trace * trace) /
        (4. * moduli.mu);
      energy += determinant * rule.weight(q) * dealii::determinant(F) * density;
    }
  }
  return problem.thickness * Parallel::sum(energy, communicator);
}


void
NonlinearAnalysis::verify()
{
  unsigned int n_iterations = 0, n_cuts = 0;
  for (const HistoryRow &row : history)
  {
    n_iterations += row.n_iterations + row.n_lost_iterations;
    n_cuts += row.n_cuts;
  }
  summary.add("load_steps", history.size());
  summary.add("newton_iterations", finite ? n_iterations : 0);
  summary.add("cuts", n_cuts);
  summary.add("load_factor", history.empty() ? 0. : history.back().load_factor);
  if (history.empty())
    return;
  if (finite)
  {
    summary.add("final_residual", history.back().relative_residual);
    summary.add("direct_stress_covers",
                Parallel::sum(recovery->n_direct(), communicator));
  }
  summary.add("strain_energy",
              history.back().strain_energy,
              scene.parameters().output.stress_unit + "*" +
                scene.parameters().output.length_unit + "^3");
}


void
NonlinearAnalysis::write_more(const OutputDirectory &directory)
{
  const bool is_first = Parallel::this_mpi_process(communicator) == 0;
  if (is_first)
    directory.write_text("history.csv",
                         [&](std::ostream &out) { write_history(out); });
  if (scene.parameters().output.fields_every == 0 || !last_state)
    return;

  std::vector<std::pair<double, std::string>> files;
  for (const State &state : series)
    if (state.load_factor < last_state->load_factor)
    {
      show(state);
      std::ostringstream name;
      name << "fields-" << std::setw(4) << std::setfill('0')
           << files.size() + 1;
      files.emplace_back(state.load_factor,
                         write_fields_of_state(*covers,
                                               FieldTriangles(*covers,
                                                              evaluator.get()),
                                               directory,
                                               name.str()));
    }
  show(*last_state);
  files.emplace_back(last_state->load_factor,
                     Parallel::n_mpi_processes(communicator) > 1
                       ? "fields.pvtu"
                       : "fields.vtu");
  if (is_first)
    write_series(files, directory);
}


void
NonlinearAnalysis::write_history(std::ostream &out) const
{
  out << "step,load_factor,iterations,cuts,relative_residual,strain_energy,"
         "max_displacement";
  for (const ProbeParameters &probe : scene.parameters().probes)
    if (!probe.is_line)
      out << ',' << probe.name << "_x," << probe.name << "_y";
  out << '\n' << std::setprecision(12);
  for (unsigned int i = 0; i < history.size(); ++i)
  {
    const HistoryRow &row = history[i];
    out << i + 1 << ',' << row.load_factor << ',' << row.n_iterations << ','
        << row.n_cuts << ',' << row.relative_residual << ','
        << row.strain_energy << ',' << row.max_displacement;
    for (const Tensor<1, 2> &u : row.probe_displacements)
      out << ',' << u[0] << ',' << u[1];
    out << '\n';
  }
}
