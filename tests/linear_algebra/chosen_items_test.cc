// Items of chosen blocks against looking at all of them.

#include <algorithm>
#include <gtest/gtest.h>
#include <linear_algebra/chosen_items.h>
#include <random>
#include <set>

using namespace NMM;
using namespace NMM::internal;

namespace
{
  std::vector<unsigned int>
  all_of(const ChosenItems &items, const unsigned int n)
  {
    std::vector<unsigned int> result;
    items.for_each(n, [&](const unsigned int i) { result.push_back(i); });
    return result;
  }


  // Each item belongs to none, one or several of the blocks; those chosen before leave
  // nothing behind.
  TEST(ChosenItems, OfRandomBlocks)
  {
    const unsigned int seed = 20261123;
    std::mt19937       generator(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const unsigned int n : {1U, 63U, 64U, 65U, 1000U})
    {
      const unsigned int                  n_blocks = 1 + n / 7;
      std::vector<std::set<unsigned int>> item_to_blocks(n);
      std::uniform_int_distribution<>     number(0, 3), block(0, n_blocks - 1);
      for (auto &blocks : item_to_blocks)
        for (int k = number(generator); k > 0; --k)
          blocks.insert(block(generator));
      ChosenItems items;
      EXPECT_TRUE(items.empty());
      items.reinit(n, [&](const auto &add) {
        for (unsigned int i = 0; i < n; ++i)
          for (const unsigned int b : item_to_blocks[i])
            add(i, b);
      });
      EXPECT_FALSE(items.empty());
      EXPECT_EQ(all_of(items, n).size(), n);
      for (const double share : {0., 0.1, 0.5, 1., 0.02})
      {
        std::vector<bool> chosen(n_blocks);
        for (unsigned int b = 0; b < n_blocks; ++b)
          chosen[b] = std::bernoulli_distribution(share)(generator);
        items.select(chosen);
        std::vector<unsigned int> expected;
        for (unsigned int i = 0; i < n; ++i)
          for (const unsigned int b : item_to_blocks[i])
            if (chosen[b])
            {
              expected.push_back(i);
              break;
            }
        EXPECT_FALSE(items.all());
        EXPECT_EQ(items.chosen(), expected);
        EXPECT_EQ(all_of(items, n), expected);
        for (unsigned int i = 0; i < n; ++i)
          EXPECT_EQ(items.contains(i),
                    std::binary_search(expected.begin(), expected.end(), i));
      }
      items.select({});
      EXPECT_TRUE(items.all());
      EXPECT_EQ(all_of(items, n).size(), n);
    }
  }
} // namespace
