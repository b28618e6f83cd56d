// Blocks on slopes with known limits, at full size. Argument 1: which bar (1: toppling
// columns, 2: map of a block on an incline, 3: factors of safety, 4: shaken block;
// 0: all), argument 2: the file for the table.

#include <nmm/base/program.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iostream>
#include <support/block_bars/block_bars.h>

using namespace NMM;
using namespace NMM::BlockBars;

int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  const std::string     which = argc > 1 ? argv[1] : "0";
  Measurements          measurements(&std::cout);
  const auto            is_asked = [&](const std::string &bar) {
    return which == "0" || which == bar;
  };
  try
  {
    if (is_asked("1"))
      topple_columns(Toppling(), measurements);
    if (is_asked("2"))
      map_incline(InclineMap(), measurements);
    if (is_asked("3"))
    {
      slide_wedge(Slides(), measurements);
      slide_two_blocks(Slides(), measurements);
    }
    if (is_asked("4"))
      for (const unsigned int seed : {1U, 2U, 3U})
      {
        BaseMotion motion;
        motion.seed = seed;
        shake_block(motion, measurements);
      }
  }
  catch (const InputError &error)
  {
    std::cout << error.message() << std::endl;
    return 2;
  }
  catch (const NumericalFailure &failure)
  {
    std::cout << failure.message() << std::endl;
    return 3;
  }
  if (argc > 2)
  {
    std::ofstream csv(argv[2]);
    measurements.write_csv(csv);
  }
  return measurements.failures().empty() ? 0 : 1;
}
