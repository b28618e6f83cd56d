#include "staged_model.h"

#include <iomanip>
#include <sstream>

namespace NMM
{
  namespace Bench
  {
    StagedModel::StagedModel(Geometry                    geometry,
                             const GradedMeshParameters &mesh_parameters,
                             const Options              &options,
                             Row                        &row)
      : watch(options.communicator)
    {
      const double       memory = allocated_memory();
      const unsigned int p      = options.degree;
      row.degree                = p;
      row.stabilization         = name(options.stabilization);

      physical_mesh     = std::make_unique<PhysicalMesh>(std::move(geometry));
      row.geometry      = watch.lap();
      mathematical_mesh = std::make_unique<MathematicalMesh>(
        mesh_parameters.local_sizes.empty()
          ? make_regular_mesh(*physical_mesh, mesh_parameters, p)
          : make_graded_mesh(*physical_mesh, mesh_parameters, p));
      row.mesh = watch.lap();
      manifold_mesh =
        std::make_unique<ManifoldMesh>(*mathematical_mesh, *physical_mesh);
      row.cutting = watch.lap();

      covers =
        std::make_unique<CoverSystem>(*manifold_mesh, options.communicator);
      if (options.has_contact)
      {
        covers->make_boundary_relevant();
        surface = std::make_unique<ContactSurface>(*covers, options.obstacles);
      }
      if (options.stabilization == Stabilization::aggregation)
      {
        aggregation = aggregate(*covers);
        constraints = make_constraints(*covers, aggregation, 2);
      }
      else
        constraints.close();
      if (options.stabilization == Stabilization::ghost_penalty)
        ghost_penalty =
          std::make_unique<GhostPenalty>(make_ghost_penalty(*manifold_mesh));
      row.covers = watch.lap();

      quadrature = std::make_unique<QuadratureCollection>(
        *manifold_mesh,
        options.degree_whole == 0 ? std::max(1U, 2 * (p - 1))
                                  : options.degree_whole,
        options.degree_cut == 0 ? 2 * p : options.degree_cut,
        covers->locally_owned_elements());
      row.quadrature = watch.lap();

      count(memory, row);
      watch.lap();
    }


    void
    StagedModel::count(const double memory, Row &row) const
    {
      using namespace dealii::Utilities::MPI;
      const MPI_Comm communicator = covers->communicator();
      const auto [first, end]     = covers->locally_owned_elements();
      row.elements                = manifold_mesh->n_elements();
      row.cut_elements            = 0.;
      for (unsigned int e = first; e < end; ++e)
        row.cut_elements += manifold_mesh->is_whole(e) ? 0. : 1.;
      row.cut_elements = sum(row.cut_elements, communicator);
      row.unknowns =
        2. * (covers->n_covers() - aggregation.cover_to_root.size());
      row.rank_memory = max(allocated_memory() - memory, communicator);
    }


    void
    StagedModel::solve(const LinearSolverParameters &parameters, Row &row)
    {
      watch.lap();
      elasticity = std::make_unique<StaticElasticity>(
        *covers, *quadrature, constraints, problem, ghost_penalty.get());
      dealii::TimerOutput timer(covers->communicator(),
                                std::cout,
                                dealii::TimerOutput::never,
                                dealii::TimerOutput::wall_times);
      elasticity->assemble(&timer);
      const double all = watch.lap();
      row.sparsity     = timer.get_summary_data(
        dealii::TimerOutput::total_wall_time)["sparsity"];
      row.assembly                    = all - row.sparsity;
      const LinearSolverReport report = elasticity->solve(parameters);
      row.solution                    = watch.lap();
      row.analysis      = report.direct ? report.analysis_time : none;
      row.factorization = report.factorization_time;
      row.solution -= report.analysis_time + row.factorization;
      row.solver         = report.direct ? "MUMPS" : "CG + ML";
      row.factor_entries = report.direct ? report.n_factor_entries : none;
      row.iterations     = report.direct ? none : report.n_iterations;
      row.nonzeros       = elasticity->system_matrix().n_nonzero_elements();
      row.total          = watch.total();
    }


    double
    StagedModel::lap()
    {
      return watch.lap();
    }


    double
    StagedModel::total() const
    {
      return watch.total();
    }


    Tensor<1, 2>
    StagedModel::displacement(const DisplacementField &field,
                              const Point<2>          &x,
                              const Point<2>          &inside) const
    {
      using namespace dealii::Utilities::MPI;
      const Point<2> here        = x + 1e-9 * (inside - x);
      const auto [first, last]   = covers->locally_owned_elements();
      const unsigned int element = manifold_mesh->find_element(here);
      const bool         is_here = element >= first && element < last;
      const unsigned int rank    = this_mpi_process(covers->communicator()),
                         owner   = min(is_here ? rank : invalid_index,
                                     covers->communicator());
      AssertThrow(owner != invalid_index, dealii::ExcInternalError());
      Tensor<1, 2> u;
      if (owner == rank)
        u = field.displacement(element,
                               mathematical_mesh->real_to_reference(
                                 manifold_mesh->cell(element), x));
      for (unsigned int c = 0; c < 2; ++c)
        u[c] = sum(u[c], covers->communicator());
      return u;
    }


    std::string
    name(const Stabilization stabilization)
    {
      return stabilization == Stabilization::none          ? "none"
             : stabilization == Stabilization::aggregation ? "aggregation"
                                                           : "ghost penalty";
    }


    std::string
    to_text(const std::vector<double> &numbers)
    {
      std::ostringstream text;
      text << std::setprecision(15);
      for (unsigned int i = 0; i < numbers.size(); ++i)
        text << (i == 0 ? "" : " ") << numbers[i];
      return text.str();
    }
  } // namespace Bench
} // namespace NMM
