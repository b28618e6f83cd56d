#include <nmm/base/exceptions.h>
#include <nmm/contact/state/carried_history.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/detection/points.h>
#include <contact/detection/search.h>
#include <contact/state/common_pieces.h>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      /// The anchor of a place before the cut: its piece, null if there is none, and its parameter on the
      /// edge of that piece before the cut.
      struct Anchor
      {
        const CommonPiece *master = nullptr;
        double             t      = 0.;
      };


      /// An interval of an edge before the cut in which the history is linear.
      struct LinearHistory
      {
        double begin = 0., end = 0.;
        /// Piece of the master, and the parameters of the anchors of both ends on the edge before
        /// the cut.
        const CommonPiece    *master    = nullptr;
        std::array<double, 2> t         = {{0., 0.}};
        bool                  is_bonded = false;

        double
        anchor(const double s) const
        {
          return t[0] + (s - begin) / (end - begin) * (t[1] - t[0]);
        }
      };


      /// Carries the anchors, see carry_history().
      class StickCarrier
      {
      public:
        StickCarrier(const ContactHistory            &history,
                     const ContactSurface            &from,
                     const ContactSurface            &to,
                     const CommonPieces              &common,
                     const std::vector<unsigned int> &slave_priority);

        /// The anchors of all places after the cut.
        std::vector<ContactHistory::Stick>
        carry();

      private:
        void
        carry_corner(const ContactHistory::Stick &stick);

        void
        carry_piece(const CommonPiece &piece);

        std::vector<LinearHistory>
        linear_histories(const CommonPiece &piece) const;

        Anchor
        find_anchor(StickPlace stick, bool stays) const;

        Anchor
        anchor_at(const CommonPiece &piece, double s) const;

        double
        end_on_master(const CommonPiece &piece, double begin, double end) const;

        bool
        is_kept(unsigned int slave, unsigned int anchor) const;

        void
        add_at(const CommonPiece &piece, const LinearHistory &part, double s);

        void
        add_new_corner(const CommonPiece   &piece,
                       const LinearHistory &part,
                       unsigned int         end_of_part);

        void
        add_reversed(const CommonPiece &piece, const LinearHistory &part);

        const ContactHistory &history;
        const ContactSurface &from, &to;
        const CommonPieces   &common;
        /// Knows which of two edges is the slave after the cut.
        const ContactSearch search;
        /// Anchors along each edge before the cut, ascending.
        std::vector<std::vector<StickPlace>> places_along;
        /// Whether the anchors along an edge before the cut are copied.
        std::vector<bool>                  is_copied;
        std::vector<ContactHistory::Stick> sticks;
        /// Corners that have an anchor.
        std::set<unsigned int> known_corners;
      };


      StickCarrier::StickCarrier(
        const ContactHistory            &history,
        const ContactSurface            &from,
        const ContactSurface            &to,
        const CommonPieces              &common,
        const std::vector<unsigned int> &slave_priority)
        : history(history)
        , from(from)
        , to(to)
        , common(common)
        , search(to, slave_priority)
        , places_along(from.edges().size())
        , is_copied(from.edges().size(), true)
      {
        for (const ContactHistory::Stick &stick : history.sticks)
          if (stick.place < from.edges().size())
          {
            places_along[stick.place].push_back(
              {stick.s, stick.edge, stick.t, stick.is_bonded, stick.slip});
            const unsigned int slave = common.same_edge(stick.place);
            if (slave == invalid_index || !is_kept(slave, stick.edge))
              is_copied[stick.place] = false;
          }
        for (auto &places : places_along)
          std::sort(places.begin(),
                    places.end(),
                    [](const StickPlace &a, const StickPlace &b) {
                      return a.s < b.s;
                    });
      }


      std::vector<ContactHistory::Stick>
      StickCarrier::carry()
      {
        const unsigned int n = from.edges().size();
        for (const ContactHistory::Stick &stick : history.sticks)
          if (stick.place >= n)
            carry_corner(stick);
          else if (is_copied[stick.place])
          {
            sticks.push_back(stick);
            sticks.back().place = common.same_edge(stick.place);
            sticks.back().edge  = common.same_edge(stick.edge);
          }
        for (unsigned int e = 0; e < to.edges().size(); ++e)
          for (const CommonPiece &piece : common.of_after(e))
            if (!is_copied[piece.before])
              carry_piece(piece);
        return std::move(sticks);
      }


      /// Whether the edge of an anchor of @p slave, an edge after the cut, is the same as before and
      /// still the master.
      bool
      StickCarrier::is_kept(const unsigned int slave,
                            const unsigned int anchor) const
      {
        const unsigned int master = common.same_edge(anchor);
        return master != invalid_index && search.comes_first(slave, master);
      }


      /// The anchor of a place. Unless it @p stays on its edge, one beyond a smooth end of it is a
      /// place of the next edge.
      Anchor
      StickCarrier::find_anchor(StickPlace stick, const bool stays) const
      {
        constexpr unsigned int most_edges = 100;
        constexpr auto         smooth     = ContactSurface::Corner::smooth;

        for (unsigned int i = 0;
             i < most_edges && !stays && (stick.t < 0. || stick.t > 1.);
             ++i)
        {
          const bool  is_before = stick.t < 0.;
          const auto &edge      = from.edges()[stick.edge];
          if ((is_before ? edge.at_start : edge.at_end) != smooth)
            break;
          stick.edge         = is_before ? edge.previous : edge.next;
          const double ratio = edge.length / from.edges()[stick.edge].length;
          stick.t = is_before ? 1. + stick.t * ratio : (stick.t - 1.) * ratio;
        }
        return {common.piece_at(stick.edge, stick.t), stick.t};
      }


      /// The anchor of the parameter @p s on the edge of a piece before the cut.
      Anchor
      StickCarrier::anchor_at(const CommonPiece &piece, const double s) const
      {
        StickPlace stick;
        return find_stick_place(places_along[piece.before], s, stick)
                 ? find_anchor(stick, is_kept(piece.after, stick.edge))
                 : Anchor();
      }


      /// The end of the part of an interval, from its beginning on, whose anchors are on the same piece.
      double
      StickCarrier::end_on_master(const CommonPiece &piece,
                                  const double       begin,
                                  const double       end) const
      {
        constexpr double       inside       = 1e-6;
        constexpr unsigned int n_bisections = 50;

        double low                      = (1. - inside) * begin + inside * end,
               high                     = (1. - inside) * end + inside * begin;
        const CommonPiece *const master = anchor_at(piece, low).master;
        if (anchor_at(piece, high).master == master)
          return end;
        for (unsigned int i = 0; i < n_bisections; ++i)
        {
          const double middle = 0.5 * (low + high);
          (anchor_at(piece, middle).master == master ? low : high) = middle;
        }
        return high;
      }


      void
      StickCarrier::carry_corner(const ContactHistory::Stick &stick)
      {
        const unsigned int n    = from.edges().size();
        const unsigned int kind = stick.place / n - 1;
        const unsigned int end =
          kind < PointKind::along ? kind : kind - PointKind::master_ends;
        const unsigned int edge = common.edge_at_end(stick.place % n, end);
        if (edge == invalid_index)
          return;
        const Anchor anchor =
          find_anchor({stick.s, stick.edge, stick.t},
                      common.same_edge(stick.edge) != invalid_index);
        const CommonPiece *const master = anchor.master;
        // A corner of a master that has become a slave is a point along that slave.
        if (master == nullptr || (kind > PointKind::along &&
                                  !search.comes_first(master->after, edge)))
          return;
        const unsigned int place = place_key(to, edge, kind);
        known_corners.insert(place);
        sticks.push_back({place,
                          stick.s,
                          master->after,
                          master->to_after(anchor.t),
                          stick.is_bonded,
                          stick.slip});
      }


      std::vector<LinearHistory>
      StickCarrier::linear_histories(const CommonPiece &piece) const
      {
        constexpr double shortest = 1e-6;

        const std::vector<StickPlace> &places = places_along[piece.before];
        const double begin = piece.of_before[0], end = piece.of_before[1];
        std::vector<double> ends = {begin, end};
        for (unsigned int i = 0; i < places.size(); ++i)
        {
          ends.push_back(places[i].s);
          if (i + 1 < places.size() &&
              (places[i].edge != places[i + 1].edge ||
               places[i].is_bonded != places[i + 1].is_bonded))
            ends.push_back(0.5 * (places[i].s + places[i + 1].s));
        }
        std::sort(ends.begin(), ends.end());
        const double               least = shortest * (end - begin);
        std::vector<LinearHistory> result;
        for (unsigned int i = 0; i + 1 < ends.size(); ++i)
        {
          double begin_of_part = ends[i];
          while (begin_of_part >= begin && ends[i + 1] <= end &&
                 ends[i + 1] - begin_of_part > least)
          {
            LinearHistory part;
            part.begin          = begin_of_part;
            part.end            = end_on_master(piece, part.begin, ends[i + 1]);
            begin_of_part       = part.end;
            const double length = part.end - part.begin;
            const Anchor a      = anchor_at(piece, part.begin + 0.25 * length),
                         b      = anchor_at(piece, part.end - 0.25 * length);
            StickPlace stick;
            if (!(length > least) || a.master == nullptr ||
                a.master != b.master ||
                !find_stick_place(places, part.begin + 0.5 * length, stick))
              continue;
            part.master    = a.master;
            part.is_bonded = stick.is_bonded;
            part.t = {{a.t - 0.5 * (b.t - a.t), b.t + 0.5 * (b.t - a.t)}};
            result.push_back(part);
          }
        }
        return result;
      }


      void
      StickCarrier::add_at(const CommonPiece   &piece,
                           const LinearHistory &part,
                           const double         s)
      {
        StickPlace stick;
        if (find_stick_place(places_along[piece.before], s, stick))
          sticks.push_back({piece.after,
                            piece.to_after(s),
                            part.master->after,
                            part.master->to_after(part.anchor(s)),
                            part.is_bonded,
                            stick.slip});
      }


      /// If an interval ends at a corner of its master that the cut has made, anchor this corner at
      /// the place of the slave that is stuck to it.
      void
      StickCarrier::add_new_corner(const CommonPiece   &piece,
                                   const LinearHistory &part,
                                   const unsigned int   end_of_part)
      {
        constexpr double tolerance = 1e-6;
        constexpr auto   convex    = ContactSurface::Corner::convex;

        const CommonPiece &master    = *part.master;
        const auto         corner_at = [](const ContactSurface::Edge &edge,
                                  const unsigned int          end) {
          return end == 0 ? edge.at_start : edge.at_end;
        };
        for (const unsigned int end : {0U, 1U})
        {
          const bool was_corner =
            master.of_before[end] == end &&
            corner_at(from.edges()[master.before], end) == convex;
          const unsigned int place =
            place_key(to, master.after, PointKind::master_ends + end);
          StickPlace   stick;
          const double s = end_of_part == 0 ? part.begin : part.end;
          if (was_corner || master.of_after[end] != end ||
              corner_at(to.edges()[master.after], end) != convex ||
              std::abs(master.of_before[end] - part.t[end_of_part]) >
                tolerance ||
              !find_stick_place(places_along[piece.before], s, stick) ||
              !known_corners.insert(place).second)
            continue;
          sticks.push_back({place,
                            double(end),
                            piece.after,
                            piece.to_after(s),
                            part.is_bonded,
                            stick.slip});
        }
      }


      /// Add two places to the master of an interval, which is the slave after the cut: the slave's
      /// point at s is stuck to the place t of the master, hence the master's point at t to s. A
      /// corner of the old slave is a corner of the new master, and keeps its anchor.
      void
      StickCarrier::add_reversed(const CommonPiece   &piece,
                                 const LinearHistory &part)
      {
        // Least ratio of the lengths on the master and on the slave. It is about 1, unless the
        // anchors have been extrapolated from a single place.
        constexpr double least_ratio = 0.1, inside = 1e-3;

        const double slope = (part.t[1] - part.t[0]) / (part.end - part.begin);
        const auto  &edges = from.edges();
        if (std::abs(slope) * edges[part.master->before].length <=
            least_ratio * edges[piece.before].length)
          return;
        for (const unsigned int end : {0U, 1U})
        {
          const ContactSurface::Edge &corner = to.edges()[piece.after];
          const unsigned int          place =
            place_key(to, piece.after, PointKind::master_ends + end);
          const double s = end == 0 ? part.begin : part.end;
          StickPlace   stick;
          if (piece.to_after(s) == end &&
              (end == 0 ? corner.at_start : corner.at_end) ==
                ContactSurface::Corner::convex &&
              find_stick_place(places_along[piece.before], s, stick) &&
              known_corners.insert(place).second)
            sticks.push_back({place,
                              double(end),
                              part.master->after,
                              part.master->to_after(part.t[end]),
                              part.is_bonded,
                              stick.slip});
        }
        // The new slave ends where its edge does.
        double ends[2];
        for (const unsigned int end : {0U, 1U})
          ends[end] =
            std::min(part.master->of_before[1],
                     std::max(part.master->of_before[0], part.t[end]));
        if (ends[0] == ends[1])
          return;
        for (const double share : {inside, 1. - inside})
        {
          const double t = (1. - share) * ends[0] + share * ends[1];
          const double s = part.begin + (t - part.t[0]) / slope;
          StickPlace   stick;
          if (find_stick_place(places_along[piece.before], s, stick))
            sticks.push_back({part.master->after,
                              part.master->to_after(t),
                              piece.after,
                              piece.to_after(s),
                              part.is_bonded,
                              stick.slip});
        }
      }


      /// Add two places for each interval, at its ends. Where the next interval continues
      /// this one, both share a place; where the history jumps, places are inside of the intervals.
      void
      StickCarrier::carry_piece(const CommonPiece &piece)
      {
        constexpr double inside = 1e-3, same = 1e-9;

        if (places_along[piece.before].empty())
          return;
        const std::vector<LinearHistory> all       = linear_histories(piece);
        const auto                       continues = [&](const unsigned int i) {
          return i + 1 < all.size() && all[i].master == all[i + 1].master &&
                 all[i].is_bonded == all[i + 1].is_bonded &&
                 all[i + 1].begin - all[i].end <= same &&
                 std::abs(all[i].t[1] - all[i + 1].t[0]) <=
                   same * (1. + std::abs(all[i].t[1]));
        };
        for (unsigned int i = 0; i < all.size(); ++i)
        {
          const LinearHistory &part = all[i];
          if (!search.comes_first(piece.after, part.master->after))
          {
            add_reversed(piece, part);
            continue;
          }
          const double depth       = inside * (part.end - part.begin);
          const bool   is_at_start = i == 0 && piece.to_after(part.begin) == 0.;
          const bool   is_at_end =
            i + 1 == all.size() && piece.to_after(part.end) == 1.;
          if (i == 0 || !continues(i - 1))
            add_at(piece, part, is_at_start ? part.begin : part.begin + depth);
          add_at(piece,
                 part,
                 is_at_end || continues(i) ? part.end : part.end - depth);
          add_new_corner(piece, part, 0);
          add_new_corner(piece, part, 1);
        }
      }


      using EdgePairs = std::vector<std::pair<unsigned int, unsigned int>>;


      EdgePairs
      carry_entrances(const ContactHistory &history,
                      const ContactSurface &from,
                      const ContactSurface &to,
                      const CommonPieces   &common)
      {
        const unsigned int n = from.edges().size();
        std::map<unsigned int, const ContactHistory::Stick *> corner_sticks;
        for (const ContactHistory::Stick &stick : history.sticks)
          if (stick.place >= n)
            corner_sticks[stick.place] = &stick;
        EdgePairs result;
        for (const auto &[place, face] : history.entrances)
        {
          const unsigned int kind   = place / n - 1;
          const unsigned int before = place % n;
          const unsigned int edge   = common.edge_at_end(before, kind);
          if (edge == invalid_index)
            continue;
          const CommonPiece *entrance = nullptr;
          const auto         stick    = corner_sticks.find(place);
          if (stick != corner_sticks.end() && stick->second->edge == face)
            entrance = common.piece_at(face, stick->second->t);
          else
          {
            const ContactPosition x     = from.reference_place(before, kind).x;
            double                least = 0.;
            for (const CommonPiece &piece : common.of_before(face))
              for (const double t : {0., 0.5, 1.})
              {
                const double distance =
                  to.reference_place(piece.after, t).x.distance(x);
                if (entrance == nullptr || distance < least)
                {
                  entrance = &piece;
                  least    = distance;
                }
              }
          }
          if (entrance != nullptr)
            result.emplace_back(place_key(to, edge, kind), entrance->after);
        }
        return result;
      }


      EdgePairs
      carry_touching(const ContactHistory &history, const CommonPieces &common)
      {
        EdgePairs                                       result;
        std::set<std::pair<unsigned int, unsigned int>> known;
        for (const auto &[edge, other] : history.touching)
          for (const CommonPiece &a : common.of_before(edge))
            for (const CommonPiece &b : common.of_before(other))
              if ((a.after != b.after || edge == other) &&
                  known.insert({a.after, b.after}).second)
                result.emplace_back(a.after, b.after);
        return result;
      }


      /// Carry the energies of pairs of bodies. @p result already has the faces that touch.
      void
      carry_energies(const ContactHistory &history,
                     const ContactSurface &from,
                     const ContactSurface &to,
                     const CommonPieces   &common,
                     ContactHistory       &result)
      {
        std::vector<unsigned int> former(to.n_bodies(), invalid_index);
        for (unsigned int e = 0; e < to.edges().size(); ++e)
          for (const CommonPiece &piece : common.of_after(e))
            former[to.edges()[e].body] = from.edges()[piece.before].body;
        std::vector<std::vector<unsigned int>> parts(from.n_bodies());
        bool is_divided = !history.former_bodies.empty();
        for (unsigned int body = 0; body < former.size(); ++body)
          if (former[body] != invalid_index)
          {
            parts[former[body]].push_back(body);
            is_divided = is_divided || parts[former[body]].size() > 1;
          }

        // Faces that touch determine which pairs of parts have an energy. How it is distributed among
        // them matters only until the next step begins.
        using Pair = std::pair<unsigned int, unsigned int>;
        std::set<Pair> touching;
        for (const auto &[edge, other] : result.touching)
          touching.insert(
            std::minmax({to.edges()[edge].body, to.edges()[other].body}));
        for (const ContactHistory::PairEnergy &energy : history.pair_energies)
        {
          std::set<Pair> all, near;
          for (const unsigned int a : parts[energy.first])
            for (const unsigned int b : parts[energy.second])
            {
              const Pair pair = std::minmax({a, b});
              all.insert(pair);
              if (touching.count(pair) > 0)
                near.insert(pair);
            }
          const std::set<Pair> &pairs = near.empty() ? all : near;
          for (const auto &[first, second] : pairs)
            result.pair_energies.push_back(
              {first,
               second,
               {{energy.energies[0] / pairs.size(),
                 energy.energies[1] / pairs.size()}}});
        }
        if (!is_divided)
          return;
        result.former_bodies = former;
        // If no step has begun since the last cut, bodies before that one count.
        for (unsigned int &body : result.former_bodies)
          if (body != invalid_index && !history.former_bodies.empty())
            body = history.former_bodies[body];
      }
    } // namespace
  }   // namespace internal


  ContactHistory
  carry_history(const ContactHistory            &history,
                const ContactSurface            &from,
                const ContactSurface            &to,
                const std::vector<unsigned int> &slave_priority)
  {
    const internal::CommonPieces common(from, to);
    ContactHistory               result;
    result.has_accepted_state = history.has_accepted_state;
    result.is_conserving      = history.is_conserving;
    result.touching_reach     = history.touching_reach;
    result.sticks =
      internal::StickCarrier(history, from, to, common, slave_priority).carry();
    result.entrances = internal::carry_entrances(history, from, to, common);
    result.touching  = internal::carry_touching(history, common);
    internal::carry_energies(history, from, to, common, result);
    return result;
  }
} // namespace NMM
