// Some hundred random cases of each generator; nmm-fuzz runs more.

#include "support/n_samples.h"
#include <fuzz/fuzz.h>
#include <gtest/gtest.h>

using namespace NMM::Fuzz;

namespace
{
  void
  expect_good(const std::string &name, const unsigned int seed)
  {
    const Generator  &generator = find_generator(name);
    const Case        c         = generator.make(seed);
    const std::string failure   = check(generator, c);
    std::string       files;
    for (const auto &[file, text] : c.files)
      if (!failure.empty())
        files += file + ":\n" + text;
    EXPECT_EQ(failure, "") << "nmm-fuzz " << name << " 1 " << seed << ": "
                           << c.description << '\n'
                           << files;
  }
} // namespace


TEST(Fuzz, Geometry)
{
  for (unsigned int seed = 1; seed <= n_samples(500); ++seed)
    expect_good("geometry", seed);
}


TEST(Fuzz, Scenes)
{
  for (unsigned int seed = 1; seed <= n_samples(500); ++seed)
    expect_good("scene", seed);
}


TEST(Fuzz, Growth)
{
  for (unsigned int seed = 1; seed <= n_samples(40); ++seed)
    expect_good("growth", seed);
}


TEST(Fuzz, GrowthWithContact)
{
  for (unsigned int seed = 1; seed <= n_samples(4); ++seed)
    expect_good("contact-growth", seed);
}


TEST(Fuzz, GrowthInMotion)
{
  for (unsigned int seed = 1; seed <= n_samples(4); ++seed)
    expect_good("growth-in-motion", seed);
}


TEST(Fuzz, BlocksInMotionFarFromTheOrigin)
{
  for (unsigned int seed = 1; seed <= n_samples(4); ++seed)
    expect_good("blocks", seed);
}


// Joints that run within rounding along others and end inside a block: the patch test was
// off by up to 2e-2 there, or the system singular.
TEST(Fuzz, StripsThatEndInABlock)
{
  for (const unsigned int seed :
       {69, 1733, 2123, 2369, 13664, 20136, 20427, 48971})
    expect_good("geometry", seed);
}


// Strips whose polynomials are those of another strip that points elsewhere: the bound on
// their traces was that of the other strip, and up to 1e14 times too large.
TEST(Fuzz, StripsTiedToTheTraceOfAnother)
{
  for (const unsigned int seed : {7227, 27434, 42709, 48836})
    expect_good("geometry", seed);
}


// Strips so thin that rounding decides about 1e-5 of the displacements, or all of them: the
// estimate of its effect has to say so, and the solver to refuse the last but one. The last one is
// only some hundred roundings of its coordinates wide.
TEST(Fuzz, StripsThatRoundingMoves)
{
  for (const unsigned int seed : {36846, 225623, 400036, 400057, 604659})
    expect_good("geometry", seed);
}


// In a load step an obstacle went so far, 3e28 m, that the ends of its faces were one number, and
// the check of paths read beyond its arrays.
TEST(Fuzz, PathsFurtherThanNumbersResolve)
{
  expect_good("scene", 607248);
}


// 150,000 joints of 300 km through cells of 2 m: it took minutes to cut the solid before its
// mesh was refused.
TEST(Fuzz, JointsThroughTooManyCells)
{
  expect_good("scene", 749448);
}


// An arc of a crack's face that is shorter than coordinates can tell has no direction: the
// intensity factors were no numbers, and the run ended with exit code 0.
TEST(Fuzz, FacesThatAreShorterThanCoordinatesCanTell)
{
  expect_good("growth", 41766);
}
