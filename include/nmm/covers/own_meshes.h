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
  /// Choice of the mathematical mesh for a region.
  struct RegionMesh
  {
    /// The main mesh, or a mesh of the region's own.
    enum class Kind
    {
      /// The main mesh, unless the region needs a mesh of its own.
      where_needed,
      /// The main mesh in any case.
      main_mesh,
      /// A mesh of its own, with n_across cells along the longer side of the region's bounding
      /// rectangle.
      own,
      /// The main mesh if it resolves the region and its cells are no larger than those of n_across
      /// cells along the longer side; else a mesh of its own.
      automatic
    };
    /// Which mesh the region is on.
    Kind kind = Kind::where_needed;
    /// Number of cells along the longer side of the region's bounding rectangle. 1 stands for a
    /// single triangle, if the region fills it well enough; 0, for Kind::own only, for cells of
    /// the main mesh's size.
    unsigned int n_across = 0;
  };


  /// Criteria by which regions get mathematical meshes of their own, and quality of these.
  struct OwnMeshParameters
  {
    /// A region needs a mesh of its own if none of its elements has this
    /// element_support() [-].
    double threshold = default_aggregation_threshold;
    /// Fraction of its cell's area [-] that an element of a mesh of its own should have.
    double filling = 0.25;
    /// Whether every region gets a mesh of its own, even if it does not need one.
    bool every_region = false;
    /// Choice for each region of the physical mesh; if it is empty, every_region decides for all.
    std::vector<RegionMesh> regions;
    /// Largest number of times that the cells of a region's mesh are halved until one is
    /// filled well.
    unsigned int n_halvings = 4;
    /// Largest number of cells for a region that needs a mesh of its own.
    unsigned int n_cells_at_most = 20000;
    /// Memory that the whole computation needs for a cell [bytes], at least that of the mesh
    /// itself. Meshes of regions with a given number of cells are compared with the available
    /// memory before they are made.
    double memory_per_cell = 2000.;
  };


  /**
   * A mathematical mesh whose part 0 is the main mesh, with a further part for each
   * region that has a mesh of its own, and the manifold mesh on it.
   */
  struct OwnMeshes
  {
    /// The mathematical mesh of all parts.
    std::unique_ptr<MathematicalMesh> mathematical_mesh;
    /// The manifold mesh, which refers to mathematical_mesh.
    std::unique_ptr<ManifoldMesh> manifold_mesh;
    /// Part of the mathematical mesh for each region; empty if all regions are on part 0.
    std::vector<unsigned int> region_to_part;
    /// Sentences for the user: which regions got which mesh.
    std::vector<std::string> notices;
  };


  /**
   * Make meshes for regions that are smaller or thinner than the cells of the main mesh. All
   * elements of such a region are slivers: a function that is moderate in the region can be huge
   * on the cell, whatever the covers are, and aggregation finds no root. The region gets a mesh
   * that fits its size and shape, in which its elements fill their cells:
   *
   * - the region's frame is its minimum-area bounding rectangle (rotating
   *   calipers over the convex hull), of sides @f$L_1\ge L_2@f$, made some 8 %
   *   larger so that mesh lines do not coincide with the region's straight
   *   sides;
   * - if @f$L_1\le h@f$, the local cell size of the main mesh, it is a single
   *   triangle: the smallest one circumscribed about the region with sides in
   *   24 directions of the frame, provided the region fills it to the
   *   threshold;
   * - else it has @f$\lceil L_1/h\rceil\times\lceil L_2/h\rceil@f$ rectangles of the
   *   frame, each halved into two right-angled triangles. A thin layer gets one row of
   *   cells that are as thin as the layer; they are well shaped in coordinates
   *   stretched across the layer, and the method is invariant under affine maps of cells;
   * - if no triangle is filled well (thin layers that are bent), all cells are
   *   halved in both directions up to n_halvings times. The best mesh found is used,
   *   or the main mesh if that is no worse.
   *
   * RegionMesh can choose otherwise for each region; with n cells across, the cell
   * size h is @f$L_1/n@f$.
   *
   * The main mesh is cut first. If no region needs a mesh of its own, the main mesh is returned
   * with that manifold mesh, without further cost. Otherwise all parts are cut exactly, each at a
   * cost in proportion to its regions.
   * @throws InputError if the main mesh does not cover the solid, if the choices
   * do not fit the regions, or if cells of own meshes would need more memory than there is.
   */
  OwnMeshes
  make_own_meshes(std::unique_ptr<MathematicalMesh> main_mesh,
                  const PhysicalMesh               &physical_mesh,
                  const OwnMeshParameters          &parameters = {});

  /// Region that contains @p x [m], or invalid_index outside of the solid; computed in floating
  /// point, so that it is not reliable within rounding of a curve.
  unsigned int
  find_region(const PhysicalMesh &physical_mesh, const dealii::Point<2> &x);

  /// Longer side of the minimum-area bounding rectangle of a region, the largest over all regions
  /// [m].
  double
  largest_extent(const PhysicalMesh &physical_mesh);
} // namespace NMM

#endif
