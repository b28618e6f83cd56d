#ifndef nmm_mechanics_block_motion_h
#define nmm_mechanics_block_motion_h

#include <nmm/mechanics/displacement_field.h>
#include <nmm/quadrature/element_quadrature.h>

#include <vector>

namespace NMM
{
  /**
   * The motion of a block as a whole between two displacement fields u and v, as a stiff block
   * would follow their difference d = v - u best: with its area A and its centre X_c, all in the
   * reference configuration,
   * @f[ t = \frac1A\int d\,dA, \qquad
   *     \omega = \frac{\int (X - X_c)\times d\,dA}{\int |X - X_c|^2\,dA}. @f]
   * What is left of d is deformation; of a large turn, omega is the sine.
   */
  struct BlockMotion
  {
    /// Number of the block in the physical mesh.
    unsigned int block = invalid_index;
    /// [m^2]
    double area = 0.;
    /// X_c [m].
    dealii::Point<2> center;
    /// Radius of gyration, the root of the mean of |X - X_c|^2 [m].
    double radius = 0.;
    /// t [m].
    dealii::Tensor<1, 2> translation;
    /// omega, counter-clockwise [rad].
    double rotation = 0.;

    /// Root of the mean square of the displacement of the block's points,
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
