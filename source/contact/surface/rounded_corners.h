#ifndef nmm_source_contact_surface_rounded_corners_h
#define nmm_source_contact_surface_rounded_corners_h

#include <nmm/contact/diagnostics/locked_corners.h>

#include <deal.II/base/array_view.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Corners of blocks that give way, see ContactParameters::rounded_corners. The faces of the
     * block within the radius of its corner, and the faces into which the corner would slide, are no
     * contact for each other. So a block slides on as if its tip were crushed, until it has slid
     * about as far as the radius: then places of its faces beyond the radius meet the faces ahead.
     * Distances are those of the reference configuration, so that the tip stays crushed.
     */
    class RoundedCorners
    {
    public:
      /// Take the @p corners of @p surface, with their @p radius [m].
      RoundedCorners(const ContactSurface            &surface,
                     const std::vector<LockedCorner> &corners,
                     double                           radius);

      /// Faces that a point at the parameter @p s of an edge does not touch.
      dealii::ArrayView<const unsigned int>
      excluded(unsigned int edge, double s) const;

    private:
      struct Corner
      {
        dealii::Point<2>          place;
        std::vector<unsigned int> edges, ahead;
      };

      const ContactSurface *surface;
      double                radius;
      std::vector<Corner>   corners;
      /// For each edge, the corners that it belongs to or that would slide into it.
      std::vector<std::vector<unsigned int>> of_edge;
    };
  } // namespace internal
} // namespace NMM

#endif
