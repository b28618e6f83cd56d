#ifndef nmm_geometry_physical_mesh_h
#define nmm_geometry_physical_mesh_h

#include <nmm/base/types.h>
#include <nmm/geometry/geometry.h>

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
   * interfaces, and the regions and blocks it makes.
   *
   * A *region* is a bounded, connected piece of the solid that no curve
   * crosses; it has one material. A *block* is a maximal set of regions
   * connected across material interfaces: what moves as one piece. A joint that
   * ends inside a block (a crack) does not divide it.
   *
   * The topology is exact (CGAL Arrangement_2 over circles and segments with
   * exact constructions): a joint through a vertex, along another or tangent to
   * a circle is an ordinary case. Coordinates are doubles, however, and what exact
   * lines enclose may be smaller than these can tell apart: three lines through one
   * point, with rounded digits, make a triangle with all corners in that point. The
   * area of such a face, from its rounded vertices, is no more than their rounding,
   * @f$ 16\,\varepsilon \sum_i l_i \max(M, R_i) @f$ with lengths l of its edges, radii
   * R of arcs and the largest coordinate M. It is no region but a part of that region
   * with which it shares the longest edge, as if the lines met in the point, and the
   * edge between them is no more. A face without such a neighbour is left out of the
   * solid. Segments that run along each other within rounding, so that one of them may
   * end inside a block, are made to coincide there before. Notices tell of both.
   * Immutable once built.
   */
  class PhysicalMesh
  {
  public:
    struct Region
    {
      /// Index into material_names(), or invalid_index if none was given.
      unsigned int material;
      /// Block this region belongs to.
      unsigned int block;
      /// Area [m^2].
      double area;
      /// A point inside [m], for messages and pictures.
      dealii::Point<2> inside;
      /// Thinner than a millionth of its length.
      bool is_sliver = false;
    };

    /// Parts of joints with the same region on both sides: they bound no block.
    struct DanglingEnds
    {
      /// Crack tips: points inside the solid where one piece of a joint ends.
      unsigned int n_kept = 0, n_dropped = 0;
      /// [m].
      double length_kept = 0., length_dropped = 0.;
      /// The crack tips [m].
      std::vector<dealii::Point<2>> tips;
    };

    /**
     * Check and build. @throws InputError with the curve's name, coordinates and
     * remedy for: an open or self-intersecting boundary or hole, a hole outside
     * its domain, overlapping domains, a joint or interface wholly outside, a
     * joint confined to what does not exist, a material point outside, no
     * boundary at all.
     */
    explicit PhysicalMesh(Geometry geometry);

    ~PhysicalMesh();
    PhysicalMesh(PhysicalMesh &&) noexcept;
    PhysicalMesh &
    operator=(PhysicalMesh &&) noexcept;

    const std::vector<Curve> &
    curves() const;

    /**
     * Pieces of all curves, numbered through: piece i belongs to curve
     * piece_to_curve()[i].
     */
    const std::vector<CurvePiece> &
    pieces() const;

    const std::vector<unsigned int> &
    piece_to_curve() const;

    const std::vector<Region> &
    regions() const;

    unsigned int
    n_blocks() const;

    const std::vector<std::string> &
    material_names() const;

    /// Bounding box of the solid [m].
    const dealii::BoundingBox<2> &
    bounding_box() const;

    /// Index of the first curve called @p name, or invalid_index.
    unsigned int
    find_curve(const std::string &name) const;

    /// Indices of all curves called @p name: curves of one role may share a
    /// name and then form one group, to all of which conditions apply.
    std::vector<unsigned int>
    find_curves(const std::string &name) const;

    /**
     * Whether a curve on the boundary of a region may be its face. Where domains
     * share an edge, the boundaries of both lie on it, and each is a face of its
     * own domain only; a hole is one of what is outside of it. Others always
     * are.
     */
    bool
    is_face_of(unsigned int curve, unsigned int region) const;

    /// Notices that are no errors: parts of joints outside the solid, a joint
    /// along a boundary, duplicated joints, an interface that separates
    /// nothing. Sentences for people.
    const std::vector<std::string> &
    notices() const;

    /// Dangling ends of joints, kept or dropped (Curve::drops_ends).
    const DanglingEnds &
    dangling_ends() const;

    /// For the covers module: the exact arrangement.
    const internal::PhysicalArrangement &
    arrangement() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
