#ifndef nmm_source_solution_line_search_h
#define nmm_source_solution_line_search_h

#include <limits>

namespace NMM
{
  namespace internal
  {
    /**
     * A line search: finds the step length eta of a correction, u - eta delta, from residuals at
     * step lengths that are tried one after the other; see NewtonSolver. It does not assemble by
     * itself, so that several groups of unknowns search side by side with one assembly for all.
     */
    class LineSearch
    {
    public:
      /// Criterion for a step length.
      enum class Mode
      {
        /// Take the first step length with an admissible deformation.
        none,
        /// Reduce it until |r . delta| has decreased.
        slope,
        /// Reduce it until |r| has decreased.
        descend
      };

      /// @p slope is r . delta and @p norm is |r|, both before the correction.
      void
      begin(Mode mode, double slope, double norm, double min_step_length);

      /// The step length to try next or, once is_done(), to take.
      double
      step_length() const
      {
        return eta;
      }

      bool
      is_done() const
      {
        return done;
      }

      /// Judge step_length() by its result: whether the deformation was admissible, and r . delta
      /// and |r| there. Either ends the search or changes step_length().
      void
      judge(bool is_admissible, double slope, double norm);

      /// Number of step lengths that were tried and not taken.
      unsigned int
      n_cuts() const
      {
        return cuts;
      }

    private:
      void
      judge_slope(bool is_admissible, double slope);

      void
      judge_norm(bool is_admissible, double norm);

      void
      halve();

      static constexpr double unknown = std::numeric_limits<double>::max();

      Mode   mode = Mode::none;
      double eta = 1., min_step_length = 0., first_slope = 0., first_norm = 0.;
      bool   done       = true;
      unsigned int cuts = 0;
      /// Step lengths and slopes on both sides of a change of sign of the slope.
      double       lower = 0., upper = 1., lower_slope = 0., upper_slope = 0.;
      bool         is_bracketed = false;
      unsigned int n_brackets   = 0;
      /// The smallest |r| so far and its step length.
      double best = unknown, best_step_length = 1.;
      bool   is_last = false;
    };
  } // namespace internal
} // namespace NMM

#endif
