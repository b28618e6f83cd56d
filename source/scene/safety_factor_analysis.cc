#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <scene/current_stress.h>
#include <scene/mechanism.h>
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
      Stage              system_stage(progress, "masses");
      const unsigned int degree = 2 * mathematical_mesh->degree();
      mass_quadrature           = std::make_unique<QuadratureCollection>(
        *manifold_mesh, degree, degree, covers->locally_owned_elements());
      elasticity = std::make_unique<FiniteElasticity>(
        *covers, *quadrature, constraints, problem, /* may_float = */ true);
      const auto mass = make_mass_matrix(*elasticity, *mass_quadrature);
      model           = make_solid(*elasticity,
                         scene.parameters().model.kinematics,
                         scene.make_loading(),
                         mass);
    }


    void
    SafetyFactorAnalysis::settle()
    {
      StartReport report;
      settled           = find_start({scene,
                                      *covers,
                                      *quadrature,
                                      *mass_quadrature,
                                      constraints,
                                      problem,
                                      contact.get(),
                                      progress},
                           report);
      n_start_steps     = report.n_steps;
      settled_materials = report.material_state;
      if (contact)
        settled_contact = contact->contact().history();
    }


    StrengthTrial
    SafetyFactorAnalysis::try_factor(const double factor)
    {
      const SceneParameters &parameters = scene.parameters();
      const TimeScheme       scheme =
        parameters.time.time_scheme(Analysis::safety_factor,
                                    parameters.model.kinematics,
                                    /* has_contact = */ true);
      std::vector<ForceTerm *>          force_terms = {model.get()};
      std::unique_ptr<AccountedContact> with_contact;
      if (contact)
      {
        contact->begin_anew(factor);
        with_contact =
          std::make_unique<AccountedContact>(model->layout(),
                                             *contact,
                                             update_in_relaxation(scheme));
        with_contact->append_to(force_terms);
      }
      InelasticTerms *const terms = model->inelastic_terms();
      if (terms != nullptr)
      {
        terms->forget_states();
        terms->set_materials(reduce_strength(problem.materials, factor));
      }
      MechanicalModel mechanics(model->layout(), force_terms);
      TimeIntegrator  integrator(mechanics,
                                scheme,
                                motion_newton_parameters(scene, progress));
      if (parameters.safety_factor.start == Start::settled)
      {
        if (contact)
          with_contact->continue_from(settled_contact);
        if (terms != nullptr)
          terms->restore_internal_state(settled_materials);
        integrator.initialize(settled,
                              Vector(model->layout().locally_owned,
                                     communicator));
      }
      const RelaxationParameters relaxation = parameters.relaxation.of_trial(
        parameters.safety_factor.max_displacement,
        parameters.safety_factor.search.tolerance);
      StrengthTrial trial = try_to_stand(
        integrator, relaxation, factor, [&](const StepRecord &step) {
          stop_if_asked(communicator);
          show_progress(factor, integrator, step);
        });

      if (trial.outcome == StrengthTrial::Outcome::moves)
        trial.reason += ": " + describe_motion(integrator.state().u);
      if (tells_more(trial))
      {
        shown              = trial;
        shown_displacement = integrator.state().u;
        if (contact)
          shown_contact = contact->last_state();
        if (terms != nullptr)
          shown_materials = terms->internal_state();
      }
      trials.push_back(trial);
      on_first_rank([&]() { write_trials(); });
      std::ostringstream line;
      line << "  factor " << factor << ' ' << verb(trial.outcome) << " ("
           << trial.n_steps << " steps, " << trial.n_iterations
           << " iterations, imbalance " << std::setprecision(2)
           << trial.imbalance << std::setprecision(6)
           << (trial.reason.empty() ? "" : ", ") << trial.reason << ')';
      progress.message(line.str());
      return trial;
    }


    void
    SafetyFactorAnalysis::show_progress(const double          factor,
                                        const TimeIntegrator &integrator,
                                        const StepRecord     &step)
    {
      stage->update([&](double) {
        std::ostringstream line;
        line << std::setprecision(3) << "factor " << factor << ", step "
             << integrator.state().step << " of " << step.report.step
             << " s, motion " << step.report.max_displacement
             << " m, imbalance " << integrator.account().imbalance;
        return line.str();
      });
    }


    bool
    SafetyFactorAnalysis::tells_more(const StrengthTrial &trial) const
    {
      if (trials.empty() || trial.fails())
        return true;
      if (trial.outcome != shown.outcome)
        return shown.stands();
      return trial.stands() ? trial.factor > shown.factor
                            : trial.factor < shown.factor;
    }


    void
    SafetyFactorAnalysis::solve()
    {
      const SafetyFactorSectionParameters &parameters =
        scene.parameters().safety_factor;
      if (parameters.start == Start::settled)
        settle();
      try
      {
        Stage search(progress, "trials");
        stage  = &search;
        result = find_safety_factor(
          [this](const double factor) { return try_factor(factor); },
          parameters.search);
      }
      catch (const Stopped &)
      {
        for (const StrengthTrial &trial : trials)
          if (trial.stands())
            result.stands_at = std::max(result.stands_at, trial.factor);
          else if (!trial.fails())
            result.moves_at = std::min(result.moves_at, trial.factor);
        if (!trials.empty())
          show_best_trial();
        verify();
        throw;
      }
      show_best_trial();
      is_solved = result.stands_at > 0. && std::isfinite(result.moves_at) &&
                  !result.has_failed();
      if (!is_solved)
        give_up();
      std::ostringstream line;
      line << "  factor of safety " << result.value() << ": stands at "
           << result.stands_at << ", moves at " << result.moves_at;
      progress.message(line.str());
    }


    void
    SafetyFactorAnalysis::show_best_trial()
    {
      if (contact)
        contact->show_state(shown_contact);
      Stage recovery_stage(progress, "stress recovery");
      show();
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
        where << "the factor " << trials.back().factor;
        what
          << "The search for the factor of safety has ended, because a trial "
             "did not converge: it tells neither whether the blocks stand nor "
             "whether they move ("
          << what_is_known() << "; " << trials.back().reason << ')';
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
             << shown.factor << ' ' << describe_motion(shown_displacement);
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
      Vector begin(end);
      begin = 0.;
      if (scene.parameters().safety_factor.start == Start::settled)
        begin = settled;
      std::string text =
        internal::describe_motion(*covers, problem, *quadrature, begin, end);
      text[0] = 'b';
      return text;
    }


    void
    SafetyFactorAnalysis::write_trials() const
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
      evaluator.reset();
      recovery.reset();
      Vector relevant(model->layout().locally_owned,
                      model->layout().locally_relevant,
                      communicator);
      relevant = shown_displacement;
      field = std::make_unique<DisplacementField>(*covers, problem, relevant);
      recovery = std::make_unique<StressRecovery>(*field, aggregation);
      InelasticTerms *const terms = model->inelastic_terms();
      if (terms != nullptr)
      {
        terms->set_materials(reduce_strength(problem.materials, shown.factor));
        terms->restore_internal_state(shown_materials);
        (void)terms->assemble(relevant, /* with_tangent = */ false);
      }
      evaluator = std::make_unique<FieldEvaluator>(
        *field, *recovery, problem, CurrentStress::of(*model, *quadrature));
      if (terms != nullptr)
        evaluator->set_plastic_strain(
          CurrentStress::plastic_strain(*terms, *covers, *quadrature));
    }


    void
    SafetyFactorAnalysis::verify()
    {
      // One end of the bracket alone is no factor of safety.
      if (result.stands_at > 0. && std::isfinite(result.moves_at))
        summary.add("safety_factor", result.value());
      if (!trials.empty())
      {
        summary.add("factor_stands", result.stands_at);
        summary.add("factor_moves", result.moves_at);
      }
      summary.add("trials", trials.size());
      unsigned int n_steps = n_start_steps;
      for (const StrengthTrial &trial : trials)
        n_steps += trial.n_steps;
      summary.add("time_steps", n_steps);
      summary.add("shown_factor", shown.factor);
      summary.add("shown_stands", shown.stands() ? 1. : 0.);
      if (contact)
        contact->add_to_summary(summary);
    }


    double
    SafetyFactorAnalysis::last_value() const
    {
      return shown.factor;
    }


    std::string
    SafetyFactorAnalysis::unsolved_note() const
    {
      std::ostringstream note;
      if (shown.fails())
        note << "no convergence at the factor " << shown.factor;
      else
        note << verb(shown.outcome) << " at all factors tried";
      return note.str();
    }
  } // namespace internal
} // namespace NMM
