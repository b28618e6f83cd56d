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
   * The tip's frame has its origin at `point`. Its first axis e_1 is along `direction`, in which a
   * crack that does not turn would grow, and its second axis is 90 degrees to the left of it. Near
   * the tip, the crack lies along the negative first axis.
   */
  struct CrackTip
  {
    /// Position of the tip in the reference configuration [m].
    dealii::Point<2> point;
    /// Unit tangent of the crack at its tip, pointing out of the crack [-].
    dealii::Tensor<1, 2> direction;
    /// Region of the physical mesh in which the tip lies.
    unsigned int region = invalid_index;
    /// Curve that ends at the tip, an index for PhysicalMesh::curves().
    unsigned int curve = invalid_index;
    /// The crack from the tip to its other end or to the first point where another
    /// curve arrives; the start of each edge is nearer to the tip along the crack than its end.
    std::vector<ElementEdge> path;
    /**
     * The largest R [m] for which the disk |x - point| < R contains no curve but the beginning of
     * `path`, and `path` has exactly one point at each distance r < R from the tip.
     */
    double free_radius = 0.;

    /**
     * Polar angle of @p x in the tip's frame [rad]. Within the free radius it is continuous except
     * at the crack, where it jumps by 2 pi. Its range is (phi(r) - 2 pi, phi(r)), phi(r) being the
     * polar angle of the crack at the distance r = |x - point|; for a straight crack phi = pi.
     * A point on the crack is assigned to the side to which @p into_solid points, if it is given.
     */
    double
    angle(
      const dealii::Point<2>     &x,
      const dealii::Tensor<1, 2> &into_solid = dealii::Tensor<1, 2>()) const;
  };


  /**
   * Find the tips of all open joints, in the order of their coordinates x, then y.
   * Tied joints (JointState::closed) have no tips, because they do not open. Ends that are nearer
   * than 1e-9 times the solid's size to another curve are not tips either, because there is no
   * room for a singular field.
   * Cost: O(tips · curves).
   */
  std::vector<CrackTip>
  find_crack_tips(const PhysicalMesh &physical_mesh);
} // namespace NMM

#endif
