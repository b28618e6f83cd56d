#ifndef nmm_source_solution_newton_groups_h
#define nmm_source_solution_newton_groups_h

#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <base/disjoint_sets.h>
#include <linear_algebra/active_items.h>
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
     * A group is active while it is being solved, then done; a group that is held is not solved
     * at all. In an active group an iteration corrects the blocks that are far from equilibrium
     * and the neighbours of these: in the end few blocks of a large heap.
     */
    class NewtonGroups
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      struct Group
      {
        /// Whether it had converged in the last iteration.
        bool         has_converged = false;
        unsigned int n_unknowns    = 0;
        /// Largest distance in the contact graph from a block that has not converged at which
        /// blocks are corrected.
        unsigned int n_rings = 2;
        /// |r|^2 over the square of the force scale and |r . du| in each iteration since the
        /// group was made, joined another one or was reactivated.
        std::vector<double> squares, energies;
        /// Whether contact states cycle, so that residuals must decrease from now on.
        bool       is_cycling = false;
        LineSearch search;
        /// Current values of r . du and |r|^2.
        double product = 0., square = 0.;
      };

      /// Begin a solution: all blocks are active except those that @p is_held names (empty:
      /// none). @p blocks gives the block of each owned unknown, or is empty.
      void
      reinit(const std::vector<unsigned int> &blocks,
             const std::vector<bool>         &is_held,
             const Vector                    &like);

      /// Choose the blocks that are corrected from now on. In each active group these are the
      /// blocks whose residual is unknown or above a tenth of their part of @p allowed, and their
      /// neighbours up to Group::n_rings; if there are none, all blocks of the group. Blocks just
      /// outside feel the corrections as forces, see affected(). Where these are above a tenth of
      /// the group's residual, as in a tower at rest, or if the group cycles, the number of rings
      /// doubles. @p scale is the force scale [N/m].
      void
      choose(const Vector &residual, double scale, double allowed);

      /// Corrected blocks whose rows of the tangent have not been assembled.
      std::vector<bool>
      blocks_without_tangent() const;

      /// Whether the rows of all corrected blocks have been assembled.
      bool
      have_tangents() const;

      /// The rows of @p blocks (empty: all) of the tangent @p matrix have been assembled. Blocks
      /// that are coupled in them, by @p pairs or, if these are unknown (null), by values other
      /// than zero, are one group from now on; a group that joins another one begins its history
      /// anew. Blocks that were not coupled before are corrected, too.
      void
      unite(const std::vector<bool>                      &blocks,
            const dealii::TrilinosWrappers::SparseMatrix &matrix,
            const std::vector<BlockPair>                 *pairs = nullptr);

      /// The same for a body matrix.
      void
      unite(const std::vector<bool> &blocks, const BodyMatrix &matrix);

      /// For each block, the blocks that it was coupled with when its rows were assembled last.
      const std::vector<std::vector<unsigned int>> &
      couplings() const
      {
        return neighbours;
      }

      /// The rows of all blocks have to be assembled again.
      void
      invalidate_tangents();

      /// The residual of @p blocks (empty: all) has been assembled.
      void
      note_residual(const std::vector<bool> &blocks);

      /// The root of each group, one of its blocks, by which groups are addressed; here of all
      /// groups, below of active ones.
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

      /// Part of all unknowns that is corrected [-].
      double
      corrected_share() const;

      unsigned int
      n_unknowns() const
      {
        return n_all;
      }

      /// Make the groups of these blocks active again, with a new history, if they are done.
      /// @p is_known: whether the residual of these blocks has been assembled.
      void
      reactivate(const std::vector<unsigned int> &blocks,
                 const bool                       is_known = false);

      /// Mark active groups that have converged as done.
      void
      retire_converged();

      /// Blocks whose residual changes with the corrections: those that are corrected and the
      /// blocks that touch them, of active groups for which @p is_meant is true. Empty if these
      /// are all blocks.
      template <typename Predicate>
      std::vector<bool>
      affected(const Predicate &is_meant) const
      {
        unsigned int      n = 0;
        std::vector<bool> result(groups.size(), false);
        for (const unsigned int b : affected_blocks)
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
      const ActiveItems &
      unknowns() const
      {
        return active_unknowns;
      }

      /// Owned unknowns that are corrected.
      const ActiveItems &
      corrected() const
      {
        return corrected_unknowns;
      }

      /// The group of the i-th owned unknown.
      Group &
      of_unknown(const unsigned int i)
      {
        return groups[block_of.empty() ? 0 : root_of[block_of[i]]];
      }

      /// Set product and square of active groups from the residual and a correction, which is
      /// zero in unknowns that are not corrected.
      void
      sum(const Vector &residual, const Vector &correction);

      /// Set the squares of all groups.
      void
      sum_squares(const Vector &residual);

    private:
      enum class State : unsigned char
      {
        active,
        done,
        held
      };

      struct Block
      {
        bool residual_is_known = false, is_unconverged = false,
             is_corrected = false, is_affected = false, has_tangent = false;
        unsigned int n_unknowns = 0;
      };

      /// Move the neighbours of @p blocks to neighbours_before, and leave these blocks without.
      void
      store_neighbours(const std::vector<bool> &blocks);

      /// Join the groups of blocks that are coupled now.
      void
      unite_neighbours(const std::vector<bool> &blocks);

      /// Find the neighbours of @p blocks from values other than zero.
      void
      find_neighbours(const std::vector<bool>                      &blocks,
                      const dealii::TrilinosWrappers::SparseMatrix &matrix);

      void
      add_neighbour(const unsigned int block, const unsigned int other)
      {
        auto &all = neighbours[block];
        if (std::find(all.begin(), all.end(), other) == all.end())
          all.push_back(other);
      }

      void
      update_roots();

      /// Make the lists of active groups, blocks and unknowns anew.
      void
      update_active_lists();

      /// Double the number of rings of groups that need more, see choose().
      void
      widen_rings(const std::vector<double> &squares, double scale);

      /// Blocks that have not converged and their neighbours, each with its distance: 0, 1, ...
      /// rings, up to one more than are corrected.
      std::vector<std::pair<unsigned int, unsigned int>>
      unconverged_neighbourhood() const;

      /// Correct the blocks that have not converged and their neighbours.
      void
      select_corrected();

      void
      join(const unsigned int i, const unsigned int j);

      DisjointSets              joined;
      std::vector<unsigned int> block_of, root_of, all_roots, all_active_roots,
        active_blocks, affected_blocks;
      std::vector<Group> groups;
      std::vector<State> states;
      std::vector<Block> all_blocks;
      /// What couplings() returns.
      std::vector<std::vector<unsigned int>> neighbours;
      /// Neighbours before the last assembly, one block after the other, and where those of each
      /// block begin and end, see store_neighbours().
      std::vector<unsigned int> neighbours_before;
      std::vector<BlockPair>    before_of_block;
      ActiveItems               active_unknowns, corrected_unknowns;
      unsigned int              n_all = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
