#ifndef nmm_tests_support_contact_bars_overlap_h
#define nmm_tests_support_contact_bars_overlap_h

#include <nmm/contact/contact_surface.h>

namespace NMM
{
  namespace ContactBars
  {
    /**
     * How deep the bodies of a surface are in each other at its current positions
     * [m]: the largest distance of a corner, or of an edge's middle, of one body that
     * lies inside of another from the boundary of that one. By Boost.Geometry, all
     * against all, without anything that the contact knows. Obstacles are
     * taken for half planes: the left of each of their pieces, which must be straight.
     */
    double
    find_overlap(const ContactSurface &surface);
  } // namespace ContactBars
} // namespace NMM

#endif
