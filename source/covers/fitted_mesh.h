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
    /// Size and shape of a region, for making a mesh of it.
    struct RegionShape
    {
      /// Curves around the region, without those that end inside.
      std::vector<ElementEdge> outline;
      /// Corners of a convex polygon around the region, counter-clockwise [m]: the convex hull with
      /// tangents in place of arcs.
      std::vector<dealii::Point<2>> hull;
      /// Area of the convex hull with chords in place of arcs [m^2].
      double inner_hull_area;
      /// Minimum-area bounding rectangle: corner [m], directions (orthonormal, right-handed), and
      /// lengths of the sides, the longer one first [m]. Of several with equal area, the choice
      /// does not depend on rounding.
      dealii::Point<2>                    origin;
      std::array<dealii::Tensor<1, 2>, 2> axes;
      std::array<double, 2>               sides;
      /// Largest coordinate of the region [m].
      double scale;
      /// Upper bound of the rounding of a point [m].
      double rounding;

      RegionShape(const PhysicalEdges &edges, unsigned int region);

    private:
      /// Sets origin, axes and sides from hull and rounding.
      void
      choose_rectangle();
    };

    /**
     * The smallest triangle around the region with sides in 24 directions of its frame, made larger
     * by 8 %. For a thin region only right-angled triangles are used, with the right angle at the
     * first corner, because only their determinants have no cancellation.
     */
    MeshPart
    make_single_triangle(const RegionShape &shape);

    /**
     * The frame of the region, made larger by about 8 % and divided into n[0] x n[1] rectangles.
     * Each one is halved into two triangles whose first corner is the right angle. Rectangles that
     * are away from the region are left out.
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
