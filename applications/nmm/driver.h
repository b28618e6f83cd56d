#ifndef nmm_applications_driver_h
#define nmm_applications_driver_h

#include <mpi.h>

/**
 * Run the program on the command line (@p argc, @p argv), as main() is given it:
 * read the scene, solve it and write tables, fields and a picture, or print what
 * was asked for. Messages go to std::cout and std::cerr, those of errors on the
 * first rank of @p communicator only.
 *
 * Returns the exit code of the program: 0 for success, 2 for bad input (nothing is
 * written), 3 if there is no solution (what is known is written) or results cannot
 * be written, 4 if a signal has stopped it at the end of a step, 1 for mistakes in this program.
 *
 * It may be called repeatedly in one process: tests of bad input do so.
 */
int
run_driver(int argc, char **argv, MPI_Comm communicator);

#endif
