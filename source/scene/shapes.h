#ifndef nmm_source_scene_shapes_h
#define nmm_source_scene_shapes_h

#include <nmm/geometry/geometry.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /**
     * The curve that the entries `Shape` or `File` of the section @p section describe:
     * the record @p shape of a geometry file, or, if @p file is not empty, the record in that file.
     * In a shape, polygons and circles become boundaries, and all other curves become
     * interfaces. @throws InputError unless there is exactly one curve.
     */
    Curve
    read_shape(const std::string &shape,
               const std::string &file,
               const std::string &section,
               const std::string &scene_file);

    /// The pieces of a curve with the rigid body on their left. Open curves keep their direction;
    /// closed boundaries are rigid inside, and holes are rigid outside.
    std::vector<CurvePiece>
    oriented_pieces(const Curve &curve);
  } // namespace internal
} // namespace NMM

#endif
