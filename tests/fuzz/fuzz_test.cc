// Some hundred random cases of each generator; nmm-fuzz runs more.

#include <fuzz/fuzz.h>
#include <gtest/gtest.h>

using namespace NMM::Fuzz;

TEST(Fuzz, Geometry)
{
  const Generator &generator = find_generator("geometry");
  for (unsigned int seed = 101; seed <= 300; ++seed)
  {
    const Case        c       = generator.make(seed);
    const std::string failure = check(generator, c);
    EXPECT_EQ(failure, "") << "nmm-fuzz geometry 1 " << seed << ": "
                           << c.description << '\n'
                           << c.files.at("case.wkt");
  }
}
