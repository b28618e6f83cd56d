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
#include <nmm/materials/material_law.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

// The paper's scheme has a file of its own, `incremental_elasticity.cc`: the library has only Newton's
// method. `study.cc` has the parameters and the reference values, `figures.cc` the
// figures. They are apart from this page since nothing of the method is in them.
#include "incremental_elasticity.h"
#include "study.h"
#include "tutorial/tutorial.h"
#include <cmath>

namespace StepNMM2
{
  using namespace dealii;

  // @sect3{Geometry and problem}

  // Four straight pieces with names: loads and supports are given on named
  // curves.
  NMM::Geometry
  make_beam(const Parameters &parameters)
  {
    const double   L          = parameters.length;
    const double   H          = parameters.height;
    const Point<2> corners[4] = {{0., 0.}, {L, 0.}, {L, H}, {0., H}};
    const char    *names[4]   = {"bottom", "end", "top", "clamped"};
    NMM::Geometry  geometry;
    for (unsigned int i = 0; i < 4; ++i)
    {
      NMM::Curve curve;
      curve.name   = names[i];
      curve.role   = NMM::CurveRole::boundary;
      curve.pieces = {
        NMM::CurvePiece::segment(corners[i], corners[(i + 1) % 4])};
      geometry.add(std::move(curve));
    }
    return geometry;
  }


  // The whole end section is held: a displacement condition, imposed weakly
  // because no node of the mesh lies there. The load that turns is a pressure on
  // the top and a suction on the bottom, both on the deformed surface; the dead
  // load is a traction per unit of *undeformed* length.
  NMM::ElasticityProblem
  make_problem(const Parameters &parameters, const Load load)
  {
    using Condition = NMM::BoundaryCondition;
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_stress;
    NMM::Material material;
    material.name           = "beam";
    material.youngs_modulus = parameters.youngs_modulus;
    material.poissons_ratio = parameters.poissons_ratio;
    material.law            = NMM::material_law("St. Venant-Kirchhoff");
    problem.materials       = {material};

    Condition clamped;
    clamped.name = clamped.curve = "clamped";
    clamped.type                 = Condition::Type::displacement;
    problem.boundary_conditions.push_back(clamped);

    for (const std::string side : {"top", "bottom"})
    {
      const double half = 0.5 * parameters.force();
      Condition    condition;
      condition.name = condition.curve = side;
      if (load == Load::follower)
      {
        condition.type  = Condition::Type::follower_pressure;
        condition.value = std::make_shared<Functions::ConstantFunction<2>>(
          side == "top" ? half : -half);
      }
      else
      {
        condition.type  = Condition::Type::traction;
        condition.value = std::make_shared<Functions::ConstantFunction<2>>(
          std::vector<double>{0., -half});
      }
      problem.boundary_conditions.push_back(condition);
    }
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
    mesh.offset    = parameters.offset;
    mesh.rotation  = parameters.rotation;
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
      , physical_mesh(make_beam(parameters))
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
      measurement.load      = load;
      measurement.degree    = degree;
      measurement.mesh      = mesh.local_sizes.empty() ? "uniform" : "graded";
      measurement.cell_size = mesh.cell_size;
      measurement.n_unknowns =
        2 * (covers.n_covers() - aggregation.cover_to_root.size());
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

    const Parameters               &parameters;
    const NMM::PhysicalMesh         physical_mesh;
    const NMM::MathematicalMesh     mathematical_mesh;
    const NMM::ManifoldMesh         manifold_mesh;
    NMM::CoverSystem                covers;
    const NMM::Aggregation          aggregation;
    const AffineConstraints<double> constraints;
    const NMM::QuadratureCollection quadrature;
    const NMM::ElasticityProblem    problem;
    Measurement                     measurement;
  };


  // @sect3{Few large steps}

  // Newton's method at K = 2, 4, ..., 10. Beside the error stands what one iteration
  // costs, and what one linear problem on the same covers does.
  Measurement
  run_finite(const Parameters                &parameters,
             const NMM::GradedMeshParameters &mesh,
             const unsigned int               degree,
             const Load                       load)
  {
    Timer                 timer;
    Model                 model(parameters, mesh, degree, load);
    NMM::FiniteElasticity elasticity(model.covers,
                                     model.quadrature,
                                     model.constraints,
                                     model.problem);
    NMM::NonlinearStatics statics(elasticity);

    Measurement &result    = model.measurement;
    result.kinematics      = "finite";
    double     newton_time = 0.;
    const auto record      = [&](const NMM::LoadStep                 &step,
                            const TrilinosWrappers::MPI::Vector &u) {
      result.deflection[parameters.last_load * step.load_factor] =
        model.tip({model.covers, model.problem, u})[0];
      ++result.n_steps;
      result.n_iterations +=
        step.newton.iterations.size() + step.n_lost_iterations;
      newton_time += step.newton.assembly_time +
                     step.newton.factorization_time +
                     step.newton.substitution_time;
    };
    statics.run(NMM::LoadSteps::equal(parameters.n_load_steps), record);
    result.total_time     = timer.wall_time();
    result.iteration_time = newton_time / result.n_iterations;

    // the best of three, as the first one also pays for what is loaded late
    result.linear_time = 1e300;
    for (unsigned int k = 0; k < 3; ++k)
    {
      timer.restart();
      NMM::StaticElasticity linear(model.covers,
                                   model.quadrature,
                                   model.constraints,
                                   model.problem);
      linear.assemble();
      linear.solve(NMM::LinearSolverParameters());
      result.linear_time = std::min(result.linear_time, timer.wall_time());
    }
    compare(result);
    return result;
  }


  // @sect3{Many small steps}

  // The paper's way: each increment is one linear problem on the geometry that
  // the last one left.
  Measurement
  run_incremental(const Parameters                &parameters,
                  const NMM::GradedMeshParameters &mesh,
                  const Load                       load,
                  const unsigned int               n_steps)
  {
    Timer                 timer;
    Model                 model(parameters, mesh, 2, load);
    IncrementalElasticity elasticity(model.covers,
                                     model.quadrature,
                                     model.constraints,
                                     model.problem);
    Measurement          &result = model.measurement;
    result.kinematics            = "incremental";
    result.n_steps               = n_steps;
    result.n_iterations          = n_steps;
    const double setup_time      = timer.wall_time();
    for (unsigned int k = 1; k <= n_steps; ++k)
    {
      elasticity.step(static_cast<double>(k) / n_steps);
      if (parameters.n_load_steps * k % n_steps == 0)
        result.deflection[parameters.last_load * k / n_steps] = model.tip(
          {model.covers, model.problem, elasticity.displacements()})[0];
    }
    result.total_time     = timer.wall_time();
    result.iteration_time = (result.total_time - setup_time) / n_steps;
    compare(result);
    return result;
  }


  // @sect3{Fig. 10}

  // The tip at K = 0.5, 1, ..., 10, and the deformed outline at the paper's loads.
  Curves
  compute_curves(const Parameters &parameters, const Load load)
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
    Curves                curves;
    const auto            add_outline = [&](const double                         K,
                                 const TrilinosWrappers::MPI::Vector &u) {
      const NMM::DisplacementField field(model.covers, model.problem, u);
      std::vector<Point<2>>       &outline = curves.outlines[K];
      constexpr unsigned int       n       = 60;
      for (unsigned int k = 0; k <= n; ++k)
        outline.push_back(model.moved(field, {k * L / n, 0.}));
      for (unsigned int k = 0; k <= n; ++k)
        outline.push_back(model.moved(field, {(n - k) * L / n, H}));
      outline.push_back(outline.front());
    };
    constexpr unsigned int n_steps = 20;
    NMM::NonlinearStatics  statics(elasticity);
    add_outline(0., statics.solution());
    curves.tip[0.] = {{0., 0.}};
    statics.run(NMM::LoadSteps::equal(n_steps),
                [&](const NMM::LoadStep                 &step,
                    const TrilinosWrappers::MPI::Vector &u) {
                  const double K = parameters.last_load * step.load_factor;
                  curves.tip[K]  = model.tip({model.covers, model.problem, u});
                  const auto k   = std::lround(n_steps * step.load_factor);
                  if (step.is_asked && k % 4 == 0)
                    add_outline(K, u);
                });
    return curves;
  }


  // @sect3{The study}

  // Mesh sizes with and without smaller triangles at the corners, first and
  // second order; then increments.
  void
  run_study(const Parameters &parameters, const std::string &prefix)
  {
    Tutorial::Table table(
      "Largest error of w/L at K = 2, 4, ..., 10, relative to the solid of "
      "cantilever.csv");
    for (const Load load : loads)
    {
      const auto finite = [&](const unsigned int degree, const bool is_graded) {
        for (const double cell_size : parameters.cell_sizes)
          table.add(row(
            run_finite(parameters,
                       make_mesh_parameters(parameters, cell_size, is_graded),
                       degree,
                       load)));
      };
      finite(1, false);
      finite(2, false);
      finite(2, true);
      for (const unsigned int n : parameters.increments)
        table.add(
          row(run_incremental(parameters,
                              make_mesh_parameters(parameters,
                                                   parameters.cell_size,
                                                   /* is_graded = */ true),
                              load,
                              n)));
    }
    table.write(prefix + "study.csv");
  }


  // The mesh moved and turned at random: the error must not depend on luck.
  void
  run_placements(Parameters parameters)
  {
    Tutorial::Table table;
    for (const Tutorial::Placement &placement : Tutorial::random_placements(
           parameters.n_placements, parameters.seed, parameters.cell_size))
    {
      parameters.offset   = placement.offset;
      parameters.rotation = placement.rotation;
      for (const Load load : loads)
        table.add(row(run_finite(parameters,
                                 make_mesh_parameters(parameters,
                                                      parameters.cell_size,
                                                      /* is_graded = */ true),
                                 2,
                                 load)));
    }
    table.print_ranges("Mesh moved and turned at random, both loads",
                       {"cell_size_m", "error", "iterations"});
  }
} // namespace StepNMM2


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM2;
  return Tutorial::run(
    argc,
    argv,
    [](const std::string &parameter_file, const std::string &output_directory) {
      Tutorial::check_that_there_is_one_rank("step-nmm-2");
      const Parameters parameters = read_parameters(parameter_file);
      Tutorial::make_output_directory(output_directory);

      const std::string prefix = output_directory + "/step-nmm-2-";
      run_study(parameters, prefix);
      run_placements(parameters);
      std::map<Load, Curves> curves;
      for (const Load load : loads)
        curves[load] = compute_curves(parameters, load);
      write_curves(prefix, curves);
      draw_figures(prefix);
    });
}
