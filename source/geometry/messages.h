#ifndef nmm_source_geometry_messages_h
#define nmm_source_geometry_messages_h

#include <nmm/base/exceptions.h>
#include <nmm/geometry/curve.h>

#include <sstream>
#include <string>

namespace NMM
{
  namespace internal
  {
    /// "joint 'j1'"
    inline std::string
    describe(const Curve &curve)
    {
      return to_string(curve.role) + " '" + curve.name + "'";
    }

    /// "(1, 2) (slope.wkt:3)": coordinates and, if known, file and line.
    inline std::string
    describe_place(const Curve &curve, const dealii::Point<2> &point)
    {
      return to_string(point) +
             (curve.source.empty() ? "" : " (" + curve.source + ")");
    }

    /// A length with its unit, for people.
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
