#include <algorithm>
#include <contact/surface/rounded_corners.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Edges from @p edge on, in one direction along the boundary, that begin within @p distance
      /// [m] of the place where the first one begins.
      void
      append_within(const ContactSurface      &surface,
                    const unsigned int         edge,
                    const bool                 forward,
                    const double               distance,
                    std::vector<unsigned int> &result)
      {
        const auto  &edges = surface.edges();
        double       way   = 0.;
        unsigned int e     = edge;
        while (e != invalid_index && way <= distance &&
               std::find(result.begin(), result.end(), e) == result.end())
        {
          result.push_back(e);
          way += edges[e].length;
          e = forward ? edges[e].next : edges[e].previous;
        }
      }
    } // namespace


    RoundedCorners::RoundedCorners(const ContactSurface            &surface,
                                   const std::vector<LockedCorner> &locked,
                                   const double                     radius)
      : surface(&surface)
      , radius(radius)
      , of_edge(locked.empty() ? 0 : surface.edges().size())
    {
      for (const LockedCorner &corner : locked)
      {
        const unsigned int next = surface.edges()[corner.edge].next;
        Corner             result;
        result.place = corner.place;
        append_within(surface, corner.edge, false, radius, result.edges);
        append_within(surface, next, true, radius, result.edges);
        append_within(surface,
                      corner.ahead_edge,
                      corner.ahead_end == 0,
                      2. * radius,
                      result.ahead);
        for (const auto *edges : {&result.edges, &result.ahead})
          for (const unsigned int e : *edges)
            of_edge[e].push_back(corners.size());
        corners.push_back(std::move(result));
      }
    }


    dealii::ArrayView<const unsigned int>
    RoundedCorners::excluded(const unsigned int edge, const double s) const
    {
      if (of_edge.empty())
        return {};
      for (const unsigned int i : of_edge[edge])
      {
        const Corner &corner = corners[i];
        const double  distance =
          (surface->reference_place(edge, s).x - corner.place).norm();
        const bool is_ahead =
          std::find(corner.ahead.begin(), corner.ahead.end(), edge) !=
          corner.ahead.end();
        // Places ahead are passed by faces of the block within the radius of its corner.
        if (is_ahead && distance <= 2. * radius)
          return {corner.edges.data(), corner.edges.size()};
        if (!is_ahead && distance <= radius)
          return {corner.ahead.data(), corner.ahead.size()};
      }
      return {};
    }
  } // namespace internal
} // namespace NMM
