#ifndef nmm_source_base_in_order_h
#define nmm_source_base_in_order_h

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/std_cxx20/iota_view.h>
#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Calls work(i, result) for each i in [@p first, @p last), on as many threads as
     * deal.II may use (dealii::MultithreadInfo), and take(i, result) in ascending order of i, one
     * at a time. Sums that take() makes are therefore the same to the last bit for any number of
     * threads. Objects of type Result are used again, so that work() must overwrite what they
     * contain. On one thread both functions are called alternately, without any copy.
     */
    template <typename Result, typename Work, typename Take>
    void
    for_each_in_order(const unsigned int first,
                      const unsigned int last,
                      const Work        &work,
                      const Take        &take)
    {
      // Assembling the systems of this many elements takes about a hundred microseconds.
      constexpr unsigned int block_size = 32;
      const unsigned int     n_threads  = dealii::MultithreadInfo::n_threads();
      if (n_threads == 1 || last <= first + block_size)
      {
        Result result;
        for (unsigned int i = first; i < last; ++i)
        {
          work(i, result);
          take(i, result);
        }
        return;
      }

      struct Block
      {
        unsigned int begin = 0, end = 0;
        // They are made by the thread that needs them first, not copied.
        std::vector<Result> results;
      };
      struct Scratch
      {
      };
      const dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
        blocks(0U, (last - first + block_size - 1) / block_size);
      dealii::WorkStream::run(
        blocks.begin(),
        blocks.end(),
        [&](const auto &b, Scratch &, Block &block) {
          block.results.resize(block_size);
          block.begin = first + *b * block_size;
          block.end   = std::min(block.begin + block_size, last);
          for (unsigned int i = block.begin; i < block.end; ++i)
            work(i, block.results[i - block.begin]);
        },
        [&](const Block &block) {
          for (unsigned int i = block.begin; i < block.end; ++i)
            take(i, const_cast<Result &>(block.results[i - block.begin]));
        },
        Scratch(),
        Block(),
        2 * n_threads,
        1);
    }
  } // namespace internal
} // namespace NMM

#endif
