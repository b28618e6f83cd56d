#include <nmm/base/exceptions.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/static_elasticity.h>

#include <algorithm>
#include <base/in_order.h>
#include <linear_algebra/cover_matrix_assembler.h>
#include <linear_algebra/linear_solver.h>
#include <mechanics/boundary_terms.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/disk_system.h>
#include <mechanics/edge_tables.h>
#include <mechanics/floating_blocks.h>
#include <mechanics/ghost_terms.h>
#include <mechanics/local_system.h>
#include <mechanics/point_terms.h>
#include <mechanics/trace_constant.h>
#include <mechanics/volume_terms.h>
#include <memory>

namespace NMM
{
  namespace
  {
    /// Start a section of the timer; null if there is no timer.
    std::unique_ptr<dealii::TimerOutput::Scope>
    time_section(dealii::TimerOutput *timer, const std::string &name)
    {
      return timer == nullptr
               ? nullptr
               : std::make_unique<dealii::TimerOutput::Scope>(*timer, name);
    }


    /// Couple the covers of elements that are tied or have a ghost penalty.
    void
    couple_pairs(
      const CoverSystem                                        &covers,
      const internal::CurveConditions                          &conditions,
      const std::vector<std::pair<unsigned int, unsigned int>> &ghost_pairs,
      internal::CoverMatrixAssembler                           &assembler)
    {
      const unsigned int n =
        2 * covers.manifold_mesh().mathematical_mesh().n_covers_per_cell();
      const auto couple = [&](const unsigned int e,
                              const unsigned int neighbor) {
        assembler.couple(
          {internal::covers_of_pair(covers, e, neighbor).data(), n});
      };
      internal::for_each_tie(
        covers, conditions, [&](const unsigned int e, const ElementEdge &edge) {
          couple(e, edge.neighbor);
        });
      for (const auto &pair : ghost_pairs)
        couple(pair.first, pair.second);
    }


    /// Add the forces of all loads to the right-hand side.
    void
    add_loads(const internal::DeadLoads      &loads,
              internal::CoverMatrixAssembler &assembler)
    {
      loads.for_each_load([&](const internal::DeadLoads::Load &load) {
        constexpr double no_matrix[4] = {};
        for (unsigned int i = 0; i < load.covers.size(); ++i)
          assembler.add({&load.covers[i], 1}, no_matrix, &load.forces[i][0]);
      });
    }
  } // namespace


  StaticElasticity::StaticElasticity(
    const CoverSystem                       &covers,
    const QuadratureCollection              &quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem,
    const GhostPenalty                      *ghost_penalty,
    const std::vector<const DiskCover *>    &disks)
    : covers(&covers)
    , quadrature(&quadrature)
    , constraints(&constraints)
    , problem(&problem)
    , ghost_penalty(ghost_penalty)
    , disks(std::make_unique<internal::DiskSystem>(covers,
                                                   constraints,
                                                   problem,
                                                   disks))
  {
    problem.check(covers.manifold_mesh().physical_mesh());
    // throws an exception for points outside the solid
    const internal::PointTerms points(covers, problem);
  }


  StaticElasticity::~StaticElasticity() = default;


  void
  StaticElasticity::assemble(dealii::TimerOutput *timer)
  {
    using namespace internal;
    const ManifoldMesh &mesh = covers->manifold_mesh();
    const unsigned int  n_per_cell =
      mesh.mathematical_mesh().n_covers_per_cell();

    const CurveConditions conditions(mesh, *problem);
    const PointTerms      points(*covers, *problem);
    check_no_block_floats(*covers, *problem, conditions, points);

    auto                 section = time_section(timer, "sparsity");
    CoverMatrixAssembler assembler(*covers, *constraints);
    const auto           ghost_pairs = owned_pairs(*covers, ghost_penalty);
    couple_pairs(*covers, conditions, ghost_pairs, assembler);
    assembler.build(matrix, rhs);
    assembler.reset();

    section.reset();
    section = time_section(timer, "assembly");
    const VolumeTerms volume_terms(*covers, *quadrature, *problem);
    const GhostTerms  ghost_terms(*covers, *problem);
    TraceConstants    trace_constants(
      *covers, *quadrature, *constraints, conditions, ghost_penalty);
    const EdgeTables edges(*covers, *problem, conditions, trace_constants);
    const EdgeTerms  edge_terms(*covers, *problem, trace_constants);
    // the right-hand side is the negative force of all terms at rest
    const auto add = [&](const dealii::ArrayView<const unsigned int> &to,
                         LocalSystem                                 &local) {
      for (unsigned int i = 0; i < 2 * local.n_covers; ++i)
        local.rhs[i] = -local.rhs[i];
      assembler.add(to, local.matrix, local.rhs);
    };
    const LocalDisplacement rest{};
    auto                    condition = edges.conditions.begin();
    const auto [first, last]          = covers->locally_owned_elements();
    for_each_in_order<LocalSystem>(
      first,
      last,
      [&](const unsigned int e, LocalSystem &system) {
        system.reset(n_per_cell);
        volume_terms.add(e, system);
      },
      [&](const unsigned int e, LocalSystem &system) {
        if (condition != edges.conditions.end() && condition->element == e)
          edge_terms.add_weak_points(edges, *condition++, system);
        for (unsigned int f = 0; f < problem->fixed_points.size(); ++f)
          if (points.fixed_point_elements()[f] == e)
            points.add_spring(f, 1., rest, system);
        add(covers->covers(e), system);
      });
    LocalSystem local;
    const auto  add_pair = [&](const unsigned int e,
                              const unsigned int neighbor,
                              const auto        &add_terms) {
      const auto pair = covers_of_pair(*covers, e, neighbor);
      local.reset(2 * n_per_cell);
      add_terms();
      add({pair.data(), 2 * n_per_cell}, local);
    };
    for (const EdgeTables::Site &tie : edges.ties)
      add_pair(tie.element, tie.neighbor, [&]() {
        edge_terms.add_weak_points(edges, tie, local);
      });
    for (const auto &pair : ghost_pairs)
      add_pair(pair.first, pair.second, [&]() {
        ghost_terms.add_stiffness(pair, local);
      });
    add_loads(DeadLoads(*covers,
                        *quadrature,
                        *problem,
                        conditions,
                        points,
                        /* are_displacements_small = */ true),
              assembler);
    section.reset();
    section = time_section(timer, "to Trilinos");
    assembler.compress();
    disks->assemble(edge_terms, conditions, rhs);
  }


  LinearSolverReport
  StaticElasticity::solve(const LinearSolverParameters &parameters)
  {
    std::vector<const dealii::TrilinosWrappers::MPI::Vector *> all_rhs = {&rhs};
    for (const auto &coupling : disks->couplings())
      all_rhs.push_back(&coupling);
    std::vector<dealii::TrilinosWrappers::MPI::Vector> solutions, effects;
    LinearSolverReport report = internal::solve_linear_system(
      matrix, all_rhs, *covers, *constraints, parameters, solutions, effects);
    dealii::TrilinosWrappers::MPI::Vector distributed_solution =
      std::move(solutions.front());
    solutions.erase(solutions.begin());
    disks->combine(solutions, distributed_solution);
    disk_energy_value = disks->energy(distributed_solution);
    constraints->distribute(distributed_solution);
    relevant_solution.reinit(covers->locally_owned_dofs(2),
                             covers->locally_relevant_dofs(2),
                             covers->communicator());
    relevant_solution = distributed_solution;

    constexpr double limit = 0.01;
    if (!effects.empty())
      report.rounding_effect = largest_share(effects);
    AssertThrow(report.rounding_effect <= limit,
                NumericalFailure("The linear system is singular to rounding, "
                                 "which changes the displacements by " +
                                   std::to_string(report.rounding_effect) +
                                   " of them",
                                 "",
                                 "look for strips that are thinner than "
                                 "numbers can resolve, or for materials of "
                                 "extreme stiffness contrast"));
    return report;
  }


  /// The largest L2 norm of the displacements with the unknowns of one of @p changes, over that of
  /// the solution [-]. Unknowns of thin strips may be far off without changing displacements.
  double
  StaticElasticity::largest_share(
    const std::vector<dealii::TrilinosWrappers::MPI::Vector> &changes) const
  {
    const auto norm = [&](const dealii::TrilinosWrappers::MPI::Vector &u) {
      return compute_errors(
               DisplacementField(*covers, *problem, u),
               [](const dealii::Point<2> &) { return dealii::Tensor<1, 2>(); },
               [](const dealii::Point<2> &) {
                 return dealii::SymmetricTensor<2, 2>();
               })
        .displacement;
    };
    double largest = 0.;
    for (dealii::TrilinosWrappers::MPI::Vector change : changes)
    {
      constraints->distribute(change);
      dealii::TrilinosWrappers::MPI::Vector relevant(relevant_solution);
      relevant = change;
      largest  = std::max(largest, norm(relevant));
    }
    return largest / norm(relevant_solution);
  }


  const dealii::TrilinosWrappers::MPI::Vector &
  StaticElasticity::solution() const
  {
    return relevant_solution;
  }


  const std::vector<dealii::Vector<double>> &
  StaticElasticity::disk_coefficients() const
  {
    return disks->coefficients();
  }


  double
  StaticElasticity::disk_energy() const
  {
    return disk_energy_value;
  }


  const dealii::TrilinosWrappers::SparseMatrix &
  StaticElasticity::system_matrix() const
  {
    return matrix;
  }


  const dealii::TrilinosWrappers::MPI::Vector &
  StaticElasticity::system_rhs() const
  {
    return rhs;
  }
} // namespace NMM
