#ifndef nmm_geometry_crack_extension_h
#define nmm_geometry_crack_extension_h

#include <nmm/geometry/geometry.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace NMM
{
  /// What became of a crack tip that grew.
  struct CrackExtension
  {
    /// Where the crack ends now [m].
    dealii::Point<2> end;
    /// The curve it has arrived at: a boundary, hole, joint, interface or another
    /// crack, where it ends. Empty: it ends inside a block, and is a tip again.
    std::string met;
  };

  /**
   * Let a crack grow straight on from its tip at @p tip in the unit direction @p direction by
   * @p length [m], as a further open joint called @p name.
   *
   * A crack does not cross other curves: it ends at the first one that it meets, and also where
   * this is up to half of the length further away, so that no bridge remains that is short beside
   * the increment. The curve it meets is divided there, at a point in doubles, which moves it by
   * rounding, so that both are connected exactly.
   *
   * @p tip must be the end of a joint of @p geometry, to the last bit.
   */
  CrackExtension
  extend_crack(Geometry                   &geometry,
               const dealii::Point<2>     &tip,
               const dealii::Tensor<1, 2> &direction,
               double                      length,
               const std::string          &name);
} // namespace NMM

#endif
