#ifndef nmm_fracture_tip_grading_h
#define nmm_fracture_tip_grading_h

#include <nmm/covers/crack_tip.h>
#include <nmm/covers/graded_mesh.h>

namespace NMM
{
  /**
   * Cells that become small towards a crack tip, so that all of them have the same part
   * in the error of second-order displacements. These are off by h^3 times third
   * derivatives, which grow like r^(-5/2); squared, times the area h^2 of a cell and by
   * h^(-2) for the strain, the energy of the error in a cell is
   * @f[ h^6\,r^{-5} = \mathrm{const.}
       \quad\Rightarrow\quad h = g R \left(\frac rR\right)^{5/6}, @f]
   * R being the free radius of the tip and g @p growth [-], the size of cells at that distance
   * over R. About 44 / g^2 cells lie in the disk r < R, however small they are at
   * the tip: there they are 1e-6 R, since the crack opens up to the cell that holds its tip, and
   * what is missing of its length a costs about half of its share in a of K.
   *
   * In each refinement at most 2^20 divisions are possible: @p cell_size [m] of the mesh elsewhere
   * bounds the size at the tip from below.
   */
  LocalSize
  grade_towards(const CrackTip &tip, double growth, double cell_size);
} // namespace NMM

#endif
