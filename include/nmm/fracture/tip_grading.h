#ifndef nmm_fracture_tip_grading_h
#define nmm_fracture_tip_grading_h

#include <nmm/covers/crack_tip.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/geometry/physical_mesh.h>

#include <vector>

namespace NMM
{
  /**
   * The cell sizes about a singular point that distribute the error of second-order displacements
   * equally among cells, where the displacement is of degree @f$\lambda@f$ in the distance r: 1/2
   * at a crack tip, corner_exponent() at a corner. The error of displacements is h^3 times their
   * third derivatives, which grow like @f$r^{\lambda-3}@f$. Its square, times h^(-2) for the strain
   * and times the area h^2 of a cell, is the energy of the error in a cell,
   * @f[ h^6\,r^{2\lambda-6} = \mathrm{const.}
       \quad\Rightarrow\quad h = g R \left(\frac rR\right)^{1-\lambda/3}, @f]
   * where R is the free radius and g = @p growth is the size of cells at the distance R over R [-].
   * About 22 / (lambda g^2) cells lie in the disk r < R, for any cell size at the point. That size s
   * is R times @p smallest at a tip, and at least @p least_size [m] (least_cell_size()). The crack
   * is open only up to the cell that contains its tip, and a crack that is too short by a fraction
   * of its length has a K that is too small by about half of that fraction.
   */
  LocalSize
  grade_towards(const CrackTip &tip,
                double          growth,
                double          least_size,
                double          smallest = 1e-6);

  /**
   * The cell sizes about a corner of a crack. The energy of the field within the distance s of it is
   * the share @f$(s/R)^{2\lambda}@f$ of that within R. Cells at the corner are so small that this is
   * @p smallest, as at a tip.
   */
  LocalSize
  grade_towards(const CrackCorner &corner,
                double             growth,
                double             least_size,
                double             smallest = 1e-6);

  /**
   * The exponent lambda of the displacement r^lambda at a corner with free faces, whose solid has
   * the angle alpha = @p angle in (pi, 2 pi) [rad]: the root in (1/2, 1) of
   * @f[ \sin\lambda\alpha + \lambda\sin\alpha = 0. @f]
   * Source: M. Williams, J. Appl. Mech. 19 (1952), 526-528.
   */
  double
  corner_exponent(double angle);


  /**
   * The cell sizes about all tips of @p solid. Arguments are those of grade_towards(). Where a tip
   * has a cover (TipCover), R is the radius of its circle, and cells at the tip are as large as
   * 0.4 g R: the tip functions leave nothing that needs smaller ones. The size grows with 0.8 g from
   * there. With these numbers intensity factors are at least as accurate as without a cover, with a
   * third of the unknowns.
   */
  std::vector<LocalSize>
  sizes_at_tips(const PhysicalMesh &solid,
                double              growth,
                double              smallest = 1e-6);

  /**
   * The cell sizes about the corners of cracks that turn by more than 20 degrees; a corner of less
   * changes intensity factors by 3e-5 at most. Their growth is 1.6 @p growth, since the field at a
   * corner is weaker than at a tip. Corners that are nearer to each other than a quarter of their
   * distance from the next tip are left out: they are roughness there, which cells whose size
   * grows with a quarter of that distance do not resolve either.
   */
  std::vector<LocalSize>
  sizes_at_corners(const PhysicalMesh &solid,
                   double              growth,
                   double              smallest = 1e-6);
} // namespace NMM

#endif
