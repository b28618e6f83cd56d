#include <nmm/base/exceptions.h>
#include <nmm/base/types.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <linear_algebra/direct_solver.h>
#include <linear_algebra/matrix_rows.h>
#include <solution/newton_groups.h>
#include <utility>

namespace NMM
{
  using internal::LineSearch;
  using internal::NewtonGroups;


  const std::vector<unsigned int> &
  NonlinearSystem::blocks_of_unknowns() const
  {
    static const std::vector<unsigned int> none;
    return none;
  }


  struct NewtonSolver::Data
  {
    using Group = NewtonGroups::Group;

    NewtonParameters parameters;

    /// The solver is kept, with its analysis of the pattern, for all systems of the same
    /// size and symmetry.
    std::unique_ptr<internal::DirectSolver> direct_solver;
    bool                                    is_symmetric = false;
    unsigned int                            n            = 0;
    unsigned int                            version      = 0;

    NonlinearSystem                         *system      = nullptr;
    const dealii::AffineConstraints<double> *constraints = nullptr;
    NewtonReport                            *report      = nullptr;
    /// Owned unknowns: u now and before the correction, the correction, and the residual. In rows
    /// of other blocks the residual is that of their last assembly.
    Vector owned, before, correction, residual;
    /// For each locally relevant unknown, its change in the last iteration that corrected it.
    Vector last_increment;
    bool   use_increment = true;
    /// Force scale of the last assembly of all blocks, or else of the first assembly [N/m].
    double scale = 0.;
    /// Tolerance of this solution, relative to the force scale [-].
    double tolerance = 0.;
    /// @{
    /// Rounding of the forces in the last assembly, and by that of the unknowns; negative: not known
    /// yet [N/m].
    double rounding = 0., rounding_by_unknowns = -1.;
    /// @}
    NewtonGroups groups;

    template <typename Predicate>
    Deformation
    assemble_residual(const Vector &u, const Predicate &is_meant);

    Deformation
    assemble_all(const Vector &u);

    Deformation
    assemble_blocks(const Vector            &u,
                    Tangent                  tangent,
                    const Vector            *increment,
                    const std::vector<bool> &blocks);

    /// For each block, whether it is active; empty if all are.
    std::vector<bool>
    all_active() const
    {
      return groups.are_there_several()
               ? groups.active([](const Group &) { return true; })
               : std::vector<bool>();
    }

    Deformation
    assemble_tangent(const Vector &u, const Vector *increment);

    void
    factorize();

    /// Solve with the last factorization for @p blocks (empty: all), which must be whole groups.
    void
    solve(const Vector            &rhs,
          Vector                  &solution,
          const std::vector<bool> &blocks = {});

    /// Set u from the owned unknowns, in active blocks.
    void
    distribute(Vector &u);

    void
    note_increment();

    void
    begin_searches(bool use_slopes);

    Deformation
    search_step_lengths(Vector &u);

    bool
    iterate(Vector &u, const Vector *increment);

    bool
    has_converged(const Group &group, double largest_energy) const;

    void
    find_rounding_by_unknowns();

    double
    floor() const;

    bool
    settle(Vector &u, double largest_energy);

    bool
    refine(Vector &u);
  };


  NewtonSolver::NewtonSolver(const NewtonParameters &parameters)
    : data(std::make_unique<Data>())
  {
    data->parameters = parameters;
  }


  NewtonSolver::~NewtonSolver() = default;

  /// Assemble the residual of active groups for which @p is_meant is true.
  template <typename Predicate>
  Deformation
  NewtonSolver::Data::assemble_residual(const Vector    &u,
                                        const Predicate &is_meant)
  {
    return assemble_blocks(u,
                           Tangent::none,
                           nullptr,
                           groups.are_there_several() ? groups.active(is_meant)
                                                      : std::vector<bool>());
  }


  /// Assemble the residual of all blocks, also of those that are done or sleep.
  Deformation
  NewtonSolver::Data::assemble_all(const Vector &u)
  {
    return assemble_blocks(u, Tangent::none, nullptr, {});
  }


  /// Assemble the rows of @p blocks; empty: of all blocks.
  Deformation
  NewtonSolver::Data::assemble_blocks(const Vector            &u,
                                      const Tangent            tangent,
                                      const Vector            *increment,
                                      const std::vector<bool> &blocks)
  {
    dealii::Timer     timer;
    const Deformation state = system->assemble(u, tangent, increment, blocks);
    report->assembly_time += timer.wall_time();
    if (state != Deformation::admissible)
      return state;
    // the first assembly comprises all blocks that do not sleep
    if (blocks.empty() || scale == 0.)
      scale = system->assembled().force_scale;
    rounding    = system->assembled().force_rounding;
    double norm = 0.;
    if (blocks.empty())
    {
      residual = system->residual();
      norm     = residual.l2_norm();
    }
    else
    {
      const auto from = system->residual().begin();
      const auto to   = residual.begin();
      groups.unknowns().for_each(residual.locally_owned_size(),
                                 [&](const unsigned int i) {
                                   if (groups.is_in(blocks, i))
                                     to[i] = from[i];
                                   norm += to[i] * to[i];
                                 });
      norm = std::sqrt(norm);
    }
    report->relative_residual = norm > 0. ? norm / scale : 0.;
    return std::isfinite(report->relative_residual) ? state
                                                    : Deformation::inverted;
  }


  /// Assemble the tangent and residual of active blocks and update the groups.
  Deformation
  NewtonSolver::Data::assemble_tangent(const Vector &u, const Vector *increment)
  {
    const bool is_robust =
      report->iterations.size() <= parameters.n_robust_iterations;
    const Deformation state =
      assemble_blocks(u,
                      is_robust ? Tangent::robust : Tangent::consistent,
                      use_increment ? increment : nullptr,
                      all_active());
    if (state != Deformation::admissible)
      return state;
    if (const BodyMatrix *body_matrix = system->assembled().body_tangent)
      groups.unite(*body_matrix);
    else
      groups.unite(system->tangent());
    return state;
  }


  void
  NewtonSolver::Data::note_increment()
  {
    if (groups.unknowns().all())
    {
      Vector change(owned);
      change -= before;
      last_increment = change;
      return;
    }
    const auto to = last_increment.begin();
    for (const unsigned int i : groups.unknowns().chosen())
      to[i] =
        std::as_const(owned).begin()[i] - std::as_const(before).begin()[i];
  }


  void
  NewtonSolver::Data::factorize()
  {
    dealii::Timer timer;
    if (direct_solver == nullptr ||
        is_symmetric != system->assembled().is_symmetric || n != owned.size())
    {
      is_symmetric  = system->assembled().is_symmetric;
      n             = owned.size();
      direct_solver = std::make_unique<internal::DirectSolver>(
        is_symmetric ? internal::DirectSolver::Symmetry::symmetric
                     : internal::DirectSolver::Symmetry::unsymmetric,
        system->blocks_of_unknowns());
    }
    else if (version != system->assembled().pattern_version)
      direct_solver->forget_analysis();
    version = system->assembled().pattern_version;
    if (const BodyMatrix *body_matrix = system->assembled().body_tangent)
      direct_solver->factorize(*body_matrix, groups.unknowns().chosen());
    else
      direct_solver->factorize(system->tangent(),
                               groups.unknowns().chosen(),
                               groups.couplings());
    report->factorization_time += timer.wall_time();
  }


  void
  NewtonSolver::Data::solve(const Vector            &rhs,
                            Vector                  &solution,
                            const std::vector<bool> &blocks)
  {
    dealii::Timer timer;
    if (solution.size() != rhs.size())
      solution.reinit(rhs);
    direct_solver->solve(rhs, solution, blocks);
    report->substitution_time += timer.wall_time();
  }


  void
  NewtonSolver::Data::distribute(Vector &u)
  {
    if (groups.unknowns().all() || constraints->n_constraints() > 0)
    {
      constraints->distribute(owned);
      u = owned;
      return;
    }
    // on one rank u has the same unknowns as owned
    const auto from = owned.begin();
    const auto to   = u.begin();
    for (const unsigned int i : groups.unknowns().chosen())
      to[i] = from[i];
  }


  namespace
  {
    /// Whether an iteration cycles, given |r|^2 of all its iterations: |r| is the same as two or
    /// three iterations ago, or none of the last three iterations has reduced it much below the
    /// smallest value before. Contact points that alternate between stick and slip make Newton's
    /// method cycle among three or more states, while r . du grows and falls as if it converged.
    bool
    is_cycling_among_states(const std::vector<double> &squares)
    {
      constexpr unsigned int n_last = 3;
      constexpr double       enough = 0.7, same = 0.01;
      for (const unsigned int n : {2U, 3U})
        if (squares.size() > n + 1 &&
            std::abs(squares.back() - squares[squares.size() - 1 - n]) <
              same * squares.back())
          return true;
      if (squares.size() < 2 * n_last)
        return false;
      const auto last = squares.end() - n_last;
      return *std::min_element(last, squares.end()) >
             enough * enough * *std::min_element(squares.begin(), last);
    }
  } // namespace


  /// Begin the line search of each active group, with products and squares of this iteration.
  void
  NewtonSolver::Data::begin_searches(const bool use_slopes)
  {
    constexpr unsigned int n_young = 4;

    for (const unsigned int root : groups.active_roots())
    {
      Group &group = groups[root];
      group.squares.push_back(group.square / (scale * scale));
      group.energies.push_back(std::abs(group.product));
      const auto k = group.energies.size();
      const bool is_late =
        k > n_young && group.energies[k - 1] > group.energies[k - 2];
      use_increment = use_increment && !is_late;
      group.is_cycling =
        parameters.stops_cycles &&
        (group.is_cycling || is_cycling_among_states(group.squares));
      group.search.begin(group.is_cycling        ? LineSearch::Mode::descend
                         : is_late || use_slopes ? LineSearch::Mode::slope
                                                 : LineSearch::Mode::none,
                         group.product,
                         std::sqrt(group.square),
                         parameters.min_line_search);
    }
  }


  /// Find the step length of each active group, apply it to u and assemble the residual there.
  Deformation
  NewtonSolver::Data::search_step_lengths(Vector &u)
  {
    const auto is_open = [](const Group &group) {
      return !group.search.is_done();
    };
    const auto         x = owned.begin(), a = before.begin();
    const auto         c = std::as_const(correction).begin();
    const unsigned int n = owned.locally_owned_size();
    groups.unknowns().for_each(n, [&](const unsigned int i) { a[i] = x[i]; });
    Deformation state   = Deformation::admissible;
    bool        goes_on = true;
    while (goes_on)
    {
      groups.unknowns().for_each(n, [&](const unsigned int i) {
        x[i] = a[i] - groups.of_unknown(i).search.step_length() * c[i];
      });
      distribute(u);
      state = assemble_residual(u, is_open);
      if (state == Deformation::admissible)
        groups.sum(residual, correction);
      goes_on = false;
      for (const unsigned int root : groups.active_roots())
        if (is_open(groups[root]))
        {
          Group &group = groups[root];
          group.search.judge(state == Deformation::admissible,
                             group.product,
                             std::sqrt(group.square));
          goes_on = goes_on || !group.search.is_done();
        }
    }
    return state;
  }


  /// Take one iteration. Afterwards the residual is that at the new u. Returns false if it failed.
  bool
  NewtonSolver::Data::iterate(Vector &u, const Vector *increment)
  {
    report->iterations.emplace_back();
    NewtonReport::Iteration &iteration = report->iterations.back();
    if (assemble_tangent(u, increment) != Deformation::admissible)
    {
      report->reason =
        "the deformation is not admissible (an element is "
        "turned inside out)";
      return false;
    }
    iteration.relative_residual = report->relative_residual;
    iteration.solved_share      = groups.solved_share();
    try
    {
      factorize();
    }
    catch (const NumericalFailure &failure)
    {
      report->reason = failure.message();
      return false;
    }
    solve(residual, correction);
    groups.sum(residual, correction);
    for (const unsigned int root : groups.active_roots())
      iteration.energy += std::abs(groups[root].product);
    if (!std::isfinite(iteration.energy))
    {
      report->reason = "the tangent is singular";
      return false;
    }

    begin_searches(parameters.always_search);
    const Deformation state = search_step_lengths(u);
    for (const unsigned int root : groups.active_roots())
    {
      const LineSearch &search = groups[root].search;
      iteration.line_search =
        std::min(iteration.line_search, search.step_length());
      report->n_line_search_cuts += search.n_cuts();
    }
    if (use_increment)
      note_increment();
    if (state != Deformation::admissible)
      report->reason =
        "every step length of the correction gives a deformation that "
        "is not admissible";
    return state == Deformation::admissible;
  }


  /// Estimate the rounding of forces by that of the unknowns, as soon as the residual is near the
  /// tolerance: stored numbers are rounded by epsilon / 2, so the forces by that times |K_ij u_j|.
  void
  NewtonSolver::Data::find_rounding_by_unknowns()
  {
    // Residuals below this multiple of the tolerance may be due to rounding.
    constexpr double near = 1e4;
    if (rounding_by_unknowns >= 0. ||
        system->assembled().body_tangent != nullptr ||
        report->relative_residual > near * tolerance)
      return;
    const internal::MatrixRows rows(system->tangent());
    // On several ranks the columns of others are left out, which are few.
    const int *const columns =
      system->tangent().trilinos_matrix().ColMap().MyGlobalElements();
    const auto first = owned.local_range().first,
               last  = owned.local_range().second;
    const auto x     = std::as_const(owned).begin();
    double     sum   = 0.;
    for (unsigned int i = 0; i < owned.locally_owned_size(); ++i)
      for (int e = rows.begins[i]; e < rows.begins[i + 1]; ++e)
      {
        const dealii::types::global_dof_index j = columns[rows.columns[e]];
        if (j >= first && j < last)
          sum += std::pow(rows.values[e] * x[j - first], 2);
      }
    rounding_by_unknowns =
      std::numeric_limits<double>::epsilon() *
      std::sqrt(dealii::Utilities::MPI::sum(sum, owned.get_mpi_communicator()));
  }


  /// The smallest residual that can be expected [N/m].
  double
  NewtonSolver::Data::floor() const
  {
    // A residual of more tolerances than these is not put down to rounding.
    constexpr double most = 10.;
    // The sum of forces is rounded, too: that of a stressed body in balance is nothing else.
    return std::min(most * tolerance * scale,
                    std::hypot(rounding,
                               std::max(0., rounding_by_unknowns),
                               std::numeric_limits<double>::epsilon() * scale));
  }


  /// Whether a group meets its share of both tolerances, which is its share of the unknowns.
  bool
  NewtonSolver::Data::has_converged(const Group &group,
                                    const double largest_energy) const
  {
    const double part =
      static_cast<double>(group.n_unknowns) / groups.n_unknowns();
    const double allowed = tolerance * scale;
    if (group.square <= allowed * allowed * part &&
        std::abs(group.product) <=
          parameters.energy_tolerance * largest_energy * part)
      return true;
    // At the floor an iteration gains nothing any more.
    constexpr double gain = 0.25;
    if (group.square > floor() * floor() ||
        group.square < gain * group.squares.back() * scale * scale)
      return false;
    report->is_at_floor =
      report->is_at_floor || group.square > allowed * allowed * part;
    return true;
  }


  /// Refine the groups that have converged in this iteration, see NewtonParameters::n_refinements.
  /// Returns false if u becomes inadmissible.
  bool
  NewtonSolver::Data::refine(Vector &u)
  {
    const auto is_new = [](const Group &group) { return group.has_converged; };
    const std::vector<bool> blocks =
      groups.are_there_several() ? groups.active(is_new) : std::vector<bool>();
    // With a coarser tolerance contact may still change, and the last tangent is that of another
    // state: its correction may be far too large.
    const unsigned int n =
      tolerance > parameters.residual_tolerance ? 0 : parameters.n_refinements;
    for (unsigned int i = 0; i < n; ++i)
    {
      solve(residual, correction, blocks);
      const auto x = owned.begin();
      const auto c = std::as_const(correction).begin();
      groups.unknowns().for_each(owned.locally_owned_size(),
                                 [&](const unsigned int j) {
                                   if (is_new(groups.of_unknown(j)))
                                     x[j] -= c[j];
                                 });
      distribute(u);
      if (assemble_blocks(u, Tangent::none, nullptr, blocks) !=
          Deformation::admissible)
      {
        report->reason = "the deformation is not admissible";
        return false;
      }
    }
    return true;
  }


  /// Retire the groups that have converged. Returns whether all groups have; if not, and
  /// report->reason is set, the solution has failed.
  bool
  NewtonSolver::Data::settle(Vector &u, const double largest_energy)
  {
    bool is_any_new = false;
    find_rounding_by_unknowns();
    for (const unsigned int root : groups.active_roots())
    {
      Group &group        = groups[root];
      group.has_converged = has_converged(group, largest_energy);
      is_any_new          = is_any_new || group.has_converged;
    }
    if (is_any_new && !refine(u))
      return false;
    groups.retire_converged();
    if (groups.is_any_active())
      return false;
    if (!groups.are_there_several())
      return true;

    // Verify all groups, because a group that was retired early may have been loaded by others since.
    // The caller may also need the forces on blocks that sleep.
    if (assemble_all(u) != Deformation::admissible)
    {
      report->reason = "the deformation is not admissible";
      return false;
    }
    groups.sum_squares(residual);
    const double              allowed = tolerance * scale;
    std::vector<unsigned int> loaded;
    for (const unsigned int root : groups.roots())
      if (groups[root].square * groups.n_unknowns() >
            allowed * allowed * groups[root].n_unknowns &&
          groups[root].square > floor() * floor())
        loaded.push_back(root);
    groups.reactivate(loaded);
    return !groups.is_any_active();
  }


  NewtonReport
  NewtonSolver::solve(NonlinearSystem                         &system,
                      const dealii::AffineConstraints<double> &constraints,
                      Vector                                  &u,
                      const Vector                            *increment,
                      const double residual_tolerance)
  {
    NewtonReport report;
    Data        &d  = *data;
    d.system        = &system;
    d.constraints   = &constraints;
    d.report        = &report;
    d.use_increment = d.parameters.use_increment;
    d.owned.reinit(u.locally_owned_elements(), u.get_mpi_communicator());
    d.owned = u;
    d.residual.reinit(d.owned);
    d.before.reinit(d.owned);
    if (d.use_increment)
      d.last_increment.reinit(u);
    d.tolerance = std::max(d.parameters.residual_tolerance, residual_tolerance);
    d.scale     = 0.;
    d.rounding  = 0.;
    d.rounding_by_unknowns = -1.;
    d.groups.reinit(system.blocks_of_unknowns(),
                    system.sleepers(),
                    d.parameters.solves_groups_separately,
                    d.owned);

    double largest_energy = 0.;
    // if all blocks sleep, only the forces are assembled
    if (!d.groups.is_any_active())
      report.converged = d.settle(u, largest_energy);
    while (!report.converged &&
           report.iterations.size() < d.parameters.max_iterations)
    {
      if (!d.iterate(u, increment))
        break;
      if (d.parameters.after_iteration)
        d.parameters.after_iteration(report);
      largest_energy =
        std::max(largest_energy, report.iterations.back().energy);
      report.converged = d.settle(u, largest_energy);
      if (report.converged || !report.reason.empty())
        break;
      if (d.use_increment)
        increment = &d.last_increment;
    }
    if (!report.converged && report.reason.empty())
      report.reason = "no convergence in " +
                      std::to_string(report.iterations.size()) + " iterations";
    return report;
  }
} // namespace NMM
