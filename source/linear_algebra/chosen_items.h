#ifndef nmm_source_linear_algebra_chosen_items_h
#define nmm_source_linear_algebra_chosen_items_h

#include <cstdint>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The items (rows, elements or contact points) that belong to chosen blocks, in ascending
     * order. All blocks are chosen at first.
     * Cost of select(): O(chosen items), and a bit for each item and block.
     */
    class ChosenItems
    {
    public:
      /// Set the items 0 to @p n - 1. @p for_each is a function that calls its argument with each
      /// pair of an item and a block it belongs to; an item may belong to several blocks or none.
      template <typename ForEach>
      void
      reinit(const unsigned int n, const ForEach &for_each)
      {
        begins.assign(2, 0);
        for_each([this](unsigned int, const unsigned int block) {
          if (block + 2 >= begins.size())
            begins.resize(block + 3, 0);
          ++begins[block + 2];
        });
        for (unsigned int b = 2; b < begins.size(); ++b)
          begins[b] += begins[b - 1];
        of_blocks.resize(begins.back());
        for_each([this](const unsigned int item, const unsigned int block) {
          of_blocks[begins[block + 1]++] = item;
        });
        is_known = true;
        of_chosen.clear();
        bits.assign((n + 63) / 64, 0);
        select({});
      }

      /// The same if each item belongs to one block.
      void
      reinit(const std::vector<unsigned int> &item_to_block)
      {
        reinit(item_to_block.size(), [&](const auto &add) {
          for (unsigned int i = 0; i < item_to_block.size(); ++i)
            add(i, item_to_block[i]);
        });
      }

      /// Forget the items until the next reinit().
      void
      clear()
      {
        is_known = false;
        is_all   = true;
      }

      /// Whether no items have been set since the last clear().
      bool
      empty() const
      {
        return !is_known;
      }

      /// Choose @p blocks; empty: all.
      void
      select(const std::vector<bool> &blocks)
      {
        is_all = blocks.empty();
        for (const unsigned int item : of_chosen)
          bits[item / 64] = 0;
        of_chosen.clear();
        for (unsigned int b = 0; b < blocks.size() && b + 2 < begins.size();
             ++b)
          if (blocks[b])
            for (unsigned int i = begins[b]; i < begins[b + 1]; ++i)
              bits[of_blocks[i] / 64] |= std::uint64_t(1)
                                         << (of_blocks[i] % 64);
        for (unsigned int word = 0; !is_all && word < bits.size(); ++word)
          for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
            of_chosen.push_back(64 * word + __builtin_ctzll(rest));
      }

      /// Whether all blocks are chosen.
      bool
      all() const
      {
        return is_all;
      }

      /// Whether an item is chosen.
      bool
      contains(const unsigned int item) const
      {
        return is_all || (bits[item / 64] >> (item % 64) & 1) != 0;
      }

      /// Chosen items in ascending order; undefined if all() is true.
      const std::vector<unsigned int> &
      chosen() const
      {
        return of_chosen;
      }

      /// Call action(item) for all chosen items; if all() is true, these are 0 to @p n - 1.
      template <typename Action>
      void
      for_each(const unsigned int n, const Action &action) const
      {
        if (is_all)
          for (unsigned int i = 0; i < n; ++i)
            action(i);
        else
          for (const unsigned int i : of_chosen)
            action(i);
      }

    private:
      bool is_all = true, is_known = false;
      /// Items sorted by block (of_blocks), the index of the first item of each block (begins),
      /// and the chosen items.
      std::vector<unsigned int> begins, of_blocks, of_chosen;
      /// For each item, a bit that is set if the item is in the list of chosen items.
      std::vector<std::uint64_t> bits;
    };
  } // namespace internal
} // namespace NMM

#endif
