#ifndef nmm_source_geometry_curve_h
#define nmm_source_geometry_curve_h

#include <nmm/base/exceptions.h>
#include <nmm/geometry/curve.h>

#include <sstream>
#include <string>

namespace NMM
{
  namespace internal
  {
    /// A curve in messages: "joint 'j1'".
    inline std::string
    describe(const Curve &curve)
    {
      return to_string(curve.role) + " '" + curve.name + "'";
    }

    /// A place in messages: coordinates and, if known, file and line, as in "(1, 2) (slope.wkt:3)".
    inline std::string
    describe_place(const Curve &curve, const dealii::Point<2> &point)
    {
      return to_string(point) +
             (curve.source.empty() ? "" : " (" + curve.source + ")");
    }

    /// A length with its unit, for messages.
    inline std::string
    describe_length(const double length)
    {
      std::ostringstream out;
      out.precision(6);
      out << length << " m";
      return out.str();
    }
  } // namespace internal
} // namespace NMM

#endif
