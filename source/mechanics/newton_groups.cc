#include <deal.II/base/mpi.h>

#include <algorithm>
#include <mechanics/matrix_rows.h>
#include <mechanics/newton_groups.h>

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
        active_unknowns.clear();
      block_of = blocks;
      n_all    = like.size();
      if (active_unknowns.empty() && !blocks.empty())
        active_unknowns.reinit(blocks);
      const unsigned int n =
        blocks.empty() ? 1
                       : *std::max_element(blocks.begin(), blocks.end()) + 1;
      groups.assign(n, Group());
      states.assign(n, State::active);
      joined.reinit(n);
      if (blocks.empty())
        groups[0].n_unknowns = n_all;
      for (const unsigned int block : blocks)
        ++groups[block].n_unknowns;
      for (unsigned int b = 0; b < is_held.size() && b < n; ++b)
        if (is_held[b])
          states[b] = State::held;
      number_roots();
    }


    void
    NewtonGroups::number_roots()
    {
      all_roots.clear();
      root_of.resize(groups.size());
      for (unsigned int b = 0; b < groups.size(); ++b)
      {
        root_of[b] = joined.find(b);
        if (root_of[b] == b)
          all_roots.push_back(b);
      }
      list_active();
    }


    void
    NewtonGroups::list_active()
    {
      all_active_roots.clear();
      active_blocks.clear();
      for (unsigned int b = 0; b < groups.size(); ++b)
        if (states[root_of[b]] == State::active)
        {
          active_blocks.push_back(b);
          if (root_of[b] == b)
            all_active_roots.push_back(b);
        }
      if (!block_of.empty())
        active_unknowns.select(mask([](const Group &) { return true; }));
    }


    void
    NewtonGroups::unite(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      if (block_of.empty())
        return;
      const MatrixRows entries(matrix);
      bool             has_joined = false;
      active_unknowns.for_each(n_all, [&](const unsigned int row) {
        for (int i = entries.begins[row]; i < entries.begins[row + 1]; ++i)
        {
          const unsigned int other = block_of[entries.columns[i]];
          if (other == block_of[row] || entries.values[i] == 0.)
            continue;
          const unsigned int a = joined.find(block_of[row]),
                             b = joined.find(other);
          // what is not active does not feel this row: see NonlinearSystem
          if (a == b || states[b] != State::active)
            continue;
          Group both;
          both.n_unknowns = groups[a].n_unknowns + groups[b].n_unknowns;
          joined.join(a, b);
          groups[joined.find(a)] = both;
          has_joined             = true;
        }
      });
      if (has_joined)
        number_roots();
    }


    double
    NewtonGroups::active_share() const
    {
      double n = 0.;
      for (const unsigned int root : all_active_roots)
        n += groups[root].n_unknowns;
      return n / n_all;
    }


    void
    NewtonGroups::wake(const std::vector<unsigned int> &blocks)
    {
      bool is_any = false;
      for (const unsigned int block : blocks)
      {
        const unsigned int root = root_of[block];
        if (states[root] == State::active || states[root] == State::held)
          continue;
        const unsigned int n    = groups[root].n_unknowns;
        groups[root]            = Group();
        groups[root].n_unknowns = n;
        states[root]            = State::active;
        is_any                  = true;
      }
      if (is_any)
        list_active();
    }


    void
    NewtonGroups::let_go()
    {
      bool is_any = false;
      for (const unsigned int root : all_active_roots)
        if (groups[root].has_converged)
        {
          states[root] = State::done;
          is_any       = true;
        }
      if (is_any)
        list_active();
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
                                 group.product += r[i] * c[i];
                                 group.square += r[i] * r[i];
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
