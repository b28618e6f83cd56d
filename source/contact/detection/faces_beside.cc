// Overlaps of bodies that a search for the nearest faces does not find.
#include <algorithm>
#include <cmath>
#include <contact/detection/corner_rules.h>
#include <contact/detection/narrow_phase.h>
#include <limits>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;
    using Place = ContactSurface::Place;
    using namespace CornerRules;

    namespace
    {
      /// Length of the part of an edge that lies behind a face and ends at a corner of the edge [m];
      /// infinite if the edge continues behind the face beyond its end.
      double
      length_behind(const ContactSurface &surface,
                    const unsigned int    edge,
                    const Place          &face)
      {
        const auto           &at    = surface.edges()[edge];
        const ContactPosition start = surface.place(edge, 0.).x,
                              end   = surface.place(edge, 1.).x;
        const Tensor<1, 2> normal   = face.normal();
        const double       at_start = (start - face.x) * normal,
                     at_end         = (end - face.x) * normal;
        if (at_start >= 0. && at_end >= 0.)
          return 0.;
        const bool starts_behind = at_start < 0.;
        if ((starts_behind && at_end < 0.) ||
            (starts_behind ? at.at_start : at.at_end) !=
              ContactSurface::Corner::convex)
          return std::numeric_limits<double>::max();
        return start.distance(end) * std::min(at_start, at_end) /
               -std::abs(at_end - at_start);
      }
    } // namespace


    double
    NarrowPhase::gap_beyond_corner(const unsigned int     edge,
                                   const ContactPosition &x,
                                   const Tensor<1, 2>    &normal,
                                   const Tensor<1, 2>    &other_normal) const
    {
      constexpr auto smooth = ContactSurface::Corner::smooth;
      const auto    &edges  = surface->edges();
      double         result = -std::numeric_limits<double>::max();
      for (const unsigned int end : {0U, 1U})
      {
        const auto &at = edges[edge];
        if ((end == 0 ? at.at_start : at.at_end) !=
            ContactSurface::Corner::convex)
          continue;
        // The face round the corner, as far as the point is beyond its edges.
        unsigned int next = end == 0 ? at.previous : at.next;
        double       t;
        Place        place;
        bool         is_found = false, is_beyond = true;
        while (next != invalid_index && is_beyond)
        {
          is_found          = find_nearest(next, x, t, place);
          const auto &round = edges[next];
          is_beyond         = end == 0 ? t < 0. : t > 1.;
          if ((end == 0 ? round.at_start : round.at_end) != smooth)
            break;
          if (is_beyond)
            next = end == 0 ? round.previous : round.next;
        }
        if (!is_found)
          continue;
        const double gap = (x - place.x) * place.normal();
        if (gap >= 0. && can_separate(place.normal(), normal, other_normal))
          result = std::max(result, gap);
      }
      return result;
    }


    double
    NarrowPhase::depth_inside(const unsigned int     position,
                              const unsigned int     body,
                              const ContactPosition &x) const
    {
      double nearest = reach(), gap = 0.;
      for (const unsigned int master : search->masters(position))
      {
        double t;
        Place  place;
        if (surface->edges()[master].body != body ||
            surface->is_further(master, x, nearest, 0., 0.) ||
            !find_nearest(master, x, t, place))
          continue;
        const Place  end      = surface->place(master, std::clamp(t, 0., 1.));
        const double distance = x.distance(end.x);
        const double now      = (x - end.x) * end.normal();
        // At the corner of two edges, the edge with the larger normal distance determines the side.
        const bool is_tied = std::abs(distance - nearest) <= same_gap * reach();
        if (is_tied ? std::abs(now) > std::abs(gap) : distance < nearest)
        {
          nearest = distance;
          gap     = now;
        }
      }
      return gap < 0. ? nearest : 0.;
    }


    bool
    NarrowPhase::is_beside(const unsigned int     edge,
                           const ContactPosition &x,
                           const unsigned int     master,
                           const double           depth) const
    {
      const auto &edges = surface->edges();
      for (const bool forward : {true, false})
      {
        unsigned int e         = master;
        bool         is_convex = false;
        double       way       = 0.;
        while (way <= around_corner_beside * depth)
        {
          is_convex =
            is_convex || (forward ? edges[e].at_end : edges[e].at_start) ==
                           ContactSurface::Corner::convex;
          e = forward ? edges[e].next : edges[e].previous;
          if (e == invalid_index || e == master)
            break;
          double t;
          Place  place;
          if (is_convex && find_nearest(e, x, t, place) && t >= 0. && t <= 1. &&
              std::abs((x - place.x) * place.normal()) < depth &&
              length_behind(*surface, edge, place) <
                longest_overlap_beside * depth)
            return true;
          way += edges[e].length;
        }
      }
      return false;
    }


    void
    NarrowPhase::append_faces_beside(
      const unsigned int                          edge,
      const ContactPosition                      &x,
      const dealii::ArrayView<const unsigned int> masters,
      const double                                depth,
      std::vector<unsigned int>                  &faces) const
    {
      for (const unsigned int master : masters)
      {
        const Place  middle = surface->place(master, 0.5);
        const double behind = (middle.x - x) * middle.normal();
        if (behind > depth && behind <= reach() &&
            is_beside(edge, x, master, behind))
          faces.push_back(master);
      }
    }
  } // namespace internal
} // namespace NMM
