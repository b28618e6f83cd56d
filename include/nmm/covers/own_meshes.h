#ifndef nmm_covers_own_meshes_h
#define nmm_covers_own_meshes_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/mathematical_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// Which mathematical mesh a region is on.
  struct RegionMesh
  {
    enum class Kind
    {
      /// The main mesh, unless the region needs one of its own.
      where_needed,
      /// The main mesh, whatever comes of it.
      main_mesh,
      /// One of its own, with n_across cells along the longer side of its
      /// rectangle.
      own,
      /// The main mesh where that holds the region and has cells as small as that,
      /// or smaller; else one of its own.
      automatic
    };
    Kind kind = Kind::where_needed;
    /// 1: a single triangle, where that can be filled. 0, of `own` only: cells of the
    /// main mesh's size.
    unsigned int n_across = 0;
  };


  /// When a region gets a mathematical mesh of its own, and how good a one.
  struct OwnMeshParameters
  {
    /// A region needs a mesh of its own if none of its elements has this
    /// element_support() [-].
    double threshold = default_aggregation_threshold;
    /// The share of its cell's area [-] that an element of a mesh of its own
    /// should have.
    double filling = 0.25;
    /// Give every region a mesh of its own, whether it needs it or not.
    bool every_region = false;
    /// For each region of the physical mesh; empty: all the same, by every_region.
    std::vector<RegionMesh> regions;
    /// How often the cells of a region's mesh are halved, at most, until one is
    /// filled well.
    unsigned int n_halvings = 4;
    /// No more cells than this for a region that needs a mesh of its own.
    unsigned int n_cells_at_most = 20000;
    /// What a cell needs in the end [bytes]: meshes of regions that say how many cells
    /// they want are compared with the memory there is before they are made. At least
    /// what the mesh itself takes.
    double memory_per_cell = 2000.;
  };


  /**
   * A mathematical mesh whose part 0 is the main mesh, with a part for each
   * region that the main mesh holds badly, and the manifold mesh on it.
   */
  struct OwnMeshes
  {
    std::unique_ptr<MathematicalMesh> mathematical_mesh;
    /// Refers to mathematical_mesh.
    std::unique_ptr<ManifoldMesh> manifold_mesh;
    /// Part of the mathematical mesh for each region; empty: all on part 0.
    std::vector<unsigned int> region_to_part;
    /// Which regions got what; sentences for people.
    std::vector<std::string> notices;
  };


  /**
   * A region smaller or thinner than the cells of the mathematical mesh has only
   * slivers for elements: whatever the covers, a function of such a region that
   * is moderate in it can be huge on the cell, and aggregation finds no root.
   * Such a region gets a mesh of its own size and shape, in which its elements
   * are ordinary ones:
   *
   * - the region's frame is its minimum-area bounding rectangle (rotating
   *   calipers over the convex hull), of sides @f$L_1\ge L_2@f$, made some 8 %
   *   larger so that mesh lines do not coincide with the region's straight
   *   sides;
   * - if @f$L_1\le h@f$, the local cell size of the main mesh, a single
   *   triangle: the smallest of those circumscribed to the region with sides in
   *   24 directions of the frame, provided the region fills it to the
   *   threshold;
   * - else @f$\lceil L_1/h\rceil\times\lceil L_2/h\rceil@f$ rectangles of the
   *   frame, each halved into two right-angled triangles. One row across a thin
   *   layer: cells are as thin as the layer, and well shaped in coordinates
   *   stretched across it, in which affine cells are the same as any other;
   * - if no triangle is filled well (thin layers that are bent), all cells are
   *   halved in both directions, a few times; the best mesh found is kept,
   *   and if it is no better than the main mesh, that.
   *
   * RegionMesh chooses otherwise, region by region; with n cells across the cell
   * size h is @f$L_1/n@f$.
   *
   * The main mesh is cut first, to find out; if no region needs anything, it is
   * returned as it is with that manifold mesh, at no further cost. Otherwise all
   * parts are cut, exactly, each at a cost in proportion to its regions.
   * A distributed main mesh (make_distributed_mesh()) can have no others beside it.
   * @throws InputError if the main mesh does not cover the solid, if the choices
   * do not fit the regions, if cells of own meshes would need more memory than there
   * is, or if a region beside a distributed mesh wants one of its own.
   */
  OwnMeshes
  make_own_meshes(std::unique_ptr<MathematicalMesh> main_mesh,
                  const PhysicalMesh               &physical_mesh,
                  const OwnMeshParameters          &parameters = {});

  /// Region that contains @p x [m], in floating point; invalid_index outside of
  /// the solid.
  unsigned int
  find_region(const PhysicalMesh &physical_mesh, const dealii::Point<2> &x);

  /// Longer side of the smallest rectangle around the largest region [m].
  double
  largest_extent(const PhysicalMesh &physical_mesh);
} // namespace NMM

#endif
