#ifndef nmm_base_types_h
#define nmm_base_types_h

#include <deal.II/base/numbers.h>
#include <deal.II/base/types.h>

#include <utility>

/**
 * The second-order numerical manifold method on deal.II.
 *
 * The library consists of modules ("rooms"), listed here in the order in which data flows: base,
 * geometry, covers, quadrature, linear_algebra, solution, materials, mechanics, fracture, contact,
 * dynamics, output, scene. Each is described in one of its headers: doc/conventions.md has a table.
 *
 * The room `base` holds what all others use. It has no order of calls:
 *
 * | header | content |
 * |---|---|
 * | types.h | index types |
 * | exceptions.h | InputError and NumericalFailure, the errors that users see |
 * | assembly.h | the interface between nonlinear solvers and assemblies |
 * | named_law.h | parameters of laws, and lists of laws that scenes choose from |
 * | memory.h | available memory, checked before a large allocation |
 * | program.h | MPI, exit codes and messages of programs |
 * | step_fault.h | why the result of a step is refused |
 * | compat.h | differences between versions of deal.II |
 *
 * The body of main() in a program that keeps the exit codes of the driver:
 * @code
 * try
 *   {
 *     const MPISession mpi(argv[0]);
 *     run();
 *   }
 * catch (...)
 *   {
 *     const ProgramEnd end = explain_exception(false);      // nothing has been written yet
 *     std::cerr << end.message << std::endl;
 *     return static_cast<int>(end.code);
 *   }
 * return static_cast<int>(ExitCode::success);
 * @endcode
 */
namespace NMM
{
  /// The index that stands for "none": no object has it.
  constexpr unsigned int invalid_index = dealii::numbers::invalid_unsigned_int;

  /// The indices of two blocks.
  using BlockPair = std::pair<unsigned int, unsigned int>;
} // namespace NMM

#endif
