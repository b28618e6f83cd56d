#ifndef nmm_source_scene_shapes_h
#define nmm_source_scene_shapes_h

#include <nmm/geometry/geometry.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /**
     * The one curve that the entries `Shape` or `File` of the section @p section give:
     * @p shape as in a geometry file, or, if @p file is not empty, that geometry file.
     * Of a shape, polygons and circles are boundaries, and all else is an
     * interface. @throws InputError unless it is one curve.
     */
    Curve
    read_shape(const std::string &shape,
               const std::string &file,
               const std::string &section,
               const std::string &scene_file);

    /// The body on the left: as drawn, but closed boundaries are rigid inside and
    /// holes outside.
    std::vector<CurvePiece>
    oriented_pieces(const Curve &curve);
  } // namespace internal
} // namespace NMM

#endif
