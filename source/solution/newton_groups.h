#ifndef nmm_source_solution_newton_groups_h
#define nmm_source_solution_newton_groups_h

#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <base/disjoint_sets.h>
#include <linear_algebra/chosen_items.h>
#include <solution/line_search.h>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Groups of blocks that touch (connected components of the contact graph), each of which
     * Newton's method solves at its own pace. Groups only ever grow during a solution. If the
     * system has no blocks, all unknowns are one group.
     *
     * A group is active while it is being solved, and done once it has converged. A group that
     * sleeps is not solved at all.
     *
     * Order of calls: reinit(); in each iteration unite() after the assembly of the tangent, sum()
     * after each assembly of a residual, and retire_converged(). Before the end, reactivate() what
     * has not converged after all.
     */
    class NewtonGroups
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      /// Progress of the solution of a group.
      struct Group
      {
        /// Whether the group had converged after the last iteration.
        bool         has_converged = false;
        unsigned int n_unknowns    = 0;
        /// |r|^2 over the square of the force scale and |r . du| in each iteration since the group
        /// was made, joined another one or was reactivated.
        std::vector<double> squares, energies;
        /// Whether contact states cycle, so that residuals must decrease from now on.
        bool       is_cycling = false;
        LineSearch search;
        /// Current values of r . du and |r|^2.
        double product = 0., square = 0.;
      };

      /// Begin a solution: all blocks are active except those that @p sleeps names (empty: none).
      /// @p blocks gives the block of each owned unknown, or is empty. All active blocks are one
      /// group unless @p are_separate.
      void
      reinit(const std::vector<unsigned int> &blocks,
             const std::vector<bool>         &sleeps,
             bool                             are_separate,
             const Vector                    &like);

      /// Record that the rows of active blocks of the tangent @p matrix have been assembled. Active
      /// blocks that are coupled in these rows by nonzero values are one group from now on; those
      /// that are done join it in retire_converged(), since their rows have not been assembled. A group
      /// that joins another one begins its history anew.
      void
      unite(const dealii::TrilinosWrappers::SparseMatrix &matrix);

      /// The same for a body matrix.
      void
      unite(const BodyMatrix &matrix);

      /// For each block, the blocks that it was coupled with when its rows were assembled last.
      const std::vector<std::vector<unsigned int>> &
      couplings() const
      {
        return neighbours;
      }

      /// The roots of all groups. The root of a group is one of its blocks; its number addresses
      /// the group.
      const std::vector<unsigned int> &
      roots() const
      {
        return all_roots;
      }

      /// The roots of active groups.
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

      /// Whether the system has blocks, so that there may be several groups.
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

      /// Number of unknowns of active groups divided by that of all unknowns [-].
      double
      solved_share() const;

      unsigned int
      n_unknowns() const
      {
        return n_all;
      }

      /// Make the groups of these blocks active again, with a new history, if they are done.
      void
      reactivate(const std::vector<unsigned int> &blocks);

      /// Mark active groups that have converged as done, and let groups that are done join those
      /// active ones that unite() found to be coupled with them.
      void
      retire_converged();

      /// For each block, whether it belongs to an active group for which @p is_meant is true. Empty
      /// if all blocks do.
      template <typename Predicate>
      std::vector<bool>
      active(const Predicate &is_meant) const
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

      /// Whether the i-th owned unknown belongs to one of @p blocks (empty: all).
      bool
      is_in(const std::vector<bool> &blocks, const unsigned int i) const
      {
        return blocks.empty() || blocks[block_of.empty() ? 0 : block_of[i]];
      }

      /// Owned unknowns of active groups.
      const ChosenItems &
      unknowns() const
      {
        return chosen_unknowns;
      }

      /// The group of the i-th owned unknown.
      Group &
      of_unknown(const unsigned int i)
      {
        return groups[block_of.empty() ? 0 : root_of[block_of[i]]];
      }

      /// Compute Group::product and Group::square of active groups from the residual and a
      /// correction.
      void
      sum(const Vector &residual, const Vector &correction);

      /// Compute Group::square of all groups.
      void
      sum_squares(const Vector &residual);

    private:
      /// State of a group, stored at its root.
      enum class State : unsigned char
      {
        active,
        done,
        asleep
      };

      /// Join the groups of active blocks with those of the blocks they are coupled with.
      void
      unite_neighbours();

      void
      add_neighbour(const unsigned int block, const unsigned int other)
      {
        auto &all = neighbours[block];
        if (std::find(all.begin(), all.end(), other) == all.end())
          all.push_back(other);
      }

      void
      update_roots();

      /// Recompute the lists of active groups, blocks and unknowns.
      void
      update_active_lists();

      void
      join(const unsigned int i, const unsigned int j);

      DisjointSets              joined;
      std::vector<unsigned int> block_of, root_of, all_roots, all_active_roots,
        active_blocks;
      std::vector<Group> groups;
      std::vector<State> states;
      /// For each block, the blocks it is coupled with; see couplings().
      std::vector<std::vector<unsigned int>> neighbours;
      /// Blocks whose groups are joined by retire_converged().
      std::vector<BlockPair> late_pairs;
      ChosenItems            chosen_unknowns;
      unsigned int           n_all = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
