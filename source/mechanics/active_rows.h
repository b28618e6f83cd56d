#ifndef nmm_source_mechanics_active_rows_h
#define nmm_source_mechanics_active_rows_h

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Rows of the blocks that count at present, ascending; all of them unless said otherwise.
    class ActiveRows
    {
    public:
      /// Those of @p blocks, @p block_of having the block of each row; empty: all.
      void
      select(const std::vector<unsigned int> &block_of,
             const std::vector<bool>         &blocks)
      {
        are_all = blocks.empty();
        rows.clear();
        for (unsigned int r = 0; !are_all && r < block_of.size(); ++r)
          if (blocks[block_of[r]])
            rows.push_back(r);
      }

      bool
      all() const
      {
        return are_all;
      }

      /// Call action(row), the rows being 0 to @p n - 1 if all count.
      template <typename Action>
      void
      for_each(const unsigned int n, const Action &action) const
      {
        if (are_all)
          for (unsigned int r = 0; r < n; ++r)
            action(r);
        else
          for (const unsigned int r : rows)
            action(r);
      }

    private:
      bool                      are_all = true;
      std::vector<unsigned int> rows;
    };
  } // namespace internal
} // namespace NMM

#endif
