#ifndef nmm_mechanics_block_motion_h
#define nmm_mechanics_block_motion_h

#include <nmm/mechanics/displacement_field.h>
#include <nmm/quadrature/element_quadrature.h>

#include <vector>

namespace NMM
{
  /**
   * The rigid part of the motion of a block between two displacement fields u and v: the
   * least-squares fit of a linearized rigid motion to the difference d = v - u. With the area A
   * and the centroid X_c of the block, all in the reference configuration,
   * @f[ t = \frac1A\int d\,dA, \qquad
   *     \omega = \frac{\int (X - X_c)\times d\,dA}{\int |X - X_c|^2\,dA}. @f]
   * The remainder of d is deformation. For a large rotation, omega is the sine of the angle.
   */
  struct BlockMotion
  {
    /// Number of the block in the physical mesh.
    unsigned int block = invalid_index;
    /// Area of the block in the reference configuration [m^2].
    double area = 0.;
    /// Centroid X_c in the reference configuration [m].
    dealii::Point<2> center;
    /// Radius of gyration, the root of the mean of |X - X_c|^2 [m].
    double radius = 0.;
    /// Translation t [m].
    dealii::Tensor<1, 2> translation;
    /// Rotation omega, positive counter-clockwise [rad].
    double rotation = 0.;

    /// Root mean square of the rigid displacement of the block's points,
    /// sqrt(t . t + (omega radius)^2) [m].
    double
    size() const;
  };

  /// Motions of all blocks from @p before to @p after; the same on all ranks. Collective.
  std::vector<BlockMotion>
  block_motions(const DisplacementField    &before,
                const DisplacementField    &after,
                const QuadratureCollection &quadrature);
} // namespace NMM

#endif
