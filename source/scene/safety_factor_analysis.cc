#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <analysis/mechanism.h>
#include <cmath>
#include <iomanip>
#include <scene/current_stress.h>
#include <scene/joint_water.h>
#include <scene/safety_factor_analysis.h>
#include <scene/static_start.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using Stage = Progress::Stage;
    using Start = SafetyFactorSectionParameters::Start;

    namespace
    {
      const char *
      verb(const StrengthTrial::Outcome outcome)
      {
        switch (outcome)
        {
          case StrengthTrial::Outcome::stands:
            return "stands";
          case StrengthTrial::Outcome::moves:
            return "moves";
          default:
            return "fails";
        }
      }
    } // namespace


    void
    SafetyFactorAnalysis::make_system()
    {
      Stage                       system_stage(progress, "masses");
      const SceneParameters      &given = scene.parameters();
      StrengthReductionParameters parameters;
      parameters.search = given.safety_factor.search;
      parameters.trial =
        given.relaxation.of_trial(given.safety_factor.max_displacement,
                                  given.safety_factor.search.tolerance);
      parameters.reduced    = given.safety_factor.reduced;
      parameters.flow_rule  = given.safety_factor.flow_rule;
      MotionParameters &how = parameters.motion;
      how.kinematics        = given.model.kinematics;
      how.loading           = scene.make_loading();
      how.scheme            = given.time.time_scheme(Analysis::safety_factor,
                                          how.kinematics,
                                          /* has_contact = */ true);
      how.contact_update    = update_in_relaxation(how.scheme);
      how.newton            = motion_newton_parameters(scene, progress);
      how.further_terms     = further_terms(scene);
      reduction             = std::make_unique<StrengthReduction>(*solid,
                                                      problem,
                                                      std::move(parameters),
                                                      contact.get());
      reduction->after_step = [this](const double      factor,
                                     const StepRecord &step) {
        stop_if_asked(communicator);
        cut_notice.note(step);
        show_progress(factor, step);
      };
      reduction->after_trial = [this](StrengthTrial &trial) {
        add_trial(trial);
      };
    }


    void
    SafetyFactorAnalysis::settle()
    {
      StartReport              report;
      StrengthReduction::Start start;
      start.displacement =
        find_start({scene, *solid, problem, contact.get(), progress}, report);
      start.materials = report.material_state;
      start.terms     = report.term_state;
      removed_blocks = start.removed_blocks = report.removed_blocks;
      n_start_steps                         = report.n_steps;
      if (contact)
        start.contact = contact->contact().history();
      reduction->start_from(std::move(start));
    }


    void
    SafetyFactorAnalysis::add_trial(StrengthTrial &trial)
    {
      if (trial.outcome == StrengthTrial::Outcome::moves)
        trial.reason +=
          ": " + describe_motion(reduction->motion().integrator().state().u);
      std::vector<StrengthTrial> trials = reduction->so_far().trials;
      trials.push_back(trial);
      on_first_rank([&]() { write_trials(trials); });
      std::ostringstream line;
      line << "  factor " << trial.factor << ' ' << verb(trial.outcome) << " ("
           << trial.n_steps << " steps, " << trial.n_iterations
           << " iterations, imbalance " << std::setprecision(2)
           << trial.imbalance << std::setprecision(6)
           << (trial.reason.empty() ? "" : ", ") << trial.reason << ')';
      progress.message(line.str());
    }


    void
    SafetyFactorAnalysis::show_progress(const double      factor,
                                        const StepRecord &step)
    {
      const TimeIntegrator &integrator = reduction->motion().integrator();
      stage->update([&](double) {
        std::ostringstream line;
        line << std::setprecision(3) << "factor " << factor << ", step "
             << integrator.state().step << " of " << step.report.step
             << " s, motion " << step.report.max_displacement
             << " m, imbalance " << integrator.account().imbalance;
        return line.str();
      });
    }


    void
    SafetyFactorAnalysis::solve()
    {
      const SafetyFactorSectionParameters &parameters =
        scene.parameters().safety_factor;
      if (parameters.start == Start::settled ||
          !scene.parameters().stages.empty())
        settle();
      try
      {
        Stage search(progress, "trials");
        stage  = &search;
        result = reduction->find();
      }
      catch (const Stopped &)
      {
        result = reduction->so_far();
        if (!result.trials.empty())
          show();
        verify();
        throw;
      }
      show();
      is_solved = result.stands_at > 0. && std::isfinite(result.moves_at) &&
                  !result.has_failed();
      if (!is_solved)
        give_up();
      std::ostringstream line;
      line << "  factor of safety " << result.value() << ": stands at "
           << result.stands_at << ", moves at " << result.moves_at;
      progress.message(line.str());
    }


    std::string
    SafetyFactorAnalysis::what_is_known() const
    {
      std::ostringstream text;
      if (result.stands_at > 0.)
        text << "they stand at " << result.stands_at;
      if (std::isfinite(result.moves_at))
        text << (text.str().empty() ? "they" : " and") << " move at "
             << result.moves_at;
      return text.str().empty() ? "nothing is known of other factors"
                                : text.str();
    }


    void
    SafetyFactorAnalysis::give_up()
    {
      const SafetyFactorParameters &search =
        scene.parameters().safety_factor.search;
      const bool stands = result.stands_at > 0.;
      verify();
      std::ostringstream what;
      if (result.has_failed())
      {
        std::ostringstream where;
        where << "the factor " << result.trials.back().factor;
        what
          << "The search for the factor of safety has ended, because a trial "
             "did not converge: it tells neither whether the blocks stand nor "
             "whether they move ("
          << what_is_known() << "; " << result.trials.back().reason << ')';
        AssertThrow(false,
                    NumericalFailure(what.str(),
                                     where.str(),
                                     "look for joints that nearly coincide and "
                                     "other slivers, or choose another "
                                     "'Safety factor/First', a smaller "
                                     "'Relaxation/Step' or softer springs of "
                                     "contact"));
      }
      what << "The blocks " << (stands ? "stand" : "move")
           << " at all factors tried, from " << search.first
           << (stands ? " up to " : " down to ")
           << (stands ? result.stands_at : result.moves_at);
      if (!stands)
        what << ": there is no factor of safety, since strength does not hold "
                "them. At the factor "
             << reduction->shown().trial.factor << ' '
             << describe_motion(reduction->shown().displacement);
      AssertThrow(
        false,
        NumericalFailure(
          what.str(),
          std::string("parameter 'Safety factor/") +
            (stands ? "Highest'" : "Lowest'"),
          stands ? "raise it, if blocks can move at all"
                 : "see that nothing topples or falls whatever its strength, "
                   "and that 'Largest displacement' is more than blocks "
                   "settle; or lower the lowest factor"));
    }


    std::string
    SafetyFactorAnalysis::describe_motion(const Vector &end) const
    {
      std::string text = internal::describe_motion(
        solid->covers(), problem, solid->quadrature(), reduction->start(), end);
      text[0] = 'b';
      return text;
    }


    void
    SafetyFactorAnalysis::write_trials(
      const std::vector<StrengthTrial> &trials) const
    {
      directory->write_text("safety_factor.csv", [&](std::ostream &out) {
        out.precision(12);
        out << "trial,factor,stands,moves,largest_displacement,steps,reason\n";
        for (unsigned int i = 0; i < trials.size(); ++i)
          out << i + 1 << ',' << trials[i].factor << ',' << trials[i].stands()
              << ',' << (trials[i].outcome == StrengthTrial::Outcome::moves)
              << ',' << trials[i].displacement << ',' << trials[i].n_steps
              << ',' << quoted(trials[i].reason) << '\n';
      });
    }


    void
    SafetyFactorAnalysis::show()
    {
      Stage recovery_stage(progress, "stress recovery");
      evaluator.reset();
      recovery.reset();
      reduction->show();
      const SolidTerm &term = reduction->motion().solid_term();
      Vector           relevant(term.layout().locally_owned,
                      term.layout().locally_relevant,
                      communicator);
      relevant = reduction->shown().displacement;
      field =
        std::make_unique<DisplacementField>(solid->covers(), problem, relevant);
      recovery = std::make_unique<StressRecovery>(*field, solid->aggregation());
      InelasticTerms *const terms = term.inelastic_terms();
      if (terms != nullptr)
        (void)terms->assemble(relevant, /* with_tangent = */ false);
      evaluator = std::make_unique<FieldEvaluator>(
        *field,
        *recovery,
        problem,
        CurrentStress::of(term, solid->quadrature()));
      evaluator->hide_blocks(removed_blocks);
      if (terms != nullptr)
        evaluator->set_plastic_strain(CurrentStress::plastic_strain(
          *terms, solid->covers(), solid->quadrature()));
    }


    void
    SafetyFactorAnalysis::verify()
    {
      // One end of the bracket alone is no factor of safety.
      if (result.stands_at > 0. && std::isfinite(result.moves_at))
        summary.add("safety_factor", result.value());
      if (!result.trials.empty())
      {
        summary.add("factor_stands", result.stands_at);
        summary.add("factor_moves", result.moves_at);
      }
      summary.add("trials", result.trials.size());
      unsigned int n_steps = n_start_steps;
      for (const StrengthTrial &trial : result.trials)
        n_steps += trial.n_steps;
      summary.add("time_steps", n_steps);
      summary.add("shown_factor", reduction->shown().trial.factor);
      summary.add("shown_stands", reduction->shown().trial.stands() ? 1. : 0.);
      if (contact)
        contact->add_to_summary(summary);
    }


    double
    SafetyFactorAnalysis::last_value() const
    {
      return reduction->shown().trial.factor;
    }


    std::string
    SafetyFactorAnalysis::unsolved_note() const
    {
      std::ostringstream note;
      if (reduction->shown().trial.fails())
        note << "no convergence at the factor "
             << reduction->shown().trial.factor;
      else
        note << verb(reduction->shown().trial.outcome)
             << " at all factors tried";
      return note.str();
    }
  } // namespace internal
} // namespace NMM
