#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/contact/assembly/statics.h>
#include <nmm/contact/assembly/term.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/mechanics/static_system.h>

#include <algorithm>
#include <iomanip>
#include <memory>
#include <scene/mechanism.h>
#include <scene/static_start.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using Vector = FiniteElasticity::Vector;

    namespace
    {
      LoadAmplitudes
      amplitudes_at_start(const Scene &scene)
      {
        const Loading loading = scene.make_loading();
        return loading.amplitudes ? loading.amplitudes(0.) : LoadAmplitudes();
      }


      bool
      is_small(const Scene &scene)
      {
        return scene.parameters().model.kinematics == Kinematics::small;
      }


      Vector
      owned_part(const StartInput &input, const Vector &solution)
      {
        Vector owned(input.covers.locally_owned_dofs(2),
                     input.covers.communicator());
        owned = solution;
        return owned;
      }


      /// Solves one linear problem.
      Vector
      solve_small(const StartInput &input,
                  FiniteElasticity &elasticity,
                  StartReport      &report)
      {
        const auto   solid = make_solid_at_rest(elasticity,
                                              Kinematics::small,
                                              amplitudes_at_start(input.scene));
        StaticSystem system(*solid);
        system.set_load_factor(1.);
        Vector             u(input.covers.locally_owned_dofs(2),
                 input.covers.locally_relevant_dofs(2),
                 input.covers.communicator());
        NewtonSolver       solver;
        const NewtonReport newton = solver.solve(system, input.constraints, u);
        AssertThrow(newton.converged,
                    NumericalFailure(newton.reason,
                                     "the linear problem",
                                     "see that supports hold every block"));
        report.n_steps      = 1;
        report.n_iterations = newton.iterations.size();
        return owned_part(input, u);
      }


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
        const Scene     &scene = input.scene;
        FiniteElasticity elasticity(input.covers,
                                    input.quadrature,
                                    input.constraints,
                                    input.problem,
                                    /* may_float = */ input.contact != nullptr);
        const LoadSteps  steps = scene.parameters().load_steps.load_steps();
        if (is_small(scene) && !scene.parameters().is_nonlinear())
          return solve_small(input, elasticity, report);
        const auto solid =
          make_solid_at_rest(elasticity,
                             scene.parameters().model.kinematics,
                             amplitudes_at_start(scene));
        const auto keep_materials = [&]() {
          if (const InelasticTerms *terms = solid->inelastic_terms())
            report.material_state = terms->internal_state();
        };
        if (input.contact == nullptr)
        {
          NonlinearStatics statics(
            *solid,
            show_iterations(scene.parameters().newton.newton, input.progress));
          statics.run(steps, [&](const LoadStep &step, const Vector &) {
            ++report.n_steps;
            report.n_iterations += step.n_iterations + step.n_lost_iterations;
            show_load(stage, report, step.load_factor);
            stop_if_asked(input.covers.communicator());
          });
          keep_materials();
          return owned_part(input, statics.solution());
        }
        ContactStatics statics(*solid,
                               input.contact->contact(),
                               contact_newton_parameters(scene,
                                                         input.progress));
        statics.run(steps, [&](const ContactStep &step, const Vector &) {
          ++report.n_steps;
          report.n_iterations += step.n_iterations + step.n_lost_iterations;
          show_load(stage, report, step.load_factor);
          stop_if_asked(input.covers.communicator());
        });
        keep_materials();
        return owned_part(input, statics.solution());
      }


      Vector
      relax_to_rest(const StartInput &input,
                    StartRelaxation  &relaxing,
                    Progress::Stage  &stage,
                    StartReport      &report)
      {
        const TimeIntegrator &integrator = relaxing.integrator();
        RelaxationParameters  parameters =
          input.scene.parameters().relaxation.bounded(
            input.covers.manifold_mesh().physical_mesh());
        parameters.continued_step     = relaxing.continued_step;
        const Vector           begin  = integrator.state().u;
        const RelaxationReport result = relax(
          relaxing.integrator(),
          parameters,
          [&](const StepRecord &record) {
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
            stop_if_asked(input.covers.communicator());
          });
        if (result.moves_away)
          refuse_motion(input.covers,
                        input.problem,
                        input.quadrature,
                        begin,
                        integrator.state().u);
        if (const InelasticTerms *terms = relaxing.inelastic_terms())
          report.material_state = terms->internal_state();
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
              input.scene.parameters().model.analysis == Analysis::safety_factor
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


    StartRelaxation::StartRelaxation(const StartInput &input)
      : elasticity(input.covers,
                   input.quadrature,
                   input.constraints,
                   input.problem,
                   /* may_float = */ true)
    {
      const SceneParameters &parameters = input.scene.parameters();
      const LoadAmplitudes   amplitudes = amplitudes_at_start(input.scene);
      Loading                loading;
      loading.amplitudes = [amplitudes](const double) { return amplitudes; };
      const auto mass    = make_mass_matrix(elasticity, input.mass_quadrature);
      model              = make_solid(elasticity,
                         parameters.model.kinematics,
                         std::move(loading),
                         mass);
      std::vector<ForceTerm *> terms = {model.get()};
      if (input.contact != nullptr)
      {
        contact_term =
          std::make_unique<ContactTerm>(model->layout(),
                                        input.contact->contact(),
                                        std::vector<ObstacleRelease>(),
                                        ContactUpdate::every_step);
        terms.push_back(contact_term.get());
      }
      mechanics = std::make_unique<MechanicalModel>(model->layout(), terms);

      TimeParameters time = parameters.time;
      time.scheme         = TimeParameters::Scheme::automatic;
      time_integrator     = std::make_unique<TimeIntegrator>(
        *mechanics,
        time.time_scheme(Analysis::relaxation,
                         parameters.model.kinematics,
                         input.contact != nullptr),
        motion_newton_parameters(input.scene, input.progress));
    }


    InelasticTerms *
    StartRelaxation::inelastic_terms() const
    {
      return model->inelastic_terms();
    }


    NewtonParameters
    motion_newton_parameters(const Scene &scene, Progress &progress)
    {
      const NewtonParameters &given = scene.parameters().newton.newton;
      NewtonParameters newton   = TimeIntegrator::default_newton_parameters();
      newton.residual_tolerance = given.residual_tolerance;
      // Without contact more iterations would only allow steps to grow that should be cut.
      if (given.max_iterations != NewtonParameters().max_iterations ||
          !scene.parameters().is_nonlinear())
        newton.max_iterations = given.max_iterations;
      return show_iterations(newton, progress);
    }


    Vector
    find_start(const StartInput &input, StartReport &report)
    {
      const SceneParameters &parameters = input.scene.parameters();
      if (parameters.model.analysis == Analysis::safety_factor ||
          parameters.time.start == TimeParameters::Start::relaxation)
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
