// What runs on several threads, on one and on two of them.

#include <deal.II/base/multithread_info.h>

#include "report.h"
#include "staged_model.h"

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      const char method_start[] = "manifold; threads: ";


      /// A square with joints that cut a fifth of its cells.
      Row
      run(const double cell_size, const unsigned int n_threads)
      {
        Row      row;
        Geometry geometry;
        add_box(geometry, {0., 0.}, {1., 1.});
        const auto n_joints = static_cast<unsigned int>(0.1 / cell_size);
        for (unsigned int i = 1; i <= n_joints; ++i)
        {
          const double y = static_cast<double>(i) / (n_joints + 1);
          geometry.add_polyline({{0.05, y}, {0.95, y + 0.3 * cell_size}},
                                "joint " + std::to_string(i),
                                CurveRole::joint);
        }
        GradedMeshParameters mesh;
        mesh.cell_size = cell_size;
        mesh.rotation  = 7.;
        StagedModel model(std::move(geometry), mesh, {}, row);
        row                       = Row();
        row.name                  = "threads";
        row.method                = method_start + std::to_string(n_threads);
        row.degree                = 2;
        model.problem.plane_state = PlaneState::plane_strain;
        model.problem.materials   = {material("rock", 1e7, 0.2, 2500.)};
        model.problem.gravity     = Tensor<1, 2>({0., -9.81});
        model.problem.boundary_conditions = {
          condition(BoundaryCondition::Type::displacement, "bottom")};
        row.elements     = model.manifold_mesh->n_elements();
        row.cut_elements = 0.;
        for (unsigned int e = 0; e < model.manifold_mesh->n_elements(); ++e)
          row.cut_elements += model.manifold_mesh->is_whole(e) ? 0. : 1.;

        StaticElasticity system(*model.covers,
                                *model.quadrature,
                                model.constraints,
                                model.problem);
        FiniteElasticity finite(*model.covers,
                                *model.quadrature,
                                model.constraints,
                                model.problem,
                                /* may_float = */ true);
        const Vector     u               = finite.initial_solution();
        const auto       assemble_finite = [&]() {
          AssertThrow(finite.assemble(u, 1., Tangent::consistent) ==
                        Deformation::admissible,
                      dealii::ExcInternalError());
        };
        // the first one makes the pattern
        assemble_finite();
        dealii::TimerOutput timer(std::cout,
                                  dealii::TimerOutput::never,
                                  dealii::TimerOutput::wall_times);

        dealii::MultithreadInfo::set_thread_limit(n_threads);
        Stopwatch                  watch;
        const QuadratureCollection rules(
          *model.manifold_mesh, 2, 4, model.covers->locally_owned_elements());
        row.quadrature = watch.lap();
        system.assemble(&timer);
        row.sparsity = watch.lap();
        row.assembly = timer.get_summary_data(
          dealii::TimerOutput::total_wall_time)["assembly"];
        row.sparsity -= row.assembly;
        assemble_finite();
        // of finite kinematics
        row.solution = watch.lap();
        row.total    = watch.total();
        dealii::MultithreadInfo::set_thread_limit(1);
        return row;
      }
    } // namespace


    void
    measure_threads(Recorder &recorder)
    {
      const double cell_size = recorder.size() == Size::smallest ? 0.1
                               : recorder.size() == Size::quick  ? 0.01
                                                                 : 0.005;
      for (const unsigned int n_threads : {1U, 2U})
        recorder.record([&]() { return run(cell_size, n_threads); });
    }


    void
    write_threads(std::ostream &out, const std::vector<Row> &rows)
    {
      const std::vector<Row> members = select(rows, "threads");
      if (members.empty())
        return;
      out
        << "## Threads\n\nResults have the same bits on any number of threads "
           "(`nmm --threads`). Rules, assembly and contact points run on them; "
           "cutting, the search for candidates, stress recovery and "
           "factorizations (`OPENBLAS_NUM_THREADS`) do not.\n\n"
           "| threads | elements | cut | rules [s] | assembly, small [s] | "
           "assembly, finite [s] |\n|---|---|---|---|---|---|\n";
      for (const Row &row : members)
        out << "| " << row.method.substr(sizeof(method_start) - 1) << " | "
            << text_of(row.elements) << " | " << text_of(row.cut_elements)
            << " | " << text_of(row.quadrature) << " | "
            << text_of(row.assembly) << " | " << text_of(row.solution)
            << " |\n";
      out
        << "\nOpenBLAS 0.3.21 (Debian 12) does not know the newest processors. "
           "`OPENBLAS_CORETYPE=HASWELL` names one that it knows: `nmm "
           "applications/nmm/scenes/jointed-tunnel.prm` takes 10.1 instead of "
           "10.8 s on such a processor.\n\n";
    }
  } // namespace Bench
} // namespace NMM
