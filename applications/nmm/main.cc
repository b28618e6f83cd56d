// The general driver: reads a scene file, solves it and writes tables, fields
// and a picture. See doc/scene-format.md.

#include <nmm/base/program.h>
#include <nmm/base/stop.h>

#include "driver.h"
#include <csignal>

int
main(int argc, char **argv)
{
  // A file that becomes too large is an error like that of a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  const NMM::MPISession mpi(argv[0]);
  NMM::stop_at_signals();
  return run_driver(argc, argv, MPI_COMM_WORLD);
}
