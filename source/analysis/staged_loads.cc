#include <algorithm>
#include <analysis/staged_loads.h>
#include <mechanics/load_amplitudes.h>

namespace NMM
{
  namespace internal
  {
    LoadAmplitudes
    StagedLoads::at(const double load_factor) const
    {
      if (!stage)
        return proportional.amplitudes(load_factor);
      const double s =
        std::clamp((load_factor - stage->begin) / (stage->end - stage->begin),
                   0.,
                   1.);
      const auto mean = [s](const double a, const double b) {
        return a + s * (b - a);
      };
      LoadAmplitudes        result = stage->at_end;
      const LoadAmplitudes &begin  = stage->at_begin;
      for (const auto list : {&LoadAmplitudes::boundary_conditions,
                              &LoadAmplitudes::point_forces,
                              &LoadAmplitudes::fixed_points})
        for (std::size_t i = 0; i < (result.*list).size(); ++i)
          (result.*list)[i] = mean((begin.*list)[i], (result.*list)[i]);
      result.gravity    = mean(begin.gravity, result.gravity);
      result.body_force = mean(begin.body_force, result.body_force);
      return result;
    }


    void
    StagedLoads::begin_stage(const double                         begin,
                             const double                         end,
                             const std::optional<LoadAmplitudes> &at_end)
    {
      const LoadAmplitudes at_begin = completed(problem, at(begin));
      stage                         = {begin,
                                       end,
                                       at_begin,
               at_end ? completed(problem, *at_end) : at_begin};
    }
  } // namespace internal
} // namespace NMM
