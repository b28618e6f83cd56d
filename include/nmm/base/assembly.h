#ifndef nmm_base_assembly_h
#define nmm_base_assembly_h

/// What a nonlinear solver asks of an assembly, and what an assembly answers.
namespace NMM
{
  /// Whether a law is defined for a deformation: an expected outcome of a
  /// Newton step that goes too far.
  enum class [[nodiscard]] Deformation{
    admissible,
    /// det F <= 0 where the law needs it to be positive.
    inverted};


  /// Which derivative of the forces an assembly makes.
  enum class Tangent
  {
    /// None: forces alone.
    none,
    /// The derivative.
    consistent,
    /**
     * The derivative without those terms that are large far from the solution
     * only and may lead away from it; see FiniteElasticity. For the first
     * iterations of a step.
     */
    robust
  };
} // namespace NMM

#endif
