// step-nmm-2: a cantilever bent far beyond small displacement, on a mesh that
// does not fit it.
//
// This program follows the paper's Fig. 10. A load of P / 2 per unit length acts
// on the top and on the bottom of a beam, and grows until the end has moved by
// most of the beam's length: once with constant direction and once turning with
// the beam. What is compared are two ways to get there: many small linear
// steps (the paper's) and few large ones with Newton's method.

// @sect3{Include files}

#include <nmm/base/program.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/function.h>
#include <deal.II/base/timer.h>

// The paper's scheme has a file of its own, `incremental_elasticity.cc`: the library has only Newton's
// method. `cantilever.cc` has the parameters and the reference values, `figures.gp` the
// figures. They are apart from this page since nothing of the method is in them.
#include "cantilever.h"
#include "cantilever_csv.h"
#include "figures_gp.h"
#include "incremental_elasticity.h"
#include <array>
#include <cmath>

namespace StepNMM2
{
  using namespace dealii;

  // @sect3{Geometry and problem}

  // Four straight pieces with names: loads and supports are given on named
  // curves.
  NMM::Geometry
  make_beam()
  {
    return NMM::parse_geometry(R"(
      boundary name=bottom  LINESTRING (0 0, 10 0)
      boundary name=end     LINESTRING (10 0, 10 1)
      boundary name=top     LINESTRING (10 1, 0 1)
      boundary name=clamped LINESTRING (0 1, 0 0))",
                               "the beam");
  }


  // The whole end section is held: a displacement condition, imposed weakly
  // because no node of the mesh lies there. The load that turns is a pressure on
  // the top and a suction on the bottom, both on the deformed surface; the dead
  // load is a traction per unit of *undeformed* length.
  NMM::ElasticityProblem
  make_problem(const Parameters &parameters, const Load load)
  {
    using Type     = NMM::BoundaryCondition::Type;
    using Constant = Functions::ConstantFunction<2>;
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_stress;
    problem.materials   = {
        {"beam", parameters.youngs_modulus, parameters.poissons_ratio}};
    problem.materials[0].law    = NMM::material_law("St. Venant-Kirchhoff");
    problem.boundary_conditions = {
      {"clamped", "clamped", Type::displacement, nullptr}};
    const double half = 0.5 * parameters.force();
    for (const std::string side : {"top", "bottom"})
      if (load == Load::follower)
        problem.boundary_conditions.push_back(
          {side,
           side,
           Type::follower_pressure,
           std::make_shared<Constant>(side == "top" ? half : -half)});
      else
        problem.boundary_conditions.push_back(
          {side,
           side,
           Type::traction,
           std::make_shared<Constant>(std::vector<double>{0., -half})});
    return problem;
  }


  // The stress is singular where the clamped section meets the free sides, and
  // that is where the error comes from. A regular mesh of equilateral triangles,
  // turned by some angle, is refined around these two points: the error becomes
  // seven times smaller for a third more unknowns.
  NMM::GradedMeshParameters
  make_mesh_parameters(const Parameters &parameters,
                       const double      cell_size,
                       const bool        is_graded)
  {
    NMM::GradedMeshParameters mesh;
    mesh.cell_size = cell_size;
    mesh.offset    = parameters.placement.offset;
    mesh.rotation  = parameters.placement.rotation;
    if (is_graded)
      for (const double y : {0., parameters.height})
      {
        NMM::LocalSize corner;
        corner.kind   = NMM::LocalSize::Kind::point;
        corner.point  = Point<2>(0., y);
        corner.size   = parameters.corner_ratio * cell_size;
        corner.growth = parameters.corner_growth;
        mesh.local_sizes.push_back(corner);
      }
    return mesh;
  }


  // @sect3{The model}

  // Everything that does not move: all integrals are over the undeformed beam,
  // which is cut once. A whole triangle's stiffness in a linear problem needs a
  // rule of degree 2(p-1); the energy of the St. Venant-Kirchhoff law has degree
  // 4(p-1), but a rule for that costs twice as many points and changes the
  // deflection by 5e-6 here. Cut triangles get the full 2p.
  class Model
  {
  public:
    Model(const Parameters                &parameters,
          const NMM::GradedMeshParameters &mesh,
          const unsigned int               degree,
          const Load                       load)
      : parameters(parameters)
      , mesh(mesh)
      , physical_mesh(make_beam())
      , mathematical_mesh(
          mesh.local_sizes.empty()
            ? NMM::make_regular_mesh(physical_mesh, mesh, degree)
            : NMM::make_graded_mesh(physical_mesh, mesh, degree))
      , manifold_mesh(mathematical_mesh, physical_mesh)
      , covers(manifold_mesh, MPI_COMM_WORLD)
      , aggregation(NMM::aggregate(covers))
      , constraints(NMM::make_constraints(covers, aggregation, 2))
      , quadrature(manifold_mesh,
                   std::max(1u, 2 * (degree - 1)),
                   2 * degree,
                   covers.locally_owned_elements())
      , problem(make_problem(parameters, load))
    {
    }


    // A point on the boundary belongs to an element, but rounding may say
    // otherwise: look for it a little inside.
    Point<2>
    moved(const NMM::DisplacementField &field, const Point<2> &x) const
    {
      const Point<2> middle(0.5 * parameters.length, 0.5 * parameters.height);
      const unsigned int element =
        manifold_mesh.find_element(x + 1e-9 * (middle - x));
      AssertThrow(element != NMM::invalid_index, ExcInternalError());
      return x + field.displacement(element,
                                    mathematical_mesh.real_to_reference(
                                      manifold_mesh.cell(element), x));
    }


    // (-v, -u) / L of the middle of the end.
    std::array<double, 2>
    tip(const NMM::DisplacementField &field) const
    {
      const Point<2>     end(parameters.length, 0.5 * parameters.height);
      const Tensor<1, 2> d = moved(field, end) - end;
      return {{-d[1] / parameters.length, -d[0] / parameters.length}};
    }

    // What all rows of the table begin with.
    Tutorial::Row
    row(const Load load, const std::string &kinematics) const
    {
      const bool is_graded = mesh.local_sizes.size() > 0;
      return {{"load", name(load)},
              {"kinematics", kinematics},
              {"degree", mathematical_mesh.degree()},
              {"mesh", is_graded ? "graded" : "uniform"},
              {"cell_size_m", mesh.cell_size},
              {"unknowns",
               2 * (covers.n_covers() - aggregation.cover_to_root.size())}};
    }

    const Parameters               &parameters;
    const NMM::GradedMeshParameters mesh;
    const NMM::PhysicalMesh         physical_mesh;
    const NMM::MathematicalMesh     mathematical_mesh;
    const NMM::ManifoldMesh         manifold_mesh;
    NMM::CoverSystem                covers;
    const NMM::Aggregation          aggregation;
    const AffineConstraints<double> constraints;
    const NMM::QuadratureCollection quadrature;
    const NMM::ElasticityProblem    problem;
  };


  // @sect3{Few large steps}

  // Newton's method at K = 2, 4, ..., 10. Beside the error stands what one iteration
  // costs, and what one linear problem on the same covers does.
  Tutorial::Row
  run_finite(const Parameters                &parameters,
             const NMM::GradedMeshParameters &mesh,
             const unsigned int               degree,
             const Load                       load)
  {
    Timer                 timer;
    const Model           model(parameters, mesh, degree, load);
    NMM::FiniteElasticity elasticity(model.covers,
                                     model.quadrature,
                                     model.constraints,
                                     model.problem);
    NMM::NonlinearStatics statics(elasticity);

    std::map<double, double> deflections;
    unsigned int             n_iterations = 0;
    double                   newton_time  = 0.;
    statics.run(NMM::LoadSteps::equal(parameters.n_load_steps),
                [&](const NMM::LoadStep                 &step,
                    const TrilinosWrappers::MPI::Vector &u) {
                  deflections[parameters.last_load * step.load_factor] =
                    model.tip({model.covers, model.problem, u})[0];
                  n_iterations +=
                    step.newton.iterations.size() + step.n_lost_iterations;
                  newton_time += step.newton.assembly_time +
                                 step.newton.factorization_time +
                                 step.newton.substitution_time;
                });
    const double total_time = timer.wall_time();

    // the best of three, as the first one also pays for what is loaded late
    double linear_time = 1e300;
    for (unsigned int k = 0; k < 3; ++k)
    {
      timer.restart();
      NMM::StaticElasticity linear(model.covers,
                                   model.quadrature,
                                   model.constraints,
                                   model.problem);
      linear.assemble();
      linear.solve(NMM::LinearSolverParameters());
      linear_time = std::min(linear_time, timer.wall_time());
    }
    return model.row(load, "finite") +
           Tutorial::Row{{"steps", deflections.size()},
                         {"iterations", n_iterations},
                         {"error", largest_error(load, deflections)},
                         {"total_s", total_time},
                         {"iteration_s", newton_time / n_iterations},
                         {"linear_s", linear_time}};
  }


  // @sect3{Many small steps}

  // The paper's way: each increment is one linear problem on the geometry that
  // the last one left.
  Tutorial::Row
  run_incremental(const Parameters                &parameters,
                  const NMM::GradedMeshParameters &mesh,
                  const Load                       load,
                  const unsigned int               n_steps)
  {
    Timer                 timer;
    const Model           model(parameters, mesh, 2, load);
    IncrementalElasticity elasticity(model.covers,
                                     model.quadrature,
                                     model.constraints,
                                     model.problem);

    std::map<double, double> deflections;
    const double             setup_time = timer.wall_time();
    for (unsigned int k = 1; k <= n_steps; ++k)
    {
      elasticity.step(static_cast<double>(k) / n_steps);
      if (parameters.n_load_steps * k % n_steps == 0)
        deflections[parameters.last_load * k / n_steps] = model.tip(
          {model.covers, model.problem, elasticity.displacements()})[0];
    }
    const double total_time = timer.wall_time();
    return model.row(load, "incremental") +
           Tutorial::Row{{"steps", n_steps},
                         {"iterations", n_steps},
                         {"error", largest_error(load, deflections)},
                         {"total_s", total_time},
                         {"iteration_s", (total_time - setup_time) / n_steps},
                         {"linear_s", 0.}};
  }


  // @sect3{The study}

  // Mesh sizes with and without smaller triangles at the corners, first and
  // second order; then increments.
  void
  run_study(const Parameters &parameters)
  {
    Tutorial::Table table(
      "Largest error of w/L at K = 2, 4, ..., 10, relative to the solid of "
      "cantilever.csv");
    for (const Load load : loads)
    {
      const auto finite = [&](const unsigned int degree, const bool is_graded) {
        for (const double cell_size : parameters.cell_sizes)
          table.add(
            run_finite(parameters,
                       make_mesh_parameters(parameters, cell_size, is_graded),
                       degree,
                       load));
      };
      finite(1, false);
      finite(2, false);
      finite(2, true);
      const auto mesh = make_mesh_parameters(parameters,
                                             parameters.cell_size,
                                             /* is_graded = */ true);
      for (const unsigned int n : parameters.increments)
        table.add(run_incremental(parameters, mesh, load, n));
    }
    table.write(parameters.prefix + "study.csv");
  }


  // The mesh moved and turned at random: the error must not depend on luck.
  void
  run_placements(Parameters parameters)
  {
    Tutorial::Table table;
    for (const Tutorial::Placement &placement : Tutorial::random_placements(
           parameters.n_placements, parameters.seed, parameters.cell_size))
    {
      parameters.placement = placement;
      const auto mesh      = make_mesh_parameters(parameters,
                                             parameters.cell_size,
                                             /* is_graded = */ true);
      for (const Load load : loads)
        table.add(run_finite(parameters, mesh, 2, load));
    }
    table.print_ranges("Mesh moved and turned at random, both loads",
                       {"cell_size_m", "error", "iterations"});
  }


  // @sect3{Fig. 10}

  // The tip at K = 0.5, 1, ..., 10, and the deformed outline at the paper's loads.
  void
  write_curves(const Parameters &parameters, const Load load)
  {
    const Model           model(parameters,
                      make_mesh_parameters(parameters,
                                           parameters.cell_size,
                                           /* is_graded = */ true),
                      2,
                      load);
    NMM::FiniteElasticity elasticity(model.covers,
                                     model.quadrature,
                                     model.constraints,
                                     model.problem);
    const double          L = parameters.length, H = parameters.height;
    Tutorial::Table       tip, shapes;
    const auto            add_outline = [&](const double                         K,
                                 const TrilinosWrappers::MPI::Vector &u) {
      const NMM::DisplacementField field(model.covers, model.problem, u);
      const auto                   add_point = [&](const Point<2> &x) {
        const Point<2> now = model.moved(field, x);
        shapes.add({{"x_m", now[0]}, {"y_m", now[1]}, {"K", K}});
      };
      constexpr unsigned int n = 60;
      for (unsigned int k = 0; k <= n; ++k)
        add_point({k * L / n, 0.});
      for (unsigned int k = 0; k <= n; ++k)
        add_point({(n - k) * L / n, H});
      add_point({0., 0.});
      shapes.add_break();
    };
    const auto add_tip = [&](const double K, const double w, const double u) {
      tip.add({{"K", K}, {"w_over_L", w}, {"u_over_L", u}});
    };

    constexpr unsigned int n_steps = 20;
    NMM::NonlinearStatics  statics(elasticity);
    add_outline(0., statics.solution());
    add_tip(0., 0., 0.);
    statics.run(
      NMM::LoadSteps::equal(n_steps),
      [&](const NMM::LoadStep &step, const TrilinosWrappers::MPI::Vector &u) {
        const double K            = parameters.last_load * step.load_factor;
        const auto [w_tip, u_tip] = model.tip({model.covers, model.problem, u});
        add_tip(K, w_tip, u_tip);
        const auto k = std::lround(n_steps * step.load_factor);
        if (step.is_asked && k % 4 == 0)
          add_outline(K, u);
      });
    const std::string ending = "-" + name(load) + ".csv";
    tip.write(parameters.prefix + "tip" + ending);
    shapes.write(parameters.prefix + "shapes" + ending);
  }
} // namespace StepNMM2


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM2;
  return Tutorial::run<Parameters>(
    "step-nmm-2", argc, argv, [](const Parameters &parameters) {
      Tutorial::check_that_there_is_one_rank("step-nmm-2");
      run_study(parameters);
      run_placements(parameters);
      for (const Load load : loads)
        write_curves(parameters, load);
      Tutorial::draw_figures(parameters.prefix, figures_gp, cantilever_csv);
    });
}
