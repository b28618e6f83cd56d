#ifndef nmm_source_geometry_outline_h
#define nmm_source_geometry_outline_h

#include <nmm/geometry/curve.h>

namespace NMM
{
  namespace internal
  {
    /// Whether @p point is inside of the closed curve. Computed in floating point with 64 chords
    /// for each arc, so that the result is not reliable near the curve.
    bool
    contains(const Curve &curve, const dealii::Point<2> &point);
  } // namespace internal
} // namespace NMM

#endif
