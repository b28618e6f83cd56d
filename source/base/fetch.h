#ifndef nmm_source_base_fetch_h
#define nmm_source_base_fetch_h

#include <cstddef>

namespace NMM
{
  namespace internal
  {
    /// Prefetches @p n items into the cache, for accesses that are scattered in memory, which the
    /// processor cannot predict. It has no other effect.
    template <typename Item>
    void
    fetch(const Item *items, const std::size_t n)
    {
      constexpr std::size_t line  = 64;
      const char           *bytes = reinterpret_cast<const char *>(items);
      for (std::size_t b = 0; b < n * sizeof(Item); b += line)
        __builtin_prefetch(bytes + b);
    }
  } // namespace internal
} // namespace NMM

#endif
