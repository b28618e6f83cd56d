#ifndef nmm_covers_element_support_h
#define nmm_covers_element_support_h

#include <nmm/covers/manifold_mesh.h>

namespace NMM
{
  /**
   * How much of a linear strain an element sees of its cell: the largest s with
   * @f[ \frac{1}{|T|}\int_E q^2\,dA \ge s\,\frac{1}{|T|}\int_T q^2\,dA
   *     \quad\forall q\in P_1, @f]
   * the smallest eigenvalue of the 3 x 3 matrix of moments of E in a basis that
   * is orthonormal on the cell T; 1 for a whole triangle, at most the share of
   * the area (q = 1). The strains of the second-order method are linear, so
   * the unknowns of an element hang on its strain energy with a constant of
   * 1/s. The area alone does not tell: a strip of a quarter of the area along an
   * edge has s = 0.005, a corner of a quarter of the area 0.03, a cell that lacks a
   * corner of a quarter of its area 0.35.
   *
   * Invariant under affine maps, so that stretched cells are no special case.
   * Arcs are taken as polylines of 8 chords.
   */
  double
  element_support(const ManifoldMesh &mesh, unsigned int element);

  /// Is it at least @p threshold? For a fraction of the time.
  bool
  has_support(const ManifoldMesh &mesh, unsigned int element, double threshold);
} // namespace NMM

#endif
