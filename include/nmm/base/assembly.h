#ifndef nmm_base_assembly_h
#define nmm_base_assembly_h

#include <vector>

/// The types by which a nonlinear solver asks for an assembly, and by which the assembly answers.
namespace NMM
{
  /// Whether a law is defined for a deformation. That it is not is an expected outcome of a
  /// Newton step that goes too far.
  enum class [[nodiscard]] Deformation{
    /// The law is defined, and its result is valid.
    admissible,
    /// The law is not defined, e.g. since det F <= 0; its result is not valid.
    inverted};


  /// Which derivative of the forces with respect to the unknowns is assembled.
  enum class Tangent
  {
    /// Only the forces are assembled.
    none,
    /// The exact derivative is assembled.
    consistent,
    /**
     * The derivative is assembled without those terms that are large only far from the solution
     * and may lead away from it; see FiniteElasticity. It is meant for the first iterations of a
     * step.
     */
    robust
  };


  /// For each block, whether the rows of its unknowns are wanted from an assembly; empty: those of
  /// all blocks. Other rows, energies and the scale of forces are undefined then. This saves time
  /// where most blocks have converged or sleep.
  using BlockSelection = std::vector<bool>;
} // namespace NMM

#endif
