#ifndef nmm_contact_diagnostics_locked_corners_h
#define nmm_contact_diagnostics_locked_corners_h

#include <nmm/contact/surface/surface.h>

#include <string>
#include <vector>

namespace NMM
{
  /// A corner of a block that a face of another body keeps from sliding, see
  /// find_locked_corners().
  struct LockedCorner
  {
    /// Position of the corner in the reference configuration [m].
    dealii::Point<2> place;
    /// Number of the block.
    unsigned int block = invalid_index;
    /// Name of the curve or obstacle on which the block lies.
    std::string along;
    /// Name of the curve or obstacle into which the corner would slide.
    std::string ahead;
    /// Edge of the block that ends at the corner; the next one begins there.
    unsigned int edge = invalid_index;
    /// Edge into which the corner would slide, and its end at the corner, 0 or 1.
    unsigned int ahead_edge = invalid_index, ahead_end = 0;
  };


  /**
   * Find corners of blocks that cannot slide because another face begins exactly where the face
   * below them ends. Examples are a sliding plane that ends at the toe of a slope with level ground
   * in front of it, and the tip of a wedge in a corner of its base. Such a block cannot slide
   * without penetrating the ground, however sharp its corner is. It is stable in the computation
   * where limit equilibrium, which neglects corners, predicts sliding.
   *
   * The result are convex corners at which one side lies along a face that ends there, and a face
   * of another body begins less than 60 degrees off the direction of sliding, which goes into that
   * body. What is on the other side of the corner does not matter, since it may move away, unless it
   * is that face itself: then the whole side of the block rests on it. Directions against @p gravity
   * (any unit) do not count; if @p gravity is zero, all directions count. Positions are those of the
   * reference configuration.
   * Cost: O(n log n) for n edges.
   */
  std::vector<LockedCorner>
  find_locked_corners(const ContactSurface       &surface,
                      const dealii::Tensor<1, 2> &gravity);
} // namespace NMM

#endif
