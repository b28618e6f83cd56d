#ifndef nmm_covers_mathematical_mesh_h
#define nmm_covers_mathematical_mesh_h

#include <nmm/base/types.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  struct RankCells;

  /// Triangles that will be a part of a mathematical mesh.
  struct MeshPart
  {
    std::vector<dealii::Point<2>> vertices;
    /// Corner vertices, counter-clockwise.
    std::vector<std::array<unsigned int, 3>> cells;
  };


  /**
   * The mathematical mesh: a deal.II simplex triangulation that need only cover
   * the solid, with the scalar finite element whose shape functions are the
   * weight functions w_i of the paper's eq. (3)-(4) (monomials 1, x, y, x^2, xy,
   * y^2; degree 1 is the first-order method). One scalar dof is one
   * *mathematical cover*: the hexagon around a corner node or the quadrilateral
   * around a mid-side node.
   *
   * A mesh can consist of several *parts* (combine_meshes()) that share no
   * vertex and may overlap in space: each is the mathematical mesh of regions of
   * its own. Cells, covers and edges are numbered through, part after part.
   *
   * Beside the deal.II objects it keeps flat tables of vertices, cells, edges
   * and covers, because walking deal.II iterators per element and step would
   * cost more than the arithmetic.
   */
  class MathematicalMesh
  {
  public:
    /// An edge of the triangulation between two cells.
    struct Edge
    {
      /// Vertices, lower index first.
      std::array<unsigned int, 2> vertices;
      /// Cells to the left and right of vertices[0] -> vertices[1];
      /// invalid_index beyond the mesh.
      std::array<unsigned int, 2> cells;
    };

    /**
     * Take over @p triangulation (triangles only, counter-clockwise) and
     * distribute FE_SimplexP<2>(degree), degree 1 or 2.
     * @throws InputError for another cell type, an empty mesh, a degree that
     * the installed deal.II does not offer.
     */
    MathematicalMesh(std::unique_ptr<dealii::Triangulation<2>> triangulation,
                     unsigned int                              degree);

    /// Copy the cells of a triangulation the caller keeps.
    MathematicalMesh(const dealii::Triangulation<2> &triangulation,
                     unsigned int                    degree);

    /// Take over a part of a mesh, see make_distributed_mesh().
    MathematicalMesh(std::unique_ptr<dealii::Triangulation<2>> triangulation,
                     unsigned int                              degree,
                     std::unique_ptr<const RankCells>          rank_cells);

    MathematicalMesh(MathematicalMesh &&) noexcept;
    ~MathematicalMesh();

    const dealii::Triangulation<2> &
    triangulation() const;

    /// Scalar: one dof per mathematical cover.
    const dealii::DoFHandler<2> &
    dof_handler() const;

    const dealii::FiniteElement<2> &
    fe() const;

    /// The affine mapping of triangles.
    const dealii::Mapping<2> &
    mapping() const;

    unsigned int
    degree() const;

    unsigned int
    n_cells() const;

    unsigned int
    n_mathematical_covers() const;

    /// Weight functions per cell: 3 or 6.
    unsigned int
    n_covers_per_cell() const;

    /// Who owns which cell if this rank holds a part of the mesh only; null if it
    /// holds all of it.
    const RankCells *
    rank_cells() const;

    /// Parts; 1 unless made by combine_meshes().
    unsigned int
    n_parts() const;

    unsigned int
    cell_part(unsigned int cell) const;

    /// Cells of a part, first and past-the-end.
    std::pair<unsigned int, unsigned int>
    part_cells(unsigned int part) const;

    const std::vector<dealii::Point<2>> &
    vertices() const;

    /// Corner vertices, counter-clockwise, in deal.II's order.
    const std::array<unsigned int, 3> &
    cell_vertices(unsigned int cell) const;

    /// Corner vertices of all cells.
    const std::vector<std::array<unsigned int, 3>> &
    cells() const;

    /// Mathematical covers in the order of the finite element's dofs; pointer to
    /// n_covers_per_cell() entries.
    const unsigned int *
    cell_covers(unsigned int cell) const;

    /// Edge numbers, in the order of deal.II's lines: edge i of a cell joins its
    /// corners i and (i+1)%3.
    const std::array<unsigned int, 3> &
    cell_edges(unsigned int cell) const;

    const std::vector<Edge> &
    edges() const;

    /// Weight functions (finite element dofs) on each edge of a cell: those of
    /// its two corners, then the mid-side one (degree 2; else invalid_index).
    const std::vector<std::array<unsigned int, 3>> &
    edge_to_local_covers() const;

    dealii::Triangulation<2>::active_cell_iterator
    cell_iterator(unsigned int cell) const;

    /// Node of a mathematical cover (corner or mid-side) [m].
    const dealii::Point<2> &
    cover_node(unsigned int mathematical_cover) const;

    /// Columns v1 - v0 and v2 - v0 [m] of the affine map x = v0 + J xi.
    dealii::Tensor<2, 2>
    jacobian(unsigned int cell) const;

    dealii::Point<2>
    real_to_reference(unsigned int cell, const dealii::Point<2> &x) const;

    dealii::Point<2>
    reference_to_real(unsigned int cell, const dealii::Point<2> &xi) const;

    double
    cell_area(unsigned int cell) const;

    /// Longest edge [m].
    double
    cell_diameter(unsigned int cell) const;

  private:
    friend MathematicalMesh
    combine_meshes(const std::vector<MeshPart> &parts, unsigned int degree);

    struct Data;
    std::unique_ptr<Data> data;
  };


  /**
   * One mathematical mesh of several parts, in the order given: a deal.II
   * triangulation of as many disconnected pieces. Parts may overlap.
   * @throws InputError for no parts, a part without cells, or what the
   * constructor does not accept.
   */
  MathematicalMesh
  combine_meshes(const std::vector<MeshPart> &parts, unsigned int degree);

  /// The cells of a mesh, for example to combine them with others.
  MeshPart
  make_mesh_part(const MathematicalMesh &mesh);


  /// How a regular mesh is made of triangles.
  enum class MeshPattern
  {
    /// Equilateral triangles: the smallest error for a number of unknowns.
    equilateral,
    /// Squares halved along one diagonal: corners at round coordinates.
    right_angled
  };

  /// Parameters of a regular mathematical mesh.
  struct RegularMeshParameters
  {
    /// Edge length of a triangle (equilateral) or of a square [m].
    double cell_size = 0.;
    /// A node of the mesh, before rotation, is moved to box centre + offset [m].
    dealii::Tensor<1, 2> offset;
    /// Turned counter-clockwise about the box centre [degrees].
    double      rotation = 0.;
    MeshPattern pattern  = MeshPattern::equilateral;
    /// Cells of the whole (inflated) box, or only those that can touch the solid.
    bool whole_box = false;
  };

  class PhysicalMesh;

  /**
   * Regular mesh over the solid's bounding box. Unless whole_box is set, cells
   * that surely lie outside (further than a cell from every curve and not
   * inside) are never created.
   * @throws InputError if the cell size is not positive or would give more than
   * 2^31 cells.
   */
  MathematicalMesh
  make_regular_mesh(const PhysicalMesh          &physical_mesh,
                    const RegularMeshParameters &parameters,
                    unsigned int                 degree);
} // namespace NMM

#endif
