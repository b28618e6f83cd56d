#ifndef nmm_source_geometry_outline_h
#define nmm_source_geometry_outline_h

#include <nmm/geometry/curve.h>

namespace NMM
{
  namespace internal
  {
    /// Is @p point inside of the closed curve? In floating-point arithmetic, arcs
    /// as 64 chords a piece: for questions that are not about its border.
    bool
    contains(const Curve &curve, const dealii::Point<2> &point);
  } // namespace internal
} // namespace NMM

#endif
