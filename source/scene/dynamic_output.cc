#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/dynamics/checkpoint.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <scene/current_stress.h>
#include <scene/dynamic_analysis.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    void
    DynamicAnalysis::open_files()
    {
      const bool is_continued = continues_in_folder();
      // The first state follows after the start.
      const bool has_rows = is_continued && !continues_in_start();
      const int  continue_after =
        has_rows ? static_cast<int>(step_number()) : -1;
      if (is_continued)
        series->resume(has_rows ? time() : -1.);
      on_first_rank([&]() {
        if (!is_continued)
          directory->create();
        if (!probe_history->is_empty())
          probe_history->open(directory->file("probes-history.csv"),
                              continue_after);
        history = std::make_unique<CsvSeries>(directory->file("history.csv"),
                                              history_columns(),
                                              continue_after);
        open_departures(continue_after);
        if (is_continued)
          directory->resume();
        if (growth && growth->table().n_increments() > 0)
          growth->table().write(*directory);
      });
      if (!has_start() && !is_continued)
        write_first_state();
      // The states of a relaxation at the start are none of the run.
      else if (contact && !continues_in_start())
        take_contact();
    }


    void
    DynamicAnalysis::take_contact()
    {
      contact->remember_states();
      contact->take_state(motion->contact_account()->friction_work());
    }


    void
    DynamicAnalysis::write_first_state()
    {
      if (contact)
        take_contact();
      write_rows(StepRecord());
      if (scene.parameters().output.fields_every > 0)
        write_state_of_series();
    }


    void
    DynamicAnalysis::after_step(const StepRecord &record)
    {
      cut_notice.note(record);
      ++n_steps;
      n_iterations += record.report.n_iterations;
      if (leaving)
        drop_blocks();
      can_be_saved = false;
      note_energies();
      const std::string fault =
        contact ? contact->find_deep_penetration(
                    contact->last_state().report.largest_penetration)
                : "";
      AssertThrow(fault.empty(),
                  NumericalFailure("There is " + fault,
                                   "time " + std::to_string(time()) +
                                     " s, step " +
                                     std::to_string(step_number()),
                                   "take shorter steps, or choose a higher "
                                   "'Contact/Normal stiffness'"));
      // A crack that leaves a very thin strip can make equations that bring energy.
      AssertThrow(
        !growth || growth->table().n_increments() == 0 || !balance_is_off(),
        NumericalFailure(
          "A crack that has grown has left equations that bring energy",
          "time " + std::to_string(time()) + " s, step " +
            std::to_string(step_number()),
          "choose another 'Fracture/Increment' or "
          "'Fracture/Grading'"));
      can_be_saved = true;
      last_good    = motion->integrator().state();
      warn_of_turns(record.report.step);
      write_rows(record);
      const OutputParameters &output = scene.parameters().output;
      if (output.fields_every > 0 && step_number() % output.fields_every == 0)
        write_state_of_series();
      // The checkpoint is written last, so that all files of the steps before it are complete.
      const bool is_last_step = is_asked_to_stop(communicator);
      if (is_checkpoint_due(step_number()) ||
          (is_last_step && scene.parameters().may_be_continued()))
        write_checkpoint();
      show_progress();
      if (is_last_step)
        stop();
    }


    bool
    DynamicAnalysis::is_checkpoint_due(const unsigned int step) const
    {
      const unsigned int every = scene.parameters().output.checkpoint_every;
      return every > 0 && step % every == 0;
    }


    void
    DynamicAnalysis::stop() const
    {
      AssertThrow(false,
                  Stopped("stopped by a signal; what is known is written",
                          "t = " + std::to_string(time()) + " s",
                          scene.parameters().may_be_continued()
                            ? "continue with --restart " + checkpoint_file()
                            : ""));
    }


    std::vector<std::string>
    DynamicAnalysis::history_columns() const
    {
      std::vector<std::string> columns = {"size",
                                          "iterations",
                                          "lost_iterations",
                                          "max_displacement",
                                          "error",
                                          "kinetic",
                                          "strain",
                                          "conditions",
                                          "dissipated",
                                          "external_work",
                                          "balance",
                                          "momentum_x",
                                          "momentum_y",
                                          "angular_momentum"};
      if (contact)
        for (const std::string &column : contact->columns())
          columns.push_back(column);
      if (leaving)
        columns.insert(columns.end(), {"blocks_left", "left_energy"});
      if (scene.parameters().time.sleep.speed > 0.)
        columns.push_back("blocks_asleep");
      // The number of tips changes when cracks grow; their factors are in growth.csv then.
      if (growth)
        columns.insert(columns.end(),
                       {"increments", "grown_length", "fracture", "cuts"});
      else if (crack_tips)
        for (const std::string &column : crack_tips->columns())
          columns.push_back(column);
      return columns;
    }


    std::vector<double>
    DynamicAnalysis::history_values(const StepRecord &record) const
    {
      const StepReport   &report  = record.report;
      const Account      &account = motion->integrator().account();
      std::vector<double> values  = {report.step,
                                     double(report.n_iterations),
                                     double(record.n_lost_iterations),
                                     report.max_displacement,
                                     report.error,
                                     account.kinetic,
                                     account.strain,
                                     account.conditions,
                                     account.dissipated,
                                     account.external_work,
                                     account.balance,
                                     account.linear_momentum[0],
                                     account.linear_momentum[1],
                                     account.angular_momentum};
      if (contact)
        for (const double value : contact->numbers(/* thickness = */ 1.))
          values.push_back(value);
      if (leaving)
        values.insert(values.end(),
                      {double(motion->integrator().state().left_blocks.size()),
                       account.left});
      if (scene.parameters().time.sleep.speed > 0.)
        values.push_back(motion->integrator().n_asleep());
      if (growth)
        values.insert(values.end(),
                      {double(growth->table().n_increments()),
                       growth->table().grown_length(),
                       account.fracture,
                       account.cuts});
      else if (crack_tips)
        for (const double value : crack_tips->numbers())
          values.push_back(value);
      return values;
    }


    void
    DynamicAnalysis::write_rows(const StepRecord &record)
    {
      compute_tips_in_motion();
      const std::vector<double> row = history_values(record);
      std::vector<double>       probe_values;
      if (!probe_history->is_empty())
      {
        // The checkpoint needs vectors without unknowns of other ranks.
        Vector owned(velocity());
        owned        = motion->integrator().state().u;
        probe_values = probe_history->evaluate(owned, velocity());
      }
      on_first_rank([&]() {
        history->append(time(), step_number(), row);
        probe_history->write(time(), step_number(), probe_values);
      });
    }


    void
    DynamicAnalysis::write_state_of_series()
    {
      show();
      write_bolts();
      std::ostringstream description;
      description << "t = " << time() << " s";
      series->write(step_number() / scene.parameters().output.fields_every,
                    time(),
                    description.str(),
                    *evaluator,
                    sample_cracks().get());
    }


    void
    DynamicAnalysis::write_bolts()
    {
      if (!bolts)
        return;
      bolts->take_state(displacement());
      bolts->add_rows(step_number(), time());
      series->show_bolts(bolts.get());
      if (is_first_rank())
        bolts->write(*directory);
    }


    void
    DynamicAnalysis::write_checkpoint()
    {
      Checkpoint::write(motion->integrator(),
                        checkpoint_file(),
                        part_to_save());
    }


    void
    DynamicAnalysis::show_progress()
    {
      stage->update([&](const double seconds) {
        std::ostringstream line;
        line << std::setprecision(4) << "step " << step_number()
             << ", t = " << time();
        if (kind == Analysis::relaxation)
          line << " s, imbalance " << std::setprecision(2)
               << motion->integrator().account().imbalance;
        else
        {
          const double end  = scene.parameters().time.end_time;
          const double left = seconds * (end - time()) / (time() - start_time);
          line << " of " << end << " s, " << std::setprecision(3)
               << n_steps / seconds << " steps/s, about " << std::ceil(left)
               << " s left";
        }
        if (contact)
          line << "; " << contact->progress();
        if (leaving && !motion->integrator().state().left_blocks.empty())
          line << "; " << motion->integrator().state().left_blocks.size()
               << " block(s) have left";
        if (motion->integrator().n_asleep() > 0)
          line << "; " << motion->integrator().n_asleep() << " block(s) sleep";
        return line.str();
      });
    }


    void
    DynamicAnalysis::show()
    {
      evaluator.reset();
      recovery.reset();
      field    = std::make_unique<DisplacementField>(solid->covers(),
                                                  problem,
                                                  displacement());
      recovery = std::make_unique<StressRecovery>(*field, solid->aggregation());
      // Assemble again, since the last assembly may be that of a step that failed.
      if (inelastic_terms() != nullptr)
        (void)inelastic_terms()->assemble(displacement(),
                                          /* with_tangent = */ false);
      Vector relevant(solid->covers().locally_owned_dofs(2),
                      solid->covers().locally_relevant_dofs(2),
                      communicator);
      relevant = velocity();
      velocity_field =
        std::make_unique<DisplacementField>(solid->covers(), problem, relevant);
      evaluator =
        std::make_unique<FieldEvaluator>(*field,
                                         *recovery,
                                         problem,
                                         CurrentStress::of(motion->solid_term(),
                                                           solid->quadrature()),
                                         velocity_field.get());
      if (inelastic_terms() != nullptr)
        evaluator->set_plastic_strain(CurrentStress::plastic_strain(
          *inelastic_terms(), solid->covers(), solid->quadrature()));
      if (!motion->integrator().state().left_blocks.empty())
        evaluator->hide_blocks(motion->integrator().state().left_blocks);
    }


    void
    DynamicAnalysis::verify()
    {
      const std::string &length = scene.parameters().output.length_unit;
      if (has_start())
      {
        summary.add("start_steps", start.n_steps);
        summary.add("start_iterations", start.n_iterations);
      }
      summary.add("time_reached", time(), "s");
      summary.add("time_steps", step_number());
      summary.add("newton_iterations", n_iterations + n_lost_iterations);
      summary.add("cuts", n_cuts);
      if (damping.stiffness > 0.)
        summary.add("stiffness_damping", damping.stiffness, "s");
      if (kind == Analysis::relaxation)
        summary.add("imbalance", motion->integrator().account().imbalance);
      add_energies();
      if (scene.parameters().model.kinematics != Kinematics::small)
        summary.add("current_area",
                    CurrentStress::area(*field, solid->quadrature()),
                    length + "^2");
      if (contact)
        contact->add_to_summary(summary);
      if (bolts)
      {
        write_bolts();
        bolts->add_to(summary);
        for (const std::string &line : bolts->description())
          progress.message("  " + line);
      }
      if (joint_water)
      {
        joint_water->add_to(summary);
        if (is_first_rank())
          joint_water->write(*directory);
      }
      if (crack_tips)
        crack_tips->add_to(summary);
      if (growth)
      {
        summary.add("increments", growth->table().n_increments());
        summary.add("grown_length", growth->table().grown_length(), length);
      }
      if (leaving)
        summary.add("blocks_left",
                    motion->integrator().state().left_blocks.size());
      if (scene.parameters().time.sleep.speed > 0.)
        summary.add("blocks_asleep", motion->integrator().n_asleep());
      summary.add("direct_stress_covers",
                  dealii::Utilities::MPI::sum(recovery->n_direct(),
                                              communicator));
    }


    void
    DynamicAnalysis::add_energies()
    {
      const OutputParameters &output = scene.parameters().output;
      const double            t      = problem.thickness;
      const std::string       energy =
        output.stress_unit + "*" + output.length_unit + "^3";
      const std::string momentum =
        output.stress_unit + "*" + output.length_unit + "^2*s";
      const std::string angular_momentum =
        output.stress_unit + "*" + output.length_unit + "^3*s";
      const Account &account = motion->integrator().account();
      summary.add("kinetic_energy", t * account.kinetic, energy);
      summary.add("strain_energy", t * account.strain, energy);
      summary.add("conditions_energy", t * account.conditions, energy);
      summary.add("dissipated_energy", t * account.dissipated, energy);
      summary.add("external_work", t * account.external_work, energy);
      if (leaving)
        summary.add("left_energy", t * account.left, energy);
      summary.add("energy_balance", t * account.balance, energy);
      summary.add("energy_balance_relative", relative_balance());
      summary.add("momentum_x", t * account.linear_momentum[0], momentum);
      summary.add("momentum_y", t * account.linear_momentum[1], momentum);
      summary.add("angular_momentum",
                  t * account.angular_momentum,
                  angular_momentum);
    }


    void
    DynamicAnalysis::note_energies()
    {
      const Account &account = motion->integrator().account();
      const double   stored =
        account.kinetic + account.strain + account.conditions;
      AssertThrow(
        std::isfinite(stored) && std::isfinite(account.balance),
        NumericalFailure("The energies are not finite",
                         "time " + std::to_string(time()) + " s, step " +
                           std::to_string(step_number()),
                         "take shorter steps, or look for loads, stiffness "
                         "and velocities of extreme size"));
      largest_balance = std::max(largest_balance, std::abs(account.balance));
      // Initial stress does work, so that strain energy can be negative and the sum 0.
      largest_energy = std::max({largest_energy,
                                 stored,
                                 account.kinetic,
                                 std::abs(account.strain),
                                 std::abs(account.external_work)});
    }


    double
    DynamicAnalysis::relative_balance() const
    {
      return largest_energy > 0. ? largest_balance / largest_energy : 0.;
    }


    bool
    DynamicAnalysis::balance_is_off() const
    {
      // If schemes and impacts are resolved, the imbalance stays below a hundredth. The steps of a
      // relaxation are too long to resolve the motion, and forces in balance are what counts there.
      constexpr double limit = 0.1;
      return kind == Analysis::dynamics && relative_balance() > limit;
    }


    std::string
    DynamicAnalysis::balance_note() const
    {
      std::ostringstream text;
      text << std::setprecision(2) << "the energy balance is off by "
           << 100. * relative_balance()
           << " % of the largest energy, so that the last state is not to be "
              "trusted: take shorter steps";
      return text.str();
    }


    void
    DynamicAnalysis::explain_balance(const std::string &reason) const
    {
      AssertThrow(!balance_is_off(),
                  NumericalFailure(reason + "; " + balance_note(), "", ""));
    }


    double
    DynamicAnalysis::last_value() const
    {
      return time();
    }


    std::string
    DynamicAnalysis::unsolved_note() const
    {
      std::ostringstream note;
      note << "solved up to t = " << time() << " s";
      return note.str();
    }
  } // namespace internal
} // namespace NMM
