// A run in time that writes its fields every 20 steps: what the files cost.

#include <nmm/dynamics/time_integrator.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/output/vtu.h>

#include "staged_model.h"
#include <filesystem>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;


      /// A file of fields, as the driver's.
      void
      write_fields(const StagedModel     &model,
                   const Vector          &u,
                   const OutputDirectory &directory,
                   const unsigned int     step)
      {
        const DisplacementField field(*model.covers, model.problem, u);
        const StressRecovery    recovery(field, model.aggregation);
        const FieldEvaluator    evaluator(field, recovery, model.problem);
        const FieldTriangles    triangles(*model.covers, &evaluator);
        write_fields_of_state(*model.covers,
                              triangles,
                              directory,
                              "fields-" + std::to_string(step));
      }


      /// A bar that swings under its weight, for @p n_files files.
      Row
      run(const double       cell_size,
          const unsigned int n_files,
          const bool         is_finite)
      {
        constexpr unsigned int steps_per_file = 20;
        Row                    row;
        row.name       = "output";
        row.method     = "manifold uniform";
        row.kinematics = is_finite ? "finite" : "small";
        row.solver     = "MUMPS";
        Geometry geometry;
        add_box(geometry, {0., 0.}, {4., 1.});
        GradedMeshParameters mesh;
        mesh.cell_size = cell_size;
        mesh.rotation  = 7.;
        StagedModel::Options options;
        options.degree_whole = options.degree_cut = 4;
        StagedModel model(std::move(geometry), mesh, options, row);
        model.problem.plane_state         = PlaneState::plane_strain;
        model.problem.materials           = {material("rock", 1e7, 0.2, 2500.)};
        model.problem.gravity             = Tensor<1, 2>({0., -9.81});
        model.problem.boundary_conditions = {
          condition(Type::displacement, "left")};
        FiniteElasticity elasticity(*model.covers,
                                    *model.quadrature,
                                    model.constraints,
                                    model.problem,
                                    /* may_float = */ true);
        const auto       mass = make_mass_matrix(elasticity, *model.quadrature);
        const auto       solid =
          make_solid(elasticity,
                     is_finite ? Kinematics::finite : Kinematics::small,
                     Loading(),
                     mass);
        MechanicalModel mechanics(solid->layout(), {solid.get()});
        TimeIntegrator  integrator(mechanics, TimeScheme::newmark());
        integrator.initialize();

        const std::filesystem::path folder =
          std::filesystem::temp_directory_path() / "nmm-bench-output";
        const OutputDirectory directory(folder);
        directory.create();
        Vector relevant(mechanics.layout().locally_owned,
                        mechanics.layout().locally_relevant,
                        mechanics.layout().communicator);
        model.lap();
        row.factorization = row.solution = row.output = row.iterations = 0.;
        for (unsigned int file = 0; file < n_files; ++file)
        {
          for (unsigned int i = 0; i < steps_per_file; ++i)
          {
            const StepReport report = integrator.try_step(0.005);
            AssertThrow(report.converged, dealii::ExcInternalError());
            row.iterations += report.n_iterations;
            row.factorization += report.factorization_time;
            integrator.accept();
          }
          row.solution += model.lap();
          relevant = integrator.state().u;
          write_fields(model, relevant, directory, file);
          row.output += model.lap();
        }
        row.solution -= row.factorization;
        row.total = model.total();
        row.steps = n_files * steps_per_file;
        std::filesystem::remove_all(folder);
        return row;
      }
    } // namespace


    void
    measure_output(Recorder &recorder)
    {
      const bool   is_smallest = recorder.size() == Size::smallest;
      const double cell_size   = is_smallest                     ? 0.5
                                 : recorder.size() == Size::full ? 0.03
                                                                 : 0.06;
      for (const bool is_finite : {false, true})
        recorder.record(
          [&]() { return run(cell_size, is_smallest ? 1 : 2, is_finite); });
    }
  } // namespace Bench
} // namespace NMM
