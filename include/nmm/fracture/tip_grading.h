#ifndef nmm_fracture_tip_grading_h
#define nmm_fracture_tip_grading_h

#include <nmm/covers/crack_tip.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/geometry/physical_mesh.h>

#include <vector>

namespace NMM
{
  /**
   * The cell sizes about a crack tip that distribute the error of second-order displacements
   * equally among cells. The error of displacements is h^3 times their third derivatives, which
   * grow like r^(-5/2). Its square, times h^(-2) for the strain and times the area h^2 of a cell,
   * is the energy of the error in a cell,
   * @f[ h^6\,r^{-5} = \mathrm{const.}
       \quad\Rightarrow\quad h = g R \left(\frac rR\right)^{5/6}, @f]
   * where R is the free radius of the tip and g = @p growth is the size of cells at the distance R
   * over R [-]. About 44 / g^2 cells lie in the disk r < R, for any cell size at
   * the tip. That size is @p smallest times R: the crack is open only up to the cell that contains
   * its tip, and a crack that is too short by a fraction of its length has a K that is too small
   * by about half of that fraction.
   *
   * A cell can be halved at most 20 times, so that the size of cells elsewhere, @p cell_size [m],
   * bounds the size at the tip from below.
   */
  LocalSize
  grade_towards(const CrackTip &tip,
                double          growth,
                double          cell_size,
                double          smallest = 1e-6);


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
                double              cell_size,
                double              smallest = 1e-6);
} // namespace NMM

#endif
