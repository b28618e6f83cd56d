#ifndef nmm_covers_triangulate_h
#define nmm_covers_triangulate_h

#include <nmm/covers/manifold_mesh.h>

#include <array>
#include <vector>

namespace NMM
{
  /**
   * Corners 0-2, counter-clockwise, then the mid-side points 3-5 of the edges
   * 01, 12, 20 [m], as in VTK's quadratic triangle.
   */
  using QuadraticTriangle = std::array<dealii::Point<2>, 6>;

  /**
   * A manifold element as quadratic triangles, for pictures and output: arcs
   * keep their curvature by mid-side points that lie on them (an arc is split
   * so that a parabola is within 1e-4 of its radius). Not meant for integration.
   */
  std::vector<QuadraticTriangle>
  triangulate(const ManifoldMesh &mesh, unsigned int element);
} // namespace NMM

#endif
