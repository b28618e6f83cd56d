#ifndef nmm_source_mechanics_load_amplitudes_h
#define nmm_source_mechanics_load_amplitudes_h

#include <nmm/mechanics/finite_elasticity.h>

namespace NMM
{
  namespace internal
  {
    inline bool
    equal(const LoadAmplitudes &a, const LoadAmplitudes &b)
    {
      return a.boundary_conditions == b.boundary_conditions &&
             a.point_forces == b.point_forces &&
             a.fixed_points == b.fixed_points && a.gravity == b.gravity &&
             a.body_force == b.body_force &&
             a.released_conditions == b.released_conditions &&
             a.released_fixed_points == b.released_fixed_points;
    }


    /// Whether a condition is a load, and not a prescribed displacement.
    inline bool
    is_load(const BoundaryCondition &condition)
    {
      return !condition.is_support();
    }


    /// Amplitude at a position of a list; an empty list stands for amplitudes of 1.
    inline double
    amplitude(const std::vector<double> &list, const unsigned int i)
    {
      return list.empty() ? 1. : list[i];
    }


    /// @p amplitudes with an entry for each condition, force and point.
    inline LoadAmplitudes
    completed(const ElasticityProblem &problem, LoadAmplitudes amplitudes)
    {
      const auto fill = [](std::vector<double> &list, const std::size_t n) {
        if (list.empty())
          list.assign(n, 1.);
      };
      fill(amplitudes.boundary_conditions, problem.boundary_conditions.size());
      fill(amplitudes.point_forces, problem.point_forces.size());
      fill(amplitudes.fixed_points, problem.fixed_points.size());
      return amplitudes;
    }


    /// Whether a support that @p before has is removed in @p after.
    inline bool
    releases_more(const LoadAmplitudes &before, const LoadAmplitudes &after)
    {
      const auto more = [](const std::vector<bool> &old,
                           const std::vector<bool> &now) {
        for (std::size_t i = 0; i < now.size(); ++i)
          if (now[i] && (old.empty() || !old[i]))
            return true;
        return false;
      };
      return more(before.released_conditions, after.released_conditions) ||
             more(before.released_fixed_points, after.released_fixed_points);
    }


    /// Set the amplitudes of loads (@p are_loads) or of prescribed displacements to 0.
    inline void
    set_conditions_to_zero(const ElasticityProblem &problem,
                           const bool               are_loads,
                           std::vector<double>     &amplitudes)
    {
      const auto &conditions = problem.boundary_conditions;
      if (amplitudes.empty())
        amplitudes.assign(conditions.size(), 1.);
      for (unsigned int c = 0; c < conditions.size(); ++c)
        if (is_load(conditions[c]) == are_loads)
          amplitudes[c] = 0.;
    }


    /// The same amplitudes with those of all loads set to 0.
    inline LoadAmplitudes
    without_loads(const ElasticityProblem &problem, LoadAmplitudes amplitudes)
    {
      set_conditions_to_zero(problem, true, amplitudes.boundary_conditions);
      amplitudes.point_forces.assign(problem.point_forces.size(), 0.);
      amplitudes.gravity = amplitudes.body_force = 0.;
      return amplitudes;
    }


    /// The same amplitudes with those of all prescribed displacements set to 0.
    inline LoadAmplitudes
    without_prescribed(const ElasticityProblem &problem,
                       LoadAmplitudes           amplitudes)
    {
      set_conditions_to_zero(problem, false, amplitudes.boundary_conditions);
      amplitudes.fixed_points.assign(problem.fixed_points.size(), 0.);
      return amplitudes;
    }
  } // namespace internal
} // namespace NMM

#endif
