#include <cmath>
#include <solution/line_search.h>

namespace NMM
{
  namespace internal
  {
    void
    LineSearch::begin(const Mode   new_mode,
                      const double slope,
                      const double norm,
                      const double least)
    {
      *this       = LineSearch();
      mode        = new_mode;
      first_slope = lower_slope = slope;
      first_norm                = norm;
      min_step_length           = least;
      done                      = false;
    }


    void
    LineSearch::judge(const bool   is_admissible,
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
    LineSearch::halve()
    {
      eta *= 0.5;
      ++cuts;
    }


    void
    LineSearch::judge_slope(const bool is_admissible, const double slope)
    {
      // Largest |slope| that ends the search, relative to the first one: as long as the slope has
      // the same sign, and once a change of its sign has been bracketed.
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
          // regula falsi with the Illinois modification
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
      done = eta <= min_step_length;
      if (!done)
        halve();
    }


    void
    LineSearch::judge_norm(const bool is_admissible, const double norm)
    {
      constexpr double least_step_length = 1. / 16.;

      done =
        is_last || (is_admissible && norm <= (1. - 0.25 * eta) * first_norm);
      if (done)
        return;
      if (is_admissible && norm < best)
      {
        best             = norm;
        best_step_length = eta;
      }
      halve();
      if (eta < (best == unknown ? min_step_length : least_step_length))
      {
        eta     = best_step_length;
        is_last = true;
      }
    }
  } // namespace internal
} // namespace NMM
