#include <deal.II/base/exceptions.h>

#include <Eigen/OrderingMethods>
#include <Epetra_BLAS.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mechanics/frontal_solver.h>
#include <numeric>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      constexpr unsigned int none = std::numeric_limits<unsigned int>::max();


      /// Rows of a sparse matrix, each entry once and in ascending order.
      void
      sort_rows(const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
                const unsigned int                                        n,
                std::vector<unsigned int>                                &begin,
                std::vector<unsigned int> &columns)
      {
        std::vector<unsigned int> first(n + 1, 0);
        for (const auto &[row, column] : pairs)
        {
          (void)column;
          ++first[row + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<unsigned int> all(pairs.size()), next(first);
        for (const auto &[row, column] : pairs)
          all[next[row]++] = column;
        begin.assign(1, 0);
        columns.clear();
        for (unsigned int r = 0; r < n; ++r)
        {
          const auto from = all.begin() + first[r],
                     to   = all.begin() + first[r + 1];
          std::sort(from, to);
          columns.insert(columns.end(), from, std::unique(from, to));
          begin.push_back(columns.size());
        }
      }
    } // namespace


    void
    FrontalSolver::set_pattern(const unsigned int      n,
                               const std::vector<int> &rows,
                               const std::vector<int> &columns,
                               const bool              triangle)
    {
      n_unknowns  = n;
      is_triangle = triangle;
      is_analyzed = false;
      blocks.clear();
      coordinates.clear();
      coordinates.reserve(rows.size());
      // of each column, the last block it was met in
      std::vector<unsigned int> last((n + 1) / 2, none);
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        const unsigned int r = rows[i] - 1, c = columns[i] - 1;
        unsigned int      &block = last[c / 2];
        if (block == none || blocks[block].first != r / 2)
        {
          block = blocks.size();
          blocks.emplace_back(r / 2, c / 2);
        }
        coordinates.push_back({block, r % 2, c % 2});
      }
    }


    FrontalSolver::Graph
    FrontalSolver::compress() const
    {
      // both unknowns of a cover are coupled to the same ones; both ways
      const unsigned int n = n_unknowns, n_covers = (n + 1) / 2;
      std::vector<std::pair<unsigned int, unsigned int>> pairs;
      pairs.reserve(2 * blocks.size() + n_covers);
      for (unsigned int k = 0; k < n_covers; ++k)
        pairs.emplace_back(k, k);
      for (std::size_t b = 0; b < blocks.size(); ++b)
        if (counts[b] && blocks[b].first != blocks[b].second)
          pairs.push_back(blocks[b]);
      const std::size_t n_pairs = pairs.size();
      for (std::size_t i = n_covers; i < n_pairs; ++i)
        pairs.emplace_back(pairs[i].second, pairs[i].first);
      std::vector<unsigned int> begin, neighbors;
      sort_rows(pairs, n_covers, begin, neighbors);

      // covers with the same neighbours, themselves included
      std::vector<unsigned int> order(n_covers);
      std::iota(order.begin(), order.end(), 0);
      std::vector<std::size_t> key(n_covers, 0);
      for (unsigned int k = 0; k < n_covers; ++k)
        for (unsigned int i = begin[k]; i < begin[k + 1]; ++i)
          key[k] = 1099511628211u * (key[k] ^ neighbors[i]);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
        return key[a] != key[b] ? key[a] < key[b] : a < b;
      });
      std::vector<unsigned int> representative(n_covers);
      for (unsigned int i = 0; i < n_covers; ++i)
      {
        const unsigned int k = order[i];
        representative[k]    = k;
        if (i == 0)
          continue;
        const unsigned int other = representative[order[i - 1]];
        if (std::equal(neighbors.begin() + begin[k],
                       neighbors.begin() + begin[k + 1],
                       neighbors.begin() + begin[other],
                       neighbors.begin() + begin[other + 1]))
          representative[k] = other;
      }

      Graph                     graph;
      std::vector<unsigned int> cover_to_node(n_covers, none);
      for (unsigned int k = 0; k < n_covers; ++k)
        if (representative[k] == k)
        {
          cover_to_node[k] = graph.weight.size();
          graph.weight.push_back(0);
        }
      graph.unknown_to_node.resize(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        graph.unknown_to_node[i] = cover_to_node[representative[i / 2]];
        ++graph.weight[graph.unknown_to_node[i]];
      }
      pairs.clear();
      for (unsigned int k = 0; k < n_covers; ++k)
        if (representative[k] == k)
          for (unsigned int i = begin[k]; i < begin[k + 1]; ++i)
            if (representative[neighbors[i]] == neighbors[i])
              pairs.emplace_back(cover_to_node[k], cover_to_node[neighbors[i]]);
      sort_rows(pairs, graph.weight.size(), graph.begin, graph.neighbors);
      return graph;
    }


    void
    FrontalSolver::find_fronts(const Graph                            &graph,
                               std::vector<std::vector<unsigned int>> &pivots,
                               std::vector<std::vector<unsigned int>> &later,
                               std::vector<unsigned int>              &parents)
    {
      const unsigned int          m = graph.weight.size();
      Eigen::SparseMatrix<double> pattern(m, m);
      pattern.reserve(Eigen::VectorXi::Constant(m, 1));
      std::vector<Eigen::Triplet<double>> triplets;
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int i = graph.begin[k]; i < graph.begin[k + 1]; ++i)
          triplets.emplace_back(graph.neighbors[i], k, 1.);
      pattern.setFromTriplets(triplets.begin(), triplets.end());
      Eigen::AMDOrdering<int>::PermutationType order;
      Eigen::AMDOrdering<int>()(pattern, order);
      std::vector<unsigned int> position(m);
      for (unsigned int i = 0; i < m; ++i)
        position[order.indices()[i]] = i;

      // what is coupled to each node when it is eliminated, by position
      std::vector<std::vector<unsigned int>> coupled(m), from(m);
      std::vector<unsigned int>              seen(m, none), parent(m, none);
      for (unsigned int p = 0; p < m; ++p)
      {
        std::vector<unsigned int> &all = coupled[p];
        seen[p]                        = p;
        const auto meet                = [&](const unsigned int q) {
          if (q > p && seen[q] != p)
          {
            seen[q] = p;
            all.push_back(q);
          }
        };
        const unsigned int k = order.indices()[p];
        for (unsigned int i = graph.begin[k]; i < graph.begin[k + 1]; ++i)
          meet(position[graph.neighbors[i]]);
        for (const unsigned int child : from[p])
          for (const unsigned int q : coupled[child])
            meet(q);
        std::sort(all.begin(), all.end());
        if (!all.empty())
        {
          parent[p] = all.front();
          from[all.front()].push_back(p);
        }
      }

      // a child joins its parent if that makes few zeros
      constexpr double few_zeros = 0.1, few_pivots = 16.;
      const auto       size = [&](const std::vector<unsigned int> &nodes) {
        double sum = 0.;
        for (const unsigned int p : nodes)
          sum += graph.weight[order.indices()[p]];
        return sum;
      };
      std::vector<double>       n_pivots(m), n_later(m);
      std::vector<unsigned int> joined(m, none);
      for (unsigned int p = 0; p < m; ++p)
      {
        n_pivots[p] = graph.weight[order.indices()[p]];
        n_later[p]  = size(coupled[p]);
      }
      for (unsigned int p = 0; p < m; ++p)
        for (const unsigned int child : from[p])
        {
          const double zeros =
            n_pivots[child] * (n_pivots[p] + n_later[p] - n_later[child]);
          const double total = n_pivots[child] + n_pivots[p] + n_later[p];
          if (zeros <= few_zeros * total * n_pivots[child] ||
              total <= few_pivots)
          {
            joined[child] = p;
            n_pivots[p] += n_pivots[child];
          }
        }
      std::vector<unsigned int> to_front(m);
      pivots.clear();
      later.clear();
      // from the last to the first, so that parents are known
      std::vector<std::vector<unsigned int>> nodes(m);
      for (unsigned int p = m; p-- > 0;)
        to_front[p] = joined[p] == none ? p : to_front[joined[p]];
      for (unsigned int p = 0; p < m; ++p)
        nodes[to_front[p]].push_back(p);

      // children right before their parents
      std::vector<unsigned int>              sorted, open;
      std::vector<std::vector<unsigned int>> front_children(m);
      for (unsigned int p = 0; p < m; ++p)
        if (joined[p] == none && parent[p] != none)
          front_children[to_front[parent[p]]].push_back(p);
      for (unsigned int p = m; p-- > 0;)
        if (joined[p] == none && parent[p] == none)
          open.push_back(p);
      while (!open.empty())
      {
        const unsigned int p = open.back();
        open.pop_back();
        sorted.push_back(p);
        open.insert(open.end(),
                    front_children[p].begin(),
                    front_children[p].end());
      }
      std::reverse(sorted.begin(), sorted.end());
      std::vector<unsigned int> number(m, none);
      for (unsigned int i = 0; i < sorted.size(); ++i)
        number[sorted[i]] = i;
      const auto to_nodes = [&](std::vector<unsigned int> &positions) {
        for (unsigned int &p : positions)
          p = order.indices()[p];
        return std::move(positions);
      };
      parents.clear();
      for (const unsigned int p : sorted)
      {
        parents.push_back(parent[p] == none ? none
                                            : number[to_front[parent[p]]]);
        pivots.push_back(to_nodes(nodes[p]));
        later.push_back(to_nodes(coupled[p]));
      }
    }


    void
    FrontalSolver::number_unknowns(
      const Graph                                  &graph,
      const std::vector<std::vector<unsigned int>> &pivots,
      const std::vector<std::vector<unsigned int>> &later,
      const std::vector<unsigned int>              &parents)
    {
      const unsigned int m = graph.weight.size(), n_fronts = pivots.size();
      std::vector<unsigned int> node_to_first(m);
      unsigned int              n         = 0;
      std::size_t               n_factors = 0;
      fronts.assign(n_fronts, Front());
      unknown_to_front.clear();
      later_unknowns.clear();
      largest = 0;
      for (unsigned int f = 0; f < n_fronts; ++f)
      {
        Front &front = fronts[f];
        front.first  = n;
        for (const unsigned int k : pivots[f])
        {
          node_to_first[k] = n;
          n += graph.weight[k];
        }
        front.n_pivots = n - front.first;
        unknown_to_front.resize(n, f);
      }
      std::vector<unsigned int> next(node_to_first);
      old_to_new.resize(graph.unknown_to_node.size());
      for (unsigned int i = 0; i < old_to_new.size(); ++i)
        old_to_new[i] = next[graph.unknown_to_node[i]]++;

      std::vector<std::vector<unsigned int>> front_to_children(n_fronts);
      for (unsigned int f = 0; f < n_fronts; ++f)
      {
        Front &front = fronts[f];
        front.later  = later_unknowns.size();
        for (const unsigned int k : later[f])
          for (unsigned int i = 0; i < graph.weight[k]; ++i)
            later_unknowns.push_back(node_to_first[k] + i);
        // ascending, as places are looked for
        std::sort(later_unknowns.begin() + front.later, later_unknowns.end());
        front.n       = front.n_pivots + later_unknowns.size() - front.later;
        largest       = std::max(largest, front.n);
        front.factors = n_factors;
        n_factors +=
          std::size_t(front.n_pivots) * (2 * front.n - front.n_pivots);
        if (parents[f] != none)
          front_to_children[parents[f]].push_back(f);
      }
      factors.resize(n_factors);
      exchanges.resize(n);
      work.resize(std::size_t(largest) * largest);
      solution.resize(n);
      gathered.resize(largest);

      children.clear();
      runs.clear();
      std::vector<unsigned int> place(n, none);
      for (unsigned int f = 0; f < n_fronts; ++f)
      {
        Front &front         = fronts[f];
        front.children_begin = children.size();
        // the last one's is on top of the stack
        children.insert(children.end(),
                        front_to_children[f].rbegin(),
                        front_to_children[f].rend());
        front.children_end = children.size();
        for (unsigned int i = 0; i < front.n_pivots; ++i)
          place[front.first + i] = i;
        for (unsigned int i = front.n_pivots; i < front.n; ++i)
          place[later_unknowns[front.later + i - front.n_pivots]] = i;
        for (const unsigned int c : front_to_children[f])
        {
          Front &child     = fronts[c];
          child.runs_begin = runs.size();
          for (unsigned int i = 0; i < child.n - child.n_pivots; ++i)
          {
            const unsigned int there = place[later_unknowns[child.later + i]];
            Assert(there < front.n, dealii::ExcInternalError());
            if (runs.size() > child.runs_begin &&
                runs.back().there + runs.back().n == there)
              ++runs.back().n;
            else
              runs.push_back({i, there, 1});
          }
          child.runs_end = runs.size();
        }
      }
    }


    void
    FrontalSolver::place_entries()
    {
      // by front, which is that of the cover eliminated first
      struct Site
      {
        unsigned int front, row, column;
      };
      std::vector<Site> sites(blocks.size());
      const auto place = [&](const Front &front, const unsigned int unknown) {
        if (unknown < front.first + front.n_pivots)
          return unknown - front.first;
        const auto from = later_unknowns.begin() + front.later;
        const auto to   = from + (front.n - front.n_pivots);
        const auto at   = std::lower_bound(from, to, unknown);
        Assert(at != to && *at == unknown, dealii::ExcInternalError());
        return front.n_pivots + static_cast<unsigned int>(at - from);
      };
      for (std::size_t b = 0; b < blocks.size(); ++b)
        if (counts[b])
        {
          const unsigned int r = old_to_new[2 * blocks[b].first];
          const unsigned int c = old_to_new[2 * blocks[b].second];
          sites[b].front  = std::min(unknown_to_front[r], unknown_to_front[c]);
          sites[b].row    = place(fronts[sites[b].front], r);
          sites[b].column = place(fronts[sites[b].front], c);
        }

      std::vector<std::size_t> begin(fronts.size() + 1, 0);
      const auto               for_each = [&](const auto &action) {
        for (std::size_t i = 0; i < coordinates.size(); ++i)
        {
          const Coordinates &at = coordinates[i];
          if (!counts[at.block])
            continue;
          const Site        &site = sites[at.block];
          const unsigned int r = site.row + at.row, c = site.column + at.column;
          action(site.front, i, r, c);
          if (is_triangle && r != c)
            action(site.front, i, c, r);
        }
      };
      for_each(
        [&](const unsigned int f, std::size_t, unsigned int, unsigned int) {
          ++begin[f + 1];
        });
      std::partial_sum(begin.begin(), begin.end(), begin.begin());
      for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        fronts[f].entries_begin = begin[f];
        fronts[f].entries_end   = begin[f + 1];
      }
      entries.resize(begin.back());
      for_each([&](const unsigned int f,
                   const std::size_t  i,
                   const unsigned int r,
                   const unsigned int c) {
        entries[begin[f]++] = {static_cast<unsigned int>(i),
                               r * fronts[f].n + c};
      });
    }


    void
    FrontalSolver::analyze()
    {
      std::vector<std::vector<unsigned int>> pivots, later;
      std::vector<unsigned int>              parents;
      const Graph                            graph = compress();
      find_fronts(graph, pivots, later, parents);
      number_unknowns(graph, pivots, later, parents);
      place_entries();
      is_analyzed = true;
    }


    void
    FrontalSolver::forget()
    {
      is_new = true;
    }


    /// Find the order anew if blocks count that have not.
    void
    FrontalSolver::count_blocks(const std::vector<double> &values)
    {
      is_nonzero.assign(blocks.size(), 0);
      for (std::size_t i = 0; i < values.size(); ++i)
        is_nonzero[coordinates[i].block] |= values[i] != 0.;
      if (!is_analyzed || is_new)
      {
        if (!is_analyzed || is_nonzero != counts)
        {
          counts = is_nonzero;
          analyze();
        }
      }
      else
      {
        bool is_more = false;
        for (std::size_t b = 0; b < blocks.size(); ++b)
          if (is_nonzero[b] && !counts[b])
            counts[b] = is_more = true;
        if (is_more)
          analyze();
      }
      is_new = false;
    }


    bool
    FrontalSolver::factorize(const std::vector<double> &values)
    {
      count_blocks(values);
      return assemble_and_eliminate(values);
    }


    /// The pivots of a front, row-major; in panels, so that what is left is
    /// updated by matrix products.
    bool
    FrontalSolver::eliminate(const Front &front, double *matrix)
    {
      constexpr unsigned int panel = 24;
      // parts of the largest entry of a row at first
      constexpr double   lost = 1e-14;
      const unsigned int n = front.n, n_pivots = front.n_pivots;
      double             largest_entry = 0.;
      for (unsigned int i = 0; i < n_pivots; ++i)
        for (unsigned int j = 0; j < n_pivots; ++j)
          largest_entry = std::max(largest_entry, std::abs(matrix[i * n + j]));

      for (unsigned int begin = 0; begin < n_pivots; begin += panel)
      {
        const unsigned int end = std::min(begin + panel, n_pivots);
        for (unsigned int k = begin; k < end; ++k)
        {
          unsigned int best = k;
          for (unsigned int i = k + 1; i < n_pivots; ++i)
            if (std::abs(matrix[i * n + k]) > std::abs(matrix[best * n + k]))
              best = i;
          exchanges[front.first + k] = best;
          if (best != k)
            std::swap_ranges(matrix + k * n,
                             matrix + (k + 1) * n,
                             matrix + best * n);
          const double *row   = matrix + k * n;
          const double  pivot = row[k];
          if (!(std::abs(pivot) > lost * largest_entry))
            return false;
          const double inverse = 1. / pivot;
          for (unsigned int i = k + 1; i < n; ++i)
          {
            double *other = matrix + i * n;
            if (other[k] == 0.)
              continue;
            const double factor = other[k] *= inverse;
            for (unsigned int j = k + 1; j < end; ++j)
              other[j] -= factor * row[j];
          }
        }
        // rows of the panel's pivots beyond the panel
        for (unsigned int k = begin; k < end; ++k)
          for (unsigned int i = k + 1; i < end; ++i)
          {
            const double factor = matrix[i * n + k];
            if (factor != 0.)
              for (unsigned int j = end; j < n; ++j)
                matrix[i * n + j] -= factor * matrix[k * n + j];
          }
        // everything below and to the right; transposed for BLAS
        const int n_left = n - end, width = end - begin;
        if (n_left > 0)
          Epetra_BLAS().GEMM('N',
                             'N',
                             n_left,
                             n_left,
                             width,
                             -1.,
                             matrix + begin * n + end,
                             n,
                             matrix + end * n + begin,
                             n,
                             1.,
                             matrix + end * n + end,
                             n);
      }
      return true;
    }


    bool
    FrontalSolver::assemble_and_eliminate(const std::vector<double> &values)
    {
      // what fronts have left, the last one on top
      std::size_t top = 0;
      for (const Front &front : fronts)
      {
        const unsigned int n = front.n, w = front.n_pivots, r = n - w;
        std::fill_n(work.begin(), std::size_t(n) * n, 0.);
        for (std::size_t i = front.entries_begin; i < front.entries_end; ++i)
          work[entries[i].place] += values[entries[i].value];
        for (unsigned int c = front.children_begin; c < front.children_end; ++c)
        {
          const Front       &child = fronts[children[c]];
          const unsigned int m     = child.n - child.n_pivots;
          top -= std::size_t(m) * m;
          for (std::size_t a = child.runs_begin; a < child.runs_end; ++a)
            for (unsigned int i = 0; i < runs[a].n; ++i)
            {
              const double *from =
                stack.data() + top + std::size_t(runs[a].here + i) * m;
              double *to = work.data() + std::size_t(runs[a].there + i) * n;
              for (std::size_t b = child.runs_begin; b < child.runs_end; ++b)
                for (unsigned int j = 0; j < runs[b].n; ++j)
                  to[runs[b].there + j] += from[runs[b].here + j];
            }
        }
        if (!eliminate(front, work.data()))
          return false;
        double *to = std::copy_n(work.data(),
                                 std::size_t(w) * n,
                                 factors.data() + front.factors);
        if (stack.size() < top + std::size_t(r) * r)
          stack.resize(2 * (top + std::size_t(r) * r));
        for (unsigned int i = w; i < n; ++i)
        {
          const double *row = work.data() + std::size_t(i) * n;
          to                = std::copy_n(row, w, to);
          std::copy_n(row + w, r, stack.data() + top);
          top += r;
        }
      }
      Assert(top == 0, dealii::ExcInternalError());
      return true;
    }


    void
    FrontalSolver::solve(double *x) const
    {
      for (unsigned int i = 0; i < old_to_new.size(); ++i)
        solution[old_to_new[i]] = x[i];
      for (const Front &front : fronts)
      {
        const unsigned int  n = front.n, w = front.n_pivots;
        const double       *rows  = factors.data() + front.factors;
        const double       *lower = rows + std::size_t(w) * n;
        double             *own   = solution.data() + front.first;
        const unsigned int *later = later_unknowns.data() + front.later;
        for (unsigned int k = 0; k < w; ++k)
          std::swap(own[k], own[exchanges[front.first + k]]);
        for (unsigned int i = 1; i < w; ++i)
        {
          double sum = own[i];
          for (unsigned int k = 0; k < i; ++k)
            sum -= rows[std::size_t(i) * n + k] * own[k];
          own[i] = sum;
        }
        for (unsigned int i = 0; i < n - w; ++i, lower += w)
        {
          double sum = 0.;
          for (unsigned int k = 0; k < w; ++k)
            sum += lower[k] * own[k];
          solution[later[i]] -= sum;
        }
      }
      for (auto front = fronts.rbegin(); front != fronts.rend(); ++front)
      {
        const unsigned int  n = front->n, w = front->n_pivots;
        double             *own   = solution.data() + front->first;
        const unsigned int *later = later_unknowns.data() + front->later;
        for (unsigned int i = 0; i < n - w; ++i)
          gathered[i] = solution[later[i]];
        for (unsigned int i = w; i-- > 0;)
        {
          const double *row =
            factors.data() + front->factors + std::size_t(i) * n;
          double sum = own[i];
          for (unsigned int j = 0; j < n - w; ++j)
            sum -= row[w + j] * gathered[j];
          for (unsigned int j = i + 1; j < w; ++j)
            sum -= row[j] * own[j];
          own[i] = sum / row[i];
        }
      }
      for (unsigned int i = 0; i < old_to_new.size(); ++i)
        x[i] = solution[old_to_new[i]];
    }
  } // namespace internal
} // namespace NMM
