#ifndef nmm_covers_crack_tip_h
#define nmm_covers_crack_tip_h

#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace NMM
{
  /**
   * A crack tip: the end of an open joint inside a region, where no other curve
   * arrives.
   *
   * The tip's frame has its origin in `point`, its first axis e_1 along `direction`, in which
   * the crack would grow straight on, and its second axis 90 degrees to the left of
   * it. The crack lies, near the tip, along the negative first axis.
   */
  struct CrackTip
  {
    /// [m]
    dealii::Point<2> point;
    /// Unit tangent of the crack at its tip, pointing out of the crack.
    dealii::Tensor<1, 2> direction;
    /// Region of the physical mesh, and curve (PhysicalMesh::curves()) that ends.
    unsigned int region = invalid_index, curve = invalid_index;
    /// The crack from the tip to its other end or to the first point where another
    /// curve arrives; each edge begins at its end that is nearer to the tip along the crack.
    std::vector<ElementEdge> path;
    /**
     * The largest R for which the disk |x - point| < R holds nothing but the
     * beginning of `path`, and `path` passes each distance r < R from the tip exactly
     * once [m].
     */
    double free_radius = 0.;

    /**
     * Polar angle of @p x in the tip's frame [rad], as a function that is
     * continuous within the free radius but for the crack, where it jumps by
     * 2 pi: in (phi(r) - 2 pi, phi(r)), phi(r) being the angle at which the crack
     * passes the distance r = |x - point|. For a straight crack phi = pi.
     * A point on the crack is taken to be on that side into which @p into_solid
     * points, if it is given.
     */
    double
    angle(
      const dealii::Point<2>     &x,
      const dealii::Tensor<1, 2> &into_solid = dealii::Tensor<1, 2>()) const;
  };


  /**
   * The tips of all open joints, in the order of their coordinates x, then y.
   * Tied joints (JointState::closed) have none: nothing opens there. What ends within
   * 1e-9 of the solid's size of another curve is no tip either: there is no room for a
   * field of its own.
   * Cost: tips times curves.
   */
  std::vector<CrackTip>
  find_crack_tips(const PhysicalMesh &physical_mesh);
} // namespace NMM

#endif
