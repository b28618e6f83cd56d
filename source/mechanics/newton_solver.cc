#include <nmm/base/exceptions.h>
#include <nmm/mechanics/newton_solver.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <mechanics/mumps_solver.h>
#include <mechanics/newton_groups.h>

namespace NMM
{
  using internal::NewtonGroups;
  using internal::ShareSearch;
  using Group = NewtonGroups::Group;


  const std::vector<unsigned int> &
  NonlinearSystem::blocks_of_unknowns() const
  {
    static const std::vector<unsigned int> none;
    return none;
  }


  const std::vector<bool> &
  NonlinearSystem::held_blocks() const
  {
    static const std::vector<bool> none;
    return none;
  }


  struct NewtonSolver::Data
  {
    NewtonParameters parameters;

    /// Made for the first system and kept, with its analysis, for all of the same
    /// size, pattern and symmetry.
    std::unique_ptr<internal::DirectSolver> direct_solver;
    bool                                    is_symmetric = false;
    unsigned int                            n            = 0;
    unsigned int                            version      = 0;

    NonlinearSystem                         *system      = nullptr;
    const dealii::AffineConstraints<double> *constraints = nullptr;
    NewtonReport                            *report      = nullptr;
    /// Owned unknowns. The residual of what is not active is that of the time when
    /// it was.
    Vector owned, correction, residual;
    bool   use_increment = true;
    /// That of the last assembly of all, or of the first one.
    double       scale = 0.;
    NewtonGroups groups;
    /// What active groups pressed on in this iteration.
    std::vector<unsigned int> touched;

    static bool
    is_active(const Group &group)
    {
      return group.is_active;
    }

    template <typename Predicate>
    Deformation
    assemble(const Vector    &u,
             Tangent          tangent,
             const Vector    *increment,
             const Predicate &is_meant);

    Deformation
    assemble_tangent(const Vector &u, const Vector *increment);

    void
    factorize();

    void
    solve(const Vector &rhs, Vector &solution);

    void
    begin_searches(bool use_slopes);

    Deformation
    search_shares(Vector &u);

    bool
    iterate(Vector &u, const Vector *increment);

    bool
    has_converged(const Group &group, double largest_energy) const;

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


  /// Residual, and tangent, of groups for which @p is_meant.
  template <typename Predicate>
  Deformation
  NewtonSolver::Data::assemble(const Vector    &u,
                               const Tangent    tangent,
                               const Vector    *increment,
                               const Predicate &is_meant)
  {
    dealii::Timer     timer;
    std::vector<bool> blocks;
    if (groups.are_there_several())
    {
      blocks = groups.mask(is_meant);
      system->set_active_blocks(blocks);
    }
    const Deformation state = system->assemble(u, tangent, increment);
    if (groups.are_there_several())
      for (const unsigned int block : system->take_touched_blocks())
        touched.push_back(block);
    report->assembly_time += timer.wall_time();
    if (state != Deformation::admissible)
      return state;
    // the first one is of all that is not held
    if (blocks.empty() || scale == 0.)
      scale = system->force_scale();
    if (blocks.empty())
      residual = system->residual();
    else
    {
      auto from = system->residual().begin();
      auto to   = residual.begin();
      for (unsigned int i = 0; to != residual.end(); ++from, ++to, ++i)
        if (groups.is_in(blocks, i))
          *to = *from;
    }
    const double norm         = residual.l2_norm();
    report->relative_residual = norm > 0. ? norm / scale : 0.;
    return std::isfinite(report->relative_residual) ? state
                                                    : Deformation::inverted;
  }


  /// Of what is active and of what it presses on, with residual and groups. What is
  /// pressed on may press on something else: each time only the rows of what is
  /// new are assembled.
  Deformation
  NewtonSolver::Data::assemble_tangent(const Vector &u, const Vector *increment)
  {
    const unsigned int k = report->iterations.size();
    for (const unsigned int root : groups.roots())
      groups[root].has_tangent = false;
    touched.clear();
    while (true)
    {
      const Deformation state =
        assemble(u,
                 k > parameters.n_robust_iterations ? Tangent::consistent
                                                    : Tangent::robust,
                 use_increment ? increment : nullptr,
                 [](const Group &group) {
                   return group.is_active && !group.has_tangent;
                 });
      if (state != Deformation::admissible)
        return state;
      for (const unsigned int root : groups.roots())
        groups[root].has_tangent = groups[root].is_active;
      for (const unsigned int block : touched)
        groups.wake(block);
      touched.clear();
      if (std::all_of(groups.roots().begin(),
                      groups.roots().end(),
                      [this](const unsigned int root) {
                        return !groups[root].is_active ||
                               groups[root].has_tangent;
                      }))
        return state;
    }
  }


  void
  NewtonSolver::Data::factorize()
  {
    dealii::Timer timer;
    if (direct_solver == nullptr ||
        is_symmetric != system->tangent_is_symmetric() ||
        n != system->tangent().m() || version != system->pattern_version())
    {
      version       = system->pattern_version();
      is_symmetric  = system->tangent_is_symmetric();
      n             = system->tangent().m();
      direct_solver = std::make_unique<internal::DirectSolver>(
        is_symmetric ? internal::DirectSolver::Symmetry::symmetric
                     : internal::DirectSolver::Symmetry::unsymmetric,
        groups.are_there_several());
    }
    const std::vector<bool> blocks =
      groups.are_there_several() ? groups.mask(is_active) : std::vector<bool>();
    if (blocks.empty())
      direct_solver->factorize(system->tangent());
    else
    {
      std::vector<bool> rows(n);
      for (unsigned int i = 0; i < n; ++i)
        rows[i] = groups.is_in(blocks, i);
      direct_solver->factorize(system->tangent(), rows);
    }
    report->factorization_time += timer.wall_time();
  }


  void
  NewtonSolver::Data::solve(const Vector &rhs, Vector &solution)
  {
    dealii::Timer timer;
    solution.reinit(rhs, /* omit_zeroing_entries = */ true);
    direct_solver->solve(rhs, solution);
    report->substitution_time += timer.wall_time();
  }


  namespace
  {
    /// Is |r| what it was two or three iterations ago, or did none of the last ones bring
    /// it far below what had been reached before? Contact points that stick and slip by
    /// turns make Newton's method go round three states and more, between which
    /// r . du goes up and down as it should.
    bool
    is_going_round(const Group &group)
    {
      constexpr unsigned int n_last = 3;
      constexpr double       enough = 0.7, same = 0.01;
      const auto            &all = group.squares;
      for (const unsigned int n : {2U, 3U})
        if (all.size() > n + 1 &&
            std::abs(all.back() - all[all.size() - 1 - n]) < same * all.back())
          return true;
      if (all.size() < 2 * n_last)
        return false;
      const auto last = all.end() - n_last;
      return *std::min_element(last, all.end()) >
             enough * enough * *std::min_element(all.begin(), last);
    }
  } // namespace


  /// From products and squares of this iteration.
  void
  NewtonSolver::Data::begin_searches(const bool use_slopes)
  {
    constexpr unsigned int n_young = 4;

    for (const unsigned int root : groups.roots())
    {
      Group &group = groups[root];
      if (!group.is_active)
        continue;
      group.squares.push_back(group.square / (scale * scale));
      group.energies.push_back(std::abs(group.product));
      const auto k = group.energies.size();
      const bool is_late =
        k > n_young && group.energies[k - 1] > group.energies[k - 2];
      use_increment    = use_increment && !is_late;
      group.goes_round = group.goes_round || is_going_round(group);
      group.search.begin(group.goes_round        ? ShareSearch::Mode::descend
                         : is_late || use_slopes ? ShareSearch::Mode::slope
                                                 : ShareSearch::Mode::none,
                         group.product,
                         std::sqrt(group.square),
                         parameters.min_line_search);
    }
  }


  /// Moves u by shares of the correction and assembles its residual.
  Deformation
  NewtonSolver::Data::search_shares(Vector &u)
  {
    const Vector before  = owned;
    const auto   is_open = [](const Group &group) {
      return group.is_active && !group.search.is_done();
    };
    Deformation state   = Deformation::admissible;
    bool        goes_on = true;
    while (goes_on)
    {
      auto x = owned.begin();
      auto a = before.begin();
      auto c = correction.begin();
      for (unsigned int i = 0; x != owned.end(); ++x, ++a, ++c, ++i)
      {
        const Group &group = groups.of_unknown(i);
        *x = group.is_active ? *a - group.search.share() * *c : *a;
      }
      constraints->distribute(owned);
      u     = owned;
      state = assemble(u, Tangent::none, nullptr, is_open);
      if (state == Deformation::admissible)
        groups.sum(residual, correction);
      goes_on = false;
      for (const unsigned int root : groups.roots())
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


  /// One iteration; r(u) is assembled afterwards. False if it failed.
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
    if (groups.are_there_several())
      groups.unite(system->tangent());
    iteration.relative_residual = report->relative_residual;
    iteration.active_share      = groups.active_share();
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
    for (const unsigned int root : groups.roots())
      if (groups[root].is_active)
        iteration.energy += std::abs(groups[root].product);
    if (!std::isfinite(iteration.energy))
    {
      report->reason = "the tangent is singular";
      return false;
    }

    begin_searches(parameters.always_search);
    const Deformation state = search_shares(u);
    for (const unsigned int root : groups.roots())
      if (groups[root].is_active)
      {
        const ShareSearch &search = groups[root].search;
        iteration.line_search = std::min(iteration.line_search, search.share());
        report->n_line_search_cuts += search.n_cuts();
      }
    if (state != Deformation::admissible)
      report->reason =
        "every share of the correction gives a deformation that "
        "is not admissible";
    return state == Deformation::admissible;
  }


  /// A group's part of both tolerances is that of its unknowns.
  bool
  NewtonSolver::Data::has_converged(const Group &group,
                                    const double largest_energy) const
  {
    const double part =
      static_cast<double>(group.n_unknowns) / groups.n_unknowns();
    const double allowed = parameters.residual_tolerance * scale;
    return group.square <= allowed * allowed * part &&
           std::abs(group.product) <=
             parameters.energy_tolerance * largest_energy * part;
  }


  /// See NewtonParameters::n_refinements; of groups that have converged now. False if
  /// u becomes inadmissible.
  bool
  NewtonSolver::Data::refine(Vector &u)
  {
    const auto is_new = [](const Group &group) {
      return group.is_active && group.has_converged;
    };
    for (unsigned int i = 0; i < parameters.n_refinements; ++i)
    {
      solve(residual, correction);
      auto x = owned.begin();
      auto c = correction.begin();
      for (unsigned int j = 0; x != owned.end(); ++x, ++c, ++j)
        if (is_new(groups.of_unknown(j)))
          *x -= *c;
      constraints->distribute(owned);
      u = owned;
      if (assemble(u, Tangent::none, nullptr, is_new) !=
          Deformation::admissible)
      {
        report->reason = "the deformation is not admissible";
        return false;
      }
    }
    return true;
  }


  /// Leaves what has converged alone; have all? Not if there is a reason why it failed.
  bool
  NewtonSolver::Data::settle(Vector &u, const double largest_energy)
  {
    bool is_any_new = false;
    for (const unsigned int root : groups.roots())
    {
      Group &group        = groups[root];
      group.has_converged = has_converged(group, largest_energy);
      is_any_new = is_any_new || (group.is_active && group.has_converged);
    }
    if (is_any_new && !refine(u))
      return false;
    for (const unsigned int root : groups.roots())
      groups[root].is_active =
        groups[root].is_active && !groups[root].has_converged;
    for (const unsigned int block : touched)
      groups.wake(block);
    if (groups.is_any_active())
      return false;
    if (!groups.are_there_several())
      return true;

    // what was settled early may have been pressed on, below what was noticed; and
    // the caller may want to know forces on what is held
    if (assemble(u, Tangent::none, nullptr, [](const Group &) {
          return true;
        }) != Deformation::admissible)
    {
      report->reason = "the deformation is not admissible";
      return false;
    }
    groups.sum(residual, correction);
    const double allowed = parameters.residual_tolerance * scale;
    for (const unsigned int root : groups.roots())
      if (!groups[root].is_held &&
          groups[root].square * groups.n_unknowns() >
            allowed * allowed * groups[root].n_unknowns)
        groups.wake(root);
    return !groups.is_any_active();
  }


  NewtonReport
  NewtonSolver::solve(NonlinearSystem                         &system,
                      const dealii::AffineConstraints<double> &constraints,
                      Vector                                  &u,
                      const Vector                            *increment)
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
    d.scale = 0.;
    d.groups.reinit(system.blocks_of_unknowns(), system.held_blocks(), d.owned);

    Vector last_increment(u), before(u);
    double largest_energy = 0.;
    // everything is held: only forces are wanted
    if (!d.groups.is_any_active())
      report.converged = d.settle(u, largest_energy);
    while (!report.converged &&
           report.iterations.size() < d.parameters.max_iterations)
    {
      before = u;
      if (!d.iterate(u, increment))
        break;
      largest_energy =
        std::max(largest_energy, report.iterations.back().energy);
      report.converged = d.settle(u, largest_energy);
      if (report.converged || !report.reason.empty())
        break;
      last_increment = u;
      last_increment -= before;
      increment = &last_increment;
    }
    if (!report.converged && report.reason.empty())
      report.reason = "no convergence in " +
                      std::to_string(report.iterations.size()) + " iterations";
    if (d.groups.are_there_several())
      system.set_active_blocks({});
    return report;
  }
} // namespace NMM
