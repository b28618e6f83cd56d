// Counts calls of operator new in this program and its libraries.

#include "counts.h"
#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
  std::atomic<unsigned long> n_calls(0);
}


void *
operator new(const std::size_t size)
{
  n_calls.fetch_add(1, std::memory_order_relaxed);
  if (void *memory = std::malloc(size > 0 ? size : 1))
    return memory;
  throw std::bad_alloc();
}


void
operator delete(void *memory) noexcept
{
  std::free(memory);
}


void
operator delete(void *memory, std::size_t) noexcept
{
  std::free(memory);
}


unsigned long
NMM::Bench::n_allocations()
{
  return n_calls;
}
