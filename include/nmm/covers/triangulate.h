#ifndef nmm_covers_triangulate_h
#define nmm_covers_triangulate_h

#include <nmm/covers/manifold_mesh.h>

#include <array>
#include <vector>

namespace NMM
{
  /**
   * A triangle with curved sides: corners 0-2, counter-clockwise, then the mid-side points 3-5 of
   * the edges 01, 12, 20 [m], as in VTK's quadratic triangle.
   */
  using QuadraticTriangle = std::array<dealii::Point<2>, 6>;

  /**
   * Divide a manifold element into quadratic triangles, for pictures and output. Mid-side points
   * lie on arcs, and arcs are split so that a parabola deviates by less than 1e-4 of the radius.
   * Not accurate enough for integration.
   */
  std::vector<QuadraticTriangle>
  triangulate(const ManifoldMesh &mesh, unsigned int element);
} // namespace NMM

#endif
