#ifndef nmm_source_base_fetch_h
#define nmm_source_base_fetch_h

#include <cstddef>

namespace NMM
{
  namespace internal
  {
    /// Bring @p n items into the cache before it is their turn: for what does not lie one
    /// after the other, so that the processor cannot foresee it. Has no other effect.
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
