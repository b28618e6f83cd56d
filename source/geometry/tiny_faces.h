#ifndef nmm_source_geometry_tiny_faces_h
#define nmm_source_geometry_tiny_faces_h

#include "geometry/face_labels.h"
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Solid faces that are smaller than the rounding of coordinates: those that enclose no more
     * than area_rounding(). The topology is exact, so that three lines drawn through one point,
     * with rounded digits, form a triangle whose corners are one point in doubles, and a line drawn
     * twice forms a strip.
     *
     * Such a face is united with the solid face with which it has the longest common boundary. Of
     * boundaries at least half as long as that, interfaces are given up first, then joints, then
     * boundaries of domains. Curves on the other sides of the face thus keep separating or bonding
     * the regions, as if the lines met in one point, or were one. Faces that are still tiny are
     * united further; those without a solid neighbour do not count as solid.
     *
     * Cost: O(n) for n edges if there is no such face, else O(n log n).
     */
    class TinyFaces
    {
    public:
      TinyFaces(const LabelledFaces &faces, const std::vector<Curve> &curves);

      /// The face to which a face belongs: the largest of all faces united with it, mostly itself;
      /// invalid_index if it does not count as solid.
      unsigned int
      owner(unsigned int face) const;

      /// Area of all faces united with a face [m^2].
      double
      area(unsigned int owner) const;

      /// Sentences for the user about united faces; empty if there are none.
      std::vector<std::string>
      notices() const;

      /// Remove the edges between united faces. Handles of @p faces are invalid after this.
      void
      remove_edges(Arrangement &arrangement) const;

    private:
      void
      unite();

      /// The group of faces with which a tiny one is united, or invalid_index.
      unsigned int
      neighbor(unsigned int group) const;

      unsigned int
      find(unsigned int face) const;

      const LabelledFaces              &faces;
      const std::vector<Curve>         &curves;
      mutable std::vector<unsigned int> parent;
      /// By representative of a group: its largest face, edges around it, area, and rounding of the
      /// area.
      std::vector<unsigned int>              largest;
      std::vector<std::vector<unsigned int>> group_edges;
      std::vector<double>                    areas, roundings;
      std::vector<unsigned int>              tiny;
      std::vector<bool>                      is_dropped;
    };


    /// Width of the face if it is a strip [m]: a strip of length l and width w has the area l w and
    /// the perimeter 2 l.
    double
    width_of_strip(const LabelledFaces::Face &face);

    /// Whether the width of the face is less than a millionth of its length.
    bool
    is_sliver(const LabelledFaces::Face &face);

    /// A notice about slivers among the faces that are regions; @p slivers must not be empty.
    std::string
    describe_slivers(const LabelledFaces             &faces,
                     const std::vector<unsigned int> &slivers,
                     const std::vector<Curve>        &curves);
  } // namespace internal
} // namespace NMM

#endif
