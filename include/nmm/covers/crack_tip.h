#ifndef nmm_covers_crack_tip_h
#define nmm_covers_crack_tip_h

#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace NMM
{
  /**
   * A crack tip: the end of an open joint inside a block. The displacement jumps across one curve
   * that arrives there, and there is solid all around. Interfaces and closed joints may run through
   * the tip, since they are tied.
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
    /// Region of the physical mesh in which the tip lies, the first one of `regions`.
    unsigned int region = invalid_index;
    /// All regions around the tip, each once; several only if `tied_curve` exists.
    std::vector<unsigned int> regions;
    /// Curve that ends at the tip, an index for PhysicalMesh::curves().
    unsigned int curve = invalid_index;
    /// An interface or closed joint that runs through the tip, an index for
    /// PhysicalMesh::curves(), or invalid_index.
    unsigned int tied_curve = invalid_index;
    /// The crack from the tip to its other end or to the first point where another
    /// curve arrives; the start of each edge is nearer to the tip along the crack than its end.
    std::vector<ElementEdge> path;
    /**
     * The largest R [m] for which the disk |x - point| < R contains no curve but the beginning of
     * `path` and tied curves that run through the tip, and `path` has exactly one point at each
     * distance r < R from the tip. The disk contains no other regions than `regions`.
     */
    double free_radius = 0.;
    /// The curve that bounds the free radius, an index for PhysicalMesh::curves(); `curve` where
    /// the crack itself ends or turns back. Circles of tip covers do not count.
    unsigned int nearest_curve = invalid_index;

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
   * Tied joints (JointState::closed) have no tips, because they do not open. Ends without room
   * are left out, see find_tips_without_room().
   * Cost: O(tips · curves).
   */
  std::vector<CrackTip>
  find_crack_tips(const PhysicalMesh &physical_mesh);

  /**
   * Find the ends of open joints that are so near to another curve, or whose crack is so short, that
   * coordinates cannot resolve a singular field there: the free radius, without the circles of tip
   * covers, is not larger than @f$ 10^4\,\varepsilon\,M @f$, where M is the largest coordinate of
   * the solid. The smallest cells are a hundredth of that, so that rounding moves their corners by
   * up to a hundredth of their size.
   * Cost: O(tips · curves).
   */
  std::vector<CrackTip>
  find_tips_without_room(const PhysicalMesh &physical_mesh);

  /// The end of an open joint inside a block, with or without room for a singular field.
  struct CrackEnd
  {
    /// Position in the reference configuration [m].
    dealii::Point<2> point;
    /// Length of the crack up to its other end or the first point where another curve arrives [m].
    double length = 0.;
  };

  /// All ends of open joints inside blocks, in the order of find_crack_tips(). Cost: O(curves).
  std::vector<CrackEnd>
  find_crack_ends(const PhysicalMesh &physical_mesh);

  /**
   * A corner of a crack into which the solid reaches with an angle of more than 180 degrees: the
   * crack has a kink there, or branches to one side. Stress grows without bound at such a corner,
   * though less than at a tip.
   */
  struct CrackCorner
  {
    /// Position in the reference configuration [m].
    dealii::Point<2> point;
    /// Angle of the solid between the two faces, in (pi, 2 pi) [rad].
    double angle = 0.;
    /// Distance from other curves, and from where the curves of the corner end or turn back [m].
    double free_radius = 0.;
  };

  /**
   * Find the corners of open joints inside a block at which the angle of the solid is larger than
   * 180 degrees by more than @p least_turn [rad]. Corners with less room than
   * find_tips_without_room() names are left out.
   * Cost: O(corners · curves).
   */
  std::vector<CrackCorner>
  find_crack_corners(const PhysicalMesh &physical_mesh, double least_turn);

  /// Edge length below which rounding moves the corners of cells by more than a hundredth of it [m].
  double
  least_cell_size(const PhysicalMesh &physical_mesh);
} // namespace NMM

#endif
