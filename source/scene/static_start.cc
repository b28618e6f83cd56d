#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/dynamics/relaxation.h>

#include <algorithm>
#include <analysis/mechanism.h>
#include <iomanip>
#include <memory>
#include <scene/bolts.h>
#include <scene/cut_notice.h>
#include <scene/joint_water.h>
#include <scene/static_start.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using Vector = ForceTerm::Vector;

    namespace
    {
      void
      show_load(Progress::Stage   &stage,
                const StartReport &report,
                const double       load_factor)
      {
        stage.update([&](double) {
          std::ostringstream line;
          line << "load step " << report.n_steps << ", load factor "
               << std::setprecision(3) << load_factor;
          return line.str();
        });
      }


      Vector
      solve_statics(const StartInput &input,
                    Progress::Stage  &stage,
                    StartReport      &report)
      {
        const SceneParameters &parameters = input.scene.parameters();
        EquilibriumParameters  how;
        how.kinematics = parameters.model.kinematics;
        how.full       = input.scene.loads_before_stages();
        how.newton = show_iterations(parameters.newton.newton, input.progress);
        how.further_terms =
          SceneBolts::makers(input.scene, SceneBolts::Installed::in_stages);
        const std::unique_ptr<SceneJointWater> joint_water =
          SceneJointWater::make(input.scene);
        if (joint_water)
          how.further_terms.push_back(
            joint_water->maker(/* is_at_rest = */ true));
        Equilibrium equilibrium(input.solid, input.problem, how, input.contact);
        LoadSteps   steps = parameters.load_steps.load_steps();
        // One linear problem needs no steps.
        if (how.kinematics == Kinematics::small && !parameters.is_nonlinear())
          steps = LoadSteps();
        const std::vector<StageChange> stages =
          input.scene.make_stages(input.solid.physical_mesh());
        const auto after_step = [&](const ContactStep &step, const Vector &) {
          ++report.n_steps;
          report.n_iterations += step.n_iterations + step.n_lost_iterations;
          show_load(stage, report, step.load_factor);
          stop_if_asked(input.solid.covers().communicator());
        };
        const auto agree = [&]() {
          if (joint_water)
            joint_water->repeat_until_flow_agrees(equilibrium, after_step);
        };
        equilibrium.run_stages(
          steps, stages, after_step, [&](const unsigned int i) {
            agree();
            input.progress.message("  " + describe_stage(input.scene, i));
            report.removed_blocks.insert(report.removed_blocks.end(),
                                         stages[i].removed_blocks.begin(),
                                         stages[i].removed_blocks.end());
          });
        agree();
        if (const InelasticTerms *terms =
              equilibrium.solid_term().inelastic_terms())
          report.material_state = terms->internal_state();
        report.term_state = equilibrium.further_terms().save();
        Vector owned(input.solid.covers().locally_owned_dofs(2),
                     input.solid.covers().communicator());
        owned = equilibrium.solution();
        return owned;
      }


      Vector
      relax_to_rest(const StartInput &input,
                    StartRelaxation  &relaxing,
                    Progress::Stage  &stage,
                    StartReport      &report)
      {
        TimeIntegrator      &integrator = relaxing.motion.integrator();
        RelaxationParameters parameters =
          input.scene.parameters().relaxation.bounded(
            input.solid.physical_mesh());
        parameters.continued_step    = relaxing.continued_step;
        const Vector           begin = integrator.state().u;
        CutNotice              cut_notice(input.progress);
        const RelaxationReport result = relax(
          integrator,
          parameters,
          [&](const StepRecord &record) {
            cut_notice.note(record);
            ++report.n_steps;
            report.n_iterations +=
              record.report.n_iterations + record.n_lost_iterations;
            stage.update([&](double) {
              std::ostringstream line;
              line << "relaxation step " << report.n_steps << ", imbalance "
                   << std::setprecision(2) << integrator.account().imbalance;
              return line.str();
            });
          },
          [&](const double length) {
            if (relaxing.before_step)
              relaxing.before_step(length);
            stop_if_asked(input.solid.covers().communicator());
          });
        if (result.moves_away)
          refuse_motion(input.solid.covers(),
                        input.problem,
                        input.solid.quadrature(),
                        begin,
                        integrator.state().u);
        if (const InelasticTerms *terms =
              relaxing.motion.solid_term().inelastic_terms())
          report.material_state = terms->internal_state();
        report.term_state = relaxing.motion.further_terms().save();
        return integrator.state().u;
      }


      /// Calls @p find, and names the parameter of the start if there is none.
      Vector
      find_or_explain(const StartInput &input,
                      const bool        is_relaxed,
                      const std::function<Vector(Progress::Stage &)> &find)
      {
        Progress::Stage stage(input.progress, "start");
        try
        {
          return find(stage);
        }
        catch (const NumericalFailure &error)
        {
          AssertThrow(
            false,
            NumericalFailure(
              "There is no equilibrium to start from: " + error.message(),
              !input.scene.parameters().stages.empty() ? "section 'Stages'"
              : input.scene.parameters().model.analysis ==
                  Analysis::safety_factor
                ? "parameter 'Safety factor/Start'"
                : "parameter 'Time/Start'",
              is_relaxed ? "see that obstacles and supports hold every "
                           "block"
                         : "let faces touch at the start, with friction, "
                           "or set it to relaxation"));
          throw;
        }
      }
    } // namespace


    namespace
    {
      MotionParameters
      start_parameters(const StartInput &input)
      {
        const SceneParameters &parameters = input.scene.parameters();
        const LoadAmplitudes   amplitudes = input.scene.loads_before_stages();
        TimeParameters         time       = parameters.time;
        time.scheme                       = TimeParameters::Scheme::automatic;
        MotionParameters result;
        result.kinematics         = parameters.model.kinematics;
        result.scheme             = time.time_scheme(Analysis::relaxation,
                                         parameters.model.kinematics,
                                         input.contact != nullptr);
        result.loading.amplitudes = [amplitudes](double) { return amplitudes; };
        result.contact_update     = ContactUpdate::every_step;
        result.is_accounted       = false;
        result.newton = motion_newton_parameters(input.scene, input.progress);
        result.further_terms = further_terms(input.scene);
        return result;
      }
    } // namespace


    StartRelaxation::StartRelaxation(const StartInput &input)
      : motion(input.solid,
               input.problem,
               start_parameters(input),
               input.contact)
    {
    }


    std::string
    describe_stage(const Scene &scene, const unsigned int stage)
    {
      return "stage '" + scene.parameters().stages[stage].name +
             "', load factors " + std::to_string(stage + 1) + " to " +
             std::to_string(stage + 2);
    }


    NewtonParameters
    motion_newton_parameters(const Scene &scene, Progress &progress)
    {
      return newton_in_motion(show_iterations(scene.parameters().newton.newton,
                                              progress),
                              scene.parameters().is_nonlinear());
    }


    Vector
    find_start(const StartInput &input, StartReport &report)
    {
      const SceneParameters &parameters = input.scene.parameters();
      if (parameters.stages.empty() &&
          (parameters.model.analysis == Analysis::safety_factor ||
           parameters.time.start == TimeParameters::Start::relaxation))
      {
        StartRelaxation relaxation(input);
        return find_start(input, relaxation, report);
      }
      return find_or_explain(input,
                             /* is_relaxed = */ false,
                             [&](Progress::Stage &stage) {
                               return solve_statics(input, stage, report);
                             });
    }


    Vector
    find_start(const StartInput &input,
               StartRelaxation  &relaxation,
               StartReport      &report)
    {
      return find_or_explain(input,
                             /* is_relaxed = */ true,
                             [&](Progress::Stage &stage) {
                               return relax_to_rest(input,
                                                    relaxation,
                                                    stage,
                                                    report);
                             });
    }
  } // namespace internal
} // namespace NMM
