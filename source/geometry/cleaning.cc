#include <nmm/base/types.h>
#include <nmm/geometry/geometry.h>

#include "geometry/curve.h"
#include "geometry/piece_geometry.h"
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <utility>

namespace NMM
{
  namespace
  {
    /**
     * The algorithm of clean(). Pieces are stored in doubly linked lists, one per curve, so that
     * pieces can be split and removed while a search tree of their boxes stays valid.
     *
     * Cost: O((n + changes) log n).
     */
    class Cleaner
    {
    public:
      Cleaner(std::vector<Curve> &curves, double tolerance);

      std::vector<CleaningAction>
      run();

    private:
      using Point = dealii::Point<2>;
      using Kind  = CleaningAction::Kind;

      struct Link
      {
        CurvePiece   piece;
        unsigned int curve = invalid_index;
        unsigned int prev = invalid_index, next = invalid_index;
      };

      /// One of the two ends of an open curve.
      struct End
      {
        unsigned int curve;
        bool         at_start;
      };

      using TreePoint = boost::geometry::model::
        point<double, 2, boost::geometry::cs::cartesian>;
      using TreeBox   = boost::geometry::model::box<TreePoint>;
      using TreeValue = std::pair<TreeBox, unsigned int>;

      void
      remove_short_pieces(unsigned int curve);
      void
      close_gap(const End &end);
      void
      snap_to_vertex(const End &end);
      void
      snap_to_curve(const End &end);

      bool
      is_open(unsigned int curve) const;
      const Point &
      location(const End &end) const;
      unsigned int
      link_at(const End &end) const;
      std::vector<End>
      open_ends() const;

      /// Pieces whose box is within the tolerance of @p point, ascending.
      std::vector<unsigned int>
      links_near(const Point &point) const;
      /// Whether the end is exactly on another curve or on the other end of its own.
      bool
      is_attached(const End &end) const;
      bool
      move(const End &end, const Point &point, Kind kind);
      void
      split(unsigned int link, const Point &point);
      void
      unlink(unsigned int link);
      void
      replace(unsigned int link, const CurvePiece &piece);
      unsigned int
      append(const CurvePiece &piece, unsigned int curve);
      TreeValue
      tree_value(unsigned int link) const;
      void
      store();

      std::vector<Curve>       &curves;
      const double              tolerance;
      std::vector<Link>         links;
      std::vector<unsigned int> first, last;
      boost::geometry::index::rtree<TreeValue,
                                    boost::geometry::index::quadratic<16>>
                                  tree;
      std::vector<CleaningAction> actions;
    };


    Cleaner::Cleaner(std::vector<Curve> &curves, const double tolerance)
      : curves(curves)
      , tolerance(tolerance)
      , first(curves.size(), invalid_index)
      , last(curves.size(), invalid_index)
    {
      std::vector<TreeValue> values;
      for (unsigned int c = 0; c < curves.size(); ++c)
        for (const CurvePiece &piece : curves[c].pieces)
          values.push_back(tree_value(append(piece, c)));
      tree = decltype(tree)(values);
    }


    std::vector<CleaningAction>
    Cleaner::run()
    {
      for (unsigned int c = 0; c < curves.size(); ++c)
        remove_short_pieces(c);
      // Boundaries come first, so that joints snap to their final positions.
      for (const End &end : open_ends())
        close_gap(end);
      for (const End &end : open_ends())
        snap_to_vertex(end);
      for (const End &end : open_ends())
        snap_to_curve(end);
      store();
      return std::move(actions);
    }


    unsigned int
    Cleaner::append(const CurvePiece &piece, const unsigned int curve)
    {
      const unsigned int link = links.size();
      links.push_back({piece, curve, last[curve], invalid_index});
      if (last[curve] != invalid_index)
        links[last[curve]].next = link;
      else
        first[curve] = link;
      last[curve] = link;
      return link;
    }


    Cleaner::TreeValue
    Cleaner::tree_value(const unsigned int link) const
    {
      const auto corners = internal::corners_around(links[link].piece);
      return {TreeBox(TreePoint(corners[0][0], corners[0][1]),
                      TreePoint(corners[1][0], corners[1][1])),
              link};
    }


    bool
    Cleaner::is_open(const unsigned int curve) const
    {
      return first[curve] != invalid_index &&
             links[first[curve]].piece.start != links[last[curve]].piece.end;
    }


    unsigned int
    Cleaner::link_at(const End &end) const
    {
      return end.at_start ? first[end.curve] : last[end.curve];
    }


    const dealii::Point<2> &
    Cleaner::location(const End &end) const
    {
      const CurvePiece &piece = links[link_at(end)].piece;
      return end.at_start ? piece.start : piece.end;
    }


    std::vector<Cleaner::End>
    Cleaner::open_ends() const
    {
      std::vector<End> ends;
      for (unsigned int c = 0; c < curves.size(); ++c)
        if (is_open(c))
        {
          ends.push_back({c, true});
          ends.push_back({c, false});
        }
      return ends;
    }


    std::vector<unsigned int>
    Cleaner::links_near(const Point &point) const
    {
      // Boxes of arcs are rounded; pieces that are too far away are rejected later.
      const double           reach = 1.01 * tolerance;
      std::vector<TreeValue> found;
      tree.query(boost::geometry::index::intersects(
                   TreeBox(TreePoint(point[0] - reach, point[1] - reach),
                           TreePoint(point[0] + reach, point[1] + reach))),
                 std::back_inserter(found));
      std::vector<unsigned int> near;
      for (const TreeValue &value : found)
        near.push_back(value.second);
      std::sort(near.begin(), near.end());
      return near;
    }


    bool
    Cleaner::is_attached(const End &end) const
    {
      if (!is_open(end.curve))
        return true;
      const Point &point = location(end);
      for (const unsigned int link : links_near(point))
        if (links[link].curve != end.curve &&
            internal::lies_exactly_on(links[link].piece, point))
          return true;
      return false;
    }


    void
    Cleaner::replace(const unsigned int link, const CurvePiece &piece)
    {
      tree.remove(tree_value(link));
      links[link].piece = piece;
      tree.insert(tree_value(link));
    }


    void
    Cleaner::unlink(const unsigned int link)
    {
      tree.remove(tree_value(link));
      const Link gone = links[link];
      (gone.prev == invalid_index ? first[gone.curve] : links[gone.prev].next) =
        gone.next;
      (gone.next == invalid_index ? last[gone.curve] : links[gone.next].prev) =
        gone.prev;
    }


    void
    Cleaner::split(const unsigned int link, const Point &point)
    {
      const auto         parts  = internal::split(links[link].piece, point);
      const unsigned int second = links.size();
      const unsigned int curve  = links[link].curve;
      links.push_back({parts.second, curve, link, links[link].next});
      replace(link, parts.first);
      (links[link].next == invalid_index ? last[curve]
                                         : links[links[link].next].prev) =
        second;
      links[link].next = second;
      tree.insert(tree_value(second));
    }


    bool
    Cleaner::move(const End &end, const Point &point, const Kind kind)
    {
      const unsigned int link = link_at(end);
      const Point        from = location(end);
      if (from != point)
      {
        const CurvePiece moved =
          internal::with_moved_end(links[link].piece, end.at_start, point);
        if (!internal::is_valid(moved))
          return false;
        replace(link, moved);
      }
      actions.push_back(
        {kind, curves[end.curve].name, from, point, from.distance(point)});
      return true;
    }


    void
    Cleaner::remove_short_pieces(const unsigned int curve)
    {
      const CurveRole role = curves[curve].role;
      unsigned int    n    = curves[curve].pieces.size();
      for (unsigned int link = first[curve]; link != invalid_index;)
      {
        const unsigned int next = links[link].next;
        const CurvePiece   gone = links[link].piece;
        const double       size = internal::length(gone);
        // Keep enough pieces that a boundary does not vanish and a loop does not become a sliver.
        const unsigned int n_min =
          !is_open(curve)                                            ? 3
          : role == CurveRole::joint || role == CurveRole::interface ? 0
                                                                     : 1;
        if (size > tolerance || n <= n_min)
        {
          link = next;
          continue;
        }
        // The ends of the curve keep their positions.
        const unsigned int prev = links[link].prev;
        if (next == invalid_index && prev != invalid_index)
        {
          const CurvePiece joined =
            internal::with_moved_end(links[prev].piece, false, gone.end);
          if (!internal::is_valid(joined))
            return;
          replace(prev, joined);
        }
        else if (next != invalid_index)
        {
          const CurvePiece joined =
            internal::with_moved_end(links[next].piece, true, gone.start);
          if (!internal::is_valid(joined))
          {
            link = next;
            continue;
          }
          replace(next, joined);
        }
        unlink(link);
        --n;
        actions.push_back({Kind::removed_piece,
                           curves[curve].name,
                           gone.start,
                           gone.end,
                           size});
        link = next;
      }
    }


    void
    Cleaner::close_gap(const End &end)
    {
      const CurveRole role = curves[end.curve].role;
      if ((role != CurveRole::boundary && role != CurveRole::hole) ||
          !is_open(end.curve))
        return;

      const Point point    = location(end);
      Point       target   = point;
      double      distance = tolerance;
      for (const unsigned int link : links_near(point))
      {
        const unsigned int other = links[link].curve;
        if (curves[other].role != role || !is_open(other))
          continue;
        for (const bool at_start : {true, false})
        {
          const End other_end = {other, at_start};
          if (link_at(other_end) != link ||
              (other == end.curve && at_start == end.at_start))
            continue;
          if (location(other_end) == point)
            return;
          if (point.distance(location(other_end)) <= distance)
          {
            target   = location(other_end);
            distance = point.distance(target);
          }
        }
      }
      if (target != point)
        move(end, target, Kind::snapped_to_vertex);
    }


    void
    Cleaner::snap_to_vertex(const End &end)
    {
      const CurveRole role = curves[end.curve].role;
      if (role == CurveRole::boundary || role == CurveRole::hole ||
          is_attached(end))
        return;

      const Point        point    = location(end);
      Point              target   = point;
      double             distance = tolerance;
      const unsigned int other_end =
        end.at_start ? last[end.curve] : first[end.curve];
      for (const unsigned int link : links_near(point))
      {
        const CurvePiece &piece = links[link].piece;
        // Only the other end of the same curve is a candidate, and no point of a circle is a
        // vertex.
        const bool is_own = links[link].curve == end.curve;
        for (const bool at_start : {true, false})
        {
          if (piece.kind == CurvePiece::Kind::circle ||
              (is_own && (link != other_end || at_start == end.at_start ||
                          first[end.curve] == last[end.curve])))
            continue;
          const Point &vertex = at_start ? piece.start : piece.end;
          if (point.distance(vertex) <= distance)
          {
            target   = vertex;
            distance = point.distance(vertex);
          }
        }
      }
      if (target != point)
        move(end, target, Kind::snapped_to_vertex);
    }


    void
    Cleaner::snap_to_curve(const End &end)
    {
      const CurveRole role = curves[end.curve].role;
      if (role == CurveRole::boundary || role == CurveRole::hole ||
          is_attached(end))
        return;

      const Point       point = location(end);
      const CurvePiece &own   = links[link_at(end)].piece;

      // Use the crossing nearest to the end, or else the nearest curve.
      unsigned int crossed = invalid_index, nearest = invalid_index;
      Point        crossing;
      double       to_crossing = tolerance, to_nearest = tolerance;
      for (const unsigned int link : links_near(point))
      {
        if (links[link].curve == end.curve)
          continue;
        const CurvePiece &other = links[link].piece;
        for (const Point &candidate : internal::crossings(own, other))
          if (point.distance(candidate) <= to_crossing)
          {
            crossed     = link;
            crossing    = candidate;
            to_crossing = point.distance(candidate);
          }
        const double distance =
          point.distance(internal::nearest_point(other, point));
        if (distance <= to_nearest)
        {
          nearest    = link;
          to_nearest = distance;
        }
      }

      const bool is_overshoot = crossed != invalid_index;
      if (!is_overshoot && nearest == invalid_index)
        return;
      const unsigned int link   = is_overshoot ? crossed : nearest;
      const CurvePiece   other  = links[link].piece;
      Point              target = crossing;
      if (!is_overshoot)
      {
        target = internal::continuation(own, end.at_start, other, tolerance);
        if (target == point)
          target = internal::nearest_point(other, point);
      }

      // A split must leave two pieces; a target next to a vertex is replaced by the vertex.
      bool must_split = true;
      if (other.kind != CurvePiece::Kind::circle)
        for (const Point &vertex : {other.start, other.end})
          if (target.distance(vertex) <= 1e-6 * tolerance)
          {
            target     = vertex;
            must_split = false;
          }
      if (must_split)
      {
        const auto parts = internal::split(other, target);
        if (!internal::is_valid(parts.first) ||
            !internal::is_valid(parts.second))
          return;
      }
      if (move(end,
               target,
               is_overshoot ? Kind::trimmed_overshoot
                            : Kind::extended_to_curve) &&
          must_split)
        split(link, target);
    }


    void
    Cleaner::store()
    {
      std::vector<Curve> kept;
      for (unsigned int c = 0; c < curves.size(); ++c)
      {
        curves[c].pieces.clear();
        for (unsigned int link = first[c]; link != invalid_index;
             link              = links[link].next)
          curves[c].pieces.push_back(links[link].piece);
        if (!curves[c].pieces.empty())
          kept.push_back(std::move(curves[c]));
      }
      curves = std::move(kept);
    }
  } // namespace


  std::string
  CleaningAction::description() const
  {
    const std::string who   = "'" + curve + "'";
    const std::string moved = " from " + to_string(from) + " to " +
                              to_string(to) + ", " +
                              internal::describe_length(distance);
    switch (kind)
    {
      case Kind::snapped_to_vertex:
        return "end of " + who + " snapped to a vertex" + moved;
      case Kind::extended_to_curve:
        return "end of " + who + " moved onto a curve" + moved;
      case Kind::trimmed_overshoot:
        return "overshoot of " + who + " trimmed" + moved;
      case Kind::removed_piece:
        return "short piece of " + who + " removed," + moved;
      case Kind::merged_block: {
        std::ostringstream text;
        text << "block of " << area << " m^2 at " << to_string(from)
             << " became a part of the one at " << to_string(to) << ", behind "
             << internal::describe_length(distance) << " of " << who;
        return text.str();
      }
    }
    Assert(false, dealii::ExcInternalError());
    return "";
  }


  std::vector<CleaningAction>
  clean(Geometry &geometry, const double tolerance)
  {
    AssertThrow(tolerance >= 0. && std::isfinite(tolerance),
                InputError("the cleaning tolerance is " +
                             internal::describe_length(tolerance),
                           "",
                           "give a length that is not negative, 0 for none"));
    if (tolerance == 0.)
      return {};
    for (const Curve &curve : geometry.curves())
      curve.check();
    return Cleaner(geometry.curves(), tolerance).run();
  }
} // namespace NMM
