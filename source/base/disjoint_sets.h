#ifndef nmm_source_base_disjoint_sets_h
#define nmm_source_base_disjoint_sets_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Disjoint sets of 0, 1, ... n - 1, with path halving. At any time the least member of a set
     * represents it, so that the numbers of sets do not depend on the order of calls.
     * (boost::disjoint_sets needs another pass over all members for that.)
     */
    class DisjointSets
    {
    public:
      explicit DisjointSets(const unsigned int n = 0)
      {
        reinit(n);
      }

      /// Starts again with @p n members, each in a set of its own.
      void
      reinit(const unsigned int n)
      {
        parent.resize(n);
        std::iota(parent.begin(), parent.end(), 0u);
      }

      /// Least member of the set of @p i.
      unsigned int
      find(unsigned int i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }

      void
      join(const unsigned int i, const unsigned int j)
      {
        const unsigned int a = find(i), b = find(j);
        parent[std::max(a, b)] = std::min(a, b);
      }

      /// Numbers the sets consecutively, in the order of their least members. Returns the number
      /// of sets.
      unsigned int
      number(std::vector<unsigned int> &member_to_set)
      {
        unsigned int n = 0;
        member_to_set.resize(parent.size());
        for (unsigned int i = 0; i < parent.size(); ++i)
          member_to_set[i] = find(i) == i ? n++ : member_to_set[find(i)];
        return n;
      }

    private:
      std::vector<unsigned int> parent;
    };
  } // namespace internal
} // namespace NMM

#endif
