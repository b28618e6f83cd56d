#ifndef nmm_source_quadrature_element_triangles_h
#define nmm_source_quadrature_element_triangles_h

// Private: elements that are one or two well-shaped triangles.

#include <nmm/quadrature/element_quadrature.h>

namespace NMM
{
  namespace internal
  {
    /// What an element is made of.
    enum class Triangles : unsigned char
    {
      /// It has another shape.
      none,
      one,
      /// A convex quadrilateral, along the diagonal from corner 0 or 1.
      two_from_0,
      two_from_1
    };

    /**
     * Is the element a well-shaped triangle or convex quadrilateral?
     * Rounding of reference coordinates counts in proportion to the largest extent over
     * the area and over the cell: shapes for which it may grow by more than a hundred are
     * left to ElementFrame. At most @p max_triangles.
     */
    Triangles
    find_triangles(const dealii::ArrayView<const ElementEdge> &edges,
                   const CellFrame                            &cell,
                   unsigned int                                max_triangles);

    /// Set the triangles of an element, in reference coordinates; returns how many.
    unsigned int
    set_triangles(Triangles                                   kind,
                  const dealii::ArrayView<const ElementEdge> &edges,
                  const CellFrame                            &cell,
                  ElementRule::Triangle (&triangles)[2]);
  } // namespace internal
} // namespace NMM

#endif
