#ifndef nmm_source_scene_time_function_h
#define nmm_source_scene_time_function_h

#include <functional>
#include <string>

namespace NMM
{
  namespace internal
  {
    using TimeFunction = std::function<double(double)>;

    /**
     * "file: name" or an expression of t as a function, null if @p text is empty.
     * @p unit of t, for messages; @p relative_to_scene: path of a file.
     * @throws InputError naming @p parameter for an expression that cannot be
     * parsed or has no value at 0 or @p end_time, or a file that cannot be read;
     * the function throws NumericalFailure where an expression has no value.
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
