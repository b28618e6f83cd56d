// Speed against error: measures cases and requirements, and writes the report.
//
//   nmm-bench measure smallest|quick|full <table.csv> [<case>]
//   nmm-bench counts <counts.csv> [<directory of callgrind's files of nmm-kernels>]
//   nmm-bench report <table.csv> <directory>
//
// On several ranks, `measure` adds the rows of what is shared out among ranks to a table
// that is there.

#include <nmm/base/program.h>

#include "counts.h"
#include "measure.h"
#include "report.h"
#include <filesystem>
#include <iostream>
#include <sstream>

using namespace NMM;
using namespace NMM::Bench;

namespace
{
  Size
  read_size(const std::string &text)
  {
    AssertThrow(text == "smallest" || text == "quick" || text == "full",
                InputError("there is no size '" + text + "'",
                           "nmm-bench measure",
                           "say smallest, quick or full"));
    return text == "full"    ? Size::full
           : text == "quick" ? Size::quick
                             : Size::smallest;
  }


  struct Case
  {
    const char *name;
    void (*measure)(Recorder &);
    /// Is it shared out among ranks?
    bool has_ranks;
  };

  // what needs most memory first
  const Case cases[] = {{"cutting", measure_cutting, false},
                        {"large-rings", measure_large_rings, true},
                        {"ranks", measure_ranks, true},
                        {"ring", measure_ring, true},
                        {"cantilever", measure_cantilever, false},
                        {"hertz", measure_hertz, false},
                        {"cracked-plate", measure_cracked_plate, false},
                        {"incline", measure_incline, false},
                        {"slope", measure_slope, false},
                        {"output", measure_output, false},
                        {"threads", measure_threads, false},
                        {"values", measure_values, false}};


  /// All cases, or the one of that name.
  void
  measure(const Size         size,
          const std::string &file_name,
          const std::string &name)
  {
    using namespace dealii::Utilities::MPI;
    const bool is_alone = n_mpi_processes(MPI_COMM_WORLD) == 1;
    Recorder   recorder(size,
                      is_alone ? std::vector<Row>() : read_table(file_name));
    for (const Case &c : cases)
      if ((name.empty() || name == c.name) && (is_alone || c.has_ranks))
      {
        c.measure(recorder);
        if (this_mpi_process(MPI_COMM_WORLD) == 0)
          write_table(file_name, recorder.rows());
      }
    AssertThrow(
      !recorder.rows().empty(),
      InputError("there is no case '" + name + "'",
                 "nmm-bench measure",
                 "say cutting, large-rings, ranks, ring, cantilever, hertz, "
                 "cracked-plate, incline, slope, output, threads or values"));
  }


  void
  run(const std::vector<std::string> &arguments)
  {
    if ((arguments.size() == 3 || arguments.size() == 4) &&
        arguments[0] == "measure")
      return measure(read_size(arguments[1]),
                     arguments[2],
                     arguments.size() == 4 ? arguments[3] : "");
    if ((arguments.size() == 2 || arguments.size() == 3) &&
        arguments[0] == "counts")
    {
      std::vector<Count> counts = count_allocations();
      if (arguments.size() == 3)
        for (const Count &count : read_instructions(arguments[2]))
          counts.push_back(count);
      return write_counts(arguments[1], counts);
    }
    AssertThrow(arguments.size() == 3 && arguments[0] == "report",
                InputError("these arguments say nothing",
                           "nmm-bench",
                           "say measure smallest|quick|full <table.csv>, "
                           "counts <counts.csv>, or "
                           "report <table.csv> <directory>"));
    write_report(read_table(arguments[1]), arguments[2]);
  }
} // namespace


int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  try
  {
    run({argv + 1, argv + argc});
  }
  catch (const InputError &error)
  {
    error.print_info(std::cerr);
    return 2;
  }
  catch (const NumericalFailure &error)
  {
    error.print_info(std::cerr);
    return 3;
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 1;
  }
  return 0;
}
