// The thick ring (the paper's first example), as in step-nmm-1.

#include "ring.h"

#include <nmm/mechanics/thick_ring.h>

#include "step-nmm-1/fitted_ring.h"
#include "step-nmm-1/parameters.h"

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;

      GradedMeshParameters
      mesh_of(const Ring &ring, const StepNMM1::Parameters &parameters)
      {
        GradedMeshParameters mesh;
        mesh.cell_size = ring.cell_size;
        mesh.offset    = parameters.placement.offset;
        mesh.rotation  = parameters.placement.rotation;
        if (ring.is_graded)
        {
          LocalSize inside;
          inside.kind   = LocalSize::Kind::curve;
          inside.curve  = "inner";
          inside.size   = 0.5 * ring.cell_size;
          inside.growth = inside.size / parameters.refined_width;
          mesh.local_sizes.push_back(inside);
        }
        return mesh;
      }


    } // namespace


    Row
    run(const Ring &ring, const bool with_stress_error)
    {
      const StepNMM1::Parameters parameters;
      const double a = parameters.inner_radius, b = parameters.outer_radius;
      Row          row;
      row.name       = ring.name;
      row.method     = ring.is_graded ? "manifold refined" : "manifold uniform";
      row.kinematics = "small";
      StagedModel model(quarter_ring(a, b),
                        mesh_of(ring, parameters),
                        ring.options,
                        row);
      model.problem.plane_state         = PlaneState::plane_stress;
      model.problem.materials           = {parameters.material};
      model.problem.boundary_conditions = {
        condition(Type::normal_displacement, "bottom"),
        condition(Type::normal_displacement, "left"),
        condition(Type::pressure, "inner", constant(parameters.pressure))};
      model.solve(ring.solver, row);

      const ThickRing         exact(a,
                            b,
                            parameters.pressure,
                            model.problem.materials[0],
                            PlaneState::plane_stress);
      const DisplacementField field(*model.covers,
                                    model.problem,
                                    model.elasticity->solution());
      std::vector<double>     probes;
      for (const double angle : {15., 45., 75.})
        for (const double r : {a, 0.5 * (a + b), b})
        {
          const double   t = angle * dealii::numbers::PI / 180.;
          const Point<2> x(r * std::cos(t), r * std::sin(t));
          const Point<2> inside(0.5 * (a + b) / r * x);
          const auto     u = model.displacement(field, x, inside);
          probes.insert(probes.end(), {u[0], u[1]});
        }
      row.probes            = to_text(probes);
      row.error_kind        = "L2 of u";
      row.second_error_kind = "L2 of stress";
      if (with_stress_error)
      {
        const ErrorNorms errors = compute_errors(
          field,
          [&](const Point<2> &x) { return exact.displacement(x); },
          [&](const Point<2> &x) { return exact.stress(x); });
        row.error        = errors.displacement;
        row.second_error = errors.stress;
      }
      return row;
    }


    namespace
    {
      Row
      run_fitted(const std::string &name, const double cell_size)
      {
        const StepNMM1::Run fitted =
          StepNMM1::run_fitted_elements(StepNMM1::Parameters(), cell_size);
        Row row;
        row.name              = name;
        row.method            = "fitted (deal.II)";
        row.kinematics        = "small";
        row.solver            = "MUMPS unsymmetric";
        row.degree            = fitted.degree;
        row.elements          = fitted.n_elements;
        row.unknowns          = fitted.n_unknowns;
        row.nonzeros          = fitted.n_nonzeros;
        row.error             = fitted.error_u;
        row.second_error      = fitted.error_stress;
        row.error_kind        = "L2 of u";
        row.second_error_kind = "L2 of stress";
        for (const auto &[stage, seconds] : fitted.clock.stages())
          (stage == "mesh"       ? row.mesh
           : stage == "dofs"     ? row.covers
           : stage == "sparsity" ? row.sparsity
           : stage == "assembly" ? row.assembly
                                 : row.factorization) = seconds;
        row.total = fitted.clock.total();
        return row;
      }


      LinearSolverParameters
      solver(const LinearSolverParameters::Type type)
      {
        LinearSolverParameters parameters;
        parameters.type = type;
        return parameters;
      }
    } // namespace


    void
    measure_ring(Recorder &recorder)
    {
      using Solver = LinearSolverParameters::Type;
      const bool is_alone =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
      std::vector<double> cell_sizes = {0.12, 0.0603};
      if (recorder.size() != Size::smallest)
        cell_sizes.insert(cell_sizes.end(), {0.0301, 0.01505});
      if (recorder.size() == Size::full)
        cell_sizes.push_back(0.0076);

      const auto series = [&](const unsigned int  degree,
                              const bool          is_graded,
                              const Stabilization stabilization,
                              const Solver        solver_type) {
        for (const double cell_size : cell_sizes)
        {
          Ring ring;
          // about as many unknowns with and without refinement, first and second order
          ring.cell_size =
            (is_graded ? 1.35 : 1.) * (degree == 1 ? 0.5 : 1.) * cell_size;
          ring.is_graded             = is_graded;
          ring.options.degree        = degree;
          ring.options.stabilization = stabilization;
          ring.solver                = solver(solver_type);
          recorder.record([&]() { return run(ring); });
        }
      };
      series(1, false, Stabilization::aggregation, Solver::direct);
      series(2, false, Stabilization::aggregation, Solver::direct);
      series(2, true, Stabilization::aggregation, Solver::direct);
      series(2, true, Stabilization::aggregation, Solver::iterative);
      if (!is_alone)
        return;
      series(2, true, Stabilization::ghost_penalty, Solver::direct);
      for (const double cell_size : cell_sizes)
        recorder.record([&]() { return run_fitted("ring", cell_size); });
    }


    void
    measure_large_rings(Recorder &recorder)
    {
      using Solver     = LinearSolverParameters::Type;
      const auto large = [&](const std::string &name,
                             const double       cell_size,
                             const Solver       solver_type,
                             const bool         is_graded) {
        Ring ring;
        ring.name      = name;
        ring.cell_size = cell_size;
        ring.is_graded = is_graded;
        ring.solver    = solver(solver_type);
        recorder.record([&]() { return run(ring, false); });
      };
      const bool is_full  = recorder.size() == Size::full;
      const bool is_small = recorder.size() == Size::smallest;

      // two ranks against one
      const double shared = is_full ? 0.0074 : is_small ? 0.1 : 0.0151;
      large("ring on ranks", shared, Solver::direct, false);
      large("ring on ranks", shared, Solver::iterative, false);
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        return;

      // one solution
      large("ring of 91000", is_small ? 0.2 : 0.0203175, Solver::direct, true);
      // growth
      const double coarse = is_full ? 0.01487 : is_small ? 0.2 : 0.0301;
      const double factor = is_full ? std::sqrt(10.) : 2.;
      large("ring that grows", coarse, Solver::iterative, false);
      large("ring that grows", coarse / factor, Solver::iterative, false);

      // assembly against FEValues at about as many unknowns
      const double fine = is_full ? 0.0076 : is_small ? 0.12 : 0.01505;
      large("assembly", fine, Solver::direct, false);
      recorder.record([&]() {
        return run_fitted("assembly", fine * (is_small ? 0.9 : 0.931));
      });
    }
  } // namespace Bench
} // namespace NMM
