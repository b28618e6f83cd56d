#ifndef nmm_source_covers_fitted_mesh_h
#define nmm_source_covers_fitted_mesh_h

// Private: meshes fitted to the size and shape of a region.

#include <nmm/covers/mathematical_mesh.h>

#include "physical_edges.h"
#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Size and shape of a region, as far as a mesh for it needs them.
    struct RegionShape
    {
      /// Curves around it, without those that end inside.
      std::vector<ElementEdge> outline;
      /// Corners of a convex polygon around it, counter-clockwise [m]: the
      /// convex hull, of tangents instead of arcs.
      std::vector<dealii::Point<2>> hull;
      /// Area of the convex hull, of chords instead of arcs [m^2].
      double inner_hull_area;
      /// Corner and directions of its minimum-area bounding rectangle
      /// (orthonormal, right-handed), and sides, the longer one first [m].
      dealii::Point<2>                    origin;
      std::array<dealii::Tensor<1, 2>, 2> axes;
      std::array<double, 2>               sides;
      /// Largest coordinate of the region [m].
      double scale;
      /// What rounding may move a point by, generously [m].
      double rounding;

      RegionShape(const PhysicalEdges &edges, unsigned int region);
    };

    /**
     * The smallest of the triangles around the region with sides in 24
     * directions of its frame, made larger by 8 %. Of a thin region only
     * right-angled ones, first corner there: only such have a determinant
     * without cancellation.
     */
    MeshPart
    make_single_triangle(const RegionShape &shape);

    /**
     * Frame of the region made larger by some 8 %, divided into n[0] x n[1]
     * rectangles, each halved into two triangles that begin with their right
     * angle. Rectangles away from the region are left out.
     */
    MeshPart
    make_rectangles(const RegionShape                 &shape,
                    const std::array<unsigned int, 2> &n);

    /// Total area of the triangles [m^2].
    double
    mesh_area(const MeshPart &mesh);
  } // namespace internal
} // namespace NMM

#endif
