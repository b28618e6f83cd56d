// step-nmm-1: a thick ring under inner pressure, solved on a mesh that does not
// fit it.
//
// This program follows the paper's first example (Figs. 5-7). The physics is an
// undergraduate's: Lamé's solution is known in closed form. What is tested is
// the method: circles cut a regular mesh of triangles wherever they like, and
// the question is what that costs in accuracy and time against triangles that
// fit the circles, with the same number of unknowns.

// @sect3{Include files}

// From this library: the modules in the order in which data flows through them.
#include <nmm/base/program.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/mechanics/thick_ring.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>

// `parameters.h` has the parameters, `figures.gp` the figures, and `fitted_ring.cc` solves the same ring on triangles
// of deal.II that fit it. What all tutorials share, tables above all, is in the folder `tutorial`.
#include "figures_gp.h"
#include "fitted_ring.h"
#include "parameters.h"
#include <array>
#include <cmath>
#include <functional>

namespace StepNMM1
{
  using namespace dealii;

  // @sect3{Geometry}

  // The ring as curves. The inner and the outer circle get names, because loads
  // and supports are given on named curves. A full ring is two circles; half a
  // ring and a quarter are two arcs and the two straight cuts, on which symmetry
  // holds. Arcs are given by three points they pass through: three doubles always lie
  // exactly on one circle.
  NMM::Geometry
  make_ring(const Parameters &parameters)
  {
    using NMM::CurvePiece;
    const double  a = parameters.inner_radius, b = parameters.outer_radius;
    NMM::Geometry geometry;
    if (parameters.ring == "full")
    {
      geometry.add_circle(Point<2>(), b, "outer", NMM::CurveRole::boundary);
      geometry.add_circle(Point<2>(), a, "inner", NMM::CurveRole::hole);
      return geometry;
    }

    const auto add = [&](const std::string &name, const CurvePiece &piece) {
      NMM::Curve curve;
      curve.name   = name;
      curve.role   = NMM::CurveRole::boundary;
      curve.pieces = {piece};
      geometry.add(std::move(curve));
    };
    const bool is_half = (parameters.ring == "half");
    const auto last    = [&](const double r) {
      return is_half ? Point<2>(-r, 0.) : Point<2>(0., r);
    };
    const double c   = is_half ? 0. : std::sqrt(0.5);
    const double s   = is_half ? 1. : std::sqrt(0.5);
    const auto   arc = [&](const double r) {
      return CurvePiece::arc(Point<2>(r, 0.), Point<2>(r * c, r * s), last(r));
    };
    add("inner", arc(a));
    add("outer", arc(b));
    add("first cut", CurvePiece::segment(Point<2>(a, 0.), Point<2>(b, 0.)));
    add("last cut", CurvePiece::segment(last(a), last(b)));
    return geometry;
  }


  // @sect3{The problem}

  // Pressure inside, symmetry on the cuts. A symmetry line is a displacement
  // prescribed along the normal, as zero; it is imposed weakly, since the mesh has no
  // nodes there. A half ring could still move along its cut, a full ring move and
  // turn: points that symmetry holds still anyway get the springs of the
  // paper's eq. (12), which carry no force then.
  NMM::ElasticityProblem
  make_problem(const Parameters &parameters)
  {
    using Type = NMM::BoundaryCondition::Type;
    NMM::ElasticityProblem problem;
    problem.plane_state         = NMM::PlaneState::plane_stress;
    problem.materials           = {parameters.material};
    problem.boundary_conditions = {
      {"pressure",
       "inner",
       Type::pressure,
       std::make_shared<Functions::ConstantFunction<2>>(parameters.pressure)}};
    if (parameters.ring != "full")
      for (const std::string cut : {"first cut", "last cut"})
        problem.boundary_conditions.push_back(
          {"symmetry on the " + cut, cut, Type::normal_displacement, nullptr});

    const double r = 0.5 * (parameters.inner_radius + parameters.outer_radius);
    const auto   hold = [&](const Point<2> &x, const bool in_x) {
      NMM::FixedPoint point;
      point.point         = x;
      point.components[0] = in_x;
      point.components[1] = !in_x;
      problem.fixed_points.push_back(point);
    };
    if (parameters.ring != "quarter")
      hold(Point<2>(0., r), true);
    if (parameters.ring == "full")
    {
      hold(Point<2>(r, 0.), false);
      hold(Point<2>(-r, 0.), false);
    }
    return problem;
  }


  // @sect3{What is measured}

  // The hoop stress is largest at the inner circle, where triangles are cut. At 101 points of a
  // radius, both circles included: distance from the centre [m] and hoop stress [Pa].
  using StressAt = std::function<SymmetricTensor<2, 2>(const Point<2> &)>;

  std::vector<std::array<double, 2>>
  sample_hoop(const Parameters &parameters,
              const double      degrees,
              const StressAt   &stress)
  {
    const double           angle = degrees * numbers::PI / 180.;
    const Tensor<1, 2>     along({std::cos(angle), std::sin(angle)});
    const Tensor<1, 2>     across({-along[1], along[0]});
    constexpr unsigned int n = 100;
    std::vector<std::array<double, 2>> samples;
    for (unsigned int k = 0; k <= n; ++k)
    {
      const double r =
        parameters.inner_radius +
        (parameters.outer_radius - parameters.inner_radius) * k / n;
      samples.push_back({{r, across * (stress(Point<2>(r * along)) * across)}});
    }
    return samples;
  }


  double
  largest_hoop_error(const NMM::ThickRing &exact,
                     const Parameters     &parameters,
                     const StressAt       &stress)
  {
    double largest = 0.;
    for (const double degrees : {15., 45., 75.})
      for (const auto &[r, hoop] : sample_hoop(parameters, degrees, stress))
        largest = std::max(largest,
                           std::abs(hoop - exact.hoop_stress(r)) /
                             exact.hoop_stress(r));
    return largest;
  }


  // The stress is that of the displacement, directly, or recovered from it, which is smooth.
  void
  measure_errors(const Parameters             &parameters,
                 const NMM::ManifoldMesh      &mesh,
                 const NMM::DisplacementField &field,
                 const NMM::StressRecovery    &recovery,
                 Tutorial::Table              *profile,
                 Run                          &run)
  {
    const NMM::ThickRing  exact(parameters.inner_radius,
                               parameters.outer_radius,
                               parameters.pressure,
                               parameters.material,
                               NMM::PlaneState::plane_stress);
    const NMM::ErrorNorms errors = NMM::compute_errors(
      field,
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) { return exact.stress(x); });
    run.error_u      = errors.displacement;
    run.error_stress = errors.stress;

    const auto stress_of = [&](const auto &stresses) -> StressAt {
      return [&](const Point<2> &x) {
        const unsigned int element = mesh.find_element(x);
        AssertThrow(element != NMM::invalid_index, ExcInternalError());
        return stresses.stress(
          element,
          mesh.mathematical_mesh().real_to_reference(mesh.cell(element), x));
      };
    };
    const StressAt direct = stress_of(field), recovered = stress_of(recovery);
    run.error_hoop           = largest_hoop_error(exact, parameters, direct);
    run.error_hoop_recovered = largest_hoop_error(exact, parameters, recovered);
    if (profile == nullptr)
      return;
    const auto directly       = sample_hoop(parameters, 45., direct);
    const auto after_recovery = sample_hoop(parameters, 45., recovered);
    for (unsigned int k = 0; k < directly.size(); ++k)
      profile->add({{"r_m", directly[k][0]},
                    {"exact_Pa", exact.hoop_stress(directly[k][0])},
                    {"direct_Pa", directly[k][1]},
                    {"recovered_Pa", after_recovery[k][1]}});
  }


  // A row of the table. An error falls like $n^{-q/2}$ with the number of unknowns $n$, where $q$ is
  // the order; it is known from the second mesh of a method on.
  Tutorial::Row
  row(const Run &run, const Run *coarser)
  {
    const auto order = [&](const double Run::*error) -> Tutorial::Value {
      if (coarser == nullptr)
        return "-";
      return 2. * std::log(coarser->*error / run.*error) /
             std::log(double(run.n_unknowns) / coarser->n_unknowns);
    };
    Tutorial::Value recovered = run.error_hoop_recovered;
    if (run.method == "fitted")
      recovered = "-";
    return {{"method", run.method},
            {"degree", run.degree},
            {"cell_size_m", run.cell_size},
            {"unknowns", run.n_unknowns},
            {"L2_u", run.error_u},
            {"order_u", order(&Run::error_u)},
            {"L2_stress", run.error_stress},
            {"order_stress", order(&Run::error_stress)},
            {"hoop_direct", run.error_hoop},
            {"hoop_recovered", recovered},
            {"total_s", run.clock.total()},
            {"stages_s", run.clock.to_text()}};
  }


  // @sect3{One run}

  // From curves to displacements. The order is that of the library's modules, and
  // each result is an immutable object the next one refers to: nothing here is
  // ever copied or updated in place.
  Run
  run_manifold_method(const Parameters                &parameters,
                      const NMM::GradedMeshParameters &mesh_parameters,
                      const unsigned int               degree,
                      Tutorial::Table                 *profile)
  {
    Run result;
    result.method = mesh_parameters.local_sizes.empty() ? "uniform" : "graded";
    result.degree = degree;
    result.cell_size            = mesh_parameters.cell_size;
    Tutorial::StageClock &clock = result.clock;

    const NMM::PhysicalMesh     physical_mesh(make_ring(parameters));
    const NMM::MathematicalMesh mathematical_mesh =
      mesh_parameters.local_sizes.empty()
        ? NMM::make_regular_mesh(physical_mesh, mesh_parameters, degree)
        : NMM::make_graded_mesh(physical_mesh, mesh_parameters, degree);
    clock.lap("mesh");

    const NMM::ManifoldMesh manifold_mesh(mathematical_mesh, physical_mesh);
    clock.lap("cutting");

    NMM::CoverSystem       covers(manifold_mesh, MPI_COMM_WORLD);
    const NMM::Aggregation aggregation =
      NMM::aggregate(covers, parameters.aggregation_threshold);
    const auto constraints = NMM::make_constraints(covers, aggregation, 2);
    clock.lap("covers");

    // The stiffness of a whole triangle integrates products of first derivatives,
    // degree 2(p-1); cut elements get the full 2p, as the body force would
    // need it.
    const NMM::QuadratureCollection quadrature(manifold_mesh,
                                               std::max(1u, 2 * (degree - 1)),
                                               2 * degree,
                                               covers.locally_owned_elements());
    clock.lap("quadrature");

    const NMM::ElasticityProblem problem = make_problem(parameters);
    NMM::StaticElasticity elasticity(covers, quadrature, constraints, problem);
    elasticity.assemble();
    clock.lap("assembly");

    elasticity.solve(NMM::LinearSolverParameters());
    clock.lap("solution");

    // Covers with too little support are expressed through others: they have
    // rows in the matrix, but are no unknowns.
    result.n_unknowns =
      2 * (covers.n_covers() - aggregation.cover_to_root.size());

    // What follows is not part of the method but of its examination.
    const NMM::DisplacementField field(covers, problem, elasticity.solution());
    const NMM::StressRecovery    recovery(field, aggregation);
    measure_errors(parameters, manifold_mesh, field, recovery, profile, result);
    return result;
  }


  // @sect3{The study}

  // The mesh of one run: regular equilateral triangles that know nothing of the
  // ring, or the same with triangles of half the size near the inner circle, where
  // the stress varies most.
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
    {
      NMM::LocalSize near_inside;
      near_inside.kind   = NMM::LocalSize::Kind::curve;
      near_inside.curve  = "inner";
      near_inside.size   = 0.5 * cell_size;
      near_inside.growth = 0.5 * cell_size / parameters.refined_width;
      mesh.local_sizes.push_back(near_inside);
    }
    return mesh;
  }


  // Six mesh sizes, first and second order, and fitted triangles of deal.II
  // beside them. The hoop stress is drawn for the coarsest regular meshes.
  void
  run_convergence_study(const Parameters &parameters)
  {
    Tutorial::Table table("The ring: relative errors", 11);
    Run             coarser;
    const auto      add = [&](const Run &run) {
      const bool is_coarsest =
        coarser.method != run.method || coarser.degree != run.degree;
      table.add(row(run, is_coarsest ? nullptr : &coarser));
      coarser = run;
      return is_coarsest;
    };
    const auto run = [&](const unsigned int degree, const bool is_graded) {
      for (const double size : parameters.cell_sizes)
      {
        // about the same number of unknowns with and without grading
        const double    cell_size = (is_graded ? 1.35 : 1.) * size;
        Tutorial::Table profile;
        if (add(run_manifold_method(
              parameters,
              make_mesh_parameters(parameters, cell_size, is_graded),
              degree,
              &profile)) &&
            !is_graded)
          profile.write(parameters.prefix + "hoop-" + std::to_string(degree) +
                        ".csv");
      }
    };
    run(1, false);
    run(2, false);
    run(2, true);
    for (const double cell_size : parameters.cell_sizes)
      add(run_fitted_elements(parameters, cell_size));
    table.write(parameters.prefix + "study.csv");
  }


  // An unfitted method must not care where its mesh happens to lie: the same
  // ring with the mesh moved and turned at random.
  void
  run_placement_study(Parameters parameters)
  {
    Tutorial::Table table;
    for (const Tutorial::Placement &placement :
         Tutorial::random_placements(parameters.n_placements,
                                     parameters.seed,
                                     parameters.placement_cell_size))
    {
      parameters.placement = placement;
      const auto mesh      = make_mesh_parameters(parameters,
                                             parameters.placement_cell_size,
                                             /* is_graded = */ true);
      table.add(
        row(run_manifold_method(parameters, mesh, 2, nullptr), nullptr));
    }
    table.print_ranges(
      "The mesh moved and turned at random",
      {"cell_size_m", "L2_u", "L2_stress", "hoop_recovered", "hoop_direct"});
    table.write(parameters.prefix + "placements.csv");
  }
} // namespace StepNMM1


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM1;
  return Tutorial::run<Parameters>(
    "step-nmm-1", argc, argv, [](const Parameters &parameters) {
      run_convergence_study(parameters);
      run_placement_study(parameters);
      Tutorial::draw_figures(parameters.prefix, figures_gp);
    });
}
