#include <nmm/contact/diagnostics/locked_corners.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Sine of half a degree: directions that differ by less are equal.
    constexpr double same_direction = 0.01;


    /// An end of an edge.
    struct End
    {
      Point<2>     x;
      unsigned int edge = invalid_index, end = 0;
      /// Unit vectors: along the edge away from this end, and out of its body.
      Tensor<1, 2> away, normal;
    };


    std::vector<End>
    sorted_ends(const ContactSurface &surface)
    {
      std::vector<End> result;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
        for (const unsigned int end : {0U, 1U})
        {
          const auto   place = surface.reference_place(e, end);
          Tensor<1, 2> away  = place.a / place.a.norm();
          if (end == 1)
            away *= -1.;
          result.push_back({place.x, e, end, away, place.normal()});
        }
      std::sort(result.begin(), result.end(), [](const End &a, const End &b) {
        return a.x[0] < b.x[0];
      });
      return result;
    }


    /// Whether a side of a corner lies on the face that begins at the same point.
    bool
    lies_on(const End &side, const End &face)
    {
      return side.normal * face.normal < 0. && side.away * face.away > 0. &&
             std::abs(side.away * face.normal) < same_direction;
    }
  } // namespace


  std::vector<LockedCorner>
  find_locked_corners(const ContactSurface &surface,
                      const Tensor<1, 2>   &gravity)
  {
    // Fraction of an edge: ends that are nearer to each other are one point.
    constexpr double rounding = 1e-9;
    // cosine of 60 degrees
    constexpr double least_ahead = 0.5;

    const auto            &edges = surface.edges();
    const std::vector<End> ends  = sorted_ends(surface);
    std::vector<End>       near;
    // Find the faces of other bodies at a corner.
    const auto find_near = [&](const End &corner) {
      near.clear();
      const double same = rounding * edges[corner.edge].length;
      for (auto other = std::lower_bound(ends.begin(),
                                         ends.end(),
                                         corner.x[0] - same,
                                         [](const End &end, const double x) {
                                           return end.x[0] < x;
                                         });
           other != ends.end() && other->x[0] <= corner.x[0] + same;
           ++other)
        if (edges[other->edge].body != edges[corner.edge].body &&
            std::abs(other->x[1] - corner.x[1]) <= same)
          near.push_back(*other);
    };
    // Whether a direction goes from the corner into the body of a face that begins there.
    const auto goes_into = [&](const Tensor<1, 2> &way, const End &face) {
      const auto        &e     = edges[face.edge];
      const unsigned int other = face.end == 0 ? e.previous : e.next;
      if (other == invalid_index)
        return true;
      const auto         place = surface.reference_place(other, 1. - face.end);
      const Tensor<1, 2> away =
        (face.end == 0 ? -1. : 1.) * place.a / place.a.norm();
      // The interior is to the left of the edge that begins at the corner.
      const Tensor<1, 2> &first = face.end == 0 ? face.away : away,
                         &last  = face.end == 0 ? away : face.away;
      const auto angle          = [&](const Tensor<1, 2> &d) {
        const double turn = std::atan2(internal::cross(first, d), first * d);
        return turn < 0. ? turn + 2. * dealii::numbers::PI : turn;
      };
      return angle(way) > same_direction &&
             angle(way) < angle(last) - same_direction;
    };

    std::vector<LockedCorner> result;
    for (const End &corner : ends)
    {
      const auto &edge = edges[corner.edge];
      if (corner.end != 1 || surface.is_rigid(corner.edge) ||
          edge.at_end != ContactSurface::Corner::convex)
        continue;
      find_near(corner);
      if (near.size() < 2)
        continue;
      const auto place = surface.reference_place(edge.next, 0.);
      const End  next{
        place.x, edge.next, 0, place.a / place.a.norm(), place.normal()};
      for (const auto &[side, other] :
           {std::make_pair(corner, next), std::make_pair(next, corner)})
      {
        const Tensor<1, 2> way = -side.away;
        if (gravity * way < 0.)
          continue;
        const auto along =
          std::find_if(near.begin(), near.end(), [&](const End &face) {
            return lies_on(side, face);
          });
        const auto ahead =
          std::find_if(near.begin(), near.end(), [&](const End &face) {
            return way * face.normal < -same_direction &&
                   way * face.away > least_ahead && !lies_on(other, face) &&
                   goes_into(way, face);
          });
        if (along != near.end() && ahead != near.end())
          result.push_back({corner.x,
                            edge.body,
                            surface.name(along->edge),
                            surface.name(ahead->edge),
                            corner.edge,
                            ahead->edge,
                            ahead->end});
      }
    }
    return result;
  }
} // namespace NMM
