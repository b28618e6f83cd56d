#ifndef nmm_base_types_h
#define nmm_base_types_h

#include <deal.II/base/numbers.h>
#include <deal.II/base/types.h>

#include <utility>

/**
 * The second-order numerical manifold method on deal.II.
 *
 * Modules, in the order data flows (a module includes only those before it):
 * base, geometry, covers, quadrature, mechanics, dynamics, io.
 */
namespace NMM
{
  /// "No such thing": an index that no object has.
  constexpr unsigned int invalid_index = dealii::numbers::invalid_unsigned_int;

  /// Two blocks, by number.
  using BlockPair = std::pair<unsigned int, unsigned int>;
} // namespace NMM

#endif
