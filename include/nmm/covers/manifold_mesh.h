#ifndef nmm_covers_manifold_mesh_h
#define nmm_covers_manifold_mesh_h

#include <nmm/base/types.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/std_cxx20/iota_view.h>

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * One oriented edge of a manifold element's boundary, a straight line or a circular arc; the
   * element lies to its left.
   */
  struct ElementEdge
  {
    /// First point in the reference configuration [m].
    dealii::Point<2> start;
    /// Last point [m].
    dealii::Point<2> end;
    /// Centre of an arc [m].
    dealii::Point<2> center;
    /// Signed radius of an arc [m]: positive if the edge runs counter-clockwise about the centre,
    /// so that the element is on the concave side; negative if it runs clockwise. 0 for a straight
    /// edge. Arcs span at most a half circle.
    double radius = 0.;
    /// Physical curves that lie on this edge, an index for
    /// ManifoldMesh::curve_set(), or invalid_index for a purely mathematical edge.
    unsigned int curve_set = invalid_index;
    /// Manifold element on the other side, or invalid_index outside the solid.
    unsigned int neighbor = invalid_index;
    /// Edge of the mathematical mesh that this edge lies on, or invalid_index.
    unsigned int mesh_edge = invalid_index;

    /// Whether the edge is an arc and not a straight line.
    bool
    is_arc() const
    {
      return radius != 0.;
    }
  };

  /**
   * Angle that an arc of a manifold element sweeps, positive counter-clockwise
   * [rad]; 0 for a straight edge. Such arcs span at most a half circle, so that half
   * the angle is atan2(chord / 2, distance of the centre from the chord). This
   * stays small for a chord of a few ulp, whose ends may have angles in either order.
   */
  double
  swept_angle(const ElementEdge &edge);

  /**
   * The edges of one element, one after the other. For most elements the mesh stores only corners
   * and neighbours; this object then owns the edges, which live as long as it does. Edges of other
   * elements live as long as the mesh. Used like an array.
   */
  class ElementEdges
  {
  public:
    /// No edges.
    ElementEdges() = default;

    /// Refer to @p edges, which must outlive this object.
    explicit ElementEdges(const dealii::ArrayView<const ElementEdge> &edges)
      : kept(edges.data())
      , n(edges.size())
    {
    }

    /// The first edge; edges are contiguous.
    const ElementEdge *
    begin() const
    {
      return kept != nullptr ? kept : n <= max_inside ? inside() : many.data();
    }

    /// Past the last edge.
    const ElementEdge *
    end() const
    {
      return begin() + n;
    }

    /// Number of edges.
    std::size_t
    size() const
    {
      return n;
    }

    /// Edge @p i, from 0 to size() - 1.
    const ElementEdge &
    operator[](const unsigned int i) const
    {
      AssertIndexRange(i, n);
      return begin()[i];
    }

    /// A view of the edges, valid as long as this object.
    operator dealii::ArrayView<const ElementEdge>() const
    {
      return dealii::ArrayView<const ElementEdge>(begin(), n);
    }

  private:
    friend class ManifoldMesh;

    static constexpr unsigned int max_inside = 6;

    /// Storage for @p n_edges edges, which the caller fills.
    ElementEdge *
    make(const unsigned int n_edges)
    {
      n = n_edges;
      if (n > max_inside)
      {
        many.resize(n);
        return many.data();
      }
      auto *const first = reinterpret_cast<ElementEdge *>(storage);
      std::uninitialized_default_construct_n(first, n);
      return std::launder(first);
    }

    const ElementEdge *
    inside() const
    {
      return std::launder(reinterpret_cast<const ElementEdge *>(storage));
    }

    const ElementEdge       *kept = nullptr;
    unsigned int             n    = 0;
    std::vector<ElementEdge> many;
    /// Storage of up to max_inside edges. Only make() constructs edges in it, since most elements
    /// are whole and have none. Copies of this object copy the bytes.
    static_assert(std::is_trivially_copyable<ElementEdge>::value &&
                    std::is_trivially_destructible<ElementEdge>::value,
                  "Edges in the storage are copied and left without calls.");
    alignas(
      ElementEdge) unsigned char storage[max_inside * sizeof(ElementEdge)];
  };


  /// How cells near physical curves are cut. The elements are the same, except for rounding.
  enum class Cutter
  {
    /// Cells near straight edges are divided one by one, others by an arrangement.
    cell_by_cell,
    /// All cells are cut by an arrangement with exact numbers, which takes some thirty times as
    /// long; to check the other one.
    arrangement
  };


  /**
   * The manifold elements: connected pieces of the mathematical mesh's triangles
   * cut by the physical mesh; the units of integration. A mathematical mesh and a physical mesh
   * come in; elements with their edges, regions and links to neighbours go out. The constructor
   * does all the work; the result is immutable.
   *
   * Cutting is exact and is done only in cells that a physical curve comes near; all others are
   * whole elements without stored edges. Cells through which straight edges run, in which they end,
   * or which contain a whole block, are divided one by one with the signs of a few determinants.
   * Cells with arcs, and those with cracks or holes inside, are divided by an arrangement with
   * exact numbers, see Cutter. Elements are numbered so that neighbours have near numbers (reverse
   * Cuthill-McKee on the element graph).
   *
   * If the mathematical mesh has several parts, each region of the physical mesh
   * has its elements in the cells of one part. Each part is cut separately
   * with the curves of its regions only, at a cost in proportion to them. Along
   * curves between regions on different parts the elements of both sides have
   * the same edges, which are divided wherever a mesh edge of either part
   * meets the curve.
   *
   * The constructor must not run in two threads at once: CGAL counts references to exact numbers
   * without locks here, and copies of the physical mesh's arrangement share these numbers.
   *
   * Lifetime: both meshes must outlive this object.
   */
  class ManifoldMesh
  {
  public:
    /**
     * Cut the mathematical mesh. @p region_to_part is the part of the mathematical mesh for each
     * region of the physical mesh; if it is empty, all regions are on part 0. @p cutter changes
     * points by rounding, and the order of edges.
     * @throws InputError if the mathematical mesh does not cover the solid (a
     * part not its regions), or if region_to_part does not fit the meshes.
     */
    ManifoldMesh(const MathematicalMesh          &mathematical_mesh,
                 const PhysicalMesh              &physical_mesh,
                 const std::vector<unsigned int> &region_to_part = {},
                 Cutter cutter = Cutter::cell_by_cell);

    /// The mathematical mesh of the constructor.
    const MathematicalMesh &
    mathematical_mesh() const;

    /// The physical mesh of the constructor.
    const PhysicalMesh &
    physical_mesh() const;

    /// Number of elements.
    unsigned int
    n_elements() const;

    /// Cell of the mathematical mesh that an element is a piece of.
    unsigned int
    cell(unsigned int element) const;

    /// Region of the physical mesh, which gives material and block.
    unsigned int
    region(unsigned int element) const;

    /// Block of the physical mesh that an element belongs to.
    unsigned int
    block(unsigned int element) const;

    /// Whether an element is a whole triangle; physical curves may run along its edges.
    bool
    is_whole(unsigned int element) const;

    /// Area [m^2], never negative.
    double
    area(unsigned int element) const;

    /**
     * Boundary edges with the element on the left: outer loop and loops around
     * holes one after the other, each loop closed. A crack that ends inside
     * appears twice, once in each direction. Empty for a whole element that no
     * physical curve comes near.
     */
    ElementEdges
    edges(unsigned int element) const;

    /// Number of edges(), without making them.
    unsigned int
    n_edges(unsigned int element) const;

    /// Connection of an element to one that is joined to it across a mathematical edge, without a
    /// physical curve between both.
    struct Link
    {
      /// The other element.
      unsigned int neighbor;
      /// Local edge of the element's cell, 0 to 2, see MathematicalMesh::cell_edges().
      unsigned char edge_here;
      /// Local edge of the neighbour's cell, 0 to 2.
      unsigned char edge_there;
    };

    /**
     * The links of an element, in no particular order. Those of a whole element among whole ones
     * follow from the mathematical mesh and are stored in this object; those of other elements
     * live as long as the mesh. Used like an array.
     */
    class Links
    {
    public:
      /// The first link; links are contiguous.
      const Link *
      begin() const
      {
        return stored != nullptr ? stored : made;
      }

      /// Past the last link.
      const Link *
      end() const
      {
        return begin() + n;
      }

      /// Number of links.
      std::size_t
      size() const
      {
        return n;
      }

      /// Link @p i, from 0 to size() - 1.
      const Link &
      operator[](const unsigned int i) const
      {
        AssertIndexRange(i, n);
        return begin()[i];
      }

    private:
      friend class ManifoldMesh;

      const Link  *stored = nullptr;
      unsigned int n      = 0;
      Link         made[3];
    };

    /// Links of an element to all elements that are joined to it.
    Links
    joined(unsigned int element) const;

    /**
     * A point that identifies an element among those of its cell, up to rounding [m]: the mean of
     * its corners, or of the cell's corners for whole elements.
     */
    dealii::Point<2>
    reference_point(unsigned int element) const;

    /// Elements of a cell, which have consecutive numbers.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    cell_elements(unsigned int cell) const;

    /// Pieces of the physical mesh (indices for PhysicalMesh::pieces()) that belong to the number
    /// ElementEdge::curve_set.
    const std::vector<unsigned int> &
    curve_set(unsigned int index) const;

    /// Number of cells that physical curves come near, which are cut exactly.
    unsigned int
    n_cells_cut_exactly() const;

    /// Element that contains @p x [m], one of them if @p x is on an edge, or invalid_index.
    unsigned int
    find_element(const dealii::Point<2> &x) const;

  private:
    struct Data;
    std::unique_ptr<Data> data;

  public:
    ~ManifoldMesh();
    /// Take over the elements of another mesh. Objects that refer to that one, such as a
    /// CoverSystem, must not be used any more.
    ManifoldMesh(ManifoldMesh &&) noexcept;
  };
} // namespace NMM

#endif
