#include <cmath>
#include <solution/share_search.h>

namespace NMM
{
  namespace internal
  {
    void
    ShareSearch::begin(const Mode   new_mode,
                       const double slope,
                       const double norm,
                       const double least)
    {
      *this       = ShareSearch();
      mode        = new_mode;
      first_slope = lower_slope = slope;
      first_norm                = norm;
      min_share                 = least;
      done                      = false;
    }


    void
    ShareSearch::judge(const bool   is_admissible,
                       const double slope,
                       const double norm)
    {
      if (mode == Mode::descend)
        judge_norm(is_admissible, norm);
      else if (is_admissible && mode == Mode::none)
        done = true;
      else
        judge_slope(is_admissible, slope);
    }


    void
    ShareSearch::halve()
    {
      eta *= 0.5;
      ++cuts;
    }


    void
    ShareSearch::judge_slope(const bool is_admissible, const double slope)
    {
      // what is left of the slope along the correction: not less than this must
      // go, and when the slope has changed its sign, not more
      constexpr double       enough = 0.9, bracketed = 0.5;
      constexpr unsigned int max_brackets = 8;

      if (is_admissible)
      {
        if (std::abs(slope) <=
            (is_bracketed ? bracketed : enough) * std::abs(first_slope))
        {
          done = true;
          return;
        }
        if (slope * first_slope < 0.)
        {
          // regula falsi of the Illinois kind
          if (is_bracketed)
            lower_slope *= 0.5;
          upper        = eta;
          upper_slope  = slope;
          is_bracketed = true;
        }
        else if (is_bracketed)
        {
          lower       = eta;
          lower_slope = slope;
          upper_slope *= 0.5;
        }
        if (is_bracketed)
        {
          done = ++n_brackets > max_brackets;
          if (done)
            return;
          eta =
            lower + (upper - lower) * lower_slope / (lower_slope - upper_slope);
          ++cuts;
          return;
        }
      }
      done = eta <= min_share;
      if (!done)
        halve();
    }


    void
    ShareSearch::judge_norm(const bool is_admissible, const double norm)
    {
      constexpr double least_share = 1. / 16.;

      done =
        is_last || (is_admissible && norm <= (1. - 0.25 * eta) * first_norm);
      if (done)
        return;
      if (is_admissible && norm < best)
      {
        best       = norm;
        best_share = eta;
      }
      halve();
      if (eta < (best == unknown ? min_share : least_share))
      {
        eta     = best_share;
        is_last = true;
      }
    }
  } // namespace internal
} // namespace NMM
