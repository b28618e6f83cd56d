#ifndef nmm_contact_locked_corners_h
#define nmm_contact_locked_corners_h

#include <nmm/contact/contact_surface.h>

#include <string>
#include <vector>

namespace NMM
{
  /// See find_locked_corners().
  struct LockedCorner
  {
    dealii::Point<2> place;
    unsigned int     block = invalid_index;
    /// Names of the face it lies on, and of the one that it would run into.
    std::string along, ahead;
  };


  /**
   * Corners of blocks that lie on a face of another body exactly as far as that face goes, where
   * another face begins that rises before them: a sliding plane that ends at the toe of a slope
   * with level ground before it, the point of a wedge in a corner of its base. A block cannot
   * slide that way without going into the ground, however sharp its corner: the corner bears as
   * much as the ground does, and the block stands where limit equilibrium, which knows no
   * corners, lets it slide.
   *
   * Found are convex corners at which one side lies along a face that ends there, the other side
   * is free, and another body's face is less than 60 degrees ahead of the way down the first one.
   * Uphill, against @p gravity, nothing slides; zero: every way counts. In the reference
   * configuration. Cost: O(n log n) for n edges.
   */
  std::vector<LockedCorner>
  find_locked_corners(const ContactSurface       &surface,
                      const dealii::Tensor<1, 2> &gravity);
} // namespace NMM

#endif
