#ifndef nmm_source_solution_newton_groups_h
#define nmm_source_solution_newton_groups_h

#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <base/disjoint_sets.h>
#include <linear_algebra/active_items.h>
#include <solution/share_search.h>
#include <utility>
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
     * What an iteration corrects of an active group is what is far from equilibrium and
     * what is near that: few blocks of a large heap, in the end.
     */
    class NewtonGroups
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      struct Group
      {
        /// In the last iteration.
        bool         has_converged = false;
        unsigned int n_unknowns    = 0;
        /// What touches at so many hands what is far from equilibrium is corrected.
        unsigned int n_rings = 2;
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

      /// What is corrected from now on: in each active group blocks the residual of which
      /// is not known, or above a tenth of their part of @p allowed, and what touches
      /// those at second hand; all if there are none, or if it goes round. What is left out feels
      /// corrections as forces, see watched(): where those are above a tenth of the
      /// residual of the group, equilibrium is a matter of more than neighbours (a tower
      /// at rest), and from then on twice as many hands count. @p scale: of forces.
      void
      choose(const Vector &residual, double scale, double allowed);

      /// Blocks that are to be corrected and have no tangent yet.
      std::vector<bool>
      without_tangent() const;

      /// All blocks that are to be corrected have one?
      bool
      have_tangents() const;

      /// Rows of @p blocks (empty: all) of the tangent @p matrix are new. What is coupled in
      /// them, by @p pairs or, if those are not known (null), by values other than zero,
      /// is one group from now on; what joins begins its history anew. Blocks that
      /// were not coupled before are corrected, too.
      void
      unite(const std::vector<bool>                      &blocks,
            const dealii::TrilinosWrappers::SparseMatrix &matrix,
            const std::vector<BlockPair>                 *pairs = nullptr);

      /// The same of a matrix that has no other blocks.
      void
      unite(const std::vector<bool> &blocks, const BodyMatrix &matrix);

      /// With which each block was coupled when its rows were new.
      const std::vector<std::vector<unsigned int>> &
      couplings() const
      {
        return neighbours;
      }

      /// No block has its tangent.
      void
      lose_tangents();

      /// The residual of @p blocks (empty: all) is known.
      void
      note_residual(const std::vector<bool> &blocks);

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

      /// Share of all unknowns that are being corrected.
      double
      corrected_share() const;

      unsigned int
      n_unknowns() const
      {
        return n_all;
      }

      /// The groups of these blocks are active again, from the beginning, if they are
      /// done; is the residual of these blocks known?
      void
      wake(const std::vector<unsigned int> &blocks,
           const bool                       is_known = false);

      /// Active groups that have converged are done.
      void
      let_go();

      /// Blocks of active groups for which @p is_meant the residual of which corrections
      /// change: those that are corrected, and what touches them. Empty if that is all
      /// blocks.
      template <typename Predicate>
      std::vector<bool>
      watched(const Predicate &is_meant) const
      {
        unsigned int      n = 0;
        std::vector<bool> result(groups.size(), false);
        for (const unsigned int b : watched_blocks)
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

      /// And those that are being corrected.
      const ActiveItems &
      corrected() const
      {
        return corrected_unknowns;
      }

      /// Group of the i-th owned unknown.
      Group &
      of_unknown(const unsigned int i)
      {
        return groups[block_of.empty() ? 0 : root_of[block_of[i]]];
      }

      /// Products and squares of active groups, from the residual and a correction,
      /// which is zero but for what is being corrected.
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

      struct Block
      {
        bool residual_is_known = false, is_loud = false, is_corrected = false,
             is_watched = false, has_tangent = false;
        unsigned int n_unknowns = 0;
      };

      /// To neighbours_before what was coupled with @p blocks before their rows were new;
      /// nothing is, then.
      void
      take_neighbours(const std::vector<bool> &blocks);

      /// Blocks that are coupled now are one group.
      void
      unite_neighbours(const std::vector<bool> &blocks);

      /// Neighbours of @p blocks by values.
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
      number_roots();

      /// Lists of what is active.
      void
      list_active();

      /// Groups that need more rings have them.
      void
      widen(const std::vector<double> &squares, double scale);

      /// What is loud (not known to be in equilibrium) and what is near that, each with
      /// its distance: 0, 1, ... rings, one more than are corrected.
      std::vector<std::pair<unsigned int, unsigned int>>
      near_loud() const;

      /// What is loud and what is near is corrected.
      void
      extend();

      void
      join(const unsigned int i, const unsigned int j);

      DisjointSets              joined;
      std::vector<unsigned int> block_of, root_of, all_roots, all_active_roots,
        active_blocks, watched_blocks;
      std::vector<Group> groups;
      std::vector<State> states;
      std::vector<Block> all_blocks;
      /// See couplings().
      std::vector<std::vector<unsigned int>> neighbours;
      /// See take_neighbours(): of one block after the other, and where those of each
      /// begin and end; kept, since it is asked for in each iteration.
      std::vector<unsigned int> neighbours_before;
      std::vector<BlockPair>    before_of_block;
      ActiveItems               active_unknowns, corrected_unknowns;
      unsigned int              n_all = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
