#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
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
      block_of = blocks;
      n_all    = like.size();
      const unsigned int n =
        blocks.empty() ? 1
                       : *std::max_element(blocks.begin(), blocks.end()) + 1;
      groups.assign(n, Group());
      joined.reinit(n);
      if (blocks.empty())
        groups[0].n_unknowns = n_all;
      for (const unsigned int block : blocks)
        ++groups[block].n_unknowns;
      for (unsigned int b = 0; b < is_held.size() && b < n; ++b)
        if (is_held[b])
        {
          groups[b].is_active = false;
          groups[b].is_held   = true;
        }
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
    }


    void
    NewtonGroups::unite(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      if (block_of.empty())
        return;
      const Epetra_CrsMatrix &entries    = matrix.trilinos_matrix();
      bool                    has_joined = false;
      for (int row = 0; row < entries.NumMyRows(); ++row)
      {
        if (!groups[joined.find(block_of[row])].is_active)
          continue;
        int     n;
        double *values;
        int    *columns;
        entries.ExtractMyRowView(row, n, values, columns);
        for (int i = 0; i < n; ++i)
        {
          const unsigned int other = block_of[columns[i]];
          if (other == block_of[row] || values[i] == 0.)
            continue;
          const unsigned int a = joined.find(block_of[row]),
                             b = joined.find(other);
          // what is not active does not feel this row: see NonlinearSystem
          if (a == b || !groups[a].is_active || !groups[b].is_active)
            continue;
          Group both;
          both.n_unknowns = groups[a].n_unknowns + groups[b].n_unknowns;
          joined.join(a, b);
          groups[joined.find(a)] = both;
          has_joined             = true;
        }
      }
      if (has_joined)
        number_roots();
    }


    bool
    NewtonGroups::is_any_active() const
    {
      return std::any_of(all_roots.begin(),
                         all_roots.end(),
                         [&](const unsigned int root) {
                           return groups[root].is_active;
                         });
    }


    double
    NewtonGroups::active_share() const
    {
      double n = 0.;
      for (const unsigned int root : all_roots)
        n += groups[root].is_active ? groups[root].n_unknowns : 0.;
      return n / n_all;
    }


    void
    NewtonGroups::wake(const unsigned int block)
    {
      Group &group = groups[root_of[block]];
      if (group.is_active || group.is_held)
        return;
      const unsigned int n = group.n_unknowns;
      group                = Group();
      group.n_unknowns     = n;
    }


    void
    NewtonGroups::sum(const Vector &residual, const Vector &correction)
    {
      for (const unsigned int root : all_roots)
        groups[root].product = groups[root].square = 0.;
      auto r = residual.begin();
      auto c = correction.begin();
      for (unsigned int i = 0; r != residual.end(); ++r, ++c, ++i)
      {
        Group &group = of_unknown(i);
        group.product += *r * *c;
        group.square += *r * *r;
      }
      if (!block_of.empty())
        return;
      double sums[2] = {groups[0].product, groups[0].square};
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 2),
                                  residual.get_mpi_communicator(),
                                  dealii::ArrayView<double>(sums, 2));
      groups[0].product = sums[0];
      groups[0].square  = sums[1];
    }
  } // namespace internal
} // namespace NMM
