#include <nmm/base/program.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

/**
 * main() of every test executable. MPI is initialized once, with one thread,
 * because deal.II's Trilinos objects need it; a failing Assert throws instead of
 * aborting, so that tests can expect it.
 */
int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  testing::InitGoogleTest(&argc, argv);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  return RUN_ALL_TESTS();
}
