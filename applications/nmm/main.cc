// The general driver: reads a scene file, solves it and writes tables, fields
// and a picture. See doc/scene-format.md.

#include <deal.II/base/mpi.h>

#include "driver.h"
#include <iostream>

int
main(int argc, char **argv)
{
  try
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    try
    {
      return run_driver(argc, argv, MPI_COMM_WORLD);
    }
    catch (const std::exception &error)
    {
      std::cerr << "nmm: internal error: " << error.what() << std::endl;
      // Other ranks may wait for this one.
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, 1);
      return 1;
    }
  }
  catch (const std::exception &error)
  {
    std::cerr << "nmm: " << error.what() << std::endl;
    return 1;
  }
}
