#include "geometry/overlaps.h"

#include "geometry/curve.h"
#include "geometry/piece_geometry.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {

      /// A segment of a curve; further vertices are inserted into it.
      struct Chain
      {
        unsigned int                  curve, piece;
        std::vector<dealii::Point<2>> vertices;
        dealii::Point<2>              lower, upper;
      };


      /// Width of a strip between doubled joints over its length [-].
      constexpr double doubled = 1e-6;


      /// Projection of a point onto the segment from a to b.
      struct Projection
      {
        Projection(const dealii::Point<2> &a,
                   const dealii::Point<2> &b,
                   const dealii::Point<2> &x)
        {
          const double length = a.distance(b);
          along               = (x - a) * (b - a) / length;
          if (along <= 0.)
            distance = x.distance(a);
          else if (along >= length)
            distance = x.distance(b);
          else
            distance = std::abs((b[0] - a[0]) * (x[1] - a[1]) -
                                (b[1] - a[1]) * (x[0] - a[0])) /
                       length;
          is_between = along > 0. && along < length;
        }

        double along, distance;
        bool   is_between;
      };


      class Overlaps
      {
      public:
        Overlaps(std::vector<Curve> &curves, bool unites_joints);

        std::string
        unite();

      private:
        /// The largest distance of a vertex from a segment on which it lies [m].
        double
        width(const Chain &a, const Chain &b) const;
        /// Whether the segment belongs neither to a boundary nor to a hole.
        bool
        is_line(const Chain &chain) const;
        bool
        may_overlap(const Chain &a, const Chain &b) const;
        /// Insert ends of each chain into the other one until they coincide. Returns whether there
        /// were any.
        bool
        unite(Chain &a, Chain &b);
        /// The same for one segment of each chain; i and j are the vertices where the segments
        /// begin.
        bool
        unite(Chain &a, unsigned int i, Chain &b, unsigned int j);
        void
        store();

        std::vector<Curve> &curves;
        const bool          unites_joints;
        std::vector<Chain>  chains;
      };


      Overlaps::Overlaps(std::vector<Curve> &curves, const bool unites_joints)
        : curves(curves)
        , unites_joints(unites_joints)
      {
        for (unsigned int c = 0; c < curves.size(); ++c)
          for (unsigned int p = 0; p < curves[c].pieces.size(); ++p)
          {
            const CurvePiece &piece = curves[c].pieces[p];
            if (piece.kind != CurvePiece::Kind::segment)
              continue;
            Chain chain = {c, p, {piece.start, piece.end}, {}, {}};
            for (unsigned int d = 0; d < 2; ++d)
            {
              chain.lower[d] = std::min(piece.start[d], piece.end[d]);
              chain.upper[d] = std::max(piece.start[d], piece.end[d]);
            }
            chains.push_back(chain);
          }
        std::stable_sort(chains.begin(),
                         chains.end(),
                         [](const Chain &a, const Chain &b) {
                           return a.lower[0] < b.lower[0];
                         });
      }


      double
      Overlaps::width(const Chain &a, const Chain &b) const
      {
        double largest = 0.;
        for (unsigned int d = 0; d < 2; ++d)
          largest = std::max({largest,
                              std::abs(std::max(a.lower[d], b.lower[d])),
                              std::abs(std::min(a.upper[d], b.upper[d]))});
        const double rounding =
          32. * std::numeric_limits<double>::epsilon() * largest;
        const Curve &first = curves[a.curve], &second = curves[b.curve];
        if (!unites_joints || first.role != CurveRole::joint ||
            second.role != CurveRole::joint || first.state != second.state)
          return rounding;
        return std::max(rounding,
                        doubled * std::min(a.lower.distance(a.upper),
                                           b.lower.distance(b.upper)));
      }


      bool
      Overlaps::is_line(const Chain &chain) const
      {
        const CurveRole role = curves[chain.curve].role;
        return role == CurveRole::joint || role == CurveRole::interface;
      }


      bool
      Overlaps::may_overlap(const Chain &a, const Chain &b) const
      {
        const double delta = width(a, b);
        for (unsigned int d = 0; d < 2; ++d)
          if (a.lower[d] > b.upper[d] + delta ||
              b.lower[d] > a.upper[d] + delta)
            return false;
        return a.curve != b.curve || is_line(a);
      }


      bool
      Overlaps::unite(Chain             &a,
                      const unsigned int i,
                      Chain             &b,
                      const unsigned int j)
      {
        Chain                                *chains[2] = {&a, &b};
        const unsigned int                    first[2]  = {i, j};
        const std::array<dealii::Point<2>, 2> ends[2]   = {
            {{a.vertices[i], a.vertices[i + 1]}},
            {{b.vertices[j], b.vertices[j + 1]}}};
        const double delta = width(a, b);

        std::vector<dealii::Point<2>> contacts;
        // Pairs (segment that gets a vertex, vertex).
        std::vector<std::pair<unsigned int, dealii::Point<2>>> missing;
        for (unsigned int side = 0; side < 2; ++side)
          for (const dealii::Point<2> &end : ends[1 - side])
          {
            const Projection place(ends[side][0], ends[side][1], end);
            if (!(place.distance <= delta))
              continue;
            contacts.push_back(end);
            // A boundary would run along itself between two ends at one place.
            if (!is_line(*chains[side]) &&
                std::min(end.distance(ends[side][0]),
                         end.distance(ends[side][1])) <= 2. * delta)
              continue;
            const std::vector<dealii::Point<2>> &known = chains[side]->vertices;
            if (place.is_between &&
                std::find(known.begin(), known.end(), end) == known.end() &&
                !lies_exactly_on(
                  CurvePiece::segment(ends[side][0], ends[side][1]), end))
              missing.emplace_back(side, end);
          }
        double length = 0.;
        for (const dealii::Point<2> &x : contacts)
          for (const dealii::Point<2> &y : contacts)
            length = std::max(length, x.distance(y));
        if (missing.empty() || !(length > 16. * delta))
          return false;
        auto &[side, vertex]                    = missing.front();
        std::vector<dealii::Point<2>> &vertices = chains[side]->vertices;
        vertices.insert(vertices.begin() + first[side] + 1, vertex);
        return true;
      }


      bool
      Overlaps::unite(Chain &a, Chain &b)
      {
        bool       is_changed = false;
        const auto unite_next = [&]() {
          for (unsigned int i = 0; i + 1 < a.vertices.size(); ++i)
            for (unsigned int j = 0; j + 1 < b.vertices.size(); ++j)
              if (unite(a, i, b, j))
                return true;
          return false;
        };
        // Each end is inserted into a chain at most once.
        while (unite_next())
          is_changed = true;
        return is_changed;
      }


      std::string
      Overlaps::unite()
      {
        std::vector<std::pair<unsigned int, unsigned int>> pairs;
        for (unsigned int i = 0; i < chains.size(); ++i)
          for (unsigned int j = i + 1; j < chains.size(); ++j)
          {
            const double bound =
              std::max(width(chains[i], chains[j]),
                       unites_joints
                         ? doubled * chains[i].lower.distance(chains[i].upper)
                         : 0.);
            if (chains[j].lower[0] > chains[i].upper[0] + bound)
              break;
            if (may_overlap(chains[i], chains[j]) &&
                unite(chains[i], chains[j]))
              pairs.emplace_back(i, j);
          }
        if (pairs.empty())
          return "";
        // Segments that were bent may now run along others.
        for (bool is_changed = true; is_changed;)
        {
          is_changed = false;
          for (unsigned int i = 0; i < chains.size(); ++i)
            for (unsigned int j = i + 1; j < chains.size(); ++j)
              if (chains[i].vertices.size() + chains[j].vertices.size() > 4 &&
                  may_overlap(chains[i], chains[j]))
                is_changed = unite(chains[i], chains[j]) || is_changed;
        }
        store();

        const auto &[i, j]  = pairs.front();
        const Curve &first  = curves[chains[i].curve];
        const Curve &second = curves[chains[j].curve];
        const bool is_wide  = unites_joints && first.role == CurveRole::joint &&
                             second.role == CurveRole::joint;
        const Chain &bent = chains[chains[i].vertices.size() > 2 ? i : j];
        return (pairs.size() == 1
                  ? ""
                  : std::to_string(pairs.size()) +
                      " pairs of segments, the first of them of ") +
               describe(first) + " and " + describe(second) + " at " +
               describe_place(second, bent.vertices[1]) +
               ", run along each other within " +
               (is_wide ? "a millionth of their length" : "rounding") +
               ": there they are one";
      }


      void
      Overlaps::store()
      {
        std::vector<std::vector<std::vector<dealii::Point<2>>>> vertices(
          curves.size());
        for (unsigned int c = 0; c < curves.size(); ++c)
          vertices[c].resize(curves[c].pieces.size());
        for (const Chain &chain : chains)
          if (chain.vertices.size() > 2)
            vertices[chain.curve][chain.piece] = chain.vertices;
        for (unsigned int c = 0; c < curves.size(); ++c)
        {
          std::vector<CurvePiece> pieces;
          for (unsigned int p = 0; p < curves[c].pieces.size(); ++p)
          {
            const std::vector<dealii::Point<2>> &x = vertices[c][p];
            if (x.empty())
              pieces.push_back(curves[c].pieces[p]);
            for (unsigned int i = 0; i + 1 < x.size(); ++i)
            {
              pieces.push_back(CurvePiece::segment(x[i], x[i + 1]));
              pieces.back().is_straightened =
                i == 0 && curves[c].pieces[p].is_straightened;
            }
          }
          curves[c].pieces = std::move(pieces);
        }
      }
    } // namespace


    std::string
    unite_overlaps(std::vector<Curve> &curves, const bool unites_joints)
    {
      return Overlaps(curves, unites_joints).unite();
    }
  } // namespace internal
} // namespace NMM
