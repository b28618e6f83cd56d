#ifndef nmm_geometry_dxf_h
#define nmm_geometry_dxf_h

#include <nmm/geometry/curve.h>

#include <string>
#include <vector>

namespace NMM
{
  /// What read_dxf() finds in a drawing.
  struct Drawing
  {
    /// The curves, with the role of a joint and the name of their layer.
    std::vector<Curve> curves;
    /// The unit of its coordinates, as in "mm" ($INSUNITS of its header); empty if it says none.
    std::string unit;
    /// A sentence that counts the entities that are left out, by their kinds; empty if there are
    /// none.
    std::string notice;
  };

  /**
   * Read curves from a DXF drawing in ASCII, of AutoCAD's release 12 or later: LINE, LWPOLYLINE and
   * POLYLINE (with bulges, which become arcs), ARC and CIRCLE of its model space. Each curve has
   * the name of its layer, in UTF-8 and as the drawing first spells it. z is ignored. Entities
   * whose plane is seen from below (extrusion 0, 0, -1) are turned into the plane x, y. An arc of
   * 360 degrees is a circle.
   *
   * Left out and counted are entities in paper space, on layers that are frozen or switched off,
   * invisible ones, those without a length, meshes, and all other kinds. Points of a spline's frame
   * and definitions of DXF blocks are left out silently, since they are not drawn.
   *
   * If @p layers is not empty, only these layers are read. Upper and lower case of their names are
   * not distinguished, as in CAD.
   *
   * @throws InputError naming the file and the entity with its line if the file cannot be read or
   * ends early; if a coordinate is missing, no number, or not from 1e-75 to 1e75 in size; if a
   * layer has no curves (the message lists those that have); for splines, ellipses, inserted blocks
   * and rays on layers that are read, which would be missing from the joints; and for entities in
   * another plane.
   *
   * Reference: Autodesk, DXF Reference (group codes; arbitrary axis algorithm).
   */
  Drawing
  read_dxf(const std::string              &file_name,
           const std::vector<std::string> &layers = {});
} // namespace NMM

#endif
