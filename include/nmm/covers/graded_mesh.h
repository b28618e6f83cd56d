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
   * A place that wants smaller cells: edge length `size` there, growing with the
   * distance d from it,
   * @f[ h(x) = \texttt{size} + \texttt{growth}\cdot
       \begin{cases}\ell\,(d/\ell)^{\texttt{exponent}} & d < \ell\\ d & d \ge \ell
       \end{cases},
       \qquad \ell = \texttt{length}. @f]
   */
  struct LocalSize
  {
    enum class Kind
    {
      point,
      box,
      curve
    };
    Kind kind = Kind::point;

    /// Points: where [m].
    dealii::Point<2> point;
    /// Boxes: lower left and upper right corner [m]; d = 0 inside.
    dealii::Point<2> lower, upper;
    /// Curves: name; all curves of that name count.
    std::string curve;

    /// Wanted edge length [m].
    double size = 0.;
    /// Increase of the edge length per distance [-], at most 1; with another exponent than 1
    /// its mean up to the distance `length`.
    double growth = 0.2;
    /// In (0, 1]. With 1, `length` [m] has no effect. For an exponent less than 1 cells grow
    /// faster near the place and slower up to `length`.
    double exponent = 1., length = 1.;
  };


  /// A regular mesh, whose cell size holds far from all local sizes.
  struct GradedMeshParameters : RegularMeshParameters
  {
    std::vector<LocalSize> local_sizes;
  };


  /**
   * The size field: the smallest of the cell size and all local sizes.
   */
  class SizeField
  {
  public:
    /// @throws InputError for a size or growth out of range, an unknown curve.
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
   * The regular mesh, refined where the size field is smaller than its cells: a
   * triangle is divided into four of half the size until its edges are no
   * longer than the size field at its centre (red), neighbours are kept within one
   * level, and where a neighbour's node remains in the middle of an edge the
   * triangle is halved (green; Bank, Sherman & Weiser 1983). So most cells
   * stay as well shaped as those of the regular mesh, and no angle is less than half of
   * theirs. Cells that lie outside the solid are dropped. The mesh does not fit
   * the solid's curves: cutting does that.
   * @throws InputError for sizes out of range or an unknown curve.
   */
  MathematicalMesh
  make_graded_mesh(const PhysicalMesh         &physical_mesh,
                   const GradedMeshParameters &parameters,
                   unsigned int                degree);

  /**
   * A mesh of triangles from a gmsh file (format 2 or 4), as it is.
   * @throws InputError if the file cannot be read or holds no triangles.
   */
  MathematicalMesh
  read_gmsh_mesh(const std::string &file_name, unsigned int degree);
} // namespace NMM

#endif
