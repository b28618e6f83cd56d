#ifndef nmm_source_base_hash_h
#define nmm_source_base_hash_h

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace NMM
{
  namespace internal
  {
    /// The 64-bit FNV-1a hash of the bytes of all values that are added.
    class Hash
    {
    public:
      void
      add_bytes(const void *bytes, const std::size_t n)
      {
        const unsigned char *byte = static_cast<const unsigned char *>(bytes);
        for (std::size_t i = 0; i < n; ++i)
        {
          sum ^= byte[i];
          sum *= 1099511628211ull;
        }
      }

      template <typename Number>
      void
      add(const Number number)
      {
        add_bytes(&number, sizeof(Number));
      }

      std::uint64_t
      value() const
      {
        return sum;
      }

    private:
      std::uint64_t sum = 14695981039346656037ull;
    };
  } // namespace internal
} // namespace NMM

#endif
