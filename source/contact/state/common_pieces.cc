#include <nmm/base/exceptions.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <contact/state/common_pieces.h>
#include <limits>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      /// Number of edges that belong to blocks; those of obstacles follow.
      unsigned int
      n_edges_of_blocks(const ContactSurface &surface)
      {
        unsigned int n = surface.edges().size();
        while (n > 0 && surface.is_rigid(n - 1))
          --n;
        return n;
      }


      bool
      is_same_curve(const ContactSurface::Edge &a,
                    const ContactSurface::Edge &b)
      {
        return a.start == b.start && a.end == b.end && a.radius == b.radius &&
               (a.radius == 0. ||
                (a.center == b.center && a.first_angle == b.first_angle &&
                 a.last_angle == b.last_angle));
      }


      /// Parameters of the start and the end of the edge @p after on the edge @p before. Returns
      /// false if both do not lie on the same line or do not look the same way.
      bool
      find_ends_on_line(const ContactSurface::Edge &before,
                        const ContactSurface::Edge &after,
                        const double                tolerance,
                        std::array<double, 2>      &ends)
      {
        constexpr double same_way = 0.9;
        // The direction of the longer edge has less rounding.
        const auto        &line = before.length > after.length ? before : after;
        const Tensor<1, 2> tangent = (line.end - line.start) / line.length;
        for (const auto &edge : {before, after})
        {
          if ((edge.end - edge.start) * tangent <= same_way * edge.length)
            return false;
          for (const Point<2> &x : {edge.start, edge.end})
          {
            const Tensor<1, 2> d = x - line.start;
            if (std::abs(d[0] * tangent[1] - d[1] * tangent[0]) > tolerance)
              return false;
          }
        }
        const double length = (before.end - before.start) * tangent;
        ends                = {{(after.start - before.start) * tangent / length,
                                (after.end - before.start) * tangent / length}};
        return true;
      }


      /// The same for arcs.
      bool
      find_ends_on_circle(const ContactSurface::Edge &before,
                          const ContactSurface::Edge &after,
                          const double                tolerance,
                          std::array<double, 2>      &ends)
      {
        if (std::abs(before.radius - after.radius) > tolerance ||
            before.center.distance(after.center) > tolerance)
          return false;
        constexpr double turn  = 2. * dealii::numbers::PI;
        const double     range = before.last_angle - before.first_angle;
        const double     other = after.last_angle - after.first_angle;
        // The first angles may differ by whole turns, of which at most two let both overlap.
        double shift = std::fmod(after.first_angle - before.first_angle, turn);
        double most  = 0.;
        for (const double turns : {-turn, 0., turn})
        {
          const double begin  = (shift + turns) / range;
          const double end    = (shift + turns + other) / range;
          const double common = std::min(1., end) - std::max(0., begin);
          if (common > most)
          {
            most = common;
            ends = {{begin, end}};
          }
        }
        return most > 0.;
      }


      /// Find the common piece of two edges. Returns false if there is none.
      bool
      find_common_piece(const ContactSurface::Edge &before,
                        const ContactSurface::Edge &after,
                        CommonPiece                &piece)
      {
        constexpr double relative = 1e-9, rounding = 1e-15;
        const double     tolerance =
          relative * (before.length + after.length) +
          rounding * (std::abs(after.start[0]) + std::abs(after.start[1]));
        std::array<double, 2> t;
        if ((before.radius == 0.) != (after.radius == 0.) ||
            !(before.radius == 0.
                ? find_ends_on_line(before, after, tolerance, t)
                : find_ends_on_circle(before, after, tolerance, t)))
          return false;

        const double at_end = tolerance / before.length;
        for (unsigned int end = 0; end < 2; ++end)
        {
          const double ends_here = end;
          const double beyond    = end == 0 ? -t[0] : t[1] - 1.;
          if (beyond < -at_end)
          {
            piece.of_before[end] = t[end];
            piece.of_after[end]  = ends_here;
          }
          else
          {
            piece.of_before[end] = ends_here;
            piece.of_after[end] =
              beyond <= at_end ? ends_here : (ends_here - t[0]) / (t[1] - t[0]);
          }
        }
        const double length =
          (piece.of_before[1] - piece.of_before[0]) * before.length;
        return length > std::min(2. * tolerance,
                                 0.5 * std::min(before.length, after.length));
      }


      /// Of pieces that overlap, keep the longest one: next to very short edges the tolerance may
      /// admit two.
      void
      sort_pieces(std::vector<CommonPiece> &pieces)
      {
        const auto length = [](const CommonPiece &piece) {
          return piece.of_after[1] - piece.of_after[0];
        };
        std::sort(pieces.begin(),
                  pieces.end(),
                  [](const CommonPiece &a, const CommonPiece &b) {
                    return a.of_after[0] != b.of_after[0]
                             ? a.of_after[0] < b.of_after[0]
                             : a.before < b.before;
                  });
        std::vector<CommonPiece> kept;
        for (const CommonPiece &piece : pieces)
        {
          const double overlap =
            kept.empty() ? 0. : kept.back().of_after[1] - piece.of_after[0];
          if (kept.empty() ||
              overlap <= 0.5 * std::min(length(kept.back()), length(piece)))
            kept.push_back(piece);
          else if (length(piece) > length(kept.back()))
            kept.back() = piece;
        }
        pieces = std::move(kept);
      }
    } // namespace


    CommonPieces::CommonPieces(const ContactSurface &from,
                               const ContactSurface &to)
      : pieces_of_before(from.edges().size())
      , pieces_of_after(to.edges().size())
      , same_edges(from.edges().size(), invalid_index)
    {
      match_blocks(from, to);
      match_obstacles(from, to);
      for (const auto &pieces : pieces_of_after)
        for (const CommonPiece &piece : pieces)
        {
          pieces_of_before[piece.before].push_back(piece);
          if (is_same_curve(from.edges()[piece.before],
                            to.edges()[piece.after]))
            same_edges[piece.before] = piece.after;
        }
      for (auto &pieces : pieces_of_before)
        std::sort(pieces.begin(),
                  pieces.end(),
                  [](const CommonPiece &a, const CommonPiece &b) {
                    return a.of_before[0] < b.of_before[0];
                  });
    }


    void
    CommonPieces::match_blocks(const ContactSurface &from,
                               const ContactSurface &to)
    {
      namespace bg = boost::geometry;
      using Vertex = bg::model::point<double, 2, bg::cs::cartesian>;
      using Bounds = bg::model::box<Vertex>;
      using Item   = std::pair<Bounds, unsigned int>;

      const auto bounds_of = [](const ContactSurface &surface,
                                const unsigned int    edge) {
        // Samples in between and the largest distance of an arc from its chords between them.
        constexpr unsigned int n        = 4;
        constexpr double       relative = 1e-8;
        Point<2>               lower, upper;
        double                 margin = relative * surface.edges()[edge].length;
        for (unsigned int i = 0; i <= n; ++i)
        {
          const ContactSurface::Place place =
            surface.reference_place(edge, i / double(n));
          margin = std::max(margin, place.b.norm() / (8. * n * n));
          for (unsigned int c = 0; c < 2; ++c)
          {
            lower[c] = i == 0 ? place.x[c] : std::min(lower[c], place.x[c]);
            upper[c] = i == 0 ? place.x[c] : std::max(upper[c], place.x[c]);
          }
        }
        return Bounds(Vertex(lower[0] - margin, lower[1] - margin),
                      Vertex(upper[0] + margin, upper[1] + margin));
      };
      std::vector<Item>  items;
      const unsigned int n_before = n_edges_of_blocks(from),
                         n_after  = n_edges_of_blocks(to);
      for (unsigned int e = 0; e < n_before; ++e)
        items.emplace_back(bounds_of(from, e), e);
      const bg::index::rtree<Item, bg::index::rstar<16>> tree(items);
      std::vector<Item>                                  found;
      for (unsigned int e = 0; e < n_after; ++e)
      {
        found.clear();
        tree.query(bg::index::intersects(bounds_of(to, e)),
                   std::back_inserter(found));
        for (const auto &[bounds, before] : found)
        {
          CommonPiece piece;
          piece.before = before;
          piece.after  = e;
          if (find_common_piece(from.edges()[before], to.edges()[e], piece))
            pieces_of_after[e].push_back(piece);
        }
        sort_pieces(pieces_of_after[e]);
      }
    }


    void
    CommonPieces::match_obstacles(const ContactSurface &from,
                                  const ContactSurface &to)
    {
      const unsigned int n_before = n_edges_of_blocks(from),
                         n_after  = n_edges_of_blocks(to);
      const unsigned int n        = from.edges().size() - n_before;
      bool               is_same  = to.edges().size() - n_after == n &&
                     from.obstacles().size() == to.obstacles().size();
      for (unsigned int i = 0; i < n && is_same; ++i)
        is_same =
          is_same_curve(from.edges()[n_before + i], to.edges()[n_after + i]);
      AssertThrow(
        is_same,
        InputError("The obstacles before and after a cut differ",
                   "the contact history",
                   "make both contact surfaces with the same obstacles"));
      for (unsigned int i = 0; i < n; ++i)
      {
        CommonPiece piece;
        piece.before = n_before + i;
        piece.after  = n_after + i;
        pieces_of_after[piece.after].push_back(piece);
      }
    }


    unsigned int
    CommonPieces::edge_at_end(const unsigned int before,
                              const unsigned int end) const
    {
      const auto &pieces = pieces_of_before[before];
      if (pieces.empty())
        return invalid_index;
      const CommonPiece &piece = end == 0 ? pieces.front() : pieces.back();
      return piece.of_before[end] == end && piece.of_after[end] == end
               ? piece.after
               : invalid_index;
    }


    const CommonPiece *
    CommonPieces::piece_at(const unsigned int before, const double t) const
    {
      const auto        &pieces = pieces_of_before[before];
      const CommonPiece *best   = nullptr;
      double             least  = 0.;
      for (const CommonPiece &piece : pieces)
      {
        const double distance =
          std::max({0., piece.of_before[0] - t, t - piece.of_before[1]});
        if (best == nullptr || distance < least)
        {
          best  = &piece;
          least = distance;
        }
      }
      return best;
    }
  } // namespace internal
} // namespace NMM
