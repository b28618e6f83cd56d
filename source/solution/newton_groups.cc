#include <deal.II/base/mpi.h>

#include <algorithm>
#include <linear_algebra/matrix_rows.h>
#include <solution/newton_groups.h>

namespace NMM
{
  namespace internal
  {
    void
    NewtonGroups::reinit(const std::vector<unsigned int> &blocks,
                         const std::vector<bool>         &is_held,
                         const bool                       are_separate,
                         const Vector                    &like)
    {
      if (blocks != block_of)
        active_unknowns.clear();
      block_of = blocks;
      n_all    = like.size();
      if (active_unknowns.empty() && !blocks.empty())
        active_unknowns.reinit(blocks);
      const unsigned int n =
        blocks.empty() ? 1
                       : *std::max_element(blocks.begin(), blocks.end()) + 1;
      groups.assign(n, Group());
      neighbours.resize(n);
      states.assign(n, State::active);
      joined.reinit(n);
      if (blocks.empty())
        groups[0].n_unknowns = n_all;
      for (const unsigned int block : blocks)
        ++groups[block].n_unknowns;
      for (unsigned int b = 0; b < std::min<std::size_t>(n, is_held.size());
           ++b)
        if (is_held[b])
          states[b] = State::held;
      if (!are_separate)
      {
        unsigned int first = invalid_index;
        for (unsigned int b = 0; b < n; ++b)
          if (states[b] != State::active)
            continue;
          else if (first == invalid_index)
            first = b;
          else
            join(first, b);
      }
      update_roots();
    }


    void
    NewtonGroups::update_roots()
    {
      all_roots.clear();
      root_of.resize(groups.size());
      for (unsigned int b = 0; b < groups.size(); ++b)
      {
        root_of[b] = joined.find(b);
        if (root_of[b] == b)
          all_roots.push_back(b);
      }
      update_active_lists();
    }


    void
    NewtonGroups::update_active_lists()
    {
      all_active_roots.clear();
      active_blocks.clear();
      std::vector<bool> is_active(groups.size(), false);
      for (unsigned int b = 0; b < groups.size(); ++b)
        if (states[root_of[b]] == State::active)
        {
          is_active[b] = true;
          active_blocks.push_back(b);
          if (root_of[b] == b)
            all_active_roots.push_back(b);
        }
      if (!block_of.empty())
        active_unknowns.select(active_blocks.size() == groups.size()
                                 ? std::vector<bool>()
                                 : is_active);
    }


    void
    NewtonGroups::clear_neighbours(const std::vector<bool> &blocks)
    {
      for (unsigned int b = 0; b < neighbours.size(); ++b)
        if (blocks.empty() || blocks[b])
          neighbours[b].clear();
    }


    void
    NewtonGroups::unite(const std::vector<bool>                      &blocks,
                        const dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const std::vector<BlockPair>                 *pairs)
    {
      clear_neighbours(blocks);
      if (block_of.empty())
        return;
      if (pairs != nullptr)
        for (const auto &[a, b] : *pairs)
        {
          if (blocks.empty() || blocks[a])
            add_neighbour(a, b);
          if (blocks.empty() || blocks[b])
            add_neighbour(b, a);
        }
      else
      {
        const MatrixRows entries(matrix);
        active_unknowns.for_each(n_all, [&](const unsigned int row) {
          const unsigned int b = block_of[row];
          if (!is_in(blocks, row))
            return;
          // columns of the same block follow each other
          unsigned int last = b;
          for (int i = entries.begins[row]; i < entries.begins[row + 1]; ++i)
          {
            const unsigned int other = block_of[entries.columns[i]];
            if (other == last || entries.values[i] == 0.)
              continue;
            last = other;
            if (other != b)
              add_neighbour(b, other);
          }
        });
      }
      unite_neighbours();
    }


    void
    NewtonGroups::unite(const std::vector<bool> &blocks,
                        const BodyMatrix        &matrix)
    {
      clear_neighbours(blocks);
      for (unsigned int b = 0; b < neighbours.size(); ++b)
        if (blocks.empty() || blocks[b])
          matrix.for_each_in_row(b,
                                 [&](const unsigned int other, const double *) {
                                   if (other != b)
                                     neighbours[b].push_back(other);
                                 });
      unite_neighbours();
    }


    void
    NewtonGroups::unite_neighbours()
    {
      bool has_joined = false;
      for (const unsigned int b : active_blocks)
        for (const unsigned int other : neighbours[b])
          // blocks that are not active are reported by NonlinearSystem::take_touched_blocks()
          if (states[joined.find(other)] == State::active &&
              joined.find(b) != joined.find(other))
          {
            join(b, other);
            has_joined = true;
          }
      if (has_joined)
        update_roots();
    }


    void
    NewtonGroups::join(const unsigned int i, const unsigned int j)
    {
      Group both;
      both.n_unknowns =
        groups[joined.find(i)].n_unknowns + groups[joined.find(j)].n_unknowns;
      joined.join(i, j);
      groups[joined.find(i)] = both;
    }


    double
    NewtonGroups::active_share() const
    {
      double n = 0.;
      for (const unsigned int root : all_active_roots)
        n += groups[root].n_unknowns;
      return n / n_all;
    }


    std::vector<bool>
    NewtonGroups::reactivate(const std::vector<unsigned int> &blocks)
    {
      bool              is_any = false;
      std::vector<bool> is_new(groups.size(), false);
      for (const unsigned int block : blocks)
      {
        const unsigned int root = root_of[block];
        if (states[root] != State::done)
          continue;
        const unsigned int n    = groups[root].n_unknowns;
        groups[root]            = Group();
        groups[root].n_unknowns = n;
        states[root]            = State::active;
        is_new[root] = is_any = true;
      }
      if (!is_any)
        return {};
      for (unsigned int b = 0; b < groups.size(); ++b)
        is_new[b] = is_new[root_of[b]];
      update_active_lists();
      return is_new;
    }


    void
    NewtonGroups::retire_converged()
    {
      bool is_any = false;
      for (const unsigned int root : all_active_roots)
        if (groups[root].has_converged)
        {
          states[root] = State::done;
          is_any       = true;
        }
      if (is_any)
        update_active_lists();
    }


    void
    NewtonGroups::sum(const Vector &residual, const Vector &correction)
    {
      for (const unsigned int root : all_active_roots)
        groups[root].product = groups[root].square = 0.;
      const auto r = residual.begin(), c = correction.begin();
      active_unknowns.for_each(residual.locally_owned_size(),
                               [&](const unsigned int i) {
                                 Group &group = of_unknown(i);
                                 group.square += r[i] * r[i];
                                 group.product += r[i] * c[i];
                               });
      if (!block_of.empty())
        return;
      double sums[2] = {groups[0].product, groups[0].square};
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 2),
                                  residual.get_mpi_communicator(),
                                  dealii::ArrayView<double>(sums, 2));
      groups[0].product = sums[0];
      groups[0].square  = sums[1];
    }


    void
    NewtonGroups::sum_squares(const Vector &residual)
    {
      for (const unsigned int root : all_roots)
        groups[root].square = 0.;
      const auto r = residual.begin();
      for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
        of_unknown(i).square += r[i] * r[i];
    }
  } // namespace internal
} // namespace NMM
