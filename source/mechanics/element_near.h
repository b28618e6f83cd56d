#ifndef nmm_source_mechanics_element_near_h
#define nmm_source_mechanics_element_near_h

#include <nmm/covers/manifold_mesh.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /// Element of a point of the solid. If the point is not found, because rounding has moved it
    /// from the boundary to the outside, points very close to it are tried.
    /// @throws InputError that begins with @p what if no element contains the point.
    unsigned int
    find_element_near(const ManifoldMesh     &mesh,
                      const dealii::Point<2> &point,
                      const std::string      &what);
  } // namespace internal
} // namespace NMM

#endif
