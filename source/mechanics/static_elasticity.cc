#include <nmm/base/exceptions.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/static_elasticity.h>

#include <algorithm>
#include <linear_algebra/linear_solver.h>
#include <mechanics/boundary_terms.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/disk_system.h>
#include <mechanics/point_terms.h>
#include <mechanics/trace_constant.h>
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
    , has_disks(!disks.empty())
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
    auto section = time_section(timer, "sparsity");
    forces       = std::make_unique<FiniteElasticity>(*covers,
                                                *quadrature,
                                                *constraints,
                                                *problem,
                                                /* may_float = */ false,
                                                ghost_penalty);
    AssertThrow(!forces->is_inelastic(),
                InputError("a material is inelastic, which is not possible in "
                           "a linear problem",
                           "StaticElasticity",
                           "choose another law, or NonlinearStatics"));
    section.reset();
    section = time_section(timer, "assembly");
    forces->assemble_at_rest(1.);
    rhs = forces->residual();
    rhs *= -1.;
    if (!has_disks)
      return;
    const internal::CurveConditions conditions(covers->manifold_mesh(),
                                               *problem);
    internal::TraceConstants        trace_constants(
      *covers, *quadrature, *constraints, conditions, ghost_penalty);
    disks->assemble(internal::EdgeTerms(*covers, *problem, trace_constants),
                    conditions,
                    rhs);
  }


  LinearSolverReport
  StaticElasticity::solve(const LinearSolverParameters &parameters)
  {
    std::vector<const dealii::TrilinosWrappers::MPI::Vector *> all_rhs = {&rhs};
    for (const auto &coupling : disks->couplings())
      all_rhs.push_back(&coupling);
    auto [solutions, effects, report] = internal::solve_linear_system(
      system_matrix(), all_rhs, *covers, *constraints, parameters);
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
    return forces->tangent();
  }


  const dealii::TrilinosWrappers::MPI::Vector &
  StaticElasticity::system_rhs() const
  {
    return rhs;
  }
} // namespace NMM
