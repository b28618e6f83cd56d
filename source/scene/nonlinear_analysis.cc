#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <scene/current_stress.h>
#include <scene/nonlinear_analysis.h>
#include <scene/parsing.h>
#include <scene/static_start.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;
    using Stage        = Progress::Stage;
    namespace Parallel = dealii::Utilities::MPI;

    void
    NonlinearAnalysis::make_system()
    {
      const SceneParameters &parameters = scene.parameters();
      EquilibriumParameters  how;
      how.kinematics = parameters.model.kinematics;
      how.full       = scene.loads_before_stages();
      how.newton     = show_iterations(parameters.newton.newton, progress);
      bolts          = SceneBolts::make(scene);
      if (bolts)
        how.further_terms = {bolts->maker()};
      joint_water = SceneJointWater::make(scene);
      if (joint_water)
        how.further_terms.push_back(
          joint_water->maker(/* is_at_rest = */ true));
      try
      {
        equilibrium =
          std::make_unique<Equilibrium>(*solid, problem, how, contact.get());
      }
      catch (const NumericalFailure &)
      {
        failure = std::current_exception();
      }
      stages = scene.make_stages(*physical_mesh);

      const auto [first, last] = solid->covers().locally_owned_elements();
      for (unsigned int element = first; element < last; ++element)
        for (const QuadraticTriangle &triangle :
             triangulate(solid->manifold_mesh(), element))
          for (const Point<2> &x : triangle)
            output_points.emplace_back(
              element,
              solid->mathematical_mesh().real_to_reference(
                solid->manifold_mesh().cell(element), x));
    }


    ElasticityProblem
    NonlinearAnalysis::problem_now() const
    {
      return equilibrium->problem_now();
    }


    bool
    NonlinearAnalysis::has_large_displacements() const
    {
      return scene.parameters().model.kinematics != Kinematics::small;
    }


    void
    NonlinearAnalysis::solve()
    {
      if (failure)
        std::rethrow_exception(failure);
      const auto finish = [&]() {
        if (!history.empty())
        {
          Stage stage(progress, "stress recovery");
          show();
        }
      };
      write_history();
      try
      {
        Stage stage(progress, "load steps");
        run_stages();
      }
      catch (const NumericalFailure &)
      {
        finish();
        verify();
        throw;
      }
      catch (const Stopped &)
      {
        finish();
        verify();
        throw;
      }
      finish();
      if (crack_tips)
        for (const std::string &line : crack_tips->description())
          progress.message("  " + line);
      if (bolts)
        for (const std::string &line : bolts->description())
          progress.message("  " + line);
      is_solved = true;
    }


    void
    NonlinearAnalysis::run_stages()
    {
      if (!contact && problem.has_varying_initial_stress())
        report_initial_balance(equilibrium->initial_forces());
      try
      {
        const auto after_step = [this](const ContactStep &step,
                                       const Vector &u) { add_step(step, u); };
        const auto agree      = [&]() {
          if (joint_water)
            joint_water->repeat_until_flow_agrees(*equilibrium, after_step);
        };
        equilibrium->run_stages(
          scene.parameters().load_steps.load_steps(),
          stages,
          after_step,
          [&](const unsigned int i) {
            agree();
            progress.message("    " + describe_stage(scene, i));
            removed_blocks.insert(removed_blocks.end(),
                                  stages[i].removed_blocks.begin(),
                                  stages[i].removed_blocks.end());
          });
        agree();
      }
      catch (const NumericalFailure &)
      {
        n_last_cuts       = equilibrium->last_attempt().n_cuts;
        n_last_iterations = equilibrium->last_attempt().n_lost_iterations;
        throw;
      }
    }


    std::string
    NonlinearAnalysis::describe_step(const double load_factor) const
    {
      std::ostringstream text;
      text << "load factor " << load_factor;
      if (load_factor > 1. && !stages.empty())
      {
        const auto i = static_cast<unsigned int>(std::ceil(load_factor)) - 2;
        text << " (stage '" << scene.parameters().stages[i].name << "')";
      }
      return text.str();
    }


    bool
    NonlinearAnalysis::is_removed(const unsigned int element) const
    {
      return std::find(removed_blocks.begin(),
                       removed_blocks.end(),
                       solid->manifold_mesh().block(element)) !=
             removed_blocks.end();
    }


    void
    NonlinearAnalysis::add_step(const ContactStep &step, const Vector &solution)
    {
      if (contact && history.empty())
        report_initial_balance(equilibrium->initial_forces());
      HistoryRow row;
      row.load_factor       = step.load_factor;
      row.n_iterations      = step.n_iterations;
      row.n_cuts            = step.n_cuts;
      row.n_lost_iterations = step.n_lost_iterations;
      row.relative_residual = step.relative_residual;
      row.strain_energy =
        problem.thickness *
        equilibrium->solid_term().strain_energy_at(solution, step.load_factor);
      if (contact)
        row.contact_numbers = contact->numbers(problem.thickness);
      field =
        std::make_unique<DisplacementField>(solid->covers(), problem, solution);
      const InelasticTerms *terms = inelastic_terms();
      if (!has_large_displacements())
        row.strain_energy =
          small_strain_energy() +
          (terms == nullptr ? 0. : problem.thickness * terms->totals().energy);
      if (terms != nullptr)
        row.plastic =
          HistoryRow::Plastic{problem.thickness * equilibrium->material_work(),
                              terms->totals().yielded_area};
      row.max_displacement = find_max_displacement();
      AssertThrow(
        std::isfinite(row.strain_energy) && std::isfinite(row.max_displacement),
        NumericalFailure("The strain energy or a displacement is not finite",
                         describe_step(row.load_factor),
                         "look for loads and stiffness of extreme size"));

      const auto [first, last] = solid->covers().locally_owned_elements();
      for (const ProbePoints::Entry &entry : probes->entries())
        if (!scene.parameters().probes[entry.probe].is_line)
        {
          Tensor<1, 2> u;
          if (entry.element >= first && entry.element < last &&
              is_removed(entry.element))
            u[0] = u[1] = std::numeric_limits<double>::quiet_NaN();
          else if (entry.element >= first && entry.element < last)
            u =
              field->displacement(entry.element,
                                  solid->mathematical_mesh().real_to_reference(
                                    solid->manifold_mesh().cell(entry.element),
                                    entry.x));
          row.probe_displacements.push_back(Parallel::sum(u, communicator));
        }
      compute_intensity_factors();
      if (crack_tips)
        row.tip_numbers = crack_tips->numbers();
      history.push_back(row);
      if (bolts)
      {
        bolts->take_state(solution);
        bolts->add_rows(history.size(), row.load_factor);
        series->show_bolts(bolts.get());
      }

      std::ostringstream line;
      line << "    load factor " << std::left << std::setw(10)
           << row.load_factor << std::right << std::setw(3) << row.n_iterations
           << " iteration(s), " << row.n_cuts << " cut(s), residual "
           << std::scientific << std::setprecision(1) << row.relative_residual;
      if (row.plastic)
        line << "; " << std::setprecision(4) << std::defaultfloat
             << row.plastic->yielded_area << " "
             << scene.parameters().output.length_unit << "^2 have yielded";
      if (contact)
        line << "; " << contact->progress();
      if (bolts)
        line << "; " << bolts->progress();
      if (joint_water)
        line << "; " << joint_water->progress();
      progress.message(line.str());

      last_solution = solution;
      write_history();
      const unsigned int every = scene.parameters().output.fields_every;
      if (every > 0 && history.size() % every == 0)
        write_state(row, history.size() / every);
      stop_if_asked(communicator);
    }


    double
    NonlinearAnalysis::find_max_displacement() const
    {
      double largest = 0.;
      for (const auto &[element, xi] : output_points)
        if (!is_removed(element))
          largest = std::max(largest, field->displacement(element, xi).norm());
      return Parallel::max(largest, communicator);
    }


    void
    NonlinearAnalysis::write_state(const HistoryRow  &row,
                                   const unsigned int number)
    {
      show();
      series->write(number,
                    last_value(),
                    describe_step(row.load_factor),
                    *evaluator,
                    sample_cracks().get());
    }


    void
    NonlinearAnalysis::show()
    {
      evaluator.reset();
      recovery.reset();
      field    = std::make_unique<DisplacementField>(solid->covers(),
                                                  problem,
                                                  last_solution);
      recovery = std::make_unique<StressRecovery>(*field, solid->aggregation());
      // Assemble again, since the last assembly may be that of a step that failed.
      if (inelastic_terms() != nullptr)
        (void)equilibrium->solid_term().inelastic_terms()->assemble(
          last_solution,
          /* with_tangent = */ false);
      evaluator = std::make_unique<FieldEvaluator>(
        *field,
        *recovery,
        problem,
        CurrentStress::of(equilibrium->solid_term(), solid->quadrature()));
      evaluator->hide_blocks(removed_blocks);
      if (inelastic_terms() != nullptr)
        evaluator->set_plastic_strain(CurrentStress::plastic_strain(
          *inelastic_terms(), solid->covers(), solid->quadrature()));
    }


    void
    NonlinearAnalysis::verify()
    {
      unsigned int n_iterations = n_last_iterations, n_cuts = n_last_cuts;
      for (const HistoryRow &row : history)
      {
        n_iterations += row.n_iterations + row.n_lost_iterations;
        n_cuts += row.n_cuts;
      }
      summary.add("load_steps", history.size());
      summary.add("newton_iterations", n_iterations);
      summary.add("cuts", n_cuts);
      summary.add("load_factor", reached_load_factor());
      if (!stages.empty())
        summary.add("removed_blocks", removed_blocks.size());
      if (history.empty())
        return;
      summary.add("final_residual", history.back().relative_residual);
      summary.add("direct_stress_covers",
                  Parallel::sum(recovery->n_direct(), communicator));
      summary.add("strain_energy",
                  history.back().strain_energy,
                  scene.parameters().output.stress_unit + "*" +
                    scene.parameters().output.length_unit + "^3");
      if (history.back().plastic)
      {
        summary.add("plastic_dissipation",
                    history.back().plastic->dissipation,
                    scene.parameters().output.stress_unit + "*" +
                      scene.parameters().output.length_unit + "^3");
        summary.add("yielded_area",
                    history.back().plastic->yielded_area,
                    scene.parameters().output.length_unit + "^2");
      }
      if (contact)
        contact->add_to_summary(summary);
      if (bolts)
        bolts->add_to(summary);
      if (joint_water)
        joint_water->add_to(summary);
      if (crack_tips)
        crack_tips->add_to(summary);
    }


    const InelasticTerms *
    NonlinearAnalysis::inelastic_terms() const
    {
      return equilibrium ? equilibrium->solid_term().inelastic_terms()
                         : nullptr;
    }


    double
    NonlinearAnalysis::reached_load_factor() const
    {
      return history.empty() ? 0. : history.back().load_factor;
    }


    double
    NonlinearAnalysis::last_value() const
    {
      // programs that show a series want values that ascend
      return scene.parameters().load_steps.load_steps().are_ascending()
               ? reached_load_factor()
               : history.size();
    }


    std::string
    NonlinearAnalysis::unsolved_note() const
    {
      std::ostringstream note;
      if (history.empty())
        note << "not solved";
      else
        note << "solved up to " << describe_step(reached_load_factor());
      return note.str();
    }


    void
    NonlinearAnalysis::write_history() const
    {
      if (is_first_rank())
        directory->write_text("history.csv",
                              [&](std::ostream &out) { write_history(out); });
      if (is_first_rank() && bolts)
        bolts->write(*directory);
      if (is_first_rank() && joint_water)
        joint_water->write(*directory);
    }


    void
    NonlinearAnalysis::write_history(std::ostream &out) const
    {
      out << "step,load_factor,iterations,cuts,relative_residual,strain_energy,"
             "max_displacement";
      for (const Probe &probe : scene.parameters().probes)
        if (!probe.is_line)
          out << ',' << quoted(probe.name + "_x") << ','
              << quoted(probe.name + "_y");
      if (inelastic_terms() != nullptr)
        out << ",plastic_dissipation,yielded_area";
      if (contact)
        for (const std::string &column : contact->columns())
          out << ',' << quoted(column);
      if (crack_tips)
        for (const std::string &column : crack_tips->columns())
          out << ',' << column;
      out << '\n' << std::setprecision(12);
      for (unsigned int i = 0; i < history.size(); ++i)
      {
        const HistoryRow &row = history[i];
        out << i + 1 << ',' << row.load_factor << ',' << row.n_iterations << ','
            << row.n_cuts << ',' << row.relative_residual << ','
            << row.strain_energy << ',' << row.max_displacement;
        for (const Tensor<1, 2> &u : row.probe_displacements)
          out << ',' << u[0] << ',' << u[1];
        if (row.plastic)
          out << ',' << row.plastic->dissipation << ','
              << row.plastic->yielded_area;
        for (const double value : row.contact_numbers)
          out << ',' << value;
        for (const double value : row.tip_numbers)
          out << ',' << value;
        out << '\n';
      }
    }
  } // namespace internal
} // namespace NMM
