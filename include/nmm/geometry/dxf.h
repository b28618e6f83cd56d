#ifndef nmm_geometry_dxf_h
#define nmm_geometry_dxf_h

#include <nmm/geometry/curve.h>

#include <string>
#include <vector>

namespace NMM
{
  /// Was this library built with dxflib?
  bool
  can_read_dxf();

  /**
   * Joints of a DXF drawing: LINE, LWPOLYLINE and POLYLINE (with bulges, which become
   * arcs), ARC and CIRCLE, each called after its layer; z is left out. Texts, points and
   * dimensions are skipped, and so is what is defined in blocks. With
   * @p layers only these are read.
   *
   * @throws InputError naming the file and the entity with its line for a file that
   * cannot be read, ends early or has coordinates that are no numbers; a layer that
   * has nothing on it; splines, ellipses, inserted blocks and rays, which are curves
   * that would be missing; what is drawn in another plane; or if can_read_dxf() is
   * false.
   */
  std::vector<Curve>
  read_dxf(const std::string              &file_name,
           const std::vector<std::string> &layers = {});
} // namespace NMM

#endif
