#ifndef nmm_geometry_dxf_h
#define nmm_geometry_dxf_h

#include <nmm/geometry/curve.h>

#include <string>
#include <vector>

namespace NMM
{
  /// Whether this library was built with dxflib.
  bool
  can_read_dxf();

  /**
   * Read joints from a DXF drawing: LINE, LWPOLYLINE and POLYLINE (with bulges, which become
   * arcs), ARC and CIRCLE. Each joint has the name of its layer, and z is ignored. Texts, points,
   * dimensions and definitions of DXF blocks are skipped. If @p layers is not empty, only these
   * layers are read.
   *
   * @throws InputError naming the file and the entity with its line if the file cannot be read,
   * ends early or has coordinates that are not numbers; if a layer has no curves; for splines,
   * ellipses, inserted blocks and rays, which would be missing from the joints; for entities in
   * another plane; or if can_read_dxf() is false.
   */
  std::vector<Curve>
  read_dxf(const std::string              &file_name,
           const std::vector<std::string> &layers = {});
} // namespace NMM

#endif
