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
     * Solid faces that are smaller than coordinates can tell apart: those that
     * enclose no more than area_rounding(). The topology is exact, so that three
     * lines drawn through one point, with rounded digits, make a triangle whose
     * corners are one point in doubles, and a line drawn twice makes a strip.
     *
     * Such a face is united with the solid face that it shares the longest
     * boundary with. Of boundaries at least half as long as that, interfaces are
     * given up first, then joints, then boundaries of domains: what the curves on
     * the other sides of it separate or bond stays separate or bonded, as if the
     * lines met in one point, or were one. What is still tiny then is united further;
     * what has no solid neighbour does not count as solid.
     *
     * Cost: O(n) for n edges if there is none, else O(n log n).
     */
    class TinyFaces
    {
    public:
      TinyFaces(const LabelledFaces &faces, const std::vector<Curve> &curves);

      /// The face, larger than all others united with it, in which a face counts:
      /// mostly itself; invalid_index if it does not count as solid.
      unsigned int
      owner(unsigned int face) const;

      /// Of all faces united with it [m^2].
      double
      area(unsigned int owner) const;

      /// Sentences for people, if there are any.
      std::vector<std::string>
      notices() const;

      /// Remove the edges between faces that are united. Handles of @p faces are
      /// out of date after this.
      void
      remove_edges(Arrangement &arrangement) const;

    private:
      void
      unite();

      /// The group to unite a tiny one with, or invalid_index.
      unsigned int
      neighbor(unsigned int group) const;

      unsigned int
      find(unsigned int face) const;

      const LabelledFaces              &faces;
      const std::vector<Curve>         &curves;
      mutable std::vector<unsigned int> parent;
      /// By representative: face of the largest area, edges around, area, rounding.
      std::vector<unsigned int>              largest;
      std::vector<std::vector<unsigned int>> group_edges;
      std::vector<double>                    areas, roundings;
      std::vector<unsigned int>              tiny;
      std::vector<bool>                      is_dropped;
    };


    /// Width of the face if it is a strip: of length l and width w it has an area of
    /// l w and a perimeter of 2 l [m].
    double
    width_of_strip(const LabelledFaces::Face &face);

    /// Is the face less than a millionth of its length wide?
    bool
    is_sliver(const LabelledFaces::Face &face);

    /// A notice of slivers among faces that are regions, which must not be empty.
    std::string
    describe_slivers(const LabelledFaces             &faces,
                     const std::vector<unsigned int> &slivers,
                     const std::vector<Curve>        &curves);
  } // namespace internal
} // namespace NMM

#endif
