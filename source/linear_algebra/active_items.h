#ifndef nmm_source_linear_algebra_active_items_h
#define nmm_source_linear_algebra_active_items_h

#include <cstdint>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * What belongs to blocks (rows, elements, points of contact), and of that what
     * belongs to the blocks that count at present, ascending; all of it unless said
     * otherwise. Choosing some takes as long as they are many, but for a bit per item and
     * block.
     */
    class ActiveItems
    {
    public:
      /// Items 0 to @p n - 1. @p for_each calls its argument with each item and block
      /// that belong together; an item may belong to several blocks or none.
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
        bits.assign((n + 63) / 64, 0);
        select({});
      }

      /// Each item belongs to one block.
      void
      reinit(const std::vector<unsigned int> &item_to_block)
      {
        reinit(item_to_block.size(), [&](const auto &add) {
          for (unsigned int i = 0; i < item_to_block.size(); ++i)
            add(i, item_to_block[i]);
        });
      }

      /// Nothing is known until reinit().
      void
      clear()
      {
        is_known = false;
        is_all   = true;
      }

      bool
      empty() const
      {
        return !is_known;
      }

      /// From now on those of @p blocks count; empty: all.
      void
      select(const std::vector<bool> &blocks)
      {
        is_all = blocks.empty();
        active.clear();
        for (unsigned int b = 0; b < blocks.size() && b + 2 < begins.size();
             ++b)
          if (blocks[b])
            for (unsigned int i = begins[b]; i < begins[b + 1]; ++i)
              bits[of_blocks[i] / 64] |= std::uint64_t(1)
                                         << (of_blocks[i] % 64);
        for (unsigned int word = 0; !is_all && word < bits.size(); ++word)
          for (; bits[word] != 0; bits[word] &= bits[word] - 1)
            active.push_back(64 * word + __builtin_ctzll(bits[word]));
      }

      bool
      all() const
      {
        return is_all;
      }

      /// Those that count, unless all do.
      const std::vector<unsigned int> &
      chosen() const
      {
        return active;
      }

      /// Call action(item), the items being 0 to @p n - 1 if all count.
      template <typename Action>
      void
      for_each(const unsigned int n, const Action &action) const
      {
        if (is_all)
          for (unsigned int i = 0; i < n; ++i)
            action(i);
        else
          for (const unsigned int i : active)
            action(i);
      }

    private:
      bool is_all = true, is_known = false;
      /// Items of one block after the other.
      std::vector<unsigned int>  begins, of_blocks, active;
      std::vector<std::uint64_t> bits;
    };
  } // namespace internal
} // namespace NMM

#endif
