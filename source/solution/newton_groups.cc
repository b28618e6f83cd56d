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
                         const std::vector<bool>         &sleeps,
                         const bool                       are_separate,
                         const Vector                    &like)
    {
      if (blocks != block_of)
        chosen_unknowns.clear();
      block_of = blocks;
      n_all    = like.size();
      if (chosen_unknowns.empty() && !blocks.empty())
        chosen_unknowns.reinit(blocks);
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
      late_pairs.clear();
      for (unsigned int b = 0; b < std::min<std::size_t>(n, sleeps.size()); ++b)
        if (sleeps[b])
          states[b] = State::asleep;
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
        chosen_unknowns.select(active_blocks.size() == groups.size()
                                 ? std::vector<bool>()
                                 : is_active);
    }


    void
    NewtonGroups::unite(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      if (block_of.empty())
        return;
      for (const unsigned int b : active_blocks)
        neighbours[b].clear();
      const MatrixRows entries(matrix);
      chosen_unknowns.for_each(n_all, [&](const unsigned int row) {
        const unsigned int b = block_of[row];
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
      unite_neighbours();
    }


    void
    NewtonGroups::unite(const BodyMatrix &matrix)
    {
      for (const unsigned int b : active_blocks)
      {
        neighbours[b].clear();
        matrix.for_each_in_row(b,
                               [&](const unsigned int other, const double *) {
                                 if (other != b)
                                   neighbours[b].push_back(other);
                               });
      }
      unite_neighbours();
    }


    void
    NewtonGroups::unite_neighbours()
    {
      bool has_joined = false;
      late_pairs.clear();
      for (const unsigned int b : active_blocks)
        for (const unsigned int other : neighbours[b])
        {
          const State state = states[joined.find(other)];
          if (state == State::done)
            late_pairs.emplace_back(b, other);
          else if (state == State::active &&
                   joined.find(b) != joined.find(other))
          {
            join(b, other);
            has_joined = true;
          }
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
    NewtonGroups::solved_share() const
    {
      double n = 0.;
      for (const unsigned int root : all_active_roots)
        n += groups[root].n_unknowns;
      return n / n_all;
    }


    void
    NewtonGroups::reactivate(const std::vector<unsigned int> &blocks)
    {
      for (const unsigned int block : blocks)
      {
        const unsigned int root = root_of[block];
        if (states[root] != State::done)
          continue;
        const unsigned int n    = groups[root].n_unknowns;
        groups[root]            = Group();
        groups[root].n_unknowns = n;
        states[root]            = State::active;
      }
      update_active_lists();
    }


    void
    NewtonGroups::retire_converged()
    {
      bool is_any = !late_pairs.empty();
      for (const auto &[block, other] : late_pairs)
        if (joined.find(block) != joined.find(other))
        {
          join(block, other);
          states[joined.find(block)] = State::active;
        }
      late_pairs.clear();
      for (const unsigned int root : all_active_roots)
        if (joined.find(root) == root && groups[root].has_converged)
        {
          states[root] = State::done;
          is_any       = true;
        }
      if (is_any)
        update_roots();
    }


    void
    NewtonGroups::sum(const Vector &residual, const Vector &correction)
    {
      for (const unsigned int root : all_active_roots)
        groups[root].product = groups[root].square = 0.;
      const auto r = residual.begin(), c = correction.begin();
      chosen_unknowns.for_each(residual.locally_owned_size(),
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
