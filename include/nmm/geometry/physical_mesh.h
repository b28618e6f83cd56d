#ifndef nmm_geometry_physical_mesh_h
#define nmm_geometry_physical_mesh_h

#include <nmm/base/types.h>
#include <nmm/geometry/geometry.h>
#include <nmm/geometry/physical_region.h>

#include <deal.II/base/bounding_box.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    // The CGAL arrangement of the physical curves; see
    // source/geometry/arrangement.h.
    struct PhysicalArrangement;
  } // namespace internal

  /**
   * The physical mesh: the exact arrangement of boundaries, holes, joints and
   * interfaces, and the regions and blocks that it forms. A Geometry comes in; curves, pieces,
   * regions, materials and notices go out. The constructor does all the work; the result is
   * immutable.
   *
   * A *region* is a bounded, connected piece of the solid that no curve
   * crosses; it has one material. A *block* is a maximal set of regions
   * connected across material interfaces, so that it moves as one piece. A joint that
   * ends inside a block (a crack) does not divide it.
   *
   * The topology is exact (CGAL Arrangement_2 over circles and segments with
   * exact constructions): a joint through a vertex, along another or tangent to
   * a circle is an ordinary case. Coordinates are doubles, however, and exact lines may enclose
   * faces that are smaller than rounding: three lines through one
   * point, with rounded digits, form a triangle with all corners in that point. A face is
   * negligible if its area, from its rounded vertices, is no more than their rounding,
   * @f$ 16\,\varepsilon \sum_i l_i \max(M, R_i) @f$ with lengths l of its edges, radii
   * R of arcs and the largest coordinate M. Such a face is not a region but a part of the region
   * with which it shares the longest edge, as if the lines met in the point, and the
   * edge between them is removed. A face without such a neighbour is removed from the
   * solid. Before that, segments that run along each other within rounding, so that one of them may
   * end inside a block, are made to coincide. Notices report both. With
   * Geometry::unite_doubled_joints() joints coincide within a millionth of their length, and blocks
   * that are thinner than a millionth of their length count as small.
   *
   * Blocks smaller than Geometry::merging_area() are then merged, the smallest one first: each
   * becomes a part of the block with which it shares the longest boundary of joints, and has the
   * material there. The joints between both are removed; boundaries, holes and interfaces never
   * are. A block without such a neighbour stays as it is, and a notice names it.
   */
  class PhysicalMesh
  {
  public:
    /// See PhysicalRegion.
    using Region = PhysicalRegion;
    /// See NMM::DanglingEnds.
    using DanglingEnds = NMM::DanglingEnds;

    /**
     * Check the geometry and build the mesh. @throws InputError with the curve's name, coordinates
     * and remedy for: an open or self-intersecting boundary or hole, a hole outside
     * its domain, overlapping domains, a joint or interface entirely outside, a
     * joint confined to a domain or region that does not exist, a material point outside, or no
     * boundary at all.
     */
    explicit PhysicalMesh(Geometry geometry);

    ~PhysicalMesh();
    /// Take over the contents of another mesh. Objects that refer to that one, such as a
    /// ManifoldMesh, must not be used any more.
    PhysicalMesh(PhysicalMesh &&) noexcept;
    /// Replace the contents by those of another mesh. Objects that refer to either of them must
    /// not be used any more.
    PhysicalMesh &
    operator=(PhysicalMesh &&) noexcept;

    /// The curves of the geometry, in its order.
    const std::vector<Curve> &
    curves() const;

    /// Pieces of all curves, numbered consecutively.
    const std::vector<CurvePiece> &
    pieces() const;

    /// Curve that each piece belongs to.
    const std::vector<unsigned int> &
    piece_to_curve() const;

    /// All regions, from left to right.
    const std::vector<Region> &
    regions() const;

    /// Number of blocks; Region::block is from 0 to n_blocks() - 1.
    unsigned int
    n_blocks() const;

    /// Names of the materials, by number of the material.
    const std::vector<std::string> &
    material_names() const;

    /// Bounding box of the solid [m].
    const dealii::BoundingBox<2> &
    bounding_box() const;

    /// Index of the first curve called @p name, or invalid_index if there is none.
    unsigned int
    find_curve(const std::string &name) const;

    /// Blocks of which all regions are inside the closed curve @p border, in ascending order. A block
    /// that the border crosses is decided by PhysicalRegion::inside.
    std::vector<unsigned int>
    blocks_inside(const Curve &border) const;

    /// Indices of all curves called @p name. Curves of one role may share a name; conditions for
    /// that name apply to all of them.
    std::vector<unsigned int>
    find_curves(const std::string &name) const;

    /**
     * Whether a curve on the boundary of a region can be a face of that region. Where two domains
     * share an edge, the boundaries of both lie on it, and each is a face of its own domain only. A
     * hole is a face of the regions outside of it. Joints and interfaces are faces of all regions.
     */
    bool
    is_face_of(unsigned int curve, unsigned int region) const;

    /// Sentences for the user about findings that are not errors: parts of joints outside the
    /// solid, a joint along a boundary, duplicated joints, an interface that separates nothing.
    const std::vector<std::string> &
    notices() const;

    /// Parts of joints that bound no block, kept or removed (Curve::drops_ends).
    const DanglingEnds &
    dangling_ends() const;

    /// Small blocks that were merged into neighbours, in this order. A block may have absorbed
    /// others before, which count in its area.
    const std::vector<CleaningAction> &
    merged_blocks() const;

    /// The exact arrangement of the curves, for the covers module.
    const internal::PhysicalArrangement &
    arrangement() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
