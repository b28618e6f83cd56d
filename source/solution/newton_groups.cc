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
                         const Vector                    &like)
    {
      if (blocks != block_of)
      {
        active_unknowns.clear();
        corrected_unknowns.clear();
      }
      block_of = blocks;
      n_all    = like.size();
      if (active_unknowns.empty() && !blocks.empty())
      {
        active_unknowns.reinit(blocks);
        corrected_unknowns.reinit(blocks);
      }
      const unsigned int n =
        blocks.empty() ? 1
                       : *std::max_element(blocks.begin(), blocks.end()) + 1;
      groups.assign(n, Group());
      all_blocks.resize(n);
      neighbours.resize(n);
      for (auto &of_block : neighbours)
        of_block.clear();
      for (Block &block : all_blocks)
      {
        block.residual_is_known = false;
        block.n_unknowns        = 0;
      }
      states.assign(n, State::active);
      joined.reinit(n);
      if (blocks.empty())
        all_blocks[0].n_unknowns = n_all;
      for (const unsigned int block : blocks)
        ++all_blocks[block].n_unknowns;
      for (unsigned int b = 0; b < n; ++b)
      {
        groups[b].n_unknowns = all_blocks[b].n_unknowns;
        if (b < is_held.size() && is_held[b])
          states[b] = State::held;
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
        else
          all_blocks[b].is_unconverged = all_blocks[b].is_affected =
            all_blocks[b].is_corrected = false;
      if (!block_of.empty())
        active_unknowns.select(active_blocks.size() == groups.size()
                                 ? std::vector<bool>()
                                 : is_active);
    }


    void
    NewtonGroups::choose(const Vector &residual,
                         const double  scale,
                         const double  allowed)
    {
      // residual of a block that counts as converged, relative to its share of the tolerance
      constexpr double negligible = 0.1;

      std::vector<double> squares(groups.size(), 0.);
      const auto          r = residual.begin();
      if (!block_of.empty())
        active_unknowns.for_each(n_all, [&](const unsigned int i) {
          squares[block_of[i]] += r[i] * r[i];
        });
      widen_rings(squares, scale);
      std::vector<bool> has_unconverged(groups.size(), false);
      for (const unsigned int b : active_blocks)
      {
        Block       &block = all_blocks[b];
        const double part  = double(block.n_unknowns) / n_all;
        block.is_unconverged =
          !block.residual_is_known ||
          squares[b] > negligible * negligible * allowed * allowed * part;
        if (block.is_unconverged)
          has_unconverged[root_of[b]] = true;
      }
      for (const unsigned int b : active_blocks)
        if (!has_unconverged[root_of[b]])
          all_blocks[b].is_unconverged = true;
      select_corrected();
    }


    void
    NewtonGroups::widen_rings(const std::vector<double> &squares,
                              const double               scale)
    {
      constexpr double much = 0.1;

      std::vector<double> outside(groups.size(), 0.);
      for (const unsigned int b : active_blocks)
        if (all_blocks[b].is_affected && !all_blocks[b].is_corrected)
          outside[root_of[b]] += squares[b];
      for (const unsigned int root : all_active_roots)
      {
        Group &group = groups[root];
        if (group.is_cycling || (!group.squares.empty() &&
                                 outside[root] > much * much * scale * scale *
                                                   group.squares.back()))
          group.n_rings =
            std::min<unsigned int>(2 * group.n_rings, groups.size());
      }
    }


    std::vector<std::pair<unsigned int, unsigned int>>
    NewtonGroups::unconverged_neighbourhood() const
    {
      std::vector<bool> is_in(groups.size(), false);
      std::vector<std::pair<unsigned int, unsigned int>> result;
      for (const unsigned int b : active_blocks)
        if (all_blocks[b].is_unconverged)
        {
          is_in[b] = true;
          result.emplace_back(b, 0);
        }
      for (unsigned int i = 0; i < result.size(); ++i)
      {
        const auto [b, ring] = result[i];
        if (ring <= groups[root_of[b]].n_rings)
          for (const unsigned int other : neighbours[b])
            if (!is_in[other] && states[root_of[other]] == State::active)
            {
              is_in[other] = true;
              result.emplace_back(other, ring + 1);
            }
      }
      return result;
    }


    void
    NewtonGroups::select_corrected()
    {
      for (const unsigned int b : active_blocks)
        all_blocks[b].is_affected = all_blocks[b].is_corrected = false;
      std::vector<bool> is_chosen(groups.size(), false);
      unsigned int      n_chosen = 0;
      affected_blocks.clear();
      for (const auto &[b, ring] : unconverged_neighbourhood())
      {
        all_blocks[b].is_affected = true;
        affected_blocks.push_back(b);
        if (ring > groups[root_of[b]].n_rings)
          continue;
        all_blocks[b].is_corrected = is_chosen[b] = true;
        ++n_chosen;
      }
      if (!block_of.empty())
        corrected_unknowns.select(
          n_chosen == groups.size() ? std::vector<bool>() : is_chosen);
    }


    std::vector<bool>
    NewtonGroups::blocks_without_tangent() const
    {
      unsigned int      n = 0;
      std::vector<bool> result(groups.size(), false);
      for (const unsigned int b : active_blocks)
        if (all_blocks[b].is_corrected && !all_blocks[b].has_tangent)
        {
          result[b] = true;
          ++n;
        }
      return n == groups.size() ? std::vector<bool>() : result;
    }


    bool
    NewtonGroups::have_tangents() const
    {
      return std::all_of(active_blocks.begin(),
                         active_blocks.end(),
                         [this](const unsigned int b) {
                           return !all_blocks[b].is_corrected ||
                                  all_blocks[b].has_tangent;
                         });
    }


    void
    NewtonGroups::invalidate_tangents()
    {
      for (Block &block : all_blocks)
        block.has_tangent = false;
    }


    void
    NewtonGroups::note_residual(const std::vector<bool> &blocks)
    {
      for (unsigned int b = 0; b < all_blocks.size(); ++b)
        if (blocks.empty() || blocks[b])
          all_blocks[b].residual_is_known = true;
    }


    void
    NewtonGroups::find_neighbours(
      const std::vector<bool>                      &blocks,
      const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      const MatrixRows entries(matrix);
      corrected_unknowns.for_each(n_all, [&](const unsigned int row) {
        const unsigned int b = block_of[row];
        if (!blocks.empty() && !blocks[b])
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


    void
    NewtonGroups::unite(const std::vector<bool>                      &blocks,
                        const dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const std::vector<BlockPair>                 *pairs)
    {
      store_neighbours(blocks);
      if (block_of.empty())
        return;
      if (pairs == nullptr)
        find_neighbours(blocks, matrix);
      else
        for (const auto &[a, b] : *pairs)
        {
          if (blocks.empty() || blocks[a])
            add_neighbour(a, b);
          if (blocks.empty() || blocks[b])
            add_neighbour(b, a);
        }
      unite_neighbours(blocks);
    }


    void
    NewtonGroups::unite(const std::vector<bool> &blocks,
                        const BodyMatrix        &matrix)
    {
      store_neighbours(blocks);
      for (unsigned int b = 0; b < all_blocks.size(); ++b)
        if (blocks.empty() || blocks[b])
          matrix.for_each_in_row(b,
                                 [&](const unsigned int other, const double *) {
                                   if (other != b)
                                     neighbours[b].push_back(other);
                                 });
      unite_neighbours(blocks);
    }


    void
    NewtonGroups::store_neighbours(const std::vector<bool> &blocks)
    {
      neighbours_before.clear();
      before_of_block.resize(all_blocks.size());
      for (unsigned int b = 0; b < all_blocks.size(); ++b)
        if (blocks.empty() || blocks[b])
        {
          all_blocks[b].has_tangent = true;
          before_of_block[b].first  = neighbours_before.size();
          neighbours_before.insert(neighbours_before.end(),
                                   neighbours[b].begin(),
                                   neighbours[b].end());
          before_of_block[b].second = neighbours_before.size();
          neighbours[b].clear();
        }
    }


    void
    NewtonGroups::unite_neighbours(const std::vector<bool> &blocks)
    {
      bool has_joined = false, is_any_new = false;
      for (const unsigned int b : active_blocks)
        if (blocks.empty() || blocks[b])
          for (const unsigned int other : neighbours[b])
          {
            // blocks that are not active are reported by NonlinearSystem::take_touched_blocks()
            if (states[joined.find(other)] != State::active)
              continue;
            if (joined.find(b) != joined.find(other))
            {
              join(b, other);
              has_joined = true;
            }
            const auto before =
                         neighbours_before.begin() + before_of_block[b].first,
                       end =
                         neighbours_before.begin() + before_of_block[b].second;
            if (!all_blocks[other].is_corrected &&
                std::find(before, end, other) == end)
              all_blocks[other].is_unconverged = is_any_new = true;
          }
      if (has_joined)
        update_roots();
      if (is_any_new)
        select_corrected();
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
    NewtonGroups::corrected_share() const
    {
      double n = 0.;
      for (const unsigned int b : active_blocks)
        if (all_blocks[b].is_corrected)
          n += all_blocks[b].n_unknowns;
      return n / n_all;
    }


    void
    NewtonGroups::reactivate(const std::vector<unsigned int> &blocks,
                             const bool                       is_known)
    {
      std::vector<unsigned int> roots;
      for (const unsigned int block : blocks)
      {
        const unsigned int root = root_of[block];
        if (states[root] != State::done)
          continue;
        roots.push_back(root);
        all_blocks[block].residual_is_known = is_known;
        all_blocks[block].is_unconverged    = true;
      }
      for (const unsigned int root : roots)
      {
        const unsigned int n    = groups[root].n_unknowns;
        groups[root]            = Group();
        groups[root].n_unknowns = n;
        states[root]            = State::active;
      }
      if (!roots.empty())
      {
        update_active_lists();
        select_corrected();
      }
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
                               });
      corrected_unknowns.for_each(residual.locally_owned_size(),
                                  [&](const unsigned int i) {
                                    of_unknown(i).product += r[i] * c[i];
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
