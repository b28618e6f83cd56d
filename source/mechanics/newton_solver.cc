#include <nmm/base/exceptions.h>
#include <nmm/mechanics/newton_solver.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mechanics/mumps_solver.h>

namespace NMM
{
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
    /// Owned unknowns.
    Vector owned, correction;
    bool   use_increment = true;
    /// From an iteration on that went round, residuals must go down.
    bool goes_round = false;

    Deformation
    assemble(const Vector &u, Tangent tangent, const Vector *increment);

    void
    factorize();

    void
    solve(const Vector &rhs, Vector &solution);

    Deformation
    line_search(Vector                  &u,
                NewtonReport::Iteration &iteration,
                bool                     is_searched);

    Deformation
    descend(Vector &u, NewtonReport::Iteration &iteration);

    bool
    is_going_round() const;

    bool
    iterate(Vector &u, const Vector *increment);

    bool
    has_converged(double largest_energy);

    bool
    refine(Vector &u);
  };


  NewtonSolver::NewtonSolver(const NewtonParameters &parameters)
    : data(std::make_unique<Data>())
  {
    data->parameters = parameters;
  }


  NewtonSolver::~NewtonSolver() = default;


  Deformation
  NewtonSolver::Data::assemble(const Vector &u,
                               const Tangent tangent,
                               const Vector *increment)
  {
    dealii::Timer     timer;
    const Deformation state = system->assemble(u, tangent, increment);
    report->assembly_time += timer.wall_time();
    if (state != Deformation::admissible)
      return state;
    const double norm         = system->residual().l2_norm();
    report->relative_residual = norm > 0. ? norm / system->force_scale() : 0.;
    return std::isfinite(report->relative_residual) ? state
                                                    : Deformation::inverted;
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
                     : internal::DirectSolver::Symmetry::unsymmetric);
    }
    direct_solver->factorize(system->tangent());
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


  /// Choose eta, see the class; moves u and assembles its residual.
  Deformation
  NewtonSolver::Data::line_search(Vector                  &u,
                                  NewtonReport::Iteration &iteration,
                                  const bool               is_searched)
  {
    // what is left of the slope along the correction: not less than this must
    // go, and when the slope has changed its sign, not more
    constexpr double       enough = 0.9, bracketed = 0.5;
    constexpr unsigned int max_brackets = 8;
    const double           first_slope  = correction * system->residual();
    const Vector           before       = owned;
    iteration.line_search               = 1.;
    // eta and slope on both sides of a zero
    double       lower = 0., upper = 1.;
    double       lower_slope = first_slope, upper_slope = 0.;
    bool         is_bracketed = false;
    unsigned int n_brackets   = 0;
    while (true)
    {
      owned = before;
      owned.add(-iteration.line_search, correction);
      constraints->distribute(owned);
      u                       = owned;
      const Deformation state = assemble(u, Tangent::none, nullptr);
      if (state == Deformation::admissible && !is_searched)
        return state;
      if (state == Deformation::admissible)
      {
        const double slope = correction * system->residual();
        if (std::abs(slope) <=
            (is_bracketed ? bracketed : enough) * std::abs(first_slope))
          return state;
        if (slope * first_slope < 0.)
        {
          // regula falsi of the Illinois kind
          if (is_bracketed)
            lower_slope *= 0.5;
          upper        = iteration.line_search;
          upper_slope  = slope;
          is_bracketed = true;
        }
        else if (is_bracketed)
        {
          lower       = iteration.line_search;
          lower_slope = slope;
          upper_slope *= 0.5;
        }
        if (is_bracketed)
        {
          if (++n_brackets > max_brackets)
            return state;
          iteration.line_search =
            lower + (upper - lower) * lower_slope / (lower_slope - upper_slope);
          ++report->n_line_search_cuts;
          continue;
        }
      }
      if (iteration.line_search <= parameters.min_line_search)
        return state;
      iteration.line_search *= 0.5;
      ++report->n_line_search_cuts;
    }
  }


  /// Did none of the last iterations bring |r| far below what had been reached before?
  /// Contact points that stick and slip by turns make Newton's method go round
  /// three states and more, between which r . du goes up and down as it should.
  bool
  NewtonSolver::Data::is_going_round() const
  {
    constexpr unsigned int n_last = 3;
    constexpr double       enough = 0.7;
    const auto            &all    = report->iterations;
    if (all.size() < 2 * n_last)
      return false;
    const auto less = [](const auto &a, const auto &b) {
      return a.relative_residual < b.relative_residual;
    };
    const auto last = all.end() - n_last;
    return std::min_element(last, all.end(), less)->relative_residual >
           enough *
             std::min_element(all.begin(), last, less)->relative_residual;
  }


  /// Choose eta such that |r| goes down by a quarter of what it does where r is linear,
  /// or else the best that was tried: along a path of ever smaller residuals
  /// states change one after the other (Katzenelson's method for piecewise linear
  /// equations). Moves u and assembles its residual.
  Deformation
  NewtonSolver::Data::descend(Vector &u, NewtonReport::Iteration &iteration)
  {
    constexpr double least_share = 1. / 16.;

    const double first  = system->residual().l2_norm();
    const Vector before = owned;
    double       best = std::numeric_limits<double>::max(), best_share = 1.;
    const auto   move_by = [&](const double share) {
      iteration.line_search = share;
      owned                 = before;
      owned.add(-share, correction);
      constraints->distribute(owned);
      u = owned;
      return assemble(u, Tangent::none, nullptr);
    };
    const double unknown = best;
    for (double share = 1.;
         share >= (best == unknown ? parameters.min_line_search : least_share);
         share *= 0.5)
    {
      if (move_by(share) == Deformation::admissible)
      {
        const double norm = system->residual().l2_norm();
        if (norm <= (1. - 0.25 * share) * first)
          return Deformation::admissible;
        if (norm < best)
        {
          best       = norm;
          best_share = share;
        }
      }
      ++report->n_line_search_cuts;
    }
    return move_by(best_share);
  }


  /// One iteration; r(u) is assembled afterwards. False if it failed.
  bool
  NewtonSolver::Data::iterate(Vector &u, const Vector *increment)
  {
    constexpr unsigned int n_young = 4;

    report->iterations.emplace_back();
    const unsigned int       k         = report->iterations.size();
    NewtonReport::Iteration &iteration = report->iterations.back();
    if (assemble(u,
                 k > parameters.n_robust_iterations ? Tangent::consistent
                                                    : Tangent::robust,
                 use_increment ? increment : nullptr) !=
        Deformation::admissible)
    {
      report->reason =
        "the deformation is not admissible (an element is "
        "turned inside out)";
      return false;
    }
    iteration.relative_residual = report->relative_residual;
    try
    {
      factorize();
    }
    catch (const NumericalFailure &failure)
    {
      report->reason = failure.message();
      return false;
    }
    solve(system->residual(), correction);
    iteration.energy = std::abs(correction * system->residual());
    if (!std::isfinite(iteration.energy))
    {
      report->reason = "the tangent is singular";
      return false;
    }

    const bool is_late =
      k > n_young && iteration.energy > report->iterations[k - 2].energy;
    use_increment = use_increment && !is_late;
    goes_round    = goes_round || is_going_round();
    if ((goes_round
           ? descend(u, iteration)
           : line_search(u, iteration, is_late || parameters.always_search)) !=
        Deformation::admissible)
    {
      report->reason =
        "every share of the correction gives a deformation that "
        "is not admissible";
      return false;
    }
    return true;
  }


  bool
  NewtonSolver::Data::has_converged(const double largest_energy)
  {
    return report->relative_residual <= parameters.residual_tolerance &&
           std::abs(correction * system->residual()) <=
             parameters.energy_tolerance * largest_energy;
  }


  /// See NewtonParameters::n_refinements. False if u becomes inadmissible.
  bool
  NewtonSolver::Data::refine(Vector &u)
  {
    for (unsigned int i = 0; i < parameters.n_refinements; ++i)
    {
      solve(system->residual(), correction);
      owned -= correction;
      constraints->distribute(owned);
      u = owned;
      if (assemble(u, Tangent::none, nullptr) != Deformation::admissible)
      {
        report->reason = "the deformation is not admissible";
        return false;
      }
    }
    return true;
  }


  NewtonReport
  NewtonSolver::solve(NonlinearSystem                         &system,
                      const dealii::AffineConstraints<double> &constraints,
                      Vector                                  &u,
                      const Vector                            *increment)
  {
    NewtonReport report;
    data->system        = &system;
    data->constraints   = &constraints;
    data->report        = &report;
    data->use_increment = data->parameters.use_increment;
    data->goes_round    = false;
    data->owned.reinit(u.locally_owned_elements(), u.get_mpi_communicator());
    data->owned = u;

    Vector last_increment(u), before(u);
    double largest_energy = 0.;
    while (report.iterations.size() < data->parameters.max_iterations)
    {
      before = u;
      if (!data->iterate(u, increment))
        return report;
      largest_energy =
        std::max(largest_energy, report.iterations.back().energy);
      if (data->has_converged(largest_energy))
      {
        report.converged = data->refine(u);
        return report;
      }
      last_increment = u;
      last_increment -= before;
      increment = &last_increment;
    }
    report.reason = "no convergence in " +
                    std::to_string(report.iterations.size()) + " iterations";
    return report;
  }
} // namespace NMM
