#ifndef nmm_source_mechanics_newton_groups_h
#define nmm_source_mechanics_newton_groups_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <base/disjoint_sets.h>
#include <mechanics/active_items.h>
#include <mechanics/share_search.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Blocks that hang together in a system of equations, because something of one
     * presses on something of the other: groups, each of which Newton's
     * method solves at its own pace. Groups only ever grow during a solution.
     * One group of all unknowns if there are no blocks to tell apart.
     *
     * Some are being solved (active), others are done, or held: not solved at all.
     */
    class NewtonGroups
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      struct Group
      {
        /// It has the tangent of this iteration.
        bool has_tangent = false;
        /// In the last iteration.
        bool         has_converged = false;
        unsigned int n_unknowns    = 0;
        /// Of the iterations since it was made, joined another one or was woken:
        /// |r|^2 over the square of the force scale, and |r . du|.
        std::vector<double> squares, energies;
        /// Residuals must go down from now on.
        bool        goes_round = false;
        ShareSearch search;
        /// r . du and |r|^2 now.
        double product = 0., square = 0.;
      };

      /// All is active but what @p is_held says (empty: nothing). @p blocks: of each
      /// owned unknown, or empty.
      void
      reinit(const std::vector<unsigned int> &blocks,
             const std::vector<bool>         &is_held,
             const Vector                    &like);

      /// Blocks that values of active rows of @p matrix other than zero couple are
      /// one group from now on. What joins begins its history anew.
      void
      unite(const dealii::TrilinosWrappers::SparseMatrix &matrix);

      /// Roots, one block of each group: of all groups, and of active ones.
      const std::vector<unsigned int> &
      roots() const
      {
        return all_roots;
      }

      const std::vector<unsigned int> &
      active_roots() const
      {
        return all_active_roots;
      }

      Group &
      operator[](const unsigned int root)
      {
        return groups[root];
      }

      const Group &
      operator[](const unsigned int root) const
      {
        return groups[root];
      }

      bool
      are_there_several() const
      {
        return !block_of.empty();
      }

      bool
      is_any_active() const
      {
        return !all_active_roots.empty();
      }

      /// Share of all unknowns that are in active groups.
      double
      active_share() const;

      unsigned int
      n_unknowns() const
      {
        return n_all;
      }

      /// The groups of these blocks are active again, from the beginning, unless they are
      /// held.
      void
      wake(const std::vector<unsigned int> &blocks);

      /// Active groups that have converged are done.
      void
      let_go();

      /// Blocks of active groups for which @p is_meant; empty if that is all blocks.
      template <typename Predicate>
      std::vector<bool>
      mask(const Predicate &is_meant) const
      {
        unsigned int      n = 0;
        std::vector<bool> result(groups.size(), false);
        for (const unsigned int b : active_blocks)
          if (is_meant(groups[root_of[b]]))
          {
            result[b] = true;
            ++n;
          }
        return n == groups.size() ? std::vector<bool>() : result;
      }

      /// Is the i-th owned unknown in a block of a mask()?
      bool
      is_in(const std::vector<bool> &blocks, const unsigned int i) const
      {
        return blocks.empty() || blocks[block_of.empty() ? 0 : block_of[i]];
      }

      /// Owned unknowns of active groups.
      const ActiveItems &
      unknowns() const
      {
        return active_unknowns;
      }

      /// Group of the i-th owned unknown.
      Group &
      of_unknown(const unsigned int i)
      {
        return groups[block_of.empty() ? 0 : root_of[block_of[i]]];
      }

      /// Products and squares of active groups, from the residual and a correction.
      void
      sum(const Vector &residual, const Vector &correction);

      /// Squares of all groups.
      void
      sum_squares(const Vector &residual);

    private:
      enum class State : unsigned char
      {
        active,
        done,
        held
      };

      void
      number_roots();

      /// Lists of what is active.
      void
      list_active();

      DisjointSets              joined;
      std::vector<unsigned int> block_of, root_of, all_roots, all_active_roots,
        active_blocks;
      std::vector<Group> groups;
      std::vector<State> states;
      ActiveItems        active_unknowns;
      unsigned int       n_all = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
