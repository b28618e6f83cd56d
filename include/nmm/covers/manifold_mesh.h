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
  namespace internal
  {
    // See source/covers/element_exchange.h.
    class ElementExchange;
  } // namespace internal

  /**
   * One oriented edge of a manifold element's boundary; the element lies to its
   * left. Straight, or an arc about a centre.
   */
  struct ElementEdge
  {
    dealii::Point<2> start, end;
    /// Arcs only: centre [m].
    dealii::Point<2> center;
    /// 0: straight. Positive: arc of this radius run through counter-clockwise
    /// about the centre (the element is on the concave side); negative: clockwise [m].
    /// Arcs span at most a half circle.
    double radius = 0.;
    /// Physical curves that lie on this edge, an index for
    /// ManifoldMesh::curve_set(), or invalid_index for a purely mathematical edge.
    unsigned int curve_set = invalid_index;
    /// Manifold element on the other side, or invalid_index outside the solid.
    unsigned int neighbor = invalid_index;
    /// Edge of the mathematical mesh that this edge lies on, or invalid_index.
    unsigned int mesh_edge = invalid_index;

    bool
    is_arc() const
    {
      return radius != 0.;
    }
  };

  /**
   * The edges of one element, one after the other. Of most elements the mesh keeps the
   * corners and what lies beyond; their edges are made when they are asked for, and live as
   * long as this object, others as long as the mesh.
   */
  class ElementEdges
  {
  public:
    ElementEdges() = default;

    /// Edges that are stored elsewhere, and must outlive this object.
    explicit ElementEdges(const dealii::ArrayView<const ElementEdge> &edges)
      : kept(edges.data())
      , n(edges.size())
    {
    }

    const ElementEdge *
    begin() const
    {
      return kept != nullptr ? kept : n <= max_inside ? inside() : many.data();
    }

    const ElementEdge *
    end() const
    {
      return begin() + n;
    }

    std::size_t
    size() const
    {
      return n;
    }

    const ElementEdge &
    operator[](const unsigned int i) const
    {
      AssertIndexRange(i, n);
      return begin()[i];
    }

    operator dealii::ArrayView<const ElementEdge>() const
    {
      return dealii::ArrayView<const ElementEdge>(begin(), n);
    }

  private:
    friend class ManifoldMesh;

    static constexpr unsigned int max_inside = 6;

    /// Room for @p n_edges edges, to be filled.
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
    /// Edges are constructed in here by make() only: most elements are whole and have none.
    /// Copies are copies of the bytes.
    static_assert(std::is_trivially_copyable<ElementEdge>::value &&
                    std::is_trivially_destructible<ElementEdge>::value,
                  "Edges in the storage are copied and left without calls.");
    alignas(
      ElementEdge) unsigned char storage[max_inside * sizeof(ElementEdge)];
  };


  /**
   * The manifold elements: connected pieces of the mathematical mesh's triangles
   * cut by the physical mesh; the units of integration. Immutable.
   *
   * Cutting is exact and touches only cells that a physical curve comes near;
   * all others are whole elements that keep no edges. Cells that straight edges run
   * through or end in are divided by themselves, which takes the signs of a few
   * determinants; cells with arcs, with cracks or blocks inside, and all cells of a
   * mesh of several parts by an arrangement with exact numbers. Elements are numbered so
   * that neighbours have near numbers (reverse Cuthill-McKee on the element
   * graph).
   *
   * If the mathematical mesh has several parts, each region of the physical mesh
   * has its elements in the cells of one part, and each part is cut by itself
   * with the curves of its regions only, at a cost in proportion to them. Along
   * curves between regions on different parts the elements of both sides have
   * the same edges: those are divided wherever a mesh edge of either part
   * meets the curve.
   *
   * If the mathematical mesh is distributed, each rank cuts the cells it holds, with
   * all curves, and numbers its elements by itself: those of ghost cells of lower
   * ranks, its own, those of higher ranks. Edges and links of elements at the rim of the
   * ghost cells may lack their neighbours.
   *
   * Not for two threads at once: CGAL's exact numbers are counted without locks
   * here, and the copy of the physical mesh's arrangement shares them.
   *
   * Lifetime: both meshes must outlive this object.
   */
  class ManifoldMesh
  {
  public:
    /**
     * @p region_to_part: part of the mathematical mesh for each region of the
     * physical mesh; empty: all on part 0.
     * @throws InputError if the mathematical mesh does not cover the solid (a
     * part not its regions), or if region_to_part does not fit the meshes.
     */
    ManifoldMesh(const MathematicalMesh          &mathematical_mesh,
                 const PhysicalMesh              &physical_mesh,
                 const std::vector<unsigned int> &region_to_part = {});

    const MathematicalMesh &
    mathematical_mesh() const;

    const PhysicalMesh &
    physical_mesh() const;

    unsigned int
    n_elements() const;

    unsigned int
    cell(unsigned int element) const;

    /// Region of the physical mesh, hence material and block.
    unsigned int
    region(unsigned int element) const;

    unsigned int
    block(unsigned int element) const;

    /// Whole triangle (it may still have physical curves along its edges).
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

    /// How many those are.
    unsigned int
    n_edges(unsigned int element) const;

    /**
     * Elements joined to @p element across mathematical edges that no physical
     * curve blocks, as (neighbour, local edge of the element's cell, local edge
     * of the neighbour's cell).
     */
    struct Link
    {
      unsigned int  neighbor;
      unsigned char edge_here, edge_there;
    };

    /**
     * The links of an element, in no particular order. Those of a whole element among
     * whole ones follow from the mathematical mesh, and are made when they are asked for.
     */
    class Links
    {
    public:
      const Link *
      begin() const
      {
        return stored != nullptr ? stored : made;
      }

      const Link *
      end() const
      {
        return begin() + n;
      }

      std::size_t
      size() const
      {
        return n;
      }

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

    Links
    joined(unsigned int element) const;

    /// Elements of cells this rank owns, first and past-the-end; all if the mesh
    /// is not distributed.
    std::pair<unsigned int, unsigned int>
    owned_elements() const;

    /**
     * A point that tells the elements of a cell from each other to rounding,
     * whichever way they were found: the mean of the corners, of the cell's for
     * whole elements [m].
     */
    dealii::Point<2>
    reference_point(unsigned int element) const;

    /// For modules of this library: null if the mesh is not distributed.
    const internal::ElementExchange *
    exchange() const;

    /// Elements of a cell, which have consecutive numbers.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    cell_elements(unsigned int cell) const;

    /// Pieces of the physical mesh (PhysicalMesh::pieces()) on an edge.
    const std::vector<unsigned int> &
    curve_set(unsigned int index) const;

    /// Cells that physical curves come near, which are cut exactly.
    unsigned int
    n_cells_cut_exactly() const;

    /// Element containing @p x [m] (on an edge: one of them), or invalid_index.
    unsigned int
    find_element(const dealii::Point<2> &x) const;

    /// The same of the owned elements only.
    unsigned int
    find_owned_element(const dealii::Point<2> &x) const;

  private:
    unsigned int
    find_element(const dealii::Point<2>                      &x,
                 const std::pair<unsigned int, unsigned int> &elements) const;

    struct Data;
    std::unique_ptr<Data> data;

  public:
    ~ManifoldMesh();
    ManifoldMesh(ManifoldMesh &&) noexcept;
  };
} // namespace NMM

#endif
