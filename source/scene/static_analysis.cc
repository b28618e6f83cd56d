#include <nmm/base/exceptions.h>
#include <nmm/covers/point_location.h>
#include <nmm/linear_algebra/condition_number.h>
#include <nmm/mechanics/error_norms.h>

#include <algorithm>
#include <cmath>
#include <scene/static_analysis.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using Stage = Progress::Stage;

    void
    StaticAnalysis::make_system()
    {
      std::vector<const DiskCover *> disks;
      for (const auto &cover : tip_covers)
        disks.push_back(cover.get());
      elasticity = std::make_unique<StaticElasticity>(solid->covers(),
                                                      solid->quadrature(),
                                                      solid->constraints(),
                                                      problem,
                                                      solid->ghost_penalty(),
                                                      disks);
    }


    bool
    StaticAnalysis::can_have_tip_covers() const
    {
      return !scene.parameters().contact.is_present();
    }


    double
    StaticAnalysis::small_strain_energy() const
    {
      const double energy = SceneAnalysis::small_strain_energy();
      return elasticity == nullptr
               ? energy
               : energy + problem.thickness * elasticity->disk_energy();
    }


    void
    StaticAnalysis::clear()
    {
      elasticity.reset();
      SceneAnalysis::clear();
    }


    void
    StaticAnalysis::solve()
    {
      solve_problem();
      if (crack_tips)
        for (const std::string &line : crack_tips->description())
          progress.message("  " + line);
      is_solved = true;
    }


    void
    StaticAnalysis::solve_problem()
    {
      {
        Stage stage(progress, "assembly");
        elasticity->assemble();
      }
      report_initial_balance(elasticity->system_rhs());
      {
        Stage                    stage(progress, "solution");
        const LinearSolverReport report =
          elasticity->solve(scene.parameters().solver);
        const std::string iterations = "conjugate gradients, " +
                                       std::to_string(report.n_iterations) +
                                       " iterations";
        stage.remark(
          !report.direct ? iterations
          : report.n_iterations == 0
            ? "direct solver"
            : "direct solver, since conjugate gradients would take "
              "more than " +
                std::to_string(scene.parameters().solver.max_iterations) +
                " iterations in all");
        summary.add("solver_direct", report.direct ? 1. : 0.);
        summary.add("solver_iterations", report.n_iterations);
        summary.add("solver_relative_residual", report.relative_residual);
        if (report.direct)
          summary.add("rounding_effect", report.rounding_effect);
        constexpr double worth_a_warning = 1e-5;
        if (report.rounding_effect > worth_a_warning)
        {
          std::ostringstream text;
          text << "  warning: rounding may change displacements by "
               << std::setprecision(1) << report.rounding_effect
               << " of them: look for strips that are much thinner than the "
                  "rest, or for large contrasts of stiffness";
          progress.message(text.str());
        }
      }
      if (scene.parameters().solver.estimate_condition)
        estimate_condition();
      show(elasticity->solution());
    }


    void
    StaticAnalysis::show(const dealii::TrilinosWrappers::MPI::Vector &solution)
    {
      {
        Stage stage(progress, "stress recovery");
        field = std::make_unique<DisplacementField>(solid->covers(),
                                                    problem,
                                                    solution);
        for (unsigned int i = 0; i < tip_covers.size(); ++i)
          field->add_disk(*tip_covers[i], elasticity->disk_coefficients()[i]);
        recovery =
          std::make_unique<StressRecovery>(*field, solid->aggregation());
        evaluator =
          std::make_unique<FieldEvaluator>(*field, *recovery, problem);
      }
      compute_intensity_factors();
    }


    void
    StaticAnalysis::estimate_condition()
    {
      Stage                 stage(progress, "condition number");
      const ConditionNumber condition =
        estimate_condition_number(elasticity->system_matrix(),
                                  solid->covers(),
                                  solid->constraints());
      summary.add("condition_number", condition.value());
      const bool has_place = condition.weakest_cover != invalid_index;
      if (has_place)
      {
        const Point<2> &place = condition.weakest_node;
        const auto     &unit  = scene.parameters().output.length_unit;
        summary.add("condition_place_x", place[0], unit);
        summary.add("condition_place_y", place[1], unit);
      }
      std::ostringstream text;
      text << condition.value();
      stage.remark(text.str());
      if (!(condition.value() <= scene.parameters().solver.condition_limit))
        progress.message(
          "  warning: the condition number " + text.str() +
          " is above the limit" +
          (has_place ? "; the matrix is weakest near " +
                         to_string(condition.weakest_node)
                     : "; the matrix is singular to rounding") +
          ": look for slivers without stabilization, parts that hardly "
          "anything "
          "holds, long thin parts, or large contrasts of stiffness");
    }


    namespace
    {
      /// The circle on which all pieces of a curve lie.
      CurvePiece
      circle_of(const PhysicalMesh &mesh, const std::string &name)
      {
        const std::string  where = "section 'Exact solution'";
        const unsigned int curve = mesh.find_curve(name);
        AssertThrow(curve != invalid_index,
                    InputError("the geometry has no curve '" + name + "'",
                               where,
                               "name a circle or arc of the geometry"));
        const CurvePiece piece = mesh.curves()[curve].pieces.front();
        for (const CurvePiece &other : mesh.curves()[curve].pieces)
          AssertThrow(
            other.kind != CurvePiece::Kind::segment &&
              other.center.distance(piece.center) < 1e-9 * piece.radius &&
              std::abs(other.radius - piece.radius) < 1e-9 * piece.radius,
            InputError("the curve '" + name + "' is not part of one circle",
                       where,
                       "name a circle or arc of the geometry"));
        return piece;
      }


      /// Sum of the constant pressures on a curve [Pa].
      double
      pressure_on(const ElasticityProblem &problem,
                  const std::string       &curve,
                  const Point<2>          &x)
      {
        double pressure = 0.;
        for (const BoundaryCondition &condition : problem.boundary_conditions)
          if (condition.curve == curve)
          {
            AssertThrow(condition.type == BoundaryCondition::Type::pressure,
                        InputError("the condition '" + condition.name +
                                     "' on '" + curve + "' is no pressure",
                                   "section 'Exact solution'",
                                   "the thick ring is loaded by pressure"));
            if (condition.value)
              pressure += condition.value->value(x);
          }
        return pressure;
      }
    } // namespace


    void
    StaticAnalysis::check_problem()
    {
      const ExactSolutionParameters &parameters =
        scene.parameters().exact_solution;
      if (parameters.type == ExactSolutionParameters::Type::none)
        return;

      const CurvePiece inner =
        circle_of(*physical_mesh, parameters.inner_boundary);
      const CurvePiece outer =
        circle_of(*physical_mesh, parameters.outer_boundary);
      AssertThrow(inner.center.distance(outer.center) < 1e-9 * outer.radius,
                  InputError("the ring's inner circle about " +
                               to_string(inner.center) +
                               " and its outer one about " +
                               to_string(outer.center) + " are not concentric",
                             "section 'Exact solution'",
                             "name two concentric curves"));
      AssertThrow(pressure_on(problem,
                              parameters.outer_boundary,
                              outer.start) == 0.,
                  InputError("there is a pressure on the ring's outside",
                             "section 'Exact solution'",
                             "this exact solution has inner pressure only"));
      AssertThrow(problem.materials.size() == 1,
                  InputError("the exact solution has one material, the scene " +
                               std::to_string(problem.materials.size()),
                             "section 'Exact solution'",
                             "remove materials that are not used"));
      exact_solution.emplace(inner.radius,
                             outer.radius,
                             pressure_on(problem,
                                         parameters.inner_boundary,
                                         inner.start),
                             problem.materials.front(),
                             problem.plane_state,
                             inner.center);
    }


    void
    StaticAnalysis::verify()
    {
      Stage stage(progress, "verification");
      summary.add("strain_energy",
                  small_strain_energy(),
                  scene.parameters().output.stress_unit + "*" +
                    scene.parameters().output.length_unit + "^3");
      summary.add("direct_stress_covers",
                  dealii::Utilities::MPI::sum(recovery->n_direct(),
                                              communicator));
      if (contact)
        contact->add_to_summary(summary);
      if (crack_tips)
        crack_tips->add_to(summary);
      if (exact_solution)
        add_errors();
    }


    void
    StaticAnalysis::add_errors()
    {
      const ThickRing &ring         = *exact_solution;
      const auto       displacement = [&](const Point<2> &x) {
        return ring.displacement(x);
      };
      const auto stress = [&](const Point<2> &x) { return ring.stress(x); };
      const ErrorNorms direct = compute_errors(*field, displacement, stress);
      const ErrorNorms recovered =
        compute_errors(*field,
                       displacement,
                       stress,
                       [&](const unsigned int element, const Point<2> &xi) {
                         return recovery->stress(element, xi);
                       });
      summary.add("error_displacement_l2", direct.displacement);
      summary.add("error_direct_stress_l2", direct.stress);
      summary.add("error_recovered_stress_l2", recovered.stress);

      // Points are along the radius through the middle of the first piece of the inner curve.
      const CurvePiece inner =
        circle_of(*physical_mesh,
                  scene.parameters().exact_solution.inner_boundary);
      const double middle =
        angle_about(inner.center, inner.start) + 0.5 * swept_angle(inner);
      const dealii::Tensor<1, 2> radial({std::cos(middle), std::sin(middle)});
      const dealii::Tensor<1, 2> hoop({-radial[1], radial[0]});
      Probe                      line;
      line.is_line = true;
      line.from    = ring.center() + ring.inner_radius() * radial;
      line.to      = ring.center() + ring.outer_radius() * radial;
      const ProbePoints points(solid->manifold_mesh(), {line});
      const auto        samples = points.evaluate(solid->covers(), *evaluator);

      double error_direct = 0., error_recovered = 0.;
      for (unsigned int i = 0; i < samples.size(); ++i)
        if (samples[i])
        {
          const double exact =
            ring.hoop_stress(points.entries()[i].x.distance(ring.center()));
          const auto error = [&](const FieldSample::Stress &value) {
            return std::abs(hoop * (value.in_plane * hoop) / exact - 1.);
          };
          error_direct = std::max(error_direct, error(samples[i]->direct));
          error_recovered =
            std::max(error_recovered, error(samples[i]->recovered));
        }
      summary.add("error_direct_hoop_max", error_direct);
      summary.add("error_recovered_hoop_max", error_recovered);
    }
  } // namespace internal
} // namespace NMM
