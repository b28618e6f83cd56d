#ifndef nmm_geometry_crack_extension_h
#define nmm_geometry_crack_extension_h

#include <nmm/geometry/geometry.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace NMM
{
  /// Result of extend_crack().
  struct CrackExtension
  {
    /// Position of the end of the crack after the growth [m].
    dealii::Point<2> end;
    /// Role and name of the curve at which the crack ends now, such as "joint 'j1'": a boundary,
    /// hole, joint, interface or another crack. Empty if the crack ends inside a block and has a
    /// tip there.
    std::string met;
  };

  /**
   * Let a crack grow straight from its tip at @p tip in the unit direction @p direction by
   * @p length [m], as a further open joint called @p name.
   *
   * A crack does not cross other curves: it ends at the first one that it meets. It is extended to
   * a curve that is up to half of the length further away, so that no bridge remains that is
   * short compared with the increment. The curve that it meets is divided at a point with
   * double coordinates, which moves the curve by rounding, so that both are connected exactly.
   *
   * @p tip must be exactly the end of a joint of @p geometry.
   */
  CrackExtension
  extend_crack(Geometry                   &geometry,
               const dealii::Point<2>     &tip,
               const dealii::Tensor<1, 2> &direction,
               double                      length,
               const std::string          &name);

  /**
   * Let a new crack called @p name start at the boundary or hole nearest to @p point, which
   * need not lie on it exactly, and grow from there as in extend_crack(). The boundary is divided
   * at a point with double coordinates, at which the crack starts.
   * @throws InputError if there is neither a boundary nor a hole.
   */
  CrackExtension
  start_crack(Geometry                   &geometry,
              const dealii::Point<2>     &point,
              const dealii::Tensor<1, 2> &direction,
              double                      length,
              const std::string          &name);
} // namespace NMM

#endif
