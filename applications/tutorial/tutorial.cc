#include "tutorial/tutorial.h"

#include <nmm/base/exceptions.h>
#include <nmm/base/program.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace Tutorial
{
  using namespace dealii;

  namespace
  {
    /// Before anything is computed.
    void
    make_output_directory(const std::string &name)
    {
      try
      {
        std::filesystem::create_directories(name);
      }
      catch (const std::filesystem::filesystem_error &error)
      {
        AssertThrow(false,
                    NMM::InputError("the folder for results cannot be made (" +
                                      error.code().message() + ")",
                                    name,
                                    "name one that can be written to"));
      }
    }
  } // namespace


  int
  run(const int                                                       argc,
      char                                                          **argv,
      const std::function<void(const std::string &parameter_file,
                               const std::string &output_directory)> &study)
  {
    try
    {
      const NMM::MPISession mpi(argv[0]);
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
        std::cout.setstate(std::ios::failbit);
      const std::string directory = argc > 2 ? argv[2] : ".";
      make_output_directory(directory);
      study(argc > 1 ? argv[1] : "", directory);
    }
    catch (...)
    {
      const NMM::ProgramEnd end =
        NMM::explain_exception(/* has_output = */ false);
      std::cerr << end.message << std::endl;
      return static_cast<int>(end.code);
    }
    return static_cast<int>(NMM::ExitCode::success);
  }


  void
  check_that_there_is_one_rank(const std::string &program)
  {
    AssertThrow(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1,
                NMM::InputError("The program runs on several ranks",
                                program,
                                "start it without mpirun: its tables are times "
                                "of one core"));
  }


  ParameterFile::ParameterFile(const std::string &file_name,
                               const std::string &prefix)
    : prefix(prefix)
    , file_name(file_name)
    , prm(std::make_shared<ParameterHandler>())
  {
    if (file_name.empty())
      return;
    std::ifstream      file(file_name);
    std::ostringstream content;
    content << file.rdbuf();
    AssertThrow(file,
                NMM::InputError("the parameter file cannot be read",
                                file_name,
                                "check its name"));
    text = content.str();
  }


  void
  ParameterFile::check_that_all_is_known()
  {
    parse(/* skips_unknown = */ false);
  }


  std::string
  ParameterFile::read(const std::string           &name,
                      const std::string           &standard,
                      const Patterns::PatternBase &pattern)
  {
    prm->declare_entry(name, standard, pattern);
    parse(/* skips_unknown = */ true);
    return prm->get(name);
  }


  void
  ParameterFile::parse(const bool skips_unknown)
  {
    try
    {
      std::istringstream input(text);
      prm->parse_input(input, file_name, "", skips_unknown);
    }
    catch (const ExceptionBase &exception)
    {
      std::ostringstream reason;
      exception.print_info(reason);
      AssertThrow(false,
                  NMM::InputError("the parameter file is wrong (" +
                                    reason.str() + ")",
                                  file_name,
                                  "see the .prm file beside the source of the "
                                  "program, which has all entries"));
    }
  }


  void
  draw_figures(const std::string &prefix,
               const std::string &script,
               const std::string &reference)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    if (!reference.empty())
      std::ofstream(prefix + "reference.csv") << reference;
    const std::string file_name = prefix + "figures.gp";
    const std::string commands =
      Utilities::replace_in_string(script, "PREFIX", prefix);
    std::ofstream(file_name) << commands;
    if (std::system(("gnuplot '" + file_name + "'").c_str()) != 0)
    {
      std::cout << "No figures: gnuplot is missing or failed; " << file_name
                << " draws them" << std::endl;
      return;
    }
    const std::string  output = "set output '";
    std::istringstream lines(commands);
    const char        *separator = "Figures: ";
    for (std::string line; std::getline(lines, line);)
      if (line.rfind(output, 0) == 0)
      {
        std::cout << separator
                  << line.substr(output.size(),
                                 line.rfind('\'') - output.size());
        separator = ", ";
      }
    std::cout << std::endl;
  }
} // namespace Tutorial
