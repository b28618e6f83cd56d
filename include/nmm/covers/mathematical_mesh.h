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
  /// Triangles that will be a part of a mathematical mesh, see combine_meshes().
  struct MeshPart
  {
    /// Positions of the vertices [m].
    std::vector<dealii::Point<2>> vertices;
    /// Corner vertices of each triangle, counter-clockwise.
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
   * its own. Cells, covers and edges are numbered consecutively, part after part.
   *
   * The class stores flat tables of vertices, cells, edges and covers beside the deal.II objects,
   * because deal.II iterators would cost more than the arithmetic on each element.
   *
   * Order of calls in this room: make a mathematical mesh with make_regular_mesh(),
   * make_graded_mesh() or read_gmsh_mesh(); cut it with a PhysicalMesh by
   * the constructor of ManifoldMesh, or by make_own_meshes() if regions may be smaller than cells;
   * number the unknowns by a CoverSystem; treat covers with little support by aggregate() or
   * make_ghost_penalty().
   * @code
   * RegularMeshParameters parameters;
   * parameters.cell_size = 0.1;
   * const MathematicalMesh triangles = make_regular_mesh(solid, parameters, 2);
   * const ManifoldMesh     elements(triangles, solid);
   * CoverSystem            covers(elements, MPI_COMM_WORLD);
   * const Aggregation      aggregation = aggregate(covers);
   * const auto             constraints = make_constraints(covers, aggregation, 2);
   * @endcode
   */
  class MathematicalMesh
  {
  public:
    /// An edge of the triangulation, between two cells or at the rim of the mesh.
    struct Edge
    {
      /// Vertices, lower index first.
      std::array<unsigned int, 2> vertices;
      /// Cells to the left and right of vertices[0] -> vertices[1];
      /// invalid_index where there is no cell.
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

    /// Copy the cells of @p triangulation, which the caller keeps; otherwise as above.
    MathematicalMesh(const dealii::Triangulation<2> &triangulation,
                     unsigned int                    degree);

    /// Take over the tables of another mesh. Objects that refer to that one, such as a
    /// ManifoldMesh, must not be used any more.
    MathematicalMesh(MathematicalMesh &&) noexcept;
    ~MathematicalMesh();

    /// The deal.II triangulation; it lives as long as this object.
    const dealii::Triangulation<2> &
    triangulation() const;

    /// Degrees of freedom of the scalar finite element: one per mathematical cover.
    const dealii::DoFHandler<2> &
    dof_handler() const;

    /// The scalar finite element FE_SimplexP<2>(degree()), whose shape functions are the weight
    /// functions.
    const dealii::FiniteElement<2> &
    fe() const;

    /// The affine mapping of triangles.
    const dealii::Mapping<2> &
    mapping() const;

    /// Degree of the weight functions, 1 or 2.
    unsigned int
    degree() const;

    /// Number of cells.
    unsigned int
    n_cells() const;

    /// Number of mathematical covers.
    unsigned int
    n_mathematical_covers() const;

    /// Number of weight functions on a cell: 3 or 6.
    unsigned int
    n_covers_per_cell() const;

    /// Number of parts; 1 unless combine_meshes() made the mesh.
    unsigned int
    n_parts() const;

    /// Part that a cell belongs to.
    unsigned int
    cell_part(unsigned int cell) const;

    /// Cells of a part, first and past-the-end.
    std::pair<unsigned int, unsigned int>
    part_cells(unsigned int part) const;

    /// Positions of all vertices [m].
    const std::vector<dealii::Point<2>> &
    vertices() const;

    /// Corner vertices of a cell, counter-clockwise, in deal.II's order.
    const std::array<unsigned int, 3> &
    cell_vertices(unsigned int cell) const;

    /// Corner vertices of all cells.
    const std::vector<std::array<unsigned int, 3>> &
    cells() const;

    /// Mathematical covers of a cell in the order of the finite element's dofs: pointer to
    /// n_covers_per_cell() entries.
    const unsigned int *
    cell_covers(unsigned int cell) const;

    /// Edges of a cell in the order of deal.II's lines: edge i of a cell joins its
    /// corners i and (i+1)%3.
    const std::array<unsigned int, 3> &
    cell_edges(unsigned int cell) const;

    /// All edges of the triangulation.
    const std::vector<Edge> &
    edges() const;

    /// Weight functions (finite element dofs) on each of a cell's three edges: those of
    /// its two corners, then the mid-side one (degree 2; else invalid_index).
    const std::vector<std::array<unsigned int, 3>> &
    edge_to_local_covers() const;

    /// The deal.II cell of a cell number.
    dealii::Triangulation<2>::active_cell_iterator
    cell_iterator(unsigned int cell) const;

    /// Node of a mathematical cover (corner or mid-side) [m].
    const dealii::Point<2> &
    cover_node(unsigned int mathematical_cover) const;

    /// Jacobian matrix J of a cell's affine map x = v0 + J xi [m]; its columns are v1 - v0 and
    /// v2 - v0.
    dealii::Tensor<2, 2>
    jacobian(unsigned int cell) const;

    /// Reference coordinates xi [-] of the point @p x [m], which may lie outside the cell.
    dealii::Point<2>
    real_to_reference(unsigned int cell, const dealii::Point<2> &x) const;

    /// Position x [m] of the reference coordinates @p xi [-].
    dealii::Point<2>
    reference_to_real(unsigned int cell, const dealii::Point<2> &xi) const;

    /// Area of a cell [m^2].
    double
    cell_area(unsigned int cell) const;

    /// Length of a cell's longest edge [m].
    double
    cell_diameter(unsigned int cell) const;

  private:
    friend MathematicalMesh
    combine_meshes(const std::vector<MeshPart> &parts, unsigned int degree);

    struct Data;
    std::unique_ptr<Data> data;
  };


  /**
   * Make one mathematical mesh of several parts, in the order given: a deal.II
   * triangulation of as many disconnected pieces. Parts may overlap.
   * @throws InputError for no parts, a part without cells, or what the
   * constructor does not accept.
   */
  MathematicalMesh
  combine_meshes(const std::vector<MeshPart> &parts, unsigned int degree);

  /// Copy the cells of a mesh, for example to combine them with others.
  MeshPart
  make_mesh_part(const MathematicalMesh &mesh);


  /// Arrangement of the triangles in a regular mesh.
  enum class MeshPattern
  {
    /// Equilateral triangles: the smallest error for a given number of unknowns.
    equilateral,
    /// Squares halved along one diagonal: their corners have round coordinates.
    right_angled
  };

  /// Parameters of a regular mathematical mesh.
  struct RegularMeshParameters
  {
    /// Edge length of a triangle (equilateral) or of a square [m].
    double cell_size = 0.;
    /// Before the rotation, a node of the mesh is at the centre of the bounding box + offset [m].
    dealii::Tensor<1, 2> offset;
    /// Angle by which the mesh is turned counter-clockwise about the centre of the box [degrees].
    double rotation = 0.;
    /// Arrangement of the triangles.
    MeshPattern pattern = MeshPattern::equilateral;
    /// Whether the mesh has the cells of the whole (inflated) box, or only those that can touch
    /// the solid.
    bool whole_box = false;
  };

  class PhysicalMesh;

  /**
   * Make a regular mesh over the solid's bounding box. Unless whole_box is set, cells that are
   * certainly outside the solid (further than a cell from every curve and not inside) are not
   * created.
   * @throws InputError if the cell size is not positive or would give more than
   * 2^31 cells.
   */
  MathematicalMesh
  make_regular_mesh(const PhysicalMesh          &physical_mesh,
                    const RegularMeshParameters &parameters,
                    unsigned int                 degree);
} // namespace NMM

#endif
