#ifndef nmm_covers_graded_mesh_h
#define nmm_covers_graded_mesh_h

#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/curve.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A place with smaller cells. The wanted edge length is `size` there, and grows with the
   * distance d from it,
   * @f[ h(x) = \texttt{size} + \texttt{growth}\cdot
       \begin{cases}\ell\,(d/\ell)^{\texttt{exponent}} & d < \ell\\ d & d \ge \ell
       \end{cases},
       \qquad \ell = \texttt{length}. @f]
   */
  struct LocalSize
  {
    /// What the distance d is measured from.
    enum class Kind
    {
      /// The member `point`.
      point,
      /// The box between `lower` and `upper`; d = 0 inside.
      box,
      /// All curves with the name `curve`.
      curve
    };
    /// Kind of this place; the members of other kinds are not used.
    Kind kind = Kind::point;

    /// Position of a point [m].
    dealii::Point<2> point;
    /// Lower left corner of a box [m].
    dealii::Point<2> lower;
    /// Upper right corner of a box [m].
    dealii::Point<2> upper;
    /// Name of the curves.
    std::string curve;

    /// Wanted edge length at the place [m], positive.
    double size = 0.;
    /// Increase of the edge length per distance [-], in (0, 1]; with another exponent than 1
    /// its mean up to the distance `length`.
    double growth = 0.2;
    /// Exponent of the distance [-], in (0, 1]. With an exponent less than 1 cells grow faster near
    /// the place and slower towards `length`.
    double exponent = 1.;
    /// Distance beyond which the edge length grows linearly [m]; no effect if the exponent is 1.
    double length = 1.;
  };


  /// Parameters of a graded mesh: those of a regular mesh, whose cell size holds far from all
  /// places with smaller cells.
  struct GradedMeshParameters : RegularMeshParameters
  {
    /// Places with smaller cells; the smallest wanted edge length counts.
    std::vector<LocalSize> local_sizes;
  };


  /**
   * The size field h(x): the smallest of the regular cell size and all local sizes.
   */
  class SizeField
  {
  public:
    /// Find the curves that the local sizes name.
    /// @throws InputError for a size or growth out of range, or an unknown curve.
    SizeField(const PhysicalMesh  &physical_mesh,
              GradedMeshParameters parameters);

    /// Wanted edge length at @p x [m].
    double
    operator()(const dealii::Point<2> &x) const;

  private:
    GradedMeshParameters                 parameters;
    std::vector<std::vector<CurvePiece>> pieces_of_local_size;
  };


  /**
   * The regular mesh, refined where the size field is smaller than its cells. A triangle is divided
   * into four of half the size (red) until its edges are no longer than the size field at its
   * centre, and the levels of neighbours differ by one at most. A triangle with a hanging node on
   * an edge is halved (green; Bank, Sherman & Weiser 1983). So most cells are as well shaped as
   * those of the regular mesh, and no angle is less than half of theirs. Cells outside the solid
   * are removed. The mesh need not fit the solid's curves.
   * @throws InputError for sizes out of range or an unknown curve.
   */
  MathematicalMesh
  make_graded_mesh(const PhysicalMesh         &physical_mesh,
                   const GradedMeshParameters &parameters,
                   unsigned int                degree);

  /**
   * Read a mesh of triangles from a gmsh file (format 2 or 4) without changing it.
   * @throws InputError if the file cannot be read or holds no triangles.
   */
  MathematicalMesh
  read_gmsh_mesh(const std::string &file_name, unsigned int degree);
} // namespace NMM

#endif
