#include "run_in_process.h"

#include <deal.II/base/mpi.h>

#include "driver.h"
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace
{
  /// Collects what is written to std::cout and std::cerr during its lifetime.
  class Capture
  {
  public:
    Capture()
      : cout_buffer(std::cout.rdbuf(text.rdbuf()))
      , cerr_buffer(std::cerr.rdbuf(text.rdbuf()))
    {
    }

    ~Capture()
    {
      std::cout.rdbuf(cout_buffer);
      std::cerr.rdbuf(cerr_buffer);
    }

    std::ostringstream text;

  private:
    std::streambuf *cout_buffer;
    std::streambuf *cerr_buffer;
  };
} // namespace


DriverResult
run_in_process(const std::vector<std::string> &arguments)
{
  std::vector<std::string> words = {"nmm"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char *> argv;
  for (std::string &word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);

  Capture capture;
  int     exit_code = 1;
  try
  {
    exit_code = run_driver(words.size(), argv.data(), MPI_COMM_WORLD);
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what();
  }
  return {exit_code, capture.text.str()};
}


std::string
fresh_output_dir(const std::string &name)
{
  const std::string path = NMM_TEST_OUTPUT_DIR "/" + name;
  if (is_first_rank())
  {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(
      std::filesystem::path(path).parent_path());
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return path;
}


unsigned int
n_ranks()
{
  return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
}


bool
is_first_rank()
{
  return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}
