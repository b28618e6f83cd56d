#ifndef nmm_source_quadrature_element_triangles_h
#define nmm_source_quadrature_element_triangles_h

// Elements that are one or two well-shaped triangles.

#include <nmm/quadrature/element_quadrature.h>

namespace NMM
{
  namespace internal
  {
    /// The division of an element into triangles.
    enum class Triangles : unsigned char
    {
      /// The element is not divided, since it has another shape.
      none,
      /// The element is a triangle.
      one,
      /// The element is a convex quadrilateral, divided along the diagonal from corner 0.
      two_from_0,
      /// The element is a convex quadrilateral, divided along the diagonal from corner 1.
      two_from_1
    };

    /**
     * Finds out whether the element is a well-shaped triangle or convex quadrilateral, which
     * needs no more than @p max_triangles. Small and thin elements amplify the rounding of
     * reference coordinates. Those for which it may grow by a factor of more than a hundred
     * count as not well-shaped and are left to ElementFrame.
     */
    Triangles
    find_triangles(const dealii::ArrayView<const ElementEdge> &edges,
                   const CellFrame                            &cell,
                   unsigned int                                max_triangles);

    /// Sets the triangles of an element in reference coordinates of its cell, and returns their
    /// number, which is 0 for Triangles::none.
    unsigned int
    set_triangles(Triangles                                   kind,
                  const dealii::ArrayView<const ElementEdge> &edges,
                  const CellFrame                            &cell,
                  ElementRule::Triangle (&triangles)[2]);
  } // namespace internal
} // namespace NMM

#endif
