#ifndef nmm_source_base_angle_minus_sine_h
#define nmm_source_base_angle_minus_sine_h

#include <cmath>

namespace NMM
{
  namespace internal
  {
    /// @p angle - sin(@p angle) without cancellation.
    inline double
    angle_minus_sine(const double angle)
    {
      if (std::abs(angle) > 1.)
        return angle - std::sin(angle);
      const double square = angle * angle;
      double       term   = angle * square / 6.;
      double       sum    = 0.;
      for (unsigned int k = 4; k < 24; k += 2)
      {
        sum += term;
        term *= -square / (k * (k + 1.));
      }
      return sum;
    }
  } // namespace internal
} // namespace NMM

#endif
