#include <algorithm>
#include <array>
#include <cmath>
#include <linear_algebra/nested_dissection.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      class Dissection
      {
      public:
        Dissection(const std::vector<std::size_t>      &row_begin,
                   const std::vector<unsigned int>     &columns,
                   const std::vector<dealii::Point<2>> &points)
          : row_begin(row_begin)
          , columns(columns)
          , part(points.size(), 0)
          , places(points.size())
        {
          nodes.reserve(points.size());
          for (unsigned int i = 0; i < points.size(); ++i)
            nodes.push_back({points[i][0], points[i][1], 0., i});
          constexpr double pi = 3.14159265358979323846;
          for (unsigned int i = 0; i < directions.size(); ++i)
            directions[i] = {{std::cos(pi * i / directions.size()),
                              std::sin(pi * i / directions.size())}};
        }

        std::vector<unsigned int>
        run()
        {
          order(0, nodes.size());
          return places;
        }

      private:
        struct Node
        {
          double       x, y, key;
          unsigned int row;

          bool
          operator<(const Node &other) const
          {
            return key < other.key || (key == other.key && row < other.row);
          }
        };

        using Direction = std::array<double, 2>;

        /// Number nodes [begin, end) with the places [begin, end).
        void
        order(const unsigned int begin, const unsigned int end)
        {
          // about an element's worth: what is smaller is as good as full
          constexpr unsigned int n_leaf = 8;
          if (end - begin <= n_leaf)
          {
            for (unsigned int i = begin; i < end; ++i)
              places[nodes[i].row] = i;
            return;
          }
          const Cut cut = find_cut(begin, end);
          mark(cut);
          const Direction across = cut.across;

          const auto in_part = [&](const unsigned int p) {
            return [this, p](const Node &node) { return part[node.row] == p; };
          };
          const auto last = nodes.begin() + end;
          const auto second_part =
            std::partition(nodes.begin() + begin, last, in_part(cut.first));
          const auto separator_part =
            std::partition(second_part, last, in_part(cut.second));
          // along the cut
          for (auto node = separator_part; node != last; ++node)
            node->key = -across[1] * node->x + across[0] * node->y;
          std::sort(separator_part, last);
          for (auto node = separator_part; node != last; ++node)
            places[node->row] = node - nodes.begin();
          const unsigned int begin_second    = second_part - nodes.begin(),
                             begin_separator = separator_part - nodes.begin();
          // equal points, all neighbours of each other
          if (begin_separator == end && begin_second == begin)
            return;
          order(begin, begin_second);
          order(begin_second, begin_separator);
        }


        /// Halves [begin, middle) and [middle, end), as marked, and which of them the
        /// separator is taken from.
        struct Cut
        {
          Direction    across;
          unsigned int begin, middle, end;
          unsigned int first, second;
          bool         is_from_first;
          unsigned int n_separator;
        };


        Cut
        make_cut(const Direction   &across,
                 const unsigned int begin,
                 const unsigned int end)
        {
          Cut cut{};
          cut.across = across;
          cut.begin  = begin;
          cut.middle = begin + (end - begin) / 2;
          cut.end    = end;
          for (unsigned int i = begin; i < end; ++i)
            nodes[i].key = across[0] * nodes[i].x + across[1] * nodes[i].y;
          std::nth_element(nodes.begin() + begin,
                           nodes.begin() + cut.middle,
                           nodes.begin() + end);
          cut.first  = ++n_parts;
          cut.second = ++n_parts;
          for (unsigned int i = begin; i < end; ++i)
            part[nodes[i].row] = i < cut.middle ? cut.first : cut.second;
          const unsigned int n_first =
                               count_neighbors(begin, cut.middle, cut.second),
                             n_second =
                               count_neighbors(cut.middle, end, cut.first);
          cut.is_from_first = n_first <= n_second;
          cut.n_separator   = std::min(n_first, n_second);
          return cut;
        }


        /// The best of those that promise most.
        Cut
        find_cut(const unsigned int begin, const unsigned int end)
        {
          sort_directions(begin, end);
          const unsigned int n_tried = end - begin > 1000  ? 4
                                       : end - begin > 100 ? 2
                                                           : 1;
          Cut                best = make_cut(sorted_directions[0], begin, end);
          bool               is_last = true;
          for (unsigned int i = 1; i < n_tried; ++i)
          {
            const Cut cut = make_cut(sorted_directions[i], begin, end);
            is_last       = cut.n_separator < best.n_separator;
            if (is_last)
              best = cut;
          }
          return is_last ? best : make_cut(best.across, begin, end);
        }


        /// By the width of the middle fifth of a sample of the nodes.
        void
        sort_directions(const unsigned int begin, const unsigned int end)
        {
          const unsigned int    n_sample = end - begin > 1000 ? 1000 : 100;
          const unsigned int    step = std::max(1U, (end - begin) / n_sample);
          std::array<double, 8> widths;
          for (unsigned int d = 0; d < 8; ++d)
          {
            keys.clear();
            for (unsigned int i = begin; i < end; i += step)
              keys.push_back(directions[d][0] * nodes[i].x +
                             directions[d][1] * nodes[i].y);
            const unsigned int n     = keys.size();
            const auto         lower = keys.begin() + (2 * n) / 5,
                       upper         = keys.begin() + (3 * n) / 5;
            std::nth_element(keys.begin(), lower, keys.end());
            std::nth_element(lower, upper, keys.end());
            widths[d] = *upper - *lower;
          }
          std::array<unsigned int, 8> order = {{0, 1, 2, 3, 4, 5, 6, 7}};
          std::sort(order.begin(),
                    order.end(),
                    [&](const unsigned int a, const unsigned int b) {
                      return widths[a] > widths[b] ||
                             (widths[a] == widths[b] && a < b);
                    });
          for (unsigned int d = 0; d < 8; ++d)
            sorted_directions[d] = directions[order[d]];
        }


        bool
        has_neighbor(const unsigned int row, const unsigned int other) const
        {
          for (std::size_t i = row_begin[row]; i < row_begin[row + 1]; ++i)
            if (part[columns[i]] == other)
              return true;
          return false;
        }


        unsigned int
        count_neighbors(const unsigned int begin,
                        const unsigned int end,
                        const unsigned int other) const
        {
          unsigned int n = 0;
          for (unsigned int i = begin; i < end; ++i)
            n += has_neighbor(nodes[i].row, other) ? 1 : 0;
          return n;
        }


        /// Give the rows of the separator a part of their own.
        void
        mark(const Cut &cut)
        {
          const unsigned int separator = ++n_parts;
          const unsigned int other = cut.is_from_first ? cut.second : cut.first;
          for (unsigned int i = cut.is_from_first ? cut.begin : cut.middle;
               i < (cut.is_from_first ? cut.middle : cut.end);
               ++i)
            if (has_neighbor(nodes[i].row, other))
              part[nodes[i].row] = separator;
        }


        const std::vector<std::size_t>  &row_begin;
        const std::vector<unsigned int> &columns;
        std::vector<Node>                nodes;
        std::array<Direction, 8>         directions, sorted_directions;
        /// The last part of a dissection that a row was in.
        std::vector<unsigned int> part;
        unsigned int              n_parts = 0;
        std::vector<unsigned int> places;
        std::vector<double>       keys;
      };
    } // namespace


    std::vector<unsigned int>
    nested_dissection(const std::vector<std::size_t>      &row_begin,
                      const std::vector<unsigned int>     &columns,
                      const std::vector<dealii::Point<2>> &points)
    {
      AssertDimension(row_begin.size(), points.size() + 1);
      return Dissection(row_begin, columns, points).run();
    }
  } // namespace internal
} // namespace NMM
