#ifndef nmm_covers_element_support_h
#define nmm_covers_element_support_h

#include <nmm/covers/manifold_mesh.h>

namespace NMM
{
  /**
   * Support s of an element E in its cell T [-], the largest number with
   * @f[ \frac{1}{|T|}\int_E q^2\,dA \ge s\,\frac{1}{|T|}\int_T q^2\,dA
   *     \quad\forall q\in P_1. @f]
   * It is the smallest eigenvalue of the 3 x 3 matrix of moments of E in a basis that is
   * orthonormal on T: 1 for a whole triangle, and at most the ratio of the areas (q = 1). The
   * strains of the second-order method are linear, so the strain energy of an element bounds its
   * unknowns with a constant of 1/s. The area alone is no measure of this: a strip of a quarter of
   * the area along an edge has s = 0.005, a corner of a quarter of the area 0.03, and a cell that
   * lacks a corner of a quarter of its area 0.35.
   *
   * s is invariant under affine maps, so that stretched cells need no special treatment.
   * Arcs are approximated by polylines of 8 chords.
   */
  double
  element_support(const ManifoldMesh &mesh, unsigned int element);

  /// Whether the support of an element is at least @p threshold [-]; cheaper than
  /// element_support().
  bool
  has_support(const ManifoldMesh &mesh, unsigned int element, double threshold);
} // namespace NMM

#endif
