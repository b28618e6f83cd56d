#ifndef nmm_source_scene_time_function_h
#define nmm_source_scene_time_function_h

#include <functional>
#include <string>

namespace NMM
{
  namespace internal
  {
    using TimeFunction = std::function<double(double)>;

    /// Time within which prescribed displacements grow to their values in a relaxation whose first
    /// step is @p step [s]. That step is about the lowest period of the solid, which can follow.
    inline double
    ramp_time(const double step)
    {
      constexpr double n_periods = 20.;
      return n_periods * step;
    }

    /**
     * Makes a function of time from @p text, which is "file: name" or an expression of t; the
     * function is null if @p text is empty. @p unit is the unit of t in messages, and
     * @p relative_to_scene gives the path of a file. The function throws NumericalFailure where an
     * expression has no value.
     * @throws InputError naming @p parameter for an expression that cannot be
     * parsed or has no value at 0 or @p end_time, or for a file that cannot be read.
     */
    TimeFunction
    make_time_function(
      const std::string                                     &text,
      const std::string                                     &parameter,
      double                                                 end_time,
      const std::string                                     &unit,
      const std::function<std::string(const std::string &)> &relative_to_scene);
  } // namespace internal
} // namespace NMM

#endif
