#ifndef nmm_source_solution_share_search_h
#define nmm_source_solution_share_search_h

#include <limits>

namespace NMM
{
  namespace internal
  {
    /**
     * Which share eta of a correction is taken, from residuals at shares tried one
     * after the other; see NewtonSolver. It knows nothing of what it is for: several
     * groups of unknowns search side by side, with one assembly for all of them.
     */
    class ShareSearch
    {
    public:
      enum class Mode
      {
        /// The first that is admissible.
        none,
        /// Until |r . delta| is less.
        slope,
        /// Until |r| is less.
        descend
      };

      /// @p slope: r . delta, @p norm: |r|, both before the correction.
      void
      begin(Mode mode, double slope, double norm, double min_share);

      /// To be tried next, or taken once is_done().
      double
      share() const
      {
        return eta;
      }

      bool
      is_done() const
      {
        return done;
      }

      /// What came of share().
      void
      judge(bool is_admissible, double slope, double norm);

      /// Shares that were tried and not taken.
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

      Mode         mode = Mode::none;
      double       eta = 1., min_share = 0., first_slope = 0., first_norm = 0.;
      bool         done = true;
      unsigned int cuts = 0;
      /// Shares and slopes on both sides of a zero.
      double       lower = 0., upper = 1., lower_slope = 0., upper_slope = 0.;
      bool         is_bracketed = false;
      unsigned int n_brackets   = 0;
      /// The least |r| so far and its share.
      double best = unknown, best_share = 1.;
      bool   is_last = false;
    };
  } // namespace internal
} // namespace NMM

#endif
